"""Requirements on the match of two contours: a start, pins, and stiff regions."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.errors import MatchError
from shapeblend_cli.geometry.similarity import Similarity

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import FloatArray, Polygon
    from shapeblend_cli.options.settings import Settings

    Numbers = tuple[int, int]
    Pin = tuple[complex, complex]


class Constraints(NamedTuple):
    """Requirements on the match of two contours. Pins are vertex numbers, or points in A's coordinates."""

    start: Numbers | None = None
    pins: Sequence[Pin] = ()

    def without_numbers(self) -> Constraints:
        """Return the constraints that hold however outlines are cut: pins between points."""
        return Constraints(None, [pin for pin in self.pins if not has_numbers(pin)])

    def rotated_back(self, rotation: float) -> Constraints:
        """Return the constraints for B rotated back by an angle; vertex numbers do not change."""
        if not rotation:
            return self
        back = Similarity.rotation(-rotation)
        return self._replace(
            pins=[pin if has_numbers(pin) else (pin[0], back.point(pin[1])) for pin in self.pins]
        )

    def pinned_vertices(self, a: Polygon, b: Polygon) -> list[Numbers]:
        """Return the vertices that pins connect, by their numbers or nearest to the points."""
        vertices = []
        for p, q in self.pins:
            if isinstance(p, int) and isinstance(q, int):
                vertices.append((p, q))
            else:
                i, j = np.abs(a.vertices - p).argmin(), np.abs(b.vertices - q).argmin()
                vertices.append((int(i), int(j)))
        return vertices


def check_stiff(polygons: Sequence[Polygon], settings: Settings) -> None:
    """Raise a MatchError for a stiff region without a vertex of A in it."""
    for point, radius, _ in settings.stiff:
        vertices = np.concatenate([polygon.vertices for polygon in polygons])
        nearest = vertices[np.abs(vertices - point).argmin()]
        if abs(nearest - point) > radius:
            raise MatchError(
                f"no vertex of A lies within {radius:g} of the stiff point {point.real:g},{point.imag:g}; "
                f"the nearest is {nearest.real:g},{nearest.imag:g}"
            )


def stiffness(polygon: Polygon, settings: Settings) -> FloatArray | None:
    """Return the stiffness of A's vertices, (m,) float, if any is required; where regions overlap it multiplies."""
    if not settings.stiff:
        return None
    weight = np.ones(len(polygon.vertices))
    for point, radius, factor in settings.stiff:
        weight[np.abs(polygon.vertices - point) <= radius] *= factor
    return weight


def has_numbers(pin: Pin) -> bool:
    """Return whether a pin names vertices by their numbers, and not points."""
    return isinstance(pin[0], int) and isinstance(pin[1], int)
