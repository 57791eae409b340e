"""The graph of all correspondences, and the least-work paths through it.

Section 4 of Sederberg and Greenwood, "A Physically Based Approach to 2-D Shape Blending", Computer
Graphics 26(2), 1992 (SIGGRAPH '92). This file is compiled by Cython and runs uncompiled as well.

A dot [i, j] says that vertex i of the first polygon corresponds to vertex j of the second. The three
work values of a dot, W-left, W-up and W-diagonal in eqs (20)-(22), belong to the step that led to the dot:
East (i + 1), South (j + 1) or Southeast (both). Work is added in the order of the path: the bend at
a dot is charged on leaving it, when both of its steps are known.

The graph of closed polygons is periodic: dot [i + m, j] is dot [i, j], and so is [i, j + n]. A closed path
leaves column 0 in row j and meets column m in row j + n. Rows are counted on without end; the tables
are read modulo n.

Departures
----------
* Eqs (20)-(22) read literally make every first step infinite, because no dot comes before [0, 0], and they
  never charge the angle there. Here a path starts in a *state*, a dot together with the step that led
  to it, and a closed path has to end in the state it started from.
* No back-pointers are followed per step direction: one byte a dot says, for each of the three
  steps out of it, which step in was the best (two bits are enough).
"""

from __future__ import annotations

try:
    import cython
except ImportError:  # Cython is needed to build, not to run
    from shapeblend_cli import _cython as cython

COMPILED = cython.compiled

INFINITY = cython.declare(cython.double, float("inf"))

# Steps into and out of a dot, and the bends between them: as in `work`.
EAST = cython.declare(cython.int, 0)
SOUTH = cython.declare(cython.int, 1)
SOUTHEAST = cython.declare(cython.int, 2)
EE = cython.declare(cython.int, 0)
ED = cython.declare(cython.int, 1)
DE = cython.declare(cython.int, 2)
SS = cython.declare(cython.int, 3)
SD = cython.declare(cython.int, 4)
DS = cython.declare(cython.int, 5)
DD = cython.declare(cython.int, 6)

# The parents of a dot in one byte: the step in that is best for each step out.
EAST_CAME_DIAGONALLY = cython.declare(cython.int, 1)  # else by East
SOUTH_CAME_DIAGONALLY = cython.declare(cython.int, 2)  # else by South
SOUTHEAST_CAME_SHIFT = cython.declare(cython.int, 2)  # two bits: EAST, SOUTH or SOUTHEAST


@cython.boundscheck(False)
@cython.wraparound(False)
@cython.cdivision(True)
def cost_to_go(
    east: cython.double[::1],
    south: cython.double[::1],
    southeast: cython.double[:, ::1],
    bends: cython.double[:, :, ::1],
    first_sink: cython.Py_ssize_t,
    to_go: cython.double[:, :, ::1],
) -> None:
    """Least work from every state to the nearest sink, from the last column backwards.

    Parameters
    ----------
    east, south, southeast, bends : arrays
        The tables of `work.Tables`.
    first_sink : int
        Sinks are the dots of the last column from this row on. A path ends where it meets the last column.
    to_go : (columns, rows, 3) float
        Overwritten: the work from a dot onwards, the bend at the dot included, by the step that led to
        it. Column c is vertex ``c mod m``, row r vertex ``r mod n``. Infinite where no path leads to a sink.
    """
    columns: cython.Py_ssize_t = to_go.shape[0]
    rows: cython.Py_ssize_t = to_go.shape[1]
    m: cython.Py_ssize_t = bends.shape[0]
    n: cython.Py_ssize_t = bends.shape[1]
    c: cython.Py_ssize_t
    r: cython.Py_ssize_t
    i: cython.Py_ssize_t
    j: cython.Py_ssize_t
    e: cython.double
    s: cython.double
    d: cython.double
    south_of_here: cython.double
    southeast_of_here: cython.double

    for r in range(rows):
        to_go[columns - 1, r, EAST] = 0.0 if r >= first_sink else INFINITY
        to_go[columns - 1, r, SOUTH] = INFINITY
        to_go[columns - 1, r, SOUTHEAST] = 0.0 if r >= first_sink else INFINITY

    for c in range(columns - 2, -1, -1):
        i = c % m
        j = (rows - 1) % n
        south_of_here = INFINITY
        southeast_of_here = INFINITY
        for r in range(rows - 1, -1, -1):
            # What each step out of the dot costs from here on, the bend at the dot apart.
            e = east[i] + to_go[c + 1, r, EAST]
            s = south[j] + south_of_here
            d = southeast[i, j] + southeast_of_here
            southeast_of_here = to_go[c + 1, r, SOUTHEAST]
            south_of_here = min(bends[i, j, SS] + s, bends[i, j, SD] + d)
            to_go[c, r, EAST] = min(bends[i, j, EE] + e, bends[i, j, ED] + d)
            to_go[c, r, SOUTH] = south_of_here
            to_go[c, r, SOUTHEAST] = min(min(bends[i, j, DE] + e, bends[i, j, DS] + s), bends[i, j, DD] + d)
            j -= 1
            if j < 0:
                j = n - 1


@cython.boundscheck(False)
@cython.wraparound(False)
@cython.cdivision(True)
def sweep(
    east: cython.double[::1],
    south: cython.double[::1],
    southeast: cython.double[:, ::1],
    bends: cython.double[:, :, ::1],
    low: cython.Py_ssize_t[::1],
    high: cython.Py_ssize_t[::1],
    last_source: cython.Py_ssize_t,
    source: cython.double[::1],
    open_wires: cython.bint,
    to_go: cython.double[:, :, ::1],
    bound: cython.double,
    left: cython.double[:, ::1],
    parents: cython.uchar[:, ::1],
    ends: cython.double[:, ::1],
) -> None:
    """Least work to every state from any source, eqs (20)-(22), column by column.

    Parameters
    ----------
    east, south, southeast, bends : arrays
        The tables of `work.Tables`.
    low, high : (columns,) int
        First and last row of each column; neither ever falls. Column c is vertex ``c mod m``, row r
        vertex ``r mod n``.
    last_source : int
        Sources are the dots of column 0 from row ``low[0]`` to this one.
    source : (3,) float
        Work at a source by the step that led to it; infinite forbids the step.
    open_wires : bool
        There is one source, and no bend is charged there.
    to_go : (columns, rows, 3) float, or empty
        Lower bounds on the work from each state onwards, as by `cost_to_go`; its row 0 is row 0.
    bound : float
        With `to_go`: states that no path of less than this work goes through are left out.
    left : (4, high[-1] - low[0] + 1) float
        Overwritten, room for two columns: the work of having left a dot by East and by Southeast.
    parents : (columns, at least max(high - low) + 1) uchar
        Overwritten where a path can come by: the best steps in, row ``low[c]`` first.
    ends : (at least high[-1] - low[-1] + 1, 3) float
        Overwritten: work at the last column by the step in, row ``low[-1]`` first. South steps are made
        there only where the path may have begun in the middle of the same run.
    """
    columns: cython.Py_ssize_t = low.shape[0]
    m: cython.Py_ssize_t = bends.shape[0]
    n: cython.Py_ssize_t = bends.shape[1]
    pruning: cython.bint = to_go.shape[0] > 0
    south_at_end: cython.bint = open_wires or source[SOUTH] < INFINITY
    origin: cython.Py_ssize_t = low[0]
    c: cython.Py_ssize_t
    r: cython.Py_ssize_t
    i: cython.Py_ssize_t
    j: cython.Py_ssize_t
    # Rows of the last column that a path can come from, and of this one.
    first: cython.Py_ssize_t = origin
    last: cython.Py_ssize_t = last_source
    new_first: cython.Py_ssize_t
    new_last: cython.Py_ssize_t
    was: cython.Py_ssize_t = 0
    now: cython.Py_ssize_t = 2
    w_e: cython.double
    w_s: cython.double
    w_d: cython.double
    by_e: cython.double
    by_s: cython.double
    by_d: cython.double
    left_south: cython.double
    came: cython.int

    for r in range(ends.shape[0]):
        ends[r, EAST] = INFINITY
        ends[r, SOUTH] = INFINITY
        ends[r, SOUTHEAST] = INFINITY

    for c in range(columns):
        i = c % m
        new_first = -1
        new_last = -1
        left_south = INFINITY
        r = max(low[c], first)
        j = r % n
        while r <= high[c]:
            w_e = INFINITY
            w_s = left_south
            w_d = INFINITY
            if c == 0:
                if r <= last:
                    w_e = source[EAST]
                    w_s = min(w_s, source[SOUTH])
                    w_d = source[SOUTHEAST]
            else:
                if r <= last:
                    w_e = left[was, r - origin]
                if first < r <= last + 1:
                    w_d = left[was + 1, r - 1 - origin]
                if c == columns - 1 and not south_at_end:
                    w_s = INFINITY
            if pruning:
                if w_e + to_go[c, r, EAST] >= bound:
                    w_e = INFINITY
                if w_s + to_go[c, r, SOUTH] >= bound:
                    w_s = INFINITY
                if w_d + to_go[c, r, SOUTHEAST] >= bound:
                    w_d = INFINITY
            if w_e < INFINITY or w_s < INFINITY or w_d < INFINITY:
                if new_first < 0:
                    new_first = r
                new_last = r
            elif r > last:
                break  # nothing comes to the rows below either

            came = 0
            # Leaving East, after East or Southeast.
            by_e = w_e + bends[i, j, EE]
            by_d = w_d + bends[i, j, DE]
            if by_d < by_e:
                by_e = by_d
                came |= EAST_CAME_DIAGONALLY
            left[now, r - origin] = by_e + east[i]
            # Leaving South, after South or Southeast.
            by_s = w_s + bends[i, j, SS]
            by_d = w_d + bends[i, j, DS]
            if by_d < by_s:
                by_s = by_d
                came |= SOUTH_CAME_DIAGONALLY
            left_south = by_s + south[j]
            # Leaving Southeast, after any step.
            by_e = w_e + bends[i, j, ED]
            by_s = w_s + bends[i, j, SD]
            by_d = w_d + bends[i, j, DD]
            if by_d <= by_e and by_d <= by_s:
                came |= SOUTHEAST << SOUTHEAST_CAME_SHIFT
            elif by_s < by_e:
                by_d = by_s
                came |= SOUTH << SOUTHEAST_CAME_SHIFT
            else:
                by_d = by_e
            left[now + 1, r - origin] = by_d + southeast[i, j]
            if open_wires and c == 0 and r == origin:  # no angle, whatever the step
                left[now, r - origin] = east[i]
                left_south = south[j]
                left[now + 1, r - origin] = southeast[i, j]
            parents[c, r - low[c]] = came

            if c == columns - 1:
                ends[r - low[c], EAST] = w_e
                ends[r - low[c], SOUTH] = w_s
                ends[r - low[c], SOUTHEAST] = w_d
            r += 1
            j += 1
            if j == n:
                j = 0
        if new_first < 0:
            return  # no path costs less than the bound
        first = new_first
        last = new_last
        was, now = now, was


@cython.boundscheck(False)
@cython.wraparound(False)
def backtrack(
    parents: cython.uchar[:, ::1],
    low: cython.Py_ssize_t[::1],
    row: cython.Py_ssize_t,
    step: cython.int,
) -> tuple[list[tuple[int, int]], int]:
    """Follow the parents from a state of the last column back to its source.

    Parameters
    ----------
    parents, low : arrays
        As filled in by `sweep`.
    row : int
        Row of the end of the path.
    step : int
        The step that led there.

    Returns
    -------
    dots : list of (int, int)
        Columns and rows from the source to the end, both included.
    step : int
        The step that led to the source.
    """
    c: cython.Py_ssize_t = low.shape[0] - 1
    r: cython.Py_ssize_t = row
    came: cython.int
    dots: list[tuple[int, int]] = [(c, r)]
    while c > 0 or (step == SOUTH and r > low[0]):
        if step != SOUTH:
            c -= 1
        if step != EAST:
            r -= 1
        came = parents[c, r - low[c]]
        if step == EAST:
            step = SOUTHEAST if came & EAST_CAME_DIAGONALLY else EAST
        elif step == SOUTH:
            step = SOUTHEAST if came & SOUTH_CAME_DIAGONALLY else SOUTH
        else:
            step = came >> SOUTHEAST_CAME_SHIFT
        dots.append((c, r))
    dots.reverse()
    return dots, step
