"""What the user wants of the pairing: contours by number or id, pins, stiff regions."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.errors import MatchError
from shapeblend_cli.pairing.pair import pair_contours

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.geometry.similarity import Similarity
    from shapeblend_cli.model import Drawing, Polygon
    from shapeblend_cli.pairing.decompose import PlacedContour
    from shapeblend_cli.settings import Settings

    Numbers = tuple[int, int]
    Pin = tuple[complex, complex]

NAMED = 5
"""Ids that an error names, at most."""


class Constraints(NamedTuple):
    """What is wanted of one pair of contours.

    Attributes
    ----------
    start : (int, int) or None
    pins : sequence of (int, int) or (complex, complex)
        Vertex numbers, or points in A's coordinates.
    """

    start: Numbers | None = None
    pins: Sequence[Pin] = ()


class Pinned(NamedTuple):
    """A pin between points, B's laid over A, and the contours it joins."""

    pair: Numbers
    pin: Pin


def pinned(
    a: Sequence[PlacedContour], b: Sequence[PlacedContour], settings: Settings, over: Similarity
) -> list[Pinned]:
    """Find the contours that pins between points join: those nearest to the points."""
    found = []
    for pin in settings.pins:
        if _is_numbers(pin):
            continue
        points = pin[0], over.point(pin[1])
        i, j = (_nearest(parts, point) for parts, point in zip((a, b), points, strict=True))
        found.append(Pinned((i, j), points))
    return found


def constraints_for(
    couple: tuple[PlacedContour, PlacedContour],
    settings: Settings,
    pins: Sequence[Pinned],
    *,
    is_largest: bool,
) -> Constraints:
    """What is wanted of a pair of contours; vertex numbers are those of the largest pair."""
    pair = couple[0].number, couple[1].number
    numbers = [pin for pin in settings.pins if is_largest and _is_numbers(pin)]
    points = [found.pin for found in pins if found.pair == pair]
    return Constraints(settings.start if is_largest else None, numbers + points)


def given_pairs(
    drawings: tuple[Drawing, Drawing],
    parts: tuple[Sequence[PlacedContour], Sequence[PlacedContour]],
    settings: Settings,
) -> list[Numbers]:
    """The pairs of contours that are given: by numbers, or by the ids of shapes whose contours are then paired.

    Raises
    ------
    MatchError
        An id that no shape has.
    """
    found: list[Numbers] = []
    for pair in settings.match:
        sides = [
            _named(name, drawing, side) for name, drawing, side in zip(pair, drawings, parts, strict=True)
        ]
        if all(isinstance(side, int) for side in sides):
            found.append((int(pair[0]), int(pair[1])))
            continue
        shapes = [
            [part for part in side if part.number == name] if isinstance(name, int) else name
            for name, side in zip(sides, parts, strict=True)
        ]
        if shapes[0] and shapes[1]:
            found += [
                (p.number, q.number)
                for p, q in pair_contours(shapes[0], shapes[1], settings.replace(unmatched="point"))
            ]
    return found


def check_stiff(polygons: Sequence[Polygon], settings: Settings) -> None:
    """See that every stiff region has a vertex of A in it."""
    for point, radius, _ in settings.stiff:
        vertices = np.concatenate([polygon.vertices for polygon in polygons])
        nearest = vertices[np.abs(vertices - point).argmin()]
        if abs(nearest - point) > radius:
            raise MatchError(
                f"no vertex of A lies within {radius:g} of the stiff point {point.real:g},{point.imag:g}; "
                f"the nearest is {nearest.real:g},{nearest.imag:g}"
            )


def _is_numbers(pin: Pin) -> bool:
    return isinstance(pin[0], int) and isinstance(pin[1], int)


def _nearest(parts: Sequence[PlacedContour], point: complex) -> int:
    """Number of the contour with the vertex nearest to a point."""
    return min(parts, key=lambda part: np.abs(part.polygon.vertices - point).min()).number


def _named(name: str, drawing: Drawing, parts: Sequence[PlacedContour]) -> int | list[PlacedContour]:
    """A contour number, or the contours of the shape with an id."""
    if name.isdecimal():
        return int(name)
    wanted = name.removeprefix("#")
    shapes = {k for k, shape in enumerate(drawing.shapes) if shape.id == wanted}
    if shapes:
        return [part for part in parts if part.shape in shapes]
    import difflib  # only errors need it

    ids = [shape.id for shape in drawing.shapes if shape.id]
    near = difflib.get_close_matches(wanted, ids, NAMED) or ids[:NAMED]
    there = f"; there is {', '.join(near)}" if near else ", nor any other; a contour number would work"
    raise MatchError(f"{drawing.file} paints no shape with the id '{wanted}'{there}")
