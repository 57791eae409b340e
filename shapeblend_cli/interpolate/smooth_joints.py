"""Joints that are smooth in both drawings, and stay smooth in between.

With control points on straight paths the handles on either side of a joint are at time t
``(1 - t) * in_a * u + t * in_b * v`` and ``(1 - t) * out_a * u + t * out_b * v``, for handle lengths `in` and `out`
and the drawings' directions u and v. They are parallel, and the joint stays smooth, if u is v or if
``in_a / out_a = in_b / out_b``: if both drawings change speed alike at the joint. Two choices leave both drawings as
they are:

- the division of a line that becomes a curve: its inner points may lie anywhere on it;
- the position on a segment with which the other drawing's node is matched. That slides the correspondence, so it is
  weighed against the sideways deviation of the in-between.

The rest of a bend is mostly the polygons' own: their in-betweens bend as well where, from one edge to the next, the
vertices of one drawing suddenly follow each other faster, compared with the vertices of the other.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.geometry import cubics
from shapeblend_cli.interpolate.parametrization import CORNER, ContourParameter
from shapeblend_cli.model.arrays import rolled

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import BoolArray, ComplexArray, FloatArray

SLIGHT_BEND = np.radians(1.0)
"""Bend that weighs as much as a deviation of `SIDEWAYS`, in radians."""

SIDEWAYS = 0.3
"""Deviation that weighs as much as a slight bend, as a share of the tolerance."""

LONGEST_SLIDE = 0.3
"""Maximum slide of a cut, as a share of the piece that becomes shorter."""

LEAST_HANDLE = 0.05
"""Minimum length of a handle on a line, as a share of the line."""

MOST_HANDLE = 0.9
"""Maximum length of a handle on a line, as a share of the line: such a line never turns back."""

BLOCK = 32
"""Number of cuts that slide together, independently of other blocks: this takes the time of their number cubed."""


class _Joints(NamedTuple):
    """The joint before each segment, (s,) each."""

    smooth: BoolArray
    direction: ComplexArray
    inward: FloatArray  # length of the handle before the joint
    outward: FloatArray  # length of the handle after the joint


def _joints(segments: ComplexArray, closed: bool) -> _Joints:
    begin, end = cubics.directions(segments)
    turn = begin * rolled(end, 1).conj()
    inward = rolled(np.abs(segments[:, 3] - segments[:, 2]), 1)
    outward = np.abs(segments[:, 1] - segments[:, 0])
    smooth = (turn.real >= np.cos(CORNER)) & (inward > 0.0) & (outward > 0.0)
    if not closed:
        smooth[0] = False
    return _Joints(smooth, begin, np.where(smooth, inward, 1.0), np.where(smooth, outward, 1.0))


def _excess(a: _Joints, b: _Joints) -> FloatArray:
    """Return the differences of both changes of speed, as logarithms; 0 keeps a joint smooth."""
    return np.log(a.inward * b.outward / (a.outward * b.inward))


def divide_lines(
    segments_a: ComplexArray,
    segments_b: ComplexArray,
    line_a: BoolArray,
    line_b: BoolArray,
    closed: bool,
) -> tuple[ComplexArray, ComplexArray]:
    """Return matched pieces of two contours, with lines divided so that smooth joints stay smooth.

    Only the inner points of lines that become curves change; they stay on the line.

    Parameters
    ----------
    segments_a, segments_b : (s, 4) complex
    line_a, line_b : (s,) bool
        Pieces that are lines, or points.
    closed : bool
    """
    free = line_a ^ line_b
    if not free.any():
        return segments_a, segments_b
    # A's pieces that are free, then B's: all are worked on at once, each beside what it is matched with.
    on_a, on_b = (line_a & free).nonzero()[0], (line_b & free).nonzero()[0]
    lines = np.concatenate([segments_a[on_a], segments_b[on_b]])
    _match_speeds(lines, np.concatenate([segments_b[on_a], segments_a[on_b]]))
    even_a, even_b = segments_a.copy(), segments_b.copy()
    even_a[on_a], even_b[on_b] = lines[: len(on_a)], lines[len(on_a) :]
    a, b = _joints(even_a, closed), _joints(even_b, closed)
    excess = np.where(a.smooth & b.smooth, _excess(a, b), 0.0)
    # If both pieces at a joint can change, each takes half.
    share = np.exp(excess / np.maximum(1, free.astype(np.intp) + rolled(free, 1)))
    inverse = 1.0 / share
    outward = np.concatenate([share[on_a], inverse[on_b]])
    inward = np.concatenate([rolled(inverse, -1)[on_a], rolled(share, -1)[on_b]])
    _scale_handles(lines, outward, inward)
    even_a[on_a], even_b[on_b] = lines[: len(on_a)], lines[len(on_a) :]
    return even_a, even_b


def _match_speeds(lines: ComplexArray, matched: ComplexArray) -> None:
    """Divide lines so that each is as fast at its ends, for its length, as the curve it is matched with.

    Then both have passed the same share of their lengths at about the same time, as the polygons have.
    """
    legs = np.abs(matched[:, 1:] - matched[:, :-1])
    length = 0.5 * (legs.sum(axis=1) + np.abs(matched[:, 3] - matched[:, 0]))
    length[length <= 0.0] = 1.0
    _set_handles(lines, legs[:, 0] / length, legs[:, 2] / length)


def _scale_handles(lines: ComplexArray, outward: FloatArray, inward: FloatArray) -> None:
    """Multiply the lengths of the handles of lines."""
    steps = np.abs(lines[:, [1, 3, 3]] - lines[:, [0, 2, 0]])
    whole = steps[:, 2]
    whole[whole == 0.0] = 1.0
    _set_handles(lines, steps[:, 0] / whole * outward, steps[:, 1] / whole * inward)


def _set_handles(lines: ComplexArray, head: FloatArray, tail: FloatArray) -> None:
    """Give lines handles of these lengths, as shares of the line."""
    start, end = lines[:, 0], lines[:, 3]
    whole = end - start
    lines[:, 1] = start + np.minimum(np.maximum(head, LEAST_HANDLE), MOST_HANDLE) * whole
    lines[:, 2] = end - np.minimum(np.maximum(tail, LEAST_HANDLE), MOST_HANDLE) * whole


def slide_cuts(
    a: ContourParameter, b: ContourParameter, cuts: FloatArray, loose: BoolArray, distance: float
) -> FloatArray:
    """Slide cuts so that joints bend less: one step of damped least squares.

    At a node of one contour, the position on the other slides; a cut at nodes of both cannot. The bend at half time is,
    to first order, a weight times the logarithm of ``in_a * out_b / (out_a * in_b)``, and the length of a handle is
    proportional to the piece in its segment's parameter; so each joint depends on its own cut and on the two beside it.

    Parameters
    ----------
    a, b : ContourParameter
    cuts : (s + 1, 2) float
        Positions; on closed contours the last is the first, once round.
    loose : (s + 1,) bool
        Cuts that may slide.
    distance : float
        Maximum deviation of the in-between, in the drawing's unit.
    """
    numbers, steps = np.arange(len(cuts) - 1), np.diff(cuts, axis=0)
    parts = [one.pieces(cuts[:, side]) for side, one in enumerate((a, b))]
    spans = np.stack([end - start for _, start, end in parts])
    real = (spans > 1e-9).all(axis=0)
    joints_a, joints_b = (
        _joints(cubics.pieces(one.segments[segment], start, end), a.closed)
        for one, (segment, start, end) in zip((a, b), parts, strict=True)
    )
    smooth = joints_a.smooth & joints_b.smooth & real & rolled(real, 1)
    # Lines that become curves are divided so that their joints do not bend.
    free = a.straight[parts[0][0]] ^ b.straight[parts[1][0]]
    bends = smooth & ~free & ~rolled(free, 1)
    node_a, node_b = a.is_node(cuts[:-1, 0]), b.is_node(cuts[:-1, 1])
    movable = loose[:-1] & smooth & ~(node_a & node_b)
    if not (bends.any() and movable.any()):
        return cuts

    turn, middle, bend = _bend(joints_a, joints_b)
    side = np.where(node_b & ~node_a, 0, 1)
    sign = np.where(side == 0, 1.0, -1.0)
    after = np.where(smooth, spans[side, numbers], 1.0)
    before = np.where(smooth, spans[side, numbers - 1], 1.0)
    shorter = np.minimum(before, after)
    speed = 3.0 * np.where(side == 0, joints_a.outward, joints_b.outward) / after
    sideways = 0.5 * speed * np.abs(np.sin(np.where(side == 0, middle, turn - middle)))
    stiffness = (sideways / (SIDEWAYS * distance)) ** 2 + (2.0 / shorter) ** 2
    # The effects of a slide on the joint itself, and on the joints before and after it.
    effects = [
        np.where(movable, sign * change, 0.0)
        for change in (1.0 / before + 1.0 / after, -1.0 / before, -1.0 / after)
    ]
    weight = np.where(bends, bend, 0.0) / SLIGHT_BEND
    slide = _least_bends(effects, weight, _excess(joints_a, joints_b), stiffness)
    slide = np.clip(slide, -LONGEST_SLIDE * shorter, LONGEST_SLIDE * shorter)
    # From parameters to positions, by the mean density of vertices on the piece that becomes shorter.
    density = np.where(slide > 0.0, steps[numbers, side] / after, steps[numbers - 1, side] / before)
    moves = np.zeros_like(cuts)
    moves[numbers, side] = np.where(movable, slide * density, 0.0)
    if a.closed:
        moves[-1] = moves[0]
    return cuts + moves


def _bend(a: _Joints, b: _Joints) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return the directions at half time and of B, as angles from A's, and the bend for each unit of excess."""
    turn = np.angle(b.direction * a.direction.conj())
    ratio = np.sqrt(b.inward * b.outward / (a.inward * a.outward))
    bend = ratio * np.abs(np.sin(turn)) / np.maximum(1.0 + ratio**2 + 2.0 * ratio * np.cos(turn), 1e-2)
    return turn, np.angle(1.0 + ratio * np.exp(1j * turn)), bend


def _least_bends(
    effects: Sequence[FloatArray], weight: FloatArray, excess: FloatArray, stiffness: FloatArray
) -> FloatArray:
    """Return the slides that leave the least bends, by damped least squares in blocks, (s,) float."""
    count = len(weight)
    padded = np.zeros((6, count + -count % BLOCK))
    padded[5, count:] = 1.0
    for row, values in zip(padded, (*effects, weight, -weight * excess, stiffness), strict=True):
        row[:count] = values
    own, earlier, later, rows, wanted, damping = padded.reshape(6, -1, BLOCK)
    k = np.arange(BLOCK)
    matrix = np.zeros((len(own), BLOCK, BLOCK))
    matrix[:, k, k] = own
    matrix[:, k[:-1], k[1:]] = earlier[:, 1:]
    matrix[:, k[1:], k[:-1]] = later[:, :-1]
    matrix *= rows[:, :, None]
    across = np.swapaxes(matrix, 1, 2)
    normal = across @ matrix
    normal[:, k, k] += damping
    slides = np.linalg.solve(normal, across @ wanted[:, :, None]).ravel()
    return np.asarray(slides[:count], np.float64)
