"""Crowds of contours that are copies of each other: each kind of pair is matched once, and its match is moved.

Copies are of one outline, wherever they lie and however large they are. Places are rounded on the way, so that small
drawings, where each match is soon found, do without.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.geometry.similarity import Similarity
from shapeblend_cli.model import CubicPath
from shapeblend_cli.wires.stretches import mostly_shared

if TYPE_CHECKING:
    from collections.abc import Callable, Hashable

    from shapeblend_cli.anatomy.decompose import ContourPair, PlacedContour
    from shapeblend_cli.model import Box, ContourBlend

MATCHED_ONE_BY_ONE = 150
"""Maximum number of contours of a drawing that are all matched, whether they are copies or not."""

CROWD = 600
"""Maximum number of contours of a shape whose motion is chosen, and of a drawing with plates: more move straight."""

DECIMALS = 5
"""Number of decimals of coordinates in which copies agree, in sizes of the contour: what is written is rounded more."""

PLACES = 3
"""Number of decimals in which places agree, in sizes of the contour: less than the tolerance of what two share."""

STEPS = 4
"""Number of ratios of two sizes that are told apart, in a factor of two."""


class Copies:
    """The blends of a crowd that others are copies of."""

    def __init__(self) -> None:
        self._blends: dict[Hashable, tuple[ContourBlend, ContourBlend]] = {}

    def matched(self, pair: ContourPair, given: Hashable, match: Callable[[], ContourBlend]) -> ContourBlend:
        """Return the match of a pair: that of a copy moved to its place, if there is one."""
        a, b = pair
        place = None
        if mostly_shared([a.flat], [b.flat]) is not None:
            # Its match depends on how one lies on the other.
            place = np.round(np.subtract(b.box.bounds, a.box.bounds) / (a.size or 1.0), PLACES).tobytes()
        key = _outline(a), _outline(b), given, place
        return self._moved(key, (a.box, b.box), match)._replace(a=a.number, b=b.number)

    def curved(self, blend: ContourBlend, curve: Callable[[ContourBlend], ContourBlend]) -> ContourBlend:
        """Return a matched blend with its curves, likewise."""
        # The sizes matter only for how far curves may be from the polygons' lines.
        ratio = float(np.round(STEPS * np.log2((blend.scale_b + 1e-300) / (blend.scale_a + 1e-300))))
        # What is moved keeps its correspondence, and the blend in the table keeps that alive.
        key = id(blend.correspondence), ratio
        found = self._moved(key, (blend.polygon_a.box, blend.polygon_b.box), lambda: curve(blend), blend)
        return blend._replace(start=found.start, end=found.end, cuts=found.cuts)

    def _moved(
        self,
        key: Hashable,
        boxes: tuple[Box, Box],
        make: Callable[[], ContourBlend],
        owner: ContourBlend | None = None,
    ) -> ContourBlend:
        if key not in self._blends:
            made = make()
            self._blends[key] = made, owner or made
            return made
        blend = self._blends[key][0]
        to_a, to_b = (
            Similarity(own.larger_side / other.larger_side, complex(own.x, own.y), complex(other.x, other.y))
            for own, other in zip(boxes, (blend.polygon_a.box, blend.polygon_b.box), strict=True)
        )
        return blend._replace(
            contour_a=to_a.contour(blend.contour_a),
            contour_b=to_b.contour(blend.contour_b),
            polygon_a=to_a.polygon(blend.polygon_a),
            polygon_b=to_b.polygon(blend.polygon_b),
            scale_a=abs(to_a.factor) * blend.scale_a,
            scale_b=abs(to_b.factor) * blend.scale_b,
            start=_path(to_a, blend.start),
            end=_path(to_b, blend.end),
        )


def _path(to: Similarity, path: CubicPath) -> CubicPath:
    return CubicPath(to.points(path.segments), path.straight, path.closed)


def _outline(contour: PlacedContour) -> Hashable:
    """Return what copies of a contour have in common."""
    box, polygon = contour.box, contour.polygon
    corner, size = complex(box.x, box.y), box.larger_side or 1.0
    shapes = ((points - corner) / size for points in (contour.contour.segments, polygon.vertices))
    rounded = (np.round(points, DECIMALS) + 0.0 for points in shapes)
    lines = contour.contour.straight.tobytes()
    return contour.role == "line", polygon.closed, lines, *(points.tobytes() for points in rounded)
