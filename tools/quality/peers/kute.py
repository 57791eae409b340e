"""KUTE.js, an animation library for web pages with two components that morph paths.

`svgMorph` makes polygons of them, `svgCubicMorph` curves. Both take the first contour of a path and leave out the
others, and the documentation advises to split such paths. So each contour is a path here, with a tween of its own, and
contours meet in order of size; those that have no partner are left out. `svgMorph` turns contours the same way round
unless they are of lines alone, so all are turned before.
"""

from __future__ import annotations

from typing import Any

from tools.quality.data import Pair, one_way_round, open_data
from tools.quality.peers.node import Library, largest, longest_side, version

NAME = f"KUTE.js {version('kute.js')}"

CURVES = f"{NAME}, curves"
"""What it is called with the component for curves, which has no options."""


def job(pair: Pair) -> dict[str, Any]:
    """Return what the script is told of a pair."""
    a, b = (list(map(one_way_round, contours)) for contours in largest(pair))
    return {"a": a, "b": b, "side": longest_side(pair), "curves": False}


def job_of_curves(pair: Pair) -> dict[str, Any]:
    """Return what the script is told of a pair; the component takes Z for a side without length."""
    a, b = ([open_data(contour) for contour in side] for side in largest(pair))
    return {"a": a, "b": b, "side": None, "curves": True}


FINE = Library(NAME, "kute", job)
OF_CURVES = Library(CURVES, "kute", job_of_curves)
