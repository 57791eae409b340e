"""Large parts without a partner that lie on a body: they fade where they are, and bend with it.

Shrunk to its middle, such a part would be a small picture of itself on another drawing: glasses on a clown, the seams
of a ball on a ball. What stands beside a body, or is small, shrinks into it or out of it.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.blending.parts.alone import STIRS, change_of
from shapeblend_cli.geometry.polygons import mean_value_table, weighted_sums, winding_numbers
from shapeblend_cli.model import WHOLE, Box, Correspondence, Fade
from shapeblend_cli.motion.choose import FADES
from shapeblend_cli.motion.early import Early
from shapeblend_cli.motion.rigid import Rigid

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from shapeblend_cli.model import ComplexArray, ContourBlend, Motion, ShapeBlend, Style

LARGE = 0.3
"""Minimum size of a part that fades, as a share of the view's side: others shrink to a dot before they are read."""

REACH = 0.03
"""Maximum distance by which what lies on a body stands out of it, as a share of the view's side."""

MOSTLY = 0.7
"""Minimum share of the nodes of a part in an outline of which it is a part, as a tongue is one of the mouth."""

LEAVES = (0.15, 0.4)
"""Times at which parts that leave begin to fade, and are gone: half transparent ones are seen for a short time only."""

COMES = (0.4, 0.65)
"""Times at which parts that come begin to appear, when others are gone, lest a body be bare, and are there."""

AFFORDABLE = 100
"""Maximum number of shapes of a blend whose parts are looked at."""


class _Part(NamedTuple):
    """A shape without a partner, by its number in the order of paint, where it is whole: in A, 0, or B, 1."""

    number: int
    end: int
    points: ComplexArray  # its nodes there

    def lies_on(self, outline: ComplexArray, reach: float) -> bool:
        """Return whether the part lies in a closed outline, or stands out of it no farther than `reach`."""
        outside = self.points[winding_numbers(self.points, outline) == 0]
        return not len(outside) or bool((np.abs(outside[:, None] - outline).min(axis=1) <= reach).all())

    def is_of(self, outline: ComplexArray, reach: float) -> bool:
        """Return whether the part, or most of it, lies on a closed outline."""
        inside = winding_numbers(self.points, outline) != 0
        return bool(inside.mean() >= MOSTLY) or self.lies_on(outline, reach)


class _Body(NamedTuple):
    """A filled outline with a partner, by the number of its shape, and how it moves."""

    number: int
    contour: ContourBlend
    motion: Motion | None

    def outlines(self, end: int) -> tuple[ComplexArray, ComplexArray]:
        """Return the outline in a drawing, 0 or 1, and that in the other one, as many points, no two in one place."""
        points = self.contour.dot_points()
        here, there = points[end], points[1 - end]
        kept = np.append(True, np.abs(np.diff(here)) > 0.0)
        return here[kept], there[kept]


def with_details_faded(shapes: Sequence[ShapeBlend], side: float) -> tuple[ShapeBlend, ...]:
    """Let large parts without a partner that lie on a body fade there; in a view of a side.

    So do parts on these, and those on the body that are painted alike. All parts shrink as they do otherwise where the
    rest hardly changes and only comes or only goes, and those that meet other large ones which do so.
    """
    parts = _alone(shapes) if len(shapes) <= AFFORDABLE else []
    large = {part.number for part in parts if shapes[part.number].size >= LARGE * side}
    if not large or (len({part.end for part in parts}) < 2 and change_of(shapes, side) <= STIRS):
        return tuple(shapes)
    bodies = _bodies(shapes)
    lying = {part.number: _body_of(part, bodies, REACH * side) for part in parts}
    fading = {part.number: body for part in parts if part.number in large and (body := lying[part.number])}
    for part in parts:
        for host in [other for other in parts if other.number in fading and other.end == part.end]:
            body = fading[host.number]
            is_on = host.number < part.number and part.lies_on(host.points, REACH * side)
            if is_on or (lying[part.number] is body and _style(shapes, part) == _style(shapes, host)):
                fading.setdefault(part.number, body)
    staying = [part for part in parts if part.number in large - fading.keys()]
    fading = _without_torn(parts, fading, staying)
    found = list(shapes)
    for part in parts:
        if part.number in fading:
            found[part.number] = _faded(shapes, part, fading[part.number])
    return tuple(found)


def _alone(shapes: Sequence[ShapeBlend]) -> list[_Part]:
    """Return the shapes that grow from points, or shrink to them, and no more."""
    found = []
    for number, shape in enumerate(shapes):
        ends = {int(contour.grows) for contour in shape.contours}
        is_point = not any(contour.is_matched or contour.follows_edge for contour in shape.contours)
        motion = shape.motion
        is_straight = motion is None or (
            isinstance(motion, Early) and motion.motion is None and not motion.rides
        )
        is_plain = is_straight and not (shape.fade or shape.trim or shape.pace or shape.clips)
        if is_point and is_plain and len(ends) == 1:
            (end,) = ends
            nodes = [contour.path(end).segments[:, 0] for contour in shape.contours]
            found.append(_Part(number, end, np.concatenate(nodes)))
    return found


def _style(shapes: Sequence[ShapeBlend], part: _Part) -> Style:
    """Return the style of a part where it is whole."""
    return shapes[part.number].style(part.end)


def _bodies(shapes: Sequence[ShapeBlend]) -> list[_Body]:
    """Return the filled outlines with a partner, in the order of paint."""
    found = []
    for number, shape in enumerate(shapes):
        motion = shape.motion.motion if isinstance(shape.motion, Early) else shape.motion
        if None in (shape.style_a.fill, shape.style_b.fill):
            continue
        for k, contour in enumerate(shape.contours):
            if contour.is_matched and contour.start.closed:
                own = Rigid(motion.alignments[k : k + 1]) if isinstance(motion, Rigid) else motion
                found.append(_Body(number, contour, own))
    return found


def _body_of(part: _Part, bodies: Sequence[_Body], reach: float) -> _Body | None:
    """Return the body that a part lies on; None if it lies on none, or on what lies on another one, as a mouth does."""
    below = [body for body in bodies if body.number < part.number]
    around = (one for one in reversed(below) if part.is_of(one.outlines(part.end)[0], reach))
    host = next(around, None)
    if host is None or not part.lies_on(host.outlines(part.end)[0], reach):
        return None
    if host.motion is not None and not isinstance(host.motion, Rigid):
        return None
    itself = _Part(host.number, part.end, host.outlines(part.end)[0])
    others = (other for other in below if other.number < host.number)
    return None if any(itself.lies_on(one.outlines(part.end)[0], reach) for one in others) else host


def _without_torn(parts: Iterable[_Part], fading: dict[int, _Body], staying: list[_Part]) -> dict[int, _Body]:
    """Leave out the parts that meet large ones of the same drawing which do not fade."""
    while True:
        torn = [
            part
            for part in parts
            if part.number in fading
            and any(
                part.end == other.end and Box.around(part.points).overlaps(Box.around(other.points))
                for other in staying
            )
        ]
        if not torn:
            return fading
        fading = {number: fading[number] for number in fading.keys() - {part.number for part in torn}}
        staying = torn


def _faded(shapes: Sequence[ShapeBlend], part: _Part, body: _Body) -> ShapeBlend:
    """Return a part that fades, and bends with its body."""
    shape, style, outlines = shapes[part.number], _style(shapes, part), body.outlines(part.end)
    contours = tuple(_bent(contour, part.end, *outlines) for contour in shape.contours)
    return shape._replace(
        contours=contours,
        style_a=style,
        style_b=style,
        motion=Rigid(body.motion.alignments * len(contours)) if isinstance(body.motion, Rigid) else None,
        reason=FADES,
        span=WHOLE,
        fade=Fade(*COMES, comes=True) if part.end else Fade(*LEAVES, comes=False),
    )


def _bent(contour: ContourBlend, end: int, here: ComplexArray, there: ComplexArray) -> ContourBlend:
    """Return a contour that is whole in a drawing, 0 or 1, and in the other one as an outline around it bends it."""

    def image(points: ComplexArray) -> ComplexArray:
        return weighted_sums(mean_value_table(points.ravel(), here), there).reshape(points.shape)

    path, polygon = contour.path(end), contour.polygon(end)
    own = contour.contour_b if end else contour.contour_a
    far = replace(path, segments=image(path.segments))
    beyond = replace(own, segments=image(own.segments)), replace(polygon, vertices=image(polygon.vertices))
    found = Correspondence.one_to_one(len(polygon.vertices), polygon.closed)
    cuts = (contour.cuts[end],) * 2
    contour = contour._replace(correspondence=found, cuts=cuts, root=None)
    if end:
        return contour._replace(contour_a=beyond[0], polygon_a=beyond[1], start=far)
    return contour._replace(contour_b=beyond[0], polygon_b=beyond[1], end=far)
