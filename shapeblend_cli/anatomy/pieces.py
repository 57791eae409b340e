"""What fills paint: nothing of outlines without an area, and one area of pieces that abut.

Some drawing tools close a path with a line there and back. It paints nothing, but would become something on the way.
Those that turn a stroke into a fill may write each of its segments, joins and caps as a subpath of its own (Figma
does). Nobody sees the seams, but pieces would part on the way, and no pen line would be found in them. Nodes within
an area or at a seam are not the drawing's own, and go.
"""

from __future__ import annotations

from dataclasses import replace
from operator import is_
from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.anatomy.decompose import is_straight
from shapeblend_cli.anatomy.unions import are_alike, outline, polyline, rasters, united
from shapeblend_cli.geometry.polygons import signed_area
from shapeblend_cli.model import Box
from shapeblend_cli.model.arrays import numbered, rolled

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import Contour, Drawing, Shape, Style

MOST_NODES = 1000
"""Maximum number of nodes of a shape in pieces: each is compared with each."""

TOLERANCE = 5e-4
"""Maximum distance of nodes that are one but for rounding, as a share of the shape's larger side."""

THIN = 2e-4
"""Maximum width of an outline between pieces that is left over by rounding, as a share of the shape's larger side."""

OPPOSITE = -0.99
"""Maximum cosine of the angle between edges that run along each other in opposite directions."""


def with_areas(drawing: Drawing) -> Drawing:
    """Return a drawing whose fills have the outlines of what they paint; the same one if all of them have."""
    if drawing.has_areas:
        return drawing
    shapes = drawing.shapes
    if any(shape.clips or shape.effects for shape in shapes):
        from shapeblend_cli.anatomy.masks import unmasked  # few drawings have any

        shapes = unmasked(shapes)
    found = tuple(_with_area(shape) for shape in shapes)
    if len(found) == len(drawing.shapes) and all(map(is_, found, drawing.shapes)):
        return drawing
    return drawing._replace(shapes=found, has_areas=True)


def _with_area(shape: Shape) -> Shape:
    contours = _painted(shape.contours, shape.style)
    return shape if contours is shape.contours else replace(shape, contours=tuple(contours))


def _painted(contours: Sequence[Contour], style: Style) -> Sequence[Contour]:
    """Return the outlines of what a shape paints, if it is a fill without a stroke; else its contours."""
    if len(contours) < 2 or style.stroke is not None or not all(contour.closed for contour in contours):
        return contours
    areas = [each for each in contours if not is_straight(each.segments.ravel())]
    if 0 < len(areas) < len(contours):  # where nothing has an area, all stay, for a message that names them
        contours = areas
    if style.fill_rule != "nonzero" or _count_nodes(contours) > MOST_NODES:
        return contours
    size = Box.around(np.concatenate([contour.segments[:, 0] for contour in contours])).larger_side
    if not _abut(contours, TOLERANCE * size):
        return contours
    try:
        outlines = united(_snapped(contours, TOLERANCE * size))
    except ImportError:  # the library has no wheels for Windows on ARM
        return contours
    # Pieces that cross each other many times are no pieces of a stroke.
    if not 0 < len(outlines) <= len(contours) or _count_nodes(outlines) > MOST_NODES:
        return contours
    outlines = [each for each in _snapped(outlines, TOLERANCE * size) if not _is_thin(each, THIN * size)]
    return outlines if outlines and _paint_the_same(contours, outlines) else contours


def _count_nodes(contours: Sequence[Contour]) -> int:
    return sum(len(contour.segments) for contour in contours)


def _abut(contours: Sequence[Contour], tolerance: float) -> bool:
    """Return whether a straight edge of one contour runs back along one of another, from a node that both have."""
    edges = np.concatenate([contour.segments[contour.straight] for contour in contours])
    owner = np.repeat(np.arange(len(contours)), [np.count_nonzero(contour.straight) for contour in contours])
    length = np.abs(edges[:, 3] - edges[:, 0])
    is_long = length > 2.0 * tolerance
    starts, ends, owner = edges[is_long, 0], edges[is_long, 3], owner[is_long]
    along = (ends - starts) / length[is_long]
    # Of the ends, sorted by x, each start is compared with those that are near in x.
    order = np.argsort(ends.real)
    first, beyond = np.searchsorted(ends.real[order], np.add.outer([-tolerance, tolerance], starts.real))
    i = np.arange(len(starts)).repeat(beyond - first)
    j = order[numbered(beyond - first) + first.repeat(beyond - first)]
    meet = (np.abs(starts[i] - ends[j]) < tolerance) & (owner[i] != owner[j])
    return bool((meet & ((along[i] * along[j].conj()).real < OPPOSITE)).any())


def _snapped(contours: Sequence[Contour], tolerance: float) -> list[Contour]:
    """Return contours with nodes that are one but for rounding at one place, without those that become points."""
    nodes = np.concatenate([contour.segments[:, 0] for contour in contours])
    places = nodes[(np.abs(nodes[:, None] - nodes) < tolerance).argmax(axis=1)]
    ends = np.cumsum([len(contour.segments) for contour in contours])
    found = []
    for contour, starts in zip(contours, np.split(places, ends[:-1]), strict=True):
        shift = starts - contour.segments[:, 0]
        moved = contour.segments + np.stack([shift, shift, rolled(shift, -1), rolled(shift, -1)], axis=1)
        moved[:, 3] = rolled(starts, -1)
        is_left = (moved[:, 3] != starts) | ~contour.straight & (np.ptp(moved, axis=1) != 0.0)
        if is_left.any():
            found.append(outline(moved[is_left], contour.straight[is_left]))
    return found


def _is_thin(contour: Contour, width: float) -> bool:
    """Return whether a closed contour that does not cross itself is no wider than this."""
    vertices = polyline(contour)
    return abs(signed_area(vertices)) <= width * float(np.abs(rolled(vertices, -1) - vertices).sum()) / 2.0


def _paint_the_same(one: Sequence[Contour], other: Sequence[Contour]) -> bool:
    """Return whether contours paint the same but for slivers, seen on a raster."""
    box = Box.around(np.concatenate([polyline(contour) for contour in one]))
    return are_alike(*rasters(box, (one, "nonzero"), (other, "nonzero")))
