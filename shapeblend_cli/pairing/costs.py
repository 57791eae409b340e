"""Costs of turning one contour into another: place, size, paint and work; of having no partner; and the least total."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple, cast

import numpy as np

from shapeblend_cli.geometry.placement import to_unit_box
from shapeblend_cli.options.constants import PAPER, WorkConstants
from shapeblend_cli.wires.rough import few, turning, work_of_few

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.anatomy.decompose import PlacedContour
    from shapeblend_cli.model import BoolArray, ComplexArray, FloatArray

OVERLAP_WEIGHT = 0.65
"""Cost of boxes that do not overlap."""

DISTANCE_WEIGHT = 1.5
"""Cost of a distance as large as the frame, the part around a contour."""

MARGIN = 0.03
"""Margin of boxes on each side, as a share of their frame, so that lines and specks have some area."""

SIZE_WEIGHT = 0.45
"""Cost of a change of size by the factor e."""

MOST_GROWTH = 3.0
"""Maximum change of size that costs more than smaller ones, as a power of e."""

WORK_WEIGHT = 0.5
"""Maximum cost of work."""

WORK_HALF_SATURATION = 10.0
"""Work that costs half the maximum: about that of a circle into a five-pointed star. The cost is the share
work / (work + `WORK_HALF_SATURATION`): shapes that differ in every detail are no worse partners than shapes that differ
in most."""

LIKENESS = WorkConstants(**PAPER)
"""Constants of the work between contours, the paper's: this work does not depend on places. The weights rely on it."""

PAINT_WEIGHT = 0.65
"""Cost of a fill that comes or goes, of a stroke that comes or goes, and of black that becomes white."""

COLOUR_HALF = 0.6
"""Difference of colours, from 0 to 1, that costs rather more than half of black into white: another colour is another
colour."""

ALONE_COST = 0.78
"""Cost of a contour without a partner."""

ALONE_SIZE_COST = 0.35
"""Additional cost of a contour without a partner if it is as large as the drawing."""

MOST_UNEVEN = 2.0
"""Maximum ratio of the scales along both axes of a part that is laid over another."""

CROWD = 600
"""Maximum number of contours whose tables of pairs have all digits; tables of more contours would fill the memory."""

MANY_PAIRS = 10_000
"""Minimum number of pairs of a crowd, whose copies are solved once: the last digits of their work may differ."""

DECIMALS = 7
"""Number of decimals of coordinates in which copies agree, in sizes of the contour."""

ROUNDING = 1e-5
"""Minimum difference of costs that is no rounding, nor that of a crowd."""

MOST_WORKS = 600
"""Maximum number of pairs whose work is compared, about: the cheapest without it."""


class FoundWorks(NamedTuple):
    """What pairings of two drawings have found of the costs of work, by the numbers of contours.

    Of pairs that were not solved in full, it is known beyond which cost they are.
    """

    costs: dict[tuple[int, int], float]
    beyond: dict[tuple[int, int], float]


class Rates(NamedTuple):
    """The two costs that decide how unlike partners may be, and what pairings of the same drawings have found."""

    paint: float = PAINT_WEIGHT
    alone: float = ALONE_COST
    works: FoundWorks | None = None


USUAL = Rates()
"""Costs of all pairings but those that are tried beside another one."""


class Boxes(NamedTuple):
    """Boxes by their centres and half their widths and heights, both as x + iy."""

    centres: ComplexArray
    halves: ComplexArray

    def take(self, chosen: Sequence[int] | slice) -> Boxes:
        """Return some of the boxes."""
        return Boxes(self.centres[chosen], self.halves[chosen])

    def union(self) -> Boxes:
        """Return the one box around all."""
        low, high = self.centres - self.halves, self.centres + self.halves
        lowest = np.array([complex(low.real.min(), low.imag.min())])
        highest = np.array([complex(high.real.max(), high.imag.max())])
        return Boxes((lowest + highest) / 2, (highest - lowest) / 2)


class Described(NamedTuple):
    """Properties of contours to compare, an array each."""

    contours: Sequence[PlacedContour]
    boxes: Boxes
    areas: FloatArray  # (n,), 0 for open contours
    paint: FloatArray  # (n, 2, 3), the channels of fill and stroke from 0 to 1; -1 for no paint

    @classmethod
    def of(cls, contours: Sequence[PlacedContour]) -> Described:
        """Measure contours."""
        from shapeblend_cli.anatomy.structure import corners

        low, high = corners([contour.polygon for contour in contours])
        areas = [contour.area for contour in contours]
        paint = [[channels(c.style.fill), channels(c.style.stroke)] for c in contours]
        boxes = Boxes((low + high) / 2, (high - low) / 2)
        numbers = np.array(areas), np.array(paint).reshape(-1, 2, 3)
        if len(contours) > CROWD:
            boxes = Boxes(*(cast("ComplexArray", points.astype(np.complex64)) for points in boxes))
            numbers = numbers[0].astype(np.float32), numbers[1].astype(np.float32)
        return cls(contours, boxes, *numbers)

    def take(self, chosen: Sequence[int] | slice) -> Described:
        """Return some of the contours."""
        some = self.contours[chosen] if isinstance(chosen, slice) else [self.contours[k] for k in chosen]
        return Described(some, self.boxes.take(chosen), self.areas[chosen], self.paint[chosen])

    def alone(self, whole: Boxes, least: float) -> FloatArray:
        """Return the costs of having no partner, given the box of the drawing and the cost for a speck."""
        share = np.abs(self.boxes.halves) / np.abs(whole.halves)
        return least + ALONE_SIZE_COST * share


def laid(boxes: Boxes, frames: Boxes, onto: Boxes) -> Boxes:
    """Return boxes under the maps of their frames onto others, which scale unevenly within bounds."""
    tiny = 1e-9 * np.maximum(np.abs(frames.halves), np.abs(onto.halves)) + 1e-300
    x = np.maximum(onto.halves.real, tiny) / np.maximum(frames.halves.real, tiny)
    y = np.maximum(onto.halves.imag, tiny) / np.maximum(frames.halves.imag, tiny)
    whole = np.abs(onto.halves) / np.maximum(np.abs(frames.halves), tiny)
    uneven = np.sqrt(MOST_UNEVEN)
    x, y = (np.clip(factor, whole / uneven, whole * uneven) for factor in (x, y))
    offset = boxes.centres - frames.centres
    return Boxes(
        onto.centres + x * offset.real + 1j * y * offset.imag,
        x * boxes.halves.real + 1j * y * boxes.halves.imag,
    )


def overlaps(a: Boxes, b: Boxes, reach: FloatArray) -> FloatArray:
    """Return the common share of each box of `a` and each of `b`, (a, b), with margins in frames of half diagonals."""
    margin = MARGIN * 2.0 * reach
    away = a.centres[:, None] - b.centres
    area_a, area_b, shared = (np.ones(away.shape, margin.dtype) for _ in range(3))
    for offset, p, q in (
        (np.abs(away.real), a.halves.real, b.halves.real),
        (np.abs(away.imag), a.halves.imag, b.halves.imag),
    ):
        half_a, half_b = p[:, None] + margin, q + margin
        area_a, area_b = area_a * half_a, area_b * half_b
        shared *= np.clip(half_a + half_b - offset, 0.0, 2.0 * np.minimum(half_a, half_b)) / 2.0
    return shared / (area_a + area_b - shared)


def place_costs(a: Boxes, b: Boxes, reach: FloatArray) -> FloatArray:
    """Return the costs of moving from each box of `a` to each of `b`, (a, b), in frames with these half diagonals."""
    distance = np.abs(a.centres[:, None] - b.centres) / (2.0 * reach)
    return OVERLAP_WEIGHT * (1.0 - overlaps(a, b, reach)) + DISTANCE_WEIGHT * distance


def size_costs(a: Described, b: Described, laid_a: Boxes) -> FloatArray:
    """Return the costs of boxes and areas that grow or shrink, (a, b), with the boxes of `a` laid over `b`."""
    p, q = np.abs(laid_a.halves), np.abs(b.boxes.halves)
    tiny = 1e-9 * max(p.max(), q.max()) + 1e-300
    growth = np.abs(np.log(np.maximum(p, tiny))[:, None] - np.log(np.maximum(q, tiny)))
    with np.errstate(divide="ignore", invalid="ignore"):
        factor = np.sqrt(
            laid_a.halves.real * laid_a.halves.imag / (a.boxes.halves.real * a.boxes.halves.imag)
        )
        spread = np.abs(np.log(factor * np.sqrt(a.areas))[:, None] - np.log(np.sqrt(b.areas)))
    spread = np.where(np.isfinite(spread), np.minimum(spread, MOST_GROWTH), growth)
    return SIZE_WEIGHT * (np.minimum(growth, MOST_GROWTH) + spread) / 2


def paint_costs(a: Described, b: Described, weight: float) -> FloatArray:
    """Return the costs of changing the paint, (a, b), where black into white costs `weight`."""
    (paints_a, in_a), (paints_b, in_b) = (
        np.unique(side.paint, axis=0, return_inverse=True) for side in (a, b)
    )
    p, q = paints_a[:, None], paints_b
    none_p, none_q = p[..., 0] < 0, q[..., 0] < 0
    apart = np.abs(p - q).mean(axis=-1)
    apart = (1.0 + COLOUR_HALF) * apart / (apart + COLOUR_HALF)
    difference = np.where(none_p | none_q, none_p != none_q, apart)
    each: FloatArray = (weight * difference.sum(axis=-1))[np.ix_(in_a.ravel(), in_b.ravel())]
    return each


class Works:
    """Costs of the work between contours, each solved once, when it is wanted."""

    def __init__(self, a: Described, b: Described, found: FoundWorks | None = None) -> None:
        self._a, self._b = a, b
        self._costs = np.full((len(a.contours), len(b.contours)), np.nan, (a.areas[:1] + b.areas[:1]).dtype)
        is_crowd = self._costs.size > MANY_PAIRS
        self._alike = [_alike(side.contours) if is_crowd else range(len(side.contours)) for side in (a, b)]
        self._known, self._known_beyond = found or FoundWorks({}, {})
        self._beyond: dict[tuple[int, int], float] = {}  # costs beyond which this pairing has asked
        # Vertices, and how far they turn, by side, index and whether closed.
        self._few: dict[tuple[int, int, bool], tuple[ComplexArray, float]] = {}

    def costs(
        self, rows: Sequence[int], columns: Sequence[int], cheap: FloatArray, most: FloatArray | None = None
    ) -> FloatArray:
        """Return the costs of the work of pairs, (rows, columns): the highest, `WORK_WEIGHT`, for what is not solved.

        These are pairs whose `cheap` cost is infinite, of too many the dearest, and those that cost more than `most`,
        if that is given: they are made nowhere but among twins, whose costs are added up.
        """
        some = np.ix_(rows, columns)
        wanted = self._worth_solving(cheap)
        for k, m in np.argwhere(wanted & np.isnan(self._costs[some])).tolist():
            i, j = rows[k], columns[m]
            first = self._alike[0][i], self._alike[1][j]
            copies = self._a.contours[first[0]].number, self._b.contours[first[1]].number
            if copies not in self._known:
                self._solve(i, j, copies, np.inf if most is None else float(most[k, m]) + ROUNDING)
            self._costs[i, j] = self._known.get(copies, np.nan)
        known: FloatArray = self._costs[some]
        return np.where(np.isnan(known), WORK_WEIGHT, known)

    def _solve(self, i: int, j: int, copies: tuple[int, int], most: float) -> None:
        """Find the cost of a pair up to a maximum, or whatever it is if it was beyond another maximum before."""
        if most <= self._beyond.get(copies, 0.0):
            return
        limit = np.inf
        if most < WORK_WEIGHT and copies not in self._beyond:
            if most <= self._known_beyond.get(copies, 0.0):
                self._beyond[copies] = most
                return
            limit = WORK_HALF_SATURATION * most / (WORK_WEIGHT - most)
        closed = self._a.contours[i].polygon.closed and self._b.contours[j].polygon.closed
        (p, turning_p), (q, turning_q) = self._outline(0, i, closed), self._outline(1, j, closed)
        work = np.inf
        if LIKENESS.k_b * abs(turning_p - turning_q) <= limit:  # it bends by no less
            work = work_of_few(p, q, closed, LIKENESS, limit)
        if work == np.inf > limit:
            self._beyond[copies] = self._known_beyond[copies] = most
        else:
            self._known[copies] = WORK_WEIGHT * (1.0 - WORK_HALF_SATURATION / (work + WORK_HALF_SATURATION))

    def _outline(self, side: int, index: int, closed: bool) -> tuple[ComplexArray, float]:
        """Return a few vertices of a contour in its unit box, and how far they turn in all."""
        key = side, index, closed
        if key not in self._few:
            vertices = few(to_unit_box((self._a, self._b)[side].contours[index].polygon), closed)
            self._few[key] = vertices, turning(vertices, closed)
        return self._few[key]

    def _worth_solving(self, cheap: FloatArray) -> BoolArray:
        """Return the pairs of finite cost; of too many, the cheapest in each row and column."""
        finite = np.isfinite(cheap)
        if finite.sum() <= MOST_WORKS:
            return finite
        each = max(1, MOST_WORKS // sum(self._costs.shape))
        chosen = np.zeros_like(finite)
        for axis in (0, 1):
            first = cheap.argmin(axis, keepdims=True) if each == 1 else np.argsort(cheap, axis, kind="stable")
            np.put_along_axis(chosen, first.take(range(min(each, first.shape[axis])), axis), True, axis)
        return finite & chosen


def _alike(contours: Sequence[PlacedContour]) -> list[int]:
    """Return the number of the first copy of each contour, wherever it lies and however large it is."""
    first: dict[tuple[bool, bytes], int] = {}
    keys = (
        (contour.polygon.closed, np.round(to_unit_box(contour.polygon), DECIMALS).tobytes())
        for contour in contours
    )
    return [first.setdefault(key, k) for k, key in enumerate(keys)]


def channels(colour: str | None) -> tuple[float, float, float]:
    """Return red, green and blue of ``#rrggbb`` from 0 to 1; -1 where there is no paint."""
    if colour is None:
        return -1.0, -1.0, -1.0
    red, green, blue = bytes.fromhex(colour[1:])
    return red / 255, green / 255, blue / 255


def values_of(excess: FloatArray, focus: FloatArray) -> FloatArray:
    """Return the values of pairs to be minimised, given their costs above having no partner: 0 for no gain.

    Gains are squared, so that one good pair is worth more than two poor ones.
    """
    return -(np.where(excess < 0.0, focus - excess, 0.0) ** 2)
