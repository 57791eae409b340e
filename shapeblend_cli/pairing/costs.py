"""What it costs to turn one contour into another: work, distance, change of size and of paint."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.constants import PAPER, WorkConstants
from shapeblend_cli.geometry.placement import to_unit_box
from shapeblend_cli.geometry.polyline import distinct
from shapeblend_cli.matching.solve import least_work
from shapeblend_cli.matching.work import Wires

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import Box, ComplexArray, FloatArray
    from shapeblend_cli.pairing.decompose import PlacedContour

DISTANCE_WEIGHT = 1.0
"""Cost of a distance as large as the drawing."""

SIZE_WEIGHT = 0.5
"""Cost of a change of size by the factor e."""

WORK_WEIGHT, WORK_HALF_SATURATION = 0.5, 10.0
"""Cost of any amount of work, and the least work that costs half of it: a circle into a five-pointed star takes about
this much. The cost is the share work / (work + `WORK_HALF_SATURATION`): shapes that differ in every detail are not
worse partners than those that differ in most."""

LIKENESS = WorkConstants(**PAPER)
"""By what contours are alike: the paper's work, which does not hang on where they are. The weights are set for it."""

PAINT_WEIGHT = 0.5
"""Cost of turning a filled shape into one that is not, or one without a stroke into one with; and of turning black
into white."""

SKIP_COST = 1.0
"""Cost of leaving out a contour as large as the drawing."""

WORK_VERTICES, MOST_WORKS = 32, 400
"""Vertices of the polygons whose work is compared, and for how many pairs, about: the cheapest ones without it."""

_COINCIDENT = 1e-6
"""Vertices of a unit box nearer than this are one."""


class FramedContours(NamedTuple):
    """Contours of one drawing in their frame: the drawing's box, or for holes that of their exterior."""

    contours: Sequence[PlacedContour]
    frame: Box

    def centres(self) -> ComplexArray:
        """Return the centre of each contour relative to the frame's, in units of the frame's diagonal."""
        return (
            np.array([contour.centre for contour in self.contours]) - self.frame.centre
        ) / self.frame.diagonal

    def sizes(self) -> FloatArray:
        """Return the diagonal of each contour's box as a share of the frame's."""
        return np.array([contour.size for contour in self.contours]) / self.frame.diagonal


def pairing_costs(a: FramedContours, b: FramedContours) -> FloatArray:
    """Return the costs of turning each contour of `a` into each of `b`, (p, q) float >= 0."""
    distance = np.abs(a.centres()[:, None] - b.centres())
    growth = np.abs(np.log(a.sizes())[:, None] - np.log(b.sizes()))
    paint = np.array([[_paint_difference(p, q) for q in b.contours] for p in a.contours])
    cheap = DISTANCE_WEIGHT * distance + SIZE_WEIGHT * growth + PAINT_WEIGHT * paint
    work = np.full(cheap.shape, np.inf)
    for i, j in _worth_solving(cheap):
        p, q = a.contours[i].polygon, b.contours[j].polygon
        work[i, j] = coarse_work(to_unit_box(p), to_unit_box(q), p.closed and q.closed, LIKENESS)
    return cheap + WORK_WEIGHT * (1.0 - WORK_HALF_SATURATION / (work + WORK_HALF_SATURATION))


def _worth_solving(cheap: FloatArray) -> list[tuple[int, int]]:
    """Return all pairs, or the cheapest of each row and of each column."""
    if cheap.size <= MOST_WORKS:
        return list(np.ndindex(cheap.shape))
    each = max(1, MOST_WORKS // sum(cheap.shape))
    rows = {(i, int(j)) for i, row in enumerate(cheap) for j in np.argsort(row, kind="stable")[:each]}
    columns = {(int(i), j) for j, col in enumerate(cheap.T) for i in np.argsort(col, kind="stable")[:each]}
    return sorted(rows | columns)


def coarse_work(p0: ComplexArray, p1: ComplexArray, closed: bool, constants: WorkConstants) -> float:
    """Return the least work between two polygons in their unit boxes, on a few of their vertices.

    Open polygons may correspond in either direction. Infinite if so few vertices do not make a polygon.
    """
    p, q = _thinned(p0, closed), _thinned(p1, closed)
    if min(len(p), len(q)) < (3 if closed else 2):
        return np.inf
    directions = [q] if closed else [q, q[::-1]]
    return min(least_work(Wires(p, directed, closed, constants)).work for directed in directions)


def _thinned(vertices: ComplexArray, closed: bool) -> ComplexArray:
    """Return at most `WORK_VERTICES` vertices, evenly spread by their numbers, none twice in a row."""
    if len(vertices) > WORK_VERTICES:
        last = len(vertices) - (0 if closed else 1)
        chosen = np.linspace(0, last, WORK_VERTICES, endpoint=not closed)
        vertices = vertices[np.round(chosen).astype(np.intp)]
    # An outline that runs back over itself may have its vertices in pairs.
    return vertices[distinct(vertices, closed, _COINCIDENT)]


def _paint_difference(a: PlacedContour, b: PlacedContour) -> float:
    """Return how differently two contours are painted: 1 for black and white, 1 for each kind of paint more."""
    difference = 0.0
    for p, q in ((a.style.fill, b.style.fill), (a.style.stroke, b.style.stroke)):
        if p is None or q is None:
            difference += (p is None) != (q is None)
        else:
            channels = zip(bytes.fromhex(p[1:]), bytes.fromhex(q[1:]), strict=True)
            difference += sum(abs(x - y) for x, y in channels) / 765
    return difference
