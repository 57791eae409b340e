"""The family of in-betweens as a surface over time: figure 6."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.interpolate.paths import paths_at
from shapeblend_cli.model import Box
from shapeblend_cli.plot.axes import COLOUR_A, COLOUR_B, INK, SOFT, TOP, page_points, titled_figure
from shapeblend_cli.svg.writing.figure import Figure, line_data

if TYPE_CHECKING:
    from shapeblend_cli.model import ComplexArray, FloatArray, IntArray
    from shapeblend_cli.plot.subject import Subject

SIZE = 400.0
"""The larger side of the shapes on the page, before projection."""

TALL = 0.85
"""Height from t = 0 to t = 1, as a share of that."""

YAW, PITCH = math.radians(-24.0), math.radians(33.0)
"""The direction it is seen from: rotated about the axis of time, and from above."""

SLICES = (8, 20)
FACES = 1300
"""In-betweens, fewest and most: as many as keep the faces of the surface about this number."""

MOST_EDGES = 128
VERTEX_PATHS = 28
"""How many are drawn, about."""

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
    """Return the figure as a document."""
    closed = subject.correspondence.closed
    drawn = _vertices_to_draw(vertices_at(subject, np.array([0.0, 1.0])), closed)
    edges = len(drawn) if closed else len(drawn) - 1
    slices = min(max(FACES // edges, SLICES[0]), SLICES[1])
    times = np.arange(slices + 1) / slices
    solid = _solid(vertices_at(subject, times)[:, drawn], times)
    page, depth = project(solid)
    low, high = (project(_corners(solid, t))[0] for t in (0.0, 1.0))
    box = Box.around(np.concatenate([page.ravel(), low, high]))
    shift = complex(96.0 - box.x, TOP - 6.0 - box.y)
    page, low, high = page + shift, low + shift, high + shift
    width, height = box.width + 132.0, box.height + TOP + 34.0
    work = f"{subject.work}; moving {subject.shape.motion_name}"
    figure = titled_figure(max(width, 480.0), height, _STYLE, subject.title, subject.contours, work)
    figure.line(page_points(low), "floor", closed=True)
    _axis(figure, low[0], high[0])
    figure.line(page_points(page[0]), "a", closed=closed)
    _faces(figure, page, depth, shades(solid, closed), closed)
    figure.line(page_points(page[-1]), "b", closed=closed)
    return figure.text()


def vertices_at(subject: Subject, times: FloatArray) -> ComplexArray:
    """Return the vertices of the in-betweens: a row for every time, a column for every dot."""
    rows = []
    for t in times.tolist():
        path = paths_at(subject.shape, t)[subject.number]
        vertices = path.segments[:, 0]
        rows.append(vertices if path.closed else np.append(vertices, path.segments[-1, 3]))
    return np.array(rows)


def _vertices_to_draw(ends: ComplexArray, closed: bool) -> IntArray:
    """Choose the vertices that are drawn: all, or of many those that are corners and some between them."""
    count = ends.shape[1]
    if count <= MOST_EDGES:
        return np.arange(count)
    # What leaves the line between its neighbours most, at one of the ends, as a share of the shape.
    size = np.abs(ends - ends.mean(axis=1, keepdims=True)).max()
    off = np.abs(ends - 0.5 * (np.roll(ends, 1, axis=1) + np.roll(ends, -1, axis=1))).max(axis=0) / size
    chosen = np.zeros(count, np.bool_)
    chosen[np.argsort(-off, kind="stable")[: MOST_EDGES // 2]] = True
    chosen[:: -(-count // (MOST_EDGES // 2))] = True
    if not closed:
        chosen[[0, -1]] = True
    return np.flatnonzero(chosen)


def _solid(vertices: ComplexArray, times: FloatArray) -> FloatArray:
    """Return the points of the surface, ``(east, north, up)``, the larger side of the shapes from -1/2 to 1/2."""
    x, y = vertices.real, vertices.imag
    size = max(float(np.ptp(x)), float(np.ptp(y)))
    east = (x - (x.max() + x.min()) / 2.0) / size
    north = -(y - (y.max() + y.min()) / 2.0) / size
    up = np.broadcast_to(TALL * times[:, None], x.shape)
    return np.stack([east, north, up], axis=-1)


def _corners(solid: FloatArray, t: float) -> FloatArray:
    """Return the corners of the box around the shapes at a time, the left one first."""
    reach = [1.06 * float(np.abs(solid[..., axis]).max()) for axis in (0, 1)]
    return np.array([[e * reach[0], n * reach[1], TALL * t] for e, n in ((-1, -1), (1, -1), (1, 1), (-1, 1))])


def project(points: FloatArray) -> tuple[ComplexArray, FloatArray]:
    """Return where points ``(east, north, up)`` are on the page, and how far away."""
    east, north, up = np.moveaxis(points, -1, 0)
    across = east * math.cos(YAW) - north * math.sin(YAW)
    back = east * math.sin(YAW) + north * math.cos(YAW)
    page = SIZE * (across - 1j * (back * math.sin(PITCH) + up * math.cos(PITCH)))
    return page, back * math.cos(PITCH) - up * math.sin(PITCH)


def shades(solid: FloatArray, closed: bool) -> list[list[str]]:
    """Return the colour of every face, from A's to B's with time, lighter towards the light."""
    after = np.roll(solid, -1, axis=1) if closed else solid[:, 1:]
    here = solid[:, : after.shape[1]]
    normal = np.cross(after[1:] - here[:-1], here[1:] - after[:-1])
    length = np.linalg.norm(normal, axis=-1)
    unit = normal / np.where(length > 0.0, length, 1.0)[..., None]
    light = np.abs(unit @ (LIGHT / np.linalg.norm(LIGHT)))
    level = np.floor(light * LEVELS).clip(0, LEVELS - 1) / (LEVELS - 1)
    start, end = (
        np.array([int(colour[k : k + 2], 16) for k in (1, 3, 5)]) for colour in (COLOUR_A, COLOUR_B)
    )
    colours = []
    for strip, row in enumerate(level.tolist()):
        share = (strip + 0.5) / len(level)
        base = (1.0 - share) * start + share * end
        tints = [base + (255.0 - base) * (0.42 + 0.46 * value) for value in row]
        colours.append([f"#{round(r):02x}{round(g):02x}{round(b):02x}" for r, g, b in tints])
    return colours


def _faces(
    figure: Figure, page: ComplexArray, depth: FloatArray, colours: list[list[str]], closed: bool
) -> None:
    """Paint the faces, the furthest first, each with the lines along its sides."""
    count = page.shape[1]
    edges = count if closed else count - 1
    every = max(round(count / VERTEX_PATHS), 1)
    following = np.arange(1, edges + 1) % count
    middle = (depth[:-1, :edges] + depth[:-1, following] + depth[1:, :edges] + depth[1:, following]) / 4.0
    for number in np.argsort(-middle, axis=None, kind="stable").tolist():
        strip, k = divmod(number, edges)
        after = int(following[k])
        corners = page_points(page[[strip, strip, strip + 1, strip + 1], [k, after, after, k]])
        figure.path(line_data(corners, closed=True), "face", color=colours[strip][k])
        is_drawn = True, after % every == 0, True, k % every == 0
        sides = zip(corners, [*corners[1:], corners[0]], is_drawn, strict=True)
        figure.path("".join(line_data([p, q]) for p, q, drawn in sides if drawn), "side")


def _axis(figure: Figure, low: complex, high: complex) -> None:
    """Draw the axis of time, vertical at the left corner."""
    x = low.real - 14.0
    figure.line([(x, low.imag), (x, high.imag)], "axis")
    for t in (0.0, 0.25, 0.5, 0.75, 1.0):
        y = low.imag + t * (high.imag - low.imag)
        figure.line([(x - 5.0, y), (x, y)], "axis")
        figure.words(f"{t:g}", (x - 9.0, y + 4.0), "tick-y")
    figure.words("t", (x - 46.0, (low.imag + high.imag) / 2.0), "label")
    figure.words("A", (x + 8.0, low.imag + 4.0), "word-a")
    figure.words("B", (x + 8.0, high.imag + 4.0), "word-b")
