"""Examples of what each term of the judge punishes, drawn for docs/motion.md by `make pictures`."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.model import Box
from shapeblend_cli.motion.judge import STEPS, TIMES, Outlines, judge_outlines

if TYPE_CHECKING:
    from collections.abc import Callable

    from shapeblend_cli.model import ComplexArray

    Moving = Callable[[float], ComplexArray]

SHOWN = range(0, STEPS + 1, 2)
"""The moments that are drawn, of those at which the judge looks."""

CELL, MARGIN, HEAD, NUMBER = 76, 8, 26, 60
"""Pixels: the height of a row and the width of a drawing in it, what stays free around that, and room for text."""

STYLE = (
    "<style>text { font: 14px sans-serif; fill: #333 } polygon { fill: #7fa3cf; stroke: #24476f } "
    ".view { fill: none; stroke: #a33b3b; stroke-dasharray: 3 }</style>"
)


class Example(NamedTuple):
    """A blend with a fault, one without it, and what is seen of both drawings if that matters."""

    wrong: Moving
    right: Moving
    view: Box | None = None


def polygon(*corners: complex, pieces: int = 8) -> ComplexArray:
    """A polygon with further points on each edge."""
    a = np.array(corners, np.complex128)
    u = np.arange(pieces) / pieces
    return (a[:, None] + u * (np.roll(a, -1) - a)[:, None]).ravel()


def bump(t: float) -> float:
    """Nothing at both ends and 1 half way."""
    return 4.0 * t * (1.0 - t)


def straight(a: ComplexArray, b: ComplexArray) -> Moving:
    """Every point on its straight path."""
    return lambda t: (1.0 - t) * a + t * b


def turning(a: ComplexArray, degrees: float, centre: complex) -> Moving:
    """A shape that turns."""
    return lambda t: centre + (a - centre) * np.exp(1j * np.radians(degrees * t))


BRICK = polygon(0, 5, 5 + 2j, 2j)
HAND = polygon(-0.6, 0.6, 0.4 - 4j, -0.4 - 4j)
ROUND = np.exp(2j * np.pi * np.arange(96) / 96)
NOSE = np.exp(-((np.angle(ROUND * 1j) / 0.22) ** 2))  # at the top
HEAD_UP, HEAD_RIGHT = ROUND * (1.0 + 1.1 * NOSE), ROUND * (1.0 + 1.1 * np.roll(NOSE, 24))
ROOM, HOUSE = polygon(0, -4j, 2 - 4j, 4 - 4j, 4), polygon(0, -3j, 2 - 6j, 4 - 3j, 4)
PLATE = polygon(1 + 1j, -1 + 1j, -1 - 1j, 1 - 1j, pieces=24) * 0.89
DISC = ROUND * np.exp(0.25j * np.pi)
FORK = polygon(0, 5, 5 - 5j, 4 - 5j, 4 - 1j, 1 - 1j, 1 - 5j, -5j)
BAR_BELL = polygon(0, 2, 2 + 1.1j, 5 + 1.1j, 5, 7, 7 + 3j, 5 + 3j, 5 + 1.9j, 2 + 1.9j, 2 + 3j, 3j)
PLANK = polygon(0, 8, 8 + 1j, 1j)


def shrinking(t: float) -> ComplexArray:
    """A disc that becomes a square, and is smaller between."""
    return (1.0 - 0.35 * bump(t)) * straight(DISC, PLATE)(t)


def crossing(t: float) -> ComplexArray:
    """A fork whose tines go through each other and back."""
    up = np.maximum(-FORK.imag - 1.0, 0.0) / 4.0
    return FORK + 3.2 * bump(t) * up * np.sign(2.5 - FORK.real)


def closing(t: float) -> ComplexArray:
    """A fork whose tines go nearer to each other and back."""
    up = np.maximum(-FORK.imag - 1.0, 0.0) / 4.0
    return FORK + 1.0 * bump(t) * up * np.sign(2.5 - FORK.real)


def pinched(t: float) -> ComplexArray:
    """Two weights whose bar becomes a thread."""
    near = np.abs(BAR_BELL.imag - 1.5) < 0.5
    return BAR_BELL - 0.8j * bump(t) * (BAR_BELL.imag - 1.5) * near


EXAMPLES = {
    "sweep": Example(turning(BRICK, 180, 2.5 + 1j), straight(BRICK, BRICK)),
    "strain": Example(straight(HAND, turning(HAND, 120, 0)(1.0)), turning(HAND, 120, 0)),
    "stretch": Example(straight(HEAD_UP, HEAD_RIGHT), turning(HEAD_UP, 90, 0)),
    "area": Example(shrinking, straight(DISC, PLATE)),
    "symmetry": Example(straight(ROOM, np.roll(HOUSE, -8)), straight(ROOM, HOUSE)),
    "folds": Example(crossing, closing),
    "limbs": Example(pinched, straight(BAR_BELL, BAR_BELL)),
    "view": Example(
        turning(PLANK - 3j, 180, 4 - 1.5j), straight(PLANK - 3j, PLANK - 1j), Box(-0.5, -3.5, 9, 4)
    ),
}
"""An example of each term of the judge, by its name."""


def term(name: str, moving: Moving, view: Box | None) -> float:
    """Return what the judge finds of a fault in the motion of a polygon."""
    points = np.stack([moving(t) for t in TIMES.tolist()])
    count = points.shape[1]
    following, contour = np.roll(np.arange(count), -1), np.zeros(count, int)
    outlines = Outlines(points, following, contour, np.ones(count, bool), 0.0)
    return float(getattr(judge_outlines(outlines, view).judgement, name))


def drawn(name: str) -> str:
    """Return the picture of a term: the blend with its fault, the one without it below, and the numbers."""
    wrong, right, view = EXAMPLES[name]
    shown = [[moving(TIMES[k]) for k in SHOWN] for moving in (wrong, right)]
    everything = Box.around(np.concatenate([*shown[0], *shown[1]]))
    box = Box.union([everything, view]) if view else everything
    scale = (CELL - MARGIN) / box.larger_side
    width, height = CELL * len(SHOWN) + NUMBER, HEAD + 2 * CELL
    lines = [
        f"<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 {width} {height}' width='{width}' height='{height}'>",
        STYLE,
        f"<rect width='{width}' height='{height}' fill='#f6f6f4'/>",
        f"<text x='{MARGIN}' y='18' font-weight='bold'>{name}</text>",
    ]
    for row, moving in enumerate((wrong, right)):
        down = HEAD + CELL * (row + 0.5)
        for column, outline in enumerate(shown[row]):
            place = complex(CELL * (column + 0.5), down) - scale * box.centre
            if view:
                x, y, x1, y1 = view.bounds
                corners = np.array([complex(x, y), complex(x1, y), complex(x1, y1), complex(x, y1)])
                lines.append(f"<polygon class='view' points='{_points(place + scale * corners)}'/>")
            lines.append(f"<polygon points='{_points(place + scale * outline)}'/>")
        value = f"{term(name, moving, view):.2f}"
        lines.append(f"<text x='{width - MARGIN}' y='{down + 5:.0f}' text-anchor='end'>{value}</text>")
    return "\n".join([*lines, "</svg>", ""])


def _points(outline: ComplexArray) -> str:
    return " ".join(f"{z.real:.1f},{z.imag:.1f}" for z in outline)
