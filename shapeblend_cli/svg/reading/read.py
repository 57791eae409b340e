"""From an SVG file to a `Drawing`: the shapes that it paints, in the root's user units."""

from __future__ import annotations

import os
import sys

from shapeblend_cli.errors import InputError, unreadable
from shapeblend_cli.model import Drawing
from shapeblend_cli.svg.reading import viewports
from shapeblend_cli.svg.reading.walk import Walk
from shapeblend_cli.svg.xml import xmltree
from shapeblend_cli.svg.xml.messages import Notes, Problem, printable

STANDARD_INPUT = "-"

_TITLES = {STANDARD_INPUT: "standard input", "<stdin>": "standard input", "<text>": "text"}


def title_of(file: str | os.PathLike[str]) -> str:
    """Return the name of a file in titles, which is its name without the folder."""
    name = os.fspath(file)
    return _TITLES.get(name) or name.replace("\\", "/").rpartition("/")[2]


def read(
    file: str,
    data: bytes | None = None,
    *,
    lenient: bool = False,
    select: str | None = None,
    is_to_blend: bool = False,
    text: str = "outline",
    images: str = "embedded",
) -> Drawing:
    """Return the drawing in an SVG file; without its contents as `data`, the file is opened.

    The file ``-`` is standard input, called ``<stdin>`` in the drawing and in messages. If `lenient`, path data and
    points that break the grammar are drawn up to the error. To `select`, by ``#id`` or a CSS selector, is to return
    only the shapes it matches, those in groups it matches, and those drawn through a ``use`` it matches; `Shape.index`
    still counts all the file paints. A drawing that `is_to_blend` is refused early if it is too large for that. With
    `text` ``outline`` each letter is a shape, with ``keep`` one that knows the whole text, if that may stay text; with
    ``skip`` text is left out.
    Pictures in the file are taken, with `images` ``beside`` also those in files of its folder and below, with ``skip``
    none.

    Raises
    ------
    InputError
        If the file cannot be opened, is not SVG, exceeds a limit, or paints no shape, or none that was selected.
    """
    notes = Notes()
    name = "<stdin>" if file == STANDARD_INPUT else file
    try:
        root = xmltree.parse(contents_of(file) if data is None else data)
        if root.tag != "svg":
            tag = printable(root.tag.lstrip(":"))
            raise Problem(f"its root element is <{tag}>, not <svg>; an SVG file would work")
        box = viewports.root_box(root, notes)
        folder = None if file == STANDARD_INPUT else os.path.dirname(file) or os.curdir
        shapes = Walk(root, notes, lenient, is_to_blend, text, (images, folder)).shapes(box, select)
    except Problem as problem:
        raise InputError(name, str(problem)) from None
    page = viewports.root_page(root, box)._replace(heading=os.path.splitext(title_of(name))[0])
    return Drawing(name, box, shapes, notes.phrases(), page)


def contents_of(file: str) -> bytes:
    """Return the bytes of a file, or of standard input, no more than can be read; InputError if it cannot be opened."""
    try:
        if file == STANDARD_INPUT:
            if sys.stdin is None:
                raise InputError("<stdin>", "standard input is closed; an SVG file would work")
            return sys.stdin.buffer.read(xmltree.MAX_BYTES + 1)
        with open(file, "rb") as stream:
            return stream.read(xmltree.MAX_BYTES + 1)
    except InputError:
        raise
    except (OSError, ValueError) as error:
        name = "<stdin>" if file == STANDARD_INPUT else file
        raise unreadable(name, error, "SVG file") from None
