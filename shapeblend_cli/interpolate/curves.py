"""In-betweens made of the drawings' own curves: two outlines cut into the same list of cubics and lines.

The way there: `rails` makes places out of vertex numbers, `track` takes the polygons' rounding out of the solver's
dots, the outlines are cut where either has a node and where else the curves would stray from the polygons
(`strays`), and `joins` keeps smooth what is smooth in both drawings.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.geometry import cubics
from shapeblend_cli.interpolate.joins import divide_lines, slides
from shapeblend_cli.interpolate.rails import is_among, rail
from shapeblend_cli.interpolate.strays import along, strays
from shapeblend_cli.interpolate.track import slack_track, unrolled
from shapeblend_cli.model import Box, frozen

if TYPE_CHECKING:
    from shapeblend_cli.interpolate.rails import Rail
    from shapeblend_cli.interpolate.track import Track
    from shapeblend_cli.model import BoolArray, ComplexArray, Contour, FloatArray, IntArray, Polygon

TOLERANCE = 2e-3
"""How far in-betweens of curves may lie from those of polygons, as a share of the larger outline's size.

Four times what flattening allows itself. Over pairs of icons an in-between then has about as many segments as both
drawings together, and a bump of that height is a fifth of a pixel in an icon of 100.
"""

SNAP = 1.5
"""A node of each outline become one if so many edges of the polygons lie between, at most."""

NEARBY = 2.0
"""Nodes made one are blamed for what strays within so many edges; more than `SNAP`."""

MOST_ROUNDS = 12
"""Rounds of cutting; a handful is enough."""

SLIDING_ROUNDS = 2
"""Rounds of sliding cuts along; more change little."""

SLIDE_SHARES = (1.0, 0.5, 0.0)
"""How much of a slide is tried, one after the other, until the curves no longer stray."""


@dataclass(frozen=True, slots=True, eq=False)
class CommonSegments:
    """Two outlines as the same list of segments; an in-between has ``(1 - t) * segments_a + t * segments_b``.

    Attributes
    ----------
    segments_a, segments_b : (s, 4) complex
        Control points. Each segment is a part of one segment of its drawing, or a point where the drawing waits for
        the other one; one after the other they are the whole drawing. Each ends where the next begins.
    straight : (s,) bool
        Whether the segment is a line, or a point, in both, and so in every in-between.
    places_a, places_b : (s + 1,) float
        Where the drawings are cut: vertex numbers of their polygons, rising, once round if closed. Between two
        vertices by the curve's parameter.
    """

    segments_a: ComplexArray
    segments_b: ComplexArray
    straight: BoolArray
    places_a: FloatArray
    places_b: FloatArray

    def __post_init__(self) -> None:
        object.__setattr__(self, "segments_a", frozen(self.segments_a, np.complex128))
        object.__setattr__(self, "segments_b", frozen(self.segments_b, np.complex128))
        object.__setattr__(self, "straight", frozen(self.straight, np.bool_))
        object.__setattr__(self, "places_a", frozen(self.places_a, np.float64))
        object.__setattr__(self, "places_b", frozen(self.places_b, np.float64))


def common_segments(
    contour_a: Contour,
    polygon_a: Polygon,
    contour_b: Contour,
    polygon_b: Polygon,
    dots: IntArray,
    tolerance: float = TOLERANCE,
) -> CommonSegments:
    """Cut two outlines at places that correspond, so that both have the same segments.

    Every node of either drawing is an end of a segment, at its place on the other one; nodes of both that are nearly
    at the same place become one, corners foremost. Further cuts are made only where the curves would stray.

    Parameters
    ----------
    contour_a, contour_b : Contour
        In the same coordinates and in the same direction; both closed or both open.
    polygon_a, polygon_b : Polygon
        The contours flattened, vertices in the order of the contour's parameter. A polygon of one vertex is a point
        out of which the other outline grows whole.
    dots : (k, 2) int
        The solver's correspondence, as in `model.Correspondence`: steps of one vertex or none on either side.
    tolerance : float > 0
        How far an in-between may lie from the polygons' one, as a share of the larger outline's size. It is a
        distance of outlines: where along the outline a point is drawn does not count, see `strays.strays`. The
        polygons compared with go along `track.slack_track`, which is half an edge off the dots, at most, and only
        where a vertex stands still. Compared at a quarter, half and three quarters of the time; at the ends there is
        nothing to compare, since the curves are the drawings.

    Returns
    -------
    CommonSegments
        Closed ones begin at A's first node.
    """
    if len(polygon_a.vertices) == 1 or len(polygon_b.vertices) == 1:
        return _out_of_a_point(contour_a, polygon_a, contour_b, polygon_b)
    a, b = rail(contour_a, polygon_a), rail(contour_b, polygon_b)
    dots = np.asarray(dots, np.intp)
    if all(one.straight.all() and one.node.all() for one in (a, b)):
        # Polygons from the outset: nothing is rounded, and the solver's own paths are the best.
        return _common(a, b, unrolled(a, b, dots))
    distance = tolerance * max(Box.around(polygon.vertices).larger_side for polygon in (a, b))
    track = slack_track(a, b, dots)
    cuts = _cuts(a, b, track, distance)
    return _common(a, b, _slid(a, b, track, cuts, distance))


def _common(a: Rail, b: Rail, cuts: FloatArray) -> CommonSegments:
    return CommonSegments(*_pieces(a, b, cuts), cuts[:, 0], cuts[:, 1])


def _out_of_a_point(
    contour_a: Contour, polygon_a: Polygon, contour_b: Contour, polygon_b: Polygon
) -> CommonSegments:
    """One outline is a point: the other's own segments grow out of it, or shrink into it."""
    if len(polygon_a.vertices) == 1:
        segments, straight = contour_b.segments, contour_b.straight
        places = _node_places(contour_b, polygon_b)
        point = np.full_like(segments, polygon_a.vertices[0])
        return CommonSegments(point, segments, straight, np.zeros_like(places), places)
    segments, straight = contour_a.segments, contour_a.straight
    places = _node_places(contour_a, polygon_a)
    point = np.full_like(segments, polygon_b.vertices[0])
    return CommonSegments(segments, point, straight, places, np.zeros_like(places))


def _node_places(contour: Contour, polygon: Polygon) -> FloatArray:
    """The vertex at which each segment of a contour begins, and the end of the last."""
    count = len(polygon.vertices)
    first = np.searchsorted(polygon.segment + polygon.parameter, np.arange(len(contour.segments)))
    return np.append(first, count if polygon.closed else count - 1).astype(np.float64)


def _pieces(a: Rail, b: Rail, cuts: FloatArray) -> tuple[ComplexArray, ComplexArray, BoolArray]:
    """Both outlines between the cuts, and which pieces are straight in both."""
    found, lines = [], []
    for side, one in enumerate((a, b)):
        segment, start, end = one.parts(cuts[:, side])
        piece = cubics.pieces(one.segments[segment], start, end)
        piece[:-1, 3] = piece[1:, 0]
        if one.closed:
            piece[-1, 3] = piece[0, 0]
        point = cuts[1:, side] <= cuts[:-1, side]
        piece[point] = piece[point, :1]
        found.append(piece)
        lines.append(one.straight[segment] | point)
    divided_a, divided_b = divide_lines(found[0], found[1], lines[0], lines[1], a.closed)
    return divided_a, divided_b, lines[0] & lines[1]


def _cuts(a: Rail, b: Rail, track: Track, distance: float) -> FloatArray:
    """Where to cut: at the nodes, and where else the curves would be further off than `distance`."""
    plain, nodes = _cuts_at_nodes(a, b, track)
    first = _pairs_to_join(a, b, plain, nodes)
    extra = np.zeros((0, 2))
    for _ in range(MOST_ROUNDS):
        cuts, joined = _joined(plain, nodes, first, extra)
        segments_a, segments_b, _ = _pieces(a, b, cuts)
        far = strays(segments_a, segments_b, a, b, track.places, cuts)
        apart, more = _remedies(a, b, track, cuts, joined, far, distance)
        if not apart and not more:
            break
        first = first[~is_among(first, np.array(apart, np.intp))]
        extra = np.concatenate([extra, np.reshape(more, (-1, 2))])
    return cuts


def _cuts_at_nodes(a: Rail, b: Rail, track: Track) -> tuple[FloatArray, BoolArray]:
    """Places of the track where a drawing has a node, or where the track says so.

    Returns
    -------
    cuts : (s, 2) float
    nodes : (s, 2) bool
        Whether A, and whether B, has a node there.
    """
    fixed = track.places[track.fixed]
    lengths = a.length_at(track.places[:, 0]), b.length_at(track.places[:, 1])
    found = [fixed]
    for side, one, other in ((0, a, b), (1, b, a)):
        low, high = track.places[[0, -1], side]
        numbers = np.arange(np.ceil(low), np.floor(high) + 1.0)
        numbers = numbers[one.flag(one.node, numbers)]
        numbers = numbers[~is_among(numbers, fixed[:, side])]
        to = other.place_at(np.interp(one.length_at(numbers), lengths[side], lengths[1 - side]))
        found.append(np.stack([numbers, to] if side == 0 else [to, numbers], axis=1))
    cuts = np.concatenate(found)
    order = np.lexsort((cuts[:, 1], cuts[:, 0]))
    cuts = np.maximum.accumulate(cuts[order], axis=0)
    cuts = cuts[np.append(True, (np.diff(cuts, axis=0) > 1e-9).any(axis=1))]
    return cuts, np.stack([a.flag(a.node, cuts[:, 0]), b.flag(b.node, cuts[:, 1])], axis=1)


def _pairs_to_join(a: Rail, b: Rail, cuts: FloatArray, nodes: BoolArray) -> IntArray:
    """Numbers of cuts that are to join with the next one, so that a node of A and one of B become one."""
    gaps = _edges_between(a, b, cuts[:-1], cuts[1:])
    # Together they are at nodes of both, one of them is not, and no node has to give up its place.
    joint = (nodes[:-1] | nodes[1:]).all(axis=1) & ~(nodes[:-1] & nodes[1:]).all(axis=1)
    torn = (nodes[:-1] & nodes[1:] & (cuts[:-1] != cuts[1:])).any(axis=1)
    near = joint & ~torn & (gaps <= SNAP)
    near[[0, -1]] = False  # the ends stay where they are
    numbers = np.flatnonzero(near)
    chosen: list[int] = []
    taken = np.zeros(len(cuts), np.bool_)
    for k in numbers[np.argsort(gaps[numbers], kind="stable")].tolist():
        if not taken[k : k + 2].any():
            taken[k : k + 2] = True
            chosen.append(k)
    return np.sort(np.array(chosen, np.intp))


def _joined(
    plain: FloatArray, nodes: BoolArray, first: IntArray, extra: FloatArray
) -> tuple[FloatArray, IntArray]:
    """The cuts with pairs joined and further ones added; and for each the number of its pair's first, else -1."""
    cuts = plain.copy()
    joined = np.full(len(plain), -1, np.intp)
    cuts[first] = np.where(nodes[first], plain[first], plain[first + 1])
    joined[first] = first
    keep = np.ones(len(plain), np.bool_)
    keep[first + 1] = False
    cuts = np.concatenate([cuts[keep], extra])
    joined = np.concatenate([joined[keep], np.full(len(extra), -1, np.intp)])
    order = np.lexsort((cuts[:, 1], cuts[:, 0]))
    return cuts[order], joined[order]


def _remedies(
    a: Rail,
    b: Rail,
    track: Track,
    cuts: FloatArray,
    joined: IntArray,
    far: FloatArray,
    distance: float,
) -> tuple[list[int], list[FloatArray]]:
    """What to do where the curves stray: which joined pairs to take apart, and where to cut."""
    bad = np.flatnonzero(far > distance)
    apart: list[int] = []
    more: list[FloatArray] = []
    pieces = _piece_of(a, b, cuts, track.places[bad])
    for k in sorted(set(pieces.tolist())):
        within = bad[pieces == k]
        worst = track.places[within[far[within].argmax()]]
        ends = np.flatnonzero(joined[k : k + 2] >= 0) + k
        ends = ends[_edges_between(a, b, cuts[ends], worst[None]) <= NEARBY]
        apart += joined[ends].tolist()
        place = np.clip(worst, cuts[k], cuts[k + 1])
        if not len(ends) and (place > cuts[k]).any() and (place < cuts[k + 1]).any():
            more.append(place)
    return apart, more


def _slid(a: Rail, b: Rail, track: Track, cuts: FloatArray, distance: float) -> FloatArray:
    """Cuts slid along for smoother joins, each as far as the curves do not stray."""
    ends = track.places[[0, -1]]
    held = track.places[track.fixed]
    held = held[(held != ends[0]).any(axis=1) & (held != ends[1]).any(axis=1)]
    loose = ~(is_among(cuts[:, 0], held[:, 0]) & is_among(cuts[:, 1], held[:, 1]))
    wished = cuts
    for _ in range(SLIDING_ROUNDS):
        wished = wished + slides(a, b, wished, loose, distance)
    if (wished == cuts).all():
        return cuts
    tried = np.zeros(len(cuts), np.intp)
    while True:
        slid = cuts + np.take(SLIDE_SHARES, tried)[:, None] * (wished - cuts)
        segments_a, segments_b, _ = _pieces(a, b, slid)
        far = strays(segments_a, segments_b, a, b, track.places, slid)
        pieces = _piece_of(a, b, slid, track.places[far > distance])
        back = np.zeros(len(cuts), np.bool_)
        back[pieces] = back[pieces + 1] = True
        if a.closed:
            back[[0, -1]] = back[0] | back[-1]
        back &= (tried < len(SLIDE_SHARES) - 1) & (wished != cuts).any(axis=1)
        if not back.any():
            return slid
        tried[back] += 1


def _edges_between(a: Rail, b: Rail, one: FloatArray, other: FloatArray) -> FloatArray:
    """How far apart places are, (k,) float, in mean edges of the outline on which they are further apart."""
    gaps = [
        np.abs(r.length_at(other[:, side]) - r.length_at(one[:, side])) * (r.count / r.lengths[-1])
        for side, r in enumerate((a, b))
    ]
    return np.maximum(*gaps)


def _piece_of(a: Rail, b: Rail, cuts: FloatArray, places: FloatArray) -> IntArray:
    """The number of the piece on which each place lies."""
    numbers = np.searchsorted(along(a, b, cuts), along(a, b, places), side="right") - 1
    return np.clip(numbers, 0, len(cuts) - 2)
