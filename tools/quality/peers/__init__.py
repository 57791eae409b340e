"""The tools that are compared: what each is, a module each how it is used."""

from __future__ import annotations

import functools
from typing import TYPE_CHECKING, NamedTuple

from tools.quality.peers import arc_length, flubber, kute, polymorph, shapeblend

if TYPE_CHECKING:
    from collections.abc import Callable

    import numpy as np

    from tools.quality.data import Pair
    from tools.quality.truth.form import Linked, Truth


class Tool(NamedTuple):
    """One way to blend.

    Attributes
    ----------
    name : str
    blends : callable
        Gives for each pair its frames at the times of `scores.STEPS`, or None where the tool fails.
    linked : callable or None
        Gives for each pair of known truth its in-betweens and what goes where, or None where the tool fails.
    ready : callable
        Gives None, or else why the tool cannot run here.
    brief : bool
        Whether it has a column in the short table.
    front : bool
        Whether it has one in the README.
    """

    name: str
    blends: Callable[[list[Pair]], list[list[list[np.ndarray]] | None]]
    linked: Callable[[list[Truth]], list[Linked | None]] | None = None
    ready: Callable[[], str | None] = lambda: None
    brief: bool = True
    front: bool = False


LIBRARIES = (*flubber.LIBRARIES, *kute.LIBRARIES, *polymorph.LIBRARIES)
"""What node runs."""

BRIEF = (flubber.FINE, flubber.OWN, kute.FINE, kute.OF_CURVES, polymorph.FINE)
FRONT = (flubber.FINE, kute.OF_CURVES)
"""Those in the short table, and in that of the README."""

ALL = (
    Tool(shapeblend.NAME, shapeblend.blends, shapeblend.linked, front=True),
    *(
        Tool(shapeblend.named(motion), functools.partial(shapeblend.blends, motion=motion), brief=False)
        for motion in shapeblend.MOTIONS
    ),
    *(
        Tool(library.name, library.blends, library.linked, library.ready, library in BRIEF, library in FRONT)
        for library in LIBRARIES
    ),
    Tool(arc_length.NAME, arc_length.blends, arc_length.linked, front=True),
)
