"""What is said of one blend. A frame is a list of contours, a contour an array of complex vertices, closed."""

from __future__ import annotations

from itertools import combinations
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from shapely import Polygon, make_valid

from shapeblend_cli.geometry.polygons import signed_area

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapely.geometry.base import BaseGeometry

    Frame = Sequence[np.ndarray]

STEPS = 10
"""A blend is judged at t = 0, .1, ... 1: at the nine in-betweens, beside the ends."""

REPEATED = 1e-6
"""Neighbours nearer than this are one vertex. Drawings are about 100 wide."""

DEPTH = 0.01
"""Contours overlap that do so by more than this. Files have three decimals, and what touches may be off by that."""

LITTLE = 0.7
"""An in-between with a smaller share than this of the area it should have has shrunk on its way."""


class Score(NamedTuple):
    """One blend, judged.

    Attributes
    ----------
    crossed : bool
        Whether a contour of an in-between crosses or touches itself.
    overlapping : bool
        Whether two contours of an in-between cross each other.
    area_share : float
        The least area of an in-between, as a share of what lies on the straight line between the ends' areas.
    left_out : bool
        Whether an end has fewer contours than its drawing.
    """

    crossed: bool
    overlapping: bool
    area_share: float
    left_out: bool


def area(contour: np.ndarray) -> float:
    """The area inside, whichever way round."""
    return abs(signed_area(contour))


def is_crossed(contour: np.ndarray) -> bool:
    """Whether a contour crosses or touches itself. Points and lines, which have no inside, do not."""
    polygon = _polygon(contour)
    return polygon is not None and not polygon.is_valid


def is_overlapping(frame: Frame) -> bool:
    """Whether two contours cross each other: each is partly in the other and partly outside, by more than `DEPTH`."""
    insides = [inside(contour) for contour in frame if _polygon(contour) is not None]
    return any(
        p.overlaps(q) and all(_is_thick(part) for part in (p & q, p - q, q - p))
        for p, q in combinations(insides, 2)
    )


def _polygon(contour: np.ndarray) -> Polygon | None:
    """A contour as shapely has it, unless it is a point or a line."""
    kept = contour[np.abs(contour - np.roll(contour, 1)) > REPEATED]
    return Polygon(np.column_stack([kept.real, kept.imag])) if len(kept) > 2 else None


def inside(contour: np.ndarray) -> BaseGeometry:
    """What a contour encloses, by the even-odd rule where it crosses itself."""
    polygon = _polygon(contour) or Polygon()
    return polygon if polygon.is_valid else make_valid(polygon).buffer(0.0)


def _is_thick(part: BaseGeometry) -> bool:
    return not part.buffer(-DEPTH / 2.0).is_empty


def area_share(frames: Sequence[Frame]) -> float:
    """The least of the in-betweens' areas, each as a share of the straight line between the ends' areas."""
    areas = np.array([sum(area(contour) for contour in frame) for frame in frames])
    straight = np.linspace(areas[0], areas[-1], len(areas))
    return float((areas / np.maximum(straight, 1e-12))[1:-1].min())


def score(frames: Sequence[Frame], contours: tuple[int, int]) -> Score:
    """Judge a blend by its frames at even times, both ends among them.

    Parameters
    ----------
    frames : sequence of frames
    contours : (int, int)
        How many the two drawings have.
    """
    drawn = [sum(area(contour) > 0.0 for contour in frames[end]) for end in (0, -1)]
    return Score(
        crossed=any(is_crossed(contour) for frame in frames[1:-1] for contour in frame),
        overlapping=any(is_overlapping(frame) for frame in frames[1:-1]),
        area_share=area_share(frames),
        left_out=drawn[0] < contours[0] or drawn[1] < contours[1],
    )
