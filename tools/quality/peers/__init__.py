"""The tools that are compared: what each is, a module each how it is used."""

from __future__ import annotations

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
    linked : callable
        Gives for each pair of known truth its in-betweens and what goes where, or None where the tool fails.
    front : bool
        Whether it has a column in the README.
    """

    name: str
    blends: Callable[[list[Pair]], list[list[list[np.ndarray]] | None]]
    linked: Callable[[list[Truth]], list[Linked | None]]
    front: bool = False


LIBRARIES = (flubber.FINE, kute.FINE, kute.OF_CURVES, polymorph.FINE)
"""What node runs."""

ALL = (
    Tool(shapeblend.NAME, shapeblend.blends, shapeblend.linked, front=True),
    *(
        Tool(library.name, library.blends, library.linked, library in (flubber.FINE, kute.OF_CURVES))
        for library in LIBRARIES
    ),
    Tool(arc_length.NAME, arc_length.blends, arc_length.linked, front=True),
)


def ready() -> str | None:
    """Install the libraries, with the fonts, icons and animations, or return why they cannot run here."""
    return next(filter(None, (library.ready() for library in LIBRARIES)), None)
