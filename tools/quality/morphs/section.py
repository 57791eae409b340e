"""Measure: how near a blend of limbs and of authored morphs is to the truth."""

from __future__ import annotations

from typing import TYPE_CHECKING

from tools.quality import raw
from tools.quality.letters import HEADER, cells, scored
from tools.quality.morphs.articulated import POSES
from tools.quality.morphs.authored import ANIMATIONS, CHANGED
from tools.quality.morphs.make import FOLDER
from tools.quality.tables import Section, Table
from tools.quality.truth.form import load
from tools.quality.truth.measures import Nearness

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from tools.quality.peers import Tool

SETS = {
    "limbs turned": ("articulated", "single"),
    "authored, one contour": ("authored", "single"),
    "authored, several contours": ("authored", "multi"),
}
"""The split and the set of what is measured."""

BRIEF = {
    "limbs turned": "silhouettes with limbs turned",
    "authored, one contour": "morphs that motion designers authored",
}
"""What the short table says of."""

TEXT = f"""\
Drawings whose parts move, by the measures of the letters. Their in-betweens are known:

- *limbs turned*: {len(POSES)} silhouettes of icons whose limbs turn about joints that were set by hand, and a few
  grow. The angle is shared out smoothly about a joint, so limbs keep their width, and go on arcs. Straight ways cannot
  reach that: *in-between* is not 0 where the correspondence is the true one. Some curves of B are cut in two.
- *authored*: paths of {" and ".join(ANIMATIONS)}, animations that lottie-web is tested with, from one keyframe to the
  next. Of each layer and group it is the step that changes most; those are left out that an affine map explains but
  for {100 * CHANGED:g} % of the region. The format moves nodes and handles straight, so both ends have as many lines
  and curves. As with letters, that helps tools that blend them one by one, shapeblend among them.

B is disguised as with the letters. The icons are from Fluent Emoji (MIT licence) and game-icons.net (CC BY 3.0), the
animations from lottie-web (MIT licence); npm installs them from a lock file.
`make bench-morphs MORPHS=DIR` measures shapeblend on other pairs, with open lines among them."""


def measured(tools: Sequence[Tool], folder: Path = FOLDER) -> dict:
    """Every pair of every set with every tool that says what goes where."""
    found = {}
    for what, (split, name) in SETS.items():
        truths = list(load(folder / split, name))
        scores = {tool.name: raw.columns(Nearness, scored(tool, truths)) for tool in tools if tool.linked}
        found[what] = {"pairs": [truth.id for truth in truths], "scores": scores}
    return found


def section(found: dict) -> Section:
    rows: list[list[str]] = []
    brief: dict[str, dict[str, str]] = {}
    for what in SETS:
        for tool, scores in found[what]["scores"].items():
            told = cells(raw.records(Nearness, scores))
            rows.append([what, tool, *told])
            if what in BRIEF:
                name = f"{told[0]} {BRIEF[what]}: how far along the outline points are off, mean"
                brief.setdefault(name, {})[tool] = told[4]
    return Section("Limbs and morphs", TEXT, Table(("pairs of", *HEADER[1:]), rows), list(brief.items()))
