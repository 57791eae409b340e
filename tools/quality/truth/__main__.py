"""Measure tools by letters whose truth lies in a folder: python -m tools.quality.truth DIR [--set single]."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

import numpy as np

from tools.quality.peers import ALL
from tools.quality.tables import Table
from tools.quality.truth.form import SETS, load
from tools.quality.truth.measures import GROSS, Nearness, nearness

HEADER = ("set", "tool", "pairs", "strict", "mean", "corr", "mean", "gross", "crossed", "corners", "segments")


def row(found: list[Nearness]) -> list[str]:
    """What is said of a tool: medians, means and counts."""
    columns = Nearness(*zip(*found, strict=True))
    corners = [share for share in columns.corners if share is not None]
    cells = [
        f"{take(column):.4f}" for column in (columns.strict, columns.corr) for take in (np.median, np.mean)
    ]
    return [
        str(len(found)),
        *cells,
        str(sum(off > GROSS for off in columns.corr)),
        str(sum(columns.crossed)),
        f"{np.mean(corners):.3f}" if corners else "",
        f"{np.median(columns.segments):.0f}",
    ]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--set", choices=SETS, action="append", help="this set alone")
    options = parser.parse_args()
    rows = []
    for name in options.set or SETS:
        truths = list(load(options.folder, name))
        for tool in ALL if truths else ():
            if tool.linked is None:
                continue
            if problem := tool.ready():
                print(f"left out: {tool.name} ({problem})", file=sys.stderr)
                continue
            found = [nearness(truth, one) for truth, one in zip(truths, tool.linked(truths), strict=True)]
            rows.append([name, tool.name, *row(found)])
    print(Table(HEADER, rows).markdown(), end="")


if __name__ == "__main__":
    main()
