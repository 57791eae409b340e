"""Straight paths, eq (2): every control point of one outline goes evenly to its partner."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.geometry import cubics
from shapeblend_cli.interpolate.curves import common_segments
from shapeblend_cli.interpolate.track import counted_on
from shapeblend_cli.model import MovingContour, Outline

if TYPE_CHECKING:
    from shapeblend_cli.model import MatchedContour


def moving(matched: MatchedContour, *, curves: bool) -> MovingContour:
    """Two matched contours as outlines that are alike segment for segment.

    Parameters
    ----------
    matched : MatchedContour
    curves : bool
        Segments of the drawings' own curves, see `curves`; otherwise a line for every step of the solver's path.

    Returns
    -------
    MovingContour
        With curves, its ends are the contours; without, the polygons, some of their vertices repeated.
    """
    closed = matched.correspondence.closed
    dots = matched.correspondence.dots
    if curves:
        common = common_segments(
            matched.contour_a, matched.polygon_a, matched.contour_b, matched.polygon_b, dots
        )
        segments_a, segments_b, straight = common.segments_a, common.segments_b, common.straight
        places = common.places_a, common.places_b
    else:
        segments_a = cubics.lines(matched.polygon_a.vertices[dots[:, 0]], closed)
        segments_b = cubics.lines(matched.polygon_b.vertices[dots[:, 1]], closed)
        straight = np.ones(len(segments_a), np.bool_)
        period = len(matched.polygon_a.vertices), len(matched.polygon_b.vertices)
        along = counted_on(dots, period if closed else None)
        places = along[:, 0], along[:, 1]
    return MovingContour(
        start=Outline(segments_a, straight, closed),
        end=Outline(segments_b, straight, closed),
        places=places,
        grows=matched.a is None,
        shrinks=matched.b is None,
    )


def between(contour: MovingContour, t: float) -> Outline:
    """The outline at time t, eq (2); at 0 and 1 exactly the start and the end."""
    segments = (1.0 - t) * contour.start.segments + t * contour.end.segments
    return replace(contour.start, segments=segments)
