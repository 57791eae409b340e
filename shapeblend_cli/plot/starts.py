"""The least work by the starting correspondence (section 4.2)."""

from __future__ import annotations

from itertools import groupby
from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.errors import MatchError
from shapeblend_cli.match.solve import EXACT_DOTS
from shapeblend_cli.match.starts import least_by_start
from shapeblend_cli.plot.axes import COLOUR_A, LEFT, PATH, STYLE, TOP, WHOLE, Axes, heading, ticks, value_text
from shapeblend_cli.svg.figure import Figure

if TYPE_CHECKING:
    from shapeblend_cli.model import FloatArray
    from shapeblend_cli.plot.subject import Subject

WIDTH, HEIGHT = 600.0, 320.0

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

    log = needs_decades(works)
    shown = np.log10(works) if log else works
    low, high = _range(shown, log)
    axes = Axes(figure, LEFT, TOP, WIDTH, HEIGHT, (-0.5, len(works) - 0.5), (low, high))
    levels = _decades(low, high) if log else ticks(low, high)
    axes.grid([], levels)
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
    axes.ticks_beside(levels, [value_text(10.0**v if log else v) for v in levels], "least work")
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


def needs_decades(works: FloatArray) -> bool:
    """Whether the works differ so much that powers of ten show more."""
    finite = works[np.isfinite(works)]
    return bool(finite.min() > 0.0 and finite.max() > 30.0 * finite.min())


def _range(shown: FloatArray, log: bool) -> tuple[float, float]:
    finite = shown[np.isfinite(shown)]
    low, high = (float(finite.min()), float(finite.max())) if log else (0.0, float(finite.max()))
    room = 0.06 * (high - low) or 1.0
    return (low - room if log else 0.0), high + room


def _decades(low: float, high: float) -> list[float]:
    """Logarithms of round numbers: 1, 2, 5, 10 and so on, or only powers of ten."""
    powers = range(int(np.floor(low)), int(np.ceil(high)) + 1)
    factors = (1.0, 2.0, 5.0) if high - low < 3.0 else (1.0,)
    levels = [float(p + np.log10(f)) for p in powers for f in factors]
    return [level for level in levels if low <= level <= high]
