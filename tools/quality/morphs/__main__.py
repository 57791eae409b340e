"""Measure shapeblend by morphs whose truth lies in a folder: python -m tools.quality.morphs DIR.

The folder has one split, with its `index.json`, or several of them below it. Further options go to the command.
"""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from tools.quality.morphs import lines
from tools.quality.morphs.shape import shape
from tools.quality.peers import shapeblend
from tools.quality.tables import Table
from tools.quality.truth.form import SETS, load
from tools.quality.truth.measures import GROSS, WRONG, corr, strict

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from tools.quality.truth.form import Linked, Truth

AS_POLYGONS = "--polygons"
"""What moves and corresponds is measured, not how well curves stand for it."""

HEADER = (
    "split",
    "set",
    "pairs",
    "corr, median",
    "mean",
    "max",
    "gross",
    "strict, mean",
    "shape, mean",
    "dist, mean",
)


class Found(NamedTuple):
    """What is said of one pair: `strict` and `shape` of regions, `dist` of open lines."""

    id: str
    corr: float
    gross: bool
    strict: float | None = None
    shape: float | None = None
    dist: float | None = None


def found(truth: Truth, blend: Linked | None) -> Found:
    """Judge a blend; one that is none is as far off as can be."""
    if truth.open:
        dist, off = lines.nearness(truth, blend)
        return Found(truth.id, off, off > lines.GROSS, dist=dist)
    if blend is None:
        return Found(truth.id, WRONG, True, 1.0, 1.0)
    off = corr(truth, blend.links)
    return Found(truth.id, off, off > GROSS, strict(truth, blend.frames), shape(truth, blend.frames))


def splits(folder: Path) -> list[Path]:
    """The folder itself, or those in it that have an index."""
    return [
        file.parent for file in [folder / "index.json", *sorted(folder.glob("*/index.json"))] if file.exists()
    ]


def measured(folder: Path, also: Sequence[str]) -> Iterator[tuple[str, str, list[Found]]]:
    """What is said of the pairs, by split and set."""
    for split in splits(folder):
        for name in SETS:
            if truths := list(load(split, name)):
                blends = shapeblend.linked(truths, [AS_POLYGONS, *also])
                yield split.name, name, [found(*both) for both in zip(truths, blends, strict=True)]


def row(every: list[Found]) -> list[str]:
    """A line of the table."""
    off = [one.corr for one in every]
    means = [
        [value for value in (getattr(one, name) for one in every) if value is not None]
        for name in ("strict", "shape", "dist")
    ]
    return [
        str(len(every)),
        *(f"{take(off):.4f}" for take in (np.median, np.mean, np.max)),
        f"{np.mean([one.gross for one in every]):.3f}",
        *(f"{np.mean(values):.4f}" if values else "" for values in means),
    ]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, allow_abbrev=False)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--pairs", action="store_true", help="print each pair too, the furthest off first")
    options, also = parser.parse_known_args()
    if not splits(options.folder):
        parser.error(f"no index.json in {options.folder} or the folders in it")
    rows = []
    for split, name, every in measured(options.folder, also):
        rows.append([split, name, *row(every)])
        if options.pairs:
            for one in sorted(every, key=lambda one: -one.corr):
                told = (value for value in one if value is not None)
                print(*(f"{value:.4f}" if isinstance(value, float) else value for value in told))
    print(Table(HEADER, rows).markdown(), end="")


if __name__ == "__main__":
    main()
