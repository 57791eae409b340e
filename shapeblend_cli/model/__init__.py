"""The values that pass from stage to stage: frozen, their arrays read-only.

Points are complex numbers, ``x + 1j * y``, in SVG's coordinates (y down), as svgpathtools has them.
Values that hold arrays are dataclasses, which freeze them; most others are named tuples, which take a fifth of
the time to define, and the command starts that much sooner.
"""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple, Protocol

import numpy as np

from shapeblend_cli.model.arrays import frozen as frozen
from shapeblend_cli.model.arrays import unroll as unroll
from shapeblend_cli.model.box import Box as Box
from shapeblend_cli.model.correspondence import Correspondence as Correspondence
from shapeblend_cli.model.correspondence import Figures as Figures
from shapeblend_cli.model.correspondence import Work as Work
from shapeblend_cli.model.drawing import MOST_CONTOURS as MOST_CONTOURS
from shapeblend_cli.model.drawing import MOST_SEGMENTS as MOST_SEGMENTS
from shapeblend_cli.model.drawing import NORMAL as NORMAL
from shapeblend_cli.model.drawing import UNNAMED as UNNAMED
from shapeblend_cli.model.drawing import BentPicture as BentPicture
from shapeblend_cli.model.drawing import Clip as Clip
from shapeblend_cli.model.drawing import Contour as Contour
from shapeblend_cli.model.drawing import CubicPath as CubicPath
from shapeblend_cli.model.drawing import Drawing as Drawing
from shapeblend_cli.model.drawing import Effect as Effect
from shapeblend_cli.model.drawing import Group as Group
from shapeblend_cli.model.drawing import Length as Length
from shapeblend_cli.model.drawing import Mask as Mask
from shapeblend_cli.model.drawing import MaskLayer as MaskLayer
from shapeblend_cli.model.drawing import Name as Name
from shapeblend_cli.model.drawing import Page as Page
from shapeblend_cli.model.drawing import Polygon as Polygon
from shapeblend_cli.model.drawing import Shape as Shape
from shapeblend_cli.model.drawing import control_box as control_box
from shapeblend_cli.model.filters import ALPHA as ALPHA
from shapeblend_cli.model.filters import SOURCE as SOURCE
from shapeblend_cli.model.filters import Filter as Filter
from shapeblend_cli.model.filters import Step as Step
from shapeblend_cli.model.filters import View as View
from shapeblend_cli.model.picture import Picture as Picture
from shapeblend_cli.model.picture import Pose as Pose
from shapeblend_cli.model.picture import Raster as Raster
from shapeblend_cli.model.style import PAGE_COLOUR as PAGE_COLOUR
from shapeblend_cli.model.style import Content as Content
from shapeblend_cli.model.style import Filling as Filling
from shapeblend_cli.model.style import Gradient as Gradient
from shapeblend_cli.model.style import LinearGradient as LinearGradient
from shapeblend_cli.model.style import Paint as Paint
from shapeblend_cli.model.style import Pattern as Pattern
from shapeblend_cli.model.style import RadialGradient as RadialGradient
from shapeblend_cli.model.style import Stop as Stop
from shapeblend_cli.model.style import Style as Style

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model.arrays import BoolArray as BoolArray
    from shapeblend_cli.model.arrays import ComplexArray as ComplexArray
    from shapeblend_cli.model.arrays import FloatArray as FloatArray
    from shapeblend_cli.model.arrays import IntArray as IntArray
    from shapeblend_cli.model.arrays import PictureArray as PictureArray
    from shapeblend_cli.model.arrays import UIntArray as UIntArray


class LinePart(NamedTuple):
    """A part of a pen line, between two shares of its length; of a closed one also through its beginning."""

    name: str  # as `inspect` prints it
    begin: float = 0.0
    end: float = 1.0
    because: str = ""  # why it was cut, a phrase


class Root(NamedTuple):
    """The place at which a part without a partner is attached, where it is whole."""

    place: complex
    body: int  # number of the part with which it goes: its own, or that of the one on which it lies


class ContourBlend(NamedTuple):
    """A contour of A, its partner in B, and the paths between which it moves.

    Contours are numbered through each file in paint order; None stands for a missing partner. Both contours are in A's
    coordinates and in the same direction. A contour that is a point has a polygon of one vertex.

    Start and end have the same segments: at first a line for each step of the correspondence, then the drawings' own
    curves, by `interpolate.paths.with_curves`.
    """

    a: int | None
    b: int | None
    contour_a: Contour
    contour_b: Contour
    polygon_a: Polygon  # the contours flattened, as solved
    polygon_b: Polygon
    scale_a: float  # divisors of the normalisation, section 3.3
    scale_b: float
    correspondence: Correspondence
    start: CubicPath
    end: CubicPath
    cuts: tuple[FloatArray, FloatArray]  # ends of the segments, in vertices, rising; once round if closed
    rotation: float = 0.0  # of B against A while they were matched, in radians
    mirrored: bool = False  # whether B was a mirror image while they were matched
    seconds: float = 0.0  # spent on matching
    reason: str = ""  # for the pair, or for the lack of a partner, a phrase
    parents: tuple[int | None, int | None] = (
        None,
        None,
    )  # numbers of the contours around each; None outside of all
    lines: tuple[LinePart | None, LinePart | None] = (None, None)  # the pen lines of which these are parts
    root: Root | None = None

    @property
    def grows(self) -> bool:
        """Whether it is a point at the start."""
        return self.a is None

    @property
    def shrinks(self) -> bool:
        """Whether it is a point at the end."""
        return self.b is None

    @property
    def is_matched(self) -> bool:
        """Whether it is a contour at both ends."""
        return self.a is not None and self.b is not None

    @property
    def follows_edge(self) -> bool:
        """Whether it has no partner and yet is no point at either end, since it goes along with what it lies on."""
        return not self.is_matched and min(len(self.polygon_a.vertices), len(self.polygon_b.vertices)) > 1

    @property
    def numbers(self) -> tuple[int | None, int | None]:
        """The numbers of its contours in A and B."""
        return self.a, self.b

    @property
    def whole_at(self) -> int:
        """The end, 0 for A or 1 for B, at which a contour without a partner is no point."""
        return int(self.grows)

    def alone(self, number: int) -> tuple[int | None, int | None]:
        """Return the numbers of a contour that comes or goes as this one does."""
        return (None, number) if self.grows else (number, None)

    def path(self, end: int) -> CubicPath:
        """Return its path at the start, 0, or at the end, 1."""
        return self.end if end else self.start

    def polygon(self, end: int) -> Polygon:
        """Return its polygon in A, 0, or in B, 1."""
        return self.polygon_b if end else self.polygon_a

    def dot_points(self) -> tuple[ComplexArray, ComplexArray]:
        """Return the vertices that correspond, a pair for every dot."""
        i, j = self.correspondence.dots.T
        return self.polygon_a.vertices[i], self.polygon_b.vertices[j]

    def straight(self, t: float) -> ComplexArray:
        """Return the control points at time t on straight paths, eq (2)."""
        return (1.0 - t) * self.start.segments + t * self.end.segments


class Motion(Protocol):
    """The motion of contours that are painted together, from start to end."""

    @property
    def name(self) -> str:
        """The motion's name in reports and, if it can be asked for, for `--motion`."""

    def segments(self, contours: Sequence[ContourBlend], t: float) -> list[ComplexArray]:
        """Return the control points of each contour at a time within (0, 1); their limits are the start and the end."""


class Bend(Protocol):
    """The bending of a picture with an outline around it."""

    as_triangles: bool  # whether documents show it, too

    def at(self, shape: ShapeBlend, t: float) -> BentPicture | None:
        """Return the picture of a shape at time t."""


class Fade(NamedTuple):
    """The even appearance or disappearance of a shape between two times."""

    begin: float
    until: float
    comes: bool  # appears, else it disappears

    @property
    def times(self) -> tuple[float, ...]:
        """The times within (0, 1) at which the change begins or ends."""
        return tuple(t for t in (self.begin, self.until) if 0.0 < t < 1.0)

    def share(self, t: float) -> float:
        """Return the share of the shape's opacity at time t."""
        come = min(max((t - self.begin) / (self.until - self.begin), 0.0), 1.0)
        return come if self.comes else 1.0 - come


class Trim(NamedTuple):
    """A line of which a part is seen: between two shares of its length, which change evenly."""

    start: CubicPath
    end: CubicPath
    parts: tuple[
        tuple[float, tuple[float, float]], ...
    ]  # what is seen at times, the start and the end among them


class Candidate(NamedTuple):
    """A motion of a shape that was judged."""

    name: str
    wrong: float  # the judge's number, the sum of the terms
    terms: tuple[tuple[str, float], ...]  # weighted, as shares of the painted area
    painted: float  # area of the shape, in square units of the drawing


WHOLE = (0.0, 1.0)
"""The span of a shape that moves all the time."""


def _time_within(span: tuple[float, float], pace: Sequence[tuple[float, float]], t: float) -> float:
    """Return the time that is told by a pace, or else within a span: 0 before it, 1 after it."""
    if pace:
        return float(np.interp(t, [time for time, _ in pace], [own for _, own in pace]))
    return t if span == WHOLE else min(max((t - span[0]) / (span[1] - span[0]), 0.0), 1.0)


class ShapeBlend(NamedTuple):
    """Contours that are painted together, from one paint to another."""

    contours: tuple[ContourBlend, ...]
    style_a: Style
    style_b: Style  # its lengths in A's coordinates
    motion: Motion | None = None  # None for straight paths, eq (2)
    reason: str = ""  # for the motion, a phrase
    fade: Fade | None = None  # if others take its place at one end
    is_twin: bool = False  # the second copy of a shape that has two places in the order of paint
    candidates: tuple[Candidate, ...] = ()  # in the order in which they were judged
    sources: tuple[int | None, int | None] = (None, None)  # indices of its shapes in A and B
    names: tuple[Name, ...] = ()  # of these shapes
    groups: tuple[Group, ...] = ()
    clips: tuple[ClipBlend, ...] = ()
    span: tuple[float, float] = WHOLE  # the times of its start and its end
    trim: Trim | None = None  # its motion, for formats that trim paths
    pace: tuple[tuple[float, float], ...] = ()  # its own time at times, even in between, if not by the span
    bend: Bend | None = None  # of a picture, with an outline
    effects: tuple[EffectBlend, ...] = ()  # around it, the outermost first

    def own_time(self, t: float) -> float:
        """Return the time within the shape's own span: 0 before it, 1 after it; by its pace it may be beyond both."""
        return _time_within(self.span, self.pace, t)

    def time_of(self, own: float) -> float:
        """Return the time of the blend at a time within the shape's own span."""
        begin, until = self.span
        return own if self.span == WHOLE else begin + own * (until - begin)

    def times_of(self, own: Sequence[float]) -> list[float]:
        """Return the times within (0, 1) at which its own time has some value, by its pace also where that turns."""
        if not self.pace:
            return [t for t in map(self.time_of, own) if 0.0 < t < 1.0]
        times = {t for t, _ in self.pace}
        for (start, low), (end, high) in pairwise(self.pace):
            times |= {
                start + (end - start) * (value - low) / (high - low)
                for value in own
                if min(low, high) < value < max(low, high)
            }
        return sorted(t for t in times if 0.0 < t < 1.0)

    @property
    def name(self) -> Name:
        """The name of the shape in a blend."""
        return Name.common(self.names) if self.names else UNNAMED

    @property
    def motion_name(self) -> str:
        """The name of the motion in reports."""
        return self.motion.name if self.motion else "linear"

    @property
    def is_matched(self) -> bool:
        """Whether any of its contours has a partner."""
        return any(contour.is_matched for contour in self.contours)

    @property
    def taken(self) -> Candidate | None:
        """The candidate that was chosen, if there was a choice."""
        return next((one for one in self.candidates if one.name == self.motion_name), None)

    def style(self, end: int) -> Style:
        """Return its style at the start, 0, or at the end, 1."""
        return self.style_b if end else self.style_a

    def box(self, end: int) -> Box:
        """Return the box around it at the start, 0, or at the end, 1, with its stroke."""
        return control_box([contour.path(end) for contour in self.contours]).expanded(self.style(end).reach)

    @property
    def is_stroke(self) -> bool:
        """Whether it has no fill at either end."""
        return self.style_a.fill is self.style_b.fill is None

    @property
    def size(self) -> float:
        """The larger side of its largest contour's box."""
        return max(max(contour.scale_a, contour.scale_b) for contour in self.contours)


Shapes = tuple[ShapeBlend, ...]


class ClipBlend(NamedTuple):
    """A clip region that moves: the union of shapes that move."""

    shapes: tuple[ShapeBlend, ...]

    @property
    def rule(self) -> str:
        """The fill rule."""
        return self.shapes[0].style_a.fill_rule


class EffectBlend(NamedTuple):
    """An effect between two of one kind, whose filters have the same steps."""

    start: Effect
    end: Effect
    span: tuple[float, float] = (0.0, 1.0)  # the times of its start and its end
    pace: tuple[tuple[float, float], ...] = ()  # its own time at times, as of a shape
    clips: tuple[ClipBlend, ...] = ()  # as many as both have, or more

    @property
    def number(self) -> int:
        """The number of both."""
        return self.start.number

    def own_time(self, t: float) -> float:
        """Return the time within the effect's own span, from 0 to 1."""
        return min(max(_time_within(self.span, self.pace, t), 0.0), 1.0)


class Place(NamedTuple):
    """A place in the order of paint."""

    shape: int  # index
    end: int | None = None  # 0 for the shape's place in A alone, 1 for its place in B alone; None for both


class PaintedShape(NamedTuple):
    """Outlines that are painted together: one path of a frame."""

    paths: tuple[CubicPath, ...]
    style: Style
    below: Style | None = None  # painted under `style`, where one paint dissolves into another
    name: Name = UNNAMED
    groups: tuple[Group, ...] = ()  # the outermost first
    clips: tuple[Clip, ...] = ()
    bent: BentPicture | None = None  # seen instead of a picture, where pixels are drawn
    as_triangles: bool = False  # whether it is seen so in documents, too
    page_coloured: tuple[str, ...] = ()  # of a drawing's own shape
    effects: tuple[Effect, ...] = ()  # the outermost first


class Waypoint(NamedTuple):
    """The paths of a shape at a time t within (0, 1) between two drawings."""

    t: float
    paths: tuple[CubicPath, ...]


class KeyframedEffect(NamedTuple):
    """An effect from one key to the next, with the regions that clip it, each the union of shapes."""

    blend: EffectBlend
    first: int  # number of the first drawing
    clips: tuple[tuple[KeyframedShape, ...], ...] = ()


class KeyframedShape(NamedTuple):
    """A shape over several keys: drawings that are blended one after the other.

    All keys have the same path commands, and so have the waypoints between two keys, in order of time. From each to the
    next all points move in nearly straight lines. A shape that fades also has styles at times of their own, between
    which its opacities change evenly.
    """

    keys: tuple[PaintedShape, ...]
    first: int  # number of the first drawing
    waypoints: tuple[tuple[Waypoint, ...], ...]
    fading: tuple[tuple[tuple[float, Style], ...], ...] = ()
    name: Name = UNNAMED
    groups: tuple[Group, ...] = ()
    spans: tuple[tuple[float, float], ...] = ()  # of each pair, unless it moves all the time
    clips: tuple[tuple[KeyframedShape, ...], ...] = ()  # regions, each the union of shapes
    is_paced: bool = False  # whether all of its paint is as `fading` has it, not its opacities alone
    effects: tuple[KeyframedEffect, ...] = ()  # the outermost first


class Pair(NamedTuple):
    """Two drawings, matched shape by shape, with the numbers of their files."""

    a: int
    b: int
    shapes: tuple[ShapeBlend, ...]  # in paint order, with twins
    drawn: tuple[tuple[PaintedShape, ...], tuple[PaintedShape, ...]]  # the drawings themselves, laid over A
    views: tuple[Box, Box]  # the part of the plane to show of each
    pages: tuple[Page, Page] = (Page(), Page())  # with boxes in A's coordinates

    @property
    def each_shape(self) -> list[ShapeBlend]:
        """The shapes without twins."""
        return [shape for shape in self.shapes if not shape.is_twin]

    @property
    def contours(self) -> list[ContourBlend]:
        """The contours of all shapes."""
        return [contour for shape in self.each_shape for contour in shape.contours]


class Frame(NamedTuple):
    """The picture at a time t within a pair."""

    t: float
    pair: int
    shapes: tuple[PaintedShape, ...]  # in paint order
    view: Box  # the part of the plane to show
    page: Page = Page()

    @property
    def picture(self) -> Frame:
        """The frame to show at any size, with strokes as at the drawings' own."""
        shapes = [
            shape._replace(
                style=shape.style._replace(pixel=None), below=shape.below and shape.below._replace(pixel=None)
            )
            for shape in self.shapes
        ]
        return self._replace(shapes=tuple(shapes), page=Page())
