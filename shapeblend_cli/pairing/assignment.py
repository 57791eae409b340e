"""The contours of two drawings paired at the least total cost, from the outermost in."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.anatomy.decompose import HOLE, PlacedContour
from shapeblend_cli.anatomy.twins import anatomy_of
from shapeblend_cli.geometry.grouping import assign
from shapeblend_cli.pairing.costs import (
    CROWD,
    USUAL,
    Boxes,
    Described,
    Rates,
    Works,
    laid,
    overlaps,
    paint_costs,
    place_costs,
    size_costs,
    values_of,
)

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import BoolArray, Box, FloatArray, IntArray

    Numbers = tuple[int, int]

LEVEL_COST = 0.2
"""Cost of each level of difference in nesting between partners, two at most."""

STRAY_COST = 0.45
"""Cost of a contour that lies outside of the partner of the part around it; half of it outside costs half."""

SIDE_COST = 0.6
"""Cost of a twin that changes sides."""

AXIS_COST = 0.7
"""Cost of a twin whose partner lies on the axis."""

TWIN_GAIN = 0.2
"""Gain of a contour whose twin becomes its partner's twin."""

FOCUS_GAIN = 1.2
"""Gain of a pair in the middle of the contours around it, where there is a choice: a face rather loses its brows than
its eyes."""

FOCUS_REACH = 0.5
"""Maximum distance from that middle at which there is a gain, as a share of half the diagonal."""

INNER_GAIN = 0.6
"""Gain, where there is a choice, of a pair of twins that are both the nearest to the middle on their sides: eyes rather
than brows above or cheeks beside them."""

OUTER_GAIN = 0.3
"""Maximum additional cost of a pair to be taken instead of a pair inside it: the white of an eye instead of its pupil,
a mouth instead of its teeth."""

BESIDE = 0.15
"""Minimum distance from the axis of a contour beside it, as a share of half the drawing's width."""

KIN_GAIN = 0.3
"""Gain of a pair whose contours resemble another pair's: a wheel rather becomes a wheel if others do."""

KIN_SIZE = 1.5
"""Maximum ratio of the sizes of contours that are alike."""

LONELY_COST = 0.3
"""Cost of pairing a twin with a twin while their siblings are not paired."""

MOST_COMPARED = 40_000
"""Maximum number of pairs of undecided contours, open or not, that are all compared each time."""

LOOK_AHEAD = 2
"""Number of levels inside the open contours that are compared where there are more pairs: a nest has hundreds."""

AT_ONCE = 1 << 16
"""Number of pairs whose costs are computed at once: few enough to stay in the cache, and of little memory."""

NEVER = 1e6
"""Cost of a pair that cannot be: more than the cost of any number of others."""


class _Side:
    """One drawing's contours and the decisions on them, by places in the sequence."""

    def __init__(self, contours: Sequence[PlacedContour], frame: Box | None, alone: float) -> None:
        self.described = Described.of(contours)
        self.whole = self.described.boxes.union()
        if frame is not None:
            half = complex(frame.width, frame.height) / 2
            self.whole = Boxes(np.array([frame.centre]), np.array([half]))
        self.structure, self.mirror = anatomy_of(contours)
        codes: dict[object, int] = {}
        kinds = (
            (c.role, c.style.fill is None, c.style.stroke is None, parent)
            for c, parent in zip(contours, self.structure.parent, strict=True)
        )
        self.kinds = np.array([codes.setdefault(kind, len(codes)) for kind in kinds])
        self.alone = self.described.alone(self.whole, alone)
        self.twins = self.mirror.twins(contours) if self.mirror else []
        away = [self._away(k) for k in range(len(contours))]
        self.focus = self._focus(away)
        self.inner = self._inner(away)
        self.paired: set[int] = set()
        self.onto: dict[int, int] = {}  # partners of parts, by part
        self.passed: set[int] = set()

    def _away(self, k: int) -> float:
        """Return the distance of a contour from the middle of its parent, as a share of half the parent's diagonal."""
        boxes, parent = self.described.boxes, self.structure.parent[k]
        if parent is None:
            return 0.0
        return float(abs(boxes.centres[k] - boxes.centres[parent]) / abs(boxes.halves[parent]))

    def _focus(self, away: Sequence[float]) -> FloatArray:
        """Return how near each contour, and each contour around it, is to the middle of its parent."""
        around = [self.structure.ancestors(k) for k in range(len(away))]
        furthest = [
            max(away[i] for i in (k, *outer)) if outer else FOCUS_REACH for k, outer in enumerate(around)
        ]
        return np.clip(FOCUS_REACH - np.array(furthest, self.alone.dtype), 0.0, None)

    def _inner(self, away: Sequence[float]) -> FloatArray:
        """Return 1 for twins that are both the nearest to the middle of their parents on their sides, else 0."""
        nearest: dict[tuple[int, bool], tuple[float, int]] = {}
        for k, parent in enumerate(self.structure.parent):
            if self.mirror is not None and parent is not None and self.beside_axis(k):
                side = parent, bool(self.described.boxes.centres[k].real > self.mirror.x)
                nearest[side] = min(nearest.get(side, (np.inf, k)), (away[k], k))
        found = {k for _, k in nearest.values()}
        inner = np.zeros(len(away), self.alone.dtype)
        inner[[k for twins in self.twins if found.issuperset(twins) for k in twins]] = 1.0
        return inner

    def undecided(self) -> list[int]:
        return [k for k in range(len(self.alone)) if k not in self.paired]

    def is_open(self, k: int) -> bool:
        """Return whether the parent of a contour is decided."""
        before = self._before(k)
        return before is None or before in self.paired or before in self.onto or before in self.passed

    def _before(self, k: int) -> int | None:
        """Return the contour that is decided before a contour: its parent, or the first with the same outline."""
        first = self.structure.same[k]
        return self.structure.parent[k] if first == k else first

    def nearly_open(self) -> list[int]:
        """Return the undecided contours at most `LOOK_AHEAD` levels inside open ones."""
        found = []
        for k in self.undecided():
            at: int | None = k
            for _ in range(LOOK_AHEAD):
                if at is not None and not self.is_open(at):
                    at = self._before(at)
            if at is None or self.is_open(at):
                found.append(k)
        return found

    def twins_among(self, some: Sequence[int]) -> IntArray:
        """Return the twins among some contours, by their places there, the left one first, (p, 2)."""
        at = {k: place for place, k in enumerate(some)}
        pairs = [(at[i], at[j]) for i, j in self.twins if i in at and j in at]
        return np.array(pairs, np.intp).reshape(-1, 2)

    def is_on_axis(self, k: int) -> bool:
        """Return whether a contour is its own mirror image."""
        return self.mirror is not None and self.mirror.twin[k] == k

    def has_twin(self, k: int) -> bool:
        """Return whether a contour has a mirror image beside it."""
        return self.mirror is not None and self.mirror.twin[k] not in (None, k)

    def beside_axis(self, k: int) -> float:
        """Return 1 for a twin, a half for another contour clearly to one side of the axis, else 0."""
        if self.mirror is None or self.is_on_axis(k):
            return 0.0
        away = abs(self.described.boxes.centres[k].real - self.mirror.x)
        return 1.0 if self.has_twin(k) else 0.5 if away > BESIDE * self.whole.halves[0].real else 0.0

    def part(self, k: int) -> tuple[int, int]:
        """Return the innermost paired contour around a contour, -1 for none, and the number of others between."""
        ancestors = self.structure.ancestors(k)
        for depth, part in enumerate(ancestors):
            if part in self.onto:
                return part, depth
        return -1, len(ancestors)

    def alike(self, some: Sequence[int], others: Sequence[int]) -> tuple[BoolArray, BoolArray]:
        """Return which contours are of one size, role and kind of paint in one contour, and which of one paint."""
        described, kinds = self.described, self.kinds
        sizes = np.log([np.abs(described.boxes.halves) + 1e-300, np.sqrt(described.areas) + 1e-300])
        apart = np.abs(sizes[:, some, None] - sizes[:, None, others]).max(axis=0)
        alike = (kinds[some][:, None] == kinds[others]) & (apart <= np.log(KIN_SIZE))
        return alike, (described.paint[some][:, None] == described.paint[others]).all(axis=(2, 3))

    def boxes_of(self, parts: IntArray) -> Boxes:
        """Return the boxes of parts; for -1 the box of the drawing."""
        boxes = self.described.boxes
        return Boxes(
            np.where(parts < 0, self.whole.centres, boxes.centres[parts]),
            np.where(parts < 0, self.whole.halves, boxes.halves[parts]),
        )


class _Seen(NamedTuple):
    """Some contours of a side, with the parts around them and what these are laid over, an array or `Boxes` each."""

    described: Described
    depths: IntArray  # how many contours lie between each and the part
    onto: IntArray  # the partner of the part, -1 for the whole drawing
    same: IntArray  # the first contour of one outline
    becomes: IntArray  # its partner, or -1
    frames: Boxes  # of the parts
    there: Boxes  # the contours themselves, with their frames laid over the partners of these

    @classmethod
    def of(cls, side: _Side, other: _Side, some: Sequence[int]) -> _Seen:
        """Look at some contours of a side."""
        described = side.described.take(some)
        parts, depths = np.array([side.part(k) for k in some], np.intp).T
        onto = np.array([side.onto.get(part, -1) for part in parts.tolist()])
        same = [side.structure.same[k] for k in some]
        becomes = np.array([side.onto.get(k, -1) for k in same])
        frames = side.boxes_of(parts)
        there = laid(described.boxes, frames, other.boxes_of(onto))
        return cls(described, depths, onto, np.array(same), becomes, frames, there)

    def take(self, part: slice) -> _Seen:
        """Return a part of these contours."""
        numbers = (self.depths[part], self.onto[part], self.same[part], self.becomes[part])
        return _Seen(self.described.take(part), *numbers, self.frames.take(part), self.there.take(part))


class Pairing:
    """The contours of two drawings and the pairs decided so far, by places in the sequences."""

    def __init__(
        self,
        a: Sequence[PlacedContour],
        b: Sequence[PlacedContour],
        fixed: dict[int, int],
        frames: tuple[Box, Box] | None = None,
        rates: Rates = USUAL,
    ) -> None:
        frame_a, frame_b = frames or (None, None)
        self.a, self.b = _Side(a, frame_a, rates.alone), _Side(b, frame_b, rates.alone)
        self.partner: dict[int, int] = {}
        self._is_rest = frames is not None
        self._kin_gain = 0.0
        self._is_crowd = min(len(a), len(b)) > CROWD  # where kin of kin are not looked for
        self._works = Works(self.a.described, self.b.described, rates.works)
        self._paint = paint_costs(self.a.described, self.b.described, rates.paint)
        roles = np.array([contour.role for contour in a]), np.array([contour.role for contour in b])
        self._fit = roles[0][:, None] == roles[1]
        outer = [side != HOLE for side in roles]
        # An open contour that is filled is seen as a closed one.
        filled = [
            own & [contour.style.fill is not None for contour in side]
            for own, side in zip(outer, (a, b), strict=True)
        ]
        self._fit |= filled[0][:, None] & filled[1]
        if not self._fit[np.ix_(*outer)].any():
            self._fit |= outer[0][:, None] & outer[1]
        in_a, in_b = ({contour.number: k for k, contour in enumerate(side)} for side in (a, b))
        self._exterior = [
            [-1 if contour.exterior is None else numbers.get(contour.exterior, -1) for contour in side]
            for side, numbers in ((a, in_a), (b, in_b))
        ]
        for i, j in fixed.items():
            self._decide(in_a[i], in_b[j])

    def from_outermost_in(self) -> None:
        """Decide all pairs: first of contours that lie in no other, then of contours that lie in decided ones.

        What is left is paired once more, now that kinds of contours have partners.
        """
        self._decide_all()
        self._kin_gain = KIN_GAIN
        self._decide_all()

    def _decide_all(self) -> None:
        while True:
            found = self._cheaper_than_alone()
            now_open = [{k for k in side.undecided() if side.is_open(k)} for side in (self.a, self.b)]
            for i, j in found:
                if i in now_open[0] and j in now_open[1]:
                    self._decide(i, j)
            fresh = [some - side.passed for side, some in zip((self.a, self.b), now_open, strict=True)]
            for side, some in zip((self.a, self.b), fresh, strict=True):
                side.passed |= some
            if not any(fresh) and (not found or not self._kin_gain or self._is_crowd):
                break

    def overlap(self, i: int, j: int) -> float:
        """Return the common share of a pair's boxes, as drawn or with the parts around them laid over each other."""
        a, b = self.a, self.b
        part_a, _ = a.part(i)
        box_a, box_b = a.described.boxes.take([i]), b.described.boxes.take([j])
        onto = b.boxes_of(np.array([a.onto.get(part_a, -1)]))
        there = laid(box_a, a.boxes_of(np.array([part_a])), onto)
        reach = np.abs(onto.halves)
        return float(max(overlaps(box, box_b, reach)[0, 0] for box in (box_a, there)))

    def _decide(self, i: int, j: int) -> None:
        self.partner[i] = j
        self.a.paired.add(i)
        self.b.paired.add(j)
        i, j = self.a.structure.same[i], self.b.structure.same[j]
        if i not in self.a.onto and j not in self.b.onto:
            self.a.onto[i], self.b.onto[j] = j, i

    def _cheaper_than_alone(self) -> list[Numbers]:
        """Pair undecided contours at the least total cost; a contour that costs less alone gets no partner."""
        rows, columns = self.a.undecided(), self.b.undecided()
        if len(rows) * len(columns) > MOST_COMPARED:
            rows, columns = self._likely()
        if not rows or not columns:
            return []
        # A pair of very different sizes saves less: most of the larger contour appears or disappears anyway.
        both = self.a.alone[rows][:, None], self.b.alone[columns]
        alone = 1.5 * np.minimum(*both) + 0.5 * np.maximum(*both)
        focus = FOCUS_GAIN * np.minimum(self.a.focus[rows][:, None], self.b.focus[columns])
        focus += INNER_GAIN * self.a.inner[rows][:, None] * self.b.inner[columns]
        costs = self._cheap_costs(rows, columns)
        fit = self._fit[np.ix_(rows, columns)] & self._inside_partners(rows, columns)
        changes = self._axis_costs(rows, columns) - self._kin_gains(rows, columns)

        def excess_of(most: FloatArray | None) -> FloatArray:
            works = self._works.costs(rows, columns, np.where(fit & (costs < alone), costs, np.inf), most)
            return np.where(fit, costs + works + changes - alone, costs.dtype.type(NEVER))

        twins = [side.twins_among(some) for side, some in ((self.a, rows), (self.b, columns))]
        excess = excess_of(None if all(map(len, twins)) else alone - costs - changes)
        found = _twins_with_twins(excess, focus, *twins)
        left = excess.copy()
        for i, j in found:
            left[i], left[:, j] = NEVER, NEVER
        left[np.ix_(*(pairs.ravel() for pairs in twins))] += LONELY_COST
        value = values_of(left, focus)
        found += [(i, j) for i, j in assign(value) if value[i, j] < 0.0]
        sides = (self.a, rows), (self.b, columns)
        found = _outer_first(found, excess, *sides)
        found = [(i, j) for j, i in _outer_first([(j, i) for i, j in found], excess.T, *sides[::-1])]
        if not found and not self.partner and not self._is_rest:
            found = [divmod(int(excess_of(None).argmin()), len(columns))]
        return [(rows[i], columns[j]) for i, j in found]

    def _likely(self) -> tuple[list[int], list[int]]:
        """Return the contours of a crowd that are open, or nearly: two that were passed over are not compared again."""
        rows, columns = self.a.nearly_open(), self.b.nearly_open()
        new_a, new_b = (
            [k for k in some if k not in side.passed] for side, some in ((self.a, rows), (self.b, columns))
        )
        if new_a and not new_b:
            return new_a, columns
        return (rows, new_b) if new_b and not new_a else (rows, columns)

    def _kin_gains(self, rows: Sequence[int], columns: Sequence[int]) -> FloatArray | float:
        """Return the gains of pairs that resemble a decided pair, with both of its colours or neither."""
        if not self._kin_gain:
            return 0.0
        near_a, near_b = (
            set(side.kinds[some].tolist()) for side, some in ((self.a, rows), (self.b, columns))
        )
        pairs = [
            (i, j) for i, j in self.partner.items() if self.a.kinds[i] in near_a and self.b.kinds[j] in near_b
        ]
        (kin_a, same_a), (kin_b, same_b) = (
            side.alike(some, [pair[k] for pair in pairs])
            for k, (side, some) in enumerate(((self.a, rows), (self.b, columns)))
        )
        both = (kin_a & same_a).astype(np.float32) @ (kin_b & same_b).astype(np.float32).T
        neither = (kin_a & ~same_a).astype(np.float32) @ (kin_b & ~same_b).astype(np.float32).T
        return np.where(both + neither > 0.0, self.a.alone.dtype.type(self._kin_gain), 0)

    def _inside_partners(self, rows: Sequence[int], columns: Sequence[int]) -> BoolArray:
        """Return which contours may be partners: not holes in exteriors that have other partners."""
        around_a, around_b = (
            np.array([side[k] for k in some])
            for side, some in zip(self._exterior, (rows, columns), strict=True)
        )
        becomes = np.array([-1 if k < 0 else self.partner.get(k, -2) for k in around_a.tolist()])
        return (becomes[:, None] == around_b) | (around_a[:, None] < 0) | (around_b < 0)

    def _cheap_costs(self, rows: Sequence[int], columns: Sequence[int]) -> FloatArray:
        """Return the costs of pairs without their work, computed for some rows after the others."""
        a, b = self.a, self.b
        seen_a, seen_b = _Seen.of(a, b, rows), _Seen.of(b, a, columns)
        costs = np.empty((len(rows), len(columns)), a.described.areas.dtype)
        step = 1 + AT_ONCE // len(columns)
        for first in range(0, len(rows), step):
            part = slice(first, first + step)
            p, q = seen_a.take(part), seen_b
            strays = _out_of(b, columns, p.onto) + _out_of(a, rows[part], q.onto).T
            # An outline that is drawn twice becomes one that is drawn twice.
            known = (p.becomes >= 0)[:, None] | (q.becomes >= 0)
            strays = strays + (known & (p.becomes[:, None] != q.same))
            levels = np.abs(p.depths[:, None] - q.depths)
            half_p, half_q = np.abs(p.frames.halves), np.abs(q.frames.halves)
            carried = (
                place_costs(p.there, q.described.boxes, half_q)
                + place_costs(q.there, p.described.boxes, half_p).T
                + size_costs(p.described, q.described, p.there)
                + size_costs(q.described, p.described, q.there).T
            ) / 2
            reach = np.sqrt(half_p[:, None] * half_q)
            at_rest = place_costs(p.described.boxes, q.described.boxes, reach)
            at_rest += size_costs(p.described, q.described, p.described.boxes)
            costs[part] = (
                np.minimum(carried, at_rest)
                + self._paint[np.ix_(rows[part], columns)]
                + LEVEL_COST * np.minimum(levels, 2)
                + STRAY_COST * strays
            )
        return costs

    def _axis_costs(self, rows: Sequence[int], columns: Sequence[int]) -> FloatArray | float:
        """Return costs of pairs that leave an axis or come to it, less the gains of pairs whose twins are paired."""
        if self.a.mirror is None or self.b.mirror is None:
            return 0.0
        sides, dtype = ((self.a, rows), (self.b, columns)), self.a.alone.dtype
        on_axis = [np.array([side.is_on_axis(k) for k in some], dtype) for side, some in sides]
        beside = [np.array([side.beside_axis(k) for k in some], dtype) for side, some in sides]
        costs = AXIS_COST * (on_axis[0][:, None] * beside[1] + beside[0][:, None] * on_axis[1])
        row, column = ({k: at for at, k in enumerate(some)} for some in (rows, columns))
        for i, j in self.partner.items():
            image_a, image_b = self.a.mirror.twin[i], self.b.mirror.twin[j]
            if image_a in row and image_b in column:
                costs[row[image_a], column[image_b]] -= TWIN_GAIN
        return costs


def _twins_with_twins(excess: FloatArray, focus: FloatArray, a: IntArray, b: IntArray) -> list[Numbers]:
    """Return the pairs of twins, (p, 2) rows, with twins, (q, 2) columns, at the least total with all other contours.

    Twins are assigned together, left to left if that is no dearer; other contours one by one.
    """
    if not len(a) or not len(b):
        return []
    straight = excess[np.ix_(a[:, 0], b[:, 0])] + excess[np.ix_(a[:, 1], b[:, 1])]
    crossed = excess[np.ix_(a[:, 0], b[:, 1])] + excess[np.ix_(a[:, 1], b[:, 0])] + 2.0 * SIDE_COST
    together = np.minimum(straight, crossed) / 2.0 - TWIN_GAIN
    value = values_of(excess, focus)
    others = [np.delete(np.arange(n), twins.ravel()) for n, twins in zip(value.shape, (a, b), strict=True)]
    units = np.block(
        [
            [
                2.0 * values_of(together, focus[np.ix_(a[:, 0], b[:, 0])]),
                value[a][:, :, others[1]].min(axis=1),
            ],
            [value[others[0]][:, b].min(axis=2), value[np.ix_(*others)]],
        ]
    )
    found: list[Numbers] = []
    for i, j in assign(units):
        if i < len(a) and j < len(b) and units[i, j] < 0.0:
            first, second = b[j] if straight[i, j] <= crossed[i, j] else b[j][::-1]
            found += [(int(a[i, 0]), int(first)), (int(a[i, 1]), int(second))]
    return found


def _outer_first(
    pairs: Sequence[Numbers],
    excess: FloatArray,
    here: tuple[_Side, Sequence[int]],
    there: tuple[_Side, Sequence[int]],
) -> list[Numbers]:
    """Return pairs with contours around the first ones instead, where these are left out and about as good.

    Pairs are places in `excess` and among the contours of both sides.
    """
    (side, some), (other, others) = here, there
    place = {k: at for at, k in enumerate(some)}
    taken = {some[i] for i, _ in pairs}
    found = []
    for i, j in pairs:
        part, between = side.part(some[i])
        around = side.structure.ancestors(some[i])[:between]
        # A contour around all others may be a ground for them: a mane around a face.
        deeper = part >= 0 and between > other.part(others[j])[1]
        free = [place[k] for k in reversed(around) if k in place and k not in taken] if deeper else []
        better = (at for at in free if excess[at, j] < min(0.0, excess[i, j] + OUTER_GAIN))
        outer = next(better, i)
        taken.add(some[outer])
        found.append((outer, j))
    return found


def _out_of(side: _Side, contours: Sequence[int], parts: IntArray) -> FloatArray:
    """Return the shares of contours outside of parts, (parts, contours); nothing is outside of the drawing, -1."""
    known = parts[:, None]
    shares: FloatArray = side.structure.within[known, contours].astype(side.described.areas.dtype)
    return np.where(known < 0, 0.0, 1.0 - shares)
