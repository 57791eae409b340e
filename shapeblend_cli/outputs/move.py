"""A blend for other programs: two pictures that are alike command for command, and waypoints between them."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, Generic, Literal, NamedTuple, TypeVar

import numpy as np

from shapeblend_cli.errors import PictureError
from shapeblend_cli.frames.frames import fading_styles, shapes_at
from shapeblend_cli.frames.stagger import paced
from shapeblend_cli.interpolate.paths import paths_at, waypoints
from shapeblend_cli.model import (
    WHOLE,
    Box,
    CubicPath,
    PaintedShape,
    Pair,
    Pattern,
    Picture,
    Pose,
    ShapeBlend,
    Style,
    Waypoint,
)
from shapeblend_cli.options.easing import FOREVER
from shapeblend_cli.paint.styles import NO_PAINT, faded_coats
from shapeblend_cli.svg.writing.ids import Ids

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from shapeblend_cli.model import ClipBlend
    from shapeblend_cli.options.easing import Ease, Timing

FIXED = {
    "fill": {"fill_rule": "fill rule"},
    "stroke": {"stroke_linecap": "line cap", "stroke_linejoin": "line join", "paint_order": "paint order"},
}
"""Properties of each paint that switch at once, and their names."""


T = TypeVar("T")


class Section(NamedTuple, Generic[T]):
    """A part of a motion, with the times it begins and ends, that interpolates every number linearly but for easing."""

    start: T
    end: T
    times: tuple[float, float]
    ease: Ease


class MovedPicture(NamedTuple):
    """A picture that moves: its poses and its opacities at times between which they change evenly."""

    picture: Picture  # at the start
    poses: tuple[tuple[float, Pose], ...]
    opacities: tuple[tuple[float, float], ...]


class MovedShape(NamedTuple):
    """A shape from one picture to another, straight from waypoint to waypoint."""

    name: str
    start: PaintedShape
    end: PaintedShape
    waypoints: tuple[Waypoint, ...]
    fading: tuple[tuple[float, Style], ...] = ()  # styles at times between which its opacities change evenly
    trims: tuple[
        tuple[float, tuple[float, float]], ...
    ] = ()  # the part of the path that is seen at times, as shares
    is_paced: bool = False  # whether all of its paint is as `fading` has it, not its opacities alone
    pictures: tuple[MovedPicture, ...] = ()  # in place of paths, the lowest first
    clips: tuple[
        tuple[tuple[float, CubicPath], ...], ...
    ] = ()  # of which all is seen that is inside of each, at times

    @property
    def styles(self) -> list[tuple[float, Style]]:
        """The styles at times between which paint changes evenly, without its opacities."""
        return [(0.0, self.start.style), *(self.fading if self.is_paced else ()), (1.0, self.end.style)]

    def painted(self, name: str, paint: str) -> MovedShape:
        """Return the shape with another name, and with its ``fill`` or its ``stroke`` alone."""

        def only(style: Style) -> Style:
            fill, stroke = style.paints
            return style.painted(fill, NO_PAINT) if paint == "fill" else style.painted(NO_PAINT, stroke)

        return self._replace(
            name=name,
            start=self.start._replace(style=only(self.start.style)),
            end=self.end._replace(style=only(self.end.style)),
            fading=tuple((t, only(style)) for t, style in self.fading),
        )

    def mapped(self, change: Callable[[CubicPath], CubicPath]) -> MovedShape:
        """Return the shape with its paths changed, all in the same linear way."""
        return self._replace(
            start=self.start._replace(paths=tuple(map(change, self.start.paths))),
            end=self.end._replace(paths=tuple(map(change, self.end.paths))),
            waypoints=tuple(Waypoint(t, tuple(map(change, paths))) for t, paths in self.waypoints),
        )


class Move(NamedTuple):
    """From one picture to another: shapes in paint order, and the part of the plane to show of each picture."""

    shapes: tuple[MovedShape, ...]
    views: tuple[Box, Box]

    @property
    def view(self) -> Box:
        """The part of the plane to show all the time."""
        return Box.union(self.views)

    def with_strokes_below(self) -> Move:
        """Return the move with two shapes for one whose stroke is below its fill, which programs cannot show."""
        shapes: list[MovedShape] = []
        for shape in self.shapes:
            style = shape.start.style
            if style.paint_order != "stroke" or style.fill is None or style.stroke is None:
                shapes.append(shape)
                continue
            shapes.append(shape.painted(f"{shape.name}-stroke", "stroke"))
            shapes.append(shape.painted(shape.name, "fill"))
        return self._replace(shapes=tuple(shapes))

    def unsupported_in(
        self, program: str, shows: Callable[[MovedShape, str], object] = lambda shape, paint: None
    ) -> list[str]:
        """Return a phrase for each property that a program cannot show, or not animate.

        `shows` tells whether it can show the gradients of a shape's ``fill`` or ``stroke``.
        """
        plain = [
            f"{shape.name}: its {_server(shape)} is a plain colour in {program}"
            for shape in self.shapes
            if not shape.pictures
            and any(
                any(getattr(side.style, f"{paint}_gradient") for side in (shape.start, shape.end))
                and not shows(shape, paint)
                for paint in FIXED
            )
        ]
        return plain + [
            f"{name}: {program} cannot change the {words} on the way; that of the first drawing stays"
            for name, start, end, *_ in self.shapes
            for paint, names in FIXED.items()
            for key, words in names.items()
            if _shows(start.style, paint) and getattr(start.style, key) != getattr(end.style, key)
        ]

    def lost_curved_motion(self) -> list[str]:
        """Return a phrase for each shape whose waypoints are lost where there are two pictures and no more."""
        return [
            f"{shape.name}: moves on curved paths, which two files cannot show; it moves straight between them"
            for shape in self.shapes
            if shape.waypoints
        ]


def sections(stops: Sequence[tuple[float, T]], length: float, ease: Ease, decimals: int) -> list[Section[T]]:
    """Return the sections from stop to stop, given the length in time and the easing of all.

    Times are rounded to decimals; a stop at the time of another one, or of an end, is left out.
    """
    timed = [(0.0, 0.0, stops[0][1])]
    for t, value in stops[1:-1]:
        time = round(length * ease.time_of(t), decimals)
        if timed[-1][1] < time < length:
            timed.append((t, time, value))
    timed.append((1.0, length, stops[-1][1]))
    return [
        Section(start, end, (begin, until), ease.piece(p, q) if len(timed) > 2 else ease)
        for (p, begin, start), (q, until, end) in pairwise(timed)
    ]


def moves_of(pairs: Sequence[Pair], *, trims: bool = False) -> list[Move]:
    """Return the move from each drawing to the next; lines that are drawn on or back as `trims` or as paths."""
    moves = []
    for pair in pairs:
        if any(shape.effects for shape in pair.shapes):
            from shapeblend_cli.paint.effects import pair_without_effects  # few drawings have any

            pair = pair_without_effects(pair)
        pair = paced(pair)
        trimmed = [_trims(shape) if trims else () for shape in pair.shapes]
        if trims:
            pair = pair._replace(shapes=tuple(map(_whole, pair.shapes)))
        shapes = zip(shapes_at(pair, 0.0), shapes_at(pair, 1.0), map(waypoints, pair.shapes), strict=True)
        ids = Ids.of(pair.shapes)
        names = [
            ids.take(shape.name.id) or ids.new(f"shape-{number}")
            for number, shape in enumerate(pair.shapes, 1)
        ]
        moved = [moved_shape(name, *shape) for name, shape in zip(names, shapes, strict=True)]
        more = zip(moved, pair.shapes, trimmed, strict=True)
        shown = [
            shape._replace(
                fading=fading_styles(blend),
                trims=parts,
                is_paced=bool(blend.pace),
                pictures=_pictures(blend) if blend.style_a.picture else (),
                clips=tuple(map(_clip, [blend] * len(blend.clips), blend.clips))
                if has_simple_clips(blend)
                else (),
            )
            for shape, blend, parts in more
        ]
        moves.append(Move(tuple(shown), pair.views))
    return moves


def _pictures(shape: ShapeBlend) -> tuple[MovedPicture, ...]:
    """Return the coats of a picture, the lowest first: two where one dissolves over another."""
    times, coats = faded_coats(shape)
    found = []
    for coat in coats:
        shown = [style.picture for style in coat]
        poses: list[Pose] = []
        for picture in shown:
            assert picture is not None, "what is a picture stays one"
            poses.append(picture.pose.near(poses[-1]) if poses else picture.pose)
        when = (0.0, *times, 1.0)
        opacities = [style.fill_opacity for style in coat]
        assert shown[0] is not None
        found.append(
            MovedPicture(
                shown[0], tuple(zip(when, poses, strict=True)), tuple(zip(when, opacities, strict=True))
            )
        )
    return tuple(found)


def has_simple_clips(shape: ShapeBlend) -> bool:
    """Return whether each region that clips a shape has a single outline, as those of most programs."""
    return all(len(each.shapes) == 1 and len(each.shapes[0].contours) == 1 for each in shape.clips)


def _clip(shape: ShapeBlend, clip: ClipBlend) -> tuple[tuple[float, CubicPath], ...]:
    """Return the outline of a region that clips a shape, at the times between which it moves straight."""
    region = clip.shapes[0]._replace(span=WHOLE, pace=shape.pace)
    ends = [(t, paths_at(region, t)[0]) for t in (0.0, 1.0)]
    return (ends[0], *((point.t, point.paths[0]) for point in waypoints(region)), ends[1])


def _trims(shape: ShapeBlend) -> tuple[tuple[float, tuple[float, float]], ...]:
    """Return which part of a shape's path is seen, at all times between which it changes evenly."""
    if shape.trim is None:
        return ()
    times, parts = zip(*shape.trim.parts, strict=True)
    if shape.pace:
        sides = list(zip(*parts, strict=True))
        shown = [(t, min(max(shape.own_time(t), 0.0), 1.0)) for t in (0.0, *shape.times_of(times), 1.0)]
        return tuple(
            (t, (float(np.interp(own, times, sides[0])), float(np.interp(own, times, sides[1]))))
            for t, own in shown
        )
    inner = [(t, part) for t, part in zip(map(shape.time_of, times), parts, strict=True) if 0.0 < t < 1.0]
    return ((0.0, parts[0]), *inner, (1.0, parts[-1]))


def _whole(shape: ShapeBlend) -> ShapeBlend:
    """Return a shape with the whole of a line of which a part is seen."""
    if shape.trim is None:
        return shape
    (contour,) = shape.contours
    whole = contour._replace(start=shape.trim.start, end=shape.trim.end)
    return shape._replace(contours=(whole,), motion=None)


def without_pictures(pairs: Sequence[Pair], where: str) -> tuple[Sequence[Pair], list[str]]:
    """Return pairs for a form that has no pictures, and a phrase if they had some; PictureError if nothing is left."""
    if not any(shape.style_a.picture for pair in pairs for shape in pair.shapes):
        return pairs, []
    left = [
        pair._replace(shapes=tuple(shape for shape in pair.shapes if not shape.style_a.picture))
        for pair in pairs
    ]
    if not all(pair.shapes for pair in left):
        raise PictureError(
            f"{where} cannot have pictures, and the drawings are nothing else; .gif would work"
        )
    return left, [f"pictures are left out of {where}; frames and animated SVGs have them"]


def left_out(
    pairs: Sequence[Pair], where: str, clips: Literal["none", "simple", "all"] = "none"
) -> list[str]:
    """Return a phrase for clip paths that a form does not have, and one for effects of groups, of which it has none.

    Clip paths of a single outline are `simple`.
    """
    notes = []
    clipped = [shape for pair in pairs for shape in pair.shapes if shape.clips]
    if clips != "all" and not all(clips == "simple" and has_simple_clips(shape) for shape in clipped):
        some = "clip paths of several outlines" if clips == "simple" else "clip paths"
        notes.append(f"{some} are left out of {where}; frames and animated SVGs have them")
    if any(shape.effects for pair in pairs for shape in pair.shapes):
        from shapeblend_cli.paint.effects import kinds_in

        notes.append(f"{kinds_in(pairs)} left out of {where}; frames and animated SVGs have them")
    return notes


def moved_shape(
    name: str, start: PaintedShape, end: PaintedShape, waypoints: tuple[Waypoint, ...] = ()
) -> MovedShape:
    """Return a shape whose paint programs can interpolate; both sides have the same paths, segment for segment.

    Paint that only one side shows has its fill rule, line cap and line join from there. The point that a hole grows
    from would be painted as a dot by round or square line caps, which nothing else of closed paths shows: they are left
    out there.
    """
    # Where one paint dissolves into another, A's is below B's, and all there is to see at first.
    start_style, end_style = start.below or start.style, end.style
    for paint, names in FIXED.items():
        if not _shows(start_style, paint):
            start_style = start_style._replace(**{name: getattr(end_style, name) for name in names})
        elif not _shows(end_style, paint):
            end_style = end_style._replace(**{name: getattr(start_style, name) for name in names})
    paths = start.paths + end.paths
    if all(path.closed for path in paths) and any(path.is_point for path in paths):
        start_style = start_style._replace(stroke_linecap="butt")
        end_style = end_style._replace(stroke_linecap="butt")
    return MovedShape(name, start._replace(style=start_style), end._replace(style=end_style), waypoints)


def _server(shape: MovedShape) -> str:
    """Return what paints a shape that is no plain colour, in a word."""
    sides = (shape.start.style, shape.end.style)
    painted = [paint for style in sides for paint in (style.fill_gradient, style.stroke_gradient)]
    return "pattern" if any(isinstance(paint, Pattern) for paint in painted) else "gradient"


def _shows(style: Style, paint: str) -> bool:
    """Return whether a style's ``fill`` or ``stroke`` is visible."""
    is_wide = paint == "fill" or style.stroke_width > 0.0
    return getattr(style, paint) is not None and getattr(style, f"{paint}_opacity") > 0.0 and is_wide


def runs_left_out(timing: Timing, where: str, instead: str = "") -> list[str]:
    """Return a note on the runs that are asked for, for a format in which players decide how often to play."""
    if timing.repeat == FOREVER:
        return []
    return [f"--repeat {timing.repeat} is left out of {where}: its player decides how often it runs{instead}"]
