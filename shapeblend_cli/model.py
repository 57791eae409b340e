"""The values that pass from stage to stage: frozen, their arrays read-only.

Points are complex numbers, ``x + 1j * y``, in SVG's coordinates (y down), as svgpathtools has them.
Values that hold arrays are dataclasses, which freeze them; most others are named tuples, which take a fifth of
the time to define, and the command starts that much sooner.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple, Protocol

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    ComplexArray = NDArray[np.complex128]
    FloatArray = NDArray[np.float64]
    IntArray = NDArray[np.intp]
    BoolArray = NDArray[np.bool_]
    UIntArray = NDArray[np.uint8]


def frozen(values: object, dtype: object) -> NDArray:  # type: ignore[type-arg]
    """Return a read-only array of `dtype` holding its own copy of `values`."""
    array = np.array(values, dtype=dtype, order="C")  # type: ignore[call-overload]
    array.setflags(write=False)
    return array


class Box(NamedTuple):
    """An axis-parallel box: a viewBox, or the bounds of a drawing."""

    x: float
    y: float
    width: float
    height: float

    @classmethod
    def around(cls, points: ComplexArray) -> Box:
        """Return the smallest box around points."""
        x, y = points.real, points.imag
        return cls(float(x.min()), float(y.min()), float(np.ptp(x)), float(np.ptp(y)))

    @classmethod
    def union(cls, boxes: Sequence[Box]) -> Box:
        """Return the smallest box around one or more boxes."""
        x, y = min(b.x for b in boxes), min(b.y for b in boxes)
        return cls(x, y, max(b.x + b.width for b in boxes) - x, max(b.y + b.height for b in boxes) - y)

    @property
    def bounds(self) -> tuple[float, float, float, float]:
        """Left, top, right and bottom."""
        return self.x, self.y, self.x + self.width, self.y + self.height

    @property
    def centre(self) -> complex:
        """The point in the middle."""
        return complex(self.x + self.width / 2, self.y + self.height / 2)

    @property
    def larger_side(self) -> float:
        """The larger one of width and height."""
        return max(self.width, self.height)

    @property
    def diagonal(self) -> float:
        """Distance between opposite corners."""
        return abs(complex(self.width, self.height))

    @property
    def area(self) -> float:
        """Width times height."""
        return self.width * self.height

    def expanded(self, margin: float) -> Box:
        """Return the box with each side moved outwards."""
        return Box(self.x - margin, self.y - margin, self.width + 2 * margin, self.height + 2 * margin)

    def contains(self, other: Box, slack: float = 0.0) -> bool:
        """Return whether another box lies inside, or sticks out by at most `slack`."""
        left, top, right, bottom = self.bounds
        x0, y0, x1, y1 = other.bounds
        return x0 >= left - slack and y0 >= top - slack and x1 <= right + slack and y1 <= bottom + slack

    def overlaps(self, other: Box) -> bool:
        """Return whether two boxes have inner points in common."""
        left, top, right, bottom = self.bounds
        x0, y0, x1, y1 = other.bounds
        return left < x1 and x0 < right and top < y1 and y0 < bottom

    def intersection(self, other: Box) -> float:
        """Return the area that two boxes have in common."""
        left, top, right, bottom = self.bounds
        x0, y0, x1, y1 = other.bounds
        return max(0.0, min(right, x1) - max(left, x0)) * max(0.0, min(bottom, y1) - max(top, y0))

    def grid(self, side: int) -> ComplexArray:
        """Return points evenly spread over the box, so many along each side."""
        across = (np.arange(side) + 0.5) / side
        return (self.x + self.width * across[:, None] + 1j * (self.y + self.height * across)).ravel()

    def interpolate(self, other: Box, t: float) -> Box:
        """Return the box at time t between this one and another."""
        return Box(*((1.0 - t) * p + t * q for p, q in zip(self, other, strict=True)))


class Stop(NamedTuple):
    """A colour ``#rrggbb`` of a gradient, and where: 0 at its beginning, 1 at its end."""

    offset: float
    colour: str
    opacity: float = 1.0


class LinearGradient(NamedTuple):
    """Colours along the line from `start` to `end`, in the coordinates of the drawing."""

    start: complex
    end: complex
    stops: tuple[Stop, ...]  # two or more, in order
    spread: str = "pad"  # what is beyond the ends: pad, reflect or repeat


class RadialGradient(NamedTuple):
    """Colours from a focus out to an ellipse, in the coordinates of the drawing.

    The ellipse is the unit circle stretched by `radii`, turned by `angle` and moved to `centre`. Apart like this,
    rather than in a matrix, because SMIL can move each of them.
    """

    centre: complex
    radii: tuple[float, float]  # the larger first
    angle: float  # in degrees; 0 for a circle
    focus: complex  # in the unit circle, before it is stretched
    focal_radius: float  # where the colours begin, in radii
    stops: tuple[Stop, ...]
    spread: str = "pad"


Gradient = LinearGradient | RadialGradient


class Style(NamedTuple):
    """How a shape is painted.

    Colours are ``#rrggbb``; None is no paint. A gradient is painted instead of the plain colour, which stands for it.
    """

    fill: str | None = "#000000"
    fill_opacity: float = 1.0
    fill_rule: str = "nonzero"
    stroke: str | None = None
    stroke_opacity: float = 1.0
    stroke_width: float = 1.0
    stroke_linecap: str = "butt"
    stroke_linejoin: str = "miter"
    stroke_miterlimit: float = 4.0
    stroke_dasharray: tuple[float, ...] = ()  # lengths of dashes and gaps in turn; empty for a solid line
    stroke_dashoffset: float = 0.0
    fill_gradient: Gradient | None = None
    stroke_gradient: Gradient | None = None
    pixel: float | None = (
        None  # of the screen, at the drawing's own size; None for a stroke that scales with it
    )

    def stretched(self, scale: float) -> Style:
        """The style with the lengths of its stroke multiplied."""
        return self._replace(
            stroke_width=scale * self.stroke_width,
            stroke_dasharray=tuple(scale * length for length in self.stroke_dasharray),
            stroke_dashoffset=scale * self.stroke_dashoffset,
        )

    def with_plain(self, name: str, stop: Stop) -> Style:
        """The style with the colour of a stop for its fill or its stroke, as if a gradient had only that one."""
        if name == "fill":
            opacity = self.fill_opacity * stop.opacity
            return self._replace(fill=stop.colour, fill_opacity=opacity, fill_gradient=None)
        opacity = self.stroke_opacity * stop.opacity
        return self._replace(stroke=stop.colour, stroke_opacity=opacity, stroke_gradient=None)


@dataclass(frozen=True, slots=True, eq=False)
class CubicPath:
    """A chain of cubic Bezier segments and lines to draw, some of them perhaps without extent.

    A segment ends where the next begins; in a closed path the last ends where the first begins. A straight segment has
    its inner points at thirds.
    """

    segments: ComplexArray  # (k, 4) control points, k >= 1
    straight: BoolArray  # (k,), which segments are drawn as lines
    closed: bool

    def __post_init__(self) -> None:
        object.__setattr__(self, "segments", frozen(self.segments, np.complex128))
        object.__setattr__(self, "straight", frozen(self.straight, np.bool_))

    @property
    def is_point(self) -> bool:
        """Whether all control points are one."""
        return bool((self.segments == self.segments[0, 0]).all())


MOST_CONTOURS, MOST_SEGMENTS = 2_000, 50_000
"""Limits of a drawing to blend, and of each contour: contours are solved one by one, and every two are compared."""


class Contour(CubicPath):
    """One subpath of a drawing, transforms applied; closed if it ends in ``Z`` or where it began."""

    __slots__ = ()


class Clip(NamedTuple):
    """The region outside of which a shape is not painted."""

    paths: tuple[CubicPath, ...]
    rule: str = "nonzero"


class Name(NamedTuple):
    """What an element of a file is called: in the file, in editors, and for people. None is what it does not have."""

    id: str | None = None
    label: str | None = None  # as Inkscape shows it
    title: str | None = None
    description: str | None = None

    @classmethod
    def common(cls, names: Sequence[Name]) -> Name:
        """Return what several names have in common: what those that have it agree on."""
        found = [{value for value in values if value is not None} for values in zip(*names, strict=True)]
        return cls(*(values.pop() if len(values) == 1 else None for values in found))


UNNAMED = Name()


class Group(NamedTuple):
    """A group or a layer around shapes; transforms and paint that it has are in the shapes."""

    number: int  # tells it from the others of a drawing
    name: Name
    is_layer: bool = False  # for Inkscape


class Length(NamedTuple):
    """A length as a file writes it: a number, and ``mm``, ``%``, nothing and so on."""

    number: float
    unit: str


class Page(NamedTuple):
    """The root of a file: its size, and the box in the plane that is so large; what it is called."""

    width: Length | None = None
    height: Length | None = None
    box: Box | None = None
    name: Name = UNNAMED
    heading: str = ""  # what it can be called for want of a title: its file, or several

    @property
    def called(self) -> str:
        """What it is called for those who do not see it."""
        return self.name.title or self.heading


@dataclass(frozen=True, slots=True, eq=False)
class Shape:
    """One painted element of a file, in the root's user units, and the groups it is in, the outermost first."""

    index: int
    id: str | None  # its own, or else that of a `use` through which it is drawn
    element: str
    contours: tuple[Contour, ...]
    style: Style
    name: Name = UNNAMED
    groups: tuple[Group, ...] = ()
    clips: tuple[Clip, ...] = ()  # it is painted in all of them; in the root's user units


class Drawing(NamedTuple):
    """What a file paints, in paint order.

    Attributes
    ----------
    file : str
        The file as the user named it.
    viewbox : Box or None
        The root's viewBox, else ``0 0 width height``, else None.
    shapes : tuple of Shape
    notes : tuple of str
        What was left out or read otherwise than a browser would, one phrase each.
    page : Page
    """

    file: str
    viewbox: Box | None
    shapes: tuple[Shape, ...]
    notes: tuple[str, ...] = ()
    page: Page = Page()


@dataclass(frozen=True, eq=False)
class Polygon:
    """A flattened contour. A closed polygon stores each vertex once; no two neighbours are equal.

    Each vertex lies on a segment of the contour, at a parameter in [0, 1), or at 1 at the end of an open polygon alone.
    0 and 1 are nodes of the drawing.
    """

    vertices: ComplexArray  # (m,), like the others
    segment: IntArray
    parameter: FloatArray
    closed: bool

    def __post_init__(self) -> None:
        object.__setattr__(self, "vertices", frozen(self.vertices, np.complex128))
        object.__setattr__(self, "segment", frozen(self.segment, np.intp))
        object.__setattr__(self, "parameter", frozen(self.parameter, np.float64))

    @cached_property
    def box(self) -> Box:
        """The box around the vertices."""
        return Box.around(self.vertices)


class Work(NamedTuple):
    """The work of a correspondence by its terms, each summed along the path."""

    stretching: float = 0.0  # eq (16)
    bending: float = 0.0  # eq (17), or by turning
    travel: float = 0.0  # of points on their way

    @property
    def total(self) -> float:
        """All work together."""
        return sum(self)


@dataclass(frozen=True, slots=True, eq=False)
class Correspondence:
    """Which vertices of two polygons correspond, and the work that takes.

    Attributes
    ----------
    dots : (k, 2) int
        The path through the graph, ``[i, j]`` by vertex numbers, from its start. The path of closed polygons
        comes back to the first dot, which is not repeated.
    closed : bool
    terms : Work
        Work, summed along the path: `stretching` by eq (16), `bending` by (17) or by turning, and `travel` for the way
        of points. Each is an attribute of the correspondence, too.
    lower_bound : float
        No correspondence of the two polygons, in these directions, takes less work: from any start, through any
        vertices, in no band, exactly solved. It is the work itself where all of that was searched, and 0 where nothing
        is known.
    zero_angles : int
        Dots whose angle reaches zero.
    diagonal_deviation : float
        Eq (30), from the start.
    sweeps : int
        Number of passes over the graph.
    """

    dots: IntArray
    closed: bool
    terms: Work
    lower_bound: float
    zero_angles: int
    diagonal_deviation: float
    sweeps: int

    def __post_init__(self) -> None:
        object.__setattr__(self, "dots", frozen(self.dots, np.intp))

    @classmethod
    def without_work(cls, dots: IntArray, closed: bool) -> Correspondence:
        """Return a correspondence that nobody solved."""
        return cls(dots, closed, Work(), lower_bound=0.0, zero_angles=0, diagonal_deviation=0.0, sweeps=0)

    @property
    def pairs(self) -> IntArray:
        """The dots: pairs of vertex numbers."""
        return self.dots

    @property
    def work(self) -> float:
        """All work together."""
        return self.terms.total

    @property
    def stretching(self) -> float:
        """The work of stretching."""
        return self.terms.stretching

    @property
    def bending(self) -> float:
        """The work of bending."""
        return self.terms.bending

    @property
    def travel(self) -> float:
        """The work of travel."""
        return self.terms.travel

    @property
    def gap(self) -> float:
        """How much less work another path could cost, as a share of this one's; 0 where none costs less."""
        return (self.work - self.lower_bound) / self.work if self.work > 0.0 else 0.0


def unroll(dots: IntArray, period: tuple[int, int] | None) -> FloatArray:
    """Return (k, 2) dots as positions along both polygons that never fall.

    Those of closed polygons, which have `period` vertices, count on beyond the last vertex, and end with the first dot
    once more: (k + 1, 2).
    """
    if period is None:
        return dots.astype(np.float64)
    steps = np.diff(dots, axis=0, append=dots[:1]) % np.array(period)
    return np.concatenate([dots[:1], dots[:1] + np.cumsum(steps, axis=0)]).astype(np.float64)


class ContourBlend(NamedTuple):
    """A contour of A, the contour of B it becomes, and the paths it moves between.

    Contours are numbered through each file in paint order; None is for one without a partner.
    Both are in A's coordinates and in the same direction. A point is a contour whose control points are all there, and
    a polygon of one vertex.

    Start and end are segment for segment alike: lines along the polygons, a step of the correspondence each, until
    `interpolate.paths.with_curves` takes the drawings' own curves.
    """

    a: int | None
    b: int | None
    contour_a: Contour
    contour_b: Contour
    polygon_a: Polygon  # the contours flattened, as solved
    polygon_b: Polygon
    scale_a: float  # what section 3.3's normalisation divided by
    scale_b: float
    correspondence: Correspondence
    start: CubicPath
    end: CubicPath
    cuts: tuple[
        FloatArray, FloatArray
    ]  # where segments begin and end, in vertices, rising; once round if closed
    rotation: float = 0.0  # by what angle B was turned back while it was solved, in radians
    seconds: float = 0.0  # how long that took
    reason: str = ""  # why these two are a pair, or why it has no partner, a phrase
    parents: tuple[int | None, int | None] = (None, None)  # what each lies in, by number; None in nothing

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
        """Whether it has no partner and follows the edge that it lies on, a line or an outline at both ends."""
        return not self.is_matched and min(len(self.polygon_a.vertices), len(self.polygon_b.vertices)) > 1

    def dot_points(self) -> tuple[ComplexArray, ComplexArray]:
        """Return the vertices that correspond, a pair for every dot."""
        i, j = self.correspondence.dots.T
        return self.polygon_a.vertices[i], self.polygon_b.vertices[j]


class Motion(Protocol):
    """How contours that are painted together move from start to end."""

    @property
    def name(self) -> str:
        """As `--motion` has it."""

    def segments(self, contours: Sequence[ContourBlend], t: float) -> list[ComplexArray]:
        """Control points of each contour at a time within (0, 1); towards 0 and 1 the start's and the end's."""


class Fade(NamedTuple):
    """How a shape comes or goes: evenly from one time to another."""

    begin: float
    until: float
    comes: bool  # whether it is seen at the end, and not at the start

    @property
    def times(self) -> tuple[float, ...]:
        """The times within (0, 1) at which it begins or ends to change."""
        return tuple(t for t in (self.begin, self.until) if 0.0 < t < 1.0)

    def share(self, t: float) -> float:
        """Return what share of its opacity it has at time t."""
        come = min(max((t - self.begin) / (self.until - self.begin), 0.0), 1.0)
        return come if self.comes else 1.0 - come


class Candidate(NamedTuple):
    """A motion of a shape that was judged."""

    name: str
    wrong: float  # the judge's number
    terms: tuple[tuple[str, float], ...]  # what it adds up, with weights
    painted: float  # the area that the shape paints, whose shares these are


WHOLE = (0.0, 1.0)


class ShapeBlend(NamedTuple):
    """Contours that are painted together, from one paint to another."""

    contours: tuple[ContourBlend, ...]
    style_a: Style
    style_b: Style  # its lengths in A's coordinates
    motion: Motion | None = None  # None is straight paths, eq (2)
    reason: str = ""  # why it moves so, a phrase
    fade: Fade | None = None  # how it comes or goes where others like it are seen at an end instead
    is_twin: bool = (
        False  # whether it is the second copy of a shape that has two places in the order of paint
    )
    candidates: tuple[Candidate, ...] = ()  # what was judged, in this order, where there was a choice
    sources: tuple[int | None, int | None] = (None, None)  # the shapes of A and B it is, by index
    names: tuple[Name, ...] = ()  # of these
    groups: tuple[Group, ...] = ()
    clips: tuple[ClipBlend, ...] = ()
    span: tuple[float, float] = (0.0, 1.0)  # when it starts and ends, if shapes start one after the other

    def own_time(self, t: float) -> float:
        """Return the time that it is at, 0 before it starts and 1 after its end."""
        begin, until = self.span
        return t if self.span == WHOLE else min(max((t - begin) / (until - begin), 0.0), 1.0)

    def time_of(self, own: float) -> float:
        """Return the time at which it is at a time of its own."""
        begin, until = self.span
        return own if self.span == WHOLE else begin + own * (until - begin)

    @property
    def name(self) -> Name:
        """What it is called in a blend."""
        return Name.common(self.names) if self.names else UNNAMED

    @property
    def motion_name(self) -> str:
        """As `--motion` has it."""
        return self.motion.name if self.motion else "linear"

    @property
    def is_matched(self) -> bool:
        """Whether any of its contours has a partner."""
        return any(contour.is_matched for contour in self.contours)

    @property
    def taken(self) -> Candidate | None:
        """The candidate that it is, if any were judged."""
        return next((one for one in self.candidates if one.name == self.motion_name), None)

    @property
    def size(self) -> float:
        """The larger side of its largest contour's box."""
        return max(max(contour.scale_a, contour.scale_b) for contour in self.contours)


class ClipBlend(NamedTuple):
    """A region from one to another, shape by shape; what they fill together."""

    shapes: tuple[ShapeBlend, ...]

    @property
    def rule(self) -> str:
        """The fill rule."""
        return self.shapes[0].style_a.fill_rule


class Place(NamedTuple):
    """A place in the order of paint, from the lowest: which shape is there, and when."""

    shape: int  # its index
    end: int | None = None  # 0 if that is its place in A alone, 1 in B alone; None in both


class PaintedShape(NamedTuple):
    """Outlines that are painted together: one path of a frame."""

    paths: tuple[CubicPath, ...]
    style: Style
    below: Style | None = None  # painted first, under `style`, where one paint has to dissolve into another
    name: Name = Name()
    groups: tuple[Group, ...] = ()  # the outermost first
    clips: tuple[Clip, ...] = ()


class Waypoint(NamedTuple):
    """Where outlines are at time t, within (0, 1), on their way from one drawing to the next."""

    t: float
    paths: tuple[CubicPath, ...]


class KeyframedShape(NamedTuple):
    """A shape over several keys, the drawings that are blended one after the other.

    All keys have the same path commands. Between two keys there may be waypoints with these commands too, in order of
    time; from one to the next all points move in nearly straight lines. What fades has styles there as well, at
    times of their own; from one to the next its opacities change evenly.
    """

    keys: tuple[PaintedShape, ...]
    first: int  # number of the drawing it begins with
    waypoints: tuple[tuple[Waypoint, ...], ...]
    fading: tuple[tuple[tuple[float, Style], ...], ...] = ()
    name: Name = Name()
    groups: tuple[Group, ...] = ()
    spans: tuple[tuple[float, float], ...] = ()  # when paint changes between keys, if not all the time
    clips: tuple[tuple[KeyframedShape, ...], ...] = ()  # regions, each of shapes that fill it together


class Pair(NamedTuple):
    """Two drawings, matched shape by shape, with the numbers of their files."""

    a: int
    b: int
    shapes: tuple[
        ShapeBlend, ...
    ]  # in paint order; where that changes, a shape and its twin at another place
    drawn: tuple[tuple[PaintedShape, ...], tuple[PaintedShape, ...]]  # as they are, laid over A
    views: tuple[Box, Box]  # what part of the plane to show of each
    pages: tuple[Page, Page] = (Page(), Page())  # of each, the box in A's coordinates

    @property
    def each_shape(self) -> list[ShapeBlend]:
        """The shapes without twins."""
        return [shape for shape in self.shapes if not shape.is_twin]

    @property
    def contours(self) -> list[ContourBlend]:
        """The contours of all shapes."""
        return [contour for shape in self.each_shape for contour in shape.contours]


class Frame(NamedTuple):
    """One in-between, at a time t within its pair: what a frame file draws."""

    t: float
    pair: int
    shapes: tuple[PaintedShape, ...]  # in paint order
    view: Box  # what part of the plane to show
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
