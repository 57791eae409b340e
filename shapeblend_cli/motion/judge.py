"""A judge of blends: how wrong the in-betweens look, as one number.

The eye sees wrong area, for as long as it is there. Each term is such an area, on average over the time of the blend,
as a share of the area that the shape paints. So candidates for the same shape can be compared, whether they differ in
their motion, their correspondence or their start. `docs/motion.md` has a picture of each fault.
"""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from shapeblend_cli.geometry.raster import count_folds, count_unlike, winding_grid
from shapeblend_cli.interpolate.paths import expect, segments_at
from shapeblend_cli.model import Box
from shapeblend_cli.motion.rigid import Rigid

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from shapeblend_cli.model import BoolArray, ComplexArray, FloatArray, IntArray, ShapeBlend

STEPS = 8
"""Number of steps of time between the looks at a blend, which include both ends."""

SIDE = 64
"""Number of points along each side of the grid on which areas without a formula are counted."""

TIMES = np.arange(STEPS + 1) / STEPS
INNER = slice(1, -1)

SYMMETRIC = 0.05
"""Maximum difference of a symmetric drawing from its mirror image, as a share of its area."""

LEANING = 0.2
"""Weight of a symmetry that only turns with the outlines, as of an arrow that goes round, compared with a lost one."""

LEAST_ARC = 2.5
"""Minimum way along the outline between opposite points of a limb, relative to their distance."""

MOST_CHORD = 0.06
"""Maximum distance between opposite points of a limb, as a share of the outline's length."""

PROBES = 96
"""Number of places of an outline at which the width of limbs is measured."""

PLACES = (np.arange(PROBES) + 0.5) / PROBES
"""Places of an outline, as shares of its length, near which that is."""

LINE_WIDTH = 0.04
"""Minimum width of lines, as a share of the shape's size: narrower ones count as so wide."""


class Judgement(NamedTuple):
    """The faults of a blend: areas, on average over its time, as shares of the painted area.

    Attributes
    ----------
    sweep : float
        Area that outlines sweep, beyond the area in which A and B differ.
    strain : float
        Length of outline lost or gained, compared with an even change, times half the mean width of the shape.
    stretch : float
        Length of outline that melts away in one place and grows in another, times half that width. It is the same for
        all motions of a correspondence.
    area : float
        Area lost or gained, compared with an even change.
    symmetry : float
        Area by which the in-betweens lack a left-right symmetry that both ends have.
    folds : float
        Area round which outlines wind the wrong way or twice, beyond the same at the ends.
    limbs : float
        Area by which limbs are thinner or fatter than at either end.
    view : float
        Area outside the view.
    """

    sweep: float = 0.0
    strain: float = 0.0
    stretch: float = 0.0
    area: float = 0.0
    symmetry: float = 0.0
    folds: float = 0.0
    limbs: float = 0.0
    view: float = 0.0

    @property
    def weighted(self) -> Judgement:
        """The terms, each times its weight."""
        return Judgement(*(w * x for w, x in zip(WEIGHTS, self, strict=True)))

    @property
    def number(self) -> float:
        """The sum of the weighted terms."""
        return sum(self.weighted)


WEIGHTS = Judgement(
    sweep=0.01, strain=1.0, stretch=1.0, area=0.25, symmetry=3.0, folds=4.0, limbs=0.5, view=0.1
)


class Judged(NamedTuple):
    """The faults of a shape, as shares of the area that it paints, and that area."""

    judgement: Judgement
    painted: float  # in square units of the drawing, at the larger end


class Outlines(NamedTuple):
    """The outlines of a shape, as chords between points that correspond, at all `TIMES`."""

    points: ComplexArray  # (STEPS + 1, n)
    following: IntArray  # (n,), the other end of the chord from each point; for the end of a line, itself
    contour: IntArray  # (n,), the number of the contour of each point
    closed: BoolArray  # (n,), whether this contour is closed
    width: float  # of strokes
    upright: ComplexArray | None = None  # the points with the turn of the whole undone, if it turns


def judge_shape(shape: ShapeBlend, view: Box | None = None) -> Judged:
    """Judge the motion of a shape in a view that both drawings have in common."""
    return judge_outlines(outlines_of(shape), view)


def judge_outlines(outlines: Outlines, view: Box | None = None) -> Judged:
    """Judge the motion of outlines; see `judge_shape`."""
    chords = outlines.points[:, outlines.following] - outlines.points
    lengths = np.abs(chords)
    total = lengths.sum(axis=1)
    longest = float(max(total[0], total[-1]))
    if longest == 0.0:
        return Judged(Judgement(), 0.0)
    areas = _areas(outlines, chords)
    painted = _painted_area(outlines, areas, longest)
    half_width = painted / longest  # of the painted region, on average
    expected = _even(lengths[0], lengths[-1])
    strain = half_width * float(np.abs(lengths - expected)[INNER].mean(axis=0).sum())
    swept, symmetry, folds = _swept(outlines), 0.0, 0.0
    if outlines.closed.any():
        regions = _Regions(outlines, outlines.points)
        swept -= regions.difference()
        folds, symmetry = regions.folds(), regions.asymmetry()
        if symmetry > 0.0 and outlines.upright is not None:
            lost = min(_Regions(outlines, outlines.upright).asymmetry(), symmetry)
            symmetry = lost + LEANING * (symmetry - lost)
    judgement = Judgement(
        max(swept, 0.0) / painted,
        strain / painted,
        half_width * _stretched(outlines, lengths) / painted,
        _area_lost(areas) / painted,
        symmetry,
        folds / painted,
        _limbs(outlines, lengths) / painted,
        half_width * _outside(outlines, lengths, view) / painted,
    )
    return Judged(judgement, painted)


def outlines_of(shape: ShapeBlend) -> Outlines:
    """Sample the outlines of a shape: the nodes, and the middle of each curve."""
    inner = TIMES[INNER].tolist() if shape.motion is not None else []
    expect(shape, inner)
    points = _points(shape, [0.0, *inner, 1.0])
    if shape.motion is None:
        points = _even(points[0], points[1])
    kept, following = [], []
    counts: list[int] = []
    for contour in shape.contours:
        path = contour.start
        keep = np.ones(2 * len(path.straight) + (not path.closed), np.bool_)
        keep[1 : 2 * len(path.straight) : 2] = ~path.straight
        first, count = sum(counts), int(np.count_nonzero(keep))
        kept.append(keep)
        following.append(np.arange(first + 1, first + count + 1))
        following[-1][-1] = first if path.closed else first + count - 1
        counts.append(count)
    points = points[:, np.concatenate(kept)]
    numbers = np.repeat(np.arange(len(counts)), counts)
    widths = [style.stroke_width for style in (shape.style_a, shape.style_b) if style.stroke]
    return Outlines(
        points,
        np.concatenate(following),
        numbers,
        np.array([contour.start.closed for contour in shape.contours])[numbers],
        max(widths, default=0.0),
        _upright(shape.motion, points, numbers) if isinstance(shape.motion, Rigid) else None,
    )


def _upright(motion: Rigid, points: ComplexArray, contour: IntArray) -> ComplexArray:
    """Return points at all times with the turns of contours undone."""
    turns = motion.alignments
    rotation = np.array([one.rotation for one in turns])[contour]
    centre_a, centre_b = (np.array(side)[contour] for side in zip(*(one[:2] for one in turns), strict=True))
    centre = _even(centre_a, centre_b)
    return (points - centre) * np.exp(-1j * rotation * TIMES[:, None]) + centre


def _points(shape: ShapeBlend, times: Sequence[float]) -> ComplexArray:
    """Return the nodes and the middles of all segments, one after the other, and the end of each line."""
    points = []
    for contour, moving in zip(
        shape.contours, zip(*(segments_at(shape, t) for t in times), strict=True), strict=True
    ):
        z = np.array(moving)
        both = np.empty((*z.shape[:2], 2), np.complex128)
        both[:, :, 0] = z[:, :, 0]
        both[:, :, 1] = (z[:, :, 0] + 3.0 * (z[:, :, 1] + z[:, :, 2]) + z[:, :, 3]) / 8.0
        points.append(both.reshape(len(times), -1))
        if not contour.start.closed:
            points.append(z[:, -1:, 3])
    return np.concatenate(points, axis=1)


def _even(a: Any, b: Any) -> NDArray[Any]:
    """Return an even change from a to b at all times, (STEPS + 1, ...)."""
    t = TIMES.reshape(-1, *[1] * np.ndim(a))
    return np.asarray((1.0 - t) * a + t * b)


def _areas(outlines: Outlines, chords: ComplexArray) -> FloatArray:
    """Return the area inside closed outlines at all times; holes count against it."""
    closed = outlines.closed
    return np.abs(0.5 * (outlines.points[:, closed].conj() * chords[:, closed]).imag.sum(axis=1))


def _painted_area(outlines: Outlines, areas: FloatArray, longest: float) -> float:
    """Return the larger area that outlines paint at either end; of lines their length times their width."""
    size = Box.around(outlines.points[[0, -1]].ravel()).larger_side
    filled = float(max(areas[0], areas[-1]))
    if filled > LINE_WIDTH**2 * size**2:
        return filled
    return longest * max(outlines.width, LINE_WIDTH * size)


def _stretched(outlines: Outlines, lengths: FloatArray) -> float:
    """Return the length of outline that is elsewhere in B than it would be if all of A stretched evenly."""
    a, b = lengths[0], lengths[-1]
    whole_a, whole_b = (np.bincount(outlines.contour, one)[outlines.contour] for one in (a, b))
    at_both = (whole_a > 0.0) & (whole_b > 0.0)
    a, b, whole_a, whole_b = (one[at_both] for one in (a, b, whole_a, whole_b))
    return 0.25 * float(np.abs((whole_a + whole_b) * (a / whole_a - b / whole_b)).sum())


def _swept(outlines: Outlines) -> float:
    """Return the area that the outlines pass over, counted each time."""
    z, after = outlines.points, outlines.points[:, outlines.following]
    # Between two times each chord sweeps a quadrilateral: half the product of its diagonals.
    return 0.5 * float(np.abs(((after[1:] - z[:-1]).conj() * (z[1:] - after[:-1])).imag).sum())


def _area_lost(areas: FloatArray) -> float:
    """Return the area lost or gained on average, compared with an even change of size or of area."""
    a, b = float(areas[0]), float(areas[-1])
    least = _even(a**0.5, b**0.5) ** 2
    off = np.maximum(least - areas, 0.0) + np.maximum(areas - _even(a, b), 0.0)
    return float(off[INNER].mean())


class _Regions:
    """The areas of closed outlines at all times, on grids; `own` are the grids around each time's own box."""

    def __init__(self, outlines: Outlines, points: ComplexArray) -> None:
        self.starts = points[:, outlines.closed]
        self.ends = points[:, outlines.following[outlines.closed]]
        x, y = self.starts.real, self.starts.imag
        left, top = x.min(axis=1), y.min(axis=1)
        sides = left, top, x.max(axis=1) - left, y.max(axis=1) - top
        self.boxes = [Box(*bounds) for bounds in zip(*(side.tolist() for side in sides), strict=True)]
        self.own = [self.grid(k, box) if box.larger_side > 0.0 else None for k, box in enumerate(self.boxes)]

    def grid(self, k: int, box: Box) -> tuple[IntArray, float]:
        """Return winding numbers at time k, on a grid around the middle of a box, and the area of its elements."""
        step = box.larger_side / (SIDE - 2)
        left, top, right, bottom = box.bounds
        corner = 0.5 * complex(left + right, top + bottom) - 0.5 * SIDE * step * (1.0 + 1.0j)
        if k in (0, -1, STEPS):
            grid = _grid_at_an_end(self.starts[k].tobytes(), self.ends[k].tobytes(), corner, step)
        else:
            grid = winding_grid(self.starts[k], self.ends[k], corner, step, SIDE)
        return grid, step * step

    def difference(self) -> float:
        """Return the area in which both ends differ."""
        both = Box.union([self.boxes[0], self.boxes[-1]])
        if both.larger_side == 0.0:
            return 0.0
        (a, element), (b, _) = (self.grid(k, both) for k in (0, -1))
        return element * float(np.count_nonzero((a != 0) != (b != 0)))

    def folds(self) -> float:
        """Return the area of winding numbers other than 0 and 1, beyond the same at the ends."""
        wrong = np.zeros(STEPS + 1)
        for k, own in enumerate(self.own):
            if own is not None:
                numbers, element = own
                wrong[k] = element * count_folds(numbers)
        return float(np.maximum(wrong - max(wrong[0], wrong[-1]), 0.0)[INNER].mean())

    def asymmetry(self) -> float:
        """Return the asymmetry of in-betweens beyond the asymmetry of the ends, as a share of the area."""
        ends = max(self._mirrored(0), self._mirrored(-1))
        if ends > SYMMETRIC:
            return 0.0
        return float(np.mean([max(self._mirrored(k) - ends, 0.0) for k in range(1, STEPS)]))

    def _mirrored(self, k: int) -> float:
        own = self.own[k]
        if own is None:
            return 1.0
        unlike, inside = count_unlike(own[0])
        return 0.5 * float(unlike) / max(inside, 1)


@lru_cache(maxsize=8)
def _grid_at_an_end(starts: bytes, ends: bytes, corner: complex, step: float) -> IntArray:
    """Return the winding numbers of a drawing, which are the same for all motions."""
    return winding_grid(
        np.frombuffer(starts, np.complex128), np.frombuffer(ends, np.complex128), corner, step, SIDE
    )


def _limbs(outlines: Outlines, lengths: FloatArray) -> float:
    """Return the area by which limbs are thinner or fatter than at either end, on average."""
    total = float(lengths[0].sum() + lengths[-1].sum())
    area = 0.0
    for number in range(int(outlines.contour[-1]) + 1):
        on = (outlines.contour == number).nonzero()[0]
        own = lengths[:, on]
        both = 0.5 * float(own[0].sum() + own[-1].sum())
        if len(on) < 8 or both < 0.05 * total or min(own[0].sum(), own[-1].sum()) == 0.0:
            continue
        share = 0.5 * (own[0] / own[0].sum() + own[-1] / own[-1].sum())
        place = np.concatenate([[0.0], share.cumsum()[:-1]])
        probes = np.minimum(place.searchsorted(PLACES), len(on) - 1)
        probes = probes[np.concatenate([[True], probes[1:] > probes[:-1]])]
        area += both * _widths_off(
            outlines.points[:, on[probes]], place[probes], own, bool(outlines.closed[on[0]])
        )
    return area


def _widths_off(points: ComplexArray, place: FloatArray, lengths: FloatArray, closed: bool) -> float:
    """Return by how much the width of limbs is off, on average along the outline and over time."""
    off = 0.0
    for end in (0, -1):
        length = float(lengths[end].sum())
        probe, opposite = _opposite(points[end].tobytes(), place.tobytes(), length, closed)
        widths = np.abs(points[:, probe] - points[:, opposite])
        thin, fat = np.minimum(widths[0], widths[-1]), np.maximum(widths[0], widths[-1])
        wrong = np.maximum(thin - widths, 0.0) + np.minimum(np.maximum(widths - fat, 0.0), fat)
        off += float(wrong[INNER].mean(axis=0).sum())
    # Both ends are asked, and both sides of each limb.
    return off / (4.0 * len(place))


@lru_cache(maxsize=8)
def _opposite(points: bytes, place: bytes, length: float, closed: bool) -> tuple[IntArray, IntArray]:
    """Return the numbers of the probes on limbs of a drawing, and of those opposite; they are the same for all motions.

    Given are the probes and their places along the outline, which has a length.
    """
    probes, places = np.frombuffer(points, np.complex128), np.frombuffer(place, np.float64)
    along = np.abs(places[:, None] - places)
    if closed:
        along = np.minimum(along, 1.0 - along)
    across = np.abs(probes[:, None] - probes)
    width = np.where(along * length > LEAST_ARC * across, across, np.inf)
    opposite = width.argmin(axis=1)
    probe = (width[np.arange(len(places)), opposite] < MOST_CHORD * length).nonzero()[0]
    return probe, opposite[probe]


def _outside(outlines: Outlines, lengths: FloatArray, view: Box | None) -> float:
    """Return the length of outline outside a view on average, beyond the same at the ends."""
    if view is None:
        return 0.0
    length = (lengths * ~view.holds(outlines.points)).sum(axis=1)
    return float(np.maximum(length - max(length[0], length[-1]), 0.0)[INNER].mean())
