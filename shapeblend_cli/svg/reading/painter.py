"""The style a shape is painted in: paint servers, opacity, stroke width and dashes resolved."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from shapeblend_cli.geometry import cubics
from shapeblend_cli.model import Box, Contour, Stop, Style
from shapeblend_cli.svg.reading import colours, gradients
from shapeblend_cli.svg.reading.cascade import Cascade, Inherited
from shapeblend_cli.svg.reading.messages import Notes, check_limit
from shapeblend_cli.svg.reading.transforms import Affine
from shapeblend_cli.svg.reading.units import Lengths
from shapeblend_cli.svg.reading.xmltree import Node

MAX_STOPS = 200_000
"""Of all gradients together, counted once for every colour they are used with."""

_STAND_IN = "a gradient or pattern read as a plain colour"


class Painter:
    """Makes a `Style` of the properties in force for an element of a document, whose nodes it knows by their ids."""

    def __init__(self, ids: dict[str, Node], cascade: Cascade, notes: Notes) -> None:
        self._ids = ids
        self._cascade = cascade
        self._notes = notes
        self._stops: dict[tuple[int, colours.Colour, int], tuple[Inherited, tuple[Stop, ...]]] = {}
        self._stops_read = 0

    def style(self, inherited: Inherited, opacity: float, scale: float, lengths: Lengths) -> Style:
        """Return the style of a shape, with plain colours in place of gradients and patterns.

        The `opacity` is that of the shape times that of all groups around it; `scale` is the factor by which its
        transforms multiply the width of its stroke.
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
        )

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
        box: Box | None = None
        for name, given in (("fill", inherited.fill), ("stroke", inherited.stroke)):
            # Without the server nothing is painted, or the fallback.
            if given.kind != "server" or getattr(style, name) is None or self._fallback(given) is not None:
                continue
            if box is None:
                box = cubics.bounds(np.concatenate([contour.segments for contour in contours]))
            links = self._links(given)
            stops = self._stops_of(links, inherited)
            gradient = gradients.resolve(links, stops, matrix, box, lengths) if links else None
            if gradient is None:
                self._notes.add(_STAND_IN)
            elif isinstance(gradient, Stop):
                style = style.with_plain(name, gradient)
            elif name == "fill":
                style = style._replace(fill_gradient=gradient)
            else:
                style = style._replace(stroke_gradient=gradient)
        return style

    def _server(self, given: colours.Paint) -> Node | None:
        return self._ids.get(given.link[1:]) if given.link.startswith("#") else None

    def _links(self, given: colours.Paint) -> list[Node]:
        """Return the gradient a paint refers to and those it is linked to; none of anything else."""
        server = self._server(given)
        return gradients.chain(server, self._ids) if server else []

    def _fallback(self, given: colours.Paint) -> colours.Paint | None:
        """Return a paint server's fallback if that is painted: in place of a pattern or a missing server."""
        server = self._server(given)
        if given.fallback is None or (server is not None and server.tag in gradients.KINDS):
            return None
        return given.fallback if given.fallback.kind != "none" or server is None else None

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
        stops = self._stops_of(self._links(given), inherited)
        # A gradient's first colour, opaque: a later stop may well be.
        return colours.Colour(stops[0].colour) if stops else colours.BLACK

    def _stops_of(self, links: list[Node], inherited: Inherited) -> tuple[Stop, ...]:
        if not links:
            return ()
        # Stops may have the shape's colour, or that of one of its custom properties. What is in force is kept, so that
        # the number that stands for the custom properties remains theirs.
        key = id(links[0]), inherited.color, id(inherited.variables)
        if key not in self._stops:
            stops = gradients.read_stops(links, self._cascade, inherited)
            self._stops_read += len(stops)
            check_limit(self._stops_read, MAX_STOPS, "stops of gradients")
            self._stops[key] = inherited, stops
        return self._stops[key][1]
