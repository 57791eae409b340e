"""Paint: colours, gradients and strokes, with the names that SVG gives their properties."""

from __future__ import annotations

from typing import Any, NamedTuple

from shapeblend_cli.model.picture import Picture

PAGE_COLOUR = "currentColor"
"""The text colour of the page that a drawing stands in; black where there is none."""


class Stop(NamedTuple):
    """A colour ``#rrggbb`` of a gradient at an offset from 0, its beginning, to 1, its end."""

    offset: float
    colour: str
    opacity: float = 1.0
    of_page: bool = False  # whether the file leaves the colour to its page, and it is black until then


class LinearGradient(NamedTuple):
    """Colours along a line, in the coordinates of the drawing."""

    start: complex
    end: complex
    stops: tuple[Stop, ...]  # two or more, in order
    spread: str = "pad"  # beyond the ends: pad, reflect or repeat


class RadialGradient(NamedTuple):
    """Colours from a focus out to an ellipse, in the coordinates of the drawing.

    The ellipse is the unit circle stretched by `radii`, turned by `angle` and moved to `centre`: not a matrix, because
    SMIL can move each of these.
    """

    centre: complex
    radii: tuple[float, float]  # the larger first
    angle: float  # in degrees; 0 for a circle
    focus: complex  # in the unit circle, before it is stretched
    focal_radius: float  # of the circle on which the colours begin, in radii
    stops: tuple[Stop, ...]
    spread: str = "pad"


class Content:
    """Shapes that are drawn as they are, in a pattern or a mask; two that paint the same are equal."""

    __slots__ = ("has_pictures", "key", "shapes")

    def __init__(self, shapes: tuple[Any, ...], key: str) -> None:
        self.shapes = shapes  # of `Shape`, in coordinates of their own
        self.key = key  # a digest of what they paint
        self.has_pictures = any(shape.has_pictures for shape in shapes)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Content) and self.key == other.key

    def __hash__(self) -> int:
        return hash(self.key)

    def __repr__(self) -> str:
        return f"Content({self.key})"


class Pattern(NamedTuple):
    """A tile that is repeated in both directions, in the coordinates of the drawing.

    The tile has its corner at 0. It is scaled, skewed along x, turned, and moved: each of these SMIL can change.
    """

    content: Content
    size: tuple[float, float]  # of the tile, before it is scaled
    origin: complex
    angle: float  # in degrees
    scale: tuple[float, float]
    skew: float  # in degrees

    @property
    def stops(self) -> tuple[Stop, ...]:
        """The stops that a gradient has."""
        return ()


Gradient = LinearGradient | RadialGradient | Pattern

Filling = Gradient | Picture


class Paint(NamedTuple):
    """The paint of a fill or a stroke."""

    colour: str | None
    opacity: float
    gradient: Filling | None = None

    @property
    def least_opacity(self) -> float:
        """The opacity where least is seen of it."""
        if isinstance(self.gradient, Picture):
            return self.opacity * float(self.gradient.raster.is_opaque)
        if isinstance(self.gradient, Pattern):
            return 0.0  # between what it draws there may be gaps
        return (
            self.opacity * min((stop.opacity for stop in self.gradient.stops), default=1.0)
            if self.gradient
            else self.opacity
        )


class Style(NamedTuple):
    """The paint of a shape, by the properties of SVG.

    Colours are ``#rrggbb``; None is no paint. A gradient, or a picture, is painted instead of the plain colour that
    stands for it. Only what is about to be written has `PAGE_COLOUR` for a colour, by `paint.page_colour`: until then
    it is black.
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
    fill_gradient: Filling | None = None
    stroke_gradient: Filling | None = None
    paint_order: str = "normal"  # or stroke, if that is below the fill
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

    @property
    def picture(self) -> Picture | None:
        """The picture that it fills a shape with, if it is one."""
        return self.fill_gradient if isinstance(self.fill_gradient, Picture) else None

    @property
    def has_pictures(self) -> bool:
        """Whether it is painted with a picture, or with a pattern that has some."""
        return any(
            isinstance(paint, Picture) or (isinstance(paint, Pattern) and paint.content.has_pictures)
            for paint in (self.fill_gradient, self.stroke_gradient)
        )

    @property
    def reach(self) -> float:
        """Distance from an outline to the edge of its stroke; 0 without a stroke."""
        return self.stroke_width / 2.0 if self.stroke else 0.0

    @property
    def paints(self) -> tuple[Paint, Paint]:
        """The paint of the fill and of the stroke."""
        fill = Paint(self.fill, self.fill_opacity, self.fill_gradient)
        return fill, Paint(self.stroke, self.stroke_opacity, self.stroke_gradient)

    def painted(self, fill: Paint, stroke: Paint) -> Style:
        """Return the style with other paint."""
        return self._replace(
            fill=fill.colour,
            fill_opacity=fill.opacity,
            fill_gradient=fill.gradient,
            stroke=stroke.colour,
            stroke_opacity=stroke.opacity,
            stroke_gradient=stroke.gradient,
        )

    def faded(self, share: float) -> Style:
        """Return the style with a share of its opacity."""
        return self._replace(
            fill_opacity=share * self.fill_opacity, stroke_opacity=share * self.stroke_opacity
        )

    def with_plain(self, name: str, stop: Stop) -> Style:
        """Return the style with the colour of a stop, instead of any gradient, for its fill or its stroke."""
        if name == "fill":
            opacity = self.fill_opacity * stop.opacity
            return self._replace(fill=stop.colour, fill_opacity=opacity, fill_gradient=None)
        opacity = self.stroke_opacity * stop.opacity
        return self._replace(stroke=stop.colour, stroke_opacity=opacity, stroke_gradient=None)
