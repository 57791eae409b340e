"""Two contours cut into the same list of cubics and lines.

`parametrization` makes positions of vertex numbers. `continuous_match` removes the rounding of polygons from the
solver's dots. Then the contours are cut at the nodes of both, and where the curves would deviate from the polygons
(`deviation`). `smooth_joints` keeps joints smooth that are smooth in both drawings.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.interpolate.continuous_match import (
    ContinuousMatch,
    even_lines,
    match_continuously,
    unroll_from_node,
)
from shapeblend_cli.interpolate.deviation import deviation
from shapeblend_cli.interpolate.parametrization import ContourParameter, is_among, parametrize
from shapeblend_cli.interpolate.smooth_joints import divide_lines, slide_cuts
from shapeblend_cli.model import Box, Contour, CubicPath, Polygon, frozen

if TYPE_CHECKING:
    from shapeblend_cli.model import BoolArray, ComplexArray, FloatArray, IntArray

    Pieces = tuple[ComplexArray, ComplexArray, BoolArray]  # see `_pieces`

TOLERANCE = 2e-3
"""Maximum deviation of in-betweens of curves from in-betweens of polygons, as a share of the larger outline's size.

Four times the tolerance of flattening. Over pairs of icons an in-between then has about as many segments as both
drawings together, and a bump of that height is a fifth of a pixel in an icon of 100. It is a distance of outlines,
see `deviation.deviation`; the polygons follow the continuous match, which is off the dots by half an edge at most, and
only where a vertex is held.
"""

SNAP = 1.5
"""Maximum distance of two nodes, one of each contour, that are merged, in edges of the polygons."""

NEARBY = 2.0
"""Maximum distance of merged nodes from a deviation that they cause, in edges; more than `SNAP`."""

MOST_ROUNDS = 12
"""Maximum number of rounds of cutting; a handful is enough."""

SLIDING_ROUNDS = 2
"""Number of rounds of sliding cuts; more change little."""

SLIDE_SHARES = (1.0, 0.5, 0.0)
"""Shares of a slide that are tried in turn until the curves are within the tolerance."""


class CommonSegments(NamedTuple):
    """Two contours as the same list of segments.

    Each segment is a part of one segment of its drawing, or a point while the other drawing moves on; together, in
    order, they are the whole contour. Each ends where the next begins.
    """

    start: CubicPath
    end: CubicPath
    cuts: tuple[FloatArray, FloatArray]  # (s + 1,) each, positions that rise, once round if closed


def common_segments(
    contour_a: Contour, polygon_a: Polygon, contour_b: Contour, polygon_b: Polygon, dots: IntArray
) -> CommonSegments:
    """Cut two contours at corresponding positions, so that both have the same segments.

    Every node of either drawing is an end of a segment; nodes of both at nearly the same position are merged, the
    nearest first. Further cuts are made only where the curves would deviate by more than `TOLERANCE`. The segments of
    closed contours begin at A's first node.

    Parameters
    ----------
    contour_a, contour_b : Contour
        In the same coordinates and in the same direction; both closed or both open.
    polygon_a, polygon_b : Polygon
        The contours flattened, vertices in the order of the contour's parameter. A polygon of one vertex stands for a
        point or a line from which the other contour, with as many segments, grows whole.
    dots : (k, 2) int
        The solver's correspondence, as in `model.Correspondence`: steps of one vertex or none on either side.
    """
    if len(polygon_a.vertices) == 1:
        return _grow_from(contour_a, contour_b, polygon_b)
    if len(polygon_b.vertices) == 1:
        grown = _grow_from(contour_b, contour_a, polygon_a)
        return CommonSegments(grown.end, grown.start, grown.cuts[::-1])
    a, b = parametrize(contour_a, polygon_a), parametrize(contour_b, polygon_b)
    dots = np.asarray(dots, np.intp)
    if all(one.straight.all() and one.node.all() for one in (a, b)):
        # Of drawings made of lines nothing is rounded, and the solver's own paths are the best.
        cuts = unroll_from_node(a, b, dots)
        pieces = _pieces(a, b, cuts)
    else:
        match = even_lines(match_continuously(a, b, dots))
        distance = TOLERANCE * max(Box.around(polygon.vertices).larger_side for polygon in (a, b))
        cuts, pieces = _slide_cuts(match, *_find_cuts(match, distance), distance)
    segments_a, segments_b, straight = pieces
    return CommonSegments(
        CubicPath(segments_a, straight, a.closed),
        CubicPath(segments_b, straight, a.closed),
        (frozen(cuts[:, 0], np.float64), frozen(cuts[:, 1], np.float64)),
    )


def _grow_from(nothing: Contour, contour: Contour, polygon: Polygon) -> CommonSegments:
    """Grow a contour's own segments out of as many without an area."""
    count = len(polygon.vertices)
    first = np.searchsorted(polygon.segment + polygon.parameter, np.arange(len(contour.segments)))
    cuts = np.append(first, count if polygon.closed else count - 1).astype(np.float64)
    start = CubicPath(nothing.segments, contour.straight, polygon.closed)
    end = CubicPath(contour.segments, contour.straight, polygon.closed)
    return CommonSegments(start, end, (frozen(np.zeros_like(cuts), np.float64), frozen(cuts, np.float64)))


def _pieces(a: ContourParameter, b: ContourParameter, cuts: FloatArray) -> Pieces:
    """Return the pieces of both contours between the cuts, (s, 4) each, and which are straight in both."""
    (piece_a, line_a, _), (piece_b, line_b, _) = (
        one.parts(cuts[:, side], joined=True) for side, one in enumerate((a, b))
    )
    divided_a, divided_b = divide_lines(piece_a, piece_b, line_a, line_b, a.closed)
    return divided_a, divided_b, line_a & line_b


def _find_cuts(match: ContinuousMatch, distance: float) -> tuple[FloatArray, Pieces]:
    """Return cuts, (s + 1, 2), at the nodes and where the curves would otherwise deviate by more than a distance.

    The second result is the pieces between them.
    """
    plain, nodes = _cuts_at_nodes(match)
    first = _pairs_to_merge(match, plain, nodes)
    extra = np.zeros((0, 2))
    for _ in range(MOST_ROUNDS):
        cuts, merged = _merge(plain, nodes, first, extra)
        pieces = _pieces(match.a, match.b, cuts)
        far = deviation(*pieces[:2], match, cuts, distance)
        apart, more = _remedies(match, cuts, merged, far, distance)
        if not apart and not more:
            break
        first = first[~is_among(first, np.array(apart, np.intp))]
        extra = np.concatenate([extra, np.reshape(more, (-1, 2))])
    return cuts, pieces


def _cuts_at_nodes(match: ContinuousMatch) -> tuple[FloatArray, BoolArray]:
    """Return the positions of nodes and of fixed matches, (k, 2), and whether A and B have a node there, (k, 2)."""
    a, b = match.a, match.b
    fixed = match.positions[match.fixed]
    positions = [fixed]
    for side, one in enumerate((a, b)):
        low, high = match.positions[[0, -1], side]
        numbers = np.arange(np.ceil(low), np.floor(high) + 1.0)
        numbers = numbers[one.is_node(numbers)]
        positions.append(match.with_partners(side, numbers[~is_among(numbers, fixed[:, side])]))
    cuts = np.concatenate(positions)
    order = np.lexsort((cuts[:, 1], cuts[:, 0]))
    cuts = np.maximum.accumulate(cuts[order], axis=0)
    cuts = cuts[np.concatenate([[True], (cuts[1:] - cuts[:-1] > 1e-9).any(axis=1)])]
    nodes = np.empty(cuts.shape, np.bool_)
    nodes[:, 0], nodes[:, 1] = a.is_node(cuts[:, 0]), b.is_node(cuts[:, 1])
    return cuts, nodes


def _pairs_to_merge(match: ContinuousMatch, cuts: FloatArray, nodes: BoolArray) -> IntArray:
    """Return the numbers of cuts at a node of one contour to merge with the next cut, at a node of the other."""
    gaps = match.edges_between(cuts[:-1], cuts[1:])
    # Both together are at nodes of A and B, but not each of them, and no node has to give up its position.
    joint = (nodes[:-1] | nodes[1:]).all(axis=1) & ~(nodes[:-1] & nodes[1:]).all(axis=1)
    torn = (nodes[:-1] & nodes[1:] & (cuts[:-1] != cuts[1:])).any(axis=1)
    near = joint & ~torn & (gaps <= SNAP)
    near[[0, -1]] = False  # the ends keep their positions
    numbers = np.flatnonzero(near)
    chosen: list[int] = []
    taken = np.zeros(len(cuts), np.bool_)
    for k in numbers[np.argsort(gaps[numbers], kind="stable")].tolist():
        if not taken[k : k + 2].any():
            taken[k : k + 2] = True
            chosen.append(k)
    return np.sort(np.array(chosen, np.intp))


def _merge(
    plain: FloatArray, nodes: BoolArray, first: IntArray, extra: FloatArray
) -> tuple[FloatArray, IntArray]:
    """Merge pairs of cuts and add further cuts; return for each cut the number of its pair's first, -1 without."""
    cuts = plain.copy()
    merged = np.full(len(plain), -1, np.intp)
    cuts[first] = np.where(nodes[first], plain[first], plain[first + 1])
    merged[first] = first
    keep = np.ones(len(plain), np.bool_)
    keep[first + 1] = False
    cuts = np.concatenate([cuts[keep], extra])
    merged = np.concatenate([merged[keep], np.full(len(extra), -1, np.intp)])
    order = np.lexsort((cuts[:, 1], cuts[:, 0]))
    return cuts.take(order, axis=0), merged[order]


def _remedies(
    match: ContinuousMatch, cuts: FloatArray, merged: IntArray, far: FloatArray, distance: float
) -> tuple[list[int], list[FloatArray]]:
    """Return the merged pairs to separate, and the cuts to add, so that the curves deviate less."""
    bad = (far > distance).nonzero()[0]
    if not len(bad):
        return [], []
    apart: list[int] = []
    more: list[FloatArray] = []
    pieces = match.piece_at(cuts, match.positions[bad])
    for k in sorted(set(pieces.tolist())):
        within = bad[pieces == k]
        worst = match.positions[within[far[within].argmax()]]
        ends = (merged[k : k + 2] >= 0).nonzero()[0] + k
        if len(ends):
            ends = ends[match.edges_between(cuts[ends], worst[None]) <= NEARBY]
            apart += merged[ends].tolist()
        cut = np.minimum(np.maximum(worst, cuts[k]), cuts[k + 1])
        if not len(ends) and (cut > cuts[k]).any() and (cut < cuts[k + 1]).any():
            more.append(cut)
    return apart, more


def _slide_cuts(
    match: ContinuousMatch, cuts: FloatArray, pieces: Pieces, distance: float
) -> tuple[FloatArray, Pieces]:
    """Slide cuts for smoother joints as far as the curves stay within a distance of the polygons.

    Returns
    -------
    cuts : (s + 1, 2) float
    pieces : Pieces
        Those between the cuts; what is given are those before the cuts slide.
    """
    ends = match.positions[[0, -1]]
    held = match.positions[match.fixed]
    held = held[(held != ends[0]).any(axis=1) & (held != ends[1]).any(axis=1)]
    loose = ~(is_among(cuts[:, 0], held[:, 0]) & is_among(cuts[:, 1], held[:, 1]))
    wanted = cuts
    for _ in range(SLIDING_ROUNDS):
        wanted = slide_cuts(match.a, match.b, wanted, loose, distance)
    if (wanted == cuts).all():
        return cuts, pieces
    tried = np.zeros(len(cuts), np.intp)
    while True:
        slid = cuts + np.take(SLIDE_SHARES, tried)[:, None] * (wanted - cuts)
        pieces = _pieces(match.a, match.b, slid)
        deviates = deviation(*pieces[:2], match, slid, distance) > distance
        far = match.piece_at(slid, match.positions[deviates])
        back = np.zeros(len(cuts), np.bool_)
        back[far] = back[far + 1] = True
        if match.a.closed:
            back[[0, -1]] = back[0] | back[-1]
        back &= (tried < len(SLIDE_SHARES) - 1) & (wanted != cuts).any(axis=1)
        if not back.any():
            return slid, pieces
        tried[back] += 1
