"""The style a shape is painted in: gradients, opacity, stroke width and dashes resolved."""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Mapping, Sequence
from functools import cache, partial
from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.geometry import cubics
from shapeblend_cli.model import Box, Contour, Gradient, LinearGradient, Paint, RadialGradient, Stop, Style
from shapeblend_cli.svg.reading import viewports
from shapeblend_cli.svg.styles import css_colours as colours
from shapeblend_cli.svg.styles.cascade import Cascade, Inherited, in_force
from shapeblend_cli.svg.styles.declarations import substitute
from shapeblend_cli.svg.styles.values import share
from shapeblend_cli.svg.xml.messages import Notes, check_limit
from shapeblend_cli.svg.xml.transforms import IDENTITY, Affine, is_sound, onto
from shapeblend_cli.svg.xml.transforms import parse as parse_transform
from shapeblend_cli.svg.xml.units import Lengths, length
from shapeblend_cli.svg.xml.xmltree import Node, Tree

if TYPE_CHECKING:
    from shapeblend_cli.svg.effects.tiles import Draw

MAX_STOPS = 200_000  # of all gradients together
_STAND_IN = "a gradient or pattern read as a plain colour"
_GRADIENTS = frozenset(("linearGradient", "radialGradient"))
_MAX_LINKS = 8

_NO_AREA = 1e-24  # a gradient whose unit square is this small in the drawing has no extent
_CIRCLE = 1e-9  # radii that differ by no more than this share are equal


class Painter:
    """Makes a `Style` of the properties in force for an element of a document, whose nodes it knows by their ids."""

    def __init__(self, tree: Tree, ids: dict[str, Node], cascade: Cascade, notes: Notes, draw: Draw) -> None:
        self._tree = tree
        self._ids = ids
        self._draw = draw  # what is in a pattern
        self._cascade = cascade
        self._notes = notes
        self._stops: dict[int, tuple[Stop, ...]] = {}
        self._stops_read = 0
        self._within: tuple[Node, ...] = ()  # the patterns and masks that are being drawn, the innermost last
        self._closing: set[tuple[int, int]] = set()  # see `circles.closing`

    def within(self, node: Node, draw: Draw) -> Painter:
        """Return a painter of what is in a pattern or a mask."""
        from shapeblend_cli.svg.effects import circles

        inner = Painter(self._tree, self._ids, self._cascade, self._notes, draw)
        inner._within = (*self._within, node)
        inner._closing = (
            self._closing if self._within else circles.closing(self._tree.root, self._ids, self._cascade)
        )
        return inner

    def style(self, inherited: Inherited, opacity: float, scale: float, lengths: Lengths) -> Style:
        """Return the style of a shape, with plain colours in place of gradients and patterns.

        The `opacity` is the product over the shape and all groups around it; `scale` is the factor of its transforms
        for the width of its stroke.
        """
        fill, fill_alpha = self._colour(inherited.fill, inherited)
        stroke, stroke_alpha = self._colour(inherited.stroke, inherited)
        width = lengths.resolve(inherited.stroke_width)
        dashes = tuple(scale * lengths.resolve(dash) for dash in inherited.stroke_dasharray)
        return Style(
            fill=fill,
            fill_opacity=fill_alpha * inherited.fill_opacity * opacity,
            fill_rule=inherited.fill_rule,
            stroke=stroke if width > 0 else None,
            stroke_opacity=stroke_alpha * inherited.stroke_opacity * opacity,
            stroke_width=width * scale,
            stroke_linecap=inherited.stroke_linecap,
            stroke_linejoin=inherited.stroke_linejoin,
            stroke_miterlimit=inherited.stroke_miterlimit,
            # https://www.w3.org/TR/SVG2/painting.html#StrokeDasharrayProperty: only zeros are a solid line.
            stroke_dasharray=dashes if any(dashes) else (),
            stroke_dashoffset=scale * lengths.resolve(inherited.stroke_dashoffset),
            paint_order=inherited.paint_order,
        )

    def page_coloured(self, style: Style, inherited: Inherited) -> tuple[str, ...]:
        """Return which of fill and stroke are `currentColor` of the page, as the file sets no colour.

        Of gradients the stops know it.
        """
        return tuple(
            name
            for name, paint, gradient in (
                ("fill", inherited.fill, style.fill_gradient),
                ("stroke", inherited.stroke, style.stroke_gradient),
            )
            if getattr(style, name) is not None and gradient is None and self._is_of_page(paint, inherited)
        )

    def _is_of_page(self, paint: colours.Paint, inherited: Inherited) -> bool:
        """Return whether the plain colour that stands for a paint is that of the page."""
        paint = self._fallback(paint) or paint
        if paint.kind == "server":
            stops = self._stops_of(_chain(paint.link, self._ids))
            return bool(stops) and all(stop.of_page for stop in stops)
        return paint.kind == "current" and not inherited.has_color

    def with_gradients(
        self,
        style: Style,
        inherited: Inherited,
        contours: Sequence[Contour],
        matrix: Affine,
        lengths: Lengths,
    ) -> Style:
        """Return the style of a shape with the gradients it is painted in; note plain colours that remain.

        The `contours` are in the shape's own coordinates, as a gradient may be; `matrix` maps these to the root's.
        """
        for name, given in (("fill", inherited.fill), ("stroke", inherited.stroke)):
            # Without the server nothing is painted, or the fallback.
            if given.kind != "server" or getattr(style, name) is None or self._fallback(given) is not None:
                continue
            box = cubics.bounds(np.concatenate([contour.segments for contour in contours]))
            server = self._ids.get(given.link[1:]) if given.link.startswith("#") else None
            if server is not None and server.tag == "pattern":
                style = self._with_pattern(style, name, server, (matrix, box, lengths))
                continue
            links = _chain(given.link, self._ids)
            gradient = _resolve(links, self._stops_of(links), matrix, box, lengths)
            if gradient is None:
                self._notes.add(_STAND_IN)
            elif isinstance(gradient, Stop):
                style = style.with_plain(name, gradient)
            elif name == "fill":
                style = style._replace(fill_gradient=gradient)
            else:
                style = style._replace(stroke_gradient=gradient)
        return style

    def _with_pattern(
        self, style: Style, name: str, server: Node, placed: tuple[Affine, Box, Lengths]
    ) -> Style:
        """Return a style with a pattern for its fill or its stroke; a plain colour stands for one that is not whole."""
        from shapeblend_cli.svg.effects import tiles

        links = tiles.chain(server, self._ids)
        found = tiles.pattern_of(links, *placed, self._draw, self._fitted)
        if found is None:
            self._notes.add(_STAND_IN)
            return style
        if not found.content.shapes:
            return style._replace(fill=None) if name == "fill" else style._replace(stroke=None)
        fill, stroke = style.paints
        if name == "fill":
            return style.painted(Paint(tiles.colour_of(found) or fill.colour, fill.opacity, found), stroke)
        return style.painted(fill, Paint(tiles.colour_of(found) or stroke.colour, stroke.opacity, found))

    def _fitted(self, node: Node, width: float, height: float) -> Affine | None:
        """Return the map of an element's viewBox onto a size."""
        box = viewports.viewbox(node, self._notes)
        return box and viewports.fit(box, width, height, node.get("preserveAspectRatio") or "")

    def _fallback(self, given: colours.Paint) -> colours.Paint | None:
        """Return a paint server's fallback if that is painted: in place of a missing server."""
        server = self._ids.get(given.link[1:]) if given.link.startswith("#") else None
        return None if given.fallback is None or self._paints(server) else given.fallback

    def _colour(self, given: colours.Paint, inherited: Inherited) -> tuple[str | None, float]:
        """Return the plain colour that stands for a paint, and its opacity."""
        if given.kind == "current":
            return inherited.color
        if given.colour is not None:
            return given.colour
        if given.kind != "server":
            return None, 1.0
        fallback = self._fallback(given)
        if fallback is not None:
            return self._colour(fallback, inherited)
        server = self._ids.get(given.link[1:]) if given.link.startswith("#") else None
        if not self._paints(server):
            return None, 1.0  # as in browsers
        stops = self._stops_of(_chain(given.link, self._ids))
        # A gradient's first colour, opaque: a later stop may well be.
        return colours.Colour(stops[0].colour) if stops else colours.BLACK

    def _paints(self, server: Node | None) -> bool:
        """Return whether a paint server is there, and no pattern that has no tile or would be drawn in itself."""
        if server is None or server.tag in _GRADIENTS:
            return server is not None
        from shapeblend_cli.svg.effects import circles, tiles

        if server.tag != "pattern" or not tiles.has_tile(tiles.chain(server, self._ids)):
            return False
        return not circles.is_closed(server, self._within, self._closing, self._ids)

    def _stops_of(self, links: list[Node]) -> tuple[Stop, ...]:
        """Return the stops of the first gradient in a chain that has any."""
        holders = (node for node in links if any(child.tag == "stop" for child in node.children))
        holder = next(holders, None)
        if holder is None:
            return ()
        if id(holder) not in self._stops:
            nodes = [child for child in holder.children if child.tag == "stop"]
            self._stops_read += len(nodes)
            check_limit(self._stops_read, MAX_STOPS, "stops of gradients")
            self._stops[id(holder)] = _read_stops(nodes, self._cascade, cache(partial(self._around, holder)))
        return self._stops[id(holder)]

    def _around(self, node: Node) -> Inherited:
        """Return what is in force in an element, wherever it is referred to."""
        return in_force(self._cascade, [*self._tree.around(node), node], self._notes.add)


def _chain(link: str, ids: Mapping[str, Node]) -> list[Node]:
    """Return the gradient at a link and those it refers to, the nearest first; anything else is not followed."""
    links: list[Node] = []
    while link.startswith("#") and len(links) < _MAX_LINKS:
        node = ids.get(link[1:])
        if node is None or node.tag not in _GRADIENTS:
            break
        links.append(node)
        link = node.link().strip()
    return links


def _read_stops(nodes: Sequence[Node], cascade: Cascade, around: Callable[[], Inherited]) -> tuple[Stop, ...]:
    """Return stops, their offsets in order. Few ask for what is in force `around` them."""
    stops: list[Stop] = []
    offset = 0.0
    for node in nodes:
        declared = cascade.declared(node, keep=True)
        if any("var(" in value for value in declared.values()):
            declared = substitute(declared, around().variables)
        given = colours.parse(declared.get("stop-color", "black"))
        colour, of_page = colours.BLACK, False
        if given is not None and given.kind == "current":
            own = in_force(cascade, [node], lambda phrase: None, around())
            colour, of_page = own.color, not own.has_color
        elif given is not None and given.colour is not None:
            colour = given.colour
        opacity = share(declared.get("stop-opacity", "1"))
        # An offset before that of the stop before it counts as that.
        offset = max(offset, share(node.get("offset") or "0") or 0.0)
        alpha = colour.alpha * (1.0 if opacity is None else opacity)
        stops.append(Stop(offset, colour.rgb, alpha, of_page))
    return tuple(stops)


def _resolve(
    links: list[Node], stops: tuple[Stop, ...], matrix: Affine, box: Box, lengths: Lengths
) -> Gradient | Stop | None:
    """Return a chain of gradients as one gradient in the root's coordinates.

    If it paints a single colour, return a stop; if it paints nothing, without stops or extent, None. The `matrix` maps
    the shape's coordinates to the root's; the `box` is around the shape, without the width of strokes.
    """
    if not stops:
        return None
    if all(stop[1:] == stops[0][1:] for stop in stops):
        return stops[-1]
    attributes = _Attributes(links, lengths)
    own = parse_transform(attributes.get("gradientTransform")) or IDENTITY
    if attributes.in_box:
        if box.width <= 0.0 or box.height <= 0.0:
            return None
        matrix = matrix @ onto(box)
    spread = attributes.get("spreadMethod").strip()
    spread = spread if spread in ("reflect", "repeat") else "pad"
    is_linear = links[0].tag == "linearGradient"
    if is_linear:
        start = complex(attributes.x("x1", "0%"), attributes.y("y1", "0%"))
        vector = complex(attributes.x("x2", "100%"), attributes.y("y2", "0%")) - start
        frame = Affine(vector.real, vector.imag, -vector.imag, vector.real, start.real, start.imag)
        is_point = vector == 0.0
    else:
        centre = complex(attributes.x("cx", "50%"), attributes.y("cy", "50%"))
        focus = complex(attributes.x("fx", centre.real), attributes.y("fy", centre.imag))
        radius = attributes.radius("r", "50%")
        frame = Affine(radius, 0.0, 0.0, radius, centre.real, centre.imag)
        is_point = radius <= 0.0
    if is_point:
        return stops[-1]
    matrix = matrix @ own @ frame
    if not is_sound(matrix) or abs(matrix.determinant) < _NO_AREA:
        return None
    if is_linear:
        return _linear(matrix, stops, spread)
    focal_radius = max(attributes.radius("fr", "0%"), 0.0)
    return _radial(matrix, (focus - centre) / radius, focal_radius / radius, stops, spread)


class _Attributes:
    """The attributes of a chain of gradients: the first gradient that has an attribute sets it.

    Attributes of the geometry are handed on between gradients of one kind only.
    """

    def __init__(self, links: list[Node], lengths: Lengths) -> None:
        self._links = links
        self._own_kind = [node for node in links if node.tag == links[0].tag]
        self.in_box = self.get("gradientUnits").strip() != "userSpaceOnUse"
        self._lengths = Lengths(1.0, 1.0, lengths.font_size) if self.in_box else lengths

    def get(self, name: str) -> str:
        return self._first(name, self._links)

    def x(self, name: str, default: str | float) -> float:
        return self._length(name, default, self._lengths.width)

    def y(self, name: str, default: str | float) -> float:
        return self._length(name, default, self._lengths.height)

    def radius(self, name: str, default: str) -> float:
        return self._length(name, default, self._lengths.diagonal)

    def _length(self, name: str, default: str | float, whole: float) -> float:
        value = length(self._first(name, self._own_kind), whole, self._lengths.font_size)
        if value is None:
            value = length(default, whole) if isinstance(default, str) else default
        return value or 0.0

    def _first(self, name: str, nodes: list[Node]) -> str:
        return next((node.attrib[name] for node in nodes if name in node.attrib), "")


def _linear(m: Affine, stops: tuple[Stop, ...], spread: str) -> LinearGradient:
    """Return the image of the gradient from 0 to 1 along the x axis.

    Lines of one colour remain lines of one colour. A skew leaves them no longer perpendicular to the line from start to
    end; the end then moves along the last of them until they are.
    """
    vector, last = complex(m.a, m.b), complex(m.c, m.d)
    last /= abs(last)
    start = complex(m.e, m.f)
    return LinearGradient(start, start + vector - last * (vector * last.conjugate()).real, stops, spread)


def _radial(
    m: Affine, focus: complex, focal_radius: float, stops: tuple[Stop, ...], spread: str
) -> RadialGradient:
    """Return the radial gradient whose ellipse is the image of the unit circle.

    In complex numbers the linear part is ``z -> p z + q conj(z)``: a rotation, scaling by ``|p| + |q|`` and
    ``|p| - |q|`` along the axes, and another rotation. The first maps the circle onto itself and moves only the focus.
    """
    a, b, c, d, e, f = m
    p, q = complex(a + d, b - c) / 2, complex(a - d, b + c) / 2
    size_p, size_q = abs(p), abs(q)
    angle, first_rotation = (cmath.phase(p) + cmath.phase(q)) / 2, (cmath.phase(p) - cmath.phase(q)) / 2
    if min(size_p, size_q) <= _CIRCLE * max(size_p, size_q):
        angle, first_rotation = 0.0, (cmath.phase(p) if size_p > size_q else -cmath.phase(q))
        size_p, size_q = max(size_p, size_q) * (size_p > size_q), max(size_p, size_q) * (size_q >= size_p)
    focus *= cmath.rect(1.0, first_rotation)
    return RadialGradient(
        centre=complex(e, f),
        radii=(size_p + size_q, abs(size_p - size_q)),
        angle=math.degrees(angle),
        focus=focus if size_p >= size_q else focus.conjugate(),
        focal_radius=focal_radius,
        stops=stops,
        spread=spread,
    )
