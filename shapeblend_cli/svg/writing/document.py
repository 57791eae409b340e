"""SVG documents: empty ones, frames, and their text."""

from __future__ import annotations

import zlib
from collections.abc import Callable, Iterable, Mapping, Sequence
from types import MappingProxyType
from xml.etree.ElementTree import Element, tostring

from shapeblend_cli.model import (
    BentPicture,
    Box,
    Clip,
    Frame,
    Group,
    KeyframedShape,
    Name,
    Page,
    PaintedShape,
    Style,
)
from shapeblend_cli.paint.names import page_for
from shapeblend_cli.svg.writing.ids import Ids
from shapeblend_cli.svg.writing.paint import Around, Gradients, hyphened, picture_attributes, visible_styles
from shapeblend_cli.svg.writing.path_data import path_data
from shapeblend_cli.svg.writing.rounding import number

SVG = "http://www.w3.org/2000/svg"
INKSCAPE = "http://www.inkscape.org/namespaces/inkscape"

SIZE_DIGITS = 6  # decimals of the width and the height of a page

TEXTS = ("title", "desc")


def new(tag: str, attributes: Mapping[str, str] = MappingProxyType({})) -> Element:
    """Return an element with attributes; see `put`."""
    element = Element(tag)
    put(element, attributes)
    return element


def put(element: Element, attributes: Mapping[str, str]) -> None:
    """Give an element attributes in alphabetical order, with hyphens for underscores; empty ones are left out."""
    given = {name: value for name, value in hyphened(attributes).items() if value}
    element.attrib = dict(sorted((element.attrib | given).items()))


def empty(viewbox: Box, decimals: int, page: Page | None = None) -> Element:
    """Return a document that draws nothing yet, of the size of a page if that has one."""
    drawing = new("svg", {"xmlns": SVG, "viewBox": box_text(viewbox, decimals)})
    if page is not None:
        for name, length in (("width", page.width), ("height", page.height)):
            size = "" if length is None else f"{number(length.number, SIZE_DIGITS)}{length.unit}"
            if size != "100%":  # the default
                put(drawing, {name: size})
        put(drawing, {"id": page.name.id or "", "preserveAspectRatio": page.fit})
        drawing.extend(_texts(page.name))
    return drawing


def empty_and_called(viewbox: Box, decimals: int, page: Page) -> Element:
    """Return a drawing as of `empty`, which has a title in any case."""
    return empty(viewbox, decimals, page._replace(name=page.name._replace(title=page.called)))


def fingerprint(shapes: Iterable[KeyframedShape], *others: object) -> str:
    """Return a hash of shapes and other values, for names that are unique among the drawings of a page."""
    shapes = [*shapes]
    effects = [each.blend for shape in shapes for each in shape.effects]
    return fingerprint_of([shape.keys for shape in shapes], *others, *effects)


def fingerprint_of(painted: Iterable[Iterable[PaintedShape]], *others: object) -> str:
    """Return such a hash of groups of shapes."""
    drawn = [
        [([path.segments.tolist() for path in key.paths], key.style) for key in keys] for keys in painted
    ]
    text = repr((drawn, *others)).replace(", pixel=None", "").replace(", paint_order='normal'", "")
    return f"{zlib.crc32(text.encode()):08x}"


def _texts(name: Name) -> list[Element]:
    texts = []
    for tag, text in zip(TEXTS, (name.title, name.description), strict=True):
        if text is not None:
            texts.append(Element(tag))
            texts[-1].text = text
    return texts


def ids_of(
    drawing: Element, shapes: Iterable[PaintedShape | KeyframedShape], own: Callable[[], str] = str
) -> Ids:
    """Return the ids of a drawing of some shapes; so far only its own id is taken. See `Ids` for `own`."""
    ids = Ids.of(shapes, own)
    ids.take(drawing.get("id"))
    return ids


class Tree:
    """A drawing to which elements are added in paint order, each in its groups and with its name.

    A group that is left and entered again is there twice, since paint order comes first; the id is the first one's.
    """

    def __init__(self, root: Element, ids: Ids) -> None:
        self._ids = ids
        self._root = root  # what elements in no group are added to
        self._open: list[tuple[tuple[str, int], Element]] = []  # groups by their numbers, the outermost first

    @classmethod
    def of(cls, drawing: Element, shapes: Iterable[PaintedShape | KeyframedShape]) -> Tree:
        """Return the tree of a drawing of some shapes, before any is added."""
        return cls(drawing, ids_of(drawing, shapes))

    @property
    def ids(self) -> Ids:
        """The ids of the document."""
        return self._ids

    def add(
        self,
        element: Element,
        groups: Sequence[Group] = (),
        name: Name | None = None,
        around: Sequence[Around] = (),
    ) -> None:
        """Add an element, which has no title yet if it gets a name, in its groups, and in others `around` it."""
        path: list[tuple[tuple[str, int], Group | Around]] = []
        waiting = list(around)
        for k, group in enumerate(groups):
            while waiting and waiting[0].place <= k:
                path.append((("effect", waiting[0].number), waiting.pop(0)))
            path.append((("group", group.number), group))
        path += [(("effect", each.number), each) for each in waiting]
        shared = 0
        while shared < min(len(self._open), len(path)) and self._open[shared][0] == path[shared][0]:
            shared += 1
        del self._open[shared:]
        for key, each in path[shared:]:
            if isinstance(each, Group):
                opened = new("g", {"inkscape:groupmode": "layer"} if each.is_layer else {})
                self._name(opened, each.name)
            else:
                opened = each.make()
            self._parent.append(opened)
            self._open.append((key, opened))
        if name is not None:
            self._name(element, name)
        self._parent.append(element)

    @property
    def _parent(self) -> Element:
        return self._open[-1][1] if self._open else self._root

    def _name(self, element: Element, name: Name) -> None:
        taken = self._ids.take(name.id)
        label = name.label or (name.id if taken is None else None)
        put(element, {"id": taken or "", "inkscape:label": label or ""})
        element[:0] = _texts(name)


def box_text(box: Box, decimals: int) -> str:
    """Return the value of ``viewBox``."""
    return " ".join(number(value, decimals) for value in box)


def text(root: Element, style: str | None = None, definitions: Sequence[Element] = ()) -> str:
    """Return the text of a drawing, which gets a style sheet and definitions if there are any."""
    if any(name.startswith("inkscape:") for element in root.iter() for name in element.attrib):
        root.set("xmlns:inkscape", INKSCAPE)
    first = sum(element.tag in TEXTS for element in root)  # a title is the first element
    if definitions:
        holder = Element("defs")
        holder.extend(definitions)
        root.insert(first, holder)
    if style is not None:
        sheet = Element("style")
        sheet.text = style
        root.insert(first, sheet)
    return tostring(root, encoding="unicode") + "\n"


def frame_svg(frame: Frame, decimals: int) -> str:
    """Return a frame as an SVG document, with its coordinates rounded to a number of decimals."""
    drawing = empty(frame.view, decimals, frame.page)
    tree = Tree.of(drawing, frame.shapes)
    gradients = Gradients(decimals, tree.ids)
    add_shapes(tree, frame, gradients)
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
        label = f"{k}: t = {number(frame.pair + frame.t, 4)}"
        layer = _layer(ids.new(f"frame-{k}"), label)
        drawing.append(layer)
        add_shapes(Tree(layer, ids), frame, gradients)
    return text(drawing, definitions=gradients.elements)


def frames_in_groups(
    frames: Sequence[Frame], decimals: int, ids: Ids, place: tuple[str, str], *, as_layers: bool
) -> str:
    """Return frames as elements for a document that has ids already: groups in a group, or layers.

    The place is the name of all together, and their transform.
    """
    title, transform = place
    gradients = Gradients(decimals, ids)
    holder = new("g", {"id": ids.new("blend"), "inkscape:label": title, "transform": transform})
    written = [] if as_layers else [holder]
    for k, frame in enumerate(frames, 1):
        own, name = ids.new(f"frame-{k}"), f"t = {number(frame.t, 4)}"
        if as_layers:
            group = _layer(own, f"{title}, {name}")
            put(group, {"transform": transform})
            written.append(group)
        else:
            group = new("g", {"id": own, "inkscape:label": name})
            holder.append(group)
        add_shapes(Tree(group, ids), frame, gradients)
    if gradients.elements:
        defined = Element("defs")
        defined.extend(gradients.elements)
        written[0].insert(0, defined)
    for element in written:
        element.set("xmlns", SVG)
        element.set("xmlns:inkscape", INKSCAPE)
    return "".join(tostring(element, encoding="unicode") for element in written)


def _layer(own: str, label: str) -> Element:
    return new("g", {"id": own, "inkscape:groupmode": "layer", "inkscape:label": label})


def add_shapes(tree: Tree, frame: Frame, gradients: Gradients) -> None:
    """Add the shapes of a frame to a drawing. Of two coats of paint the upper one has the name."""
    for shape in frame.shapes:
        data = {"d": path_data(shape.paths, gradients.decimals), **gradients.clips.attributes(shape.clips)}
        around = gradients.around(shape.effects)
        if shape.bent is not None and shape.as_triangles:
            tree.add(_bent(shape.bent, data.get("clip_path"), gradients), shape.groups, shape.name, around)
            continue
        *below, above = visible_styles(shape, frame.t)
        for style in below:
            tree.add(painted(style, data, gradients), shape.groups, around=around)
        tree.add(painted(above, data, gradients), shape.groups, shape.name, around)


def painted(style: Style, data: Mapping[str, str], gradients: Gradients) -> Element:
    """Return a path in a style; or the picture that it is filled with, in a group if it is clipped.

    The `data` are the attributes of a path apart from its paint.
    """
    if style.picture is None:
        return new("path", {**data, **gradients.attributes(style)})
    from shapeblend_cli.model.words import Words  # few drawings have pictures, or text that stays

    if isinstance(style.picture.raster, Words):
        return clipped(gradients.text(style), data.get("clip_path"))
    image = new("image", picture_attributes(style.picture, style.fill_opacity, gradients.decimals))
    return clipped(image, data.get("clip_path"))


def _bent(bent: BentPicture, clip_path: str | None, gradients: Gradients) -> Element:
    """Return a bent picture as triangles that are cut out of it, in a group."""
    group = new("g", {"clip_path": clip_path or ""})
    for opacity, triangles in bent.triangles():
        layer = new("g", {"opacity": "" if opacity == 1.0 else number(opacity, 4)})
        group.append(layer)
        for picture, triangle in triangles:
            holder = new("g", gradients.clips.attributes((Clip((triangle,)),)))
            holder.append(new("use", gradients.shared_picture(picture)))
            layer.append(holder)
    return group


def clipped(image: Element, clip_path: str | None) -> Element:
    """Return a picture in a group that clips it, if anything does: its own transform would move a clip path."""
    if clip_path is None:
        return image
    group = new("g", {"clip_path": clip_path})
    group.append(image)
    return group
