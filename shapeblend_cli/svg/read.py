"""An SVG file into a `Drawing`: what it paints, in the root's user units."""

from __future__ import annotations

from shapeblend_cli.errors import InputError
from shapeblend_cli.model import Drawing
from shapeblend_cli.svg import viewports, xmltree
from shapeblend_cli.svg.notes import Notes
from shapeblend_cli.svg.problem import Problem, shown
from shapeblend_cli.svg.walk import Walk


def read(file: str, data: bytes | None = None) -> Drawing:
    """Return what an SVG file paints.

    Parameters
    ----------
    file : str
        Its name, as the user gave it.
    data : bytes, optional
        Its contents, such as standard input; without them the file is opened.

    Raises
    ------
    InputError
        If the file cannot be opened, is not SVG, exceeds a limit, or paints no shape.
    """
    notes = Notes()
    try:
        root = xmltree.parse(_contents(file) if data is None else data)
        if root.tag != "svg":
            name = shown(root.tag.lstrip(":"))
            raise Problem(f"its root element is <{name}>, not <svg>; an SVG file would work")
        box = viewports.root_box(root, notes)
        shapes = Walk(root, notes).shapes(viewports.root_size(box))
    except Problem as problem:
        raise InputError(file, str(problem)) from None
    return Drawing(file, box, shapes, notes.phrases())


def _contents(file: str) -> bytes:
    try:
        with open(file, "rb") as stream:
            return stream.read(xmltree.MAX_BYTES + 1)
    except OSError as error:
        raise Problem(f"cannot be read ({error.strerror}); a readable SVG file would work") from None
    except ValueError:
        # Names with a null character.
        raise Problem("not the name of a file") from None
