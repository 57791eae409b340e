"""A rough estimate of the work between two contours, on a few of their vertices."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.geometry.polyline import distinct
from shapeblend_cli.matching.angles import turns
from shapeblend_cli.matching.solve import NothingLess, Search, least_work
from shapeblend_cli.matching.work import Wires

if TYPE_CHECKING:
    from shapeblend_cli.model import ComplexArray
    from shapeblend_cli.options.constants import WorkConstants

MOST_VERTICES = 32
"""Maximum number of vertices of each polygon."""

_COINCIDENT = 1e-6
"""Maximum distance of vertices that are one, in unit boxes."""


def rough_work(
    p0: ComplexArray, p1: ComplexArray, closed: bool, constants: WorkConstants, most: float = np.inf
) -> float:
    """Return the least work between two polygons in their unit boxes, on a few of their vertices.

    Open polygons may correspond in either direction. Infinite if so few vertices do not make a polygon, or if closed
    ones take more than the maximum that is of use.
    """
    return work_of_few(few(p0, closed), few(p1, closed), closed, constants, most)


def work_of_few(
    p: ComplexArray, q: ComplexArray, closed: bool, constants: WorkConstants, most: float = np.inf
) -> float:
    """Return `rough_work` of polygons that have `few` vertices already."""
    if min(len(p), len(q)) < (3 if closed else 2):
        return np.inf
    if closed:
        try:
            return least_work(Wires(p, q, closed, constants), Search(most=most)).work
        except NothingLess:
            return np.inf
    directions = [q, q[::-1]]
    return min(least_work(Wires(p, directed, closed, constants)).work for directed in directions)


def few(vertices: ComplexArray, closed: bool) -> ComplexArray:
    """Return at most `MOST_VERTICES` vertices, evenly spread by their numbers, none twice in a row."""
    if len(vertices) > MOST_VERTICES:
        last = len(vertices) - (0 if closed else 1)
        chosen = np.linspace(0, last, MOST_VERTICES, endpoint=not closed)
        vertices = vertices[np.round(chosen).astype(np.intp)]
    # An outline that runs back over itself may have its vertices in pairs.
    return vertices[distinct(vertices, closed, _COINCIDENT)]


def turning(vertices: ComplexArray, closed: bool) -> float:
    """Return how far a polygon turns in all, to whichever side.

    Any path between two polygons bends by the difference of theirs at least. At each dot an angle changes by the
    difference of two turns or more, and of a run of coincident vertices each end has half of the turn of its vertex.
    """
    return float(np.abs(turns(vertices, closed)).sum())
