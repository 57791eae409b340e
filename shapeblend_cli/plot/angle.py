"""The angle of one dot and its Q curve: figures 14 to 18, and 20 to 22 beside coincident vertices."""

from __future__ import annotations

import cmath
import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.errors import MatchError
from shapeblend_cli.model import Box, Polygon
from shapeblend_cli.plot.axes import (
    COLOUR_A,
    COLOUR_B,
    INK,
    PATH,
    SOFT,
    TOP,
    Axes,
    page_points,
    ticks,
    titled_figure,
    value_text,
)
from shapeblend_cli.plot.subject import Subject, index_on_path
from shapeblend_cli.plot.theta import NOISE, TWO_PI, Theta, bezier, theta_of
from shapeblend_cli.svg.writing.figure import Figure, line_data

if TYPE_CHECKING:
    Dot = tuple[int, int]

SIDE = 320.0
"""Side of each panel, a square, in pixels."""

Q_LEFT, THETA_LEFT, THUMBS_LEFT = 40.0, 448.0, 838.0
THUMB = 132.0

NAMES = "Q₀", "Q₁", "Q₂"

RAY = 0.45, 0.3, 0.45
"""Length of the line towards an infinitesimal control point, as a share of the longest control vector."""

STEPS_OF_DEGREES = (1, 2, 5, 10, 15, 30, 45, 60, 90)

_STYLE = f"""
.q{{stroke:{PATH};stroke-width:2.4}}
.against{{stroke:{COLOUR_B};stroke-width:3.4}}
.control{{stroke:{SOFT};stroke-width:1.2;stroke-dasharray:2 3}}
.point{{fill:{PATH};stroke:#fff;stroke-width:1}}
.zero{{stroke:{INK};stroke-width:2.6}}
.axis{{stroke:{SOFT};stroke-width:1}}
.first{{stroke:{COLOUR_A};stroke-width:1.6}}
.last{{stroke:{COLOUR_B};stroke-width:1.6}}
.word-a{{fill:{COLOUR_A};font-weight:600}}
.word-b{{fill:{COLOUR_B};font-weight:600;}}
.outline{{stroke:{SOFT};stroke-width:1.2;fill:#f3f5f7}}
.open{{stroke:{SOFT};stroke-width:1.2}}
.corner{{stroke:{PATH};stroke-width:2.4}}
.span{{stroke:{INK};stroke-width:1.2}}
.head{{fill:{INK};stroke:none}}
.origin{{fill:{INK}}}
"""


class DotAngle(NamedTuple):
    """The dot a figure is about, the motion of its angle, and its bending work as the solver has it."""

    dot: Dot
    theta: Theta
    bending: float


def angle_of(subject: Subject) -> DotAngle:
    """Return the angle of the dot that is asked for, else of the one with most bending work.

    Raises
    ------
    MatchError
        A dot that is not on the path, or an end of an open contour, where there is no angle.
    """
    at, bends, bending = subject.wires.bends_on(subject.correspondence.dots)
    dots: list[Dot] = [(i, j) for i, j in at.tolist()]
    if not dots:
        raise MatchError("a line of two vertices has no angle; contours with more would work")
    if subject.dot is None:
        index = int(bending.argmax())
    else:
        ends = [(i, j) for i, j in subject.correspondence.dots[[0, -1]].tolist()]
        if not subject.correspondence.closed and subject.dot in ends:
            raise MatchError(
                f"dot {subject.dot[0]},{subject.dot[1]} is an end of an open contour and has no angle; "
                f"{dots[0][0]},{dots[0][1]} has one"
            )
        index = index_on_path(subject, dots)
    dot = dots[index]
    return DotAngle(dot, theta_of(subject.wires, dot, int(bends[index])), float(bending[index]))


def draw(subject: Subject) -> str:
    """Return the figure as a document."""
    (i, j), theta, bending = angle_of(subject)
    delta, star, is_zero = theta.change
    figure = titled_figure(
        THUMBS_LEFT + THUMB + 24.0,
        TOP + SIDE + 60.0,
        _STYLE,
        f"{subject.title}, vertex {i} of A and {j} of B",
        subject.contours,
        f"Δθ = {_degrees(delta)}, Δθ* = {_degrees(star)}, "
        f"bending work {value_text(bending)}{'; θ reaches zero' if is_zero else ''}",
    )
    _q_panel(figure, theta)
    _theta_panel(figure, theta)
    _thumb(figure, TOP + 18.0, f"vertex {i} of A", subject.contour.polygon_a, i)
    _thumb(figure, TOP + SIDE - THUMB + 14.0, f"vertex {j} of B", subject.contour.polygon_b, j)
    return figure.text()


def _degrees(angle: float) -> str:
    return f"{round(math.degrees(angle), 1):g}°".replace("-", "−")


def _q_panel(figure: Figure, theta: Theta) -> None:
    """Draw Q(t) and its control polygon about the origin; only directions matter, so there is no scale."""
    size = max(abs(q) for q in theta.control)
    control = [q / size for q in theta.control]
    rays = {
        k: cmath.rect(RAY[k], direction)
        for k, direction in enumerate(theta.directions)
        if direction is not None
    }
    box = Box.around(np.array([*control, 0j, *rays.values()]))
    side = 1.3 * box.larger_side
    x0, y0 = box.x - (side - box.width) / 2.0, box.y - (side - box.height) / 2.0
    axes = Axes(figure, Q_LEFT, TOP, SIDE, SIDE, (x0, x0 + side), (y0, y0 + side))
    axes.frame()
    origin = axes.at(0.0, 0.0)
    figure.line([axes.at(x0, 0.0), origin], "axis")
    figure.line([axes.at(0.0, y0), axes.at(0.0, y0 + side)], "axis")
    figure.line([origin, axes.at(x0 + side, 0.0)], "zero")
    figure.words("θ = 0", (Q_LEFT + SIDE - 6.0, origin[1] + 16.0), "right-note")
    for angle, radius, kind in ((theta.first, 0.075, "first"), (theta.last, 0.105, "last")):
        turns = np.linspace(0.0, angle, max(int(abs(angle) / 0.05), 2))
        figure.line(axes.points(radius * side * np.exp(1j * turns)), kind)
    figure.line(axes.points(np.array(control)), "control")
    figure.line(axes.points(bezier(control, np.linspace(0.0, 1.0, 65))), "q")
    for k, kind in ((0, "first"), (2, "last")):
        figure.line(axes.points(np.array([0j, control[k]])), kind)
    middle = sum(control) / 3.0
    for k, (q, kind) in enumerate(zip(control, ("word-a", "label", "word-b"), strict=True)):
        if k in rays:
            figure.line(axes.points(np.array([0j, rays[k]])), "rule")
            _name(axes, rays[k], rays[k], NAMES[k], kind)
        elif q:
            figure.circle(axes.at(q.real, q.imag), 4.0, "point")
            _name(axes, q, q - middle or q, NAMES[k], kind)
    figure.circle(origin, 3.0, "origin")
    tiny = ", ".join(f"{NAMES[k]} → 0 at {_degrees(cmath.phase(ray) % TWO_PI)}" for k, ray in rays.items())
    if tiny:
        figure.words(tiny, (Q_LEFT + SIDE / 2.0, TOP + SIDE + 18.0), "middle-note")
    figure.words("Q(t)", (Q_LEFT + SIDE / 2.0, TOP + SIDE + 40.0), "label")


def _name(axes: Axes, point: complex, away: complex, words: str, kind: str) -> None:
    """Write a name beside a point, in the direction `away`, within the panel."""
    x, y = axes.at(point.real, point.imag)
    unit = away / abs(away) if away else 1j
    half = 3.6 * len(words)
    x = min(max(x + (half + 8.0) * unit.real, axes.left + half + 4.0), axes.left + axes.width - half - 4.0)
    y = min(max(y - 15.0 * unit.imag + 4.5, axes.top + 16.0), axes.top + axes.height - 6.0)
    axes.figure.words(words, (x, y), f"{kind} name")


def _theta_panel(figure: Figure, theta: Theta) -> None:
    """Draw theta(t), and how far it moves in all and against the net direction."""
    low, high = (math.degrees(angle) for angle in (theta.angles.min(), theta.angles.max()))
    room = max(0.14 * (high - low), 4.0)
    low, high = low - room, high + room
    axes = Axes(figure, THETA_LEFT, TOP, SIDE, SIDE, (-0.06, 1.2), (low, high))
    levels = ticks(low, high, 8, STEPS_OF_DEGREES)
    axes.grid([0.0, 0.25, 0.5, 0.75, 1.0], levels)
    for level in (0.0, 360.0):
        if low < level < high:
            axes.across(level, "zero")
            figure.words("θ = 0", (THETA_LEFT + SIDE - 6.0, axes.at(0.0, level)[1] - 7.0), "right-note")
    for angle in (theta.first, theta.last):
        axes.across(math.degrees(angle), "rule")
    whole = axes.points(theta.times + 1j * np.degrees(theta.angles))
    figure.line(whole, "q")
    for piece in theta.against:
        figure.line(axes.points(piece.times + 1j * np.degrees(piece.angles)), "against")
    figure.circle(whole[0], 4.0, "point")
    figure.circle(whole[-1], 4.0, "point")
    _span(axes, 1.07, math.degrees(theta.first), math.degrees(theta.last))
    if abs(theta.last - theta.first) > NOISE:
        x, y = axes.at(1.135, math.degrees(theta.first + theta.last) / 2.0)
        figure.words("Δθ", (x, y + 4.5), "name")
    _stars(axes, theta)
    axes.frame()
    axes.ticks_below([0.0, 0.25, 0.5, 0.75, 1.0], ["0", "0.25", "0.5", "0.75", "1"], "t")
    axes.ticks_beside(levels, [f"{v:g}°".replace("-", "−") for v in levels], "θ(t)")


def _stars(axes: Axes, theta: Theta) -> None:
    """Draw how far the angle moves against the net direction, where it can be seen."""
    for piece in theta.against:
        begin, end = math.degrees(float(piece.angles[0])), math.degrees(float(piece.angles[-1]))
        if abs(axes.at(0.0, begin)[1] - axes.at(0.0, end)[1]) < 14.0:
            continue
        late = float(piece.times.mean()) > 0.5
        t = float(piece.times[0]) - 0.05 if late else float(piece.times[-1]) + 0.05
        for level in (begin, end):
            near = float(piece.times[0 if level == begin else -1])
            axes.figure.line([axes.at(near, level), axes.at(t, level)], "axis")
        _span(axes, t, begin, end)
        x, y = axes.at(t, (begin + end) / 2.0)
        axes.figure.words("Δθ*", (x - 18.0 if late else x + 18.0, y + 4.5), "word-b name")


def _span(axes: Axes, t: float, begin: float, end: float) -> None:
    top, bottom = axes.at(t, max(begin, end)), axes.at(t, min(begin, end))
    if bottom[1] - top[1] < 4.0:
        return
    axes.figure.line([top, bottom], "span")
    head = min(7.0, (bottom[1] - top[1]) / 2.5)
    data = [
        line_data([(x, y), (x - 3.2, y + down), (x + 3.2, y + down)], closed=True)
        for (x, y), down in ((top, head), (bottom, -head))
    ]
    axes.figure.path("".join(data), "head")


def _thumb(figure: Figure, top: float, name: str, polygon: Polygon, vertex: int) -> None:
    """Draw the contour, small, with the vertex and its neighbours."""
    box = Box.around(polygon.vertices)
    scale = (THUMB - 8.0) / box.larger_side
    centre = complex(THUMBS_LEFT + THUMB / 2.0, top + THUMB / 2.0)
    points = page_points((polygon.vertices - box.centre) * scale + centre)
    figure.words(name, (THUMBS_LEFT + THUMB / 2.0, top - 8.0), "middle-note")
    figure.line(points, "outline" if polygon.closed else "open", closed=polygon.closed)
    count = len(points)
    beside = [points[k % count] for k in (vertex - 1, vertex, vertex + 1) if polygon.closed or 0 <= k < count]
    figure.line(beside, "corner")
    figure.circle(points[vertex], 4.0, "point")
