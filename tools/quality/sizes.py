"""Measure: segments of an in-between, and bytes of an SVG file that moves by itself."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

import numpy as np

from tools.quality.data import DECIMALS, SETS, VIEWBOX, icon_pairs, pieces
from tools.quality.peers import LIBRARIES, arc_length, shapeblend
from tools.quality.tables import NONE, Section, Table

if TYPE_CHECKING:
    from collections.abc import Sequence

    from tools.quality.data import Pair
    from tools.quality.peers.node import Library

FRAMES = 30

OWN = "moving.svg"
AS_LONG = f"{FRAMES} frames"
AS_FRAMES = f"{FRAMES} frames, {DECIMALS} decimals"
AS_ENDS = f"first and last frame, {DECIMALS} decimals"
KINDS = (OWN, AS_LONG, AS_FRAMES, AS_ENDS)

TEXT = f"""\
Medians over the pairs above in which no tool of this table leaves contours out.

*Segments*: how many lines and curves the in-between half way is written with, the lines that close contours
included. Those of shapeblend, KUTE.js' curves and polymorph have curves, the others are polygons.

*Bytes* of one animated SVG. Nothing is compressed. shapeblend: `-o moving.svg`. The libraries morph in the page, by
script, and write no files. Here their frames are put into the `values` of one `<animate>`, at their own number of
digits and rounded to as many as shapeblend writes. {FRAMES} frames are what one takes without knowing how it moves. As
vertices travel on straight lines, the first and the last frame give the same motion. polymorph is an exception: it
leaves points out that fall on others, so the number of its curves changes on the way, and a browser shows one frame
after the other without steps in between."""


def measured(icons: dict, libraries: Sequence[Library]) -> dict:
    """Sizes for the pairs that can be compared, by what `crossings.measured` found."""
    found = {}
    for name in SETS:
        pairs = _drawn_whole(icon_pairs(name), icons[name]["scores"])
        found[name] = {
            "pairs": [pair.id for pair in pairs],
            "segments": segments(pairs, libraries),
            "bytes": {
                tool: {kind: [text and len(text.encode()) for text in texts] for kind, texts in files.items()}
                for tool, files in animations(pairs, libraries).items()
            },
        }
    return found


def _drawn_whole(pairs: list[Pair], scores: dict) -> list[Pair]:
    names = (shapeblend.NAME, *(library.name for library in LIBRARIES))
    all_left_out = [scores[tool]["left_out"] for tool in names if tool in scores]
    return [
        pair
        for pair, *left_out in zip(pairs, *all_left_out, strict=True)
        if not any(left_out) and None not in left_out
    ]


def segments(pairs: list[Pair], libraries: Sequence[Library]) -> dict[str, list[int | None]]:
    """For each tool how many segments it draws half way, a number a pair."""
    counts = {shapeblend.NAME: [text and shapeblend.segments(text) for text in map(shapeblend.middle, pairs)]}
    for library in libraries:
        counts[library.name] = [frames and pieces(frames[0]) for frames in library.path_data(pairs, [0.5])]
    counts[arc_length.NAME] = [
        sum(map(len, arc_length.frames(*map(arc_length.contours, (a, b)))[0])) for _, a, b in pairs
    ]
    return counts


def animations(pairs: list[Pair], libraries: Sequence[Library]) -> dict[str, dict[str, list[str | None]]]:
    """For each tool and kind of file, a file a pair."""
    files: dict[str, dict[str, list[str | None]]] = {
        shapeblend.NAME: {OWN: [shapeblend.animation(pair) for pair in pairs]}
    }
    times = [k / (FRAMES - 1) for k in range(FRAMES)]
    for library in libraries:
        blends = library.path_data(pairs, times)
        short = [frames and [rounded(frame) for frame in frames] for frames in blends]
        files[library.name] = {
            AS_LONG: [frames and animated(frames) for frames in blends],
            AS_FRAMES: [frames and animated(frames) for frames in short],
        }
        if library.keeps_vertices:
            files[library.name][AS_ENDS] = [frames and animated([frames[0], frames[-1]]) for frames in short]
    return files


def section(found: dict) -> Section:
    rows = []
    for name in SETS:
        one = found[name]
        for tool, counts in one["segments"].items():
            files = one["bytes"].get(tool, {})
            sizes = [_median(files.get(kind, ())) for kind in KINDS]
            rows.append([SETS[name], tool, str(len(one["pairs"])), _median(counts), *sizes])
    of = f"icons of {SETS['single']}"
    drawn = {tool: _median(counts) for tool, counts in found["single"]["segments"].items()}
    cells = {tool: _brief(kinds) for tool, kinds in found["single"]["bytes"].items()}
    brief = [
        (f"segments of an in-between, {of}, median", drawn),
        (f"animated SVG, {of}: bytes, median", cells),
    ]
    header = ["pairs of icons", "tool", "pairs", "segments", *(f"bytes: {kind}" for kind in KINDS)]
    return Section("Segments and bytes", TEXT, Table(header, rows), brief)


def _brief(kinds: dict[str, list[int | None]]) -> str:
    words = {OWN: "", AS_FRAMES: f" as {FRAMES} frames", AS_ENDS: " as two"}
    return ", ".join(f"{_median(kinds[kind])}{word}" for kind, word in words.items() if kind in kinds)


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
