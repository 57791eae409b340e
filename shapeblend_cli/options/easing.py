"""The timing of animations, and easing as in CSS: the progress of a blend after a share of its time.

https://www.w3.org/TR/css-easing-1/#cubic-bezier-easing-functions
"""

from __future__ import annotations

import math
import re
from bisect import bisect_right
from collections.abc import Callable, Sequence
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

OVERSHOOT = 1.70158
"""Strength of ``back``: a tenth of the way beyond, as in most libraries of easing."""

TOLERANCE = 3e-3
"""Maximum deviation of the lines of a `Curve` from the easing that was asked for, as a share of the way."""

SAMPLES = 2048
"""Number of even steps in time at which an easing is compared with the lines of its `Curve`."""

SETTLED = 1e-3
"""Maximum distance of a spring from its rest at the end of its time, as a share of the way."""

MOST_KNOTS = 400
"""Maximum number of knots of a `Curve`: each becomes a keyframe of each part."""

FURTHEST = 3.0
"""Maximum distance of an easing beyond either drawing, as a share of the way."""


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

Knots = tuple[tuple[float, float], ...]
"""Times, rising from 0 to 1, and progress at each; straight in between."""


class Curve(NamedTuple):
    """Easing that may go beyond 0 and 1, or turn round on its way: progress is on lines from knot to knot."""

    text: str
    knots: Knots

    def __str__(self) -> str:
        """As it was asked for."""
        return self.text

    def css(self) -> str:
        """As CSS takes it."""
        inner = [f"{share:.4g} {100.0 * time:.5g}%" for time, share in self.knots]
        return f"linear({','.join(inner)})"

    def at(self, time: float) -> float:
        """Progress at a time from 0 to 1."""
        return along(self.knots, time)

    def time_of(self, progress: float) -> float:
        """Time at which a progress from 0 to 1 is reached first."""
        k = next(k for k, (_, share) in enumerate(self.knots) if share >= progress)
        if k == 0:
            return 0.0
        (start, low), (end, high) = self.knots[k - 1 : k + 1]
        return start + (end - start) * (progress - low) / (high - low)

    def mirrored(self) -> Curve:
        """The same way back."""
        return Curve(self.text, tuple((1.0 - time, 1.0 - share) for time, share in self.knots[::-1]))


Easing = Ease | Curve


def along(knots: Knots, time: float) -> float:
    """Return the value at a time from 0 to 1 on the lines from knot to knot."""
    k = min(max(bisect_right(knots, time, key=lambda knot: knot[0]), 1), len(knots) - 1)
    (start, low), (end, high) = knots[k - 1 : k + 1]
    return low + (high - low) * (time - start) / (end - start)


def knots_of(ease: Easing) -> Knots:
    """Return the knots of any easing."""
    return ease.knots if isinstance(ease, Curve) else _knots(ease.at)


FOREVER, PINGPONG = "forever", "pingpong"


class Timing(NamedTuple):
    """How an animation runs.

    The identifiers in CSS animations are made from the text of this value.
    """

    seconds: float = 2.0  # > 0, from one drawing to the next, like the easing
    ease: Ease = LINEAR
    repeat: int | str = FOREVER  # how often it runs; or "pingpong": forwards and backwards forever
    hold: tuple[float, float] = (0.0, 0.0)  # seconds of rest at the first drawing, and at each of the others
    delay: float = 0.0  # seconds before the first run

    def __repr__(self) -> str:
        """Return the text of a value; without rests and a delay that of versions that had none."""
        late = {name: self._field_defaults[name] for name in ("hold", "delay")}
        shown = {name: value for name, value in self._asdict().items() if value != late.get(name)}
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


def frame_times(frames: int, ends: bool, ease: Easing = LINEAR) -> list[float]:
    """Return the times of `frames` in-betweens, evenly spaced before easing, and of both ends if wanted."""
    times = [ease.at(k / (frames + 1)) for k in range(frames + 2)]
    return times if ends else times[1:-1]


def parse(text: str) -> Easing:
    """Read an easing as the help lists them; raise ValueError for anything else."""
    words = "".join(text.split()).lower() if "linear(" not in text.lower() else text.strip().lower()
    if words in NAMES:
        return Ease(*NAMES[words])
    if words in CURVES:
        return Curve(words, _knots(CURVES[words]))
    name, bracket, body = words.partition("(")
    if not (bracket and body.endswith(")")):
        raise ValueError(text)
    if name == "linear":
        return Curve(words, _stops(body[:-1]))
    numbers = [float(number) for number in body[:-1].split(",")]
    if name == "cubic-bezier":
        x1, y1, x2, y2 = numbers
        if not (0.0 <= min(x1, x2) and max(x1, x2) <= 1.0):
            raise ValueError(text)
        if 0.0 <= min(y1, y2) and max(y1, y2) <= 1.0:
            return Ease(x1, y1, x2, y2)
        return Curve(words, _knots(lambda time: _solved(x1, x2, y1, y2, time)))
    if name == "spring":
        mass, stiffness, damping = numbers
        return Curve(words, _knots(_spring(mass, stiffness, damping)))
    raise ValueError(text)


LIKE = {
    "back": "back overshoot anticipate",
    "elastic": "elastic bounce wobble",
    "ease": "sine quad cubic quart quint expo circ power1 power2 power3 power4 swing smooth",
}
"""Words for easings elsewhere, by the family here that comes closest."""

FORMS = {
    "cubic-bezier": ("x1,y1,x2,y2", "cubic-bezier(.34,1.56,.64,1)"),
    "spring": ("mass,stiffness,damping", "spring(1,100,10)"),
    "linear": ("0,...,1", "linear(0,1.2,1)"),
}
"""Easings with numbers: what these are, and an example."""


def wrong(text: str) -> str:
    """Return what is wrong with a text that `parse` does not read, with what would work; empty if it is like nothing.

    Examples
    --------
    >>> print(wrong("easeOutBack"))
    a known easing, not 'easeOutBack'; back-out would work
    >>> print(wrong("spring"))
    spring(mass,stiffness,damping), not 'spring'; spring(1,100,10) would work
    """
    name, _, body = "".join(text.split()).lower().partition("(")
    if name in FORMS:
        numbers, example = FORMS[name]
        problem = f", not {text!r}"
        given = [word for word in body.rstrip(")").split(",") if word]
        if name == "cubic-bezier" and len(given) == 4 and body.endswith(")"):
            off = [f"{axis} is {x}" for axis, x in zip(("x1", "x2"), given[::2], strict=True) if _is_off(x)]
            problem = f" with x1 and x2 between 0 and 1, and {' and '.join(off)}" if off else problem
        elif name != "linear" and given and len(given) != numbers.count(",") + 1:
            problem = f"{problem}, which has {len(given)} number{'s' * (len(given) > 1)}"
        return f"{name}({numbers}){problem}; {example} would work"
    words = [word.lower() for word in re.findall(r"[A-Z]?[a-z]+[0-9]?", text.partition("(")[0])]
    if words == ["steps"]:
        return f"a known easing, not {text!r}; stops of linear(0,...,1) make steps"
    family = [ours for ours, theirs in LIKE.items() if set(theirs.split()) & {*words}]
    if not family and "ease" not in words[:1] and not {*words} & {"in", "out"}:
        return ""
    way = "-".join(word for word in ("in", "out") if word in words)
    way = way or ("in" if "anticipate" in words else "out")
    found = f"{family[0] if family else 'ease'}-{way}"
    return f"a known easing, not {text!r}; {found} would work"


def _is_off(text: str) -> bool:
    try:
        return not 0.0 <= float(text) <= 1.0
    except ValueError:
        return True


def _back(time: float) -> float:
    return time * time * ((OVERSHOOT + 1.0) * time - OVERSHOOT)


def _elastic(time: float) -> float:
    return -(2.0 ** (10.0 * time - 10.0)) * math.sin((10.0 * time - 10.75) * 2.0 * math.pi / 3.0)


def _out(ease: Callable[[float], float]) -> Callable[[float], float]:
    return lambda time: 1.0 - ease(1.0 - time)


def _in_out(ease: Callable[[float], float]) -> Callable[[float], float]:
    return lambda time: ease(2.0 * time) / 2.0 if time < 0.5 else 1.0 - ease(2.0 - 2.0 * time) / 2.0


CURVES = {
    f"{name}{suffix}": way(ease)
    for name, ease in {"back": _back, "elastic": _elastic}.items()
    for suffix, way in {"": _out, "-in": lambda ease: ease, "-out": _out, "-in-out": _in_out}.items()
}
"""Easing that overshoots; without more words at the end, as most libraries of animation have it."""


def _spring(mass: float, stiffness: float, damping: float) -> Callable[[float], float]:
    """Return the way of a weight on a spring from its release until it has settled, in that time."""
    if not all(0.0 < value < 1e6 for value in (mass, stiffness, damping)):
        raise ValueError
    own = math.sqrt(stiffness / mass)
    ratio = damping / (2.0 * math.sqrt(stiffness * mass))
    slowest = ratio * own if ratio <= 1.0 else own / (ratio + math.sqrt(ratio * ratio - 1.0))
    length = math.log(1.0 / SETTLED) / slowest

    def way(time: float) -> float:
        at = time * length
        if abs(ratio - 1.0) < 1e-6:
            return 1.0 - math.exp(-own * at) * (1.0 + own * at)
        wave = own * math.sqrt(abs(1.0 - ratio * ratio))
        if ratio < 1.0:
            swing = math.cos(wave * at) + ratio * own / wave * math.sin(wave * at)
            return 1.0 - math.exp(-ratio * own * at) * swing
        fast, slow = -ratio * own - wave, -slowest
        return 1.0 + (slow * math.exp(fast * at) - fast * math.exp(slow * at)) / (fast - slow)

    return way


def _stops(body: str) -> Knots:
    """Read the stops of ``linear()`` as CSS does: those without a time are spaced evenly between the others."""
    shares: list[float] = []
    times: list[float | None] = []
    for stop in body.split(","):
        numbers = [word for word in stop.split() if not word.endswith("%")]
        given = [float(word[:-1]) / 100.0 for word in stop.split() if word.endswith("%")]
        if len(numbers) != 1 or len(given) > 2:
            raise ValueError(body)
        shares += [float(numbers[0])] * max(len(given), 1)
        times += given or [None]
    times[0], times[-1] = (0.0 if times[0] is None else times[0]), (1.0 if times[-1] is None else times[-1])
    known = [k for k, time in enumerate(times) if time is not None]
    spaced: list[float] = []
    for first, last in pairwise(known):
        begin, until = times[first] or 0.0, times[last] or 0.0
        spaced += [begin + (until - begin) * n / (last - first) for n in range(last - first)]
    spaced.append(times[-1] or 0.0)
    # A jump takes the least time that files can tell.
    for k in range(1, len(spaced)):
        spaced[k] = max(spaced[k], spaced[k - 1] + 1e-4)
    knots = tuple(zip(spaced, shares, strict=True))
    if len(knots) < 2 or knots[0] != (0.0, 0.0) or shares[-1] != 1.0 or not 1.0 <= spaced[-1] < 1.01:
        raise ValueError(body)
    return _checked([(time / spaced[-1], share) for time, share in knots])


def _knots(ease: Callable[[float], float]) -> Knots:
    """Return the fewest knots, nearly, that stay as close to an easing as `TOLERANCE`."""
    points = [(k / SAMPLES, ease(k / SAMPLES)) for k in range(SAMPLES + 1)]
    points[0], points[-1] = (0.0, 0.0), (1.0, 1.0)
    kept, ranges = {0, SAMPLES}, [(0, SAMPLES)]
    while ranges:
        first, last = ranges.pop()
        (start, low), (end, high) = points[first], points[last]
        off, worst = max(
            (abs(share - low - (high - low) * (time - start) / (end - start)), k)
            for k, (time, share) in enumerate(points[first : last + 1], first)
        )
        if off > TOLERANCE:
            kept.add(worst)
            ranges += [(first, worst), (worst, last)]
    return _checked([points[k] for k in sorted(kept)])


def _checked(knots: Sequence[tuple[float, float]]) -> Knots:
    if len(knots) > MOST_KNOTS or not all(
        -FURTHEST <= share <= 1.0 + FURTHEST for _, share in knots
    ):  # nan, too
        raise ValueError
    return tuple(knots)


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
