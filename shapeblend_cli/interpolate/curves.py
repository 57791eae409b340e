"""In-betweens made of the drawings' own curves: two outlines cut into the same list of cubics and lines."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.geometry import cubics
from shapeblend_cli.interpolate import joins
from shapeblend_cli.interpolate.rails import rail
from shapeblend_cli.interpolate.strays import strays
from shapeblend_cli.interpolate.track import slack_track, unrolled
from shapeblend_cli.model import frozen

if TYPE_CHECKING:
    from shapeblend_cli.interpolate.rails import Rail
    from shapeblend_cli.interpolate.track import Track
    from shapeblend_cli.model import BoolArray, ComplexArray, Contour, FloatArray, IntArray, Polygon

TOLERANCE = 3e-3
"""How far an in-between of curves may lie from that of polygons, as a share of the larger outline's size."""

EASE = True
SNAP = 1.5
"""Nodes of both outlines that are matched within so many edges of the polygons become one."""

MOST_ROUNDS = 12
"""Rounds of cutting; a handful is enough."""


@dataclass(frozen=True, slots=True, eq=False)
class CommonSegments:
    """todo."""

    segments_a: ComplexArray
    segments_b: ComplexArray
    straight: BoolArray

    def __post_init__(self) -> None:
        object.__setattr__(self, "segments_a", frozen(self.segments_a, np.complex128))
        object.__setattr__(self, "segments_b", frozen(self.segments_b, np.complex128))
        object.__setattr__(self, "straight", frozen(self.straight, np.bool_))


def common_segments(
    contour_a: Contour,
    polygon_a: Polygon,
    contour_b: Contour,
    polygon_b: Polygon,
    dots: IntArray,
    tolerance: float = TOLERANCE,
) -> CommonSegments:
    """todo."""
    if len(polygon_a.vertices) == 1 or len(polygon_b.vertices) == 1:
        return _out_of_a_point(contour_a, polygon_a, contour_b, polygon_b)
    a, b = rail(contour_a, polygon_a), rail(contour_b, polygon_b)
    dots = np.asarray(dots, np.intp)
    if a.straight.all() and b.straight.all() and a.node.all() and b.node.all():
        return CommonSegments(*_pieces(a, b, unrolled(a, b, dots)))
    tolerance *= max(_size(a.vertices), _size(b.vertices))
    track = slack_track(a, b, dots)
    plain, held = _cuts_at_nodes(a, b, track)
    first = _pairs_to_join(a, b, plain, held)
    nodes = np.stack([a.flag(a.node, plain[:, 0]), b.flag(b.node, plain[:, 1])], axis=1)
    extra = np.zeros((0, 2))
    for _ in range(MOST_ROUNDS):
        cuts, joined = _with_joined(plain, nodes, first, extra)
        segments_a, segments_b, straight = _pieces(a, b, cuts)
        far = strays(segments_a, segments_b, a, b, track.places, cuts)
        apart, more = _remedies(a, b, track, cuts, joined, far, tolerance)
        if not len(apart) and not len(more):
            break
        first = np.setdiff1d(first, apart)
        extra = np.concatenate([extra, more])
    return CommonSegments(segments_a, segments_b, straight)


def _size(points: ComplexArray) -> float:
    return max(float(np.ptp(points.real)), float(np.ptp(points.imag)))


def _out_of_a_point(
    contour_a: Contour, polygon_a: Polygon, contour_b: Contour, polygon_b: Polygon
) -> CommonSegments:
    """One outline is a point: the other's own segments grow out of it, or shrink into it."""
    if len(polygon_a.vertices) == 1:
        segments, straight = contour_b.segments, contour_b.straight
        return CommonSegments(np.full_like(segments, polygon_a.vertices[0]), segments, straight)
    segments, straight = contour_a.segments, contour_a.straight
    return CommonSegments(segments, np.full_like(segments, polygon_b.vertices[0]), straight)


def _cuts_at_nodes(a: Rail, b: Rail, track: Track) -> tuple[FloatArray, BoolArray]:
    """Places of the track at which one of the drawings has a node, and where the track says; which are fixed."""
    fixed = track.places[track.fixed]
    lengths = a.length_at(track.places[:, 0]), b.length_at(track.places[:, 1])
    found = [fixed]
    for side, one, other in ((0, a, b), (1, b, a)):
        low, high = track.places[[0, -1], side]
        numbers = np.arange(np.ceil(low), np.floor(high) + 1.0)
        numbers = numbers[one.flag(one.node, numbers)]
        numbers = numbers[~np.isin(numbers, fixed[:, side])]
        to = other.place_at(np.interp(one.length_at(numbers), lengths[side], lengths[1 - side]))
        found.append(np.stack([numbers, to] if side == 0 else [to, numbers], axis=1))
    cuts = np.concatenate(found)
    held = np.arange(len(cuts)) < len(fixed)
    order = np.lexsort((cuts[:, 1], cuts[:, 0]))
    cuts, held = np.maximum.accumulate(cuts[order], axis=0), held[order]
    new = np.append(True, (np.diff(cuts, axis=0) > 1e-9).any(axis=1))
    held = np.logical_or.reduceat(held, np.flatnonzero(new))
    return cuts[new], held


def _pairs_to_join(a: Rail, b: Rail, cuts: FloatArray, held: BoolArray) -> IntArray:
    """Numbers of cuts at a node of one outline that are to join with the next cut, at a node of the other one."""
    on_a, on_b = a.flag(a.node, cuts[:, 0]), b.flag(b.node, cuts[:, 1])
    alone = (on_a ^ on_b) & ~held
    gaps = np.stack(
        [
            np.diff(a.length_at(cuts[:, 0])) * a.count / a.lengths[-1],
            np.diff(b.length_at(cuts[:, 1])) * b.count / b.lengths[-1],
        ]
    ).max(axis=0)
    near = alone[:-1] & alone[1:] & (on_a[:-1] != on_a[1:]) & (gaps <= SNAP)
    chosen: list[int] = []
    taken = np.zeros(len(cuts), np.bool_)
    numbers = np.flatnonzero(near)
    for k in numbers[np.argsort(gaps[numbers], kind="stable")].tolist():
        if not taken[k : k + 2].any():
            taken[k : k + 2] = True
            chosen.append(k)
    return np.sort(np.array(chosen, np.intp))


def _with_joined(
    plain: FloatArray, nodes: BoolArray, first: IntArray, extra: FloatArray
) -> tuple[FloatArray, IntArray]:
    """The cuts with pairs joined and further ones added; for each the number of its pair's first, else -1."""
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


def _pieces(a: Rail, b: Rail, cuts: FloatArray) -> tuple[ComplexArray, ComplexArray, BoolArray]:
    """Both outlines cut at the places."""
    found = []
    lines = []
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
    if EASE:
        found = list(joins.eased(found[0], found[1], lines[0], lines[1], a.closed, 0.1))
    return found[0], found[1], lines[0] & lines[1]


def _remedies(
    a: Rail,
    b: Rail,
    track: Track,
    cuts: FloatArray,
    joined: IntArray,
    far: FloatArray,
    tolerance: float,
) -> tuple[IntArray, FloatArray]:
    """What to do where the curves stray: which joined pairs to take apart, and where to cut."""
    bad = np.flatnonzero(far > tolerance)
    apart: list[int] = []
    more: list[FloatArray] = []
    if not len(bad):
        return np.zeros(0, np.intp), np.zeros((0, 2))
    along = _along(a, b, cuts)
    span = np.clip(np.searchsorted(along, _along(a, b, track.places[bad]), side="right") - 1, 0, len(cuts) - 2)
    for k in np.unique(span).tolist():
        ends = joined[[k, k + 1]]
        if (ends >= 0).any():
            apart += ends[ends >= 0].tolist()
            continue
        within = bad[span == k]
        dot = track.places[within[far[within].argmax()]]
        place = np.clip(dot, cuts[k], cuts[k + 1])
        if (place > cuts[k]).any() and (place < cuts[k + 1]).any():
            more.append(place)
    return np.array(apart, np.intp), np.array(more).reshape(-1, 2)


def _along(a: Rail, b: Rail, places: FloatArray) -> FloatArray:
    return a.length_at(places[:, 0]) / a.lengths[-1] + b.length_at(places[:, 1]) / b.lengths[-1]
