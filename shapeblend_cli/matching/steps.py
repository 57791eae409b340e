"""Steps and bends of paths through the graph.

Paths go East (i + 1), South (j + 1) or Southeast (both). A bend is named after the steps into a dot and out of it: E
moves on the first wire alone, S on the second alone, D (Southeast) on both.
"""

from __future__ import annotations

import numpy as np

STEPS = EAST, SOUTH, SOUTHEAST = (0, 1, 2)

ENTERING = (EAST, SOUTHEAST)
"""The steps that enter a column."""

MOVES = ((1, 0), (0, 1), (1, 1))
"""Columns and rows of each step."""

BENDS = EE, ED, DE, SS, SD, DS, DD = (0, 1, 2, 3, 4, 5, 6)
"""The last axis of `Tables.bends`."""

NO_BEND = -1

BEND_OF_STEPS = np.array([[EE, NO_BEND, ED], [NO_BEND, SS, SD], [DE, DS, DD]], np.intp)
"""The bend by the step into a dot and the step out of it. Section 4 forbids turns of 90 degrees."""

MIRRORED_BENDS = (EE, DE, ED, SS, DS, SD, DD)
"""The bends when a path is followed backwards."""
