"""Measure: how near a blend of two letters is to what their designer drew in between."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from tools.quality import raw
from tools.quality.data import cut_in_two
from tools.quality.tables import NONE, Section, Table, share
from tools.quality.truth.form import SETS, load
from tools.quality.truth.letters import DIFFERENT, EVEN, FAMILIES, FOLDER
from tools.quality.truth.measures import GROSS, NEAR, REACH, SHARP, STILL_SHARP, Nearness, nearness

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from tools.quality.peers import Tool
    from tools.quality.truth.form import Truth

HEADER = (
    "letters",
    "tool",
    "pairs",
    "in-between, median",
    "mean",
    "correspondence, median",
    "mean",
    f"above {100 * GROSS:g} %",
    "crossed",
    "corners kept",
    "segments, median",
)

ALONG = "... how far along the outline its points are off, median"
IF_CUT = "letters of one contour, some lines and curves cut in two: what an in-between misses, median"
GROSSLY = f"... pairs whose points are off by more than {100 * GROSS:g} %, or on wrong contours"

CUT = "cut"
"""The set of letters of one contour of which the second file has lines and curves that are cut in two."""

KINDS = {**SETS, CUT: "one contour, cut"}
"""The sets that are measured, and what a letter has in each."""

SHARE_CUT = 1 / 3

TEXT = f"""\
Letters of variable fonts. In such a font a letter has the same points wherever its axes stand, so the designer has
said what becomes what, and how the letter looks in between. Each pair is a letter at two places of one axis. The
families, all under the SIL Open Font License and installed by npm from a lock file, are
{", ".join(FAMILIES)}.
Letters are taken by a fixed seed, of those that both fill rules fill the same, whose ends differ (more than
{100 * DIFFERENT:g} % of what either covers is not covered by both) and that change evenly: moved straight, the
designer's own points stay within {100 * EVEN:g} % of the truth by the same measure. How fast a font changes is nothing
that two drawings show. The second file begins at another point, goes the other way round in about half of the pairs,
has its contours in another order, and is scaled and shifted. The em is 100 units.

- *in-between*: how much of what the in-between or the true one covers is not covered by both, mean of t = .25, .5
  and .75. The scale and the shift of the second file are taken out: what goes straight from p to s q + d is, at
  time t, a blend of p and q at time t s / (1 - t + t s), scaled and shifted.
- *correspondence*: how far along the second outline a point of the first arrives from where the designer has it, as
  a share of that outline's length, mean over the first. A contour that becomes a wrong one counts as 50 %. *above
  {100 * GROSS:g} %*: share of the pairs.
- *crossed*: pairs in which a contour of an in-between crosses or touches itself.
- *corners kept*: corners of the true outline half way that the in-between has within {100 * NEAR:g} % of its size, mean
  over the pairs that have some. A true corner turns by more than {SHARP:g} degrees at both ends, and by
  {STILL_SHARP:g} half way; the corner of an in-between by {STILL_SHARP:g}. A turn is measured from {100 * REACH:g} %
  of the size before the corner to as much behind it. The size is the diagonal of the box around the true outline.
- *segments*: how many lines and curves the in-between half way is written with.

*one contour, cut*: the letters of one contour again, but a third of the second file's lines and curves, chosen at
random, are cut in two. That changes nothing that is seen. Without it the files of a font give something away: a letter
has the same number of lines and curves at both ends. A tool that blends them one by one, as KUTE.js' curves do, finds
what the designer meant as soon as it begins at the right one. One line or curve more, and it does not. shapeblend
blends them one by one too, where it finds them, and does without nodes that lie within a line or a curve.

A pair without an answer counts as 100 %, as 50 %, as crossed, and as without corners. shapeblend is told
`--place asis` and the number of frames. `make bench-truth TRUTH=DIR` measures the same on other pairs."""


def measured(tools: Sequence[Tool]) -> dict:
    """Every pair of every set with every tool that says what goes where."""
    found = {}
    for name in KINDS:
        truths = pairs_of(FOLDER, name)
        scores = {tool.name: raw.columns(Nearness, scored(tool, truths)) for tool in tools if tool.linked}
        found[name] = {"pairs": [truth.id for truth in truths], "scores": scores}
    return found


def pairs_of(folder: Path, name: str) -> list[Truth]:
    """Return the pairs of one of the `KINDS`."""
    if name != CUT:
        return list(load(folder, name))
    return [_cut(truth, np.random.default_rng(k)) for k, truth in enumerate(load(folder, "single"))]


def _cut(truth: Truth, rng: np.random.Generator) -> Truth:
    """Return a pair with lines and curves of its second file cut in two."""
    data = cut_in_two(truth.pair.b, SHARE_CUT, rng)
    return truth._replace(b=truth.b.replace(truth.pair.b, data))


def scored(tool: Tool, truths: list[Truth]) -> list[Nearness]:
    """What is said of the pairs."""
    return [nearness(truth, found) for truth, found in zip(truths, tool.linked(truths), strict=True)]


def section(found: dict) -> Section:
    rows, brief = [], {}
    for name, what in KINDS.items():
        for tool, scores in found[name]["scores"].items():
            told = cells(raw.records(Nearness, scores))
            rows.append([what, tool, *told])
            count, between, _, along, _, gross, _, corners, _ = told
            lines = (
                (f"{count} letters of {what}: what an in-between misses of the designer's, median", between),
                (ALONG, along),
                (GROSSLY, gross),
                ("... corners kept", corners),
            )
            for line, cell in lines if name != CUT else ((IF_CUT, between),):
                brief.setdefault((name, line), {})[tool] = cell
    del brief["multi", ALONG]
    return Section(
        "Letters", TEXT, Table(HEADER, rows), [(told, cells) for (_, told), cells in brief.items()]
    )


def cells(scores: list[Nearness]) -> list[str]:
    """What the table says of one tool."""
    columns = Nearness(*zip(*scores, strict=True))
    corners = [kept for kept in columns.corners if kept is not None]
    return [
        str(len(scores)),
        *(
            percent(take(column))
            for column in (columns.strict, columns.corr)
            for take in (np.median, np.mean)
        ),
        share(off > GROSS for off in columns.corr),
        share(columns.crossed),
        percent(np.mean(corners)) if corners else NONE,
        f"{np.median(columns.segments):.0f}",
    ]


def percent(part: float) -> str:
    """To two decimals, or three digits."""
    return f"{100 * part:.2f} %" if part < 0.1 else f"{100 * part:.3g} %"
