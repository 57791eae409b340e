"""Grades of strips, from 0, as a designer would have drawn it by hand, to 3, unusable."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from shapeblend_cli.grading.features import Features, features, shares
from shapeblend_cli.grading.measures import measures
from shapeblend_cli.grading.seen import look
from shapeblend_cli.grading.trees import tree_grade
from shapeblend_cli.grading.weights import BASE, GOOD, TOGETHER, WEIGHTS

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.grading.seen import Seen
    from shapeblend_cli.model import FloatArray, PictureArray

FRAMES = 7
"""Number of frames of the strips that people graded: longer ones are thinned."""

WORST = 3.0
"""Grade of what is unusable."""

POOR = 2.0
"""Minimum grade that people should be told of."""

NAMES = ("as drawn by hand", "good, with a small flaw", "flawed", "unusable")

TOLD = 0.15
"""Minimum part of a grade that is told as its reason."""

PHRASES = {
    "edges_lost": "lines and detail melt away",
    "size_off": "the drawing swells or shrinks on the way",
    "lumps": "something swells to a lump",
    "slivers": "thin slivers are left over",
    "spikes": "outlines grow spikes",
    "notches": "outlines get notches and slots",
    "directions": "lines tilt, bend or wobble",
    "lopsided": "a symmetry is lost",
    "patches": "parts or colours are there twice, or break up",
    "pieces": "loose pieces float about",
    "pop": "something changes suddenly",
    "detail": "there is much detail",
}
"""The features as people see them."""


class Grade(NamedTuple):
    """A grade, from 0 to 3, and its main reason, if it has one."""

    number: float
    why: str | None

    @property
    def name(self) -> str:
        """The grade in words."""
        return NAMES[round(self.number)]

    @property
    def is_poor(self) -> bool:
        """Whether people should be told."""
        return self.number >= POOR

    def as_json(self) -> dict[str, Any]:
        """Return its number, its name, and its reason."""
        return {"number": round(self.number, 2), "name": self.name, "why": self.why}


def grade(strip: Sequence[PictureArray]) -> Grade:
    """Grade a strip of three pictures or more, each (4, h, w), of which the longer side is that of all pictures."""
    return grade_of_seen(seen_in(strip))


def seen_in(strip: Sequence[PictureArray]) -> Seen:
    """Return what is seen in a strip of three pictures or more, as in `grade`.

    If all corners of the first and the last picture have one opaque colour, this is taken for the ground.
    """
    return look(_prepared(strip))


def grade_of_seen(seen: Seen) -> Grade:
    """Return the grade of what is seen, by regression trees; the reason is its worst fault."""
    if not seen.steps.any():
        return Grade(0.0, None)  # nothing changes, so nothing is wrong
    found = weighed(features(seen))
    number = tree_grade(np.append(measures(seen), found.number))
    return Grade(min(max(number, 0.0), WORST), found.why)


def sum_of_faults(seen: Seen) -> float:
    """Return the weighted sum of the faults that are seen, from 0 to 3, by which ways to blend two drawings compare.

    It goes up evenly with every fault, as trees do not: their steps would decide between ways that are nearly the same.
    """
    return weighed(features(seen)).number


def _prepared(strip: Sequence[PictureArray]) -> Sequence[PictureArray]:
    """Return at most `FRAMES` pictures of a strip, without their ground, in squares."""
    places = np.rint(np.linspace(0, len(strip) - 1, min(len(strip), FRAMES))).astype(int)
    places = places[np.append(True, np.diff(places) > 0)]  # np.unique would load numpy.ma first
    # The corners of what lies around a picture that is no square would say nothing of its ground.
    return [squared(picture) for picture in without_ground([strip[k] for k in places.tolist()])]


def weighed(amounts: Features) -> Grade:
    """Return the grade that features add up to, and the one that adds most."""
    found = shares(np.array(amounts))
    beside = _beside(found)
    number = BASE + float(found @ (np.array(WEIGHTS) + 0.5 * beside))
    parts = (found - np.array(GOOD)) * (np.array(WEIGHTS) + beside)
    parts[Features._fields.index("detail")] = 0.0  # no fault of what lies between
    worst = int(parts.argmax())
    why = PHRASES[Features._fields[worst]] if parts[worst] >= TOLD else None
    return Grade(min(max(number, 0.0), WORST), why)


def _beside(found: FloatArray) -> FloatArray:
    """Return how much more each feature weighs because of the others: shares times `TOGETHER`."""
    more = dict.fromkeys(Features._fields, 0.0)
    values = dict(zip(Features._fields, found.tolist(), strict=True))
    for (one, other), weight in TOGETHER.items():
        more[one] += weight * values[other]
        more[other] += weight * values[one]
    return np.array(list(more.values()))


def without_ground(strip: Sequence[PictureArray]) -> Sequence[PictureArray]:
    """Return pictures whose ground, if both ends have the same one, is transparent."""
    corners = np.stack([strip[k][:, [0, 0, -1, -1], [0, -1, 0, -1]] for k in (0, -1)])
    if corners[:, 3].min() < 0.99 or np.ptp(corners, axis=(0, 2)).max() > 0.02:
        return strip
    ground = corners[0, :, 0, None, None]
    return [np.where(np.abs(picture - ground).max(axis=0) > 0.06, picture, 0.0) for picture in strip]


def squared(picture: PictureArray) -> PictureArray:
    """Return a picture in the middle of the smallest square around it."""
    height, width = picture.shape[1:]
    side = max(height, width)
    if height == width:
        return picture
    found = np.zeros((len(picture), side, side), picture.dtype)
    top, left = (side - height) // 2, (side - width) // 2
    found[:, top : top + height, left : left + width] = picture
    return found
