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

Windows
-------
Only a window of the graph need be stored: column c has the rows ``low[c]`` to ``high[c]``, and they begin at
``place[c]`` of a flat array. Tables have a window of one period, m columns, whose ``low`` is called `origin`;
with n rows a column it is the whole graph. A South step on the first wire's vertex i stretches a
stiffness ``weight[i]`` times (section 6).
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
    southeast: cython.double[::1],
    bends: cython.double[:, ::1],
    weight: cython.double[::1],
    origin: cython.Py_ssize_t[::1],
    place: cython.Py_ssize_t[::1],
    low: cython.Py_ssize_t[::1],
    high: cython.Py_ssize_t[::1],
    first_sink: cython.Py_ssize_t,
    last_sink: cython.Py_ssize_t,
    south_at_end: cython.bint,
    go_place: cython.Py_ssize_t[::1],
    to_go: cython.double[:, ::1],
) -> None:
    """Least work from every state to the nearest sink, from the last column backwards.

    Parameters
    ----------
    east, south, southeast, bends, weight, origin, place : arrays
        The tables of `work.Tables`.
    low, high : (columns,) int
        First and last row of each column; neither ever falls. Column c is vertex ``c mod m``, row r
        vertex ``r mod n``.
    first_sink, last_sink : int
        Sinks are the dots of the last column between these rows. A path ends where it meets one.
    south_at_end : bool
        Paths may go South in the last column.
    go_place : (columns,) int
        Where each column begins in `to_go`.
    to_go : (dots, 3) float
        Overwritten: the work from a dot onwards, the bend at the dot included, by the step that led to
        it. Infinite where no path leads to a sink.
    """
    columns: cython.Py_ssize_t = low.shape[0]
    m: cython.Py_ssize_t = place.shape[0]
    n: cython.Py_ssize_t = south.shape[0]
    c: cython.Py_ssize_t
    r: cython.Py_ssize_t
    i: cython.Py_ssize_t
    j: cython.Py_ssize_t
    k: cython.Py_ssize_t
    t: cython.Py_ssize_t
    here: cython.Py_ssize_t
    beyond: cython.Py_ssize_t
    e: cython.double
    s: cython.double
    d: cython.double
    south_of_here: cython.double
    southeast_of_here: cython.double

    i = (columns - 1) % m
    south_of_here = INFINITY
    for r in range(high[columns - 1], low[columns - 1] - 1, -1):
        here = go_place[columns - 1] + r - low[columns - 1]
        if r > last_sink:
            to_go[here, EAST] = INFINITY
            to_go[here, SOUTH] = INFINITY
            to_go[here, SOUTHEAST] = INFINITY
        elif r >= first_sink:
            to_go[here, EAST] = 0.0
            to_go[here, SOUTH] = 0.0 if south_at_end else INFINITY
            to_go[here, SOUTHEAST] = 0.0
        else:
            k = place[i] + (r - origin[i]) % n
            s = south[r % n] * weight[i] + south_of_here
            to_go[here, EAST] = INFINITY
            to_go[here, SOUTH] = bends[k, SS] + s
            to_go[here, SOUTHEAST] = bends[k, DS] + s
        south_of_here = to_go[here, SOUTH]

    for c in range(columns - 2, -1, -1):
        i = c % m
        r = high[c]
        j = r % n
        t = (r - origin[i]) % n
        k = place[i] + t
        here = go_place[c] + r - low[c]
        beyond = go_place[c + 1] + r - low[c + 1]  # the dot to the East
        south_of_here = INFINITY
        southeast_of_here = INFINITY
        if low[c + 1] <= r + 1 <= high[c + 1]:
            southeast_of_here = to_go[beyond + 1, SOUTHEAST]
        while r >= low[c]:
            # What each step out of the dot costs from here on, the bend at the dot apart.
            e = INFINITY
            d = southeast[k] + southeast_of_here
            southeast_of_here = INFINITY
            if low[c + 1] <= r <= high[c + 1]:
                e = east[i] + to_go[beyond, EAST]
                southeast_of_here = to_go[beyond, SOUTHEAST]
            s = south[j] * weight[i] + south_of_here
            south_of_here = min(bends[k, SS] + s, bends[k, SD] + d)
            to_go[here, EAST] = min(bends[k, EE] + e, bends[k, ED] + d)
            to_go[here, SOUTH] = south_of_here
            to_go[here, SOUTHEAST] = min(min(bends[k, DE] + e, bends[k, DS] + s), bends[k, DD] + d)
            r -= 1
            here -= 1
            beyond -= 1
            j -= 1
            if j < 0:
                j = n - 1
            k -= 1
            t -= 1
            if t < 0:
                t = n - 1
                k += n


@cython.boundscheck(False)
@cython.wraparound(False)
@cython.cdivision(True)
def sweep(
    east: cython.double[::1],
    south: cython.double[::1],
    southeast: cython.double[::1],
    bends: cython.double[:, ::1],
    weight: cython.double[::1],
    origin: cython.Py_ssize_t[::1],
    place: cython.Py_ssize_t[::1],
    first_column: cython.Py_ssize_t,
    last_column: cython.Py_ssize_t,
    low: cython.Py_ssize_t[::1],
    high: cython.Py_ssize_t[::1],
    last_source: cython.Py_ssize_t,
    source: cython.double[::1],
    open_wires: cython.bint,
    go_low: cython.Py_ssize_t[::1],
    go_place: cython.Py_ssize_t[::1],
    to_go: cython.double[:, ::1],
    bound: cython.double,
    live: cython.Py_ssize_t[::1],
    left: cython.double[:, ::1],
    parent_place: cython.Py_ssize_t[::1],
    parents: cython.uchar[::1],
    visited: cython.Py_ssize_t[:, ::1],
    ends: cython.double[:, ::1],
) -> None:
    """Least work to every state from any source, eqs (20)-(22), column by column.

    Parameters
    ----------
    east, south, southeast, bends, weight, origin, place : arrays
        The tables of `work.Tables`, whose column 0 is `first_column` where they hold a part of a period.
    first_column, last_column : int
        The columns to go through, both included; those before them have been gone through by earlier calls.
    low, high : (columns,) int
        First and last row of each column; neither ever falls. Column c is vertex ``c mod m``, row r
        vertex ``r mod n``.
    last_source : int
        Sources are the dots of column 0 from row ``low[0]`` to this one.
    source : (3,) float
        Work at a source by the step that led to it; infinite forbids the step.
    open_wires : bool
        There is one source, and no bend is charged there.
    go_low, go_place, to_go : arrays, or empty
        Lower bounds on the work from each state onwards, by `cost_to_go`, and the window they are kept in.
    bound : float
        With `to_go`: states that no path of less than this work goes through are left out.
    live : (3,) int
        Handed from call to call: first and last row that a path can come from, and the row of `left` they
        are kept in; last < first when no path costs less than the bound. Begins as low[0], last_source, 0.
    left : (4, high[-1] - low[0] + 1) float
        Handed from call to call, room for two columns: the work of having left a dot by East, by Southeast.
    parent_place : (columns,) int
        Where each column begins in `parents`.
    parents : (dots,) uchar
        Overwritten where a path can come by: the best steps in.
    visited : (columns, 2) int
        Overwritten: the first and the last row of each column that a path can come by.
    ends : (high[-1] - low[-1] + 1, 3) float
        Overwritten in the last of all columns: work by the step in, row ``low[-1]`` first. South steps are
        made there only where the path may have begun in the middle of the same run.
    """
    columns: cython.Py_ssize_t = low.shape[0]
    m: cython.Py_ssize_t = place.shape[0]
    n: cython.Py_ssize_t = south.shape[0]
    shift: cython.Py_ssize_t = first_column if m < columns - 1 + open_wires else 0
    pruning: cython.bint = to_go.shape[0] > 0
    south_at_end: cython.bint = open_wires or source[SOUTH] < INFINITY
    base: cython.Py_ssize_t = low[0]
    first: cython.Py_ssize_t = live[0]
    last: cython.Py_ssize_t = live[1]
    was: cython.Py_ssize_t = live[2]
    now: cython.Py_ssize_t
    new_first: cython.Py_ssize_t
    new_last: cython.Py_ssize_t
    c: cython.Py_ssize_t
    r: cython.Py_ssize_t
    i: cython.Py_ssize_t
    j: cython.Py_ssize_t
    k: cython.Py_ssize_t
    t: cython.Py_ssize_t
    g: cython.Py_ssize_t = 0
    w_e: cython.double
    w_s: cython.double
    w_d: cython.double
    by_e: cython.double
    by_s: cython.double
    by_d: cython.double
    left_south: cython.double
    came: cython.int

    if last_column == columns - 1:
        for r in range(ends.shape[0]):
            ends[r, EAST] = INFINITY
            ends[r, SOUTH] = INFINITY
            ends[r, SOUTHEAST] = INFINITY

    for c in range(first_column, last_column + 1):
        i = (c - shift) % m
        now = 2 - was
        new_first = -1
        new_last = -1
        left_south = INFINITY
        r = max(low[c], first)
        j = r % n
        t = (r - origin[i]) % n
        k = place[i] + t
        if pruning:
            g = go_place[c] + r - go_low[c]
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
                    w_e = left[was, r - base]
                if first < r <= last + 1:
                    w_d = left[was + 1, r - 1 - base]
                if c == columns - 1 and not south_at_end:
                    w_s = INFINITY
            if pruning:
                if w_e + to_go[g, EAST] >= bound:
                    w_e = INFINITY
                if w_s + to_go[g, SOUTH] >= bound:
                    w_s = INFINITY
                if w_d + to_go[g, SOUTHEAST] >= bound:
                    w_d = INFINITY
                g += 1
            if w_e < INFINITY or w_s < INFINITY or w_d < INFINITY:
                if new_first < 0:
                    new_first = r
                new_last = r
            elif r > last:
                break  # nothing comes to the rows below either

            came = 0
            # Leaving East, after East or Southeast.
            by_e = w_e + bends[k, EE]
            by_d = w_d + bends[k, DE]
            if by_d < by_e:
                by_e = by_d
                came |= EAST_CAME_DIAGONALLY
            left[now, r - base] = by_e + east[i]
            # Leaving South, after South or Southeast.
            by_s = w_s + bends[k, SS]
            by_d = w_d + bends[k, DS]
            if by_d < by_s:
                by_s = by_d
                came |= SOUTH_CAME_DIAGONALLY
            left_south = by_s + south[j] * weight[i]
            # Leaving Southeast, after any step.
            by_e = w_e + bends[k, ED]
            by_s = w_s + bends[k, SD]
            by_d = w_d + bends[k, DD]
            if by_d <= by_e and by_d <= by_s:
                came |= SOUTHEAST << SOUTHEAST_CAME_SHIFT
            elif by_s < by_e:
                by_d = by_s
                came |= SOUTH << SOUTHEAST_CAME_SHIFT
            else:
                by_d = by_e
            left[now + 1, r - base] = by_d + southeast[k]
            if open_wires and c == 0 and r == base:  # no angle, whatever the step
                left[now, 0] = east[i]
                left_south = south[j] * weight[i]
                left[now + 1, 0] = southeast[k]
            parents[parent_place[c] + r - low[c]] = came

            if c == columns - 1:
                ends[r - low[c], EAST] = w_e
                ends[r - low[c], SOUTH] = w_s
                ends[r - low[c], SOUTHEAST] = w_d
            r += 1
            j += 1
            if j == n:
                j = 0
            k += 1
            t += 1
            if t == n:
                t = 0
                k -= n
        if new_first < 0:  # no path costs less than the bound
            live[0] = 0
            live[1] = -1
            return
        visited[c, 0] = new_first
        visited[c, 1] = new_last
        first = new_first
        last = new_last
        was = now
    live[0] = first
    live[1] = last
    live[2] = was


@cython.boundscheck(False)
@cython.wraparound(False)
@cython.cdivision(True)
def sweep_simplified(
    east: cython.double[::1],
    south: cython.double[::1],
    southeast: cython.double[::1],
    bends: cython.double[:, ::1],
    weight: cython.double[::1],
    origin: cython.Py_ssize_t[::1],
    place: cython.Py_ssize_t[::1],
    low: cython.Py_ssize_t[::1],
    high: cython.Py_ssize_t[::1],
    first_step: cython.int,
    open_wires: cython.bint,
    left: cython.double[:, ::1],
    parent_place: cython.Py_ssize_t[::1],
    parents: cython.uchar[::1],
    ends: cython.double[::1],
) -> None:
    """The simplified algorithm of section 4.1, eqs (23)-(28): one work value and one step in for each dot.

    Departure: eqs (23)-(25) allow turns of 90 degrees, which section 4 forbids; here they cost infinitely much.

    Parameters
    ----------
    east, south, southeast, bends, weight, origin, place : arrays
        The tables of `work.Tables`.
    low, high : (columns,) int
        First and last row of each column; the path leads from ``low[0]`` to ``high[-1]``.
    first_step : int
        The step that leads to the first dot.
    open_wires : bool
        No bend is charged at the first dot.
    left : (4, high[-1] - low[0] + 1) float
        Overwritten: room for two columns.
    parent_place, parents : arrays
        As in `sweep`.
    ends : (3,) float
        Overwritten: work at the last dot by the step in.
    """
    columns: cython.Py_ssize_t = low.shape[0]
    m: cython.Py_ssize_t = place.shape[0]
    n: cython.Py_ssize_t = south.shape[0]
    base: cython.Py_ssize_t = low[0]
    was: cython.Py_ssize_t = 0
    now: cython.Py_ssize_t
    c: cython.Py_ssize_t
    r: cython.Py_ssize_t
    i: cython.Py_ssize_t
    j: cython.Py_ssize_t
    k: cython.Py_ssize_t
    w_0: cython.double
    w_1: cython.double
    w_2: cython.double
    work: cython.double
    left_east: cython.double
    left_south: cython.double
    left_southeast: cython.double

    for c in range(columns):
        i = c % m
        now = 2 - was
        left_south = INFINITY
        for r in range(low[c], high[c] + 1):
            j = r % n
            k = place[i] + (r - origin[i]) % n
            w_0 = INFINITY
            w_1 = left_south
            w_2 = INFINITY
            if c > 0:
                if low[c - 1] <= r <= high[c - 1]:
                    w_0 = left[was, r - base]
                if low[c - 1] <= r - 1 <= high[c - 1]:
                    w_2 = left[was + 1, r - 1 - base]
            if c == columns - 1 and r == high[c]:
                ends[EAST] = w_0
                ends[SOUTH] = w_1
                ends[SOUTHEAST] = w_2
            left_east = INFINITY
            left_south = INFINITY
            if c == 0 and r == base:
                w_0 = 0.0 if first_step == EAST else INFINITY
                w_1 = 0.0 if first_step == SOUTH else INFINITY
                w_2 = 0.0 if first_step == SOUTHEAST else INFINITY
            if w_0 <= w_1 and w_0 <= w_2:  # eq 26
                work = w_0
                parents[parent_place[c] + r - low[c]] = EAST << SOUTHEAST_CAME_SHIFT
                left_east = work + bends[k, EE] + east[i]
                left_southeast = work + bends[k, ED] + southeast[k]
            elif w_1 <= w_2:  # eq 27
                work = w_1
                parents[parent_place[c] + r - low[c]] = SOUTH << SOUTHEAST_CAME_SHIFT
                left_south = work + bends[k, SS] + south[j] * weight[i]
                left_southeast = work + bends[k, SD] + southeast[k]
            else:  # eq 28
                work = w_2
                parents[parent_place[c] + r - low[c]] = (
                    EAST_CAME_DIAGONALLY | SOUTH_CAME_DIAGONALLY | (SOUTHEAST << SOUTHEAST_CAME_SHIFT)
                )
                left_east = work + bends[k, DE] + east[i]
                left_south = work + bends[k, DS] + south[j] * weight[i]
                left_southeast = work + bends[k, DD] + southeast[k]
            if open_wires and c == 0 and r == base:
                left_east = east[i]
                left_south = south[j] * weight[i]
                left_southeast = southeast[k]
            left[now, r - base] = left_east
            left[now + 1, r - base] = left_southeast
        was = now


@cython.boundscheck(False)
@cython.wraparound(False)
def backtrack(
    parents: cython.uchar[::1],
    parent_place: cython.Py_ssize_t[::1],
    low: cython.Py_ssize_t[::1],
    row: cython.Py_ssize_t,
    step: cython.int,
) -> tuple[list[tuple[int, int]], int]:
    """Follow the parents from a state of the last column back to its source.

    Parameters
    ----------
    parents, parent_place, low : arrays
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
        came = parents[parent_place[c] + r - low[c]]
        if step == EAST:
            step = SOUTHEAST if came & EAST_CAME_DIAGONALLY else EAST
        elif step == SOUTH:
            step = SOUTHEAST if came & SOUTH_CAME_DIAGONALLY else SOUTH
        else:
            step = came >> SOUTHEAST_CAME_SHIFT
        dots.append((c, r))
    dots.reverse()
    return dots, step
