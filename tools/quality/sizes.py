"""Measure: bytes of an SVG file that moves by itself."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

import numpy as np

from tools.quality.data import SETS, VIEWBOX, icon_pairs
from tools.quality.peers import flubber, shapeblend
from tools.quality.tables import NONE, Section, Table

if TYPE_CHECKING:
    from collections.abc import Sequence

    from tools.quality.crossings import Scores
    from tools.quality.data import Pair

FRAMES = 30
DECIMALS = 3
"""As many as shapeblend writes for drawings 100 wide."""

OURS = (shapeblend.NAME, "moving.svg")
AS_FRAMES = f"{FRAMES} frames, {DECIMALS} decimals"
AS_ENDS = f"first and last frame, {DECIMALS} decimals"

TEXT = f"""\
Median bytes of one animated SVG, over the pairs above in which no tool of this table leaves contours out. Nothing
is compressed. shapeblend: `-o moving.svg`. flubber morphs in the page, by script, and writes no files; here its
frames are put into the `values` of one `<animate>`, at its default number of digits and rounded to as many as
shapeblend writes. {FRAMES} frames are what one takes without knowing how it moves; as its vertices travel on straight
lines, the first and the last give the same motion."""


def section(scores: Scores) -> Section:
    with_flubber = any(tool == flubber.NAME for _, tool in scores)
    files = {name: _files(_drawn_whole(name, scores), with_flubber) for name in SETS}
    header = ["tool", "file", *(f"{SETS[name]}, {len(files[name][OURS])} pairs" for name in SETS)]
    rows = [[*way, *(_median(files[name][way]) for name in SETS)] for way in files["single"]]
    medians = {way: _median(written) for way, written in files["single"].items()}
    cells = {shapeblend.NAME: medians[OURS]}
    if with_flubber:
        for tool in (flubber.NAME, flubber.COARSE):
            cells[tool] = f"{medians[tool, AS_FRAMES]} as {FRAMES} frames, {medians[tool, AS_ENDS]} as two"
    what = f"animated SVG, {SETS['single']}: bytes, median"
    return Section("Size of animated SVG", TEXT, Table(header, rows), [(what, cells)])


def _drawn_whole(name: str, scores: Scores) -> list[Pair]:
    """The pairs of a set that can be compared."""
    both = [scores[name, tool] for tool in (shapeblend.NAME, flubber.NAME) if (name, tool) in scores]
    return [
        pair
        for pair, *found in zip(icon_pairs(name), *both, strict=True)
        if all(one and not one.left_out for one in found)
    ]


def _files(pairs: list[Pair], with_flubber: bool) -> dict[tuple[str, str], list[str | None]]:
    """For each tool and kind of file, a file a pair."""
    files = {OURS: [shapeblend.animation(pair) for pair in pairs]}
    times = [k / (FRAMES - 1) for k in range(FRAMES)]
    for tool, own_sides in ((flubber.NAME, False), (flubber.COARSE, True)) if with_flubber else ():
        blends = flubber.path_data(pairs, times, own_sides)
        files[tool, f"{FRAMES} frames"] = [frames and animated(frames) for frames in blends]
        short = [frames and [rounded(frame) for frame in frames] for frames in blends]
        files[tool, AS_FRAMES] = [frames and animated(frames) for frames in short]
        files[tool, AS_ENDS] = [frames and animated([frames[0], frames[-1]]) for frames in short]
    return files


def animated(frames: Sequence[str]) -> str:
    """A file that plays path data frame by frame."""
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{VIEWBOX}"><path>'
        f'<animate attributeName="d" values="{";".join(frames)}" dur="2s" repeatCount="indefinite"/></path></svg>\n'
    )


def rounded(data: str) -> str:
    """Path data with fewer decimals."""
    return re.sub(r"-?\d+(\.\d+)?(e-?\d+)?", lambda number: _shortest(float(number[0])), data)


def _shortest(value: float) -> str:
    text = f"{value:.{DECIMALS}f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def _median(files: Sequence[str | None]) -> str:
    sizes = [len(file.encode()) for file in files if file is not None]
    return f"{np.median(sizes):.0f}" if sizes else NONE
