"""Contours to test with."""

import numpy as np
import shapely

from shapeblend_cli.geometry import cubics
from shapeblend_cli.model import Contour, Drawing, Polygon, Shape, Style


def polygon_contour(points, closed=True):
    """Straight lines from point to point."""
    segments = cubics.lines(np.asarray(points, complex), closed)
    return Contour(segments, np.ones(len(segments), bool), closed)


def circle_contour(centre=0j, radius=1.0, arcs=8, turn=0.0):
    """A circle in so many cubics; four are what drawing programs write."""
    node = np.exp(1j * (turn + 2.0 * np.pi * np.arange(arcs) / arcs))
    after, handle = np.roll(node, -1), 4.0 / 3.0 * np.tan(np.pi / (2.0 * arcs))
    segments = np.stack([node, node * (1 + 1j * handle), after * (1 - 1j * handle), after], axis=1)
    return Contour(centre + radius * segments, np.zeros(arcs, bool), True)


def polygon(points, closed=True):
    """A polygon on a contour of straight lines."""
    return Polygon(points, np.arange(len(points)), np.zeros(len(points)), closed)


def drawing(*contours, file="a.svg", viewbox=None, style=None):
    """A file with one shape."""
    return Drawing(file, viewbox, (Shape(0, None, "path", contours, style or Style()),))


def polyline(one, pieces):
    """Points along a contour or an outline, each curve cut into pieces of equal parameter, without its end."""
    counts = np.where(one.straight, 1, pieces)
    segment = np.repeat(np.arange(len(one.segments)), counts)
    number = np.arange(counts.sum()) - np.repeat(np.cumsum(counts) - counts, counts)
    return cubics.evaluate(one.segments[segment], number / counts[segment])


def furthest(points, *polylines):
    """The largest distance of any point from the nearest of some polylines, all of them complex."""
    sides = np.concatenate([np.stack([line[:-1], line[1:]], axis=1) for line in polylines])
    tree = shapely.STRtree(shapely.linestrings(np.stack([sides.real, sides.imag], axis=-1)))
    points = shapely.points(points.real, points.imag)
    _, distances = tree.query_nearest(points, return_distance=True, all_matches=False)
    assert len(distances) == len(points)
    return distances.max()
