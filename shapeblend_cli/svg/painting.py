"""The style a shape is painted in: paint servers, opacity and stroke width resolved."""

from __future__ import annotations

from typing import TYPE_CHECKING

from shapeblend_cli.model import Style
from shapeblend_cli.svg import paint
from shapeblend_cli.svg.style import Inherited, diagonal

if TYPE_CHECKING:
    from shapeblend_cli.svg.css import Cascade
    from shapeblend_cli.svg.notes import Notes
    from shapeblend_cli.svg.xmltree import Node

_GRADIENTS = frozenset(("linearGradient", "radialGradient"))
_MAX_LINKS = 8


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
        self._stops: dict[int, paint.Colour] = {}

    def style(
        self, inherited: Inherited, opacity: float, scale: float, viewport: tuple[float, float]
    ) -> Style:
        """Return the style of a shape.

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
        fill, fill_alpha = self._colour(inherited.fill, inherited.color)
        stroke, stroke_alpha = self._colour(inherited.stroke, inherited.color)
        fill_alpha *= inherited.fill_opacity * opacity
        stroke_alpha *= inherited.stroke_opacity * opacity
        width, is_share = inherited.stroke_width
        if is_share:
            width *= diagonal(*viewport)
        return Style(
            fill=fill,
            fill_opacity=fill_alpha,
            fill_rule=inherited.fill_rule,
            stroke=stroke if width > 0 else None,
            stroke_opacity=stroke_alpha,
            stroke_width=width * scale,
            stroke_linecap=inherited.stroke_linecap,
            stroke_linejoin=inherited.stroke_linejoin,
        )

    def _colour(self, given: paint.Paint, current: paint.Colour) -> tuple[str | None, float]:
        """Return the plain colour that stands for a paint, and its opacity."""
        if given.kind == "current":
            return current
        if given.colour is not None:
            return given.colour
        if given.kind != "server":
            return None, 1.0
        server = self._ids.get(given.link[1:]) if given.link.startswith("#") else None
        fallback = given.fallback
        if fallback is not None and (fallback.kind != "none" or server is None):
            return self._colour(fallback, current)
        self._notes.add("a gradient or pattern read as a plain colour")
        if server is None:
            return paint.BLACK
        if id(server) not in self._stops:
            self._stops[id(server)] = self._first_stop(server) or paint.BLACK
        return self._stops[id(server)]

    def _first_stop(self, gradient: Node) -> paint.Colour | None:
        """Return the colour of a gradient's first stop, opaque: a later stop may well be."""
        for _ in range(_MAX_LINKS):
            if gradient.tag not in _GRADIENTS:
                return None
            for stop in gradient.children:
                if stop.tag == "stop":
                    given = paint.parse(self._cascade.declared(stop).get("stop-color", "black"))
                    # Stops hardly ever say currentColor; its colour would not be the shape's.
                    return paint.Colour(given.colour.rgb) if given and given.colour else None
            target = self._ids.get(gradient.link().strip()[1:])
            if target is None:
                return None
            gradient = target
        return None
