"""The tools that are compared: what each is, a module each how it is used."""

from __future__ import annotations

import functools
from typing import TYPE_CHECKING, NamedTuple

from tools.quality.peers import arc_length, flubber, shapeblend

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
    """

    name: str
    blends: Callable[[list[Pair]], list[list[list[np.ndarray]] | None]]
    linked: Callable[[list[Truth]], list[Linked | None]] | None = None
    ready: Callable[[], str | None] = lambda: None
    brief: bool = True


ALL = (
    Tool(shapeblend.NAME, shapeblend.blends, shapeblend.linked),
    *(
        Tool(shapeblend.named(motion), functools.partial(shapeblend.blends, motion=motion), brief=False)
        for motion in shapeblend.MOTIONS
    ),
    Tool(flubber.NAME, flubber.blends, flubber.linked, flubber.ready),
    Tool(
        flubber.COARSE,
        functools.partial(flubber.blends, own_sides=True),
        functools.partial(flubber.linked, own_sides=True),
        flubber.ready,
    ),
    Tool(arc_length.NAME, arc_length.blends, arc_length.linked),
)
