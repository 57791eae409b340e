"""Measure: segments of an in-between, and bytes of an SVG file that moves by itself."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

import numpy as np

from tools.quality.data import SETS, VIEWBOX, icon_pairs
from tools.quality.peers import arc_length, flubber, shapeblend
from tools.quality.tables import NONE, Section, Table

if TYPE_CHECKING:
    from collections.abc import Sequence

    from tools.quality.data import Pair

FRAMES = 30
DECIMALS = 3
"""As many as shapeblend writes for drawings 100 wide."""

OWN = "moving.svg"
AS_LONG = f"{FRAMES} frames"
AS_FRAMES = f"{FRAMES} frames, {DECIMALS} decimals"
AS_ENDS = f"first and last frame, {DECIMALS} decimals"

FLUBBER = ((flubber.NAME, False), (flubber.COARSE, True))
"""What it is called, and whether it is left the length of sides."""

TEXT = f"""\
Medians over the pairs above in which no tool of this table leaves contours out.

*Segments*: how many lines and curves the in-between half way is written with, the lines that close contours
included. That of shapeblend has curves, the others are polygons.

*Bytes* of one animated SVG. Nothing is compressed. shapeblend: `-o moving.svg`. flubber morphs in the page, by
script, and writes no files; here its frames are put into the `values` of one `<animate>`, at its default number of
digits and rounded to as many as shapeblend writes. {FRAMES} frames are what one takes without knowing how it moves; as
its vertices travel on straight lines, the first and the last give the same motion."""


def measured(icons: dict, with_flubber: bool) -> dict:
    """Sizes for the pairs that can be compared, by what `crossings.measured` found."""
    found = {}
    for name in SETS:
        pairs = _drawn_whole(icon_pairs(name), icons[name]["scores"])
        found[name] = {
            "pairs": [pair.id for pair in pairs],
            "segments": segments(pairs, with_flubber),
            "bytes": {
                tool: {kind: [text and len(text.encode()) for text in texts] for kind, texts in files.items()}
                for tool, files in animations(pairs, with_flubber).items()
            },
        }
    return found


def _drawn_whole(pairs: list[Pair], scores: dict) -> list[Pair]:
    both = [scores[tool]["left_out"] for tool in (shapeblend.NAME, flubber.NAME) if tool in scores]
    return [
        pair
        for pair, *left_out in zip(pairs, *both, strict=True)
        if not any(left_out) and None not in left_out
    ]


def segments(pairs: list[Pair], with_flubber: bool) -> dict[str, list[int | None]]:
    """For each tool how many segments it draws half way, a number a pair."""
    counts = {shapeblend.NAME: [text and shapeblend.segments(text) for text in map(shapeblend.middle, pairs)]}
    for tool, own_sides in FLUBBER if with_flubber else ():
        blends = flubber.points(pairs, [0.5], own_sides)
        counts[tool] = [frames and sum(map(len, frames[0])) for frames in blends]
    counts[arc_length.NAME] = [
        sum(map(len, arc_length.frames(*map(arc_length.contours, (a, b)))[0])) for _, a, b in pairs
    ]
    return counts


def animations(pairs: list[Pair], with_flubber: bool) -> dict[str, dict[str, list[str | None]]]:
    """For each tool and kind of file, a file a pair."""
    files: dict[str, dict[str, list[str | None]]] = {
        shapeblend.NAME: {OWN: [shapeblend.animation(pair) for pair in pairs]}
    }
    times = [k / (FRAMES - 1) for k in range(FRAMES)]
    for tool, own_sides in FLUBBER if with_flubber else ():
        blends = flubber.path_data(pairs, times, own_sides)
        short = [frames and [rounded(frame) for frame in frames] for frames in blends]
        files[tool] = {
            AS_LONG: [frames and animated(frames) for frames in blends],
            AS_FRAMES: [frames and animated(frames) for frames in short],
            AS_ENDS: [frames and animated([frames[0], frames[-1]]) for frames in short],
        }
    return files


def section(found: dict) -> Section:
    files = {tool: list(kinds) for tool, kinds in found["single"]["bytes"].items()}
    header = ["tool", "what", *(f"{SETS[name]}, {len(found[name]['pairs'])} pairs" for name in SETS)]
    rows = [
        [tool, "segments", *(_median(found[name]["segments"][tool]) for name in SETS)]
        for tool in found["single"]["segments"]
    ]
    rows += [
        [tool, f"bytes: {kind}", *(_median(found[name]["bytes"][tool][kind]) for name in SETS)]
        for tool, kinds in files.items()
        for kind in kinds
    ]
    medians = {
        tool: {kind: _median(sizes) for kind, sizes in kinds.items()}
        for tool, kinds in found["single"]["bytes"].items()
    }
    cells = {
        tool: kinds[OWN]
        if OWN in kinds
        else f"{kinds[AS_FRAMES]} as {FRAMES} frames, {kinds[AS_ENDS]} as two"
        for tool, kinds in medians.items()
    }
    of = f"icons of {SETS['single']}"
    drawn = {tool: _median(counts) for tool, counts in found["single"]["segments"].items()}
    brief = [
        (f"segments of an in-between, {of}, median", drawn),
        (f"animated SVG, {of}: bytes, median", cells),
    ]
    return Section("Segments and bytes", TEXT, Table(header, rows), brief)


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


def _median(numbers: Sequence[int | None]) -> str:
    known = [number for number in numbers if number is not None]
    return f"{np.median(known):.0f}" if known else NONE
