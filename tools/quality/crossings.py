"""Measure: how often an in-between crosses itself, loses area, or lacks contours."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from tools.quality import raw
from tools.quality.data import DECIMALS, SETS, icon_pairs, subpaths
from tools.quality.peers import shapeblend
from tools.quality.scores import LITTLE, Score, score
from tools.quality.tables import NONE, Brief, Section, Table, share

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from tools.quality.data import Pair
    from tools.quality.peers import Tool

    Blends = Callable[[list[Pair]], list[list[list[np.ndarray]] | None]]

NEVER = f"{shapeblend.NAME} --swap never"

HEADER = (
    "pairs of icons",
    "tool",
    "pairs",
    "answered",
    "crossed",
    "contours cross",
    "area below 70 %",
    "least area, median",
    "contours left out",
)

SHORT = (
    ("{} pairs of icons of {}: an in-between crosses itself", 2),
    ("... contours cross each other", 3),
    ("... an in-between has less than 70 % of its area", 4),
    ("... contours are left out", 6),
)
"""Rows of the short table, with the columns of the long one that they have."""

FRONT = {
    ("single", 2): "Icons that cross themselves on the way",
    ("whole", 6): "Icons with several outlines that lose some",
}

TEXT = f"""\
Pairs of icons: `tests/bench/data/pairs.json`. Nine in-betweens a pair, t = .1, .2, ... .9.

- *answered*: pairs for which the tool gave frames. One without an answer counts as crossed, in both ways, and as
  below 70 %.
- *crossed*: pairs in which a contour of at least one in-between crosses or touches itself: shapely calls it
  invalid, after neighbours nearer than a millionth of a unit, in drawings 100 wide, are made one vertex.
  A contour shrunk to a point is not crossed.
- *contours cross*: pairs in which two contours of at least one in-between cross each other: each is partly inside
  the other and partly outside, by more than a hundredth of a unit. Touching is none, nor is lying inside.
- *area*: that of all contours of a frame added up, holes too, as a share of the straight line between the areas
  at t = 0 and t = 1 as the tool draws them; the least of the nine counts. *below 70 %*: share of the pairs.
- *contours left out*: pairs in which the tool draws fewer contours at t = 0 or t = 1 than the icon has. Its other
  figures are then of a simpler task.

The tools:

- shapeblend: its command, told the number of frames and nothing else, so that it chooses how shapes move: by
  looking for crossings itself, at these times among others. Measured are the frame files it writes, rounding included;
  a contour with curves in about 2000 pieces. Where it moves icons as pen lines, their strokes count as the outlines of
  all that they paint together. Drawings that would not blend well [take each other's
  place](motion.md#drawings-with-too-little-in-common): one shrinks and the other grows. So do most of the pairs of two
  to five contours. These cross nothing, and count as below 70 % of the area. With `--swap never` all are blended.
- flubber, KUTE.js and polymorph are libraries for web pages, run in node. All three have the MIT licence, and npm
  installs them from a lock file. Some help is given that users can easily give, too: contours are put in order of size,
  or turned the same way round.
  - flubber: `maxSegmentLength` is a 120th of the longest contour; the library's default, 10, is coarse in drawings 100
    wide. Several contours go by `interpolateAll`, which pairs them as they come and gets them in
    order of size, `separate` and `combine`. For several to several in unequal number it has no call: the largest are
    taken. It knows no holes and turns every contour the same way round.
  - KUTE.js: its component `svgMorph`, which is based on flubber. `morphPrecision` is a 120th of the longest contour. It
    only takes the first contour of a path, and its documentation advises to split
    paths. So each contour has a tween of its own here, they are paired in order of size, and those without a partner
    are left out. It does not turn contours of lines alone the same way round, so that is done before.
  - KUTE.js, curves: its component `svgCubicMorph`, which has no options. It is taken from the library's sources, as the
    published bundle lacks it. From the best start on, the first line or curve of one drawing becomes the first of the
    other, and so on. Where one drawing has fewer, long ones are cut in two. Contours are treated as before; the line
    that closes them is drawn, as the component does not see it in a Z.
  - polymorph: the package polymorph-js. `precision`, the number of decimals, is {DECIMALS}; its default is 0. It pairs
    contours in order of their lengths, and begins each near the upper left of its box. Where one has fewer curves it
    gets some without length, and what has no partner grows from a point. It would turn contours inside out that go
    opposite ways, so all are turned the same way round before. At t = 0 and 1 it returns its input, so it is asked for
    a millionth beside that.
- even arc length: 120 vertices a contour, from the start with the least squared distances. Contours are paired in
  order of size; what is left over grows from a point or shrinks to one."""


def measured(tools: Sequence[Tool]) -> dict:
    """Every pair of every set with every tool, and with shapeblend if it is to blend them all."""
    ways = {tool.name: tool.blends for tool in tools} | {NEVER: never_swapped}
    found = {}
    for name in SETS:
        pairs = icon_pairs(name)
        scores = {tool: raw.columns(Score, scored(blends, pairs)) for tool, blends in ways.items()}
        found[name] = {"pairs": [pair.id for pair in pairs], "scores": scores}
    return found


def never_swapped(pairs: list[Pair]) -> list[list[list[np.ndarray]] | None]:
    """The frames of shapeblend if it is to blend all pairs."""
    return shapeblend.blends(pairs, ("--swap", "never"))


def scored(blends: Blends, pairs: list[Pair]) -> list[Score | None]:
    """What is said of the pairs; None where a tool has no answer."""
    contours = [(len(subpaths(pair.a)), len(subpaths(pair.b))) for pair in pairs]
    return [frames and score(frames, counts) for frames, counts in zip(blends(pairs), contours, strict=True)]


def section(found: dict) -> Section:
    rows, brief = [], []
    for name, what in SETS.items():
        told = {tool: _cells(raw.records(Score, each)) for tool, each in found[name]["scores"].items()}
        rows += [[what, tool, *cells] for tool, cells in told.items()]
        for words, k in SHORT:
            cells = {tool: each[k] for tool, each in told.items()}
            line = words.format(len(found[name]["pairs"]), what)
            brief.append(Brief(line, cells, FRONT.get((name, k), "")))
    return Section("Crossings and area", TEXT, Table(HEADER, rows), brief)


def _cells(scores: list[Score | None]) -> list[str]:
    """What the table says of one tool."""
    answered = [one for one in scores if one]
    return [
        str(len(scores)),
        str(len(answered)),
        share(one is None or one.crossed for one in scores),
        share(one is None or one.overlapping for one in scores),
        share(one is None or one.area_share < LITTLE for one in scores),
        f"{100 * np.median([one.area_share for one in answered]):.1f} %" if answered else NONE,
        share(one.left_out for one in answered) if answered else NONE,
    ]
