"""Draw a further set of pairs to be graded by eye: python -m tools.quality.judge.sheets SEED COUNT.

Into `out/quality/judge/SEED` go a sheet for each pair, its rows in shuffled order with letters for names, and a table
of which letter stands for what: look into it only when all is graded.
"""

from __future__ import annotations

import argparse
import random
import sys
from typing import TYPE_CHECKING

import numpy as np
from PIL import Image, ImageDraw

from tools.contact_sheet import sheet
from tools.quality.judge import pairs
from tools.quality.judge.blends import OPTIONS, blend_of, look, unlikeness

if TYPE_CHECKING:
    import shapeblend_cli as sb
    from tools.quality.judge.pairs import Pair

LETTERS = "ABCDEF"
MOMENTS = np.arange(9) / 8
CELL, GUTTER = 84, 20
"""Pixels of a drawing, and what is free for a letter."""

SAME = 0.05
"""Of two blends whose looks differ by no more than this one is drawn."""


def drawn(pair: Pair, blends: dict[str, sb.Blend], order: list[str]) -> Image.Image:
    """The sheet of a pair."""
    frames = [blends[name].frame(t).svg for name in order for t in MOMENTS.tolist()]
    rows = sheet(frames, len(MOMENTS), CELL)
    picture = Image.new("RGB", (rows.width + GUTTER, rows.height + GUTTER), "white")
    picture.paste(rows, (GUTTER, GUTTER))
    draw = ImageDraw.Draw(picture)
    draw.text((2, 2), " ".join(pair), fill="black")
    for k in range(len(order)):
        draw.text((4, GUTTER + (k + 0.5) * rows.height / len(order)), LETTERS[k], fill="black")
    return picture


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("seed", type=int)
    parser.add_argument("count", type=int)
    options = parser.parse_args()
    if problem := pairs.ready():
        sys.exit(f"no icons: {problem}")
    folder = pairs.INSTALLED / str(options.seed)
    folder.mkdir(parents=True, exist_ok=True)
    lots = random.Random(options.seed)
    lines = ["\t".join(("pair", "icons", "a", "b", "blend", "letter", "look"))]
    for k, pair in enumerate(pairs.picked(options.seed, options.count)):
        blends = {name: blend_of(pair, how) for name, how in OPTIONS.items()}
        looks = {name: look(blend) for name, blend in blends.items()}
        unlike: list[str] = []
        for name in OPTIONS:
            if all(unlikeness(looks[name], looks[other]) > SAME for other in unlike):
                unlike.append(name)
        lots.shuffle(unlike)
        drawn(pair, blends, unlike).save(folder / f"{k:03d}.png")
        for name in OPTIONS:
            shown = min(unlike, key=lambda other: unlikeness(looks[name], looks[other]))
            lines.append("\t".join((str(k), *pair, name, LETTERS[unlike.index(shown)], looks[name])))
        print(k, *pair)
    (folder / "key.tsv").write_text("\n".join(lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
