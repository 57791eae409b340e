"""Draw a further set of pairs to be graded by eye: python -m tools.quality.judge.sheets SEED COUNT.

Into `out/judge/SEED` go a sheet for each pair, its rows in shuffled order with letters for names, and `key.tsv`
with what each letter stands for: look into that only when all is graded. Write the grades into a file, a line for each
pair, as

    0|A3 B0 C2|what is wrong with the rest

and `--grades FILE` makes of it the tables beside this file. Pairs whose grades are all alike are left out.
"""

from __future__ import annotations

import argparse
import csv
import random
import sys
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from PIL import Image, ImageDraw

from tools.pictures import sheet
from tools.quality.data import ROOT
from tools.quality.judge import pairs
from tools.quality.judge.blends import OPTIONS, blend_of, look, unlikeness
from tools.quality.judge.section import HERE
from tools.quality.npm import install

if TYPE_CHECKING:
    import shapeblend_cli as sb
    from tools.quality.judge.pairs import Pair

LETTERS = "ABCDEF"
MOMENTS = np.arange(9) / 8
CELL, GUTTER = 84, 20
"""Pixels of a drawing, and what is free for a letter."""

SAME = 0.05
"""Of two blends whose looks differ by no more than this one is drawn, and the other gets its grade."""

KEY = ("pair", "icons", "a", "b", "blend", "letter", "look")


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


def draw(seed: int, count: int, folder: Path) -> None:
    """Write the sheets of a set, and the key."""
    folder.mkdir(parents=True, exist_ok=True)
    lots = random.Random(seed)
    lines = [KEY]
    for k, pair in enumerate(pairs.picked(seed, count)):
        blends = {name: blend_of(pair, options) for name, options in OPTIONS.items()}
        looks = {name: look(blend) for name, blend in blends.items()}
        unlike: list[str] = []
        for name in OPTIONS:
            if all(unlikeness(looks[name], looks[other]) > SAME for other in unlike):
                unlike.append(name)
        lots.shuffle(unlike)
        drawn(pair, blends, unlike).save(folder / f"{k:03d}.png")
        for name in OPTIONS:
            shown = min(unlike, key=lambda other: unlikeness(looks[name], looks[other]))
            lines.append((str(k), *pair, name, LETTERS[unlike.index(shown)], looks[name]))
    (folder / "key.tsv").write_text("".join("\t".join(line) + "\n" for line in lines), encoding="utf-8")


def tables(key: str, graded: str) -> dict[str, str]:
    """The tables of grades and of looks, of a key and the grades of its letters."""
    rows = list(csv.DictReader(key.splitlines(), delimiter="\t"))
    made = {
        "grades": [("icons", "a", "b", *OPTIONS, "note")],
        "looks": [("icons", "a", "b", *OPTIONS)],
    }
    for line in graded.splitlines():
        number, grades, note = line.split("|")
        grade = {word[0]: word[1:] for word in grades.split()}
        of_pair = [row for row in rows if row["pair"] == number]
        if grade.keys() != {row["letter"] for row in of_pair}:
            raise SystemExit(
                f"pair {number} has the letters {', '.join(sorted({r['letter'] for r in of_pair}))}"
            )
        if len(set(grade.values())) > 1:
            icons = tuple(of_pair[0][name] for name in ("icons", "a", "b"))
            made["grades"].append((*icons, *(grade[row["letter"]] for row in of_pair), note))
            made["looks"].append((*icons, *(row["look"] for row in of_pair)))
    return {what: "".join("\t".join(line) + "\n" for line in lines) for what, lines in made.items()}


def main(arguments: list[str] | None = None) -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("seed", type=int)
    parser.add_argument("count", type=int)
    parser.add_argument("--grades", type=Path, metavar="FILE")
    options = parser.parse_args(arguments)
    if problem := install():
        sys.exit(f"no icons: {problem}")
    folder = ROOT / "out" / "judge" / str(options.seed)
    if options.grades is None:
        draw(options.seed, options.count, folder)
        print(folder)
        return
    made = tables((folder / "key.tsv").read_text("utf-8"), options.grades.read_text("utf-8"))
    for what, text in made.items():
        (HERE / f"{what}-{options.seed}.tsv").write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
