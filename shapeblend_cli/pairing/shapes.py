"""Matched contours put together into shapes that are painted in one go, those without a partner among them."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from shapeblend_cli.geometry.polygons import winding_numbers
from shapeblend_cli.model import ContourBlend, ShapeBlend
from shapeblend_cli.pairing.decompose import HOLE, PlacedContour
from shapeblend_cli.pairing.growth import MatchedPoints, point_inside, point_on
from shapeblend_cli.pairing.matching import grow_from_point
from shapeblend_cli.pairing.paint_order import paint_order, visible_overlaps

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import Style


class Match(NamedTuple):
    """Two contours that are paired, and the blend between them."""

    a: PlacedContour
    b: PlacedContour
    blend: ContourBlend

    def side(self, *, of_b: bool) -> PlacedContour:
        """Return the contour of one drawing."""
        return self.b if of_b else self.a

    def points(self, *, from_b: bool) -> MatchedPoints:
        """Return the vertices that correspond, as seen from one drawing."""
        a, b = self.blend.dot_points()
        return MatchedPoints(b, a) if from_b else MatchedPoints(a, b)


class _Group(NamedTuple):
    """What is painted together: the shapes it comes from, and whether a stroke grows with it."""

    a: int | None
    b: int | None
    stroke_grows: bool = False


def shape_blends(
    a: Sequence[PlacedContour], b: Sequence[PlacedContour], matches: Sequence[Match]
) -> tuple[ShapeBlend, ...]:
    """Put together the contours of two drawings, and give each without a partner a point to grow from.

    Contours are painted together if they come from the same shape of A and the same shape of B. What grows out of one
    of them is painted with it, unless it has a stroke, whose width must grow from nothing too.

    Parameters
    ----------
    a, b : sequence of PlacedContour
        All contours of the drawings.
    matches : sequence of Match
        Those that are paired, at least one.

    Returns
    -------
    tuple of ShapeBlend
        In paint order.
    """
    groups: dict[_Group, list[ContourBlend]] = {}
    styles: dict[_Group, tuple[Style, Style]] = {}
    for match in matches:
        group = _Group(match.a.shape, match.b.shape)
        groups.setdefault(group, []).append(match.blend)
        styles.setdefault(group, _styles(match.a, match.b))
    for parts, of_b in ((a, False), (b, True)):
        for part, group, point in _unmatched(parts, matches, of_b=of_b):
            groups.setdefault(group, []).append(grow_from_point(part, point, of_b=of_b))
            nothing = part.style._replace(stroke_width=0.0)
            styles.setdefault(group, (nothing, part.style) if of_b else (part.style, nothing))
    keys = list(groups)
    shapes = [(group.a, group.b) for group in keys]
    below_a, below_b = visible_overlaps(a), visible_overlaps(b)
    # Pairs that the user gave may contradict the order of paint; then A's counts.
    ranks = paint_order(shapes, below_a, below_b) or paint_order(shapes, below_a, ()) or range(len(keys))
    return tuple(ShapeBlend(tuple(groups[keys[k]]), *styles[keys[k]]) for k in ranks)


def _styles(a: PlacedContour, b: PlacedContour) -> tuple[Style, Style]:
    """The styles of a pair, under one fill rule where one paints both."""
    rules = {part.style.fill_rule for part in (a, b) if not part.any_rule}
    rule = rules.pop() if len(rules) == 1 else None if rules else "nonzero"
    if rule is None:
        return a.style, b.style
    return a.style._replace(fill_rule=rule), b.style._replace(fill_rule=rule)


def _unmatched(
    parts: Sequence[PlacedContour], matches: Sequence[Match], *, of_b: bool
) -> list[tuple[PlacedContour, _Group, complex]]:
    """The contours of one drawing without a partner, what each is painted with, and the point it grows from."""
    paired = {match.side(of_b=of_b).number: match for match in matches}
    tops = [match for match in matches if match.side(of_b=of_b).role != HOLE]
    points = [match.points(from_b=of_b) for match in tops]
    found: list[tuple[PlacedContour, _Group, complex]] = []
    alone: dict[int, tuple[_Group, complex]] = {}
    for part in parts:
        if part.number in paired or part.role == HOLE:
            continue
        near = [k for k, match in enumerate(tops) if match.side(of_b=of_b).shape == part.shape]
        near = near or list(range(len(tops)))
        home = _hole_around(part, matches, of_b=of_b)
        if home is not None:
            match, point = home, point_inside(part.polygon.vertices, home.points(from_b=of_b))
        else:
            number, point = point_on(part.polygon.vertices, [points[k] for k in near])
            match = tops[near[number]]
        own = (
            _Group(None, part.shape, bool(part.style.stroke))
            if of_b
            else _Group(part.shape, None, bool(part.style.stroke))
        )
        is_same = match.side(of_b=of_b).shape == part.shape and part.style.stroke is None
        group = _Group(match.a.shape, match.b.shape) if is_same else own
        alone[part.number] = group, point
        found.append((part, group, point))
    for part in parts:
        if part.number in paired or part.role != HOLE or part.exterior is None:
            continue
        if part.exterior in alone:
            found.append((part, *alone[part.exterior]))
            continue
        match = next((k for k in tops if k.side(of_b=of_b).has(part)), paired[part.exterior])
        siblings = [
            other.points(from_b=of_b) for other in matches if other.side(of_b=of_b).exterior == part.exterior
        ]
        point = point_inside(part.polygon.vertices, match.points(from_b=of_b), siblings)
        found.append((part, _Group(match.a.shape, match.b.shape), point))
    return found


def _hole_around(part: PlacedContour, matches: Sequence[Match], *, of_b: bool) -> Match | None:
    """The smallest paired hole of the same shape in which an outline is an island, if there is one."""
    vertex = part.polygon.vertices[:1]
    around = [
        match
        for match in matches
        if (side := match.side(of_b=of_b)).role == HOLE
        and side.shape == part.shape
        and winding_numbers(vertex, side.polygon.vertices)[0]
    ]
    return min(around, key=lambda match: match.side(of_b=of_b).size, default=None)
