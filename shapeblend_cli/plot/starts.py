"""The least work for each starting correspondence (section 4.2)."""

from __future__ import annotations

import math
from itertools import groupby
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.errors import MatchError
from shapeblend_cli.matching.solve import EXACT_DOTS
from shapeblend_cli.matching.starts import least_by_start
from shapeblend_cli.plot.axes import (
    COLOUR_A,
    LEFT,
    NOTHING,
    PATH,
    TOP,
    WHOLE,
    Axes,
    ticks,
    titled_figure,
    value_text,
)

if TYPE_CHECKING:
    from shapeblend_cli.model import FloatArray
    from shapeblend_cli.plot.subject import Subject

WIDTH, HEIGHT = 600.0, 320.0

MUCH = 30.0
"""Works that differ by more than this factor are drawn on a logarithmic scale."""

BEADS = 80
"""Up to so many starts each is marked."""

_STYLE = f"""
.work{{stroke:{COLOUR_A};stroke-width:1.8}}
.start{{fill:{COLOUR_A}}}
.best{{fill:{PATH};stroke:#fff;stroke-width:1.5}}
"""


def draw(subject: Subject) -> str:
    """Return the figure as a document."""
    works = works_of(subject)
    vertex, best = start_vertex(subject), int(works.argmin())
    least = f"least with vertex {vertex} of A at vertex {best} of B: work {value_text(works[best])}"
    band = "" if subject.band is None else f", in a band of {value_text(subject.band)}"
    figure = titled_figure(
        LEFT + WIDTH + 36.0, TOP + HEIGHT + 64.0, _STYLE, subject.title, subject.contours, least + band
    )
    scale = scale_for(works)
    axes = Axes(figure, LEFT, TOP, WIDTH, HEIGHT, (-0.5, len(works) - 0.5), (scale.low, scale.high))
    axes.grid([], [height for height, _ in scale.ticks])
    points = [axes.at(j, y) for j, y in enumerate(scale.heights(works).tolist())]
    for finite, run in groupby(range(len(works)), key=lambda j: bool(np.isfinite(works[j]))):
        line = [points[j] for j in run]
        if finite:
            figure.line(line, "work")
            for point in line if len(works) <= BEADS or len(line) == 1 else ():
                figure.circle(point, 2.6, "start")
    figure.circle(points[best], 6.0, "best")
    axes.frame()
    whole = ticks(0.0, len(works) - 1.0, 12, WHOLE)
    axes.ticks_below(whole, [f"{v:.0f}" for v in whole], f"vertex of B for vertex {vertex} of A")
    axes.ticks_beside(
        [h for h, _ in scale.ticks], [value_text(work) for _, work in scale.ticks], "least work"
    )
    return figure.text()


def start_vertex(subject: Subject) -> int:
    """Return the vertex of A whose partner varies."""
    return subject.dot[0] if subject.dot else 0


def works_of(subject: Subject) -> FloatArray:
    """Return the least work over paths from each start, infinite where a band leaves none.

    Raises
    ------
    MatchError
        Open contours, graphs too large, a band that leaves nothing.
    """
    if not subject.correspondence.closed:
        raise MatchError(
            "open contours start at their ends, so there are no starts to compare; closed ones would work"
        )
    if subject.wires.m * subject.wires.n > EXACT_DOTS["auto"]:
        raise MatchError(
            f"{subject.wires.n} starts of {subject.wires.m} and {subject.wires.n} vertices would take very long; "
            "a smaller --vertices would work"
        )
    works = least_by_start(subject.wires, start_vertex(subject), subject.band, subject.progress)
    if not np.isfinite(works).any():
        raise MatchError(f"no path stays within {subject.band:g} of any diagonal; a wider band would work")
    return works


class Scale(NamedTuple):
    """How high works are drawn: the bottom and the top, and heights and works of ticks.

    Where there is a least work, works are drawn as their logarithms, and smaller ones than that at the bottom.
    """

    low: float
    high: float
    ticks: tuple[tuple[float, float], ...]
    least: float | None

    def heights(self, works: FloatArray) -> FloatArray:
        """Return how high works are drawn."""
        if self.least is None:
            return works
        return np.where(works < self.least, self.low, np.log10(np.maximum(works, self.least)))


def scale_for(works: FloatArray) -> Scale:
    """Return a linear scale, or a logarithmic one where works differ much."""
    finite = works[np.isfinite(works)]
    some = finite[finite > NOTHING]
    if not len(some) or some.max() <= MUCH * some.min():
        high = 1.06 * float(some.max(initial=0.0)) or 1.0
        return Scale(0.0, high, tuple((v, v) for v in ticks(0.0, high)), None)
    least, most = float(some.min()), float(some.max())
    low, high = float(np.log10(least)), float(np.log10(most))
    factors = (1.0, 2.0, 5.0) if high - low < 3.0 else (1.0,)
    powers = range(math.floor(low), math.ceil(high) + 1)
    round_works = [factor * 10.0**power for power in powers for factor in factors]
    levels = [(float(np.log10(work)), work) for work in round_works if least <= work <= most]
    room = 0.06 * (high - low)
    if len(some) == len(finite):
        return Scale(low - room, high + room, tuple(levels), least)
    bottom = low - 4.0 * room
    return Scale(bottom, high + room, ((bottom, 0.0), *levels), least)
