"""Requirements of users: pairs of contours by number, point or id, and the pins and the start of each pair."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.errors import MatchError
from shapeblend_cli.geometry.grouping import assign
from shapeblend_cli.geometry.polygons import winding_numbers
from shapeblend_cli.pairing.pair import pair_contours
from shapeblend_cli.wires.constraints import Constraints, has_numbers

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.anatomy.decompose import ContourPair, PlacedContour, PlacedDrawing
    from shapeblend_cli.options.settings import Settings
    from shapeblend_cli.wires.constraints import Numbers, Pin

    NumbersOrNone = tuple[int | None, int | None]
    ConstrainedPairs = dict[NumbersOrNone, tuple[ContourPair, Constraints]]

SUGGESTIONS = 5
"""Maximum number of ids that an error suggests."""


MOST_LETTERS = 100_000
"""Maximum number of pairs of letters that are compared; the letters of longer texts are paired as other shapes are."""


class PointPin(NamedTuple):
    """A pin between points in A's coordinates, and the numbers of the contours it connects."""

    pair: Numbers
    pin: Pin


def point_pins(a: PlacedDrawing, b: PlacedDrawing, settings: Settings) -> list[PointPin]:
    """Return the pins between points, each with the contours nearest to them."""
    located = []
    for pin in settings.pins:
        if has_numbers(pin):
            continue
        points = pin[0], b.to_a.point(pin[1])
        i, j = (
            min(side.contours, key=lambda c: np.abs(c.polygon.vertices - point).min()).number
            for side, point in zip((a, b), points, strict=True)
        )
        located.append(PointPin((i, j), points))
    return located


def constrain(pairs: Sequence[ContourPair], settings: Settings, pins: Sequence[PointPin]) -> ConstrainedPairs:
    """Return pairs of contours by their numbers, with constraints; starts and vertex numbers are the largest pair's."""
    largest = max(pairs, key=lambda pair: pair[0].size, default=None)
    constrained: ConstrainedPairs = {}
    for pair in pairs:
        numbers = pair[0].number, pair[1].number
        at_vertices = [pin for pin in settings.pins if pair is largest and has_numbers(pin)]
        at_points = [located.pin for located in pins if located.pair == numbers]
        start = settings.start if pair is largest else None
        constrained[numbers] = pair, Constraints(start, at_vertices + at_points)
    return constrained


def required_pairs(a: PlacedDrawing, b: PlacedDrawing, settings: Settings) -> list[Numbers]:
    """Return the pairs of contours that users name by numbers or points, and all pairs of shapes that they name by ids.

    Points are in each drawing's own coordinates. An id that no shape has raises a MatchError.
    """
    required: list[Numbers] = []
    for pair in settings.match:
        if not isinstance(pair[0], str) or not isinstance(pair[1], str):
            points = a.to_a.point(complex(pair[0])), b.to_a.point(complex(pair[1]))
            found = [_at(point, side.contours) for point, side in zip(points, (a, b), strict=True)]
            required.append((found[0].number, found[1].number))
            continue
        contours = [_named(name, side) for name, side in zip(pair, (a, b), strict=True)]
        if all(name.isdecimal() for name in pair):
            required.append((int(pair[0]), int(pair[1])))
        elif contours[0] and contours[1]:
            required += _pairs_within(contours[0], contours[1], settings)
    return required + _pairs_of_letters(a, b, settings, required)


def _pairs_within(
    a: Sequence[PlacedContour], b: Sequence[PlacedContour], settings: Settings
) -> list[Numbers]:
    whole = settings.replace(unmatched="point")
    return [(p.number, q.number) for p, q in pair_contours(a, b, whole)]


def _pairs_of_letters(
    a: PlacedDrawing, b: PlacedDrawing, settings: Settings, required: Sequence[Numbers]
) -> list[Numbers]:
    """Return the pairs of contours of letters: equal ones first, and then all others, in order as far as that goes.

    The place of a letter is that among all letters of its drawing, from 0 to 1. Squares of distances keep the order.
    """
    ours = _letters(a, {i for i, _ in required})
    theirs = _letters(b, {j for _, j in required})
    if not ours or not theirs:
        return []
    from shapeblend_cli.pairing.assignment import NEVER

    pairs: list[Numbers] = []
    for are_equal in (True, False):
        if len(ours) * len(theirs) > MOST_LETTERS:
            break
        shapes = [*ours], [*theirs]
        costs = np.array(
            [
                [
                    NEVER if are_equal and p.letter != q.letter else (p.place - q.place) ** 2
                    for q in theirs.values()
                ]
                for p in ours.values()
            ]
        ).reshape(len(ours), len(theirs))
        for k, m in assign(costs):
            if costs[k, m] < NEVER:
                p, q = ours.pop(shapes[0][k]), theirs.pop(shapes[1][m])
                pairs += _pairs_within(p.contours, q.contours, settings)
    return sorted(pairs)


class _Letter(NamedTuple):
    letter: str
    place: float
    contours: list[PlacedContour]


def _letters(side: PlacedDrawing, taken: set[int]) -> dict[int, _Letter]:
    """Return the letters of a drawing by the numbers of their shapes, without those that have a taken contour."""
    shapes = {
        k: shape.name.label or "" for k, shape in enumerate(side.drawing.shapes) if shape.element == "text"
    }
    contours: dict[int, list[PlacedContour]] = {k: [] for k in shapes}
    for contour in side.contours:
        if contour.shape in contours:
            contours[contour.shape].append(contour)
    most = max(len(shapes) - 1, 1)
    return {
        shape: _Letter(shapes[shape], place / most, members)
        for place, (shape, members) in enumerate(contours.items())
        if members and not taken.intersection(contour.number for contour in members)
    }


def _at(point: complex, contours: Sequence[PlacedContour]) -> PlacedContour:
    """Return the innermost contour around a point, of several equal ones the topmost; else the nearest contour."""
    here = np.array([point])
    around = [c for c in contours if c.polygon.closed and winding_numbers(here, c.polygon.vertices)[0]]
    if around:
        return min(around, key=lambda c: (c.area, -c.number))
    return min(contours, key=lambda c: float(np.abs(c.polygon.vertices - point).min()))


def _named(name: str, side: PlacedDrawing) -> list[PlacedContour]:
    """Return the contour with a number, or the contours of the shape with an id."""
    if name.isdecimal():
        return [contour for contour in side.contours if contour.number == int(name)]
    wanted, shapes = name.removeprefix("#"), side.drawing.shapes
    indices = {k for k, shape in enumerate(shapes) if shape.id == wanted}
    if indices:
        return [contour for contour in side.contours if contour.shape in indices]
    import difflib  # only errors need it

    ids = [shape.id for shape in shapes if shape.id]
    near = difflib.get_close_matches(wanted, ids, SUGGESTIONS) or ids[:SUGGESTIONS]
    there = (
        f"; there is {', '.join(near)}"
        if near
        else f", nor any other id; a number from 0 to {len(side.contours) - 1} would work"
    )
    raise MatchError(f"{side.drawing.file} paints no shape with the id '{wanted}'{there}")
