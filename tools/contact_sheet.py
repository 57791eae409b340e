"""Draw SVG files side by side into one PNG: contact_sheet.py OUT.png FILE... [--columns N] [--cell PIXELS].

Draws only files this project wrote: a renderer in native code is not for files from elsewhere.
"""

from __future__ import annotations

import argparse
import io
from pathlib import Path

import resvg_py
from PIL import Image, ImageDraw


def sheet(svgs: list[str], columns: int, cell: int) -> Image.Image:
    """All drawings in rows of `columns`, each in a square of `cell` pixels."""
    rows = -(-len(svgs) // columns)
    gap = cell // 20
    picture = Image.new("RGB", (columns * (cell + gap) + gap, rows * (cell + gap) + gap), "white")
    pen = ImageDraw.Draw(picture)
    for k, svg in enumerate(svgs):
        x, y = gap + (k % columns) * (cell + gap), gap + (k // columns) * (cell + gap)
        pen.rectangle((x, y, x + cell - 1, y + cell - 1), fill="#f6f6f4")
        drawing = Image.open(
            io.BytesIO(bytes(resvg_py.svg_to_bytes(svg_string=svg, width=cell, height=cell)))
        )
        drawing = drawing.convert("RGBA")
        drawing.thumbnail((cell, cell))
        at = (x + (cell - drawing.width) // 2, y + (cell - drawing.height) // 2)
        picture.paste(drawing, at, drawing)
    return picture


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("out", type=Path)
    parser.add_argument("files", type=Path, nargs="+")
    parser.add_argument("--columns", type=int)
    parser.add_argument("--cell", type=int, default=200)
    options = parser.parse_args()
    svgs = [file.read_text(encoding="utf-8") for file in options.files]
    sheet(svgs, options.columns or min(len(svgs), 10), options.cell).save(options.out, optimize=True)


if __name__ == "__main__":
    main()
