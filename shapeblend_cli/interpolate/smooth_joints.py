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

This file is compiled by Cython and runs uncompiled as well.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.geometry import cubics
from shapeblend_cli.interpolate.parametrization import CORNER

try:
    import cython
except ImportError:  # Cython is needed to build, not to run
    from shapeblend_cli import _cython as cython

if cython.compiled:
    from cython.cimports.libc.math import atan2, cos, exp, fabs, log, sin, sqrt
else:
    from math import atan2, cos, exp, fabs, log, sin, sqrt

if TYPE_CHECKING:
    from shapeblend_cli.interpolate.parametrization import ContourParameter
    from shapeblend_cli.model import BoolArray, ComplexArray, FloatArray

COMPILED = cython.compiled

cython.declare(SLIGHT_BEND=cython.double, SIDEWAYS=cython.double, LONGEST_SLIDE=cython.double)
SLIGHT_BEND = float(np.radians(1.0))
"""Bend that weighs as much as a deviation of `SIDEWAYS`, in radians."""

SIDEWAYS = 0.3
"""Deviation that weighs as much as a slight bend, as a share of the tolerance."""

LONGEST_SLIDE = 0.3
"""Maximum slide of a cut, as a share of the piece that becomes shorter."""

cython.declare(LEAST_HANDLE=cython.double, MOST_HANDLE=cython.double, LEAST_SPAN=cython.double)
LEAST_HANDLE = 0.05
"""Minimum length of a handle on a line, as a share of the line."""

MOST_HANDLE = 0.9
"""Maximum length of a handle on a line, as a share of the line: such a line never turns back."""

LEAST_SPAN = 1e-9
"""Minimum extent of a piece that is more than a point, in the parameter of its segment."""

cython.declare(BLOCK=cython.Py_ssize_t)
BLOCK = 32
"""Number of cuts that slide together, independently of other blocks."""

STRAIGHT_ON = cython.declare(cython.double, float(np.cos(CORNER)))
"""Minimum cosine of the turn at a smooth joint."""


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
    both = np.empty((2, *segments_a.shape), np.complex128)
    both[0], both[1] = segments_a, segments_b
    are_lines = np.empty((2, len(line_a)), np.uint8)
    are_lines[0], are_lines[1] = line_a, line_b
    places = both.view(np.float64)
    _match_speeds(places, are_lines)
    _keep_smooth(places, are_lines, _ways(both), closed, np.empty((2, len(line_a))))
    return both[0], both[1]


def _ways(both: ComplexArray) -> FloatArray:
    """Return the directions at the starts and the ends of the pieces of A, then at those of B, (4, s, 2)."""
    ways = np.empty((4, both.shape[1]), np.complex128)
    for side in (0, 1):
        ways[2 * side], ways[2 * side + 1] = cubics.directions(both[side])
    return ways.view(np.float64).reshape(4, -1, 2)


@cython.cfunc
@cython.inline
@cython.exceptval(check=False)
@cython.boundscheck(False)
@cython.wraparound(False)
def _between(
    places: cython.const[cython.double][:, :, ::1],
    side: cython.Py_ssize_t,
    k: cython.Py_ssize_t,
    first: cython.Py_ssize_t,
    last: cython.Py_ssize_t,
) -> cython.double:
    """Return the distance between two control points of a segment."""
    x: cython.double = places[side, k, 2 * last] - places[side, k, 2 * first]
    y: cython.double = places[side, k, 2 * last + 1] - places[side, k, 2 * first + 1]
    return sqrt(x * x + y * y)


@cython.cfunc
@cython.inline
@cython.exceptval(check=False)
@cython.boundscheck(False)
@cython.wraparound(False)
def _set_handles(
    places: cython.double[:, :, ::1],
    side: cython.Py_ssize_t,
    k: cython.Py_ssize_t,
    head: cython.double,
    tail: cython.double,
) -> cython.void:
    """Give a line handles of these lengths, as shares of the line."""
    head, tail = (
        min(max(head, LEAST_HANDLE), MOST_HANDLE),
        min(max(tail, LEAST_HANDLE), MOST_HANDLE),
    )
    i: cython.Py_ssize_t
    for i in range(2):
        whole: cython.double = places[side, k, 6 + i] - places[side, k, i]
        places[side, k, 2 + i] = places[side, k, i] + head * whole
        places[side, k, 4 + i] = places[side, k, 6 + i] - tail * whole


@cython.boundscheck(False)
@cython.wraparound(False)
@cython.cdivision(True)
def _match_speeds(places: cython.double[:, :, ::1], lines: cython.const[cython.uchar][:, ::1]) -> None:
    """Divide lines that become curves so that each is as fast at its ends, for its length, as the curve.

    Then both have passed the same share of their lengths at about the same time, as the polygons have.
    """
    k: cython.Py_ssize_t
    for k in range(lines.shape[1]):
        if lines[0, k] == lines[1, k]:
            continue
        curve: cython.Py_ssize_t = 1 if lines[0, k] else 0
        first: cython.double = _between(places, curve, k, 0, 1)
        last: cython.double = _between(places, curve, k, 2, 3)
        legs: cython.double = first + _between(places, curve, k, 1, 2) + last
        length: cython.double = 0.5 * (legs + _between(places, curve, k, 0, 3))
        if length <= 0.0:
            length = 1.0
        _set_handles(places, 1 - curve, k, first / length, last / length)


@cython.cfunc
@cython.inline
@cython.exceptval(check=False)
@cython.boundscheck(False)
@cython.wraparound(False)
def _is_smooth(
    places: cython.const[cython.double][:, :, ::1],
    ways: cython.const[cython.double][:, :, ::1],
    side: cython.Py_ssize_t,
    k: cython.Py_ssize_t,
    before: cython.Py_ssize_t,
) -> cython.bint:
    """Return whether the joint of a segment with the one before it is smooth; ways are as in `_ways`."""
    start: cython.Py_ssize_t = 2 * side
    along: cython.double = (
        ways[start, k, 0] * ways[start + 1, before, 0] + ways[start, k, 1] * ways[start + 1, before, 1]
    )
    if not along >= STRAIGHT_ON:
        return False
    return _between(places, side, before, 2, 3) > 0.0 and _between(places, side, k, 0, 1) > 0.0


@cython.cfunc
@cython.inline
@cython.exceptval(check=False)
@cython.cdivision(True)
def _excess(
    places: cython.const[cython.double][:, :, ::1], k: cython.Py_ssize_t, before: cython.Py_ssize_t
) -> cython.double:
    """Return the difference of both changes of speed at a joint, as a logarithm; 0 keeps it smooth."""
    inward: cython.double = _between(places, 0, before, 2, 3) * _between(places, 1, k, 0, 1)
    return log(inward / (_between(places, 0, k, 0, 1) * _between(places, 1, before, 2, 3)))


@cython.boundscheck(False)
@cython.wraparound(False)
@cython.cdivision(True)
def _keep_smooth(
    places: cython.double[:, :, ::1],
    lines: cython.const[cython.uchar][:, ::1],
    ways: cython.const[cython.double][:, :, ::1],
    closed: cython.bint,
    shares: cython.double[:, ::1],
) -> None:
    """Lengthen and shorten the handles of lines that become curves so that smooth joints stay smooth.

    If both pieces at a joint can change, each takes half.
    """
    count: cython.Py_ssize_t = lines.shape[1]
    k: cython.Py_ssize_t
    for k in range(count):
        before: cython.Py_ssize_t = k - 1 if k else count - 1
        free: cython.int = (lines[0, k] != lines[1, k]) + (lines[0, before] != lines[1, before])
        excess: cython.double = 0.0
        if free and (k or closed):
            if _is_smooth(places, ways, 0, k, before) and _is_smooth(places, ways, 1, k, before):
                excess = _excess(places, k, before)
        shares[0, k] = exp(excess / max(1, free))
        shares[1, k] = 1.0 / shares[0, k]
    for k in range(count):
        if lines[0, k] == lines[1, k]:
            continue
        side: cython.Py_ssize_t = 0 if lines[0, k] else 1
        whole: cython.double = _between(places, side, k, 0, 3)
        if whole == 0.0:
            whole = 1.0
        after: cython.Py_ssize_t = k + 1 if k + 1 < count else 0
        head: cython.double = _between(places, side, k, 0, 1) / whole * shares[side, k]
        tail: cython.double = _between(places, side, k, 2, 3) / whole * shares[1 - side, after]
        _set_handles(places, side, k, head, tail)


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
    count = len(cuts) - 1
    segments, spans = np.empty((2, count, 4), np.complex128), np.empty((2, count))
    flags = np.empty((4, count), np.uint8)
    lines = []
    for side, one in enumerate((a, b)):
        segments[side], line, spans[side] = one.parts(cuts[:, side], joined=False)
        lines.append(line)
        flags[1 + side] = one.is_node(cuts[:-1, side])
    # Lines that become curves are divided so that their joints do not bend.
    flags[0], flags[3] = lines[0] ^ lines[1], loose[:-1]
    slides = np.zeros((SIDE + 1, count))
    given = segments.view(np.float64), _ways(segments), spans, flags
    if not _weigh(given, a.closed, SIDEWAYS * distance, slides):
        return cuts
    _least_bends(slides, np.empty((5, BLOCK)))
    moved = cuts.copy()
    _slide(slides, cuts, a.closed, moved)
    return moved


cython.declare(OWN=cython.int, EARLIER=cython.int, LATER=cython.int, WEIGHT=cython.int, WANTED=cython.int)
cython.declare(DAMPING=cython.int, BEFORE=cython.int, AFTER=cython.int, SLIDE=cython.int, SIDE=cython.int)
# Rows of what is known of cuts: the effects of a slide on the joint itself and on those before and after it; the weight
# of that joint, and what is wanted of it; what a slide costs; the extents of the pieces before and after the cut; how
# far it slides, in the parameter of a segment; and on which contour.
OWN, EARLIER, LATER, WEIGHT, WANTED, DAMPING, BEFORE, AFTER, SLIDE, SIDE = range(10)


@cython.boundscheck(False)
@cython.wraparound(False)
@cython.cdivision(True)
def _weigh(
    given: tuple[FloatArray, FloatArray, FloatArray, FloatArray],
    closed: cython.bint,
    sideways: cython.double,
    rows: cython.double[:, ::1],
) -> bool:
    """Fill in what is known of each cut; return whether any joint bends, and any cut may slide.

    Given are the pieces of both contours, their directions at starts and ends, their extents in the parameters of
    their segments, and whether a piece is free, a cut at a node of A and of B, and loose.
    """
    places: cython.const[cython.double][:, :, ::1] = given[0]
    ways: cython.const[cython.double][:, :, ::1] = given[1]
    spans: cython.const[cython.double][:, ::1] = given[2]
    flags: cython.const[cython.uchar][:, ::1] = given[3]
    count: cython.Py_ssize_t = spans.shape[1]
    bends_any: cython.bint = False
    slides_any: cython.bint = False
    k: cython.Py_ssize_t
    for k in range(count):
        before: cython.Py_ssize_t = k - 1 if k else count - 1
        rows[DAMPING, k] = rows[BEFORE, k] = rows[AFTER, k] = 1.0
        is_real: cython.bint = (
            min(min(spans[0, k], spans[1, k]), min(spans[0, before], spans[1, before])) > LEAST_SPAN
        )
        if not is_real or not (k or closed):
            continue
        if not (_is_smooth(places, ways, 0, k, before) and _is_smooth(places, ways, 1, k, before)):
            continue
        bends: cython.bint = not (flags[0, k] or flags[0, before])
        slides: cython.bint = flags[3, k] and not (flags[1, k] and flags[2, k])
        if not bends and not slides:
            continue
        # The angles from A's direction to B's, and to that at half time.
        turn: cython.double = atan2(
            ways[2, k, 1] * ways[0, k, 0] - ways[2, k, 0] * ways[0, k, 1],
            ways[2, k, 0] * ways[0, k, 0] + ways[2, k, 1] * ways[0, k, 1],
        )
        out_a: cython.double = _between(places, 0, k, 0, 1)
        out_b: cython.double = _between(places, 1, k, 0, 1)
        in_a: cython.double = _between(places, 0, before, 2, 3)
        in_b: cython.double = _between(places, 1, before, 2, 3)
        ratio: cython.double = sqrt(in_b * out_b / (in_a * out_a))
        if bends:
            bends_any = True
            below: cython.double = max(1.0 + ratio * ratio + 2.0 * ratio * cos(turn), 1e-2)
            rows[WEIGHT, k] = ratio * fabs(sin(turn)) / below / SLIGHT_BEND
            rows[WANTED, k] = -rows[WEIGHT, k] * _excess(places, k, before)
        if slides:
            slides_any = True
            side: cython.Py_ssize_t = 0 if flags[2, k] and not flags[1, k] else 1
            sign: cython.double = -1.0 if side else 1.0
            rows[BEFORE, k], rows[AFTER, k] = spans[side, before], spans[side, k]
            rows[OWN, k] = sign * (1.0 / rows[BEFORE, k] + 1.0 / rows[AFTER, k])
            rows[EARLIER, k], rows[LATER, k] = sign * (-1.0 / rows[BEFORE, k]), sign * (-1.0 / rows[AFTER, k])
            middle: cython.double = atan2(ratio * sin(turn), 1.0 + ratio * cos(turn))
            speed: cython.double = 3.0 * (out_b if side else out_a) / rows[AFTER, k]
            aside: cython.double = 0.5 * speed * fabs(sin(turn - middle if side else middle)) / sideways
            shortest: cython.double = 2.0 / min(rows[BEFORE, k], rows[AFTER, k])
            rows[DAMPING, k] = aside * aside + shortest * shortest
            rows[SIDE, k] = side
    return bends_any and slides_any


@cython.boundscheck(False)
@cython.wraparound(False)
@cython.cdivision(True)
def _least_bends(rows: cython.double[:, ::1], work: cython.double[:, ::1]) -> None:
    """Fill in the slides that leave the least bends, by damped least squares in blocks.

    The normal matrix has two diagonals to either side of its own: it is the product of a unit triangle, a diagonal and
    the triangle turned over.
    """
    count: cython.Py_ssize_t = rows.shape[1]
    first: cython.Py_ssize_t
    i: cython.Py_ssize_t
    k: cython.Py_ssize_t
    for first in range(0, count, BLOCK):
        size: cython.Py_ssize_t = min(BLOCK, count - first)
        for i in range(size):
            k = first + i
            has_next: cython.bint = i + 1 < size
            own: cython.double = rows[OWN, k] * rows[WEIGHT, k]
            above: cython.double = rows[EARLIER, k] * rows[WEIGHT, k - 1] if i else 0.0
            below: cython.double = rows[LATER, k] * rows[WEIGHT, k + 1] if has_next else 0.0
            pivot: cython.double = own * own + above * above + below * below + rows[DAMPING, k]
            value: cython.double = own * rows[WANTED, k]
            beside: cython.double = 0.0
            beyond: cython.double = 0.0
            if i:
                value += above * rows[WANTED, k - 1]
            if has_next:
                value += below * rows[WANTED, k + 1]
                beside = own * (rows[EARLIER, k + 1] * rows[WEIGHT, k]) + below * (
                    rows[OWN, k + 1] * rows[WEIGHT, k + 1]
                )
            if i + 2 < size:
                beyond = below * (rows[EARLIER, k + 2] * rows[WEIGHT, k + 1])
            if i > 0:
                pivot -= work[1, i - 1] * work[1, i - 1] * work[0, i - 1]
                beside -= work[2, i - 1] * work[1, i - 1] * work[0, i - 1]
                value -= work[1, i - 1] * work[3, i - 1]
            if i > 1:
                pivot -= work[2, i - 2] * work[2, i - 2] * work[0, i - 2]
                value -= work[2, i - 2] * work[3, i - 2]
            work[0, i], work[1, i], work[2, i], work[3, i] = pivot, beside / pivot, beyond / pivot, value
        for i in range(size - 1, -1, -1):
            value = work[3, i] / work[0, i]
            if i + 1 < size:
                value -= work[1, i] * work[4, i + 1]
            if i + 2 < size:
                value -= work[2, i] * work[4, i + 2]
            work[4, i] = value
            rows[SLIDE, first + i] = value


@cython.boundscheck(False)
@cython.wraparound(False)
@cython.cdivision(True)
def _slide(
    rows: cython.const[cython.double][:, ::1],
    cuts: cython.const[cython.double][:, :],
    closed: cython.bint,
    moved: cython.double[:, :],
) -> None:
    """Slide cuts.

    From parameters to positions, it goes by the mean density of vertices on the piece that becomes shorter.
    """
    count: cython.Py_ssize_t = rows.shape[1]
    k: cython.Py_ssize_t
    for k in range(count):
        if rows[OWN, k] == 0.0:
            continue
        most: cython.double = LONGEST_SLIDE * min(rows[BEFORE, k], rows[AFTER, k])
        slide: cython.double = min(max(rows[SLIDE, k], -most), most)
        side: cython.Py_ssize_t = 1 if rows[SIDE, k] > 0.0 else 0
        before: cython.Py_ssize_t = k - 1 if k else count - 1
        density: cython.double = (
            (cuts[k + 1, side] - cuts[k, side]) / rows[AFTER, k]
            if slide > 0.0
            else (cuts[before + 1, side] - cuts[before, side]) / rows[BEFORE, k]
        )
        moved[k, side] = cuts[k, side] + slide * density
        if k == 0 and closed:
            moved[count, side] = cuts[count, side] + slide * density
