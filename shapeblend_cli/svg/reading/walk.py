"""The walk over a document: from the root to every shape it paints, in paint order."""

from __future__ import annotations

import math
from collections import Counter
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.model import Shape
from shapeblend_cli.svg.reading import contours, transforms, viewports
from shapeblend_cli.svg.reading.cascade import INITIAL, Inherited, inherit, share
from shapeblend_cli.svg.reading.declarations import Cascade, Declarations, resolved
from shapeblend_cli.svg.reading.elements import GROUPS, LEFT_OUT, POINT_LISTS, SHAPES
from shapeblend_cli.svg.reading.notes import Notes
from shapeblend_cli.svg.reading.painter import Painter
from shapeblend_cli.svg.reading.path_data import MAX_SEGMENTS
from shapeblend_cli.svg.reading.problem import Problem, shown
from shapeblend_cli.svg.reading.select import around, chosen, unpainted
from shapeblend_cli.svg.reading.shapes import outline
from shapeblend_cli.svg.reading.units import LIMIT

if TYPE_CHECKING:
    from shapeblend_cli.model import Contour
    from shapeblend_cli.svg.reading.xmltree import Node

_EFFECTS = {
    "clip-path": "not applied",
    "mask": "not applied",
    "filter": "not applied",
    "marker-start": "not drawn",
    "marker-mid": "not drawn",
    "marker-end": "not drawn",
}
# CSS properties that come before `transform`, in this order.
_SINGLE_TRANSFORMS = ("translate", "rotate", "scale")
_TRANSFORMS = frozenset(("transform", *_SINGLE_TRANSFORMS))

MAX_USE_DEPTH = 16
MAX_USED = 10_000
MAX_VARIABLES = 1000
_MAX_ID = 1000
_MAX_NAMES = 3


class _Place(NamedTuple):
    """An element on the way down, and what the elements around it hand on to it.

    `used` are the elements that the open ``use`` elements refer to, `use_id` is the id of the innermost;
    `given` is the size that a ``use`` gives to the viewport it refers to. `chosen` tells whether one of the elements
    on the way is among those that were asked for.
    """

    node: Node
    matrix: transforms.Matrix
    inherited: Inherited
    opacity: float
    viewport: viewports.Size
    used: tuple[Node, ...] = ()
    use_id: str | None = None
    given: tuple[str | None, str | None] = (None, None)
    chosen: bool = True


class Walk:
    """One walk with an explicit stack: a hostile file must not reach Python's recursion limit.

    Parameters
    ----------
    root : Node
        An ``svg`` element.
    notes : Notes
        Takes phrases on what is left out.
    lenient : bool
        Draw broken path data and points up to the error.
    """

    def __init__(self, root: Node, notes: Notes, lenient: bool = False) -> None:
        self._root = root
        self._notes = notes
        self._lenient = lenient
        self._cascade = Cascade(root)
        self._ids: dict[str, Node] = {}
        for node in root.walk():
            name = node.get("id")
            if name:
                self._ids.setdefault(name, node)
        self._painter = Painter(self._ids, self._cascade, notes)
        self._stack: list[_Place] = []
        self._shapes: list[Shape] = []
        self._skipped: Counter[str] = Counter()
        self._visits_by_use = 0
        self._segments = 0
        self._used_outlines: dict[int, list[Contour]] = {}
        self._painted = 0
        self._chosen: set[int] = set()
        self._around: set[int] = set()
        self._reason: str | None = None
        self._other_names: dict[str, None] = {}

    def shapes(self, viewport: viewports.Size, select: str | None = None) -> tuple[Shape, ...]:
        """Return the shapes that are painted.

        Parameters
        ----------
        viewport : pair of float
            What percentages refer to at the root.
        select : str, optional
            A selector. Only shapes that it matches, that stand in elements it matches, or that are drawn through a
            ``use`` of which one of the two is true are returned; their numbers are those among all of them.

        Raises
        ------
        Problem
            If there is none, or a limit is exceeded.
        """
        nodes = [] if select is None else chosen(self._root, select)
        self._chosen = {id(node) for node in nodes}
        self._around = {id(node) for node in around(self._root, nodes[0])} if nodes else set()
        first = _Place(self._root, transforms.IDENTITY, INITIAL, 1.0, viewport, chosen=select is None)
        self._stack = [first]
        while self._stack:
            self._visit(self._stack.pop())
        if not self._painted:
            found = self._what_was_found()
            raise Problem(f"no painted shape: {found}; a file with a filled or stroked path would work")
        if select is not None and not self._shapes:
            raise unpainted(self._root, select, nodes, self._reason, list(self._other_names))
        return tuple(self._shapes)

    def _visit(self, place: _Place) -> None:
        node = place.node
        if id(node) in self._chosen:
            place = place._replace(chosen=True)
        if place.used:
            self._visits_by_use += 1
            if self._visits_by_use > MAX_USED:
                raise Problem(f"more than {MAX_USED} elements drawn through use, the most that are read")
        if node.tag in LEFT_OUT:
            self._notes.add(f"{node.tag} left out")
        is_used_symbol = node.tag == "symbol" and place.used[-1:] == (node,)
        if not (node.tag in SHAPES or node.tag in GROUPS or is_used_symbol) or not _is_for_us(node):
            return
        declared = self._cascade.declared(node, keep=bool(place.used))
        if declared:
            place, declared = self._entered(place, declared)
        if declared.get("display", "").strip().lower() == "none":
            self._skip(place, "not displayed")
        elif place.opacity == 0:
            # Icon sets put a frame of opacity 0 around every drawing.
            self._skip(place, "of opacity 0")
        elif transforms.determinant(place.matrix) == 0:
            self._skip(place, "without extent")
        elif node.tag in SHAPES:
            self._draw(place, declared)
        elif node.tag == "use":
            self._use(place)
        else:
            self._descend(place)

    def _entered(self, place: _Place, declared: Declarations) -> tuple[_Place, Declarations]:
        """Return `place` with the element's own style and transform, and what is declared for it."""
        inherited = place.inherited
        own = {name: value for name, value in declared.items() if name.startswith("--")}
        if own:
            inherited = inherited._replace(variables={**inherited.variables, **own})
            if len(inherited.variables) > MAX_VARIABLES:
                raise Problem(f"more than {MAX_VARIABLES} custom properties, the most that are read")
        if any("var(" in value for value in declared.values()):
            declared = resolved(declared, inherited.variables)
        inherited = inherit(inherited, declared, self._notes.add)
        opacity = place.opacity
        if "opacity" in declared:
            own_opacity = share(declared["opacity"])
            opacity *= 1.0 if own_opacity is None else own_opacity
        for effect, phrase in _EFFECTS.items():
            if declared.get(effect, "none") != "none":
                self._notes.add(f"{effect} {phrase}")
        matrix = place.matrix
        if place.node is not self._root and not _TRANSFORMS.isdisjoint(declared):
            own_matrix = self._transform(place.node, declared, place.viewport, inherited.font_size)
            matrix = _product(matrix, own_matrix, place.node)
        return place._replace(inherited=inherited, opacity=opacity, matrix=matrix), declared

    def _transform(
        self, node: Node, declared: Declarations, viewport: viewports.Size, font_size: float
    ) -> transforms.Matrix:
        """Return the element's own transform, the attribute or the CSS properties."""
        text = declared.get("transform", "none")
        # The two have different grammars; a property that wins is not the attribute's string.
        is_attribute = text is node.get("transform")
        matrix = transforms.parse(text, None if is_attribute else viewport)
        steps = [f"{name}({declared[name]})" for name in _SINGLE_TRANSFORMS if name in declared]
        first = transforms.parse(" ".join(steps), viewport)
        if matrix is None or first is None:
            self._notes.add("a transform that cannot be read not applied")
            return transforms.IDENTITY
        matrix = transforms.multiply(first, matrix)
        origin = declared.get("transform-origin")
        if origin is None:
            return matrix
        if declared.get("transform-box", "view-box") not in ("view-box", "border-box"):
            self._notes.add("transform-box read as view-box")
        return transforms.about(matrix, *transforms.origin(origin, viewport, font_size))

    def _descend(self, place: _Place) -> None:
        node = place.node
        if node.tag in ("svg", "symbol") and node is not self._root:
            font_size = place.inherited.font_size
            inner = viewports.nested(node, place.given, place.viewport, font_size, self._notes)
            if inner is None:
                return
            matrix, viewport = inner
            place = place._replace(matrix=_product(place.matrix, matrix, node), viewport=viewport)
        children = node.children
        if node.tag == "switch":
            children = [child for child in children if ":" not in child.tag and _is_for_us(child)][:1]
        place = place._replace(given=(None, None))
        self._stack.extend(place._replace(node=child) for child in reversed(children))

    def _use(self, place: _Place) -> None:
        node = place.node
        link = node.link().strip()
        target = self._ids.get(link[1:]) if link.startswith("#") else None
        if target is None:
            self._notes.add(f"use of '{shown(link)}', which is not in the file, left out")
            return
        if target in place.used or target is node:
            self._notes.add(f"use of '{shown(link)}' inside itself left out")
            return
        if len(place.used) >= MAX_USE_DEPTH:
            raise Problem(f"{node}: use nested deeper than {MAX_USE_DEPTH}, the deepest that is read")
        move = transforms.translation(*viewports.offset(node, place.viewport, place.inherited.font_size))
        self._stack.append(
            place._replace(
                node=target,
                matrix=_product(place.matrix, move, node),
                used=(*place.used, target),
                use_id=node.get("id") or place.use_id,
                given=(node.get("width"), node.get("height")),
            )
        )

    def _draw(self, place: _Place, declared: Declarations) -> None:
        """Add a shape, if it is painted and has an extent."""
        node = place.node
        if place.inherited.visibility != "visible":
            self._skip(place, "hidden")
            return
        scale = math.sqrt(abs(transforms.determinant(place.matrix)))
        if declared.get("vector-effect") == "non-scaling-stroke":
            scale = 1.0
        style = self._painter.style(place.inherited, place.opacity, scale, place.viewport)
        if style.fill is None and style.stroke is None:
            self._skip(place, "with neither fill nor stroke")
            return
        outlines = self._outline(place, declared)
        if not outlines:
            self._skip(place, "without extent")
            return
        self._segments += sum(len(contour.segments) for contour in outlines)
        if self._segments > MAX_SEGMENTS:
            raise Problem(f"more than {MAX_SEGMENTS} segments, the most that are read")
        index = self._painted
        self._painted += 1
        name = _clean(node.get("id") or place.use_id)
        if not place.chosen:
            if name and len(self._other_names) < _MAX_NAMES:
                self._other_names[name] = None
            return
        placed = tuple(contours.transformed(contour, place.matrix) for contour in outlines)
        if not all(np.abs(contour.segments).max() < LIMIT for contour in placed):
            raise Problem(f"{node}: coordinates beyond {LIMIT:g}; smaller ones would work")
        style = self._painter.with_gradients(style, place.inherited, outlines, place.matrix, place.viewport)
        if style.stroke_dasharray and node.get("pathLength") is not None:
            self._notes.add("pathLength not applied to dashes")
        self._shapes.append(Shape(index, name, node.tag, placed, style))

    def _outline(self, place: _Place, declared: Declarations) -> list[Contour]:
        node = place.node
        # Only lists of points are worth remembering, and no percentage changes them.
        is_repeated = bool(place.used) and node.tag in POINT_LISTS
        if is_repeated and id(node) in self._used_outlines:
            return self._used_outlines[id(node)]
        found = outline(node, declared, place.viewport, place.inherited.font_size, self._notes, self._lenient)
        if is_repeated:
            self._used_outlines[id(node)] = found
        return found

    def _skip(self, place: _Place, reason: str) -> None:
        node = place.node
        self._skipped[reason] += node.tag in SHAPES
        if self._reason is None and self._chosen:
            if place.chosen:
                self._reason = reason
            elif id(node) in self._around:
                self._reason = f"in {node}, which is {reason}"

    def _what_was_found(self) -> str:
        found = [f"{_shapes(count)} {reason}" for reason, count in self._skipped.items() if count]
        total = sum(node.tag in SHAPES for node in self._root.walk())
        unseen = total - sum(self._skipped.values())
        if unseen > 0:
            found.append(f"{_shapes(unseen)} in defs, symbols, clip paths or groups that are not displayed")
        found += self._notes.phrases()
        return ", ".join(found) or "it has no shape elements"


def _shapes(count: int) -> str:
    return "1 shape" if count == 1 else f"{count} shapes"


def _product(outer: transforms.Matrix, inner: transforms.Matrix, node: Node) -> transforms.Matrix:
    matrix = outer if inner == transforms.IDENTITY else transforms.multiply(outer, inner)
    if not transforms.is_sound(matrix):
        raise Problem(f"{node}: transforms beyond {LIMIT:g}; smaller ones would work")
    return matrix


def _is_for_us(node: Node) -> bool:
    """Return whether a conditional element is drawn.

    https://www.w3.org/TR/SVG2/struct.html#ConditionalProcessing; the language is English.
    """
    if "requiredExtensions" in node.attrib:
        return False
    languages = node.get("systemLanguage")
    return languages is None or any(
        tag.strip().lower().split("-")[0] == "en" for tag in languages[:1000].split(",")
    )


def _clean(name: str | None) -> str | None:
    """Return an id without control characters, and not too long."""
    return "".join(c for c in name[:_MAX_ID] if c.isprintable()) or None if name else None
