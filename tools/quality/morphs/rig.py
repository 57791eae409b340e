"""An outline with limbs that turn about their joints, which says how the pose goes from rest to turned.

A limb reaches along the outline from its tip to the two places that are nearest to its joint. Within it the outline
turns by the whole angle, beyond by none, and over a way about each of the two places by a share that rises smoothly:
the angle is shared out, not the points, so a limb keeps its width.
"""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.geometry.polyline import cumulative_lengths, points_at
from tools.quality.truth.write import SIZE, at

if TYPE_CHECKING:
    import random
    from collections.abc import Sequence

    from tools.quality.truth.write import Segments

PLACES = 4000
"""At so many places of the outline the joints are looked for."""

SOFT = 0.6
"""Over this share of the limb's width, before and after, the outline bends at a joint."""

NEAR = 0.02
"""How far cubics may be from the pose."""

STEP = 1e-4
"""Difference of parameters that stands for a derivative."""

CUT = 0.3
"""Share of the curves that B has cut in two, so that its nodes are not all where A has them."""


class Limb(NamedTuple):
    """What turns about what: in the silhouette's box, y downwards, `SIZE` along its larger side.

    Attributes
    ----------
    joint, tip : (float, float)
        A place in the middle of where the limb begins, and one at its end.
    degrees : float
        By how much it turns, clockwise as seen.
    length : float
        By what its length is multiplied.
    """

    joint: tuple[float, float]
    tip: tuple[float, float]
    degrees: float
    length: float = 1.0


class _Bone(NamedTuple):
    """A limb as the outline has it.

    Attributes
    ----------
    middle, reach, soft : float
        Where on the outline its middle is, how far it reaches to both sides, and over how much of that it bends.
    root, along : complex
        The middle between its ends, and the direction from there to the tip.
    """

    middle: float
    reach: float
    soft: float
    root: complex
    along: complex
    limb: Limb


class Rig:
    """A silhouette whose limbs can be turned.

    Parameters
    ----------
    contour : list of array
        Its cubic segments.
    limbs : sequence of Limb
        One that hangs on another comes before it.
    """

    def __init__(self, contour: Segments, limbs: Sequence[Limb]) -> None:
        around = np.concatenate([at(segment, np.arange(16) / 16) for segment in contour])
        corner = complex(around.real.min(), around.imag.min())
        scale = SIZE / max(np.ptp(around.real), np.ptp(around.imag))
        self.contour = [(segment - corner) * scale for segment in contour]
        self.parameters = np.linspace(0.0, 1.0, 129)
        self.lengths = [cumulative_lengths(at(segment, self.parameters)) for segment in self.contour]
        self.starts = np.cumsum([0.0, *(lengths[-1] for lengths in self.lengths)])
        self.whole = float(self.starts[-1])
        fine = np.concatenate([at(segment, self.parameters[:-1]) for segment in self.contour])
        known = np.concatenate(
            [start + lengths[:-1] for start, lengths in zip(self.starts, self.lengths, strict=False)]
        )
        places = np.arange(PLACES) * self.whole / PLACES
        points = points_at(places, np.append(fine, fine[0]), np.append(known, self.whole))
        self.bones = [self._bone(limb, places, points) for limb in limbs]

    def _bone(self, limb: Limb, places: np.ndarray, points: np.ndarray) -> _Bone:
        joint, tip = complex(*limb.joint), complex(*limb.tip)
        middle = int(np.abs(points - tip).argmin())
        turned = np.roll(np.abs(points - joint), -middle)
        half = PLACES // 2
        before, after = half + int(turned[half:].argmin()), int(turned[:half].argmin())
        first, last = before - PLACES, after  # counted from the tip
        ends = points[(middle + first) % PLACES], points[(middle + last) % PLACES]
        step = self.whole / PLACES
        root = (ends[0] + ends[1]) / 2.0
        along = points[middle] - root
        reach = (last - first) / 2.0 * step
        soft = min(SOFT * abs(ends[1] - ends[0]), SOFT * reach)
        centre = places[middle] + (first + last) / 2.0 * step
        return _Bone(centre, reach, soft, root, along / abs(along), limb)

    def pose(self, segment: int, u: np.ndarray, time: float) -> np.ndarray:
        """Where points of a segment are at a time from 0 to 1."""
        points = at(self.contour[segment], u)
        places = self.starts[segment] + np.interp(u, self.parameters, self.lengths[segment])
        for bone in self.bones:
            away = np.abs((places - bone.middle + self.whole / 2.0) % self.whole - self.whole / 2.0)
            share = time * _smooth(0.5 + (bone.reach - away) / (2.0 * bone.soft))
            arm = points - bone.root
            ahead = np.maximum((arm * np.conj(bone.along)).real, 0.0)
            arm = arm + share * (bone.limb.length - 1.0) * ahead * bone.along
            points = bone.root + arm * np.exp(1j * np.radians(bone.limb.degrees) * share)
        return points

    def cubics(self, piece: tuple[int, float, float], time: float) -> np.ndarray:
        """The cubic that has the ends and the directions of a piece of a segment."""
        segment, first, last = piece
        u = np.array([first, first + STEP, last - STEP, last])
        p, ahead, back, q = self.pose(segment, u, time)
        third = (last - first) / (3.0 * STEP)
        return np.array([p, p + (ahead - p) * third, q - (q - back) * third, q])

    def pieces(self, chance: random.Random) -> list[tuple[int, float, float]]:
        """Pieces of segments that stay cubics while limbs turn, nearly; some curves are cut in any case."""
        found: list[tuple[int, float, float]] = []
        for segment, points in enumerate(self.contour):
            bent = np.abs(np.diff(points, 2)).max() > NEAR
            cuts = [chance.uniform(0.3, 0.7)] if bent and chance.random() < CUT else []
            for first, last in pairwise([0.0, *cuts, 1.0]):
                found += self._cut((segment, first, last), chance)
        return found

    def _cut(self, piece: tuple[int, float, float], chance: random.Random) -> list[tuple[int, float, float]]:
        segment, first, last = piece
        u = np.linspace(0.0, 1.0, 17)
        off = max(
            np.abs(
                at(self.cubics(piece, time), u) - self.pose(segment, first + u * (last - first), time)
            ).max()
            for time in (0.5, 1.0)
        )
        if off <= NEAR:
            return [piece]
        middle = first + (last - first) * chance.uniform(0.4, 0.6)
        return self._cut((segment, first, middle), chance) + self._cut((segment, middle, last), chance)

    def outline(self, pieces: Sequence[tuple[int, float, float]], time: float) -> Segments:
        """The pose at a time."""
        return [self.cubics(piece, time) for piece in pieces]


def _smooth(share: np.ndarray) -> np.ndarray:
    """0 up to 0, 1 from 1 on, and a smooth rise between."""
    share = np.clip(share, 0.0, 1.0)
    return share * share * (3.0 - 2.0 * share)
