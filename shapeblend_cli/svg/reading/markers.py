"""Markers: small drawings at the vertices of a line, such as arrowheads.

https://www.w3.org/TR/SVG2/painting.html#Markers
"""

from __future__ import annotations

import cmath
import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.geometry.polygons import rectangle
from shapeblend_cli.model import Box, Clip, Contour
from shapeblend_cli.svg.reading import contours as outlines
from shapeblend_cli.svg.reading import viewports
from shapeblend_cli.svg.xml.transforms import Affine, angle, rotation, translation
from shapeblend_cli.svg.xml.xmltree import named

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from shapeblend_cli.svg.styles.cascade import Cascade, Inherited
    from shapeblend_cli.svg.xml.messages import Notes
    from shapeblend_cli.svg.xml.units import Lengths
    from shapeblend_cli.svg.xml.xmltree import Node

MOST = 500
"""Maximum number of markers of an element."""


class Mark(NamedTuple):
    """A marker at a vertex."""

    node: Node
    matrix: Affine  # from the marker's contents to the element's own coordinates
    lengths: Lengths  # in its contents
    window: Contour | None  # outside of which nothing is painted, in the element's own coordinates

    def clips(self, matrix: Affine) -> list[Clip]:
        """Return what clips it, in the coordinates of the root."""
        return [] if self.window is None else [Clip((outlines.transform(self.window, matrix),))]


class _Vertex(NamedTuple):
    place: complex
    before: complex  # the unit direction in which the line comes, or goes on if it begins here
    after: complex


def marks(
    contours: Sequence[Contour],
    inherited: Inherited,
    lengths: Lengths,
    ids: Mapping[str, Node],
    cascade: Cascade,
    notes: Notes,
) -> list[Mark]:
    """Return the markers of an element with contours in its own coordinates, in the order of paint."""
    values = inherited.marker_start, inherited.marker_mid, inherited.marker_end
    if values == ("none", "none", "none") or not contours:
        return []
    start, mid, end = (_named(value, ids, notes) for value in values)
    vertices = [vertex for contour in contours for vertex in _vertices(contour)]
    placed = [(start, vertices[0], True), *((mid, vertex, False) for vertex in vertices[1:-1])]
    placed.append((end, vertices[-1], False))
    found = [(node, vertex, first) for node, vertex, first in placed if node is not None]
    if len(found) > MOST:
        notes.add(f"more than {MOST} markers of an element left out")
        return []
    width = lengths.resolve(inherited.stroke_width)
    made = (_mark(node, vertex, first, width, lengths, cascade, notes) for node, vertex, first in found)
    return [mark for mark in made if mark is not None]


def _named(value: str, ids: Mapping[str, Node], notes: Notes) -> Node | None:
    node = ids.get(named(value))
    if node is not None and node.tag == "marker":
        return node
    if value != "none":
        notes.add("a marker that is not in the file left out")
    return None


def _vertices(contour: Contour) -> list[_Vertex]:
    """Return the vertices of a contour with the directions there; a closed one ends at its first vertex again."""
    ways = [_ways(segment) for segment in contour.segments]
    places = [*contour.segments[:, 0].tolist(), complex(contour.segments[-1, 3])]
    last = ways[-1][1] if contour.closed else ways[0][0]
    first = ways[0][0] if contour.closed else ways[-1][1]
    befores, afters = [last, *(way[1] for way in ways)], [*(way[0] for way in ways), first]
    return [_Vertex(*each) for each in zip(places, befores, afters, strict=True)]


def _ways(segment: np.ndarray) -> tuple[complex, complex]:
    """Return the directions in which a segment begins and ends; one without an extent goes to the right."""

    def first(steps: Sequence[complex]) -> complex:
        return next((step / abs(step) for step in steps if step), 1.0 + 0j)

    a, b, c, d = segment.tolist()
    return first((b - a, c - a, d - a)), first((d - c, d - b, d - a))


def _mark(
    node: Node,
    vertex: _Vertex,
    is_first: bool,
    width: float,
    lengths: Lengths,
    cascade: Cascade,
    notes: Notes,
) -> Mark | None:
    """Return a marker at a vertex of a line of a width; None if it has no extent."""
    size = [lengths.x(node.get("markerWidth") or "3"), lengths.y(node.get("markerHeight") or "3")]
    wide, high = (3.0 if side is None else side for side in size)
    unit = 1.0 if (node.get("markerUnits") or "").strip() == "userSpaceOnUse" else width
    if wide <= 0.0 or high <= 0.0 or unit <= 0.0:
        return None
    box = viewports.viewbox(node, notes)
    fit = Affine()
    inner = lengths._replace(width=wide, height=high)
    if box is not None:
        fit = viewports.fit(box, wide, high, node.get("preserveAspectRatio") or "")
        inner = lengths._replace(width=box.width, height=box.height)
    reference = complex(fit.points(np.array([complex(*_reference(node, inner))]))[0])
    matrix = (
        translation(vertex.place.real, vertex.place.imag)
        @ rotation(_angle(node, vertex, is_first))
        @ Affine(unit, 0.0, 0.0, unit)
        @ translation(-reference.real, -reference.imag)
    )
    window = None
    if cascade.declared(node).get("overflow", "hidden").strip() not in ("visible", "auto"):
        window = outlines.transform(rectangle(Box(0.0, 0.0, wide, high)), matrix)
    return Mark(node, matrix @ fit, inner, window)


def _reference(node: Node, inner: Lengths) -> tuple[float, float]:
    words = {"left": 0.0, "top": 0.0, "center": 0.5, "right": 1.0, "bottom": 1.0}
    x, y = ((node.get(name) or "0").strip() for name in ("refX", "refY"))
    at_x = words[x] * inner.width if x in words else inner.x(x)
    at_y = words[y] * inner.height if y in words else inner.y(y)
    return at_x or 0.0, at_y or 0.0


def _angle(node: Node, vertex: _Vertex, is_first: bool) -> float:
    """Return by how much a marker is turned, in radians."""
    orient = (node.get("orient") or "0").strip()
    if orient not in ("auto", "auto-start-reverse"):
        return angle(orient) or 0.0
    both = vertex.before + vertex.after
    ahead = cmath.phase(both if abs(both) > 1e-9 else 1j * vertex.before)
    return ahead + math.pi if is_first and orient == "auto-start-reverse" else ahead
