"""The solver for polygons without a drawing, and the search through every path beside it."""

import numpy as np

from shapeblend_cli.matching.solve import Search, least_work
from shapeblend_cli.matching.steps import BEND_OF_STEPS, MOVES
from shapeblend_cli.matching.work import Wires
from shapeblend_cli.options.settings import Settings
from shapeblend_cli.wires.constraints import Constraints
from shapeblend_cli.wires.contour_match import ContourMatch
from tests.support.oracle import Oracle


def find_least(p0, p1, closed=True, constants=None, weight=None, **search):
    """The least-work correspondence of two polygons; `search` as in `Search`."""
    return least_work(Wires(p0, p1, closed, constants, weight), Search(**search))


def match_of(a, b, **settings):
    """The match of two flat contours that is free of constraints."""
    match = ContourMatch(a, b, None, Settings(**settings), Constraints())
    return match._replace(first=match.solve(a, b).correspondence)


def exhaustive(p0, p1, closed, constants, weight=None, **restrictions):
    """Least work over all paths; bends come from the tables, which have a test of their own."""
    priced = Wires(p0, p1, closed, constants, weight).tables().bends.reshape(len(p0), len(p1), 7)

    def bend(i, j, step_in, step_out):
        return priced[i, j, BEND_OF_STEPS[MOVES.index(step_in), MOVES.index(step_out)]]

    return Oracle(p0, p1, closed, constants, weight).least(bend, **restrictions)


def path_through(land, column, row):
    """Columns and rows of the least path through a dot, as the landscape says what comes before and after."""
    dot, step = np.array([column, row]), int(land.step[column, row])
    back = []
    while dot.any():
        back.append(dot)
        dot = dot - MOVES[step]
        step = int(land.before[tuple(dot)]) >> 2 * step & 3
    path = [dot, *reversed(back)]
    dot, step = np.array([column, row]), int(land.step[column, row])
    while (dot != np.array(land.works.shape) - 1).any():
        step = int(land.after[tuple(dot)]) >> 2 * step & 3
        dot = dot + MOVES[step]
        path.append(dot)
    return np.array(path)
