"""Draw the animations of docs/moving.md with the tool itself, and write the page: python -m tools.moving_pictures.

Each has a picture that stands still beside it, for those who have asked their system for less motion.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from tools.contact_sheet import sheet
from tools.readme_pictures import DOCS, ROOT, animation, frames

if TYPE_CHECKING:
    from PIL import Image

FOLDER = DOCS / "moving"
DRAWINGS = FOLDER / "drawings"
PAGE = DOCS / "moving.md"

OPTIONS = "--duration 1.2 --ease ease-in-out --repeat pingpong"

PAIRS = [
    ("fox", "wolf"),
    ("snail", "turtle"),
    ("cat-face", "dog-face"),
    ("tulip", "sunflower"),
    ("egg", "hatching-chick"),
    ("grinning-face", "crying-face"),
    ("bird-1", "bird-2"),
    ("dancer-1", "dancer-2"),
    ("play", "pause"),
    ("sun", "moon"),
    ("heart", "star"),
    ("envelope", "envelope-open"),
]
"""Pairs of `DRAWINGS`, and of samples."""

COLUMNS = 3
WIDTH = 160
"""Pixels of an animation in the page."""

CELL, COLOURS = 2 * WIDTH // 3, 32
"""Pixels and colours of a picture that stands still: it has three drawings in a row, each in so many pixels."""

TEXT = f"""\
# A gallery that moves

Written by `make pictures`. A command like this one makes each picture, without any corrections. The files load nothing
else:

```sh
shapeblend fox.svg wolf.svg -o fox-wolf.svg {OPTIONS}
```

These pairs were chosen by eye, from about thirty, to show what is possible. The pairs in
[the other gallery](gallery.md) are chosen by number, and shown next to those of another tool. For pairs that do not
turn out as you want, there is [the studio](studio.md).

If your system is set to reduced motion, you see a picture of both drawings, with the one half way between them.

<table>
{{rows}}
</table>

The bird and the dancer are samples of shapeblend. The other drawings, in
[moving/drawings](moving/drawings/README.md) with their sources, are from Twemoji by Twitter, Inc. and other
contributors (CC BY 4.0), and from Phosphor Icons (MIT), which are given colours here.
"""


def name(pair: tuple[str, str]) -> str:
    return "-".join(pair)


def _files(pair: tuple[str, str]) -> list[str]:
    folders = (DRAWINGS, ROOT / "samples")
    return [
        str(next(folder / f"{drawing}.svg" for folder in folders if (folder / f"{drawing}.svg").exists()))
        for drawing in pair
    ]


def moving(pair: tuple[str, str]) -> str:
    """Return the animation of a pair."""
    return animation(*_files(pair), *OPTIONS.split())


def still(pair: tuple[str, str]) -> Image.Image:
    """Return both drawings with the one half way between them."""
    drawn = frames(*_files(pair), "--frames", "1")
    return sheet(drawn, len(drawn), CELL).quantize(COLOURS)


def page() -> str:
    """Return the text of docs/moving.md."""
    lines = []
    for first in range(0, len(PAIRS), COLUMNS):
        cells = [_cell(pair) for pair in PAIRS[first : first + COLUMNS]]
        lines += ["<tr>", *cells, "</tr>"]
    return TEXT.format(rows="\n".join(lines))


def _cell(pair: tuple[str, str]) -> str:
    a, b = (drawing.rstrip("-12").replace("-", " ") for drawing in pair)
    told = f"From {a} to {b}" if a != b else f"A {a} moves"
    return (
        f'<td><picture><source media="(prefers-reduced-motion: reduce)" srcset="moving/{name(pair)}.png">'
        f'<img src="moving/{name(pair)}.svg" width="{WIDTH}" alt="{told}"></picture></td>'
    )


def main() -> None:
    for pair in PAIRS:
        (FOLDER / f"{name(pair)}.svg").write_text(moving(pair), encoding="utf-8")
        still(pair).save(FOLDER / f"{name(pair)}.png", optimize=True)
        print((FOLDER / name(pair)).relative_to(ROOT))
    PAGE.write_text(page(), encoding="utf-8")


if __name__ == "__main__":
    main()
