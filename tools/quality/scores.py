"""What is said of one blend. A frame is a list of contours, a contour an array of complex vertices, closed."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from shapely import Polygon

if TYPE_CHECKING:
    from collections.abc import Sequence

    Frame = Sequence[np.ndarray]

STEPS = 10
"""A blend is judged at t = 0, .1, ... 1: at the nine in-betweens, beside the ends."""

REPEATED = 1e-6
"""Neighbours nearer than this are one vertex. Drawings are about 100 wide."""

LITTLE = 0.7
"""An in-between with a smaller share than this of the area it should have has shrunk on its way."""


class Score(NamedTuple):
    """One blend, judged.

    Attributes
    ----------
    crossed : bool
        Whether a contour of an in-between crosses or touches itself.
    area_share : float
        The least area of an in-between, as a share of what lies on the straight line between the ends' areas.
    left_out : bool
        Whether an end has fewer contours than its drawing.
    """

    crossed: bool
    area_share: float
    left_out: bool


def area(contour: np.ndarray) -> float:
    """The area inside, whichever way round."""
    return abs(float((contour.conj() * np.roll(contour, -1)).imag.sum())) / 2


def is_crossed(contour: np.ndarray) -> bool:
    """Whether a contour crosses or touches itself. Points and lines, which have no inside, do not."""
    kept = contour[np.abs(contour - np.roll(contour, 1)) > REPEATED]
    return len(kept) > 2 and not Polygon(np.column_stack([kept.real, kept.imag])).is_valid


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
        area_share=area_share(frames),
        left_out=drawn[0] < contours[0] or drawn[1] < contours[1],
    )
