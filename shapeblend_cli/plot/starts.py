"""The least work by the starting correspondence (section 4.2)."""

from __future__ import annotations

from itertools import groupby
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.errors import MatchError
from shapeblend_cli.match.solve import EXACT_DOTS
from shapeblend_cli.match.starts import least_by_start
from shapeblend_cli.plot.axes import (
    COLOUR_A,
    LEFT,
    NOTHING,
    PATH,
    STYLE,
    TOP,
    WHOLE,
    Axes,
    heading,
    ticks,
    value_text,
)
from shapeblend_cli.svg.writing.figure import Figure

if TYPE_CHECKING:
    from shapeblend_cli.model import FloatArray
    from shapeblend_cli.plot.subject import Subject

WIDTH, HEIGHT = 600.0, 320.0

MUCH = 30.0
"""Works that differ by more than this factor are drawn by powers of ten."""

BEADS = 80
"""Up to so many starts each has a bead."""

_STYLE = f"""
.work{{stroke:{COLOUR_A};stroke-width:1.8}}
.start{{fill:{COLOUR_A}}}
.best{{fill:{PATH};stroke:#fff;stroke-width:1.5}}
"""


def draw(subject: Subject) -> str:
    """The figure as a document."""
    works = works_of(subject)
    vertex = start_vertex(subject)
    best = int(works.argmin())
    figure = Figure(LEFT + WIDTH + 36.0, TOP + HEIGHT + 64.0, STYLE + _STYLE)
    least = f"least with vertex {vertex} of A at vertex {best} of B: work {value_text(works[best])}"
    band = "" if subject.band is None else f", in a band of {value_text(subject.band)}"
    heading(figure, subject.title, [subject.contours, least + band])

    scale = scale_for(works)
    shown = scale.heights(works)
    axes = Axes(figure, LEFT, TOP, WIDTH, HEIGHT, (-0.5, len(works) - 0.5), (scale.low, scale.high))
    axes.grid([], [height for height, _ in scale.levels])
    places = [axes.at(j, y) for j, y in enumerate(shown.tolist())]
    for finite, run in groupby(
        zip(places, np.isfinite(works).tolist(), strict=True), key=lambda place: place[1]
    ):
        if finite:
            line = [place for place, _ in run]
            figure.line(line, "work")
            if len(works) <= BEADS or len(line) == 1:
                for place in line:
                    figure.circle(place, 2.6, "start")
    figure.circle(places[best], 6.0, "best")
    axes.frame()
    axes.ticks_below(
        whole := ticks(0.0, len(works) - 1.0, 12, WHOLE),
        [f"{v:.0f}" for v in whole],
        f"vertex of B for vertex {vertex} of A",
    )
    axes.ticks_beside(
        [h for h, _ in scale.levels], [value_text(work) for _, work in scale.levels], "least work"
    )
    return figure.text()


def start_vertex(subject: Subject) -> int:
    """The vertex of A whose partner is looked for."""
    return subject.dot[0] if subject.dot else 0


def works_of(subject: Subject) -> FloatArray:
    """The least work over paths from each start, infinite where a band leaves none.

    Raises
    ------
    MatchError
        Open contours, graphs too large, a band that leaves nothing.
    """
    if not subject.found.closed:
        raise MatchError(
            "open contours start at their ends, so there are no starts to compare; closed ones would work"
        )
    if subject.wires.m * subject.wires.n > EXACT_DOTS["auto"]:
        raise MatchError(
            f"{subject.wires.n} starts of {subject.wires.m} and {subject.wires.n} vertices would take very long; "
            "a smaller --vertices would work"
        )
    works = least_by_start(subject.wires, start_vertex(subject), subject.band, subject.watch)
    if not np.isfinite(works).any():
        raise MatchError(f"no path stays within {subject.band:g} of any diagonal; a wider band would work")
    return works


class Scale(NamedTuple):
    """How high works are drawn.

    Attributes
    ----------
    low, high : float
        Heights of the bottom and the top.
    levels : tuple of (float, float)
        Heights and works of the ticks.
    least : float or None
        Works are drawn as their logarithms, smaller ones than this as nothing, at `low`; None draws them as they are.
    """

    low: float
    high: float
    levels: tuple[tuple[float, float], ...]
    least: float | None

    def heights(self, works: FloatArray) -> FloatArray:
        """Where works are."""
        if self.least is None:
            return works
        return np.where(works < self.least, self.low, np.log10(np.maximum(works, self.least)))


def scale_for(works: FloatArray) -> Scale:
    """As they are, or by powers of ten where they differ much."""
    finite = works[np.isfinite(works)]
    some = finite[finite > NOTHING]
    if not len(some) or some.max() <= MUCH * some.min():
        high = 1.06 * float(some.max(initial=0.0)) or 1.0
        return Scale(0.0, high, tuple((v, v) for v in ticks(0.0, high)), None)
    least, most = float(some.min()), float(some.max())
    low, high = np.log10(least), np.log10(most)
    factors = (1.0, 2.0, 5.0) if high - low < 3.0 else (1.0,)
    steps = range(int(np.floor(low)), int(np.ceil(high)) + 1)
    works_of_levels = [factor * 10.0**power for power in steps for factor in factors]
    levels = [(float(np.log10(work)), work) for work in works_of_levels if least <= work <= most]
    room = 0.06 * (high - low)
    if len(some) == len(finite):
        return Scale(float(low - room), float(high + room), tuple(levels), least)
    bottom = float(low - 4.0 * room)
    return Scale(bottom, float(high + room), ((bottom, 0.0), *levels), least)
