"""Drawings as they are read: paths, shapes, groups, pages; and contours flattened to polygons."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple, Protocol

import numpy as np

from shapeblend_cli.model.arrays import frozen
from shapeblend_cli.model.box import Box
from shapeblend_cli.model.picture import Picture
from shapeblend_cli.model.style import Content, Style

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model.arrays import BoolArray, ComplexArray, FloatArray, IntArray, UIntArray
    from shapeblend_cli.model.filters import Filter


@dataclass(frozen=True, slots=True, eq=False)
class CubicPath:
    """A chain of cubic Bézier segments and lines to draw; some may be points.

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
        """Whether all control points coincide."""
        return bool((self.segments == self.segments[0, 0]).all())


class BentPicture(Protocol):
    """A bent picture at a time."""

    @property
    def box(self) -> Box:
        """The box around it."""

    def pixels(self, corner: complex, scale: float, width: int, height: int) -> UIntArray:
        """Return its pixels, premultiplied, (height, width, 4): from a corner on, by their number in a unit."""

    def drawn(self, view: Box, side: int) -> Picture:
        """Return it as a picture of a view, of some pixels on the longer side."""

    def triangles(self) -> list[tuple[float, list[tuple[Picture, CubicPath]]]]:
        """Return it as layers, each with its opacity: pictures, of which the inside of a triangle is seen."""


def control_box(paths: Sequence[CubicPath]) -> Box:
    """Return the box around the control points of paths."""
    return Box.around(np.concatenate([path.segments.ravel() for path in paths]))


MOST_CONTOURS = 2_000
"""Maximum number of contours of a drawing: every two are compared."""

MOST_SEGMENTS = 50_000
"""Maximum number of segments of a contour."""


class Contour(CubicPath):
    """One subpath of a drawing, transforms applied; closed if it ends in ``Z`` or where it began."""

    __slots__ = ()


class Clip(NamedTuple):
    """The region in which a shape is painted."""

    paths: tuple[CubicPath, ...]
    rule: str = "nonzero"


NORMAL = "normal"
"""Name of the blend mode of what is simply painted on what is below."""


class MaskLayer(NamedTuple):
    """A picture in a mask: where it is white and opaque, all is seen. It is scaled, then moved."""

    content: Content | None  # None is white everywhere
    region: Box  # in its own coordinates, outside of which it is black
    share: float = 1.0  # by which it covers the layers below it
    shift: complex = 0j
    scale: tuple[float, float] = (1.0, 1.0)


class Mask(NamedTuple):
    """A mask, in the coordinates of the drawing: layers, the lowest first, in a region beyond which nothing is seen."""

    region: Box
    layers: tuple[MaskLayer, ...]


class Effect(NamedTuple):
    """What is done to all shapes with an effect of this number together: to a group, or to a shape of its own.

    The filter comes first, then the clips, then the mask; the opacity is last.
    """

    number: int  # of its own in a drawing
    filter: Filter | None = None
    clips: tuple[Clip, ...] = ()
    mask: Mask | None = None
    opacity: float = 1.0
    mode: str = NORMAL  # as mix-blend-mode names it
    isolates: bool = False  # whether modes inside see only what is inside
    place: int = 0  # how many of the groups around a shape are around the effect

    @property
    def has_pictures(self) -> bool:
        """Whether its mask or its filter has some."""
        if self.filter is not None and self.filter.has_pictures:
            return True
        layers = () if self.mask is None else self.mask.layers
        return any(layer.content is not None and layer.content.has_pictures for layer in layers)

    @property
    def is_plain(self) -> bool:
        """Whether it changes nothing."""
        return self._replace(number=0, place=0) == Effect(0)


class Name(NamedTuple):
    """The names of an element: in the file, in editors, and for people; None for those that it lacks."""

    id: str | None = None
    label: str | None = None  # as Inkscape shows it
    title: str | None = None
    description: str | None = None

    @classmethod
    def common(cls, names: Sequence[Name]) -> Name:
        """Return the parts of names on which all that have them agree."""
        found = [{value for value in values if value is not None} for values in zip(*names, strict=True)]
        return cls(*(values.pop() if len(values) == 1 else None for values in found))


UNNAMED = Name()


class Group(NamedTuple):
    """A group or a layer around shapes; transforms and paint that it has are in the shapes."""

    number: int  # of its own in a drawing
    name: Name
    is_layer: bool = False  # for Inkscape


class Length(NamedTuple):
    """A length as a file writes it: a number, and ``mm``, ``%``, nothing and so on."""

    number: float
    unit: str


class Page(NamedTuple):
    """The root of a file: its size, the box in the plane that fills this size, and its names.

    `fit` is its ``preserveAspectRatio``, by which a box of another shape fills the size; empty for the default.
    """

    width: Length | None = None
    height: Length | None = None
    box: Box | None = None
    name: Name = UNNAMED
    fit: str = ""
    heading: str = ""  # stands in for a title: the name of its file, or of several

    @property
    def called(self) -> str:
        """The title for readers who cannot see the picture."""
        return self.name.title or self.heading


@dataclass(frozen=True, slots=True, eq=False)
class Shape:
    """One painted element of a file, in the root's user units."""

    index: int
    id: str | None  # its own, or else the id of a `use` through which it is drawn
    element: str
    contours: tuple[Contour, ...]
    style: Style
    name: Name = UNNAMED
    groups: tuple[Group, ...] = ()  # around it, the outermost first
    clips: tuple[Clip, ...] = ()  # only the region common to all is painted
    page_coloured: tuple[str, ...] = ()  # of ``fill`` and ``stroke``, those that the file leaves to its page
    effects: tuple[Effect, ...] = ()  # around it, the outermost first
    whole: Picture | None = None  # the text that it is a letter of, if that may stay text

    @property
    def has_pictures(self) -> bool:
        """Whether it is painted with pictures, or masked with some."""
        return self.style.has_pictures or any(effect.has_pictures for effect in self.effects)


class Drawing(NamedTuple):
    """The painted shapes of a file.

    Attributes
    ----------
    file : str
        The file as the user named it.
    viewbox : Box or None
        The root's viewBox, else ``0 0 width height``, else None.
    shapes : tuple of Shape
        In paint order.
    notes : tuple of str
        Deviations from a browser, one phrase each.
    page : Page
    has_areas : bool
        Whether its shapes are what is blended: pieces of fills joined, and what is seen through masks.
    """

    file: str
    viewbox: Box | None
    shapes: tuple[Shape, ...]
    notes: tuple[str, ...] = ()
    page: Page = Page()
    has_areas: bool = False

    @property
    def bytes_of_segments(self) -> int:
        """The size of all segments, in bytes."""
        return sum(contour.segments.nbytes for shape in self.shapes for contour in shape.contours)


@dataclass(frozen=True, eq=False)
class Polygon:
    """A flattened contour. A closed polygon stores each vertex once; no two neighbours are equal.

    Each vertex lies on a segment of the contour, at a parameter in [0, 1); only the end of an open polygon is at 1.
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

    @cached_property
    def line(self) -> ComplexArray:
        """The vertices from end to end: if closed, with the first repeated, (m + 1,) complex."""
        return np.concatenate([self.vertices, self.vertices[:1]]) if self.closed else self.vertices
