"""Pictures and elements that filters show.

https://www.w3.org/TR/filter-effects-1/#feImageElement
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from shapeblend_cli.model import Box, Picture, Step, View
from shapeblend_cli.svg.effects.tiles import content_of
from shapeblend_cli.svg.xml.transforms import translation
from shapeblend_cli.svg.xml.units import length
from shapeblend_cli.svg.xml.xmltree import Node

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from shapeblend_cli.svg.effects.placed import Units
    from shapeblend_cli.svg.effects.tiles import Draw

MADE = " "
"""Name of an attribute that no file can have: of elements that are made here."""

MOST_SEGMENTS = 100_000
"""Maximum number of segments of the elements that filters of a file show, counted again wherever they are shown."""

FIT = "preserveAspectRatio"


class Shown(NamedTuple):
    """What ``feImage`` needs to know of its filter."""

    region: Box  # of the filter, in the coordinates of its element
    ids: Mapping[str, Node]
    draw: Draw
    is_inner: bool  # whether the filter is in something that is drawn elsewhere

    def step(self, node: Node, units: Units) -> Step | None:
        """Return a step that shows a picture, or an element of the file; None if it cannot be shown."""
        box = self._box(node, units)
        link = node.link().strip()
        if box is None or not link:
            return None
        region = units.region(box)
        if not link.startswith("#"):
            (picture,) = self._drawn(_image(node), units) or (None,)
            if not isinstance(picture, Picture):
                return None
            fit = (node.get(FIT) or "").strip()
            return Step("feImage", words=((FIT, fit),) if fit else (), region=region, image=picture.raster)
        if self.is_inner:
            return None  # else few elements could show each other very often
        target = self.ids.get(link[1:])
        # As Chromium has it, the element is moved to the corner of the step, and one that is not there is empty.
        matrix = units.matrix @ translation(box.x, box.y)
        shapes = () if target is None else self.draw(target, matrix, units.lengths)
        if shapes is None or any(shape.has_pictures for shape in shapes):
            return None
        return Step("feImage", words=((FIT, "none"),), region=region, image=View(content_of(shapes), region))

    def _drawn(self, node: Node, units: Units) -> tuple[object] | None:
        """Return what an element is filled with."""
        shapes = self.draw(node, units.matrix, units.lengths)
        return (shapes[0].style.fill_gradient,) if shapes else None

    def _box(self, node: Node, units: Units) -> Box | None:
        """Return the box of a step in the coordinates of its element; what is not given is that of the filter."""
        given = [node.get(name) for name in ("x", "y", "width", "height")]
        if units.box is None:
            ways = units.lengths.x, units.lengths.y, units.lengths.x, units.lengths.y
            sides = [way(text or "") for way, text in zip(ways, given, strict=True)]
        else:
            own, wholes = units.box, (units.box.width, units.box.height) * 2
            shares = [length(text or "", whole=1.0) for text in given]
            corner = (own.x, own.y, 0.0, 0.0)
            sides = [
                None if share is None else start + share * whole
                for share, start, whole in zip(shares, corner, wholes, strict=True)
            ]
        box = Box(
            *(default if side is None else side for side, default in zip(sides, self.region, strict=True))
        )
        return box if box.width > 0.0 and box.height > 0.0 else None


def segments_in(steps: Sequence[Step]) -> int:
    """Return the number of segments of what steps show."""
    views = [step.image for step in steps if isinstance(step.image, View)]
    return sum(
        len(path.segments) for view in views for shape in view.content.shapes for path in shape.contours
    )


def _image(node: Node) -> Node:
    """Return an ``image`` for the picture of an element; it is put into that, so that it is a part of the file."""
    for child in node.children:
        if MADE in child.attrib:
            return child
    made = {MADE: "", "href": node.link(), "width": "1", "height": "1", "visibility": "visible"}
    node.children.append(Node("image", made, node.line))
    return node.children[-1]
