"""The timing of animations, and easing as in CSS: the progress of a blend after a share of its time.

https://www.w3.org/TR/css-easing-1/#cubic-bezier-easing-functions
"""

from __future__ import annotations

import math
from itertools import pairwise
from typing import NamedTuple

NAMES = {
    "linear": (0.0, 0.0, 1.0, 1.0),
    "ease": (0.25, 0.1, 0.25, 1.0),
    "ease-in": (0.42, 0.0, 1.0, 1.0),
    "ease-out": (0.0, 0.0, 0.58, 1.0),
    "ease-in-out": (0.42, 0.0, 0.58, 1.0),
}

HALVINGS = 60
"""Number of steps of the bisection for a parameter of the curve."""


class Ease(NamedTuple):
    """A cubic Bezier curve from (0, 0) to (1, 1), time to the right and progress upwards; its inner control points.

    All four lie in [0, 1]: progress beyond it would be a picture before A or after B, and there is none.
    """

    x1: float = 0.0
    y1: float = 0.0
    x2: float = 1.0
    y2: float = 1.0

    def __str__(self) -> str:
        """As CSS writes it."""
        names = [name for name, numbers in NAMES.items() if self == numbers]
        return names[0] if names else f"cubic-bezier({','.join(f'{number:g}' for number in self)})"

    def css(self) -> str:
        """As CSS takes it, with numbers as short as can be seen."""
        if self.is_linear:
            return "linear"
        return f"cubic-bezier({','.join(f'{round(value, 4):g}' for value in self)})"

    @property
    def is_linear(self) -> bool:
        """Whether progress is time."""
        return self.x1 == self.y1 and self.x2 == self.y2

    def mirrored(self) -> Ease:
        """The same way back."""
        return Ease(1.0 - self.x2, 1.0 - self.y2, 1.0 - self.x1, 1.0 - self.y1)

    def at(self, time: float) -> float:
        """Progress, from 0 to 1, at a time from 0 to 1."""
        if self.is_linear or time in (0.0, 1.0):
            return time
        return _solved(self.x1, self.x2, self.y1, self.y2, time)

    def piece(self, start: float, end: float) -> Ease:
        """The part of the curve from one progress to another, stretched to go from (0, 0) to (1, 1)."""
        if self.is_linear:
            return self
        s, t = (_parameter(self.y1, self.y2, progress) for progress in (start, end))
        sides = []
        for inner in ((self.x1, self.x2), (self.y1, self.y2)):
            # The control points of a part are the blossoms of its two ends.
            first, second, third, last = (
                _blossom((0.0, *inner, 1.0), *arguments)
                for arguments in ((s, s, s), (s, s, t), (s, t, t), (t, t, t))
            )
            length = last - first
            ways = (second - first, third - first)
            sides.append([min(max(way / length, 0.0), 1.0) if length > 0.0 else 0.0 for way in ways])
        (x1, x2), (y1, y2) = sides
        return Ease(x1, y1, x2, y2)

    def time_of(self, progress: float) -> float:
        """Time at which a progress is reached."""
        if self.is_linear or progress in (0.0, 1.0):
            return progress
        return _solved(self.y1, self.y2, self.x1, self.x2, progress)


LINEAR = Ease()

FOREVER, PINGPONG = "forever", "pingpong"


class Timing(NamedTuple):
    """How an animation runs.

    The identifiers in CSS animations are made from the text of this value.
    """

    seconds: float = 2.0  # > 0, from one drawing to the next, like the easing
    ease: Ease = LINEAR
    repeat: int | str = FOREVER  # how often it runs; or "pingpong": forwards and backwards forever
    hold: tuple[float, float] = (0.0, 0.0)  # seconds of rest at the first drawing, and at each of the others

    def __repr__(self) -> str:
        """Return the text of a value; without rests that of versions that had none."""
        shown = self._asdict() if self.rests else dict(list(self._asdict().items())[:-1])
        return f"Timing({', '.join(f'{name}={value!r}' for name, value in shown.items())})"

    @property
    def rests(self) -> bool:
        """Whether it rests at any drawing."""
        return self.hold != (0.0, 0.0)

    def when(self, place: float, *, leaves: bool = False) -> float:
        """Return when a place on the way is reached, counted in drawings, or when a drawing is left.

        The result is in times of `seconds`, the rests on the way among them.
        """
        if not self.rests:
            return place
        left = math.ceil(place) + leaves  # drawings that were left before
        first, other = (rest / self.seconds for rest in self.hold)
        return place + first * min(left, 1) + other * max(left - 1, 0)

    def length(self, pairs: int) -> float:
        """Return how long a run takes, forwards and perhaps backwards, in times of `seconds`."""
        forwards = self.when(pairs, leaves=True)
        return forwards + self.when(pairs) - self.when(0, leaves=True) if self.is_pingpong else forwards

    def rest_at(self, number: int, steps: int) -> float:
        """Return for how many seconds a frame rests, if it is a drawing: each `steps`-th frame is one."""
        return self.hold[number > 0] if number % steps == 0 else 0.0

    @property
    def is_pingpong(self) -> bool:
        """Whether it runs forwards and backwards in turn."""
        return self.repeat == PINGPONG


def frame_times(frames: int, ends: bool, ease: Ease = LINEAR) -> list[float]:
    """Return the times of `frames` in-betweens, evenly spaced before easing, and of both ends if wanted."""
    times = [ease.at(k / (frames + 1)) for k in range(frames + 2)]
    return times if ends else times[1:-1]


def parse(text: str) -> Ease:
    """Read one of `NAMES` or ``cubic-bezier(x1,y1,x2,y2)``; raise ValueError for anything else."""
    name = text.strip().lower()
    body = name.removeprefix("cubic-bezier(").removesuffix(")")
    if name in NAMES:
        return Ease(*NAMES[name])
    if name != f"cubic-bezier({body})":
        raise ValueError(text)
    x1, y1, x2, y2 = map(float, body.split(","))
    if not all(0.0 <= number <= 1.0 for number in (x1, y1, x2, y2)):
        raise ValueError(text)
    return Ease(x1, y1, x2, y2)


def _solved(x1: float, x2: float, y1: float, y2: float, x: float) -> float:
    """The curve's y where its x, which never falls, has a value."""
    s = _parameter(x1, x2, x)
    return _blossom((0.0, y1, y2, 1.0), s, s, s)


def _parameter(x1: float, x2: float, x: float) -> float:
    """Where a coordinate that never falls has a value."""
    low, high = 0.0, 1.0
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        is_below = _blossom((0.0, x1, x2, 1.0), middle, middle, middle) < x
        low, high = (middle, high) if is_below else (low, middle)
    return high


def _blossom(points: tuple[float, ...], *arguments: float) -> float:
    """De Casteljau's scheme with another parameter in each step."""
    for s in arguments:
        points = tuple((1.0 - s) * p + s * q for p, q in pairwise(points))
    return points[0]
