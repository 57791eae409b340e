"""Text that stayed text as the outlines of its letters, for what draws none."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from shapeblend_cli.model import CubicPath, PaintedShape, Pair, Picture, Pose, ShapeBlend, Style
from shapeblend_cli.model.words import words_in

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import ComplexArray, ContourBlend
    from shapeblend_cli.model.words import Words


class Carried(NamedTuple):
    """Motion of the letters of a text from its place to another pose of it."""

    words: Words
    picture: Picture  # in whose place the text is at first
    end: Pose

    @property
    def name(self) -> str:
        """The name of the motion in reports."""
        return "picture"

    def segments(self, contours: Sequence[ContourBlend], t: float) -> list[ComplexArray]:
        """Return the control points of each contour at time t."""
        there = self.picture.posed(self.picture.pose.towards(self.end, t))
        return [path.segments for path in letters_at(self.words, there)]


def with_outlined_text(pair: Pair) -> Pair:
    """Return a pair whose text is outlines, with one shape for each text."""
    if not any(words_in(shape.style_a.picture) for shape in pair.shapes):
        return pair
    shapes = tuple(_outlined(shape) for shape in pair.shapes)
    one, other = (tuple(map(outlined_shape, drawn)) for drawn in pair.drawn)
    return pair._replace(shapes=shapes, drawn=(one, other))


def outlined_shape(shape: PaintedShape) -> PaintedShape:
    """Return a painted text as the outlines of its letters, and anything else as it is."""
    words, picture = words_in(shape.style.picture), shape.style.picture
    if words is None or picture is None:
        return shape
    return shape._replace(paths=letters_at(words, picture), style=_plain(shape.style))


def letters_at(words: Words, picture: Picture) -> tuple[CubicPath, ...]:
    """Return the outlines of the letters of a text in the place of a picture."""
    origin, across, down = words.axes_in(picture)
    return tuple(
        CubicPath(
            origin + path.segments.real * across + path.segments.imag * down, path.straight, path.closed
        )
        for letter in words.letters
        for path in letter
    )


def _outlined(shape: ShapeBlend) -> ShapeBlend:
    a, b = shape.style_a.picture, shape.style_b.picture
    words = words_in(a)
    if words is None or a is None or b is None:
        return shape
    start, end = letters_at(words, a), letters_at(words, b)
    (box,) = shape.contours
    contours = tuple(
        # Numbers of their own, which no drawing has.
        box._replace(a=-1 - k, b=-1 - k, start=p, end=q)
        for k, (p, q) in enumerate(zip(start, end, strict=True))
    )
    poses = a.pose, b.pose.near(a.pose)
    is_straight = (poses[0].angle, poses[0].skew) == (poses[1].angle, poses[1].skew)
    motion = None if is_straight else Carried(words, a, poses[1])
    styles = _plain(shape.style_a), _plain(shape.style_b)
    return shape._replace(contours=contours, style_a=styles[0], style_b=styles[1], motion=motion)


def _plain(style: Style) -> Style:
    return style._replace(fill_gradient=None)
