"""Drawings written out in the tests, and what is asked of them."""

import numpy as np
import pytest

from shapeblend_cli.errors import InputError
from shapeblend_cli.geometry.cubics import bounds, lengths
from shapeblend_cli.svg.reading import path_commands
from shapeblend_cli.svg.reading.read import read

VIEWBOX = 'viewBox="0 0 100 100"'
RECT = '<rect width="1" height="2"/>'


def svg(markup, root=VIEWBOX):
    """Return a whole document around `markup`."""
    names = 'xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"'
    return f"<svg {names} {root}>{markup}</svg>".encode()


def drawn(markup, root=VIEWBOX, **options):
    """Return the drawing of a document with `markup` in it, or of a whole one in bytes."""
    return read("test.svg", markup if isinstance(markup, bytes) else svg(markup, root), **options)


def refused(markup, message, **options):
    """Check that such a document is refused with a message, a regular expression, and return the whole message."""
    with pytest.raises(InputError, match=message) as caught:
        drawn(markup, **options)
    return str(caught.value)


def table(text):
    """Return the rows of a table by what stands in their first column."""
    rows = (line.split(" | ") for line in text.strip().splitlines())
    return {name.strip(): [cell.strip() for cell in cells] for name, *cells in rows}


def boxes(drawing):
    """Return the box of every shape: xmin, ymin, xmax, ymax."""
    paths = (np.concatenate([contour.segments for contour in shape.contours]) for shape in drawing.shapes)
    found = [bounds(path) for path in paths]
    # Adding 0 turns -0.0 into 0.0.
    return [[float(round(value, 4)) + 0.0 for value in box.bounds] for box in found]


def length(drawing):
    """Return the length of all contours together."""
    return sum(lengths(contour.segments).sum() for shape in drawing.shapes for contour in shape.contours)


def path_contours(data):
    """Return the contours of path data that keeps to the grammar."""
    subpaths, error = path_commands.scan(data)
    assert error is None
    return path_commands.trace(subpaths)
