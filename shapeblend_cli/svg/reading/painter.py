"""The style a shape is painted in: paint servers, opacity, stroke width and dashes resolved."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.geometry import cubics
from shapeblend_cli.model import Stop, Style
from shapeblend_cli.svg.reading import colours
from shapeblend_cli.svg.reading.cascade import Inherited, in_user_units
from shapeblend_cli.svg.reading.problem import Problem

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import Box, Contour, Gradient
    from shapeblend_cli.svg.reading.declarations import Cascade
    from shapeblend_cli.svg.reading.notes import Notes
    from shapeblend_cli.svg.reading.transforms import Matrix
    from shapeblend_cli.svg.reading.xmltree import Node

MAX_STOPS = 200_000
"""Of all gradients together, counted once for every colour they are used with."""

_STAND_IN = "a gradient or pattern read as a plain colour"


class Painter:
    """Turns what is in force for an element into a `Style`.

    Parameters
    ----------
    ids : dict
        The nodes of the document by id.
    cascade : Cascade
    notes : Notes
    """

    def __init__(self, ids: dict[str, Node], cascade: Cascade, notes: Notes) -> None:
        self._ids = ids
        self._cascade = cascade
        self._notes = notes
        self._stops: dict[tuple[int, colours.Colour, int], tuple[Inherited, tuple[Stop, ...]]] = {}
        self._stops_read = 0

    def style(
        self, inherited: Inherited, opacity: float, scale: float, viewport: tuple[float, float]
    ) -> Style:
        """Return the style of a shape, with plain colours that stand for gradients and patterns.

        Parameters
        ----------
        inherited : Inherited
            What is in force for the shape.
        opacity : float
            Its own times that of all groups around it.
        scale : float
            What its transforms do to the width of its stroke.
        viewport : pair of float
            What percentages refer to.
        """
        fill, fill_alpha = self._colour(inherited.fill, inherited)
        stroke, stroke_alpha = self._colour(inherited.stroke, inherited)
        width = in_user_units(inherited.stroke_width, viewport)
        dashes = tuple(scale * in_user_units(dash, viewport) for dash in inherited.stroke_dasharray)
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
            stroke_dashoffset=scale * in_user_units(inherited.stroke_dashoffset, viewport),
        )

    def with_gradients(
        self,
        style: Style,
        inherited: Inherited,
        contours: Sequence[Contour],
        matrix: Matrix,
        viewport: tuple[float, float],
    ) -> Style:
        """Return the style of a shape with the gradients it is painted in; what stays a stand-in is noted.

        Parameters
        ----------
        style : Style
        inherited : Inherited
        contours : sequence of Contour
            The shape's, in its own coordinates: the units of a gradient may be those of the box around them.
        matrix : Matrix
            From these coordinates to those of the root.
        viewport : pair of float
        """
        box: Box | None = None
        for name, given in (("fill", inherited.fill), ("stroke", inherited.stroke)):
            server = self._server(given)
            # Where there is no such server, nothing is to be painted, or the fallback.
            if given.kind != "server" or getattr(style, name) is None or self._is_replaced(given, server):
                continue
            if box is None:
                box = cubics.bounds(np.concatenate([contour.segments for contour in contours]))
            found = self._placed(server, inherited, matrix, box, viewport) if server else None
            if found is None:
                self._notes.add(_STAND_IN)
            elif isinstance(found, Stop):
                style = style.with_plain(name, found)
            elif name == "fill":
                style = style._replace(fill_gradient=found)
            else:
                style = style._replace(stroke_gradient=found)
        return style

    def _placed(
        self, server: Node, inherited: Inherited, matrix: Matrix, box: Box, viewport: tuple[float, float]
    ) -> Gradient | Stop | None:
        from shapeblend_cli.svg.reading import gradients  # most drawings have none

        links = gradients.chain(server, self._ids)
        if not links:
            return None
        stops = self._stops_of(server, inherited)
        return gradients.placed(links, stops, matrix, box, viewport, inherited.font_size)

    def _server(self, given: colours.Paint) -> Node | None:
        return self._ids.get(given.link[1:]) if given.link.startswith("#") else None

    def _is_replaced(self, given: colours.Paint, server: Node | None) -> bool:
        """Return whether a paint server's fallback is painted: it is not there, or a pattern."""
        from shapeblend_cli.svg.reading.gradients import KINDS

        if given.fallback is None or (server is not None and server.tag in KINDS):
            return False
        return given.fallback.kind != "none" or server is None

    def _colour(self, given: colours.Paint, inherited: Inherited) -> tuple[str | None, float]:
        """Return the plain colour that stands for a paint, and its opacity."""
        if given.kind == "current":
            return inherited.color
        if given.colour is not None:
            return given.colour
        if given.kind != "server":
            return None, 1.0
        server = self._server(given)
        if given.fallback is not None and self._is_replaced(given, server):
            return self._colour(given.fallback, inherited)
        return (self._first_stop(server, inherited) if server else None) or colours.BLACK

    def _first_stop(self, server: Node, inherited: Inherited) -> colours.Colour | None:
        """Return the colour of a gradient's first stop, opaque: a later stop may well be."""
        stops = self._stops_of(server, inherited)
        return colours.Colour(stops[0].colour) if stops else None

    def _stops_of(self, server: Node, inherited: Inherited) -> tuple[Stop, ...]:
        from shapeblend_cli.svg.reading import gradients

        # They may be of the shape's colour, or of that of one of its custom properties. What is in force is kept, so
        # that the number that stands for the custom properties stays theirs.
        key = id(server), inherited.color, id(inherited.variables)
        if key in self._stops:
            return self._stops[key][1]
        stops = gradients.read_stops(gradients.chain(server, self._ids), self._cascade, inherited)
        self._stops_read += len(stops)
        if self._stops_read > MAX_STOPS:
            raise Problem(f"more than {MAX_STOPS} stops of gradients, the most that are read")
        self._stops[key] = inherited, stops
        return stops
