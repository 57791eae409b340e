"""How far in-betweens are off wherever and whenever they are: with the shift, the scale and the time that suit best.

A tool may place and time its in-betweens in a way of its own, which is no fault of the shape. What is found is a
minimum nearby: of a few ways to lay the in-between on the truth, the best is mended step by step.
"""

from __future__ import annotations

import functools
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
import shapely

from shapeblend_cli.geometry.polyline import cumulative_lengths, from_end_to_end
from shapeblend_cli.model import Box
from tools.quality.truth.form import TIMES
from tools.quality.truth.measures import extent, region, regions_apart, ring

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from tools.quality.scores import Frame
    from tools.quality.truth.form import Truth

TEMPO = 2.5
"""An in-between may be so many times as far on its way, counted as odds, or as little, but no more."""

POINTS = 120
"""Outlines are compared at about so many places."""

LEAST_POINTS = 8
"""And each contour at no fewer."""

GRID, CUTS, BEST = 7, 9, 3
"""How many times are tried at first, how often the interval around the best is cut, and how many times are kept."""

GOLDEN = (np.sqrt(5.0) - 1.0) / 2.0

STEP = np.array([0.04, 0.012, 0.012, 0.012])
"""First steps of time, of the shift as a share of the size, and of the logarithm of the scale."""

FINER, ROUNDS, PASSES = 2.5, 3, 4
"""Steps get shorter by this factor, so often, after at most so many passes with each."""

BETTER = 1e-6
"""What is better by less is not."""


class Anchor(NamedTuple):
    """Where a drawing is, and how large."""

    centre: complex
    size: float


def shape(truth: Truth, frames: Sequence[Frame]) -> float:
    """How little in-betweens cover what they should where and when it suits them, mean over the times."""
    return float(np.mean([_Fit(truth, frame, t).best() for t, frame in zip(TIMES, frames, strict=True)]))


class _Fit:
    """One in-between, to be laid on the truth: a time, a shift in x and y, and the logarithm of a scale."""

    def __init__(self, truth: Truth, frame: Frame, t: float) -> None:
        self.truth, self.t = truth, t
        self.region, self.anchors = region(frame), anchors(frame)
        self.centre = self.anchors[0].centre
        self.frame = [contour - self.centre for contour in frame]
        self.earliest, self.latest = (tempo * t / (1.0 - t + tempo * t) for tempo in (1.0 / TEMPO, TEMPO))
        self.true = functools.cache(truth.at_own)
        self.true_region = functools.cache(lambda time: region(self.true(time)))
        self.true_anchors = functools.cache(lambda time: anchors(self.true(time)))

    def best(self) -> float:
        """What is uncovered where it is laid best."""
        laid = min(self.starts(), key=self.apart)
        least = self.apart(laid)
        step = STEP * [1.0, *[extent([*self.truth.frames[0], *self.truth.frames[-1]])] * 2, 1.0]
        for _ in range(ROUNDS):
            for _ in range(PASSES):
                before = least
                for axis in np.diag(step):
                    for tried in (laid + axis, laid - axis):
                        if (found := self.apart(tried)) < least - BETTER:
                            laid, least = tried, found
                            break
                if least == before:
                    break
            step = step / FINER
        return least

    def starts(self) -> Iterator[np.ndarray]:
        """As the files lie; and by each anchor, at the times at which outlines are nearest to each other."""
        size = self.truth.size_at(self.t)
        (centre,) = self.truth.laid_back([self.centre], self.t)
        yield _laid(self.truth.own_time(self.t), centre, -np.log(size))
        for kind in range(len(self.anchors)):
            distances = searched(functools.partial(self.distance, kind), self.earliest, self.latest)
            for time in sorted(distances, key=distances.__getitem__)[:BEST]:
                yield self.by_anchor(kind, time)

    def by_anchor(self, kind: int, time: float) -> np.ndarray:
        """Laid so that an anchor is where the truth has it."""
        own, true = self.anchors[kind], self.true_anchors(_rounded(time))[kind]
        scale = true.size / own.size
        return _laid(time, true.centre + (self.centre - own.centre) * scale, np.log(scale))

    def distance(self, kind: int, time: float) -> float:
        """How far apart the outlines are where an anchor is laid on the truth's."""
        _, x, y, scale = self.by_anchor(kind, time)
        placed = [contour * np.exp(scale) + complex(x, y) for contour in self.frame]
        return outlines_apart(placed, self.true(_rounded(time)))

    def apart(self, laid: np.ndarray) -> float:
        """How much of the area that either covers is not covered by both."""
        time, x, y, scale = laid
        if not self.earliest <= time <= self.latest:
            return np.inf
        centre = np.array([self.centre.real, self.centre.imag])
        placed = shapely.transform(self.region, lambda p: (p - centre) * np.exp(scale) + [x, y])
        return regions_apart(placed, self.true_region(_rounded(time)))


def _laid(time: float, place: complex, scale: float) -> np.ndarray:
    return np.array([time, place.real, place.imag, scale])


def _rounded(time: float) -> float:
    """A time at which the truth need not be made again."""
    return round(float(time), 5)


def searched(function: Callable[[float], float], low: float, high: float) -> dict[float, float]:
    """Values of a function at even places, and on the way to a minimum by golden section."""
    known = {place: function(place) for place in np.linspace(low, high, GRID).tolist()}
    places = list(known)
    k = min(range(GRID), key=lambda k: known[places[k]])
    low, high = places[max(k - 1, 0)], places[min(k + 1, GRID - 1)]
    inner = [high - (high - low) * GOLDEN, low + (high - low) * GOLDEN]
    for _ in range(CUTS):
        known |= {place: function(place) for place in inner if place not in known}
        if known[inner[0]] <= known[inner[1]]:
            high = inner[1]
            inner = [high - (high - low) * GOLDEN, inner[0]]
        else:
            low = inner[0]
            inner = [inner[1], low + (high - low) * GOLDEN]
    return known


def anchors(frame: Frame) -> list[Anchor]:
    """Where a drawing is and how large: by its outlines, by its box, and by its area."""
    lines = [from_end_to_end(contour, closed=True) for contour in frame]
    starts, ends = (np.concatenate([line[part] for line in lines]) for part in (slice(-1), slice(1, None)))
    weights = np.abs(ends - starts) / np.abs(ends - starts).sum()
    centre = complex((weights * (starts + ends)).sum() / 2.0)
    # The mean of squared distances over a side from p to q is a third of |p|^2 + p.q + |q|^2.
    p, q = starts - centre, ends - centre
    spread = weights @ (np.abs(p) ** 2 + (p.conj() * q).real + np.abs(q) ** 2) / 3.0
    box, inside = Box.around(np.concatenate(frame)), region(frame)
    middle = inside.centroid if inside.area else shapely.Point(box.centre.real, box.centre.imag)
    area = Anchor(complex(middle.x, middle.y), np.sqrt(inside.area) or box.diagonal)
    return [Anchor(centre, np.sqrt(spread)), Anchor(box.centre, box.diagonal), area]


def outlines_apart(p: Frame, q: Frame) -> float:
    """The mean distance of the places on each to the other."""
    lines = [shapely.MultiLineString([ring(contour) for contour in frame]) for frame in (p, q)]
    places = [shapely.points(spread(frame).real, spread(frame).imag) for frame in (p, q)]
    return float(np.mean([shapely.distance(places[k], lines[1 - k]).mean() for k in (0, 1)]))


def spread(frame: Frame) -> np.ndarray:
    """Places at even distances along each contour, by its share of the whole length."""
    lines = [from_end_to_end(contour, closed=True) for contour in frame]
    lengths = [cumulative_lengths(line) for line in lines]
    whole = sum(reached[-1] for reached in lengths)
    found = []
    for line, reached in zip(lines, lengths, strict=True):
        count = max(LEAST_POINTS, round(POINTS * reached[-1] / whole))
        found.append(np.interp((np.arange(count) + 0.5) / count * reached[-1], reached, line))
    return np.concatenate(found)
