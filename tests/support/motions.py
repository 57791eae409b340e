"""Pairs that move otherwise than straight."""

import math

import numpy as np

from shapeblend_cli.geometry import cubics
from shapeblend_cli.model import ContourBlend, CubicPath, ShapeBlend, Style
from shapeblend_cli.motion.alignment import Alignment, PointPairs, Rigid, align
from shapeblend_cli.outputs.move import moves_of
from shapeblend_cli.pipeline import match_all
from shapeblend_cli.settings import Settings
from tests.support.drawings import drawing


def turned(pair, degrees=120.0, centre=12 + 12j):
    """A pair whose shapes turn around a point on their way, as if B's were A's turned so far."""
    motion = Rigid(Alignment(centre, centre, 1.0, math.radians(degrees)))
    return pair._replace(shapes=tuple(shape._replace(motion=motion) for shape in pair.shapes))


def reasons(pair):
    """Why each shape of a pair moves as it does."""
    return tuple(shape.reason for shape in pair.shapes)


def turned_move(*paths, degrees=120.0, **options):
    """The move between two documents of such paths that turns, and the pair that it shows."""
    pairs, _ = match_all([drawing(path, **options) for path in paths], Settings())
    (pair,) = (turned(pair, degrees) for pair in pairs)
    return moves_of([pair])[0], pair


def outline(vertices, closed=True):
    """A polygon to draw."""
    segments = cubics.lines(np.asarray(vertices, complex), closed)
    return CubicPath(segments, np.ones(len(segments), bool), closed)


def contour_blend(start, end, cuts, *, grows=False, shrinks=False):
    """A blend from path to path of contours that nobody matched."""
    numbers = None if grows else 0, None if shrinks else 0
    return ContourBlend(*numbers, *[None] * 4, 1.0, 1.0, None, start, end, cuts)


def moving_polygons(*pairs, closed=True):
    """A shape of which each contour goes from polygon to polygon, vertex by vertex; a number stands for a point."""
    contours = []
    for a, b in pairs:
        count = max(np.size(a), np.size(b))
        sides = [outline(np.broadcast_to(z, count), closed) for z in (a, b)]
        places = np.arange(len(sides[0].segments) + 1.0)
        contours.append(
            contour_blend(*sides, (places, places), grows=np.size(a) == 1, shrinks=np.size(b) == 1)
        )
    return ShapeBlend(tuple(contours), Style(), Style())


def similarity_of(shape):
    """The best one between a shape's start and its end, by its nodes."""
    a, b = (
        np.concatenate([getattr(contour, side).segments[:, 0] for contour in shape.contours])
        for side in ("start", "end")
    )
    return align(PointPairs(a, b, np.full(len(a), 1.0 / len(a))))
