# cython: boundscheck=False, wraparound=False, cdivision=True
"""The graph of all correspondences, and the least-work paths through it.

Section 4 of Sederberg and Greenwood, "A Physically Based Approach to 2-D Shape Blending", Computer
Graphics 26(2), 1992 (SIGGRAPH '92). This file is compiled by Cython and runs uncompiled as well.

A dot [i, j] says that vertex i of the first polygon corresponds to vertex j of the second. The three
work values of a dot, W-left, W-up and W-diagonal in eqs (20)-(22), belong to the step that led to the dot:
East (i + 1), South (j + 1) or Southeast (both). Work is added in the order of the path: the bend at
a dot is charged on leaving it, when both of its steps are known.

The graph of closed polygons is periodic: dot [i + m, j] is dot [i, j], and so is [i, j + n]. A closed path
leaves column 0 in row j and meets column m in row j + n. Column c is vertex ``c mod m``, row r vertex ``r mod n``;
rows are counted on without end. A South step on the first wire's vertex i stretches a stiffness ``weight[i]`` times
(section 6).

Kernels use the paper's letters: W-left, W-up and W-diagonal are ``w_e``, ``w_s`` and ``w_d``.

Departures
----------
* Eqs (20)-(22) read literally make every first step infinite, because no dot comes before [0, 0], and they
  never charge the angle there. Here a path starts in a *state*, a dot together with the step that led
  to it, and a closed path has to end in the state it started from.
* No back-pointers are followed per step direction: one byte a dot says, for each of the three
  steps out of it, which step in costs least.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.matching import steps

try:
    import cython
except ImportError:  # Cython is needed to build, not to run
    from shapeblend_cli import _cython as cython

if cython.compiled:
    from cython.cimports.cpython.exc import PyErr_CheckSignals as look_for_signals
else:
    from shapeblend_cli._cython import look_for_signals

if TYPE_CHECKING:
    from shapeblend_cli.matching.tables import Progress, Tables, Terminals, Window
    from shapeblend_cli.model import FloatArray, IntArray

COMPILED = cython.compiled

INFINITY = cython.declare(cython.double, float("inf"))

cython.declare(EAST=cython.int, SOUTH=cython.int, SOUTHEAST=cython.int)
EAST, SOUTH, SOUTHEAST = steps.STEPS
cython.declare(EE=cython.int, ED=cython.int, DE=cython.int, SS=cython.int)
cython.declare(SD=cython.int, DS=cython.int, DD=cython.int)
EE, ED, DE, SS, SD, DS, DD = steps.BENDS


@cython.cfunc
@cython.inline
@cython.exceptval(check=False)
def _is_more(work: cython.double, other: cython.double) -> cython.bint:
    """Return whether one work is more than another: by their difference, else the C compiler makes a branch of it."""
    return work - other > 0.0 if cython.compiled else work > other


def cost_to_go(
    tables: Tables,
    window: Window,
    ends: Terminals,
    to_go: cython.double[:, ::1],
    following: cython.uchar[::1],
) -> None:
    """Find the least work from every state of a window to the nearest end, from the last column backwards.

    Parameters
    ----------
    tables : Tables
    window : Window
    ends : Terminals
        In the last column. A path ends where it meets one.
    to_go : (dots, 3) float
        Overwritten: the work from a dot onwards, the bend at the dot included, by the step that led to
        it. Infinite where no path leads to an end.
    following : (dots,) uint8, or empty
        Overwritten: for each step into a dot, the step out that costs least, as in `Progress.parents`.
    """
    east: cython.double[::1] = tables.east
    south: cython.double[::1] = tables.south
    southeast: cython.double[::1] = tables.southeast
    bends: cython.double[:, ::1] = tables.bends
    weight: cython.double[::1] = tables.weight
    origin: cython.Py_ssize_t[::1] = tables.window.low
    offset: cython.Py_ssize_t[::1] = tables.window.column_offset
    low: cython.Py_ssize_t[::1] = window.low
    high: cython.Py_ssize_t[::1] = window.high
    here_offset: cython.Py_ssize_t[::1] = window.column_offset
    end_work: cython.double[::1] = ends.work
    first_end: cython.Py_ssize_t = ends.first_row
    last_end: cython.Py_ssize_t = ends.last_row
    last_column: cython.Py_ssize_t = low.shape[0] - 1
    m: cython.Py_ssize_t = weight.shape[0]
    n: cython.Py_ssize_t = south.shape[0]
    follows: cython.bint = following.shape[0] > 0
    cython.declare(c=cython.Py_ssize_t, r=cython.Py_ssize_t, i=cython.Py_ssize_t, j=cython.Py_ssize_t)
    cython.declare(k=cython.Py_ssize_t, t=cython.Py_ssize_t, here=cython.Py_ssize_t)
    cython.declare(beyond=cython.Py_ssize_t, beyond_low=cython.Py_ssize_t, beyond_high=cython.Py_ssize_t)
    cython.declare(e=cython.double, s=cython.double, d=cython.double)
    cython.declare(south_of_here=cython.double, southeast_of_here=cython.double)
    cython.declare(w_e=cython.double, w_s=cython.double, w_d=cython.double)
    cython.declare(after_e=cython.int, after_s=cython.int, after_d=cython.int)
    # The C compiler takes globals for variables, which it would read again for every dot.
    cython.declare(ee=cython.int, ed=cython.int, de=cython.int, ss=cython.int)
    cython.declare(sd=cython.int, ds=cython.int, dd=cython.int)
    ee, ed, de, ss, sd, ds, dd = 0, 1, 2, 3, 4, 5, 6
    cython.declare(by_e=cython.int, by_s=cython.int, by_d=cython.int)
    by_e, by_s, by_d = 0, 1, 2

    for c in range(last_column, -1, -1):
        if c % 8 == 0:
            look_for_signals()
        i = c % m
        r = high[c]
        j = r % n
        t = (r - origin[i]) % n
        k = offset[i] + t
        here = here_offset[c] + r - low[c]
        beyond = 0  # the dot to the East
        beyond_low = 0
        beyond_high = -1
        if c < last_column:
            last_end = first_end - 1  # there are none
            beyond_low = low[c + 1]
            beyond_high = high[c + 1]
            beyond = here_offset[c + 1] + r - beyond_low
        south_of_here = INFINITY
        southeast_of_here = INFINITY
        if beyond_low <= r + 1 <= beyond_high:
            southeast_of_here = to_go[beyond + 1, by_d]
        while r >= low[c]:
            # What each step out of the dot costs from here on, the bend at the dot apart.
            e = INFINITY
            d = southeast[k] + southeast_of_here
            southeast_of_here = INFINITY
            if beyond_low <= r <= beyond_high:
                e = east[i] + to_go[beyond, by_e]
                southeast_of_here = to_go[beyond, by_d]
            s = south[j] * weight[i] + south_of_here
            w_e = min(bends[k, ee] + e, bends[k, ed] + d)
            w_s = min(bends[k, ss] + s, bends[k, sd] + d)
            w_d = min(min(bends[k, de] + e, bends[k, ds] + s), bends[k, dd] + d)
            if follows:
                after_e = EAST if w_e == bends[k, ee] + e else SOUTHEAST
                after_s = SOUTH if w_s == bends[k, ss] + s else SOUTHEAST
                after_d = EAST if w_d == bends[k, de] + e else SOUTH if w_d == bends[k, ds] + s else SOUTHEAST
                following[here] = after_d << 4 | after_s << 2 | after_e
            if first_end <= r <= last_end:
                w_e = end_work[EAST]
                w_s = end_work[SOUTH]
                w_d = end_work[SOUTHEAST]
                if follows:
                    following[here] = 0
            to_go[here, by_e] = w_e
            to_go[here, by_s] = w_s
            to_go[here, by_d] = w_d
            south_of_here = w_s
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


@cython.final
@cython.cclass
class Arrays:
    """All that sweeps through one window read and write: to look up so many arrays takes as long as a short sweep.

    Parameters
    ----------
    tables : Tables
        Of the columns to sweep, at least.
    window : Window
    bounded : Window
    to_go : (dots, 3) float
        Lower bounds on the work from each state of that window onwards, by `cost_to_go`, or empty.
    progress : Progress
    """

    east: cython.double[::1]
    south: cython.double[::1]
    southeast: cython.double[::1]
    bends: cython.double[::1]
    weight: cython.double[::1]
    origin: cython.Py_ssize_t[::1]
    offset: cython.Py_ssize_t[::1]
    first_column: cython.Py_ssize_t
    low: cython.Py_ssize_t[::1]
    high: cython.Py_ssize_t[::1]
    parent_offset: cython.Py_ssize_t[::1]
    to_go: cython.double[::1]
    to_go_low: cython.Py_ssize_t[::1]
    to_go_offset: cython.Py_ssize_t[::1]
    leaving: cython.double[::1]
    parents: cython.uchar[::1]
    visited: cython.Py_ssize_t[:, ::1]
    ends: cython.double[:, ::1]

    def __init__(
        self, tables: Tables, window: Window, bounded: Window, to_go: FloatArray, progress: Progress
    ) -> None:
        self.east, self.south, self.southeast = tables.east, tables.south, tables.southeast
        self.bends, self.weight = tables.bends.reshape(-1), tables.weight
        self.origin, self.offset = tables.window.low, tables.window.column_offset
        self.first_column = tables.first_column
        self.low, self.high, self.parent_offset = window
        self.to_go, self.to_go_low, self.to_go_offset = to_go.reshape(-1), bounded.low, bounded.column_offset
        self.leaving, self.parents = progress.leaving.reshape(-1), progress.parents
        self.visited, self.ends = progress.visited, progress.ends


def sweep(
    arrays: Arrays,
    starts: Terminals,
    limit: cython.double,
    progress: Progress,
    last_column: cython.Py_ssize_t,
    simplified: cython.bint,
) -> None:
    """Find the least work to every state of a window from any start, eqs (20)-(22), column by column.

    Paths go South in the last column only if they may have begun in the middle of the same run.

    Parameters
    ----------
    arrays : Arrays
    starts : Terminals
        In column 0.
    limit : float
        States are left out that no path of less work goes through, by the lower bounds.
    progress : Progress
        Carried on.
    last_column : int
        The last one to sweep.
    simplified : bool
        Keep only the cheapest state of each dot: section 4.1, eqs (23)-(28). Turns of 90 degrees, which (23)-(25) allow
        and section 4 forbids, cost infinitely much all the same.
    """
    east: cython.double[::1] = arrays.east
    south: cython.double[::1] = arrays.south
    southeast: cython.double[::1] = arrays.southeast
    bends: cython.double[::1] = arrays.bends
    weight: cython.double[::1] = arrays.weight
    origin: cython.Py_ssize_t[::1] = arrays.origin
    offset: cython.Py_ssize_t[::1] = arrays.offset
    first_column: cython.Py_ssize_t = arrays.first_column
    low: cython.Py_ssize_t[::1] = arrays.low
    high: cython.Py_ssize_t[::1] = arrays.high
    parent_offset: cython.Py_ssize_t[::1] = arrays.parent_offset
    start_work: cython.double[::1] = starts.work
    to_go: cython.double[::1] = arrays.to_go
    to_go_low: cython.Py_ssize_t[::1] = arrays.to_go_low
    to_go_offset: cython.Py_ssize_t[::1] = arrays.to_go_offset
    leaving: cython.double[::1] = arrays.leaving
    rows: cython.Py_ssize_t = leaving.shape[0] // 4
    parents: cython.uchar[::1] = arrays.parents
    visited: cython.Py_ssize_t[:, ::1] = arrays.visited
    ends: cython.double[:, ::1] = arrays.ends
    lowest: cython.Py_ssize_t = progress.rows[0]
    highest: cython.Py_ssize_t = progress.rows[1]
    columns: cython.Py_ssize_t = low.shape[0]
    m: cython.Py_ssize_t = weight.shape[0]
    n: cython.Py_ssize_t = south.shape[0]
    pruning: cython.bint = to_go.shape[0] > 0 and not simplified
    south_at_end: cython.bint = simplified or start_work[SOUTH] < INFINITY
    base: cython.Py_ssize_t = low[0] - 1
    first: cython.Py_ssize_t = max(progress.live_rows[0], low[0])
    last: cython.Py_ssize_t = min(progress.live_rows[1], high[columns - 1])
    previous: cython.Py_ssize_t = progress.current
    cython.declare(c=cython.Py_ssize_t, r=cython.Py_ssize_t, i=cython.Py_ssize_t, j=cython.Py_ssize_t)
    cython.declare(
        k=cython.Py_ssize_t, t=cython.Py_ssize_t, current=cython.Py_ssize_t, beyond=cython.Py_ssize_t
    )
    cython.declare(new_first=cython.Py_ssize_t, new_last=cython.Py_ssize_t)
    cython.declare(old_e=cython.Py_ssize_t, old_d=cython.Py_ssize_t)
    cython.declare(new_e=cython.Py_ssize_t, new_d=cython.Py_ssize_t)
    cython.declare(w_e=cython.double, w_s=cython.double, w_d=cython.double, leaving_south=cython.double)
    cython.declare(by_e=cython.double, by_s=cython.double, by_d=cython.double, least=cython.double)
    cython.declare(stiff=cython.double, east_here=cython.double, parents_here=cython.Py_ssize_t)
    cython.declare(southeast_here=cython.Py_ssize_t)
    cython.declare(is_last=cython.bint, is_special=cython.bint, not_d=cython.int, entered=cython.Py_ssize_t)
    # The C compiler takes globals for variables, which it would read again for every dot.
    cython.declare(ee=cython.int, ed=cython.int, de=cython.int, ss=cython.int)
    cython.declare(sd=cython.int, ds=cython.int, dd=cython.int)
    ee, ed, de, ss, sd, ds, dd = 0, 1, 2, 3, 4, 5, 6
    cython.declare(e=cython.int, s=cython.int, d=cython.int)
    e, s, d = 0, 1, 2
    cython.declare(parent_e=cython.int, parent_s=cython.int, parent_d=cython.int, alive=cython.bint)
    column: cython.Py_ssize_t = progress.column
    g: cython.Py_ssize_t = 0

    for c in range(column, last_column + 1):
        if c % 8 == 0:
            look_for_signals()
        i = (c - first_column) % m
        current = 2 - previous
        # Where leaving each row by East and by Southeast is, in this column and in the one before.
        old_e = previous * rows - base
        old_d = old_e + rows
        new_e = current * rows - base
        new_d = new_e + rows
        stiff = weight[i]
        east_here = east[i]
        parents_here = parent_offset[c] - low[c]
        is_last = c == columns - 1
        is_special = c == 0 or is_last or simplified
        # Rows down to the last that is entered from the column before; none is entered from beyond its live rows.
        entered = last + 1
        leaving[old_d + first - 1] = INFINITY
        leaving[old_e + last + 1] = INFINITY
        if c == 0:
            entered = last
            for r in range(first, last + 1):
                leaving[old_e + r] = start_work[EAST]
                leaving[old_d + r - 1] = start_work[SOUTHEAST]
        new_first = -1
        new_last = -1
        leaving_south = INFINITY
        r = max(low[c], first, lowest)
        beyond = min(high[c], highest) + 1
        j = r % n
        t = (r - origin[i]) % n
        southeast_here = offset[i]
        k = 7 * (southeast_here + t)
        if pruning:
            g = 3 * (to_go_offset[c] + r - to_go_low[c])
        while r < beyond:
            w_e = INFINITY
            w_s = leaving_south
            w_d = INFINITY
            if r <= entered:
                w_e = leaving[old_e + r]
                w_d = leaving[old_d + r - 1]
            if is_special:
                if c == 0:
                    if r <= last:
                        w_s = min(w_s, start_work[SOUTH])
                elif is_last and not south_at_end:
                    w_s = INFINITY
            # A state beyond the limit is not left out beside another within: what follows it is beyond the limit, too.
            if pruning:
                least = min(w_e + to_go[g + e], w_s + to_go[g + s], w_d + to_go[g + d])
                alive = least < limit
                g += 3
            else:
                alive = min(w_e, w_s, w_d) < INFINITY
            if alive:
                if new_first < 0:
                    new_first = r
                new_last = r
            elif r > last:
                break  # nothing leads to the rows below either

            if is_special:
                if is_last:
                    ends[r - low[c], EAST] = w_e
                    ends[r - low[c], SOUTH] = w_s
                    ends[r - low[c], SOUTHEAST] = w_d
                if simplified:
                    if w_e <= w_s and w_e <= w_d:  # eq 26
                        w_s = w_d = INFINITY
                    elif w_s <= w_d:  # eq 27
                        w_e = w_d = INFINITY
                    else:  # eq 28
                        w_e = w_s = INFINITY

            if alive:
                # Which is least is as good as random, so there are no branches. Leaving Southeast, after any step.
                by_e = w_e + bends[k + ed]
                by_s = min(by_e, w_s + bends[k + sd])
                by_d = w_d + bends[k + dd]
                least = min(by_s, by_d)
                parent_s = _is_more(by_e, by_s)  # SOUTH, else EAST
                not_d = _is_more(by_d, least)
                parent_d = (not_d & parent_s) | (1 - not_d) << 1
                leaving[new_d + r] = least + southeast[southeast_here + t]
                # Leaving South, after South or Southeast.
                by_s = w_s + bends[k + ss]
                least = min(by_s, w_d + bends[k + ds])
                parent_s = 1 + _is_more(by_s, least)  # SOUTH or SOUTHEAST
                leaving_south = least + south[j] * stiff
                # Leaving East, after East or Southeast.
                by_e = w_e + bends[k + ee]
                least = min(by_e, w_d + bends[k + de])
                parent_e = _is_more(by_e, least) << 1  # SOUTHEAST, else EAST
                leaving[new_e + r] = least + east_here
                parents[parents_here + r] = parent_d << 4 | parent_s << 2 | parent_e
            else:
                leaving[new_d + r] = INFINITY
                leaving[new_e + r] = INFINITY
                leaving_south = INFINITY
            r += 1
            j += 1
            if j == n:
                j = 0
            k += 7
            t += 1
            if t == n:
                t = 0
                k -= 7 * n
        if new_first < 0:  # no path costs less than the limit
            progress.live_rows = (0, -1)
            return
        visited[c, 0] = new_first
        visited[c, 1] = new_last
        first = new_first
        last = new_last
        previous = current
    progress.column = last_column + 1
    progress.live_rows = (first, last)
    progress.current = previous


def least_end(
    arrays: Arrays,
    first: cython.Py_ssize_t,
    ending: tuple[int, ...],
    least: cython.double[::1],
) -> tuple[int, int]:
    """Find the least work at ends of paths.

    Parameters
    ----------
    arrays : Arrays
        Of a sweep to the last column.
    first : int
        Row of the first end, which may be before or beyond these rows, as others may be.
    ending : tuple of int
        Steps by which paths end.
    least : (ends,) float
        Overwritten: the least work at each end, infinite where there is none.

    Returns
    -------
    end : int
        Number of the end with the least work, the first one of equals; -1 where all are infinite.
    step : int
        The step into it.
    """
    cython.declare(k=cython.Py_ssize_t, row=cython.Py_ssize_t, found=cython.Py_ssize_t)
    cython.declare(step=cython.int, step_found=cython.int, work=cython.double, asked=cython.int)
    ends: cython.double[:, ::1] = arrays.ends
    asked = 0  # a bit for each step
    for step in ending:
        asked |= 1 << step
    found, step_found, work = -1, 0, INFINITY
    for k in range(least.shape[0]):
        least[k] = INFINITY
        row = first + k
        if row < 0 or row >= ends.shape[0]:
            continue
        for step in range(3):
            if asked >> step & 1 and ends[row, step] < least[k]:
                least[k] = ends[row, step]
                if least[k] < work:
                    found, step_found, work = k, step, least[k]
    return found, step_found


def backtrack(
    arrays: Arrays,
    row: cython.Py_ssize_t,
    step: cython.int,
    lowest: cython.Py_ssize_t,
) -> tuple[IntArray, int]:
    """Follow the parents of a sweep from a row of the last column, and the step into it, back to a start.

    Parameters
    ----------
    arrays : Arrays
        Of that sweep.
    row, step : int
    lowest : int
        The first row of the starts.

    Returns
    -------
    dots : (k, 2) int
        Columns and rows from the start to the end, both included.
    step : int
        The step into the start.
    """
    parents: cython.uchar[::1] = arrays.parents
    low: cython.Py_ssize_t[::1] = arrays.low
    offset: cython.Py_ssize_t[::1] = arrays.parent_offset
    c: cython.Py_ssize_t = low.shape[0] - 1
    k: cython.Py_ssize_t = c + row - lowest
    found = np.empty((k + 1, 2), np.intp)  # the longest path goes East and South alone
    dots: cython.Py_ssize_t[:, ::1] = found
    dots[k, 0], dots[k, 1] = c, row
    while c > 0 or (step == SOUTH and row > lowest):
        if step != SOUTH:
            c -= 1
        if step != EAST:
            row -= 1
        step = parents[offset[c] + row - low[c]] >> 2 * step & 3
        k -= 1
        dots[k, 0], dots[k, 1] = c, row
    return found[k:], step


def find_bends(
    columns: cython.Py_ssize_t[::1],
    rows: cython.Py_ssize_t[::1],
    period: tuple[int, int],
    closed: cython.bint,
    path_steps: cython.Py_ssize_t[::1],
    path_bends: cython.Py_ssize_t[::1],
) -> bool:
    """Find the steps and bends of a given path; return whether it has legal ones only.

    Parameters
    ----------
    columns, rows : (k,) int
        Of the dots, modulo m and n. A closed path returns to the first one.
    period : (int, int)
        m and n.
    closed : bool
    path_steps : (k,) int if closed, else (k - 1,)
        Overwritten: the steps that leave the dots.
    path_bends : (k,) int if closed, else (k - 2,)
        Overwritten: the bends at the dots, or at all but the first and the last.
    """
    table: cython.Py_ssize_t[:, ::1] = steps.BEND_OF_STEPS
    m: cython.Py_ssize_t = period[0]
    n: cython.Py_ssize_t = period[1]
    count: cython.Py_ssize_t = path_steps.shape[0]
    cython.declare(k=cython.Py_ssize_t, after=cython.Py_ssize_t, before=cython.Py_ssize_t)
    cython.declare(east=cython.Py_ssize_t, south=cython.Py_ssize_t)
    for k in range(count):
        after = k + 1 if k + 1 < columns.shape[0] else 0
        east = (columns[after] - columns[k]) % m
        south = (rows[after] - rows[k]) % n
        if east < 0:  # C's remainder has the sign of what is divided
            east += m
        if south < 0:
            south += n
        if east > 1 or south > 1 or east + south == 0:
            return False
        path_steps[k] = east + 2 * south - 1
    before = count - 1 if closed else 0
    for k in range(path_bends.shape[0]):
        after = k if closed else k + 1
        path_bends[k] = table[path_steps[before], path_steps[after]]
        if path_bends[k] < 0:
            return False
        before = after
    return True
