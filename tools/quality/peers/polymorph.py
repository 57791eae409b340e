"""polymorph, a small library that morphs paths in web pages, several contours at once.

It writes curves, and leaves one out that is a point where the one before it ends. So its frames may have different
numbers of vertices, and the first and the last do not say what goes where; those on the way do. It keeps the way round
in which contours are drawn, and turns them inside out where two go opposite ways, so all are turned the same way round
before.
"""

from __future__ import annotations

import functools
from typing import TYPE_CHECKING, Any

from tools.quality.data import DECIMALS, Pair, one_way_round
from tools.quality.peers.node import Library, contours, version

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy as np

NAME = f"polymorph {version('polymorph-js')}"

APART = 6
"""With so many decimals it takes no two points on the way for one."""

ON_THE_WAY = (0.25, 0.75)


def job(pair: Pair, precision: int) -> dict[str, Any]:
    """Return what the script is told of a pair."""
    return {"a": one_way_round(pair.a), "b": one_way_round(pair.b), "precision": precision}


class Polymorph(Library):
    """The library, whose frames on the way say what goes where."""

    def links(self, pairs: Sequence[Pair]) -> list[list[tuple[np.ndarray, np.ndarray]] | None]:
        """Return what goes where: vertices go straight, so two frames on the way give both ends."""
        exact = Library(self.name, self.script, functools.partial(job, precision=APART))
        return [
            frames
            and [(1.5 * p - 0.5 * q, 1.5 * q - 0.5 * p) for p, q in zip(*map(contours, frames), strict=True)]
            for frames in exact.path_data(pairs, ON_THE_WAY)
        ]


FINE = Polymorph(NAME, "polymorph", functools.partial(job, precision=DECIMALS))
