"""The graph of all correspondences with the least-work path in it: figures 25 and 29."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.match.landscape import landscape
from shapeblend_cli.plot.axes import (
    INK,
    LEFT,
    LINE,
    PATH,
    STYLE,
    TOP,
    WHOLE,
    Axes,
    heading,
    signed,
    ticks,
    value_text,
)
from shapeblend_cli.svg.writing.figure import Figure, line_data, rect_data

if TYPE_CHECKING:
    from shapeblend_cli.model import BoolArray, FloatArray, IntArray
    from shapeblend_cli.plot.subject import Subject

SIDE = 520.0
"""The longer side of the graph on the page."""

SLENDEREST = 0.45
"""The shorter side, at least, as a share of the longer one."""

SHADES = ("#ffffff", "#e8eff6", "#d2e0ee", "#b6cde3", "#97b7d6", "#769fc7", "#5687b7", "#3a6ea3", "#24578a")
"""From dear to cheap, the last for dots that cost nothing more."""

NO_PATH = "#efe9e2"
"""Dots no path goes through."""

MOST_CELLS = 160
"""Columns or rows that are shaded singly; of more, several become one."""

SHADED_DOTS = 2_500_000
"""Graphs of more dots are not shaded: it would take gigabytes."""

ARROWS = 30
"""Up to so many columns and rows there is a grid, and arrows lead from dot to dot."""

BEADS = 70
"""Up to so many the path is a string of beads."""


class Shading(NamedTuple):
    """How much more the least path through each dot costs than the path that was found.

    Attributes
    ----------
    more : (columns, rows) float
        Never negative; infinite where there is no path.
    levels : tuple of float
        From where on each next lighter shade begins.
    """

    more: FloatArray
    levels: tuple[float, ...]


def draw(subject: Subject) -> str:
    """The figure as a document."""
    columns, rows = shape_of(subject)
    width, height = _sides(columns, rows)
    figure = Figure(LEFT + width + 196.0, TOP + height + 64.0, STYLE + _STYLE)
    heading(figure, subject.title, [subject.contours, f"{subject.price}; {_deviation(subject)}"])
    axes = Axes(figure, LEFT, TOP, width, height, (-0.5, columns - 0.5), (rows - 0.5, -0.5))
    shading = shade_of(subject) if columns * rows <= SHADED_DOTS else None
    if shading is not None:
        _shade(axes, shading.more, shading.levels)
    else:
        figure.words("too many dots to be shaded", (LEFT + width / 2.0, TOP - 6.0), "middle-note")
    small = max(columns, rows) <= ARROWS
    if small:
        axes.grid(range(columns), range(rows))
    _diagonal(axes, columns, rows, subject.found.diagonal_deviation if subject.band is None else subject.band)
    _path(axes, unrolled(subject), small, max(columns, rows) <= BEADS)
    axes.frame()
    first0, first1 = subject.found.dots[0].tolist()
    axes.ticks_below(*_vertex_ticks(first0, columns, subject.wires.m, width), "vertex of A")
    axes.ticks_beside(*_vertex_ticks(first1, rows, subject.wires.n, height), "vertex of B")
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
    """Columns and rows; closed graphs end in the vertices they begin with."""
    again = 1 if subject.found.closed else 0
    return subject.wires.m + again, subject.wires.n + again


def unrolled(subject: Subject) -> IntArray:
    """The path in columns and rows from its first dot, counted on to the last column and row."""
    dots = subject.found.dots
    if subject.found.closed:
        dots = np.append(dots, dots[:1], axis=0)
    moves = np.diff(dots, axis=0) % (subject.wires.m, subject.wires.n)
    return np.append(np.zeros((1, 2), np.intp), np.cumsum(moves, axis=0), axis=0)


def shade_of(subject: Subject) -> Shading:
    """Price the least path through every dot."""
    works = landscape(subject.wires, subject.found.dots, subject.band).works
    more = np.maximum(works - subject.found.work, 0.0)
    more[more < 1e-9 * max(subject.found.work, 1.0)] = 0.0
    return Shading(more, levels_of(more, len(SHADES) - 1))


def levels_of(more: FloatArray, count: int) -> tuple[float, ...]:
    """Round numbers, each about twice the one before, the last near what the dearer half of the dots costs."""
    dear = more[np.isfinite(more) & (more > 0.0)]
    if not len(dear):
        return (1.0,)
    power = int(np.floor(np.log10(np.median(dear))))
    series = [f * 10.0**p for p in range(power - count, power + 2) for f in (1.0, 2.0, 5.0)]
    last = int(np.searchsorted(series, np.median(dear)))
    return tuple(float(f"{level:.1g}") for level in series[last - count + 1 : last + 1])


def _sides(columns: int, rows: int) -> tuple[float, float]:
    """Width and height on the page: cells are square as far as that fits."""
    share = max(min(columns, rows) / max(columns, rows), SLENDEREST)
    return (SIDE, SIDE * share) if columns >= rows else (SIDE * share, SIDE)


def _deviation(subject: Subject) -> str:
    own = f"diagonal deviation {value_text(subject.found.diagonal_deviation)}"
    return own if subject.band is None else f"{own} in a band of {value_text(subject.band)}"


def cells(more: FloatArray) -> tuple[FloatArray, tuple[IntArray, IntArray]]:
    """The least of as many dots as make a cell, and where its columns and rows of cells begin and end."""
    edges = []
    for axis, count in enumerate(more.shape):
        edge = np.linspace(0, count, min(count, MOST_CELLS) + 1).round().astype(np.intp)
        more = np.minimum.reduceat(more, edge[:-1], axis=axis)
        edges.append(edge)
    return more, (edges[0], edges[1])


def rectangles(mask: BoolArray) -> list[tuple[int, int, int, int]]:
    """Cover what is true in few rectangles ``(column, row, columns, rows)``: runs of a row, and equal ones joined."""
    found = []
    growing: dict[tuple[int, int], int] = {}
    for row in range(mask.shape[1] + 1):
        line = mask[:, row] if row < mask.shape[1] else np.zeros(mask.shape[0], np.bool_)
        turns = np.flatnonzero(np.diff(np.concatenate([[False], line, [False]]))).reshape(-1, 2)
        runs = {(int(first), int(last)) for first, last in turns}
        found += [(c, top, end - c, row - top) for (c, end), top in growing.items() if (c, end) not in runs]
        growing = {run: growing.get(run, row) for run in sorted(runs)}
    return sorted(found)


def _shade(axes: Axes, more: FloatArray, levels: tuple[float, ...]) -> None:
    """Paint cells from dear to cheap, the cheaper ones over the dearer ones."""
    least, (across, down) = cells(more)
    figure = axes.figure
    figure.path(rect_data(axes.left, axes.top, axes.width, axes.height), "cells", fill=NO_PATH)
    masks = [least < limit for limit in (np.inf, *reversed(levels))]
    for k, (shade, mask) in enumerate(zip(_shades(levels), masks, strict=True)):
        if k + 1 < len(masks) and np.array_equal(mask, masks[k + 1]):
            continue  # nothing of this shade will show
        data = []
        for column, row, columns, rows in rectangles(mask):
            x0, y0 = axes.at(across[column] - 0.5, down[row] - 0.5)
            x1, y1 = axes.at(across[column + columns] - 0.5, down[row + rows] - 0.5)
            data.append(rect_data(x0, y0, x1 - x0, y1 - y0))
        figure.path("".join(data), "cells", fill=shade)


def _shades(levels: tuple[float, ...]) -> tuple[str, ...]:
    """A shade for what is dearer than all levels, then one below each, from the highest on."""
    return (SHADES[0], *SHADES[len(SHADES) - len(levels) :])


def _diagonal(axes: Axes, columns: int, rows: int, band: float) -> None:
    """The diagonal of the graph, and beside it the lines of the largest deviation, eq (29)."""
    x, y = columns - 1.0, rows - 1.0
    axes.figure.line([axes.at(0.0, 0.0), axes.at(x, y)], "diagonal")
    if not 0.0 < band < 1.0:
        return
    axes.figure.line([axes.at(band * x, 0.0), axes.at(x, (1.0 - band) * y)], "deviation")
    axes.figure.line([axes.at(0.0, band * y), axes.at((1.0 - band) * x, y)], "deviation")


def _path(axes: Axes, dots: IntArray, arrows: bool, beads: bool) -> None:
    places = [axes.at(column, row) for column, row in dots.tolist()]
    figure = axes.figure
    figure.line(places, "halo")
    figure.line(places, "path")
    if arrows:
        heads = [_head(p, q) for p, q in pairwise(places)]
        figure.path("".join(heads), "head")
    if arrows or beads:
        for place in places:
            figure.circle(place, 4.0 if arrows else 2.4, "dot")


def _head(p: tuple[float, float], q: tuple[float, float]) -> str:
    """The head of an arrow that ends short of a dot."""
    way = complex(*q) - complex(*p)
    unit = way / abs(way)
    tip = complex(*q) - 4.5 * unit
    corners = (tip, tip - (8.0 + 3.2j) * unit, tip - (8.0 - 3.2j) * unit)
    return line_data([(z.real, z.imag) for z in corners], closed=True)


def _vertex_ticks(first: int, count: int, period: int, side: float) -> tuple[list[int], list[str]]:
    """Columns or rows of round vertex numbers, and these numbers."""
    round_ones = [round(v) for v in ticks(0.0, period - 1.0, max(int(side / 34.0), 2), WHOLE)]
    places = {(v - first) % period: str(v) for v in round_ones}
    if count > period and 0 in places:  # the last is the first again
        places[period] = places[0]
    return list(places), list(places.values())


def _legend(figure: Figure, left: float, subject: Subject, shading: Shading | None) -> None:
    """What the lines and the shades are."""
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
