"""Requirements of users on lines: which becomes which, where they are pinned, and how stiff they are.

Lines that are required, and all that change while some are stiff, correspond as wires: with the least work.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.anatomy.decompose import EXTERIOR, LINE, PlacedContour
from shapeblend_cli.errors import MatchError
from shapeblend_cli.geometry.flatten import flatten
from shapeblend_cli.geometry.polygons import polyline_contour
from shapeblend_cli.pens.line import foot_points
from shapeblend_cli.wires.constraints import Constraints, has_numbers
from shapeblend_cli.wires.match import match_contours

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.anatomy.decompose import PlacedDrawing
    from shapeblend_cli.model import ComplexArray
    from shapeblend_cli.options.settings import Settings
    from shapeblend_cli.pens.line import PenLine

    Pins = list[tuple[complex, complex]]
    Lines = Sequence[PenLine]


LISTED = 8
"""Maximum number of names of lines and contours that an error lists."""


class Required(NamedTuple):
    """Pairs of lines that are required, by index, each with its pins in units; and what is not about lines."""

    pairs: dict[tuple[int, int], Pins]
    left: Settings


def names_vertices(settings: Settings) -> bool:
    """Return whether vertices are named by numbers, which only outlines have."""
    return settings.start is not None or any(has_numbers(pin) for pin in settings.pins)


def wants_lines(settings: Settings) -> bool:
    """Return whether settings leave room for lines: not if they ask for what only outlines have."""
    free = settings.motion in ("auto", "linear") and not names_vertices(settings)
    free = free and (settings.unmatched == "auto" or bool(settings.mix))
    return free and settings.curves and settings.bending != "paper" and settings.strokes != "keep"


def required_lines(
    drawings: tuple[PlacedDrawing, PlacedDrawing],
    lines: tuple[Lines, Lines],
    settings: Settings,
    scale: float,
) -> Required | None:
    """Return what settings require of lines; None if a line and an outline are to become each other.

    The drawings are without the lines: their contours are what else there is.
    """
    pairs: dict[tuple[int, int], Pins] = {}
    matches, pins = [], []
    b_to_a = drawings[1].to_a
    for match in settings.match:
        points: list[complex | None] = [None, None]
        if any(map(_is_outline, map(str, match), lines, drawings)):
            return None
        if not isinstance(match[0], str):
            points = [complex(match[0]), b_to_a.point(complex(match[1]))]
        found = [
            _named(str(name), own, drawing) if point is None else _nearest(point, own, drawing, scale)
            for name, point, own, drawing in zip(match, points, lines, drawings, strict=True)
        ]
        if (found[0] is None) != (found[1] is None):
            return None
        if found[0] is None or found[1] is None:
            matches.append(match)
        else:
            pairs.setdefault((found[0], found[1]), [])
    for pin in settings.pins:
        ends = complex(pin[0]), b_to_a.point(complex(pin[1]))
        near = [_nearest(*each, scale) for each in zip(ends, lines, drawings, strict=True)]
        if (near[0] is None) != (near[1] is None):
            return None
        if near[0] is None or near[1] is None:
            pins.append(pin)
        else:
            pairs.setdefault((near[0], near[1]), []).append((ends[0] * scale, ends[1] * scale))
    left = settings.replace(match=tuple(matches), pins=tuple(pins)) if pairs else settings
    return Required(pairs, left)


def _is_outline(name: str, lines: Lines, drawing: PlacedDrawing) -> bool:
    """Return whether a name is the number of a contour that is not a line, but one edge of a line, as of a ring."""
    count = sum(len(shape.contours) for shape in drawing.drawing.shapes)
    names = {part for line in lines for part in (*line.name.split("+"), str(line.contour))}
    return name.isdigit() and int(name) < count and name not in names


def _named(name: str, lines: Lines, drawing: PlacedDrawing) -> int | None:
    """Return the index of the longest line with a name, or of a contour or a shape that has this number or id."""
    shapes = drawing.drawing.shapes
    wanted = {k for k, shape in enumerate(shapes) if shape.id and shape.id == name.removeprefix("#")}
    found = [
        k
        for k, line in enumerate(lines)
        if name in line.name.split("+") or name == str(line.contour) or line.shape in wanted
    ]
    contours = drawing.contours
    if not found and not any(name == str(c.number) or c.shape in wanted for c in contours):
        names = list(dict.fromkeys([*(line.name for line in lines), *(str(c.number) for c in contours)]))
        more = f" and {len(names) - LISTED} more" if len(names) > LISTED else ""
        there = f"{', '.join(names[:LISTED])}{more}"
        raise MatchError(f"{drawing.drawing.file} has no line or contour '{name}'; its names are {there}")
    return max(found, key=lambda k: lines[k].length, default=None)


def _nearest(point: complex, lines: Lines, drawing: PlacedDrawing, scale: float) -> int | None:
    """Return the index of the line that is nearest to a point; None if another contour is nearer."""
    here = np.array([point * scale])
    away = [float(foot_points(here, line.drawn)[0][0]) / scale for line in lines]
    best = int(np.argmin(away))
    others = [float(np.abs(contour.polygon.vertices - point).min()) for contour in drawing.contours]
    return best if away[best] <= min(others, default=np.inf) else None


def along_wires(
    p: PenLine, q: PenLine, pins: Pins, settings: Settings, scale: float
) -> tuple[ComplexArray, ComplexArray]:
    """Return the vertices of two lines that correspond with the least work; those of closed ones once round."""
    stiff = tuple((point * scale, radius * scale, weight) for point, radius, weight in settings.stiff)
    own = settings.replace(match=(), pins=(), stiff=stiff)
    wires = _wire(p, settings), _wire(q, settings)
    # Either end of a line may become either: whichever is pinned, or takes less work.
    both = own.reverse == "auto" and not (p.closed and q.closed)
    solved, errors = [], []
    for way in ("no", "yes") if both else (own.reverse,):
        try:
            solved.append(match_contours(*wires, own.replace(reverse=way), Constraints(None, pins)))
        except MatchError as error:
            errors.append(error)
    if not solved:
        raise errors[0]
    a, b = min(solved, key=lambda blend: blend.correspondence.work).dot_points()
    return (np.append(a, a[0]), np.append(b, b[0])) if p.closed and q.closed else (a, b)


def _wire(line: PenLine, settings: Settings) -> PlacedContour:
    contour = polyline_contour(line.points, line.closed)
    role = EXTERIOR if line.closed else LINE
    polygon = flatten(contour, settings.vertices)
    return PlacedContour(0, line.shape, contour, polygon, role, None, line.style)
