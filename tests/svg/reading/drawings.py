"""Drawings written out in the tests, and what is asked of them."""

from __future__ import annotations

import numpy as np

from shapeblend_cli.geometry.cubics import bounds, lengths
from shapeblend_cli.svg.reading import path_data
from shapeblend_cli.svg.reading.read import read


def svg(markup, root='viewBox="0 0 100 100"'):
    """Return a whole document around `markup`."""
    names = 'xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"'
    return f"<svg {names} {root}>{markup}</svg>".encode()


def drawn(markup, root='viewBox="0 0 100 100"'):
    """Return the drawing of a document with `markup` in it."""
    return read("test.svg", svg(markup, root))


def boxes(drawing):
    """Return the box of every shape: xmin, ymin, xmax, ymax."""
    found = []
    for shape in drawing.shapes:
        x, y, width, height = bounds(np.concatenate([contour.segments for contour in shape.contours]))
        # Adding 0 turns -0.0 into 0.0.
        found.append([float(round(value, 4)) + 0.0 for value in (x, y, x + width, y + height)])
    return found


def length(drawing):
    """Return the length of all contours together."""
    return sum(lengths(contour.segments).sum() for shape in drawing.shapes for contour in shape.contours)


def path_contours(data):
    """Return the contours of path data that keeps to the grammar."""
    subpaths, error = path_data.scan(data)
    assert error is None
    return path_data.trace(subpaths)
