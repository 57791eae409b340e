"""The walk over a document: from the root to every shape it paints, in paint order."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from copy import copy
from functools import partial
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.geometry import cubics
from shapeblend_cli.geometry.polygons import rectangle
from shapeblend_cli.model import Box, Clip, Contour, Group, Name, Picture, Shape, Style
from shapeblend_cli.svg.effects.layers import DECLARED, Clipped, Drawn, Given, Layers
from shapeblend_cli.svg.reading import contours, viewports
from shapeblend_cli.svg.reading.clips import REGIONS, Clips, covers
from shapeblend_cli.svg.reading.elements import contours_of, is_for_us
from shapeblend_cli.svg.reading.painter import Painter
from shapeblend_cli.svg.reading.path_commands import MAX_SEGMENTS
from shapeblend_cli.svg.reading.titles import clean, group_of, name_of, numbered
from shapeblend_cli.svg.styles.cascade import INITIAL, Cascade, Inherited, in_force, inherit, with_variables
from shapeblend_cli.svg.styles.declarations import Declarations, substitute
from shapeblend_cli.svg.styles.selection import no_shape, paints_nothing, select, shape_numbers
from shapeblend_cli.svg.styles.values import share
from shapeblend_cli.svg.xml.messages import Notes, Problem, check_limit, printable
from shapeblend_cli.svg.xml.transforms import IDENTITY, Affine, is_sound, parse, transform_of, translation
from shapeblend_cli.svg.xml.units import LIMIT, Lengths
from shapeblend_cli.svg.xml.xmltree import GROUPS, LEFT_OUT, MARKED, POINT_LISTS, SHAPES, Node, Tree

if TYPE_CHECKING:
    from shapeblend_cli.svg.reading.images.element import Images, PlacedImage
    from shapeblend_cli.svg.reading.text import Text, Texts

CONTENTS = ("mask", "pattern")
"""Elements whose contents are drawn where they are referred to."""

MAX_GROUPS = 32  # around a shape; deeper ones are left out, and what is in them is in the one around
MAX_CONTENTS = 1000
MAX_CONTENT_DEPTH = 4
MAX_USE_DEPTH = 16
MAX_USED = 10_000
_MAX_NAMES = 3


class _Visit(NamedTuple):
    """An element, and the values that the elements around it hand on to it.

    `used` are the elements that the open ``use`` elements refer to, `use_id` is the id of the innermost; `given` is the
    size that a ``use`` gives to the viewport it refers to. `chosen` tells whether it or one around it is selected.
    `groups` are around it, the outermost first, and so are its `clips` and the numbers of its `effects`.
    """

    node: Node
    matrix: Affine
    inherited: Inherited
    opacity: float
    lengths: Lengths
    used: tuple[Node, ...] = ()
    use_id: str | None = None
    given: tuple[str | None, str | None] = (None, None)
    chosen: bool = True
    groups: tuple[Group, ...] = ()
    clips: tuple[Clipped, ...] = ()
    effects: tuple[int, ...] = ()

    def transformed(self, inner: Affine) -> _Visit:
        """Return the visit with a transform of its element applied."""
        matrix = self.matrix if inner == IDENTITY else self.matrix @ inner
        if not is_sound(matrix):
            raise Problem(f"{self.node}: transforms beyond {LIMIT:g}; smaller ones would work")
        return self._replace(matrix=matrix)


class Walk:
    """One walk from an ``svg`` element, with an explicit stack: a hostile file must not reach the recursion limit.

    `lenient` draws broken path data and points up to the error; `notes` takes phrases on elements that are left
    out; a drawing that `is_to_blend` is refused if it is too large for that; `text` is outlined or skipped;
    `images` says which pictures are taken, as `--images` does, and the folder of the file.
    """

    def __init__(
        self,
        root: Node,
        notes: Notes,
        lenient: bool = False,
        is_to_blend: bool = False,
        text: str = "outline",
        images: tuple[str, str | None] = ("embedded", None),
    ) -> None:
        self._root = root
        self._tree = Tree(root)
        self._notes = notes
        self._lenient = lenient
        self._is_to_blend = is_to_blend
        self._drawn = 0  # contours
        self._groups = 0
        self._cascade = Cascade(self._tree)
        if self._cascade.has_schemes:
            notes.add("prefers-color-scheme: light taken")
        if self._cascade.is_animated:
            notes.add("read as it is without its animations")
        self._ids: dict[str, Node] = {}
        for node in root.walk():
            if name := node.get("id"):
                self._ids.setdefault(name, node)
        self._clips = Clips(self._tree, self._ids, self._cascade, notes, lenient)
        self._stack: list[_Visit] = []
        self._layers = Layers(self._ids, self._cascade, notes, self._content)
        self._painter = Painter(self._tree, self._ids, self._cascade, notes, self._content)
        self._depth = self._contents = 0  # of patterns and masks: in each other, and all
        self._known_contents: dict[tuple[int, Affine, Lengths, int], Sequence[Shape] | None] = {}
        self._shapes: list[Drawn] = []
        self._skipped: Counter[str] = Counter()
        self._visits_by_use = 0
        self._segments = self._painted = 0
        self._used_contours: dict[int, list[Contour]] = {}
        self._pixel = 1.0
        self._chosen: set[int] = set()
        self._ancestors: set[int] = set()
        self._reason: str | None = None
        self._other_names: dict[str, None] = {}
        self._text_as = text
        self._texts: Texts | None = None
        self._which_images = images
        self._images: Images | None = None

    def shapes(self, box: Box | None, selector: str | None = None) -> tuple[Shape, ...]:
        """Return the painted shapes, at least one, given the box of the root.

        With a selector, only shapes that it matches are returned, those in elements it matches, and those drawn through
        a ``use`` of which one of the two is true. Their numbers are those among all shapes.
        """
        numbers = None if selector is None else shape_numbers(selector)
        selector = selector if numbers is None else None
        nodes = [] if selector is None else select(self._root, selector, self._notes.add)
        self._chosen = {id(node) for node in nodes}
        self._ancestors = {id(node) for node in self._tree.around(nodes[0])} if nodes else set()
        self._pixel = viewports.root_pixel(self._root, box)
        lengths = viewports.root_lengths(box)
        moved = viewports.root_transform(self._root, self._cascade.declared(self._root), box, self._notes)
        root = _Visit(self._root, IDENTITY, INITIAL, 1.0, lengths, chosen=selector is None)
        self._stack = [root.transformed(moved)]
        while self._stack:
            self._process(self._stack.pop())
        if not self._painted:
            raise no_shape(self._root, self._skipped, self._notes)
        if selector is not None and not self._shapes:
            raise paints_nothing(self._root, selector, nodes, self._reason, list(self._other_names))
        shapes = self._layers.finish(self._shapes, box, covers)
        return tuple(shapes if numbers is None else numbered(shapes, numbers))

    def _process(self, visit: _Visit) -> None:
        node = visit.node
        if id(node) in self._chosen:
            visit = visit._replace(chosen=True)
        if visit.used:
            self._visits_by_use += 1
            check_limit(self._visits_by_use, MAX_USED, "elements drawn through use")
        if node.tag in LEFT_OUT:
            self._notes.leave_out(f"{node.tag} left out")
        is_used_symbol = node.tag in ("symbol", "marker", *CONTENTS) and visit.used[-1:] == (node,)
        is_drawn = node.tag in SHAPES or node.tag in GROUPS or node.tag == "image"
        is_drawn = is_drawn or (node.tag == "text" and self._has_text())
        if not (is_drawn or is_used_symbol) or not is_for_us(node):
            return
        declared = self._cascade.declared(node, keep=bool(visit.used))
        if declared:
            around = len(visit.effects)
            declared, visit = self._apply(declared, visit)
            mask = None
            if not REGIONS.isdisjoint(declared):
                box = partial(self._box, visit, declared)
                regions = self._clips.of(declared, visit.matrix, visit.lengths, box)
                if regions is None:
                    self._skip(visit, "clipped away")
                    return
                clips, mask = regions
                visit = visit._replace(clips=(*visit.clips, *(Clipped(around, clip) for clip in clips)))
            if mask is not None or not DECLARED.isdisjoint(declared):
                given = Given(declared, visit.matrix, visit.inherited, visit.lengths, len(visit.groups), mask)
                visit = visit._replace(effects=self._layers.add(given, visit.effects))
        reason = None
        if declared.get("display", "").strip().lower() == "none" and visit.node.tag != "marker":
            reason = "not displayed"
        elif visit.opacity == 0:
            # Icon sets put a frame of opacity 0 around every drawing.
            reason = "of opacity 0"
        elif visit.matrix.determinant == 0:
            reason = "without extent"
        elif node.tag in SHAPES:
            reason = self._draw(visit, declared)
        elif node.tag == "text":
            reason = self._draw_text(visit)
        elif node.tag == "image":
            reason = self._draw_image(visit, declared)
        elif node.tag == "use":
            self._use(visit)
        else:
            self._descend(visit)
        if reason:
            self._skip(visit, reason)

    def _apply(self, declared: Declarations, visit: _Visit) -> tuple[Declarations, _Visit]:
        """Return the declarations with variables substituted, and the visit with the element's style and transform."""
        inherited = with_variables(visit.inherited, declared)
        declared = substitute(declared, inherited.variables)
        inherited = inherit(inherited, declared, self._notes.add)
        lengths = visit.lengths._replace(font_size=inherited.font_size)
        own_opacity = share(declared.get("opacity", "1"))
        opacity = visit.opacity * (1.0 if own_opacity is None else own_opacity)
        if declared.get("backdrop-filter", "none") != "none":
            self._notes.add("backdrop-filter not applied")
        visit = visit._replace(inherited=inherited, opacity=opacity, lengths=lengths)
        if visit.node is not self._root:
            box = partial(self._box, visit, declared)
            moved = transform_of(visit.node, declared, lengths, self._notes, box)
            visit = visit if moved == IDENTITY else visit.transformed(moved)
        return declared, visit

    def _descend(self, visit: _Visit) -> None:
        node = visit.node
        if node.tag in ("svg", "symbol") and node is not self._root:
            inner = viewports.nested(node, visit.given, visit.lengths, self._notes)
            if inner is None:
                return
            matrix, lengths, window = inner
            if self._cascade.declared(node).get("overflow", "hidden").strip() not in ("visible", "auto"):
                clip = Clip((contours.transform(rectangle(window), visit.matrix),))
                visit = visit._replace(clips=(*visit.clips, Clipped(len(visit.effects), clip)))
            visit = visit.transformed(matrix)._replace(lengths=lengths)
        children = node.children
        if node.tag == "switch":
            children = [child for child in children if ":" not in child.tag and is_for_us(child)][:1]
        visit = visit._replace(given=(None, None))
        visit = visit if node.tag in ("marker", *CONTENTS) else self._grouped(visit)
        self._stack.extend(visit._replace(node=child) for child in reversed(children))

    def _use(self, visit: _Visit) -> None:
        node = visit.node
        link = node.link().strip()
        target = self._ids.get(link[1:]) if link.startswith("#") else None
        if target is None:
            self._notes.add(f"use of '{printable(link)}', which is not in the file, left out")
            return
        if target in visit.used or target is node:
            self._notes.add(f"use of '{printable(link)}' inside itself left out")
            return
        if len(visit.used) >= MAX_USE_DEPTH:
            raise Problem(f"{node}: use nested deeper than {MAX_USE_DEPTH}, the limit")
        shift = translation(*viewports.offset(node, visit.lengths))
        visit = self._grouped(visit)
        self._stack.append(
            visit.transformed(shift)._replace(
                node=target,
                used=(*visit.used, target),
                use_id=node.get("id") or visit.use_id,
                given=(node.get("width"), node.get("height")),
            )
        )

    def _content(self, node: Node, matrix: Affine, lengths: Lengths) -> Sequence[Shape] | None:
        """Return the shapes in a pattern or a mask, in its coordinates; None if something is left out of it."""
        key = id(node), matrix, lengths, self._depth
        if key in self._known_contents:
            return self._known_contents[key]
        check_limit(self._contents + 1, MAX_CONTENTS, "patterns and masks")
        if self._depth >= MAX_CONTENT_DEPTH:
            self._notes.add(f"patterns and masks in each other deeper than {MAX_CONTENT_DEPTH} left out")
            return None
        around = in_force(self._cascade, self._tree.around(node), self._notes.add)
        before = self._notes.left_out
        inner = copy(self)
        inner._depth, inner._contents, inner._is_to_blend = self._depth + 1, self._contents + 1, False
        inner._layers = Layers(self._ids, self._cascade, self._notes, inner._content, is_inner=True)
        inner._painter = self._painter.within(node, inner._content)
        inner._shapes, inner._stack = [], [_Visit(node, matrix, around, 1.0, lengths, used=(node,))]
        while inner._stack:
            inner._process(inner._stack.pop())
        shapes = inner._layers.finish(inner._shapes, None, covers)
        self._segments, self._contents = inner._segments, inner._contents
        self._visits_by_use, self._images = inner._visits_by_use, inner._images
        return self._known_contents.setdefault(key, None if self._notes.left_out > before else shapes)

    def _box(self, visit: _Visit, declared: Declarations) -> Box | None:
        """Return the box around a shape or a picture, in its own coordinates."""
        if visit.node.tag == "image":
            image = self._image(visit, declared)
            return image and (image.viewport or image.box)
        if visit.node.tag not in SHAPES or visit.matrix.determinant == 0:
            return None
        own = self._contours(visit, declared)
        return cubics.bounds(np.concatenate([contour.segments for contour in own])) if own else None

    def _grouped(self, visit: _Visit) -> _Visit:
        """Return the visit with its element as a group around the next ones."""
        if visit.node is self._root or len(visit.groups) >= MAX_GROUPS:
            return visit
        self._groups += 1
        return visit._replace(groups=(*visit.groups, group_of(visit.node, self._groups)))

    def _draw(self, visit: _Visit, declared: Declarations) -> str | None:
        """Add a shape, or return why it is not painted."""
        scales = declared.get("vector-effect", "").strip().lower() != "non-scaling-stroke"
        reason = self._paint(visit, lambda: self._contours(visit, declared), scales)
        if visit.node.tag in MARKED and visit.inherited.visibility == "visible":
            self._mark(visit, declared)
        return reason

    def _mark(self, visit: _Visit, declared: Declarations) -> None:
        """Let the markers of an element follow it, each as if it were used there."""
        inherited = visit.inherited
        if {inherited.marker_start, inherited.marker_mid, inherited.marker_end} == {"none"}:
            return
        from shapeblend_cli.svg.reading.markers import marks

        outlines = self._contours(visit, declared)
        found = marks(outlines, inherited, visit.lengths, self._ids, self._cascade, self._notes)
        for mark in reversed(found):
            if mark.node in visit.used or len(visit.used) >= MAX_USE_DEPTH:
                continue
            around = INITIAL._replace(context=(inherited.fill, inherited.stroke))
            around = in_force(self._cascade, self._tree.around(mark.node), self._notes.add, around)
            clips = (*visit.clips, *(Clipped(len(visit.effects), each) for each in mark.clips(visit.matrix)))
            inner = visit.transformed(mark.matrix)._replace(node=mark.node, inherited=around, clips=clips)
            self._stack.append(inner._replace(lengths=mark.lengths, used=(*visit.used, mark.node)))

    def _paint(
        self,
        visit: _Visit,
        make: Callable[[], list[Contour]],
        scales: bool = True,
        letters: str | None = None,
        whole: list[Contour] | None = None,
        picture: Picture | None = None,
    ) -> str | None:
        """Add a shape of contours in its own coordinates, or a picture; gradients of letters span the `whole` text."""
        node = visit.node
        if visit.inherited.visibility != "visible":
            return "hidden"
        scale = math.sqrt(abs(visit.matrix.determinant))
        pixel = scale if scales else self._pixel
        style = self._painter.style(visit.inherited, visit.opacity, pixel, visit.lengths)
        if picture is not None:
            style = Style(picture.raster.colour, visit.opacity, fill_gradient=picture)
        if style.stroke is not None and not scales:
            style = style._replace(pixel=self._pixel)
        if style.fill is None and style.stroke is None:
            return "with neither fill nor stroke"
        own_contours = make()
        self._segments += sum(len(contour.segments) for contour in own_contours)
        check_limit(self._segments, MAX_SEGMENTS, "segments")
        placed = contours.placed(own_contours, visit.matrix, style)
        if not placed:
            return "without extent"
        index, self._painted = self._painted, self._painted + 1
        name = clean(node.get("id") or visit.use_id)
        if not visit.chosen:
            if name and len(self._other_names) < _MAX_NAMES:
                self._other_names[name] = None
            return None
        if self._is_to_blend:
            self._drawn += len(placed)
            contours.check_size(self._drawn, placed)
        if not all(np.abs(contour.segments).max() < LIMIT for contour in placed):
            raise Problem(f"{node}: coordinates beyond {LIMIT:g}; smaller ones would work")
        if picture is None:
            span = whole or own_contours
            style = self._painter.with_gradients(style, visit.inherited, span, visit.matrix, visit.lengths)
        if style.fill is None and style.stroke is None:
            self._painted = index
            return "with neither fill nor stroke"  # but a pattern in which nothing is drawn
        if style.stroke_dasharray and node.get("pathLength") is not None:
            self._notes.add("pathLength not applied to dashes")
        called = name_of(node) if letters is None else Name(label=clean(letters))
        left = () if picture else self._painter.page_coloured(style, visit.inherited)
        drawn = tuple(placed), style, called, visit.groups
        shape = Shape(index, name, node.tag, *drawn, page_coloured=left)
        self._shapes.append(Drawn(shape, visit.effects, visit.clips))
        return None

    def _image(self, visit: _Visit, declared: Declarations) -> PlacedImage | None:
        """Return the picture of an element, if there is one."""
        if self._images is None:
            from shapeblend_cli.svg.reading.images.element import Images  # few drawings have any

            self._images = Images(self._notes, *self._which_images)
        return self._images.of(visit.node, declared, visit.lengths)

    def _draw_image(self, visit: _Visit, declared: Declarations) -> str | None:
        """Add a picture, or return why it is not painted."""
        image = self._image(visit, declared)
        if image is None:
            return "without a picture"
        clips = (Clipped(len(visit.effects), clip) for clip in image.clips(visit.matrix))
        around = visit._replace(clips=(*visit.clips, *clips))
        return self._paint(around, lambda: [image.contour], picture=image.picture(visit.matrix))

    def _has_text(self) -> bool:
        """Return whether text is drawn."""
        if self._text_as == "skip":
            self._notes.add("text skipped")
            return False
        if self._texts is None:
            from shapeblend_cli.svg.reading.text import Texts

            sheets = [node.text for node in self._root.walk() if node.tag == "style"]
            self._texts = Texts(sheets, self._notes)
        return self._texts.is_available

    def _draw_text(self, visit: _Visit) -> str | None:
        """Add a shape for each letter of a text, or return why there is none."""
        text, visits = self._text(self._grouped(visit))
        letters = self._texts.letters(text) if self._texts else []
        whole, first = [contour for letter in letters for contour in letter.contours], len(self._shapes)
        reason: str | None = "without letters"
        for letter in letters:
            # Fonts know one rule for what is inside.
            solid = visits[letter.span].inherited._replace(fill_rule="nonzero")
            here = visits[letter.span]._replace(node=visit.node, inherited=solid)
            skipped = self._paint(here, partial(list, letter.contours), letters=letter.letters, whole=whole)
            reason = skipped if reason is not None else None
        if self._text_as == "keep" and self._texts and not self._depth:
            from shapeblend_cli.svg.reading.kept import whole_text  # few runs keep text

            own = whole_text.with_whole(self._shapes[first:], text, letters, self._texts.fonts, visit.matrix)
            self._shapes[first:] = own
        return reason

    def _text(self, visit: _Visit) -> tuple[Text, list[_Visit]]:
        """Return the characters of a text, and the visits of its spans."""
        from shapeblend_cli.svg.reading import text as texts

        text = texts.Text([], [], [])
        visits: list[_Visit] = []
        waiting: list[tuple[int, Iterator[str | Node], bool]] = []

        def enter(inner: _Visit, path: tuple[Contour, ...] | None, keeps: bool) -> None:
            node = inner.node
            text.spans.append(texts.Span(node, inner.inherited, inner.lengths, len(text.characters), path))
            text.ends.append(0)
            keeps = texts.keeps_blanks(node, inner.inherited, keeps)
            waiting.append((len(visits), iter(node.mixed or ()), keeps))
            visits.append(inner)

        enter(visit, None, False)
        while waiting:
            number, rest, keeps = waiting[-1]
            item = next(rest, None)
            if item is None:
                text.ends[number] = len(text.characters)
                waiting.pop()
            elif isinstance(item, str):
                text.add(item, number, keeps)
            elif item.tag in ("tspan", "textPath", "a") and is_for_us(item):
                declared, inner = self._apply(
                    self._cascade.declared(item), visits[number]._replace(node=item)
                )
                if declared.get("display", "").strip().lower() == "none":
                    continue
                check_limit(len(waiting), texts.MOST_DEPTH, "spans within each other")
                path = self._carrier(inner) if item.tag == "textPath" else text.spans[number].path
                # Only the style counts: spans have no transform.
                enter(inner._replace(matrix=visit.matrix), path, keeps)
        return text, visits

    def _carrier(self, visit: _Visit) -> tuple[Contour, ...]:
        """Return the contours of the path that a text follows, none if it is not there."""
        link = visit.node.link().strip()
        target = self._ids.get(link.removeprefix("#"))
        if target is None or target.tag not in SHAPES:
            self._notes.add(f"text along '{printable(link)}', which is no path of the file, left out")
            return ()
        declared = self._cascade.declared(target, keep=True)
        matrix = parse(declared.get("transform", "none")) or IDENTITY
        found = contours_of(target, declared, visit.lengths, self._notes, self._lenient)
        return tuple(contours.transform(contour, matrix) for contour in contours.with_length(found))

    def _contours(self, visit: _Visit, declared: Declarations) -> list[Contour]:
        node = visit.node
        # Only lists of points are worth remembering, and no percentage changes them.
        known = self._used_contours if visit.used and node.tag in POINT_LISTS else {}
        if id(node) not in known:
            known[id(node)] = contours_of(node, declared, visit.lengths, self._notes, self._lenient)
        return known[id(node)]

    def _skip(self, visit: _Visit, reason: str) -> None:
        self._skipped[reason] += visit.node.tag in SHAPES
        if self._reason is None and self._chosen:
            if visit.chosen:
                self._reason = reason
            elif id(visit.node) in self._ancestors:
                self._reason = f"in {visit.node}, which is {reason}"
