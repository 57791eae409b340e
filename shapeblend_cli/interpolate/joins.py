"""Joins that are smooth in both drawings, and stay so in between.

With control points on straight paths the handles on either side of a join are at time t
``(1 - t) * in_a * u + t * in_b * v`` and ``(1 - t) * out_a * u + t * out_b * v``, for handle lengths `in` and `out`
and the drawings' directions u and v. They are parallel, and the join stays smooth, if u is v or if
``in_a / out_a = in_b / out_b``: if the drawings go through the join with the same change of speed. Two things can be
chosen without leaving either drawing:

- how a line is divided that becomes a curve: its inner points may lie anywhere on it;
- where on a segment the other drawing's node is matched. That slides the correspondence, so it is weighed against how
  far the in-between is moved sideways.

What remains of a bend after both is mostly the polygons' own: their in-between, too, bends where from one edge to the
next the vertices of one drawing suddenly follow each other faster, beside those of the other one.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.geometry import cubics
from shapeblend_cli.interpolate.rails import CORNER

if TYPE_CHECKING:
    from shapeblend_cli.interpolate.rails import Rail
    from shapeblend_cli.model import BoolArray, ComplexArray, FloatArray

SLIGHT = np.radians(1.0)
"""A bend that weighs as much as going astray by `SIDEWAYS`."""

SIDEWAYS = 0.3
"""How far astray, as a share of what is allowed."""

LONGEST_SLIDE = 0.3
"""A cut slides at most so far over the piece it cuts short, as a share of it."""

LEAST_HANDLE, MOST_HANDLE = 0.05, 0.9
"""Length of a handle on a line, as a share of the line: such a line never turns back."""

BLOCK = 32
"""So many cuts are slid together, since that takes the time of their number cubed; blocks do not see each other."""


def _in_blocks(values: FloatArray, rest: float) -> FloatArray:
    """Values in rows of `BLOCK`, the last one filled up."""
    return np.append(values, np.full(-len(values) % BLOCK, rest)).reshape(-1, BLOCK)


def _speeds(segments: ComplexArray, closed: bool) -> tuple[BoolArray, ComplexArray, FloatArray, FloatArray]:
    """The join before each segment: whether it is smooth, its direction, and its handles' lengths in and out."""
    begin, end = cubics.directions(segments)
    turn = begin * np.roll(end, 1).conj()
    inward = np.roll(np.abs(segments[:, 3] - segments[:, 2]), 1)
    outward = np.abs(segments[:, 1] - segments[:, 0])
    smooth = (turn.real >= np.cos(CORNER)) & (inward > 0.0) & (outward > 0.0)
    if not closed:
        smooth[0] = False
    return smooth, begin, np.where(smooth, inward, 1.0), np.where(smooth, outward, 1.0)


def divide_lines(
    segments_a: ComplexArray,
    segments_b: ComplexArray,
    line_a: BoolArray,
    line_b: BoolArray,
    closed: bool,
) -> tuple[ComplexArray, ComplexArray]:
    """Choose the inner points of lines that become curves so that smooth joins stay smooth.

    Parameters
    ----------
    segments_a, segments_b : (s, 4) complex
        Matched pieces of two outlines.
    line_a, line_b : (s,) bool
        Which of them are lines, or points.
    closed : bool

    Returns
    -------
    segments_a, segments_b : (s, 4) complex
        As given, but for the inner points of lines whose other piece is not one. Those stay on the line.
    """
    free = line_a ^ line_b
    if not free.any():
        return segments_a, segments_b
    even_a = _as_uneven_as(segments_a, segments_b, line_a & free)
    even_b = _as_uneven_as(segments_b, segments_a, line_b & free)
    smooth_a, _, in_a, out_a = _speeds(even_a, closed)
    smooth_b, _, in_b, out_b = _speeds(even_b, closed)
    excess = np.where(smooth_a & smooth_b, np.log(in_a * out_b / (out_a * in_b)), 0.0)
    # Where both pieces at a join can give way, each takes half.
    share = np.exp(excess / np.maximum(1, free.astype(np.intp) + np.roll(free, 1)))
    following = np.roll(share, -1)
    return (
        _divided(even_a, line_a & free, share, 1.0 / following),
        _divided(even_b, line_b & free, 1.0 / share, following),
    )


def _as_uneven_as(segments: ComplexArray, others: ComplexArray, lines: BoolArray) -> ComplexArray:
    """Lines divided so that each goes as fast at its ends, for its length, as the curve it is matched with.

    Then both are at the same share of their lengths at about the same time, as the polygons are.
    """
    legs = np.abs(np.diff(others[lines], axis=1))
    chord = np.abs(others[lines, 3] - others[lines, 0])
    length = 0.5 * (legs.sum(axis=1) + chord)
    length = np.where(length > 0.0, length, 1.0)
    found = segments.copy()
    start, end = segments[lines, 0], segments[lines, 3]
    found[lines, 1] = start + np.clip(legs[:, 0] / length, LEAST_HANDLE, MOST_HANDLE) * (end - start)
    found[lines, 2] = end - np.clip(legs[:, 2] / length, LEAST_HANDLE, MOST_HANDLE) * (end - start)
    return found


def _divided(
    segments: ComplexArray, lines: BoolArray, outward: FloatArray, inward: FloatArray
) -> ComplexArray:
    """Lines with their handles so many times as long, within bounds."""
    found = segments.copy()
    start, end = segments[lines, 0], segments[lines, 3]
    chord = end - start
    whole = np.where(chord == 0.0, 1.0, np.abs(chord))
    head = np.abs(segments[lines, 1] - start) / whole * outward[lines]
    tail = np.abs(end - segments[lines, 2]) / whole * inward[lines]
    found[lines, 1] = start + np.clip(head, LEAST_HANDLE, MOST_HANDLE) * chord
    found[lines, 2] = end - np.clip(tail, LEAST_HANDLE, MOST_HANDLE) * chord
    return found


def slides(a: Rail, b: Rail, cuts: FloatArray, loose: BoolArray, distance: float) -> FloatArray:
    """How far to slide cuts for joins to bend less: one step of damped least squares.

    Of a cut at a node of one outline the place on the other one slides; a cut at nodes of both cannot. The bend at half
    time is, to first order, a weight times the logarithm of ``in_a * out_b / (out_a * in_b)``, and handles are as
    long as the piece in its segment's parameter; so each join depends on its own cut and the two beside it.

    Parameters
    ----------
    a, b : Rail
    cuts : (s + 1, 2) float
        Places; those of closed outlines end where they began.
    loose : (s + 1,) bool
        Which cuts may slide.
    distance : float
        How far the in-between may go astray, in the drawing's unit.

    Returns
    -------
    (s + 1, 2) float
        To be added to the places.
    """
    moves = np.zeros_like(cuts)
    numbers = np.arange(len(cuts) - 1)
    found = [one.parts(cuts[:, side]) for side, one in enumerate((a, b))]
    spans = np.stack([end - start for _, start, end in found])
    real = (spans > 1e-9).all(axis=0)
    line_a, line_b = (one.straight[segment] for one, (segment, _, _) in zip((a, b), found, strict=True))
    (smooth_a, along_a, in_a, out_a), (smooth_b, along_b, in_b, out_b) = (
        _speeds(cubics.pieces(one.segments[segment], start, end), a.closed)
        for one, (segment, start, end) in zip((a, b), found, strict=True)
    )
    smooth = smooth_a & smooth_b & real & np.roll(real, 1)
    # Lines that become curves are divided as their joins need, so these bend in no case.
    free = line_a ^ line_b
    bends = smooth & ~free & ~np.roll(free, 1)
    node_a, node_b = a.flag(a.node, cuts[:-1, 0]), b.flag(b.node, cuts[:-1, 1])
    movable = loose[:-1] & smooth & ~(node_a & node_b)
    if not (bends.any() and movable.any()):
        return moves

    excess = np.log(in_a * out_b / (out_a * in_b))
    turn = np.angle(along_b * along_a.conj())
    ratio = np.sqrt(in_b * out_b / (in_a * out_a))
    bend = ratio * np.abs(np.sin(turn)) / np.maximum(1.0 + ratio**2 + 2.0 * ratio * np.cos(turn), 1e-2)
    weight = np.where(bends, bend, 0.0) / SLIGHT
    middle = np.angle(1.0 + ratio * np.exp(1j * turn))  # the in-between's direction, from A's

    side = np.where(node_b & ~node_a, 0, 1)
    sign = np.where(side == 0, 1.0, -1.0)
    after = np.where(smooth, spans[side, numbers], 1.0)
    before = np.where(smooth, spans[side, numbers - 1], 1.0)
    shorter = np.minimum(before, after)
    speed = 3.0 * np.where(side == 0, out_a, out_b) / after
    sideways = 0.5 * speed * np.abs(np.sin(np.where(side == 0, middle, turn - middle)))
    stiffness = (sideways / (SIDEWAYS * distance)) ** 2 + (2.0 / shorter) ** 2
    steps = np.diff(cuts, axis=0)
    # A column is what the slide of a cut does to its own join and to those before and after it.
    own, earlier, later = (
        _in_blocks(np.where(movable, sign * change, 0.0), 0.0)
        for change in (1.0 / before + 1.0 / after, -1.0 / before, -1.0 / after)
    )
    k = np.arange(BLOCK)
    matrix = np.zeros((len(own), BLOCK, BLOCK))
    matrix[:, k, k] = own
    matrix[:, k[:-1], k[1:]] = earlier[:, 1:]
    matrix[:, k[1:], k[:-1]] = later[:, :-1]
    matrix *= _in_blocks(weight, 0.0)[:, :, None]
    across = np.swapaxes(matrix, 1, 2)
    normal = across @ matrix
    normal[:, k, k] += _in_blocks(stiffness, 1.0)
    wanted = across @ _in_blocks(-weight * excess, 0.0)[:, :, None]
    slide = np.linalg.solve(normal, wanted).ravel()[: len(numbers)]
    slide = np.clip(slide, -LONGEST_SLIDE * shorter, LONGEST_SLIDE * shorter)
    # From parameters to places, by the mean density of vertices on the piece that becomes shorter.
    density = np.where(slide > 0.0, steps[numbers, side] / after, steps[numbers - 1, side] / before)
    moves[numbers, side] = np.where(movable, slide * density, 0.0)
    if a.closed:
        moves[-1] = moves[0]
    return moves
