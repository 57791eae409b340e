"""Measure: how near a blend is to the truth, of letters and of morphs whose in-betweens are known."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from tools.quality import raw
from tools.quality.data import cut_in_two
from tools.quality.morphs import make
from tools.quality.morphs.articulated import POSES
from tools.quality.morphs.authored import ANIMATIONS, CHANGED
from tools.quality.tables import NONE, Brief, Section, Table, share
from tools.quality.truth import letters
from tools.quality.truth.form import load
from tools.quality.truth.measures import GROSS, NEAR, REACH, SHARP, STILL_SHARP, Nearness, nearness

if TYPE_CHECKING:
    from collections.abc import Sequence

    from tools.quality.peers import Tool
    from tools.quality.truth.form import Truth

ONE, SEVERAL, CUT = "letters of one contour", "letters of several contours", "letters of one contour, cut"
LIMBS, AUTHORED = "limbs turned", "authored, one contour"

KINDS = {
    ONE: (letters.FOLDER, "single"),
    SEVERAL: (letters.FOLDER, "multi"),
    CUT: (letters.FOLDER, "single"),
    LIMBS: (make.FOLDER / "articulated", "single"),
    AUTHORED: (make.FOLDER / "authored", "single"),
    "authored, several contours": (make.FOLDER / "authored", "multi"),
}
"""What is measured: the folder and the set of its pairs."""

COLUMNS = (
    "pairs",
    "in-between, median",
    "in-between, mean",
    "correspondence, median",
    "correspondence, mean",
    f"above {100 * GROSS:g} %",
    "crossed",
    "corners kept",
    "segments, median",
)

SHORT = (
    (
        ONE,
        "{} letters of one contour: what an in-between misses of the designer's, median",
        "in-between, median",
        "Letters half way: area that differs from what the designer drew",
    ),
    (
        CUT,
        "... some lines and curves cut in two",
        "in-between, median",
        "... if one letter has extra points on its outline",
    ),
    (ONE, "... how far along the outline its points are off, median", "correspondence, median", ""),
    (ONE, "... corners kept", "corners kept", "Letters half way: corners kept"),
    (ONE, "... lines and curves, median", "segments, median", "Lines and curves in a letter half way"),
    (SEVERAL, "{} letters of several contours: what an in-between misses, median", "in-between, median", ""),
    (
        SEVERAL,
        f"... pairs whose points are off by more than {100 * GROSS:g} %, or on wrong contours",
        f"above {100 * GROSS:g} %",
        "",
    ),
    (SEVERAL, "... corners kept", "corners kept", ""),
    (
        LIMBS,
        "{} silhouettes with limbs turned: how far along the outline points are off, mean",
        "correspondence, mean",
        "Limbs that swing: how far points are off along the outline",
    ),
    (
        AUTHORED,
        "{} morphs that motion designers authored: how far along the outline points are off, mean",
        "correspondence, mean",
        "",
    ),
)
"""Rows of the short table: of which kind, the name with the number of pairs, the column, and the README's name."""

SHARE_CUT = 1 / 3

TEXT = f"""\
Drawings whose in-betweens are known.

**Letters** of variable fonts. In such a font a letter has the same points wherever its axes stand, so the designer has
said what becomes what, and how the letter looks in between. Each pair is a letter at two places of one axis. The
families, all under the SIL Open Font License and installed by npm from a lock file, are
{", ".join(letters.FAMILIES)}.
Letters are taken by a fixed seed, of those that both fill rules fill the same, whose ends differ (more than
{100 * letters.DIFFERENT:g} % of what either covers is not covered by both) and that change evenly: moved straight, the
designer's own points stay within {100 * letters.EVEN:g} % of the truth by the same measure. How fast a font changes is
nothing that two drawings show. The second file begins at another point, goes the other way round in about half of the
pairs, has its contours in another order, and is scaled and shifted. The em is 100 units.

*Cut*: the letters of one contour again, but a third of the second file's lines and curves, chosen at random, are cut in
two. That changes nothing that is seen. Without it the files of a font give something away: a letter has the same number
of lines and curves at both ends. A tool that blends them one by one, as KUTE.js' curves do, finds what the designer
meant as soon as it begins at the right one. One line or curve more, and it does not. shapeblend blends them one by one
too, where it finds them, and does without nodes that lie within a line or a curve.

**Limbs turned**: {len(POSES)} silhouettes of icons whose limbs turn about joints that were set by hand, and a few grow.
The angle is shared out smoothly about a joint, so limbs keep their width, and go on arcs. Straight ways cannot reach
that: *in-between* is not 0 where the correspondence is the true one. Some curves of B are cut in two.

**Authored**: paths of {" and ".join(ANIMATIONS)}, animations that lottie-web is tested with, from one keyframe to the
next. Of each layer and group it is the step that changes most; those are left out that an affine map explains but for
{100 * CHANGED:g} % of the region. The format moves nodes and handles straight, so both ends have as many lines and
curves. As with letters, that helps tools that blend them one by one, shapeblend among them.

The icons are from Fluent Emoji (MIT licence) and game-icons.net (CC BY 3.0), the animations from lottie-web (MIT
licence); npm installs them from a lock file.

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

A pair without an answer counts as 100 %, as 50 %, as crossed, and as without corners. shapeblend is told
`--place asis` and the number of frames. `make bench-truth TRUTH=DIR` and `make bench-morphs MORPHS=DIR` measure other
pairs."""


def measured(tools: Sequence[Tool]) -> dict:
    """Every pair of every kind with every tool."""
    letters.make(letters.FOLDER)
    make.make(make.FOLDER)
    found = {}
    for kind in KINDS:
        truths = pairs_of(kind)
        scores = {tool.name: raw.columns(Nearness, scored(tool, truths)) for tool in tools}
        found[kind] = {"pairs": [truth.id for truth in truths], "scores": scores}
    return found


def pairs_of(kind: str) -> list[Truth]:
    """Return the pairs of one of the `KINDS`."""
    truths = list(load(*KINDS[kind]))
    if kind != CUT:
        return truths
    return [_cut(truth, np.random.default_rng(k)) for k, truth in enumerate(truths)]


def _cut(truth: Truth, rng: np.random.Generator) -> Truth:
    """Return a pair with lines and curves of its second file cut in two."""
    data = cut_in_two(truth.pair.b, SHARE_CUT, rng)
    return truth._replace(b=truth.b.replace(truth.pair.b, data))


def scored(tool: Tool, truths: list[Truth]) -> list[Nearness]:
    """What is said of the pairs."""
    return [nearness(truth, found) for truth, found in zip(truths, tool.linked(truths), strict=True)]


def section(found: dict) -> Section:
    told = {
        kind: {tool: cells(raw.records(Nearness, scores)) for tool, scores in found[kind]["scores"].items()}
        for kind in KINDS
    }
    rows = [[kind, tool, *told[kind][tool].values()] for kind in KINDS for tool in told[kind]]
    brief = [
        Brief(
            name.format(len(found[kind]["pairs"])),
            {tool: each[column] for tool, each in told[kind].items()},
            front,
        )
        for kind, name, column, front in SHORT
    ]
    return Section(
        "Letters, limbs and authored morphs", TEXT, Table(("pairs of", "tool", *COLUMNS), rows), brief
    )


def cells(scores: list[Nearness]) -> dict[str, str]:
    """What the table says of one tool, by column."""
    columns = Nearness(*zip(*scores, strict=True))
    corners = [kept for kept in columns.corners if kept is not None]
    told = [
        str(len(scores)),
        *(
            percent(take(column))
            for column in (columns.strict, columns.corr)
            for take in (np.median, np.mean)
        ),
        share(one.gross for one in scores),
        share(columns.crossed),
        percent(np.mean(corners)) if corners else NONE,
        f"{np.median(columns.segments):.0f}",
    ]
    return dict(zip(COLUMNS, told, strict=True))


def percent(part: float) -> str:
    """To two decimals, or three digits."""
    return f"{100 * part:.2f} %" if part < 0.1 else f"{100 * part:.3g} %"
