"""Pairs that move otherwise than straight."""

import math

import numpy as np

from shapeblend_cli.frames.frames import make_frames
from shapeblend_cli.model import ContourBlend, CubicPath, ShapeBlend, Style
from shapeblend_cli.motion.alignment import Alignment, PointPairs, align
from shapeblend_cli.motion.rigid import Rigid
from shapeblend_cli.options.settings import Settings
from shapeblend_cli.outputs.move import moves_of
from shapeblend_cli.pipeline import match_all
from tests.support.contours import polygon_contour
from tests.support.drawings import drawing

TIMES = (0.1, 0.25, 0.5, 0.75, 0.9)


def blend(a, b, settings):
    """The pair of two drawings, and its frames."""
    (pair,), _ = match_all([a, b], settings)
    return pair, make_frames([pair], settings)


def rotated(pair, degrees=120.0, centre=12 + 12j):
    """A pair whose shapes rotate about a point, as if B's were A's rotated so far."""
    alignment = Alignment(centre, centre, 1.0, math.radians(degrees))
    return pair._replace(
        shapes=tuple(
            shape._replace(motion=Rigid((alignment,) * len(shape.contours))) for shape in pair.shapes
        )
    )


def rotated_move(*paths, degrees=120.0, **options):
    """The move between two documents of such paths that rotates, and the pair that it shows."""
    pairs, _ = match_all([drawing(path, **options) for path in paths], Settings())
    (pair,) = (rotated(pair, degrees) for pair in pairs)
    return moves_of([pair])[0], pair


def pair_of(a, b, **settings):
    """Two drawings matched as they lie, by their outlines."""
    (pair,), _ = match_all([a, b], Settings(place="asis", strokes="keep", **settings))
    return pair


def reasons(pair):
    """Why each shape of a pair moves as it does."""
    return tuple(shape.reason for shape in pair.shapes)


def contour_blend(start, end, *, grows=False, shrinks=False):
    """A blend from path to path of contours that nobody matched."""
    numbers = None if grows else 0, None if shrinks else 0
    cuts = (np.arange(len(start.segments) + 1.0),) * 2
    return ContourBlend(*numbers, *[None] * 4, 1.0, 1.0, None, start, end, cuts)


def moving_curves(a, b):
    """A closed contour of curves, from control points to control points."""
    curved = np.zeros(len(a), bool)
    return contour_blend(CubicPath(a, curved, True), CubicPath(b, curved, True))


def moving_polygon(a, b, closed=True):
    """A contour that moves from polygon to polygon, vertex by vertex; a number stands for a point."""
    count = max(np.size(a), np.size(b))
    start, end = (polygon_contour(np.broadcast_to(z, count), closed) for z in (a, b))
    return contour_blend(start, end, grows=np.size(a) == 1, shrinks=np.size(b) == 1)


def moving_shape(*contours):
    """A shape of such contours."""
    return ShapeBlend(contours, Style(), Style())


def moving_polygons(*pairs, closed=True):
    """A shape whose contours move from polygon to polygon."""
    return moving_shape(*(moving_polygon(a, b, closed) for a, b in pairs))


def similarity_of(shape):
    """The best one between a shape's start and its end, by its control points and the lengths between them."""
    a, b = (
        np.concatenate([getattr(contour, side).segments for contour in shape.contours])
        for side in ("start", "end")
    )
    length = sum(abs(np.diff(z)).sum(axis=1) for z in (a, b))
    weight = np.repeat(length, 4) / (4.0 * length.sum())
    return align(PointPairs(a.ravel(), b.ravel(), weight))


def rigidly(shape):
    """The shape in rigid motion."""
    return shape._replace(motion=Rigid((similarity_of(shape),) * len(shape.contours)))
