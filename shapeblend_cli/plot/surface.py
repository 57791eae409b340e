"""The family of in-betweens as a surface over time: figure 6."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.interpolate.paths import between
from shapeblend_cli.plot.axes import COLOUR_A, COLOUR_B, INK, SOFT, STYLE, TOP, heading
from shapeblend_cli.svg.writing.figure import Figure, line_data

if TYPE_CHECKING:
    from shapeblend_cli.model import BoolArray, ComplexArray, FloatArray, IntArray
    from shapeblend_cli.plot.subject import Subject

SIZE = 400.0
"""The larger side of the shapes on the page, before they are looked at from the side."""

TALL = 0.85
"""From t = 0 to t = 1, as a share of that."""

YAW, PITCH = math.radians(-24.0), math.radians(33.0)
"""From where it is seen: turned about the axis of time, and from above."""

SLICES = (8, 20)
FACES = 1300
"""Polygons on the way, fewest and most: as many as keep the faces of the surface about this number."""

MOST_EDGES = 128
WAYS = 28
"""Vertex paths that are drawn, about."""

LIGHT = np.array([-0.45, -0.55, 0.7])
LEVELS = 6

_STYLE = f"""
.side{{stroke:{INK};stroke-width:.7;stroke-opacity:.6}}
.face{{fill:currentColor;stroke:currentColor}}
.a{{stroke:{COLOUR_A};stroke-width:2}}
.b{{stroke:{COLOUR_B};stroke-width:2}}
.floor{{stroke:#c3cad2;stroke-width:1;fill:#f6f7f9}}
.word-a{{fill:{COLOUR_A};font-weight:600}}
.word-b{{fill:{COLOUR_B};font-weight:600}}
.axis{{stroke:{SOFT};stroke-width:1.2}}
"""


def draw(subject: Subject) -> str:
    """The figure as a document."""
    every = vertices_at(subject, np.array([0.0, 1.0]))
    kept = _kept(every, subject.found.closed)
    closed = subject.found.closed
    edges = len(kept) if closed else len(kept) - 1
    slices = min(max(FACES // edges, SLICES[0]), SLICES[1])
    times = np.arange(slices + 1) / slices
    solid = _solid(vertices_at(subject, times)[:, kept], times)
    page, depth = seen(solid)
    low = seen(_corners(solid, 0.0))[0]
    high = seen(_corners(solid, 1.0))[0]
    everything = np.concatenate([page.ravel(), low, high])
    left, top = 96.0 - float(everything.real.min()), TOP - 6.0 - float(everything.imag.min())
    page, low, high = (place + complex(left, top) for place in (page, low, high))
    width, height = float(np.ptp(everything.real)) + 132.0, float(np.ptp(everything.imag)) + TOP + 34.0
    figure = Figure(max(width, 480.0), height, STYLE + _STYLE)
    motion = f"moving {subject.shape.motion_name}"
    heading(figure, subject.title, [subject.contours, f"{subject.price}; {motion}"])
    figure.line(_points(low), "floor", closed=True)
    _axis(figure, low[0], high[0])
    figure.line(_points(page[0]), "a", closed=closed)
    _faces(figure, page, depth, shades(solid, closed), _paths(len(kept)), closed)
    figure.line(_points(page[-1]), "b", closed=closed)
    return figure.text()


def vertices_at(subject: Subject, times: FloatArray) -> ComplexArray:
    """Where the vertices of the in-betweens are: a row for every time, a column for every dot."""
    rows = []
    for t in times.tolist():
        outline = between(subject.shape, t)[subject.place]
        vertices = outline.segments[:, 0]
        rows.append(vertices if outline.closed else np.append(vertices, outline.segments[-1, 3]))
    return np.array(rows)


def _kept(ends: ComplexArray, closed: bool) -> IntArray:
    """The vertices that are drawn: all, or of many those that are corners and some between them."""
    count = ends.shape[1]
    if count <= MOST_EDGES:
        return np.arange(count)
    # What leaves the line between its neighbours most, at one of the ends, as a share of the shape.
    size = np.abs(ends - ends.mean(axis=1, keepdims=True)).max()
    off = np.abs(ends - 0.5 * (np.roll(ends, 1, axis=1) + np.roll(ends, -1, axis=1))).max(axis=0) / size
    corner = np.argsort(-off, kind="stable")[: MOST_EDGES // 2]
    even = np.arange(0, count, -(-count // (MOST_EDGES // 2)))
    chosen = np.zeros(count, np.bool_)
    chosen[corner] = chosen[even] = True
    if not closed:
        chosen[[0, -1]] = True
    return np.flatnonzero(chosen)


def _paths(count: int) -> BoolArray:
    """Which of the drawn vertices have their path drawn."""
    chosen = np.zeros(count, np.bool_)
    chosen[:: max(round(count / WAYS), 1)] = True
    return chosen


def _solid(vertices: ComplexArray, times: FloatArray) -> FloatArray:
    """Points of the surface, ``(east, north, up)``, the largest side of the shapes from -1/2 to 1/2."""
    x, y = vertices.real, vertices.imag
    size = max(float(np.ptp(x)), float(np.ptp(y)))
    east = (x - (x.max() + x.min()) / 2.0) / size
    north = -(y - (y.max() + y.min()) / 2.0) / size
    up = np.broadcast_to(TALL * times[:, None], x.shape)
    return np.stack([east, north, up], axis=-1)


def _corners(solid: FloatArray, t: float) -> FloatArray:
    """The box around the shapes at a time, its left corner first."""
    reach = [1.06 * float(np.abs(solid[..., axis]).max()) for axis in (0, 1)]
    return np.array([[e * reach[0], n * reach[1], TALL * t] for e, n in ((-1, -1), (1, -1), (1, 1), (-1, 1))])


def seen(points: FloatArray) -> tuple[ComplexArray, FloatArray]:
    """Where points ``(east, north, up)`` are on the page, and how far away."""
    east, north, up = np.moveaxis(points, -1, 0)
    across = east * math.cos(YAW) - north * math.sin(YAW)
    back = east * math.sin(YAW) + north * math.cos(YAW)
    page = SIZE * (across - 1j * (back * math.sin(PITCH) + up * math.cos(PITCH)))
    return page, back * math.cos(PITCH) - up * math.sin(PITCH)


def shades(solid: FloatArray, closed: bool) -> list[list[str]]:
    """The colour of every face, from A's to B's with time, lighter towards the light."""
    after = np.roll(solid, -1, axis=1) if closed else solid[:, 1:]
    here = solid[:, : after.shape[1]]
    normal = np.cross(after[1:] - here[:-1], here[1:] - after[:-1])
    length = np.linalg.norm(normal, axis=-1)
    unit = normal / np.where(length > 0.0, length, 1.0)[..., None]
    light = np.abs(unit @ (LIGHT / np.linalg.norm(LIGHT)))
    level = np.floor(light * LEVELS).clip(0, LEVELS - 1) / (LEVELS - 1)
    strips = len(solid) - 1
    ends = [np.array([int(colour[k : k + 2], 16) for k in (1, 3, 5)]) for colour in (COLOUR_A, COLOUR_B)]
    found = []
    for strip in range(strips):
        share = (strip + 0.5) / strips
        base = (1.0 - share) * ends[0] + share * ends[1]
        tints = [base + (255.0 - base) * (0.42 + 0.46 * value) for value in level[strip].tolist()]
        found.append([f"#{round(r):02x}{round(g):02x}{round(b):02x}" for r, g, b in tints])
    return found


def _faces(
    figure: Figure,
    page: ComplexArray,
    depth: FloatArray,
    colours: list[list[str]],
    paths: BoolArray,
    closed: bool,
) -> None:
    """Paint the faces, the furthest first, each with the lines along its sides."""
    count = page.shape[1]
    edges = count if closed else count - 1
    following = np.arange(1, edges + 1) % count
    middle = (depth[:-1, :edges] + depth[:-1, following] + depth[1:, :edges] + depth[1:, following]) / 4.0
    for place in np.argsort(-middle, axis=None, kind="stable").tolist():
        strip, k = divmod(place, edges)
        after = int(following[k])
        corners = [page[strip, k], page[strip, after], page[strip + 1, after], page[strip + 1, k]]
        data = line_data([(z.real, z.imag) for z in corners], closed=True)
        figure.path(data, "face", color=colours[strip][k])
        drawn = (True, paths[after], True, paths[k])
        sides = [side for side, wanted in zip(pairwise([*corners, corners[0]]), drawn, strict=True) if wanted]
        figure.path("".join(line_data([(z.real, z.imag) for z in side]) for side in sides), "side")


def _points(places: ComplexArray) -> list[tuple[float, float]]:
    return [(z.real, z.imag) for z in places.tolist()]


def _axis(figure: Figure, low: complex, high: complex) -> None:
    """The axis of time, upright at the left corner."""
    x = low.real - 14.0
    figure.line([(x, low.imag), (x, high.imag)], "axis")
    for t in (0.0, 0.25, 0.5, 0.75, 1.0):
        y = low.imag + t * (high.imag - low.imag)
        figure.line([(x - 5.0, y), (x, y)], "axis")
        figure.words(f"{t:g}", (x - 9.0, y + 4.0), "tick-y")
    figure.words("t", (x - 46.0, (low.imag + high.imag) / 2.0), "label")
    figure.words("A", (x + 8.0, low.imag + 4.0), "word-a")
    figure.words("B", (x + 8.0, high.imag + 4.0), "word-b")
