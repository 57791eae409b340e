"""The pen lines of a filled region, if it is the stroke of some.

Where a region is a stroke of width w, the largest ball inside it that touches its outline anywhere has the diameter w,
and its centre lies on the centre line. So points of the outline with a ball of the pen's width, moved inwards by half
of that, string up to centre lines in the order of the outline: once on each side of the stroke. Around a round cap or
join the centre rests, which gives the end of a line or a corner exactly. What is left is in `strung`.

The lines are drawn again, and kept only if that is the region. All lengths are in units (see `line.UNITS`).
"""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.geometry import cubics
from shapeblend_cli.model.arrays import numbered, rolled
from shapeblend_cli.pens.line import UNITS
from shapeblend_cli.pens.recovery.balls import Ample, ball_diameters

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import BoolArray, ComplexArray, FloatArray, IntArray
    from shapeblend_cli.pens.recovery.region import Recovered, Stretch

STEP = 0.1
"""Distance of sample points along an outline, in units."""

MOST_SAMPLES = 8000
"""Maximum number of sample points of a region: drawings with longer outlines are no icons."""

WIDEST = 0.14 * UNITS
"""Maximum width of a pen, in units."""

LARGEST = 1.1 * WIDEST
"""Maximum diameter of a ball that is looked for, in units: a little more than that of one with a pen's width."""

MOST_WIDTHS = 4
"""Maximum number of pens of a region."""

WINDOW = 0.06
"""Tolerance of the diameters that make up one pen, as a share of its width."""

LEAST_INK = 2.4
"""Minimum length of outline that a pen leaves, in widths: 1.2 on either side."""

LEAST_FREE = 0.3
"""Minimum share of the outline that a pen leaves outside of its corners."""

NEAR_WIDTH = 0.045
"""Tolerance of a ball's diameter for the pen's width, as a share of it."""

LEAST_TOLERANCE = 0.01
"""Addition to that tolerance, in units."""

APART = 0.054
"""Minimum difference of the widths of two pens, as a share of the wider: a handle is hardly wider than its ring."""

CORNER = np.radians(45.0)
"""Minimum turn of an outline at a corner that sticks out, in radians: balls in it have no pen's width."""

LEAST_SHARE = 0.6
"""Minimum share of an outline whose balls have the width of a pen."""

RESTS = 0.3
"""Maximum step of a ball's centre at a cap or a round join, as a share of the step along the outline."""

CAP_TURN = np.radians(125.0)
"""Minimum turn of the normal around a cap, in radians; a join turns less."""


class _Samples(NamedTuple):
    """Points of outlines, (n,) each: where, unit normals into the region, contours, and lengths around them."""

    points: ComplexArray
    normals: ComplexArray
    contour: IntArray
    spacing: FloatArray


def recover(contours: Sequence[ComplexArray]) -> tuple[list[Recovered], list[ComplexArray]] | None:
    """Return the lines of a region and the polygons of what sticks out of them; None if it is not mostly lines.

    Parameters
    ----------
    contours : sequence of (k, 4) complex
        An exterior and its holes, closed chains of cubic segments in units, with the region on their left.
    """
    # Before anything is sampled: drawings far larger than their viewBox would take gigabytes.
    lengths = [cubics.lengths(segments) for segments in contours]
    if sum(float(each.sum()) for each in lengths) > MOST_SAMPLES * STEP:
        return None
    samples = _sampled(contours, lengths)
    # Balls that are too wide for a pen, along more of the outline than may be left, decide at once.
    most_left = (1.0 - LEAST_SHARE) * float(samples.spacing.sum()) * (1.0 + 1e-9)
    wide = (1.0 + NEAR_WIDTH) * WIDEST + LEAST_TOLERANCE
    diameters = ball_diameters(
        samples.points, samples.normals, LARGEST, Ample(samples.spacing, wide, most_left)
    )
    if diameters is None:
        return None
    beside_corner = np.abs(diameters - _corner_diameters(contours, lengths, samples))
    in_corner = beside_corner < NEAR_WIDTH * diameters + LEAST_TOLERANCE
    widths = _pen_widths(diameters, samples.spacing, ~in_corner)
    if not len(widths):
        return None
    nearest = np.abs(diameters[:, None] - widths).argmin(axis=1)
    is_pen = np.abs(diameters - widths[nearest]) < NEAR_WIDTH * widths[nearest] + LEAST_TOLERANCE
    # The corners at cut ends are all within a width.
    is_beside = is_pen | ~(in_corner & (diameters < widths.max()))
    if samples.spacing[is_pen].sum() < LEAST_SHARE * samples.spacing[is_beside].sum():
        return None
    pen = np.where(is_pen, nearest, -1)
    stretches = _stretches(samples, pen, widths)
    if not stretches:
        return None
    from shapeblend_cli.pens.recovery.region import Region, checked
    from shapeblend_cli.pens.recovery.strung import strung_up

    region = Region(contours)
    return checked(strung_up(stretches, region, STEP), region, contours)


def _steps(own: FloatArray) -> tuple[IntArray, IntArray, IntArray]:
    """Return the segments with a length, into how many steps each is cut, and the number of each step in its own."""
    used = (own > 1e-9).nonzero()[0]
    counts = np.maximum(np.ceil(own[used] / STEP), 2).astype(np.intp)
    return used, counts, numbered(counts)


def _sampled(contours: Sequence[ComplexArray], lengths: Sequence[FloatArray]) -> _Samples:
    """Sample outlines, of segments of these lengths, at the middles of steps of even parameter: no corners."""
    parts = []
    for number, (segments, own) in enumerate(zip(contours, lengths, strict=True)):
        used, counts, within = _steps(own)
        count = counts.repeat(counts)
        t = (within + 0.5) / count
        points = segments.take(used.repeat(counts), axis=0)
        handles = 3.0 * (points[:, 1:] - points[:, :-1])
        u = 1.0 - t
        velocity = u * u * handles[:, 0] + 2.0 * u * t * handles[:, 1] + t * t * handles[:, 2]
        speed = np.abs(velocity)
        normals = 1j * velocity / np.where(speed > 0.0, speed, 1.0)
        parts.append((cubics.evaluate(points, t), normals, np.full(len(t), number), speed / count))
    return _Samples(*(np.concatenate(each) for each in zip(*parts, strict=True)))


def _corner_diameters(
    contours: Sequence[ComplexArray], lengths: Sequence[FloatArray], samples: _Samples
) -> FloatArray:
    """Return the diameter of a ball that touches the outline at each sample and beyond the corner next to it."""
    found = []
    spacings = np.split(samples.spacing, np.searchsorted(samples.contour, np.arange(1, len(contours))))
    for segments, own, spacing in zip(contours, lengths, spacings, strict=True):
        used, counts, within = _steps(own)
        starts, ends = cubics.directions(segments[used])
        turn = np.angle(starts * rolled(ends, 1).conj())
        growth = np.where(turn > CORNER, 2.0 / np.tan(np.where(turn > CORNER, turn, 1.0) / 2.0), np.inf)
        at_start = growth.repeat(counts) * (spacing * (within + 0.5))
        at_end = rolled(growth, -1).repeat(counts) * (spacing * (counts.repeat(counts) - within - 0.5))
        found.append(np.minimum(at_start, at_end))
    return np.concatenate(found)


def _pen_widths(diameters: FloatArray, spacing: FloatArray, is_free: BoolArray) -> FloatArray:
    """Return the diameters that most of the outline has, in widths, one after the other; none is that of corners."""
    found: list[float] = []
    left = diameters < WIDEST
    while left.any() and len(found) < MOST_WIDTHS:
        order = np.argsort(diameters[left], kind="stable")
        rising, ink = diameters[left][order], np.concatenate([[0.0], np.cumsum(spacing[left][order])])
        free = np.concatenate([[0.0], np.cumsum((spacing * is_free)[left][order])])
        beyond = np.searchsorted(rising, rising * (1.0 + WINDOW) + 0.02)
        inside = ink[beyond] - ink[:-1]
        is_pen = free[beyond] - free[:-1] >= LEAST_FREE * inside
        k = int(np.argmax(np.where(is_pen, inside / np.maximum(rising, 0.05), 0.0)))
        width = float(
            rising[(k + beyond[k]) // 2]
        )  # the median, without the modules that numpy loads for its own
        if not is_pen[k] or inside[k] < LEAST_INK * width or width < 0.05:
            break
        found.append(width)
        left &= np.abs(diameters - width) > APART * width + 0.012
    return np.array(found)


def _stretches(samples: _Samples, pen: IntArray, widths: FloatArray) -> list[Stretch]:
    """String up the centres of balls of a pen's width, in the order of the outline, and cut them at caps."""
    found = []
    centres = samples.points + samples.normals * np.where(pen >= 0, widths[pen], 0.0) / 2.0
    for number in range(int(samples.contour.max()) + 1):
        own = np.flatnonzero(samples.contour == number)
        following = rolled(own, -1)
        apart = np.abs(centres[following] - centres[own])
        most = 2.0 * np.maximum(samples.spacing[own], samples.spacing[following]) + 1e-9
        goes_on = (pen[own] >= 0) & (pen[following] == pen[own]) & (apart < most)
        if goes_on.all():
            found += _cut_at_caps(own, centres, samples, widths[pen[own[0]]], is_ring=True)
            continue
        start = int(np.flatnonzero(~goes_on)[0]) + 1
        own, goes_on = rolled(own, -start), rolled(goes_on, -start)
        breaks = np.flatnonzero(~goes_on) + 1
        for run in np.split(own, breaks[:-1]):
            if pen[run[0]] >= 0 and len(run) > 1:
                found += _cut_at_caps(run, centres, samples, widths[pen[run[0]]], is_ring=False)
    return found


def _cut_at_caps(
    run: IntArray, centres: ComplexArray, samples: _Samples, width: float, is_ring: bool
) -> list[Stretch]:
    """Cut a run of sample points where the centre rests while the normal turns by the angle of a cap."""
    from shapeblend_cli.pens.recovery.region import Stretch

    following = rolled(run, -1)
    spacing = 0.5 * (samples.spacing[run] + samples.spacing[following])
    rests = np.abs(centres[following] - centres[run]) < RESTS * spacing
    if not is_ring:
        rests[-1] = False
    elif rests.all():
        return [Stretch(np.array([centres[run].mean()]), width, ends=("round", "round"))]
    else:
        start = int(np.flatnonzero(~rests)[0]) + 1
        run, rests = rolled(run, -start), rolled(rests, -start)
    # Where the centre rests, points are one; `starts` are their first ones.
    starts = np.flatnonzero(np.append(True, ~rests[:-1]))
    sums: ComplexArray = np.add.reduceat(centres[run], starts).astype(complex)
    points = sums / np.diff(np.append(starts, len(run)))
    normals = samples.normals[run]
    steps = np.where(rests[:-1], np.angle(normals[1:] * normals[:-1].conj()), 0.0)
    caps = np.flatnonzero(np.abs(np.add.reduceat(np.append(steps, 0.0), starts)) > CAP_TURN).tolist()
    if is_ring and not caps:
        return [Stretch(points, width, closed=True)]
    parts = [Stretch(points[k : j + 1], width, ends=("round", "round")) for k, j in pairwise(caps)]
    if is_ring:
        around = np.concatenate([points[caps[-1] :], points[: caps[0] + 1]])
        parts.insert(0, Stretch(around, width, ends=("round", "round")))
    elif caps:
        parts.insert(0, Stretch(points[: caps[0] + 1], width, ends=(None, "round")))
        parts.append(Stretch(points[caps[-1] :], width, ends=("round", None)))
    else:
        parts.append(Stretch(points, width))
    return [part for part in parts if len(part.points) > 1]
