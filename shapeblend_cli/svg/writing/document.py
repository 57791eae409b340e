"""SVG documents, by svgwrite: empty ones, frames, and their text."""

from __future__ import annotations

import zlib
from collections.abc import Iterable, Sequence
from typing import Any
from xml.etree import ElementTree  # svgwrite has imported it anyway

from shapeblend_cli.model import Box, Frame, Group, KeyframedShape, Name, Page, PaintedShape
from shapeblend_cli.paint.names import page_for
from shapeblend_cli.svg.libraries import svgwrite
from shapeblend_cli.svg.writing.ids import Ids
from shapeblend_cli.svg.writing.paint import Gradients, visible_styles
from shapeblend_cli.svg.writing.path_data import path_data
from shapeblend_cli.svg.writing.rounding import number

INKSCAPE = "http://www.inkscape.org/namespaces/inkscape"

SIZE_DIGITS = 6  # decimals of the width and the height of a page

TEXTS = ("title", "desc")


def empty(viewbox: Box, decimals: int, page: Page | None = None) -> Any:
    """Return an svgwrite drawing that draws nothing yet, of the size of a page if that has one."""
    drawing = svgwrite.Drawing(debug=False, viewBox=box_text(viewbox, decimals))
    drawing.elements.remove(drawing.defs)
    if page is not None:
        for name, length in (("width", page.width), ("height", page.height)):
            if length is not None:
                drawing[name] = f"{number(length.number, SIZE_DIGITS)}{length.unit}"
        if page.name.id is not None:
            drawing["id"] = page.name.id
        _add_texts(drawing, page.name)
    return drawing


def empty_and_called(viewbox: Box, decimals: int, page: Page) -> Any:
    """Return a drawing as of `empty`, which has a title in any case."""
    return empty(viewbox, decimals, page._replace(name=page.name._replace(title=page.called)))


def fingerprint(shapes: Iterable[KeyframedShape], *others: object) -> str:
    """Return a hash of shapes and other values, for names that are unique among the drawings of a page."""
    drawn = [
        [([path.segments.tolist() for path in key.paths], key.style) for key in shape.keys]
        for shape in shapes
    ]
    text = repr((drawn, *others)).replace(", pixel=None", "")
    return f"{zlib.crc32(text.encode()):08x}"


def _add_texts(element: Any, name: Name) -> None:
    if name.title is not None:
        element.add(svgwrite.base.Title(name.title))
    if name.description is not None:
        element.add(svgwrite.base.Desc(name.description))


def ids_of(drawing: Any, shapes: Iterable[PaintedShape | KeyframedShape]) -> Ids:
    """Return the ids of a drawing of some shapes; so far only its own id is taken."""
    ids = Ids.of(shapes)
    ids.take(drawing.attribs.get("id"))
    return ids


class Tree:
    """A drawing to which elements are added in paint order, each in its groups and with its name.

    A group that is left and entered again is there twice, since paint order comes first; the id is the first one's.
    """

    def __init__(self, drawing: Any, ids: Ids, root: Any = None) -> None:
        self._drawing = drawing
        self._ids = ids
        self._root = drawing if root is None else root  # what elements in no group are added to
        self._open: list[tuple[int, Any]] = []  # groups by their numbers, the outermost first

    @classmethod
    def of(cls, drawing: Any, shapes: Iterable[PaintedShape | KeyframedShape]) -> Tree:
        """Return the tree of a drawing of some shapes, before any is added."""
        return cls(drawing, ids_of(drawing, shapes))

    @property
    def ids(self) -> Ids:
        """The ids of the document."""
        return self._ids

    def add(self, element: Any, groups: Sequence[Group] = (), name: Name | None = None) -> None:
        """Add an element, which has no title yet if it gets a name."""
        shared = 0
        while shared < min(len(self._open), len(groups)) and self._open[shared][0] == groups[shared].number:
            shared += 1
        del self._open[shared:]
        for group in groups[shared:]:
            opened = self._drawing.g()
            self._name(opened, group.name)
            if group.is_layer:
                opened["inkscape:groupmode"] = "layer"
            self._parent.add(opened)
            self._open.append((group.number, opened))
        if name is not None:
            self._name(element, name)
        self._parent.add(element)

    @property
    def _parent(self) -> Any:
        return self._open[-1][1] if self._open else self._root

    def _name(self, element: Any, name: Name) -> None:
        taken = self._ids.take(name.id)
        if taken is not None:
            element["id"] = taken
        label = name.label or (name.id if taken is None else None)
        if label is not None:
            element["inkscape:label"] = label
        content = element.elements[:]
        element.elements.clear()
        _add_texts(element, name)
        element.elements.extend(content)


class Ready:
    """An element that can be added to elements of svgwrite."""

    def __init__(self, element: ElementTree.Element) -> None:
        self._element = element

    def get_xml(self) -> ElementTree.Element:
        """Return the element."""
        return self._element


def box_text(box: Box, decimals: int) -> str:
    """Return the value of ``viewBox``."""
    return " ".join(number(value, decimals) for value in box)


def text(drawing: Any, style: str | None = None, definitions: Sequence[ElementTree.Element] = ()) -> str:
    """Return the text of a drawing, with a style sheet and definitions if there are any.

    Additions of svgwrite are removed: a size of 100 %, a profile, unused namespaces.
    """
    root = drawing.get_xml()
    for name in ("width", "height"):
        if root.get(name) == "100%":
            del root.attrib[name]
    if any(name.startswith("inkscape:") for element in root.iter() for name in element.attrib):
        root.set("xmlns:inkscape", INKSCAPE)
    unused = ["version", "baseProfile", "xmlns:ev"]
    if not any("xlink:href" in element.attrib for element in root.iter()):
        unused.append("xmlns:xlink")
    for name in unused:
        root.attrib.pop(name, None)
    first = sum(element.tag in TEXTS for element in root)  # a title is the first element
    if definitions:
        holder = ElementTree.Element("defs")
        holder.extend(definitions)
        root.insert(first, holder)
    if style is not None:
        sheet = ElementTree.Element("style")
        sheet.text = style
        root.insert(first, sheet)
    return ElementTree.tostring(root, encoding="unicode") + "\n"


def frame_svg(frame: Frame, decimals: int) -> str:
    """Return a frame as an SVG document, with its coordinates rounded to a number of decimals."""
    drawing = empty(frame.view, decimals, frame.page)
    tree = Tree.of(drawing, frame.shapes)
    gradients = Gradients(decimals, tree.ids)
    add_shapes(tree, drawing, frame, gradients)
    return text(drawing, definitions=gradients.elements)


def layers_svg(frames: Sequence[Frame], decimals: int, page: Page) -> str:
    """Return frames as one SVG document, each in a layer of Inkscape that is named after its time.

    Its view holds the views of all frames. An id is there once, in the first frame that has it, and elsewhere a label.
    """
    view = Box.union([frame.view for frame in frames])
    drawing = empty(view, decimals, page_for(page, view))
    ids = ids_of(drawing, [shape for frame in frames for shape in frame.shapes])
    gradients = Gradients(decimals, ids)
    for k, frame in enumerate(frames, 1):
        layer = drawing.g(id=ids.new(f"frame-{k}"))
        layer["inkscape:groupmode"] = "layer"
        layer["inkscape:label"] = f"{k}: t = {number(frame.pair + frame.t, 4)}"
        drawing.add(layer)
        add_shapes(Tree(drawing, ids, layer), drawing, frame, gradients)
    return text(drawing, definitions=gradients.elements)


def frames_in_groups(
    frames: Sequence[Frame], decimals: int, ids: Ids, place: tuple[str, str], *, as_layers: bool
) -> str:
    """Return frames as elements for a document that has ids already: groups in a group, or layers.

    The place is the name of all together, and their transform.
    """
    title, transform = place
    drawing = empty(frames[0].view, decimals)
    gradients = Gradients(decimals, ids)
    holder = drawing.g(id=ids.new("blend"))
    holder["inkscape:label"] = title
    moved = {"transform": transform} if transform else {}
    around = [] if as_layers else [holder]
    if not as_layers:
        holder.attribs.update(moved)
    for k, frame in enumerate(frames, 1):
        group = drawing.g(id=ids.new(f"frame-{k}"))
        name = f"t = {number(frame.t, 4)}"
        group["inkscape:label"] = f"{title}, {name}" if as_layers else name
        if as_layers:
            group["inkscape:groupmode"] = "layer"
            group.attribs.update(moved)
            around.append(group)
        else:
            holder.add(group)
        add_shapes(Tree(drawing, ids, group), drawing, frame, gradients)
    written = [element.get_xml() for element in around]
    if gradients.elements:
        defined = ElementTree.Element("defs")
        defined.extend(gradients.elements)
        written[0].insert(0, defined)
    for element in written:
        element.set("xmlns", "http://www.w3.org/2000/svg")
        element.set("xmlns:inkscape", INKSCAPE)
    return "".join(ElementTree.tostring(element, encoding="unicode") for element in written)


def add_shapes(tree: Tree, drawing: Any, frame: Frame, gradients: Gradients) -> None:
    """Add the shapes of a frame to a drawing. Of two coats of paint the upper one has the name."""
    for shape in frame.shapes:
        data = path_data(shape.paths, gradients.decimals)
        clipped = gradients.clips.attributes(shape.clips)
        *below, above = visible_styles(shape, frame.t)
        for style in below:
            tree.add(drawing.path(d=data, **gradients.attributes(style), **clipped), shape.groups)
        tree.add(drawing.path(d=data, **gradients.attributes(above), **clipped), shape.groups, shape.name)
