"""Draw the contact sheets of the README with the tool itself: python -m tools.readme_pictures, no arguments."""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import TYPE_CHECKING

from shapeblend_cli.cli import run
from tools.contact_sheet import sheet

if TYPE_CHECKING:
    from PIL import Image

ROOT = Path(__file__).resolve().parents[1]
DOCS = ROOT / "docs"

# For each picture its rows: the two drawings, and what else the README says was on the command line.
SHEETS = {
    "letters": ["e f"],
    "triangle-square": ["triangle square"],
    "bird": ["bird-1 bird-2"],
    "animals": ["cow deer --preset fig27"],
    "step": ["step-1 step-2 --motion linear", "step-1 step-2"],
    "dancer": ["dancer-1 dancer-2 --preset fig28 --motion linear", "dancer-1 dancer-2 --preset fig28"],
}


def row(blend: str) -> list[str]:
    """The frames of a blend, both ends among them."""
    a, b, *options = blend.split()
    files = [str(ROOT / "samples" / f"{sample}.svg") for sample in (a, b)]
    with tempfile.TemporaryDirectory() as folder:
        if run([*files, "--ends", "--output", f"{folder}/frames", *options]) != 0:
            raise SystemExit(f"{blend} was not blended")
        return [path.read_text(encoding="utf-8") for path in sorted(Path(folder, "frames").iterdir())]


def drawn(name: str) -> Image.Image:
    """One of the pictures."""
    rows = [row(blend) for blend in SHEETS[name]]
    return sheet([frame for frames in rows for frame in frames], len(rows[0]), 140).quantize(64)


def main() -> None:
    for name in SHEETS:
        target = DOCS / f"{name}.png"
        drawn(name).save(target, optimize=True)
        print(target.relative_to(ROOT))


if __name__ == "__main__":
    main()
