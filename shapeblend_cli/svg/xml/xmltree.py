"""XML into a light tree of nodes, by the standard library's expat, within limits.

Expat reads no external entity and stops exponential ones by itself. Added here are limits on size, depth, number of
elements and entity text, all of them checked while parsing.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cached_property
from xml.parsers import expat

from shapeblend_cli.svg.xml.messages import Problem, check_limit, printable

MAX_BYTES = 64 * 2**20
_MEGABYTES = MAX_BYTES // 2**20
MAX_DEPTH = 1000
MAX_ELEMENTS = 250_000
MAX_ENTITY_TEXT = 100_000
MAX_PREFIXES = 200

_OTHER_FORMATS = {
    b"\x89PNG": "a PNG image",
    b"\xff\xd8\xff": "a JPEG image",
    b"GIF8": "a GIF image",
    b"%PDF": "a PDF document",
    b"%!PS": "a PostScript document",
    b"PK\x03\x04": "a zip archive",
}
_HTML = re.compile(rb"(?i)(\xef\xbb\xbf)?\s*(<!--.*?-->\s*)*<(!doctype\s+html|html)[\s>]", re.DOTALL)
_GZIP = b"\x1f\x8b"
_UTF_32 = (b"\xff\xfe\0\0", b"\0\0\xfe\xff", b"<\0\0\0", b"\0\0\0<")
# Their first bytes tell UTF-16 apart even where the byte order mark is missing.
_UTF_16 = {b"\xff\xfe": "utf-16", b"\xfe\xff": "utf-16", b"<\x00": "utf-16-le", b"\x00<": "utf-16-be"}
# Expat knows no encoding of more than one byte a character but UTF-8 and UTF-16; Python does.
_DECLARED = rb"""\s*<\?xml[^>]*?\sencoding\s*=\s*["']([\w.:-]{1,40})["']"""
_MULTIBYTE = {"gb2312", "gbk", "gb18030", "big5", "shift_jis", "cp932", "euc_jp", "euc_kr", "cp949"}

_LINK = r"""\s*url\(\s*["']?#([^"')]{1,1000})["']?\s*\)\s*"""
_REFERENCE = rb"&([^;&#\s]{1,200});"
# Drafts of SVG 1.0 added a date to the name, and people write https.
_SVG_NAMESPACES = (
    "http://www.w3.org/2000/svg",
    "https://www.w3.org/2000/svg",
    "http://www.w3.org/Graphics/SVG",
)

POINT_LISTS = frozenset(("path", "polyline", "polygon"))
SHAPES = POINT_LISTS | {"rect", "circle", "ellipse", "line"}

MARKED = POINT_LISTS | {"line"}
"""Elements that may have markers."""

GROUPS = frozenset(("g", "a", "switch", "svg", "use"))
"""Elements that draw their children, or the element that they refer to."""

LEFT_OUT = frozenset(("foreignObject", "video", "canvas", "iframe"))
"""Elements that browsers draw and this reader does not."""

ANIMATIONS = frozenset(("animate", "animateColor", "animateMotion", "animateTransform", "set"))
"""Elements that change others over time."""

WITH_TEXT = frozenset(("style", "title", "desc"))
"""Elements whose text is kept."""


@dataclass(slots=True, eq=False, repr=False)
class Node:
    """An element."""

    tag: str  # the local name of an SVG element; `prefix:name` of any other
    attrib: dict[str, str]  # by the names in the file
    line: int  # where the element begins in the file, counted from 1
    children: list[Node] = field(default_factory=list)
    text: str = ""  # directly inside, of elements in `WITH_TEXT` only
    mixed: list[str | Node] | None = None  # words and children in order, of `text` and elements in it only

    def get(self, name: str, default: str | None = None) -> str | None:
        """Return the value of an attribute."""
        return self.attrib.get(name, default)

    def link(self) -> str:
        """Return the value of ``href`` with any prefix."""
        prefixed = (value for name, value in self.attrib.items() if name.endswith(":href"))
        return self.attrib["href"] if "href" in self.attrib else next(prefixed, "")

    def walk(self) -> Iterator[Node]:
        """Yield this node and all below it, in document order."""
        stack = [self]
        while stack:
            node = stack.pop()
            yield node
            stack.extend(reversed(node.children))

    def __str__(self) -> str:
        name = self.get("id")
        label = f" '{printable(name)}'" if name else ""
        return f"{self.tag}{label} on line {self.line}"


class Tree:
    """The elements of a document, and those around each."""

    def __init__(self, root: Node) -> None:
        self.root = root

    @cached_property
    def _parents(self) -> dict[int, Node]:
        return {id(child): each for each in self.root.walk() for child in each.children}

    def parent(self, node: Node) -> Node | None:
        """Return the element that one is in, if it is in any."""
        return self._parents.get(id(node))

    def around(self, node: Node) -> list[Node]:
        """Return the elements around one, from the root inwards."""
        path = []
        while (parent := self.parent(node)) is not None:
            node = parent
            path.append(node)
        return path[::-1]


def named(value: str) -> str:
    """Return the id that a property such as ``url(#id)`` names; "" if none."""
    match = re.fullmatch(_LINK, value)
    return match[1] if match else ""


def parse(data: bytes) -> Node:
    """Return the root of a document; raise a Problem if it is not well-formed XML, or exceeds a limit."""
    data, encoding = _decode(_unpack(data))
    parser = expat.ParserCreate(encoding)
    builder = _Builder(parser, data)
    try:
        parser.Parse(data, True)
    except expat.ExpatError as error:
        message = expat.ErrorString(error.code)
        raise Problem(
            f"line {error.lineno}: not well-formed XML ({message}); a file saved as SVG would work"
        ) from None
    except (LookupError, ValueError, UnicodeError):
        raise Problem("its encoding is not supported; saved in UTF-8 it would work") from None
    return builder.root


def _unpack(data: bytes) -> bytes:
    """Return `data` decompressed; raise a Problem if it cannot be XML."""
    if data.startswith(_GZIP):
        data = _gunzip(data)
        if data.startswith(_GZIP):
            raise Problem("this is compressed twice; compressed once, or not at all, it would work")
    if len(data) > MAX_BYTES:
        raise Problem(f"larger than {_MEGABYTES} MB, the limit")
    if not data.strip():
        raise Problem("the file is empty; an SVG file would work")
    for magic, name in _OTHER_FORMATS.items():
        if data.startswith(magic):
            raise Problem(f"this is {name}; an SVG file would work")
    if _HTML.match(data):
        raise Problem("this is a page of HTML; an SVG file would work")
    if data.startswith(_UTF_32):
        raise Problem("this is text in UTF-32; saved in UTF-8 it would work")
    return data


def _gunzip(data: bytes) -> bytes:
    import gzip
    import io
    import zlib

    try:
        with gzip.open(io.BytesIO(data)) as stream:
            return stream.read(MAX_BYTES + 1)
    except (OSError, EOFError, zlib.error):
        raise Problem("compressed data is damaged or cut short; the whole file would work") from None


def _decode(data: bytes) -> tuple[bytes, str | None]:
    """Return `data` in an encoding expat reads, and the encoding's name if it overrides the document's."""
    name = _UTF_16.get(data[:2])
    if name is None:
        declared = re.match(_DECLARED, data[:200])
        name = declared[1].decode("ascii").lower().replace("-", "_") if declared else ""
        if name not in _MULTIBYTE:
            return data, None
    try:
        return data.decode(name).encode("utf-8"), "utf-8"
    except UnicodeError:
        raise Problem(f"not valid {name} text; saved in UTF-8 it would work") from None


class _Builder:
    """The handlers of one expat parser, and the tree they build."""

    def __init__(self, parser: expat.XMLParserType, data: bytes) -> None:
        self._parser = parser
        self._data = data
        self._open: list[Node] = [Node("", {}, 0)]
        # Which prefixes mean SVG, for each open element; '' is the default namespace. A missing declaration is
        # forgiven: a fifth of old clip art has none.
        self._namespaces: list[dict[str, bool]] = [{"": True, "svg": True}]
        self._elements = 0
        self._text: list[str] = []
        # Lengths of the entities' texts, expanded.
        self._entities = dict.fromkeys(("amp", "lt", "gt", "apos", "quot"), 1)
        self._entity_text = 0
        self._has_defaults = False
        self._default_text = 0
        parser.buffer_text = True
        parser.StartElementHandler = self._start
        parser.EndElementHandler = self._end
        parser.EntityDeclHandler = self._entity
        parser.AttlistDeclHandler = self._default
        parser.EndDoctypeDeclHandler = self._check_entities

    @property
    def root(self) -> Node:
        return self._open[0].children[0]

    def _start(self, name: str, attrib: dict[str, str]) -> None:
        self._elements += 1
        check_limit(self._elements, MAX_ELEMENTS, "elements")
        if len(self._open) > MAX_DEPTH:
            raise Problem(f"elements nested deeper than {MAX_DEPTH}, the limit")
        if self._has_defaults:
            # Expat adds default values to every element: they multiply.
            self._default_text += sum(map(len, attrib.values()))
            if self._default_text > MAX_BYTES:
                raise Problem(f"attributes longer than {_MEGABYTES} MB together, the limit")
        namespaces = self._namespaces[-1]
        declared = [key for key in attrib if key.startswith("xmlns")]
        if declared:
            is_svg = {key[6:]: attrib[key].startswith(_SVG_NAMESPACES) for key in declared}
            namespaces = {**namespaces, **is_svg}
            if self._elements == 1:
                _forgive(name, declared, namespaces)
            check_limit(len(namespaces), MAX_PREFIXES, "namespaces")
        self._namespaces.append(namespaces)
        node = Node(_local(name, namespaces), attrib, self._parser.CurrentLineNumber)
        around = self._open[-1]
        around.children.append(node)
        if around.mixed is not None:
            around.mixed.append(node)
        self._open.append(node)
        if node.tag in WITH_TEXT:
            self._text = []
            self._parser.CharacterDataHandler = self._text.append
        elif node.tag == "text" or around.mixed is not None:
            node.mixed = []
            self._parser.CharacterDataHandler = node.mixed.append

    def _end(self, name: str) -> None:
        node = self._open.pop()
        self._namespaces.pop()
        if node.tag in WITH_TEXT:
            node.text = "".join(self._text)
        if node.tag in WITH_TEXT or node.mixed is not None:
            around = self._open[-1].mixed
            self._parser.CharacterDataHandler = None if around is None else around.append

    def _default(self, *declaration: object) -> None:
        self._has_defaults = True

    def _entity(self, name: str, is_parameter: int, value: str | None, *identifiers: str | None) -> None:
        if is_parameter or value is None:
            kind = "parameter" if is_parameter else "external"
            raise Problem(f"{kind} entity '{printable(name)}' in its DOCTYPE; without it the file would work")
        size = len(name) + len(value)
        for match in re.finditer(_REFERENCE, value.encode()):
            inner = match[1].decode()
            if inner not in self._entities:
                raise Problem(f"entity '{printable(name)}' refers to an unknown one, '{printable(inner)}'")
            size += self._entities[inner]
        self._entities[name] = size
        self._entity_text += size
        if self._entity_text > MAX_ENTITY_TEXT:
            raise Problem(f"more than {MAX_ENTITY_TEXT} characters of entity text, the limit")

    def _check_entities(self) -> None:
        """Refuse a document whose entities would swell it, before expat expands them."""
        if not self._entity_text:
            return
        names = (match[1].decode("utf-8", "replace") for match in re.finditer(_REFERENCE, self._data))
        # A name in another encoding than UTF-8 may stand for any of them.
        largest = max(self._entities.values())
        total = sum(self._entities.get(name, largest) for name in names)
        if total > MAX_BYTES:
            raise Problem(f"entities swell it to more than {_MEGABYTES} MB, the limit")


def _forgive(root: str, declared: list[str], namespaces: dict[str, bool]) -> None:
    """Accept a root named svg in any namespace."""
    prefix, _, local = root.rpartition(":")
    if local == "svg":
        namespaces[prefix] = True
    if prefix and "xmlns" not in declared:
        # Its author knows prefixes: a name without one is something else.
        namespaces[""] = False


def _local(name: str, namespaces: dict[str, bool]) -> str:
    """Return the local name of an SVG element, or a name with a colon for any other."""
    prefix, _, local = name.rpartition(":")
    return local if namespaces.get(prefix, False) else f"{prefix}:{local}"
