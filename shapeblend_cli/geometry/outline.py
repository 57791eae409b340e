"""What can be said of one outline: area, direction, what it goes round, crossings."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.geometry import crossings
from shapeblend_cli.model import Contour, Polygon

NEARLY_ALL = 0.95
"""Share of what an outline with crossings goes round that decides its direction."""

GRID = 24
"""Points along each side of an outline's box at which that is seen."""

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import BoolArray, ComplexArray, CubicPath, FloatArray, IntArray

CHORD_ERROR = 1e-6
"""How far curves may stray from their chords where crossings are counted; like what follows, a share of the size."""

NOISE = 1e-9
"""Places of straight edges nearer than this are one place."""

ROUNDING = 1e-15
"""The same for coordinates of size 1."""

REACH = 0.05
"""Two strands that stay together this far run along each other."""


def signed_area(vertices: ComplexArray) -> float:
    """Area inside a closed polygon; positive where x turns towards y."""
    return 0.5 * float((vertices.conj() * np.roll(vertices, -1)).imag.sum())


def direction(polygon: Polygon) -> int:
    """Which way round a polygon goes: 1, -1, or 0 where that is not decided.

    The sign of the area decides if the outline does not cross itself. If it does, the sum of its turns must agree, or
    nearly all it goes round, it must go round that way: in a figure of eight turns cancel, and one lobe's being larger
    says nothing, but a small loop in a drawing's outline is a slip. Open lines have no direction.
    """
    if not polygon.closed:
        return 0
    vertices = polygon.vertices
    way = int(np.sign(signed_area(vertices)))
    if self_crossings(vertices, closed=True):
        edges = np.roll(vertices, -1) - vertices
        turns = np.angle(edges * np.roll(edges, 1).conj()).sum() / (2.0 * np.pi)
        return way if way * round(float(turns)) > 0 or _share_round(vertices, way) >= NEARLY_ALL else 0
    return way


def _share_round(vertices: ComplexArray, way: int) -> float:
    """What share of the points a polygon goes round, it goes round in a direction; seen at a grid of points."""
    across = (np.arange(GRID) + 0.5) / GRID
    x = vertices.real.min() + np.ptp(vertices.real) * across
    y = vertices.imag.min() + np.ptp(vertices.imag) * across
    numbers = winding_numbers((x[:, None] + 1j * y).ravel(), vertices)
    around = np.count_nonzero(numbers)
    return float(np.count_nonzero(numbers * way > 0) / around) if around else 0.0


def reversed_contour(contour: Contour) -> Contour:
    """The same contour the other way round; a closed one keeps its first node."""
    return Contour(contour.segments[::-1, ::-1], contour.straight[::-1], contour.closed)


def reversed_polygon(polygon: Polygon, segments: int) -> Polygon:
    """The same polygon the other way round, on the contour the other way round.

    Parameters
    ----------
    polygon : Polygon
    segments : int
        How many segments its contour has.

    Returns
    -------
    Polygon
        A closed one keeps its first vertex.
    """
    order = np.arange(len(polygon.vertices))[::-1]
    if polygon.closed:
        order = np.roll(order, 1)
    segment, parameter = polygon.segment[order], polygon.parameter[order]
    is_node = parameter == 0.0
    segment = np.where(is_node, segments - segment, segments - 1 - segment)
    parameter = np.where(is_node, 0.0, 1.0 - parameter)
    if polygon.closed:
        segment %= segments
    elif is_node[-1]:  # nothing begins at the end of an open contour
        segment[-1], parameter[-1] = segments - 1, 1.0
    return Polygon(polygon.vertices[order], segment, parameter, polygon.closed)


def winding_numbers(points: ComplexArray, vertices: ComplexArray) -> IntArray:
    """How often a closed polygon goes round points, positive where x turns towards y.

    Parameters
    ----------
    points : (p,) complex
        Points on the polygon itself count to either side of it.
    vertices : (m,) complex

    Returns
    -------
    (p,) int
        The edges that cross the ray from each point along +x, upwards counted against downwards.
    """
    following = np.roll(vertices, -1)
    x, y = points.real[:, None], points.imag[:, None]
    below, above = vertices.imag <= y, following.imag <= y
    # On which side of the edge the point lies.
    side = (following.real - vertices.real) * (y - vertices.imag) - (x - vertices.real) * (
        following.imag - vertices.imag
    )
    up = below & ~above & (side > 0.0)
    down = ~below & above & (side < 0.0)
    return up.sum(axis=1) - down.sum(axis=1)


def mean_value_weights(point: complex, polygon: ComplexArray) -> FloatArray:
    """Mean value coordinates of a point: weights of a closed polygon's vertices, with sum 1, whose mean it is.

    Parameters
    ----------
    point : complex
        Not on the polygon; on it, the weights are those of the nearest vertex.
    polygon : (k,) complex
        Neighbours may coincide.

    Returns
    -------
    (k,) float
        Negative ones are possible where the polygon is not convex.

    References
    ----------
    M. S. Floater, "Mean value coordinates", Computer Aided Geometric Design 20 (2003), eq (2.1).
    """
    spokes = polygon - point
    lengths = np.abs(spokes)
    following, beyond = np.roll(spokes, -1), np.roll(lengths, -1)
    turned = spokes.conj() * following
    # tan(alpha / 2) of the angle between neighbouring spokes.
    below = lengths * beyond + turned.real
    weights = np.zeros(len(polygon))
    if lengths.min() > 0.0 and (below > 1e-12 * lengths * beyond).all():
        tangents = turned.imag / below
        weights = (np.roll(tangents, 1) + tangents) / lengths
    total = weights.sum()
    if abs(total) > 1e-12 * np.abs(weights).sum():
        return weights / total
    weights[:] = 0.0
    weights[lengths.argmin()] = 1.0
    return weights


def self_crossings(vertices: ComplexArray, closed: bool) -> int:
    """How often an outline of straight edges crosses itself, see `crossings.count_crossings`."""
    return _polygon_crossings([(vertices, closed)])


def all_crossings(polygons: Sequence[Polygon]) -> int:
    """How often outlines of straight edges cross themselves and each other."""
    return _polygon_crossings([(polygon.vertices, polygon.closed) for polygon in polygons])


def curve_crossings(outlines: Sequence[CubicPath], most: int | None = None) -> int:
    """How often outlines cross themselves and each other, on their curves.

    Touching is no crossing, nor is running along each other, also if the strands part to other sides than they met.
    Strands that pass through each other at a node of one or both cross once.

    Parameters
    ----------
    outlines : sequence of CubicPath
        Closed ones end where they begin.
    most : int, optional
        Stop counting there: 1 asks whether anything crosses.

    Returns
    -------
    int
        Curves are cut into chords that stray from them by at most `CHORD_ERROR` of the outlines' size. Where two
        strands stay within four times that of each other, they touch.
    """
    if not outlines:
        return 0
    return chain_crossings(
        np.concatenate([outline.segments for outline in outlines]),
        np.concatenate([outline.straight for outline in outlines]),
        [len(outline.segments) for outline in outlines],
        [outline.closed for outline in outlines],
        most,
    )


def chain_crossings(
    segments: ComplexArray,
    straight: BoolArray,
    lengths: Sequence[int],
    closed: Sequence[bool],
    most: int | None = None,
) -> int:
    """How often outlines cross themselves and each other, see `curve_crossings`.

    Parameters
    ----------
    segments : (s, 4) complex
        Control points of all outlines, one after the other.
    straight : (s,) bool
    lengths : sequence of int
        How many segments each outline has.
    closed : sequence of bool
    most : int, optional
    """
    bends = np.abs(segments[:, :2] - 2.0 * segments[:, 1:3] + segments[:, 2:]).max(axis=1)
    bends[straight] = 0.0
    tolerance = CHORD_ERROR * _size(segments)
    if tolerance == 0.0:
        return 0
    # A piece of 1/n of a segment strays from its chord by at most 1/8 of its second derivative over n^2.
    counts = np.maximum(np.ceil(np.sqrt(0.75 / tolerance * bends)).astype(np.intp), 1)
    # Every segment gives the starts of its pieces, and the last one of an outline its end as well.
    last = np.cumsum(lengths) - 1
    before = np.cumsum(counts)
    chains = np.concatenate([[0], before[last] + np.arange(1, len(lengths) + 1)])
    points = np.empty(chains[-1], np.complex128)
    places = before - counts + np.repeat(np.arange(len(lengths)), lengths)
    crossings.cut_into_chords(segments.view(np.float64), counts, places, _xy(points))
    # Rounding may have left the end of a closed one beside its start.
    first = last + 1 - np.asarray(lengths)
    points[chains[1:] - 1] = np.where(closed, segments[first, 0], segments[last, 3])
    return _count(points, chains, 4.0 * CHORD_ERROR if counts.max() > 1 else NOISE, most)


def _polygon_crossings(polygons: Sequence[tuple[ComplexArray, bool]]) -> int:
    around = [np.append(vertices, vertices[0]) if closed else vertices for vertices, closed in polygons]
    chains = np.concatenate([[0], np.cumsum([len(vertices) for vertices in around])])
    return _count(np.concatenate(around), chains, NOISE, None)


def _count(points: ComplexArray, chains: IntArray, noise: float, most: int | None) -> int:
    """Count the crossings of chains, see `crossings`; noise as a share of their size."""
    size = _size(points)
    # Far from the origin rounding is more than the share.
    noise = max(noise * size, ROUNDING * float(np.abs(points).max()))
    xy = _xy(points)
    blocks = np.empty((len(points), 4), np.intp)
    boxes = np.empty((len(points), 4))
    found = crossings.find_blocks(xy, chains, blocks, boxes)
    order = np.argsort(boxes[:found, 0])
    limit = len(points) ** 2 if most is None else most
    return crossings.count_crossings(xy, chains, blocks[order], boxes[order], noise, REACH * size, limit)


def _size(points: ComplexArray) -> float:
    return max(float(np.ptp(points.real)), float(np.ptp(points.imag)))


def _xy(points: ComplexArray) -> FloatArray:
    """The same memory as (n, 2) float."""
    return points.view(np.float64).reshape(-1, 2)
