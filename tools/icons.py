"""Draw and grade transitions of icons: python -m tools.icons [FOLDER], by default docs/icons.

FOLDER has pairs.json: a list of objects with the keys id, set, name, a and b, the last two files below FOLDER. The page
out/icons/index.html has their frames, the worst grades first, and out/icons/grades.md a table of the grades by set.
"""

from __future__ import annotations

import html
import io
import json
import re
import sys
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from PIL import Image

import shapeblend_cli as sb
from shapeblend_cli.blending.graded import grade_of
from shapeblend_cli.grading.grade import NAMES, Grade
from shapeblend_cli.options.easing import parse
from shapeblend_cli.outputs.contact_sheet import contact_sheet
from shapeblend_cli.outputs.pixels import Size
from tools.quality.data import ROOT

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

FOLDER, OUT = ROOT / "docs" / "icons", ROOT / "out" / "icons"
STEPS = 6
"""Number of steps between the frames of the page, which are those that are graded."""

SHIPS = 1.5
"""Maximum grade of what a designer would ship: nearer to good than to flawed."""

SETS = {"lucide": "Lucide", "phosphor": "Phosphor", "bootstrap": "Bootstrap Icons"}
"""The sets of docs/icons."""

COLUMNS, CELL, PICTURES, REST = 10, 40, 16, 6
"""Of a moving sheet: its columns, the pixels of a cell, the pictures of one way, and those for which it rests."""


class Transition(NamedTuple):
    """A pair of icons, its frames as SVG, and its grade."""

    id: str
    set: str
    name: str
    frames: list[str]
    grade: Grade


def pairs_in(folder: Path, only: str | None = None) -> list[dict[str, str]]:
    """Return the pairs of a folder, or of one set in it."""
    pairs = json.loads((folder / "pairs.json").read_text("utf-8"))
    return [
        pair | {"name": pair.get("name") or f"{pair['from']} to {pair['to']}"}
        for pair in pairs
        if only in (None, pair["set"])
    ]


def drawn(folder: Path, pair: dict[str, str]) -> Transition:
    """Blend a pair, and grade what is seen."""
    blend = sb.blend(folder / pair["a"], folder / pair["b"])
    frames = [blend.frame(k / STEPS).svg for k in range(STEPS + 1)]
    (move,) = blend.pairs
    return Transition(pair["id"], pair["set"], pair["name"], frames, grade_of(move))


def page(transitions: Iterable[Transition]) -> str:
    """Return a page with a row for each transition, the worst grade first."""
    rows = [
        f"<tr><td>{html.escape(one.id)}<br>{html.escape(one.name)}<td>{one.grade.number:.1f}<br>"
        f"{html.escape(one.grade.why or '')}<td>{''.join(one.frames)}"
        for one in sorted(transitions, key=lambda one: -one.grade.number)
    ]
    style = "svg { width: 96px; height: 96px; margin: 4px } td { border-top: 1px solid #ccc; font: 14px sans-serif }"
    return f"<!doctype html><title>Transitions</title><style>{style}</style><table>{''.join(rows)}</table>\n"


def table(transitions: Sequence[Transition]) -> str:
    """Return a table of the grades, by set, in Markdown."""
    lines = [f"| set | {' | '.join(NAMES)} | can ship |", f"| --- | {'--- | ' * (len(NAMES) + 1)}"]
    for name in sorted({one.set for one in transitions}):
        numbers = [one.grade.number for one in transitions if one.set == name]
        counts = [sum(round(number) == k for number in numbers) for k in range(len(NAMES))]
        ships = sum(number < SHIPS for number in numbers)
        lines.append(f"| {name} | {' | '.join(map(str, counts))} | {ships} of {len(numbers)} |")
    return "\n".join(lines) + "\n"


def moving_sheet(name: str) -> bytes:
    """Return a moving picture of all transitions of a set of docs/icons, side by side."""
    ease = parse("ease-in-out")
    times = [ease.at(k / PICTURES) for k in range(PICTURES + 1)]
    sheets = sheets_at(name, times)
    durations = [40] * len(sheets)
    durations[0] = durations[-1] = 40 * REST
    file = io.BytesIO()
    both = [*sheets, *sheets[-2:0:-1]]
    both[0].save(
        file,
        "WEBP",
        save_all=True,
        append_images=both[1:],
        duration=[*durations, *durations[-2:0:-1]],
        loop=0,
        lossless=True,
        method=6,
    )
    return file.getvalue()


def still_sheet(name: str) -> bytes:
    """Return a picture of all transitions of a set of docs/icons half way."""
    (sheet,) = sheets_at(name, [0.5])
    file = io.BytesIO()
    sheet.save(file, "PNG", optimize=True)
    return file.getvalue()


def sheets_at(name: str, times: Sequence[float]) -> list[Image.Image]:
    """Return all transitions of a set side by side, at times."""
    blends = [sb.blend(FOLDER / pair["a"], FOLDER / pair["b"]) for pair in pairs_in(FOLDER, name)]
    grey = Image.new("P", (1, 1))
    grey.putpalette([k * 85 for k in range(4) for _ in range(3)])
    return [
        contact_sheet(
            [without_size(blend.frame(t).svg) for blend in blends],
            Size(CELL, CELL),
            COLUMNS,
            ground="#fff",
            page="#fff",
        )
        .convert("RGB")
        .quantize(palette=grey, dither=Image.Dither.NONE)
        for t in times
    ]


def without_size(svg: str) -> str:
    """Return a file that any place may give its size."""
    root, end, rest = svg.partition(">")
    return re.sub(r' (width|height)="[^"]*"', "", root) + end + rest


def main() -> None:
    folder = Path(sys.argv[1]) if len(sys.argv) > 1 else FOLDER
    transitions = [drawn(folder, pair) for pair in pairs_in(folder)]
    OUT.mkdir(parents=True, exist_ok=True)
    (OUT / "index.html").write_text(page(transitions), "utf-8")
    (OUT / "grades.md").write_text(table(transitions), "utf-8")
    print(table(transitions), end="")
    print(f"\nFrames: {OUT / 'index.html'}")


if __name__ == "__main__":
    main()
