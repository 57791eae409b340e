"""The graph of all correspondences with the least-work path in it: figures 25 and 29."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.matching.landscape import landscape
from shapeblend_cli.model import unroll
from shapeblend_cli.plot.axes import (
    INK,
    LEFT,
    LINE,
    PATH,
    TOP,
    WHOLE,
    Axes,
    page_points,
    signed,
    ticks,
    titled_figure,
    value_text,
)
from shapeblend_cli.svg.writing.figure import Figure, line_data, rect_data

if TYPE_CHECKING:
    from shapeblend_cli.model import BoolArray, FloatArray, IntArray
    from shapeblend_cli.plot.subject import Subject

SIDE = 520.0
"""Longer side of the graph on the page, in pixels."""

SLENDEREST = 0.45
"""Minimum shorter side, as a share of the longer side."""

SHADES = ("#ffffff", "#e8eff6", "#d2e0ee", "#b6cde3", "#97b7d6", "#769fc7", "#5687b7", "#3a6ea3", "#24578a")
"""Colours of dots, the most expensive first, the dots of least work last."""

NO_PATH = "#efe9e2"
"""Colour of dots without a path."""

MOST_CELLS = 160
"""Maximum number of columns, or rows, of shaded cells. In larger graphs several dots share a cell."""

SHADED_DOTS = 2_500_000
"""Maximum number of dots of a graph with shades. More would take gigabytes."""

ARROWS = 30
"""Maximum number of columns and rows of a graph with a grid, and with arrows from dot to dot."""

BEADS = 70
"""Maximum number of columns and rows of a graph in which the dots of the path are marked."""


class Shading(NamedTuple):
    """How much more the least path through each dot costs, infinite if there is none; where lighter shades begin."""

    more: FloatArray
    levels: tuple[float, ...]


def draw(subject: Subject) -> str:
    """Return the figure as a document."""
    columns, rows = shape_of(subject)
    # Cells are square as far as that fits.
    share = max(min(columns, rows) / max(columns, rows), SLENDEREST)
    width, height = (SIDE, SIDE * share) if columns >= rows else (SIDE * share, SIDE)
    deviation = subject.correspondence.diagonal_deviation
    note = f"{subject.work}; diagonal deviation {value_text(deviation)}"
    if subject.band is not None:
        note += f" in a band of {value_text(subject.band)}"
        deviation = subject.band
    figure = titled_figure(
        LEFT + width + 196.0, TOP + height + 64.0, _STYLE, subject.title, subject.contours, note
    )
    axes = Axes(figure, LEFT, TOP, width, height, (-0.5, columns - 0.5), (rows - 0.5, -0.5))
    shading = shade_of(subject) if columns * rows <= SHADED_DOTS else None
    if shading is not None:
        _shade(axes, shading)
    else:
        figure.words("too many dots to be shaded", (LEFT + width / 2.0, TOP - 6.0), "middle-note")
    is_small = max(columns, rows) <= ARROWS
    if is_small:
        axes.grid(range(columns), range(rows))
    _diagonal(axes, columns, rows, deviation)
    _path(axes, unrolled(subject), is_small, max(columns, rows) <= BEADS)
    axes.frame()
    first_a, first_b = subject.correspondence.dots[0].tolist()
    axes.ticks_below(*_vertex_ticks(first_a, columns, subject.wires.m, width), "vertex of A")
    axes.ticks_beside(*_vertex_ticks(first_b, rows, subject.wires.n, height), "vertex of B")
    _legend(figure, LEFT + width + 28.0, subject, shading)
    return figure.text()


_STYLE = f"""
.diagonal{{stroke:{INK};stroke-width:1}}
.deviation{{stroke:{INK};stroke-width:1;stroke-dasharray:5 4}}
.halo{{stroke:#fff;stroke-width:5;stroke-opacity:.85}}
.path{{stroke:{PATH};stroke-width:2.2}}
.dot{{fill:{PATH}}}
.head{{fill:{PATH};stroke:{PATH};stroke-width:.5}}
.cells{{shape-rendering:crispEdges}}
"""


def shape_of(subject: Subject) -> tuple[int, int]:
    """Return the columns and rows; graphs of closed contours end with the vertices they begin with."""
    closed = subject.correspondence.closed
    return subject.wires.m + closed, subject.wires.n + closed


def unrolled(subject: Subject) -> IntArray:
    """Return the path in columns and rows, from (0, 0) to the last column and row."""
    period = (subject.wires.m, subject.wires.n) if subject.correspondence.closed else None
    dots = unroll(subject.correspondence.dots, period).astype(np.intp)
    return dots - dots[0]


def shade_of(subject: Subject) -> Shading:
    """Return how much more the least path through every dot costs."""
    works = landscape(subject.wires, subject.correspondence.dots, subject.band).works
    more = np.maximum(works - subject.correspondence.work, 0.0)
    more[more < 1e-9 * max(subject.correspondence.work, 1.0)] = 0.0
    return Shading(more, levels_of(more, len(SHADES) - 1))


def levels_of(more: FloatArray, count: int) -> tuple[float, ...]:
    """Return round numbers, each about twice the one before, the last near the median extra work."""
    extra = more[np.isfinite(more) & (more > 0.0)]
    if not len(extra):
        return (1.0,)
    median = np.median(extra)
    power = int(np.floor(np.log10(median)))
    series = [f * 10.0**p for p in range(power - count, power + 2) for f in (1.0, 2.0, 5.0)]
    last = int(np.searchsorted(series, median))
    return tuple(float(f"{level:.1g}") for level in series[last - count + 1 : last + 1])


def cells(more: FloatArray) -> tuple[FloatArray, tuple[IntArray, IntArray]]:
    """Return the least of the dots in each cell, and where the columns and rows of cells begin and end."""
    edges = []
    for axis, count in enumerate(more.shape):
        edge = np.linspace(0, count, min(count, MOST_CELLS) + 1).round().astype(np.intp)
        more = np.minimum.reduceat(more, edge[:-1], axis=axis)
        edges.append(edge)
    return more, (edges[0], edges[1])


def rectangles(mask: BoolArray) -> list[tuple[int, int, int, int]]:
    """Cover the true cells with few rectangles ``(column, row, columns, rows)``: runs of a row, equal ones joined."""
    covering = []
    growing: dict[tuple[int, int], int] = {}
    for row in range(mask.shape[1] + 1):
        line = mask[:, row] if row < mask.shape[1] else np.zeros(mask.shape[0], np.bool_)
        turns = np.flatnonzero(np.diff(np.concatenate([[False], line, [False]]))).reshape(-1, 2)
        runs = {(int(first), int(last)) for first, last in turns}
        covering += [
            (c, top, end - c, row - top) for (c, end), top in growing.items() if (c, end) not in runs
        ]
        growing = {run: growing.get(run, row) for run in sorted(runs)}
    return sorted(covering)


def _shade(axes: Axes, shading: Shading) -> None:
    """Paint cells from expensive to cheap, the cheaper ones over the others."""
    least, (across, down) = cells(shading.more)
    figure = axes.figure
    figure.path(rect_data(axes.left, axes.top, axes.width, axes.height), "cells", fill=NO_PATH)
    masks = [least < limit for limit in (np.inf, *reversed(shading.levels))]
    for k, (shade, mask) in enumerate(zip(_shades(shading.levels), masks, strict=True)):
        if k + 1 < len(masks) and np.array_equal(mask, masks[k + 1]):
            continue  # nothing of this shade will show
        data = []
        for column, row, columns, rows in rectangles(mask):
            x0, y0 = axes.at(across[column] - 0.5, down[row] - 0.5)
            x1, y1 = axes.at(across[column + columns] - 0.5, down[row + rows] - 0.5)
            data.append(rect_data(x0, y0, x1 - x0, y1 - y0))
        figure.path("".join(data), "cells", fill=shade)


def _shades(levels: tuple[float, ...]) -> tuple[str, ...]:
    """Return the shade above all levels, then the one below each, from the highest on."""
    return (SHADES[0], *SHADES[len(SHADES) - len(levels) :])


def _diagonal(axes: Axes, columns: int, rows: int, band: float) -> None:
    """Draw the diagonal of the graph, and on either side the line of the largest deviation, eq (29)."""
    x, y = columns - 1.0, rows - 1.0
    axes.figure.line([axes.at(0.0, 0.0), axes.at(x, y)], "diagonal")
    if not 0.0 < band < 1.0:
        return
    axes.figure.line([axes.at(band * x, 0.0), axes.at(x, (1.0 - band) * y)], "deviation")
    axes.figure.line([axes.at(0.0, band * y), axes.at((1.0 - band) * x, y)], "deviation")


def _path(axes: Axes, dots: IntArray, arrows: bool, beads: bool) -> None:
    points = [axes.at(column, row) for column, row in dots.tolist()]
    figure = axes.figure
    figure.line(points, "halo")
    figure.line(points, "path")
    if arrows:
        figure.path("".join(_head(p, q) for p, q in pairwise(points)), "head")
    if arrows or beads:
        for point in points:
            figure.circle(point, 4.0 if arrows else 2.4, "dot")


def _head(p: tuple[float, float], q: tuple[float, float]) -> str:
    """Return the head of an arrow that ends short of a dot."""
    step = complex(*q) - complex(*p)
    unit = step / abs(step)
    tip = complex(*q) - 4.5 * unit
    corners = np.array([tip, tip - (8.0 + 3.2j) * unit, tip - (8.0 - 3.2j) * unit])
    return line_data(page_points(corners), closed=True)


def _vertex_ticks(first: int, count: int, period: int, side: float) -> tuple[list[int], list[str]]:
    """Return the columns or rows of round vertex numbers, and these numbers."""
    round_ones = [round(v) for v in ticks(0.0, period - 1.0, max(int(side / 34.0), 2), WHOLE)]
    names = {(v - first) % period: str(v) for v in round_ones}
    if count > period and 0 in names:  # the last is the first again
        names[period] = names[0]
    return list(names), list(names.values())


def _legend(figure: Figure, left: float, subject: Subject, shading: Shading | None) -> None:
    top = TOP + 8.0
    for kind, name in (
        ("path", "least-work path"),
        ("diagonal", "diagonal"),
        ("deviation", "deviation" if subject.band is None else "band"),
    ):
        figure.line([(left, top - 4.0), (left + 22.0, top - 4.0)], kind)
        figure.words(name, (left + 30.0, top), "note")
        top += LINE
    if shading is None:
        return
    top += 16.0
    figure.words("more work than the path", (left, top), "note")
    top += 12.0
    shades = list(reversed(_shades(shading.levels)))
    for k, shade in enumerate(shades):
        figure.path(rect_data(left, top + 20.0 * k, 22.0, 20.0), "cells frame", fill=shade)
    for k, level in enumerate(shading.levels, 1):
        figure.words(signed(level), (left + 30.0, top + 20.0 * k + 4.0), "note")
    if not np.isfinite(shading.more).all():
        below = top + 20.0 * len(shades) + 10.0
        figure.path(rect_data(left, below, 22.0, 14.0), "cells frame", fill=NO_PATH)
        figure.words("no path", (left + 30.0, below + 11.0), "note")
