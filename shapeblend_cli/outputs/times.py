"""When the pictures of an animation are shown."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import NamedTuple

FASTEST = 50
"""Pictures a second; browsers take their own time for what is faster."""


class Run(NamedTuple):
    """One run of an animation, there and perhaps back.

    All its pictures are shown for the same time. Both ends are among them, and so are all drawings on the way.

    Attributes
    ----------
    pairs : int > 0
    steps : int > 0
        From one drawing to the next.
    duration : float > 0
        Seconds from one drawing to the next.
    back : bool
        Whether it goes back too; then neither end is shown twice.
    """

    pairs: int
    steps: int
    duration: float
    back: bool

    @property
    def pictures(self) -> int:
        """How many pictures are shown."""
        there = self.pairs * self.steps
        return 2 * there if self.back else there + 1

    @property
    def seconds(self) -> float:
        """How long it takes."""
        return self.duration * self.pairs * (2 if self.back else 1)

    def order(self) -> list[int]:
        """The numbers of the pictures, those from the first drawing to the last, in the order they are shown in."""
        there = list(range(self.pairs * self.steps + 1))
        return there + there[-2:0:-1] if self.back else there

    def delays(self, a_second: int) -> list[int]:
        """How long each picture is shown, in whole parts of a second, without drifting from the true times."""
        ends = [round(k * self.seconds * a_second / self.pictures) for k in range(self.pictures + 1)]
        return [end - start for start, end in pairwise(ends)]


def run_for(fps: int | None, frames: int, pairs: int, duration: float, back: bool) -> Run:
    """The run with the most pictures that are no more than `fps` a second, or with the frames that are asked for.

    Parameters
    ----------
    fps : int or None
        None for `frames`.
    frames : int >= 0
        In-betweens of each pair.
    pairs : int > 0
    duration : float > 0
        Seconds from one drawing to the next.
    back : bool
        Whether it goes back too.

    Examples
    --------
    >>> run_for(25, 5, 1, 2.0, False).pictures, run_for(25, 5, 1, 2.0, True).pictures
    (50, 100)
    """
    if fps is None:
        return Run(pairs, frames + 1, duration, back)
    # The way there shows one picture more than it has steps: see `Run.pictures`.
    steps = fps * duration - (0.0 if back else 1.0 / pairs)
    return Run(pairs, max(1, math.floor(steps + 1e-9)), duration, back)
