"""What can be measured of an in-between."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from shapeblend_cli.geometry import cubics
from shapeblend_cli.geometry.crossings import path_crossings
from shapeblend_cli.interpolate.paths import paths_at

if TYPE_CHECKING:
    from shapeblend_cli.model import Pair


class Measures(NamedTuple):
    """What is measured of an in-between at time t, within [0, 1]."""

    t: float
    pair: int  # the number of its first drawing
    self_crossings: (
        int  # how often outlines painted together cross themselves and each other, on their curves
    )
    area: float  # inside the outlines, in square units of A


def measure(pair: Pair, t: float) -> Measures:
    """Measure the in-between at time t; also at both ends as it moves, not as the drawing has it."""
    shapes = [paths_at(shape, t) for shape in pair.shapes]
    return Measures(
        t,
        pair.a,
        self_crossings=sum(path_crossings(paths) for paths in shapes),
        area=sum(abs(sum(cubics.signed_area(path.segments) for path in paths)) for paths in shapes),
    )
