"""Gradients: links followed, units and transforms resolved, stops read."""

from __future__ import annotations

import cmath
import math
from typing import TYPE_CHECKING

from shapeblend_cli.model import LinearGradient, RadialGradient, Stop
from shapeblend_cli.svg.reading import colours, transforms
from shapeblend_cli.svg.reading.cascade import diagonal, share
from shapeblend_cli.svg.reading.declarations import resolved
from shapeblend_cli.svg.reading.units import length

if TYPE_CHECKING:
    from collections.abc import Mapping

    from shapeblend_cli.model import Box, Gradient
    from shapeblend_cli.svg.reading.cascade import Inherited
    from shapeblend_cli.svg.reading.declarations import Cascade
    from shapeblend_cli.svg.reading.xmltree import Node

KINDS = frozenset(("linearGradient", "radialGradient"))
_MAX_LINKS = 8

_NO_AREA = 1e-24
"""A gradient whose unit square is this small in the drawing has no extent."""

_CIRCLE = 1e-9
"""Radii that differ by no more than this share are the same."""


def chain(gradient: Node, ids: Mapping[str, Node]) -> list[Node]:
    """Return a gradient and those it refers to, the nearest first; a link to anything else is not followed."""
    found: list[Node] = []
    node: Node | None = gradient
    while node is not None and node.tag in KINDS and len(found) < _MAX_LINKS:
        found.append(node)
        link = node.link().strip()
        node = ids.get(link[1:]) if link.startswith("#") else None
    return found


def stop_nodes(links: list[Node]) -> list[Node]:
    """Return the stops of the first gradient in a chain that has any."""
    for node in links:
        stops = [child for child in node.children if child.tag == "stop"]
        if stops:
            return stops
    return []


def read_stops(links: list[Node], cascade: Cascade, inherited: Inherited) -> tuple[Stop, ...]:
    """Return the stops of a chain of gradients, their offsets in order.

    Parameters
    ----------
    links : list of Node
    cascade : Cascade
    inherited : Inherited
        What is in force for the shape. Its custom properties and its colour are taken for those of the gradient, which
        are the same where they are set on the root.
    """
    found: list[Stop] = []
    offset = 0.0
    for node in stop_nodes(links):
        declared = cascade.declared(node, keep=True)
        if any("var(" in value for value in declared.values()):
            declared = resolved(declared, inherited.variables)
        given = colours.parse(declared.get("stop-color", "black"))
        colour = colours.BLACK
        if given is not None and given.kind == "current":
            own = colours.parse_colour(declared["color"]) if "color" in declared else None
            colour = own or inherited.color
        elif given is not None and given.colour is not None:
            colour = given.colour
        opacity = share(declared.get("stop-opacity", "1"))
        # An offset before that of the stop before it counts as that.
        offset = max(offset, share(node.get("offset") or "0") or 0.0)
        found.append(Stop(offset, colour.rgb, colour.alpha * (1.0 if opacity is None else opacity)))
    return tuple(found)


def placed(
    links: list[Node],
    stops: tuple[Stop, ...],
    matrix: transforms.Matrix,
    box: Box,
    viewport: tuple[float, float],
    font_size: float,
) -> Gradient | Stop | None:
    """Return a gradient in the root's coordinates.

    Parameters
    ----------
    links : list of Node
        The gradient and those it refers to.
    stops : tuple of Stop
    matrix : Matrix
        From the coordinates of the shape to those of the root.
    box : Box
        Around the shape, in its own coordinates, without the width of strokes.
    viewport : pair of float
        What percentages refer to.
    font_size : float

    Returns
    -------
    LinearGradient, RadialGradient, Stop or None
        One stop where the same is painted everywhere, None where nothing is: without stops, or without an extent.
    """
    if not stops:
        return None
    if all(stop[1:] == stops[0][1:] for stop in stops):
        return stops[-1]
    attributes = _Attributes(links, viewport, font_size)
    own = transforms.parse(attributes.get("gradientTransform")) or transforms.IDENTITY
    if attributes.in_box:
        if box.width <= 0.0 or box.height <= 0.0:
            return None
        matrix = transforms.multiply(matrix, (box.width, 0.0, 0.0, box.height, box.x, box.y))
    matrix = transforms.multiply(matrix, own)
    spread = attributes.get("spreadMethod").strip()
    spread = spread if spread in ("reflect", "repeat") else "pad"
    is_linear = links[0].tag == "linearGradient"
    if is_linear:
        start = complex(attributes.across("x1", "0%"), attributes.down("y1", "0%"))
        way = complex(attributes.across("x2", "100%"), attributes.down("y2", "0%")) - start
        frame = (way.real, way.imag, -way.imag, way.real, start.real, start.imag)
        is_point = way == 0.0
    else:
        centre = complex(attributes.across("cx", "50%"), attributes.down("cy", "50%"))
        focus = complex(attributes.across("fx", centre.real), attributes.down("fy", centre.imag))
        radius = attributes.along("r", "50%")
        frame = (radius, 0.0, 0.0, radius, centre.real, centre.imag)
        is_point = radius <= 0.0
    if is_point:
        return stops[-1]
    matrix = transforms.multiply(matrix, frame)
    if not transforms.is_sound(matrix) or abs(transforms.determinant(matrix)) < _NO_AREA:
        return None
    if is_linear:
        return _linear(matrix, stops, spread)
    focal_radius = max(attributes.along("fr", "0%"), 0.0)
    return _radial(matrix, (focus - centre) / radius, focal_radius / radius, stops, spread)


class _Attributes:
    """The attributes of a chain of gradients: each is that of the first that has it.

    Those of the geometry are only handed on between gradients of one kind.
    """

    def __init__(self, links: list[Node], viewport: tuple[float, float], font_size: float) -> None:
        self._links = links
        self._own_kind = [node for node in links if node.tag == links[0].tag]
        self._font_size = font_size
        self.in_box = self.get("gradientUnits").strip() != "userSpaceOnUse"
        self._viewport = (1.0, 1.0) if self.in_box else viewport

    def get(self, name: str) -> str:
        return next((node.attrib[name] for node in self._links if name in node.attrib), "")

    def across(self, name: str, default: str | float) -> float:
        return self._length(name, default, self._viewport[0])

    def down(self, name: str, default: str | float) -> float:
        return self._length(name, default, self._viewport[1])

    def along(self, name: str, default: str | float) -> float:
        return self._length(name, default, diagonal(*self._viewport))

    def _length(self, name: str, default: str | float, whole: float) -> float:
        text = next((node.attrib[name] for node in self._own_kind if name in node.attrib), "")
        value = length(text, whole, self._font_size)
        if value is None:
            value = length(default, whole) if isinstance(default, str) else default
        return value or 0.0


def _linear(m: transforms.Matrix, stops: tuple[Stop, ...], spread: str) -> LinearGradient:
    """Return the gradient that goes from 0 to 1 along the x axis, under a transform.

    Lines of one colour stay lines of one colour, but where the transform skews they are no longer across the line from
    start to end; the end moves along the last of them to where they are.
    """
    way, last = complex(m[0], m[1]), complex(m[2], m[3])
    last /= abs(last)
    start = complex(m[4], m[5])
    return LinearGradient(start, start + way - last * (way * last.conjugate()).real, stops, spread)


def _radial(
    m: transforms.Matrix, focus: complex, focal_radius: float, stops: tuple[Stop, ...], spread: str
) -> RadialGradient:
    """Return the radial gradient whose ellipse is the unit circle under a transform.

    As complex numbers the transform is ``z -> p z + q conj(z)``: a turn, a stretch along the axes by ``|p| + |q|``
    and ``|p| - |q|``, and another turn. The first turns the circle into itself, and so moves nothing but the focus.
    """
    a, b, c, d, e, f = m
    p, q = complex(a + d, b - c) / 2, complex(a - d, b + c) / 2
    size_p, size_q = abs(p), abs(q)
    angle, first_turn = (cmath.phase(p) + cmath.phase(q)) / 2, (cmath.phase(p) - cmath.phase(q)) / 2
    if min(size_p, size_q) <= _CIRCLE * max(size_p, size_q):
        angle, first_turn = 0.0, (cmath.phase(p) if size_p > size_q else -cmath.phase(q))
        size_p, size_q = max(size_p, size_q) * (size_p > size_q), max(size_p, size_q) * (size_q >= size_p)
    focus *= cmath.rect(1.0, first_turn)
    return RadialGradient(
        centre=complex(e, f),
        radii=(size_p + size_q, abs(size_p - size_q)),
        angle=math.degrees(angle),
        focus=focus if size_p >= size_q else focus.conjugate(),
        focal_radius=focal_radius,
        stops=stops,
        spread=spread,
    )
