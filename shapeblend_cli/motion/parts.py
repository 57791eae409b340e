"""The parts of a shape that can move on their own: contours that neither touch nor lie in each other.

An arrow above a tray is often one path in its file. The arrow turns as if it were a path of its own.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.geometry.grouping import Groups, overlaps
from shapeblend_cli.geometry.polygons import winding_numbers
from shapeblend_cli.geometry.polyline import cumulative_lengths, thin
from shapeblend_cli.motion.alignment import align, point_pairs

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import Box, ContourBlend, Polygon
    from shapeblend_cli.motion.alignment import Alignment

MOST_POINTS = 128
"""Maximum number of an outline's vertices that are compared."""

BESIDE = 0.01
"""Minimum distance from the middle of a part beside, above or below it, as a share of the part's reach."""


def parts_of(contours: Sequence[ContourBlend]) -> list[list[int]]:
    """Return the numbers of the contours of each part."""
    ends = [(_Outline.of(contour.polygon_a), _Outline.of(contour.polygon_b)) for contour in contours]
    # Boxes rule out most pairs at once; with their margins they rule out none that touches.
    starts, stops = zip(*([one.room for one in both] for both in ends), strict=True)
    groups = Groups(len(ends))
    for k, row in enumerate(overlaps(starts) & overlaps(stops)):
        near: set[int] = set()
        for other in np.flatnonzero(row[:k]).tolist():
            if (name := int(groups.of[other])) not in near and all(map(_touch, ends[k], ends[other])):
                near.add(name)
        groups.add(k, near)
    return list(groups)


class _Outline(NamedTuple):
    polygon: Polygon
    spacing: float

    @classmethod
    def of(cls, polygon: Polygon) -> _Outline:
        return cls(polygon, float(cumulative_lengths(polygon.line)[-1]) / len(polygon.vertices))

    @property
    def room(self) -> Box:
        """The box, with a margin of the mean length of an edge."""
        return self.polygon.box.expanded(self.spacing)


def turn_of(part: Sequence[ContourBlend], middle: complex) -> Alignment:
    """Return the similarity of a part of a drawing with a middle.

    Parts to the left and to the right that make half a turn go in opposite directions, and so do parts above and below,
    so that a symmetry is kept.
    """
    points = point_pairs(part)
    alignment = align(points)
    away = alignment.centre_a - middle
    least = BESIDE * float(np.abs(points.a - points.a.mean()).max())
    is_second = away.real > least or (away.imag > least and away.real >= -least)
    return alignment.other_way_round() if alignment.is_half_turn and is_second else alignment


def _touch(one: _Outline, other: _Outline) -> bool:
    p, q = one.polygon, other.polygon
    reach = 0.5 * max(one.spacing, other.spacing)
    if not p.box.expanded(reach).overlaps(q.box.expanded(reach)):
        return False
    if _is_in(p, q) or _is_in(q, p):
        return True
    z, w = (thin(polygon.vertices, MOST_POINTS) for polygon in (p, q))
    return bool(np.abs(z[:, None] - w).min() <= reach)


def _is_in(p: Polygon, q: Polygon) -> bool:
    return q.closed and bool(winding_numbers(p.vertices[:1], q.vertices)[0])
