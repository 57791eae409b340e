"""Defects of a motion: in-betweens that cross themselves, swing out, lose area, or have a limb that collapses."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.geometry import cubics
from shapeblend_cli.geometry.crossings import path_crossings
from shapeblend_cli.interpolate.paths import paths_at

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import ComplexArray, ContourBlend, CubicPath, FloatArray, ShapeBlend

CHECKED_TIMES, MEASURED_TIMES = tuple(k / 20 for k in range(1, 20)), tuple(k / 8 for k in range(1, 8))
"""Times at which crossings are counted, besides those of the frames, and at which the rest is measured."""

LEAST_AREA, MOST_AREA, COLLAPSE_AREA = 0.72, 1.6, 0.6
"""An in-between has at least the first share of the area it would have if it only grew, and at most the second of the
straight line between the ends' areas. With less than the third there is little left to see."""

NEGLIGIBLE_AREA = 1e-3
"""Less area, as a share of the square of a shape's size, is rounding, or lines there and back."""

SECTION, LEAST_SECTION = 0.2, 0.65
"""A fifth of an outline's length is a limb. It collapses if it has less than this share of the length of its shorter
end. On straight paths one does that is rotated by 100 degrees against the rest."""

MOST_REACH = 1.3
"""In-betweens stay within so many times the distance that both ends have from their centre. What rotates in place
stays within that distance."""

CHORDS = 4
"""Chords by which a segment is measured."""


class Defect(NamedTuple):
    """What is wrong with a motion: how bad that is, from `LOSS` to `CROSSING`, and a phrase that says it."""

    rank: int
    message: str


LOSS, OVERLAP, COLLAPSE, STRAY, CROSSING = range(5)
"""Area is lost or gained, or a limb collapses; contours cross each other; a shape nearly vanishes; a part swings far
out; a contour crosses itself."""


def worst_defect(shape: ShapeBlend, times: Sequence[float]) -> Defect | None:
    """Return the worst defect of the motion of a shape, if it has any.

    Crossings of its start or its end are not the motion's. They are counted at `times` besides `CHECKED_TIMES`.
    """
    defects = [*_crossings(shape, times), *_strays(shape), *_losses(shape)]
    return max(defects, key=lambda defect: defect.rank, default=None)


def _crossings(shape: ShapeBlend, times: Sequence[float]) -> list[Defect]:
    """Find the first in-between with crossings, and the first of which a contour crosses itself."""
    checked = checked_contours(shape.contours)

    def checked_paths(t: float) -> list[CubicPath]:
        paths = paths_at(shape, t)
        return [paths[k] for k in checked]

    ends = [checked_paths(t) for t in (0.0, 1.0)]
    most = max(path_crossings(paths) for paths in ends)
    most_by_path: list[int] = []
    defects = []
    for t in sorted({*CHECKED_TIMES, *times} - {0.0, 1.0}):
        paths = checked_paths(t)
        if path_crossings(paths, most + 1) <= most:
            continue
        # Path by path only now: most shapes never come here.
        most_by_path = most_by_path or [
            max(path_crossings([path]) for path in both) for both in zip(*ends, strict=True)
        ]
        if any(path_crossings([path], m + 1) > m for path, m in zip(paths, most_by_path, strict=True)):
            defects.append(Defect(CROSSING, f"an outline crosses itself at t = {t:.3g}"))
            break
        if not defects:
            defects.append(Defect(OVERLAP, f"outlines cross each other at t = {t:.3g}"))
    return defects


def checked_contours(contours: Sequence[ContourBlend]) -> list[int]:
    """Return the indices of the contours whose crossings are defects.

    Not those of exteriors that grow out of others, or shrink into them: these begin or end on the border of another
    one, painted alike, and are seen to come out of it.
    """
    larger = [
        max((c.start, c.end), key=lambda path: abs(cubics.signed_area(path.segments))) for c in contours
    ]
    areas = [cubics.signed_area(path.segments) if path.closed else 0.0 for path in larger]
    largest = max(areas, key=abs)
    return [
        k
        for k, (contour, area) in enumerate(zip(contours, areas, strict=True))
        if not ((contour.grows or contour.shrinks) and area * largest > 0.0)
    ]


def _strays(shape: ShapeBlend) -> list[Defect]:
    """Find the in-between that reaches furthest, if that is too far; on straight paths none does."""
    if shape.motion is None:
        return []
    ends = np.concatenate([path.segments.ravel() for t in (0.0, 1.0) for path in paths_at(shape, t)])
    centre = 0.5 * complex(ends.real.min() + ends.real.max(), ends.imag.min() + ends.imag.max())

    def reach_at(t: float) -> float:
        return max(float(np.abs(path.segments - centre).max()) for path in paths_at(shape, t))

    reach, t = max((reach_at(t), t) for t in MEASURED_TIMES)
    share = reach / float(np.abs(ends - centre).max())
    if share <= MOST_REACH:
        return []
    return [Defect(STRAY, f"swings out to {share:.2g} times its size at t = {t:.3g}")]


def _losses(shape: ShapeBlend) -> list[Defect]:
    """Find area that is lost or gained, and limbs that collapse."""
    defects = []
    area_a, area_b = (_area(paths_at(shape, t)) for t in (0.0, 1.0))
    ends = [path.segments for contour in shape.contours for path in (contour.start, contour.end)]
    negligible = NEGLIGIBLE_AREA * max(float(np.abs(z - z[0, 0]).max()) for z in ends) ** 2
    in_betweens = [paths_at(shape, t) for t in MEASURED_TIMES]
    for t, paths in zip(MEASURED_TIMES, in_betweens, strict=True):
        most = (1.0 - t) * area_a + t * area_b
        # What grows evenly has less: on straight paths its size is linear in time, else geometric.
        if shape.motion is None:
            least = ((1.0 - t) * area_a**0.5 + t * area_b**0.5) ** 2
        else:
            least = area_a ** (1.0 - t) * area_b**t
        area = _area(paths)
        share = (
            area / most if area > most > negligible else area / least if area < least > negligible else 1.0
        )
        if not LEAST_AREA <= share <= MOST_AREA:
            rank = COLLAPSE if share < COLLAPSE_AREA else LOSS
            defects.append(Defect(rank, f"{100 * share:.0f} % of the area it should have at t = {t:.3g}"))
    for k, contour in enumerate(shape.contours):
        if contour.grows or contour.shrinks:
            continue
        collapse = collapsing_section(contour, [paths[k].segments for paths in in_betweens])
        if collapse is not None:
            share, number = collapse
            t = MEASURED_TIMES[number]
            defects.append(Defect(LOSS, f"a limb shrinks to {100 * share:.0f} % at t = {t:.3g}"))
    return defects


def _area(paths: Sequence[CubicPath]) -> float:
    """Return the area inside the closed paths."""
    return abs(sum(cubics.signed_area(path.segments) for path in paths if path.closed))


def collapsing_section(
    contour: ContourBlend, in_betweens: Sequence[ComplexArray]
) -> tuple[float, int] | None:
    """Return the least share of its length that a limb keeps, if that is too little, and in which in-between.

    A limb is a section between two points of the outline that are `SECTION` of its length apart, on the mean of both
    drawings; it must have half as much on each of them.
    """
    closed = contour.start.closed
    length_a, length_b = _chord_lengths(contour.start.segments), _chord_lengths(contour.end.segments)
    total_a, total_b = length_a.sum(), length_b.sum()
    distance = 0.5 * (_distances(length_a / total_a, closed) + _distances(length_b / total_b, closed))
    first = np.arange(len(length_a))
    last = np.searchsorted(distance, distance[first] + SECTION)
    complete = last < len(distance)
    first, last = first[complete], last[complete]

    def section_lengths(lengths: FloatArray) -> FloatArray:
        distances = _distances(lengths, closed)
        return distances[last] - distances[first]

    section_a, section_b = section_lengths(length_a), section_lengths(length_b)
    shorter = np.minimum(section_a, section_b)
    counts = (section_a > 0.5 * SECTION * total_a) & (section_b > 0.5 * SECTION * total_b)
    if not counts.any():
        return None
    shares = [
        float((section_lengths(_chord_lengths(z))[counts] / shorter[counts]).min()) for z in in_betweens
    ]
    least = min(shares)
    return (least, shares.index(least)) if least < LEAST_SECTION else None


def _chord_lengths(segments: ComplexArray) -> FloatArray:
    """Return the lengths of the chords of all segments, one after the other."""
    points = cubics.evaluate(segments[:, None, :], np.arange(CHORDS + 1) / CHORDS)
    return np.abs(np.diff(points, axis=1)).ravel()


def _distances(lengths: FloatArray, closed: bool) -> FloatArray:
    """Return the distance along the outline of each chord; of closed outlines twice round."""
    return np.concatenate([[0.0], np.cumsum(np.tile(lengths, 2) if closed else lengths)])
