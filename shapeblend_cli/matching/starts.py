"""The starting correspondence: least work over every start, proven (section 4.2).

The paper takes the divide and conquer of its reference [8] (Fuchs, Kedem and Uselton, "Optimal surface
reconstruction from planar contours", Comm. ACM 20(10), 1977), which rests on two least paths never
crossing. With bending work they may: swapping tails where they cross changes the bends there.

Departure: what is exact is branch and bound on the start. Every closed path enters column 0 by an East
or a Southeast step, so the rows of column 0 with these two steps are all the starts there are. One pass
backwards with every row as start and as end gives a lower bound on the work from every state on. A set of
starts is then solved in one sweep, leaving out whatever cannot beat the best closed path known: if
the best path of the set ends in the state it began in, it is the set's least, else its work is a lower
bound and the set is cut in two, without rows to whose ends all paths take too much. Sets are taken up in
the order of their bounds, until the best closed path is not above the next bound.

Cost: O(m n) time and memory for the tables and the first pass; a later sweep visits only the dots that could
still matter. Where the tables would not fit into memory there is no first pass.
"""

from __future__ import annotations

import heapq

import numpy as np

from shapeblend_cli.matching.graph import FIRST_SWEPT, ROUNDING, Graph, Path, Starts
from shapeblend_cli.matching.steps import ENTERING, SOUTHEAST, STEPS

SLACKS = (0.01, 0.1, 0.6)
"""Shares above its lower bound within which a first closed path is looked for, before it is looked for anywhere."""

KNOWN = 1e-9
"""Maximum error of a known work, in units of work or as a share of it: it was added up in another order."""


def least_from(graph: Graph) -> Path | None:
    """Find the least path from the first dot of the region: back to it when closed, to the other ends when open."""
    row = int(graph.region.low[0])
    if graph.closed:
        return _branch_and_bound(graph, [Starts(0.0, row, row, STEPS)], np.inf)
    found = graph.sweep(Starts(0.0, row, row, STEPS))
    return Path(found.dots, found.work, graph.sweeps) if found else None


def least_of_all(graph: Graph, known: float = np.inf, most_swept: float = np.inf) -> Path | None:
    """Find the least closed path over all starts in the region's column 0; the work of some path may be known.

    When so many dots have been swept in all, the best path so far will do.
    """
    first = int(graph.region.low[0])
    bounds = graph.bound_starts()
    if bounds is None:
        last = min(int(graph.region.high[0]), first + graph.wires.n - 1)
        return _branch_and_bound(graph, [Starts(0.0, first, last, ENTERING)], np.inf)

    row = int(bounds.argmin())
    lowest = float(bounds[row])
    if not np.isfinite(lowest):
        return None
    best, limit = None, known + KNOWN * max(known, 1.0)
    if known == np.inf:
        # Most least paths have an end in common, wherever they start, and a closed path through it takes little more. A
        # first one is looked for close above its bound first: the closer, the fewer dots a sweep visits.
        end = graph.end_of(Starts(lowest, first + row, first + row, ENTERING)) - first
        row = end if 0 <= end < len(bounds) and bounds[end] < np.inf else row
        bound = float(bounds[row])
        likely = [Starts(bound, first + row, first + row, ENTERING)]
        for most in [bound + slack * max(bound, 1.0) for slack in SLACKS] + [np.inf]:
            best = best or _branch_and_bound(graph, likely, most)
        limit = best.work * (1.0 - ROUNDING) if best else np.inf

    # Then runs of neighbouring rows that could still do better.
    rows = (bounds < limit).nonzero()[0]
    gaps = (rows[1:] - rows[:-1] > 1).nonzero()[0]
    runs = zip(rows[[0, *(gaps + 1)]].tolist(), rows[[*gaps, -1]].tolist(), strict=True) if len(rows) else ()
    sets = [Starts(float(bounds[p : q + 1].min()), first + p, first + q, ENTERING) for p, q in runs]
    found = _branch_and_bound(graph, sets, limit, most_swept)
    if found is None and best is not None and graph.swept >= most_swept:
        best = best._replace(is_least=False)
    best = found or best
    return best._replace(sweeps=graph.sweeps) if best else None


def simplified_from(graph: Graph) -> Path | None:
    """Find the simplified algorithm's path from the first dot of the region."""
    return _simplified(graph, int(graph.region.low[0]), STEPS if graph.closed else (SOUTHEAST,))


def simplified_of_all(graph: Graph) -> Path | None:
    """Find the simplified algorithm's best path over all starts.

    Starts whose least work is above the best path so far need not be tried: the algorithm cannot do better.
    """
    first = int(graph.region.low[0])
    bounds = graph.bound_starts()
    assert bounds is not None, "the simplified algorithm works on stored tables"
    best = None
    for row in np.argsort(bounds, kind="stable").tolist():
        if best is not None and bounds[row] >= best.work:
            break
        path = _simplified(graph, first + row, ENTERING)
        if path is not None and (best is None or path.work < best.work):
            best = path
    return best._replace(sweeps=graph.sweeps) if best else None


def _simplified(graph: Graph, row: int, steps: tuple[int, ...]) -> Path | None:
    found = [graph.sweep(Starts(0.0, row, row, (step,)), simplified=True) for step in steps]
    paths = [Path(one.dots, one.work, graph.sweeps) for one in filter(None, found)]
    return min(paths, key=lambda path: path.work, default=None)


def _branch_and_bound(
    graph: Graph, sets: list[Starts], limit: float, most_swept: float = np.inf
) -> Path | None:
    """Find the least path of its own from any of the sets that costs less than `limit`, or None."""
    best = None
    queue = list(sets)
    heapq.heapify(queue)
    waiting = sum(starts.rows for starts in queue)
    while queue and queue[0].bound < limit:
        if graph.swept >= most_swept:
            if limit < np.inf:
                return best._replace(is_least=False) if best else None
            # Any path will do, and of a few starts one is found soonest.
            queue.sort(key=lambda starts: (starts.rows, starts.bound))
        graph.watch(1.0 - (1.0 - FIRST_SWEPT) * min(waiting / graph.wires.n, 1.0))
        starts = heapq.heappop(queue) if graph.swept < most_swept else queue.pop(0)
        waiting -= starts.rows
        found = graph.sweep(starts, limit)
        if found is None:
            continue
        if found.is_own:
            best = Path(found.dots, found.work, graph.sweeps)
            limit = found.work * (1.0 - ROUNDING)
        else:
            for part in starts.without(int(found.dots[0, 1]), int(found.dots[-1, 1]) - graph.span):
                # No path of a row's own takes less than the least one to its end.
                least = found.ends[part.first_row - starts.first_row :][: part.rows]
                bound = float(np.minimum.reduce(least, initial=np.inf))
                if bound < limit:
                    rows = (least < limit).nonzero()[0]
                    first, last = part.first_row + int(rows[0]), part.first_row + int(rows[-1])
                    heapq.heappush(queue, Starts(max(bound, starts.bound), first, last, part.steps))
                    waiting += last - first + 1
    return best
