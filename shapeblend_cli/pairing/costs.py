"""What it costs to make one contour of another: the work, the way, the change of size and of paint."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.geometry.placement import to_unit_box
from shapeblend_cli.match.solve import least_work

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.constants import WorkConstants
    from shapeblend_cli.model import Box, ComplexArray, FloatArray
    from shapeblend_cli.pairing.decompose import PlacedContour

DISTANCE_WEIGHT = 1.0
"""Cost of a way as long as the drawing is large."""

SIZE_WEIGHT = 0.5
"""Cost of a change of size by the factor e."""

WORK_WEIGHT = 0.5
"""Cost of any amount of work. Less costs its share, work / (work + `WORK_HALF_SATURATION`): shapes that differ in every
detail are not worse partners than those that differ in most."""

WORK_HALF_SATURATION = 10.0
"""Least work that costs half of `WORK_WEIGHT`: a circle into a five-pointed star takes about this much."""

PAINT_WEIGHT = 0.5
"""Cost of turning a filled shape into one that is not, or one without a stroke into one with; and of turning black
into white."""

SKIP_COST = 1.0
"""What is saved by not leaving out a contour as large as the drawing."""

VERTICES = 32
"""Vertices of the polygons whose work is compared."""

MOST_WORKS = 400
"""Pairs for which the work is found, about. Of more, those that are cheapest without it."""


_COINCIDENT = 1e-6
"""Vertices of a unit box nearer than this are one."""


class View(NamedTuple):
    """Contours of one drawing in their frame: the drawing's box, or for holes that of their outline."""

    parts: Sequence[PlacedContour]
    frame: Box

    @property
    def size(self) -> float:
        """Diagonal of the frame."""
        return self.frame.diagonal

    def centres(self) -> ComplexArray:
        """Where the middle of each contour lies, the frame's middle being 0 and its diagonal 1."""
        return (np.array([part.centre for part in self.parts]) - self.frame.centre) / self.size

    def sizes(self) -> FloatArray:
        """Diagonal of each contour's box as a share of the frame's."""
        return np.array([part.size for part in self.parts]) / self.size


def costs(a: View, b: View, constants: WorkConstants) -> FloatArray:
    """What it costs to turn each contour of `a` into each of `b`.

    Returns
    -------
    (p, q) float >= 0
        Without a unit: shares of the drawing's size, `DISTANCE_WEIGHT` being 1.
    """
    way = np.abs(a.centres()[:, None] - b.centres())
    size = np.abs(np.log(a.sizes())[:, None] - np.log(b.sizes()))
    paint = np.array([[_repainting(p, q) for q in b.parts] for p in a.parts])
    cheap = DISTANCE_WEIGHT * way + SIZE_WEIGHT * size + PAINT_WEIGHT * paint
    work = np.full(cheap.shape, np.inf)
    for i, j in _worth_solving(cheap):
        work[i, j] = _work(a.parts[i], b.parts[j], constants)
    return cheap + WORK_WEIGHT * (1.0 - WORK_HALF_SATURATION / (work + WORK_HALF_SATURATION))


def _worth_solving(cheap: FloatArray) -> list[tuple[int, int]]:
    """All pairs, or the cheapest of each row and of each column."""
    if cheap.size <= MOST_WORKS:
        return list(np.ndindex(cheap.shape))
    each = max(1, MOST_WORKS // sum(cheap.shape))
    rows = {(i, int(j)) for i, row in enumerate(cheap) for j in np.argsort(row, kind="stable")[:each]}
    columns = {(int(i), j) for j, col in enumerate(cheap.T) for i in np.argsort(col, kind="stable")[:each]}
    return sorted(rows | columns)


def _work(a: PlacedContour, b: PlacedContour, constants: WorkConstants) -> float:
    """Least work between two contours, each in its unit box, on a few of their vertices."""
    closed = a.polygon.closed and b.polygon.closed
    return coarse_work(to_unit_box(a.polygon), to_unit_box(b.polygon), closed, constants)


def coarse_work(p0: ComplexArray, p1: ComplexArray, closed: bool, constants: WorkConstants) -> float:
    """Least work between two polygons in their unit boxes, on a few of their vertices; open ones either way.

    Infinite where so few vertices do not make an outline.
    """
    p, q = _thinned(p0, closed), _thinned(p1, closed)
    if min(len(p), len(q)) < (3 if closed else 2):
        return np.inf
    return min(least_work(p, way, closed, constants).work for way in ([q] if closed else [q, q[::-1]]))


def _thinned(vertices: ComplexArray, closed: bool) -> ComplexArray:
    """At most `VERTICES` of the vertices, evenly spread by their numbers; none twice in a row."""
    if len(vertices) > VERTICES:
        last = len(vertices) - (0 if closed else 1)
        at = np.linspace(0, last, VERTICES, endpoint=not closed)
        vertices = vertices[np.round(at).astype(np.intp)]
    # What goes back the way it came may have its vertices in pairs.
    kept = [vertices[0]]
    for vertex in vertices[1:]:
        if abs(vertex - kept[-1]) > _COINCIDENT:
            kept.append(vertex)
    while closed and len(kept) > 1 and abs(kept[-1] - kept[0]) <= _COINCIDENT:
        kept.pop()
    return np.array(kept)


def _repainting(a: PlacedContour, b: PlacedContour) -> float:
    """How differently two contours are painted: 0 for alike, 1 for black and white, 1 for each kind of paint more."""
    found = 0.0
    for p, q in ((a.style.fill, b.style.fill), (a.style.stroke, b.style.stroke)):
        if p is None or q is None:
            found += (p is None) != (q is None)
        else:
            found += (
                sum(abs(x - y) for x, y in zip(bytes.fromhex(p[1:]), bytes.fromhex(q[1:]), strict=True)) / 765
            )
    return found
