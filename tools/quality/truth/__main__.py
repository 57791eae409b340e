"""Measure by pairs whose truth lies in a folder: python -m tools.quality.truth DIR [--peers] [--pairs] [OPTION ...].

The folder has one split, with its `index.json`, or several of them below it. `letters` and `morphs` stand for
out/truth and out/morphs, which are made first. Other tools are measured with --peers, and each pair is printed with
--pairs; further options go to the command.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np

from tools.quality.morphs import make as morphs
from tools.quality.npm import install
from tools.quality.peers import ALL, ready, shapeblend
from tools.quality.tables import NONE, Table
from tools.quality.truth import letters
from tools.quality.truth.form import SETS, load
from tools.quality.truth.measures import Nearness, nearness

HEADER = ("split", "set", "tool", "pairs", "corr, median", "mean", "max", "gross", "strict, median", "mean")
HEADER += ("dist, mean", "crossed", "corners", "segments")

MADE = {"letters": letters, "morphs": morphs}


def row(found: list[Nearness]) -> list[str]:
    """What is said of a tool: medians, means and counts."""
    columns = Nearness(*zip(*found, strict=True))
    strict, dist, corners = (
        [value for value in column if value is not None]
        for column in (columns.strict, columns.dist, columns.corners)
    )
    return [
        str(len(found)),
        *(f"{take(columns.corr):.4f}" for take in (np.median, np.mean, np.max)),
        str(sum(one.gross for one in found)),
        *(f"{take(strict):.4f}" if strict else NONE for take in (np.median, np.mean)),
        f"{np.mean(dist):.4f}" if dist else NONE,
        str(sum(columns.crossed)),
        f"{np.mean(corners):.3f}" if corners else NONE,
        f"{np.median(columns.segments):.0f}",
    ]


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter, allow_abbrev=False
    )
    parser.add_argument("folder")
    parser.add_argument("--peers", action="store_true")
    parser.add_argument("--pairs", action="store_true")
    options, also = parser.parse_known_args()
    folder = Path(options.folder)
    if problem := ready() if options.peers else options.folder in MADE and install():
        parser.error(f"npm is needed: {problem}")
    if made := MADE.get(options.folder):
        folder = made.FOLDER
        made.make(folder)
    files = [file for file in (folder / "index.json", *sorted(folder.glob("*/index.json"))) if file.exists()]
    if not files:
        parser.error(f"no index.json in {folder} or the folders in it")
    tools = [tool for tool in ALL if options.peers and tool.name != shapeblend.NAME]
    rows = []
    for split in [file.parent for file in files]:
        for name in SETS:
            truths = list(load(split, name))
            blends = {shapeblend.NAME: shapeblend.linked(truths, also)}
            blends |= {tool.name: tool.linked(truths) for tool in tools}
            for tool, linked in blends.items() if truths else ():
                found = [nearness(truth, one) for truth, one in zip(truths, linked, strict=True)]
                rows.append([split.name, name, tool, *row(found)])
                if options.pairs:
                    each = sorted(zip(truths, found, strict=True), key=lambda pair: -pair[1].corr)
                    for truth, one in each:
                        print(tool, truth.id, *(f"{value:.4f}" for value in one[:3] if value is not None))
    print(Table(HEADER, rows).markdown(), end="")


if __name__ == "__main__":
    main()
