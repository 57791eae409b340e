"""Clip paths and masks: the region of an element, or of a group, outside of which nothing is painted.

A mask is such a region if its shapes are opaque: what design programs write where somebody "uses a shape as a mask".
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.geometry import cubics
from shapeblend_cli.geometry.crossings import path_crossings
from shapeblend_cli.geometry.grouping import overlaps
from shapeblend_cli.geometry.polygons import (
    is_rectangle,
    rectangle,
    reverse_contour,
    signed_area,
    winding_numbers,
)
from shapeblend_cli.model import MOST_CONTOURS, Box, Clip, Contour
from shapeblend_cli.svg.reading import contours, viewports
from shapeblend_cli.svg.reading.elements import contours_of
from shapeblend_cli.svg.reading.path_commands import MAX_SEGMENTS
from shapeblend_cli.svg.styles.cascade import in_force
from shapeblend_cli.svg.styles.declarations import substitute
from shapeblend_cli.svg.styles.values import share
from shapeblend_cli.svg.xml.messages import Notes, check_limit
from shapeblend_cli.svg.xml.transforms import Affine, is_sound, onto, transform_of, translation
from shapeblend_cli.svg.xml.units import length
from shapeblend_cli.svg.xml.xmltree import SHAPES, Node, Tree, named

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from shapeblend_cli.model import ComplexArray
    from shapeblend_cli.svg.styles.cascade import Cascade, Inherited
    from shapeblend_cli.svg.styles.declarations import Declarations
    from shapeblend_cli.svg.xml.units import Lengths

SLACK = 1e-6
"""Tolerance of a shape that reaches out of its clip, as a share of the diagonal of the clip."""

REGIONS = frozenset(("clip-path", "mask"))
"""Properties that confine what an element paints to a region."""

NOT_APPLIED = "clip-path not applied"
NO_MASK = "mask not applied"

MOST_GROUPS = 16
"""Maximum depth of groups in a mask, and of clip paths that are clipped themselves."""

CROSSING = "rule of a shape that crosses itself, one of several in a clip-path or a mask, not applied"

RING_POINTS = 4
"""Number of points of a segment by which areas are measured, and what is around what."""

PLACES = 5
"""Number of places on a contour where what is around it is looked for."""

WHITE, BLACK = "#ffffff", "#000000"


class _SoftMaskError(Exception):
    """A mask that is no region: something in it is half transparent, grey, a picture or text."""


class _Part(NamedTuple):
    """A shape in a region."""

    contours: list[Contour]
    rule: str
    colour: str = BLACK


class _Element(NamedTuple):
    """An element of a region, with the map of its coordinates to the root's.

    `clips` are the values of ``clip-path`` that it has, and those that what uses it has, with such a map each.
    """

    node: Node
    declared: Declarations
    inherited: Inherited
    matrix: Affine
    clips: tuple[tuple[str, Affine], ...] = ()


class Clips:
    """The clip paths of a document, whose nodes it knows by their ids."""

    def __init__(
        self, tree: Tree, ids: dict[str, Node], cascade: Cascade, notes: Notes, lenient: bool
    ) -> None:
        self._tree = tree
        self._ids = ids
        self._cascade = cascade
        self._notes = notes
        self._lenient = lenient
        self._known: dict[tuple[int, Affine], tuple[Clip, ...]] = {}
        self._soft: set[int] = set()
        self._segments = 0

    def of(
        self, declared: Declarations, matrix: Affine, lengths: Lengths, box: Callable[[], Box | None]
    ) -> tuple[list[Clip], Node | None] | None:
        """Return the regions of an element outside of which it is not painted, in the root's coordinates.

        The `matrix` maps its coordinates to the root's; `box` finds the box around it, unless it is a group. A mask
        that is no region is returned as it is. A clip path without a region leaves nothing to paint: None.
        """
        wanted = [name for name in ("clip-path", "mask") if declared.get(name, "none").strip() != "none"]
        around = box() if wanted else None
        clips: list[Clip] = []
        soft = None
        if "clip-path" in wanted:
            region = self._clip(declared["clip-path"], matrix, lengths, around)
            if region is None:
                return None
            clips += region
        if "mask" in wanted:
            node = self._ids.get(named(declared["mask"]))
            if node is None or node.tag != "mask":
                return [*clips, *self._none(NO_MASK)], None
            regions = self._mask(node, matrix, lengths, around)
            soft = node if regions is None else None
            clips += regions or ()
        return clips, soft

    def _clip(
        self, value: str, matrix: Affine, lengths: Lengths, box: Box | None, depth: int = 0
    ) -> tuple[Clip, ...] | None:
        """Return the regions that a value of ``clip-path`` names, () if it names none; None if they have no inside."""
        node = self._ids.get(named(value))
        if node is None or node.tag != "clipPath" or depth >= MOST_GROUPS:
            return self._none(NOT_APPLIED)
        around = self._cascade.declared(node).get("clip-path", "none").strip()
        outer = () if around == "none" else self._clip(around, matrix, lengths, box, depth + 1)
        inner = _in_units(node.get("clipPathUnits"), matrix, box)
        if inner is None:
            return self._none(NOT_APPLIED)
        key = id(node), inner
        if key not in self._known:
            self._known[key] = self._read(node, inner, lengths, depth)
        own = self._known[key]
        return (*own, *outer) if own and outer is not None else None

    def _mask(self, node: Node, matrix: Affine, lengths: Lengths, box: Box | None) -> tuple[Clip, ...] | None:
        """Return the regions that together are what a mask shows; None if it is no region."""
        if not REGIONS.isdisjoint(self._cascade.declared(node)) or id(node) in self._soft:
            return None
        inner = _in_units(node.get("maskContentUnits"), matrix, box)
        if inner is None:
            return None
        key = id(node), inner
        if key not in self._known:
            before = self._segments
            try:
                self._known[key] = self._shown(node, inner, lengths)
            except _SoftMaskError:
                self._soft.add(id(node))  # not to be read again for each shape behind it
                self._segments = before
                return None
        return *self._known[key], *_frame(node, matrix, lengths, box)

    def _none(self, note: str) -> tuple[Clip, ...]:
        self._notes.add(note)
        return ()

    def _shown(self, node: Node, matrix: Affine, lengths: Lengths) -> tuple[Clip, ...]:
        """Return what a mask shows: the inside of its shapes, or of white ones, and the outside of each black one."""
        declared = self._cascade.declared(node)
        inherited = in_force(self._cascade, (node,), self._notes.add, self._around(node))
        painted = list(self._painted(node, inherited, matrix, lengths))
        shown, hidden = painted, list[_Part]()
        if declared.get("mask-type", "luminance").strip() != "alpha":
            shown = [each for each in painted if each.colour == WHITE]
            hidden = painted[len(shown) :]
            # What is white above something black would show again.
            if [each.colour for each in painted] != [WHITE] * len(shown) + [BLACK] * len(hidden):
                raise _SoftMaskError
        if not any(each.contours for each in shown):
            raise _SoftMaskError
        around = Box.union([cubics.bounds(c.segments) for each in painted for c in each.contours])
        width, height = around.width, around.height
        wide = Box(around.x - width, around.y - height, 3.0 * width, 3.0 * height)
        outside = (Clip((rectangle(wide), *self._outline(each)), "evenodd") for each in hidden)
        return self._united(shown), *outside

    def _painted(
        self, node: Node, around: Inherited, matrix: Affine, lengths: Lengths, depth: int = 0
    ) -> Iterator[_Part]:
        """Yield the shapes below an element of a mask, in the root's coordinates."""
        for each in node.children:
            child, declared, inherited, inner, _ = self._placed(each, around, matrix, lengths)
            if child.tag in ("title", "desc", "defs", "style") or _is_hidden(declared, inherited):
                continue
            opacity = share(declared.get("opacity", "1"))
            if opacity != 1.0 or any(
                declared.get(name, "none") != "none" for name in ("mask", "clip-path", "filter")
            ):
                raise _SoftMaskError
            if child.tag == "g" and child is each and depth < MOST_GROUPS:
                yield from self._painted(child, inherited, inner, lengths, depth + 1)
                continue
            fill, colour = inherited.fill, inherited.fill.colour
            colour = inherited.color if fill.kind == "current" else colour
            is_opaque = colour is not None and colour.alpha * inherited.fill_opacity >= 1.0
            if (
                child.tag not in SHAPES
                or inherited.stroke.kind != "none"
                or not is_opaque
                or not is_sound(inner)
            ):
                raise _SoftMaskError
            assert colour is not None  # as it is opaque
            yield _Part(self._closed_in(child, declared, inner, lengths), inherited.fill_rule, colour.rgb)

    def _around(self, node: Node) -> Inherited:
        """Return what the elements around a region hand on to it, where it is defined."""
        # The walk tells what cannot be read there.
        return in_force(self._cascade, self._tree.around(node), lambda phrase: None)

    def _placed(self, child: Node, around: Inherited, matrix: Affine, lengths: Lengths) -> _Element:
        """Return an element of a region, or what it uses."""
        found = self._styled(child, _Element(child, {}, around, matrix), lengths)
        if child.tag == "use":
            shift = translation(*viewports.offset(child, lengths))
            used = self._ids.get(child.link().strip().removeprefix("#"), child)
            found = found._replace(matrix=found.matrix @ shift)
            found = self._styled(used, found, lengths) if used is not child else found
        return found

    def _styled(self, node: Node, around: _Element, lengths: Lengths) -> _Element:
        """Return an element of a region, given what is around it; what it uses has declarations of both."""
        inherited = in_force(self._cascade, (node,), self._notes.add, around.inherited)
        declared = substitute(self._cascade.declared(node), inherited.variables)
        matrix = around.matrix @ transform_of(node, declared, lengths, self._notes)
        clips = around.clips
        if declared.get("clip-path", "none").strip() != "none":
            clips = (*clips, (declared["clip-path"], matrix))
        return _Element(node, {**around.declared, **declared}, inherited, matrix, clips)

    def _closed_in(
        self, child: Node, declared: Declarations, matrix: Affine, lengths: Lengths
    ) -> list[Contour]:
        """Return the contours of a shape in a region, closed, in the root's coordinates."""
        found = contours.with_length(contours_of(child, declared, lengths, self._notes, self._lenient))
        self._segments += sum(len(contour.segments) for contour in found)
        check_limit(self._segments, MAX_SEGMENTS, "segments of clip paths")
        return [_closed(contours.transform(contour, matrix)) for contour in found]

    def _read(self, node: Node, matrix: Affine, lengths: Lengths, depth: int) -> tuple[Clip, ...]:
        """Return the regions that together are that of a clip path; nothing if it has no inside."""
        around = self._styled(node, _Element(node, {}, self._around(node), matrix), lengths)
        found: list[_Part] = []
        clipped: list[tuple[str, Affine]] = []
        for each in node.children:
            child, declared, inherited, inner, clips = self._placed(
                each, around.inherited, around.matrix, lengths
            )
            if child.tag in ("title", "desc") or _is_hidden(declared, inherited):
                continue
            if child.tag not in SHAPES:
                self._notes.add(f"{child.tag} in a clip-path left out")
                continue
            if not is_sound(inner):
                continue
            own = self._closed_in(child, declared, inner, lengths)
            if own:
                found.append(_Part(own, inherited.clip_rule))
                clipped += clips
        if not found:
            return ()
        outer: tuple[Clip, ...] = ()
        if clipped and len(found) > 1:
            # Each shape would need a region of its own, and the union of these another one.
            self._notes.add(NOT_APPLIED)
            clipped = []
        for value, inner in clipped:
            regions = self._clip(value, inner, lengths, None, depth + 1)
            if regions is None:
                return ()
            outer += regions
        return self._united(found), *outer

    def _united(self, parts: Sequence[_Part]) -> Clip:
        """Return the region of several shapes: what is inside at least one of them by its own rule.

        A region has one path with one rule, which blends as a shape does. If all contours run round what is inside in
        one sense, winding numbers only add up, and ``nonzero`` is the rule of the union.
        """
        parts = [part for part in parts if part.contours]
        every = tuple(contour for part in parts for contour in part.contours)
        if len({part.rule for part in parts}) == 1 and not _overlap(parts):
            return Clip(every, parts[0].rule)
        found = [edge for part in parts for edge in self._edges(part)]
        if not found:
            return Clip(every)
        # As most of them run already: shapes that all run one way stay as they are.
        sense = 1 if sum(each for _, each in found) >= 0 else -1
        return Clip(tuple(contour if each == sense else reverse_contour(contour) for contour, each in found))

    def _outline(self, part: _Part) -> list[Contour]:
        """Return the contours of a shape for the rule ``evenodd``."""
        return part.contours if part.rule == "evenodd" else [contour for contour, _ in self._edges(part)]

    def _edges(self, part: _Part) -> list[tuple[Contour, int]]:
        """Return the contours that part the inside of a shape from its outside.

        Each has 1 if it runs from x towards y around what is inside, or the other way around a hole, else -1.
        """
        rings = [cubics.polyline(contour.segments, RING_POINTS) for contour in part.contours]
        areas = [signed_area(ring) for ring in rings]
        ways = [1 if area >= 0.0 else -1 for area in areas]
        if path_crossings(part.contours, most=1):
            runs_one_way = len({*ways}) == 1 and not any(path_crossings([c], 1) for c in part.contours)
            if part.rule != "nonzero" or not runs_one_way:
                self._notes.add(CROSSING)
            return [(contour, 1 if sum(areas) >= 0.0 else -1) for contour in part.contours]
        found = []
        for contour, way, outside in zip(part.contours, ways, _windings_around(rings), strict=True):
            numbers = outside, outside + way
            was_in, is_in = (number % 2 != 0 if part.rule == "evenodd" else number != 0 for number in numbers)
            if is_in != was_in:
                found.append((contour, way if is_in else -way))
        return found


def _frame(node: Node, matrix: Affine, lengths: Lengths, box: Box | None) -> tuple[Clip, ...]:
    """Return the rectangle beyond which a mask shows nothing; nothing if that is not known."""
    given = [node.get(name) for name in ("x", "y", "width", "height")]
    if (node.get("maskUnits") or "").strip() == "userSpaceOnUse":
        read = lengths.x, lengths.y, lengths.x, lengths.y
        sides = [by(text or "") for by, text in zip(read, given, strict=True)]
    elif box is not None:
        sides = [
            length(text or default, whole=1.0)
            for text, default in zip(given, ("-10%", "-10%", "120%", "120%"), strict=True)
        ]
        matrix = matrix @ onto(box)
    else:
        return ()
    x, y, width, height = (0.0 if side is None else side for side in sides)
    if width <= 0.0 or height <= 0.0:
        return ()
    return (Clip((contours.transform(rectangle(Box(x, y, width, height)), matrix),)),)


def _in_units(units: str | None, matrix: Affine, box: Box | None) -> Affine | None:
    """Return the map from a region's own units to the root's; None if they are of a box that is not known."""
    if (units or "").strip() != "objectBoundingBox":
        return matrix
    return None if box is None else matrix @ onto(box)


def _overlap(parts: Sequence[_Part]) -> bool:
    """Return whether the boxes of any shapes overlap, or there are too many to compare."""
    if len(parts) == 1 or len(parts) > MOST_CONTOURS:
        return len(parts) > 1
    boxes = [cubics.bounds(np.concatenate([each.segments for each in part.contours])) for part in parts]
    return bool(np.triu(overlaps(boxes), 1).any())


def _windings_around(rings: Sequence[ComplexArray]) -> list[int]:
    """Return the winding number of the other rings around each, given that none of them crosses it."""
    # Where rings touch, what is around one is uncertain: most places decide.
    shares = np.linspace(0.0, 1.0, PLACES, endpoint=False)
    points = np.array([ring[(shares * len(ring)).astype(int)] for ring in rings])
    around = np.zeros(points.shape, int)
    for k, ring in enumerate(rings):
        numbers = winding_numbers(points.ravel(), ring).reshape(points.shape)
        numbers[k] = 0
        around += numbers
    return [int(number) for number in np.median(around, axis=1)]


def _is_hidden(declared: Declarations, inherited: Inherited) -> bool:
    return declared.get("display", "").strip() == "none" or inherited.visibility != "visible"


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
    box = cubics.bounds(path.segments)
    return is_rectangle(path) and box.contains(painted, SLACK * box.diagonal)
