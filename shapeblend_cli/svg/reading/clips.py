"""Clip paths: the region of an element, or of a group, outside of which nothing is painted."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.geometry import cubics
from shapeblend_cli.model import Box, Clip, Contour
from shapeblend_cli.svg.reading import contours, viewports
from shapeblend_cli.svg.reading.elements import contours_of
from shapeblend_cli.svg.reading.path_commands import MAX_SEGMENTS
from shapeblend_cli.svg.xml.messages import Notes, check_limit
from shapeblend_cli.svg.xml.transforms import IDENTITY, Affine, is_sound, parse, translation
from shapeblend_cli.svg.xml.xmltree import SHAPES, Node, named

if TYPE_CHECKING:
    from shapeblend_cli.svg.styles.cascade import Cascade
    from shapeblend_cli.svg.styles.declarations import Declarations
    from shapeblend_cli.svg.xml.units import Lengths

SLACK = 1e-6
"""Tolerance of a shape that reaches out of its clip, as a share of the diagonal of the clip."""

NOT_APPLIED = "clip-path not applied"


class Clips:
    """The clip paths of a document, whose nodes it knows by their ids."""

    def __init__(self, ids: dict[str, Node], cascade: Cascade, notes: Notes, lenient: bool) -> None:
        self._ids = ids
        self._cascade = cascade
        self._notes = notes
        self._lenient = lenient
        self._known: dict[tuple[int, Affine], Clip | None] = {}
        self._segments = 0

    def find(self, value: str, matrix: Affine, lengths: Lengths, box: Box | None) -> Clip | None:
        """Return the region that a value of ``clip-path`` names, in the root's coordinates; None without one.

        The `matrix` maps the coordinates of the clipped element to the root's; the `box` is around it, unless it is a
        group.
        """
        node = self._ids.get(named(value))
        if node is None or node.tag != "clipPath" or "clip-path" in self._cascade.declared(node):
            self._notes.add(NOT_APPLIED)
            return None
        if (node.get("clipPathUnits") or "").strip() == "objectBoundingBox":
            if box is None:
                self._notes.add(NOT_APPLIED)
                return None
            matrix = matrix @ Affine(box.width, 0.0, 0.0, box.height, box.x, box.y)
        key = id(node), matrix
        if key not in self._known:
            self._known[key] = self._read(node, matrix, lengths)
        return self._known[key]

    def _read(self, node: Node, matrix: Affine, lengths: Lengths) -> Clip | None:
        matrix = matrix @ (parse(node.get("transform") or "none") or IDENTITY)
        outer = self._cascade.declared(node)
        found: list[Contour] = []
        rules = []
        for child in node.children:
            declared = self._cascade.declared(child)
            inner = matrix @ (parse(child.get("transform") or "none") or IDENTITY)
            if child.tag == "use":
                inner = inner @ translation(*viewports.offset(child, lengths))
                used = self._ids.get(child.link().strip().removeprefix("#"))
                child = used if used is not None else child
                declared = {**declared, **self._cascade.declared(child)}
                inner = inner @ (parse(child.get("transform") or "none") or IDENTITY)
            if child.tag in ("title", "desc") or _is_hidden(declared):
                continue
            if child.tag not in SHAPES:
                self._notes.add(f"{child.tag} in a clip-path left out")
                continue
            if not is_sound(inner):
                continue
            for contour in contours_of(child, declared, lengths, self._notes, self._lenient):
                self._segments += len(contour.segments)
                check_limit(self._segments, MAX_SEGMENTS, "segments of clip paths")
                found.append(_closed(contours.transform(contour, inner)))
            rules.append(declared.get("clip-rule") or outer.get("clip-rule") or "nonzero")
        if not found:
            self._notes.add(NOT_APPLIED)
            return None
        return Clip(tuple(found), "evenodd" if rules[0].strip() == "evenodd" else "nonzero")


def _is_hidden(declared: Declarations) -> bool:
    return declared.get("display", "").strip() == "none" or declared.get("visibility", "").strip() == "hidden"


def _closed(contour: Contour) -> Contour:
    """Return a contour that ends where it began, as filling closes it."""
    start, end = contour.segments[0, 0], contour.segments[-1, 3]
    if contour.closed:
        return contour
    line = np.array([contours.line(complex(end), complex(start))])
    return Contour(np.concatenate([contour.segments, line]), np.append(contour.straight, True), True)


def covers(clip: Clip, painted: Box) -> bool:
    """Return whether a region is an upright rectangle around all that a shape paints, so that it clips nothing."""
    if len(clip.paths) != 1:
        return False
    (path,) = clip.paths
    nodes = path.segments[:, 0]
    steps = np.diff(np.append(nodes, nodes[0]))
    is_upright = bool(
        (np.minimum(np.abs(steps.real), np.abs(steps.imag)) <= SLACK * np.abs(steps).max()).all()
    )
    box = cubics.bounds(path.segments)
    return (
        is_upright
        and len(nodes) == 4
        and bool(path.straight.all())
        and box.contains(painted, SLACK * box.diagonal)
    )
