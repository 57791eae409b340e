"""Which motion a shape gets: the one asked for, or the first without a fault."""

from __future__ import annotations

import math
from functools import cache
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.interpolate.paths import moving
from shapeblend_cli.model import MovingShape
from shapeblend_cli.motion.alignment import aligned, matched_points, residual
from shapeblend_cli.motion.faults import COLLAPSE, OVERLAP, Fault, fault
from shapeblend_cli.motion.rigid import Rigid

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from shapeblend_cli.model import MatchedShape
    from shapeblend_cli.motion.alignment import Alignment

ASKED = "asked for"

ROUNDS = 5
"""How often a shape is aligned and matched again, at most; two or three are enough."""

STANDS = 2e-3
"""A turn stands that changes by less, in radians."""

BLURRED, ROUND = 17, 20
"""Levels above which smoothed outlines have only large features left, and hardly any."""

AFFORDABLE = 600
"""Once shapes of so many segments have had other motions tried on them, further ones go straight in any case. That
takes a few seconds; a drawing of hundreds of faulty shapes would take minutes."""

COMMON = 2.0
"""Shapes of a drawing move by one similarity unless it leaves so many times as much as their own."""


class Chosen(NamedTuple):
    """A shape and how it moves.

    Attributes
    ----------
    matched : MatchedShape
    moving : MovingShape
    because : str
        Why it moves so, a phrase.
    """

    matched: MatchedShape
    moving: MovingShape
    because: str


class Chooser(NamedTuple):
    """What the choice of a motion for the shapes of a pair needs to know.

    Attributes
    ----------
    motion : str
        The one asked for, or `auto`.
    curves : bool
        As in `interpolate.paths.moving`.
    times : sequence of float
        Of the frames.
    rematch : callable
        Solves the correspondence of a shape anew, with B turned back by an angle.
    turned : float or None
        By what angle B is A turned, if it is that as a whole; the shapes have been matched so.
    """

    motion: str
    curves: bool
    times: Sequence[float]
    rematch: Callable[[MatchedShape, float], MatchedShape]
    turned: float | None

    def choose(self, shapes: Sequence[MatchedShape]) -> list[Chosen]:
        """The motion of each shape."""
        paired = [any(c.a is not None and c.b is not None for c in shape.contours) for shape in shapes]
        chosen = [
            Chosen(shape, self._moving(shape), ASKED if pair else "a point at one end")
            for shape, pair in zip(shapes, paired, strict=True)
        ]
        if self.motion == "linear":
            return chosen
        common = None
        if self.turned is not None or len(shapes) > 1:
            common = aligned(matched_points([contour for shape in shapes for contour in shape.contours]))
        numbers = [k for k, pair in enumerate(paired) if pair]
        if self.motion != "auto":
            for k in numbers:
                chosen[k] = self._makers(chosen[k], common)[self.motion]()
        elif self.turned is not None and common is not None:
            because = f"B is A turned by {np.degrees(common.turn):.3g} degrees"
            for k in numbers:
                chosen[k] = self._first_without_fault(chosen[k], because, None, common)
        else:
            self._mend(chosen, numbers, common)
        return chosen

    def _mend(self, chosen: list[Chosen], numbers: Sequence[int], common: Alignment | None) -> None:
        """Replace the motion of shapes whose straight paths have a fault, the largest first, while it is affordable."""
        faulty = []
        for k in numbers:
            found = fault(chosen[k].moving, self.times)
            if found is None:
                chosen[k] = chosen[k]._replace(because="no fault")
            else:
                faulty.append((k, found))
        left = AFFORDABLE
        for k, found in sorted(faulty, key=lambda one: -_size(chosen[one[0]].matched)):
            because = f"linear: {found.says}"
            if left > 0:
                left -= sum(len(contour.start.segments) for contour in chosen[k].moving.contours)
                chosen[k] = self._first_without_fault(chosen[k], because, found, common)
            else:
                chosen[k] = chosen[k]._replace(
                    because=f"{because}; too many shapes to try another motion on each"
                )

    def _makers(self, straight: Chosen, common: Alignment | None) -> dict[str, Callable[[], Chosen]]:
        """What makes the other motions of a shape, by their names."""

        @cache
        def turned_back() -> _Way:
            matched, alignment = self._aligned(straight.matched, common)
            return _Way(matched, self._moving(matched), alignment)

        return {
            "rigid": lambda: _rigid(turned_back()),
            "intrinsic": lambda: _intrinsic(turned_back()),
            "safe": lambda: _safe(straight, turned_back),
        }

    def _first_without_fault(
        self, straight: Chosen, because: str, found: Fault | None, common: Alignment | None
    ) -> Chosen:
        """The first motion without a fault; if all have some, the first with the least.

        Parameters
        ----------
        straight : Chosen
        because : str
            Why straight paths will not do.
        found : Fault or None
            Theirs; without one they come into question no more.
        common : Alignment or None
        """
        reasons = [because]
        seen = [] if found is None else [(straight, found)]
        for name, make in self._makers(straight, common).items():
            chosen = make()
            faults = [fault(chosen.moving, self.times), _blurred(chosen.moving)]
            found = max(filter(None, faults), key=lambda one: one.rank, default=None)
            if found is None:
                return chosen._replace(because="; ".join(reasons))
            reasons.append(f"{name}: {found.says}")
            seen.append((chosen, found))
        least, _ = min(seen, key=lambda one: one[1].rank)
        return least._replace(because="; ".join(reasons))

    def _moving(self, shape: MatchedShape) -> MovingShape:
        """The shape on straight paths."""
        contours = tuple(moving(contour, curves=self.curves) for contour in shape.contours)
        return MovingShape(contours, shape.style_a, shape.style_b)

    def _aligned(self, shape: MatchedShape, common: Alignment | None) -> tuple[MatchedShape, Alignment]:
        """Align, match, align again until the turn stands."""
        if self.turned is not None and common is not None:
            return shape, common
        own = aligned(matched_points(shape.contours))
        if common is not None and _is_as_good(common, own, shape):
            return self.rematch(shape, common.turn), common
        for _ in range(ROUNDS):
            turn = own.turn
            shape = self.rematch(shape, turn)
            own = aligned(matched_points(shape.contours))
            if abs(own.turn - turn) < STANDS:
                break
        return shape, own


class _Way(NamedTuple):
    """A shape matched with B turned back, on straight paths, and the similarity that is to be taken apart."""

    matched: MatchedShape
    moving: MovingShape
    alignment: Alignment


def _rigid(way: _Way, because: str = ASKED) -> Chosen:
    return Chosen(way.matched, way.moving._replace(motion=Rigid(way.alignment)), because)


# What takes a while to import, and most blends do without, is imported where it is wanted.


def _intrinsic(way: _Way) -> Chosen:
    from shapeblend_cli.motion.intrinsic import intrinsic

    motion = intrinsic(way.moving.contours, way.alignment)
    return Chosen(way.matched, way.moving._replace(motion=motion), ASKED)


def _safe(straight: Chosen, turned_back: Callable[[], _Way]) -> Chosen:
    """The cheapest way over the map, of the correspondences found with B as it is and turned back."""
    from shapeblend_cli.motion.safe import plan, safe

    here = plan(straight.moving, aligned(matched_points(straight.matched.contours)))
    if here is not None and here.is_level:
        return Chosen(straight.matched, safe(here), ASKED)
    way = turned_back()
    there = plan(way.moving, way.alignment, math.inf if here is None else here.cost)
    if there is not None:
        return Chosen(way.matched, safe(there), ASKED)
    if here is not None:
        return Chosen(straight.matched, safe(here), ASKED)
    return _rigid(way, "no way without crossings was found")


def _size(shape: MatchedShape) -> float:
    """Of the larger side of its largest contour's box."""
    return max(max(contour.scale_a, contour.scale_b) for contour in shape.contours)


def _is_as_good(common: Alignment, own: Alignment, shape: MatchedShape) -> bool:
    points = matched_points(shape.contours)
    return residual(points, common) <= COMMON * residual(points, own)


def _blurred(shape: MovingShape) -> Fault | None:
    """What smoothing takes away on the way, if that is too much."""
    heights = getattr(shape.motion, "heights", None)
    if heights is None or heights.max() <= BLURRED:
        return None
    if heights.max() > ROUND:
        return Fault(COLLAPSE, "nothing but round outlines half way")
    return Fault(OVERLAP, "details are smoothed away half way")
