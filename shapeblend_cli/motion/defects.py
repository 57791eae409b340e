"""What is wrong with a motion: in-betweens that cross themselves, stray, lose area, or in which a limb withers."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.geometry import cubics
from shapeblend_cli.geometry.crossings import path_crossings
from shapeblend_cli.interpolate.paths import between

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import ComplexArray, ContourBlend, CubicPath, FloatArray, ShapeBlend

CHECKED = tuple(k / 20 for k in range(1, 20))
"""Times at which in-betweens are looked at, besides those of the frames."""

MEASURED = tuple(k / 8 for k in range(1, 8))
"""Times at which they are measured."""

LEAST_AREA, MOST_AREA = 0.72, 1.6
"""An in-between has at least that share of the area it would have if it only grew, and at most this share of the
straight line between the ends' areas."""

FLAT = 1e-3
"""Area that counts, as a share of the square of a shape's size; less is rounding, or lines there and back."""

COLLAPSED = 0.6
"""With a lesser share there is little left to see."""

LIMB = 0.2
"""Share of an outline's length that is a limb: a fifth."""

WITHERED = 0.65
"""A limb withers if it has less than this share of the length of its shorter end. On straight paths one does that is
turned by 100 degrees against the rest."""

ASTRAY = 1.3
"""In-betweens keep within so many times the distance that both ends have from their middle. What turns in its place
keeps within that distance."""

PIECES = 4
"""Lines for which a segment is taken when it is measured."""


class Fault(NamedTuple):
    """What is wrong with a motion.

    Attributes
    ----------
    rank : int
        How bad that is: `LOSS`, `OVERLAP`, `COLLAPSE`, `STRAY` or `CROSSING`.
    says : str
        A phrase.
    """

    rank: int
    says: str


LOSS, OVERLAP, COLLAPSE, STRAY, CROSSING = range(5)
"""Some area is lost or won too much, or a limb withers; contours get in each other's way; a shape nearly vanishes; some
of it swings far out; a contour crosses itself."""


def fault(shape: ShapeBlend, times: Sequence[float]) -> Fault | None:
    """The worst that is wrong with the motion of a shape, if anything.

    Parameters
    ----------
    shape : ShapeBlend
        Crossings that its start or its end has are no fault of the motion.
    times : sequence of float
        At which crossings are looked for besides `CHECKED`.
    """
    found = [*_crossings(shape, times), *_strays(shape), *_losses(shape)]
    return max(found, key=lambda one: one.rank, default=None)


def _crossings(shape: ShapeBlend, times: Sequence[float]) -> list[Fault]:
    """The first in-between that is crossed, and the first of which a contour crosses itself."""
    numbers = counted(shape.contours)

    def seen(t: float) -> list[CubicPath]:
        outlines = between(shape, t)
        return [outlines[k] for k in numbers]

    ends = [seen(t) for t in (0.0, 1.0)]
    together = max(path_crossings(outlines) for outlines in ends)
    each: list[int] = []
    found = []
    for t in sorted({*CHECKED, *times} - {0.0, 1.0}):
        outlines = seen(t)
        if path_crossings(outlines, together + 1) <= together:
            continue
        # Contour by contour only now: most shapes never come here.
        each = each or [
            max(path_crossings([outline]) for outline in pair) for pair in zip(*ends, strict=True)
        ]
        if any(
            path_crossings([outline], most + 1) > most for outline, most in zip(outlines, each, strict=True)
        ):
            found.append(Fault(CROSSING, f"an outline crosses itself at t = {t:.3g}"))
            break
        if not found:
            found.append(Fault(OVERLAP, f"outlines cross each other at t = {t:.3g}"))
    return found


def counted(contours: Sequence[ContourBlend]) -> list[int]:
    """Numbers of the contours whose crossings are faults.

    Not those of outlines that grow out of others, or shrink into them: these begin or end on the border of another
    one, painted alike, and are seen to come out of it.
    """
    larger = [max((c.start, c.end), key=lambda o: abs(cubics.signed_area(o.segments))) for c in contours]
    areas = [cubics.signed_area(outline.segments) if outline.closed else 0.0 for outline in larger]
    way = max(areas, key=abs)
    return [
        k
        for k, (contour, area) in enumerate(zip(contours, areas, strict=True))
        if not ((contour.grows or contour.shrinks) and area * way > 0.0)
    ]


def _strays(shape: ShapeBlend) -> list[Fault]:
    """The in-between that goes furthest from where both ends are, if that is too far; straight paths never do."""
    if shape.motion is None:
        return []

    def far(t: float) -> float:
        return max(float(np.abs(outline.segments - middle).max()) for outline in between(shape, t))

    ends = np.concatenate([outline.segments.ravel() for t in (0.0, 1.0) for outline in between(shape, t)])
    middle = 0.5 * complex(ends.real.min() + ends.real.max(), ends.imag.min() + ends.imag.max())
    reach, t = max((far(t), t) for t in MEASURED)
    share = reach / float(np.abs(ends - middle).max())
    return (
        [Fault(STRAY, f"swings out to {share:.2g} times its size at t = {t:.3g}")] if share > ASTRAY else []
    )


def _losses(shape: ShapeBlend) -> list[Fault]:
    """Area that is lost or won too much, and limbs that wither."""
    found = []
    area_a, area_b = (_area(between(shape, t)) for t in (0.0, 1.0))
    ends = [getattr(contour, side).segments for contour in shape.contours for side in ("start", "end")]
    some = FLAT * max(float(np.abs(z - z[0, 0]).max()) for z in ends) ** 2
    pictures = []
    for t in MEASURED:
        outlines = between(shape, t)
        pictures.append([outline.segments for outline in outlines])
        most = (1.0 - t) * area_a + t * area_b
        # What grows evenly has less: on straight paths its size goes evenly, else geometrically.
        if shape.motion is None:
            least = ((1.0 - t) * area_a**0.5 + t * area_b**0.5) ** 2
        else:
            least = area_a ** (1.0 - t) * area_b**t
        area = _area(outlines)
        share = area / most if area > most > some else area / least if area < least > some else 1.0
        if not LEAST_AREA <= share <= MOST_AREA:
            rank = COLLAPSE if share < COLLAPSED else LOSS
            found.append(Fault(rank, f"{100 * share:.0f} % of the area it should have at t = {t:.3g}"))
    for k, contour in enumerate(shape.contours):
        if contour.grows or contour.shrinks:
            continue
        a, b = contour.start.segments, contour.end.segments
        withered = _withers(a, b, [picture[k] for picture in pictures], contour.start.closed)
        if withered is not None:
            share, number = withered
            found.append(Fault(LOSS, f"a limb shrinks to {100 * share:.0f} % at t = {MEASURED[number]:.3g}"))
    return found


def _area(outlines: Sequence[CubicPath]) -> float:
    """Inside the closed outlines."""
    return abs(sum(cubics.signed_area(outline.segments) for outline in outlines if outline.closed))


def _withers(
    a: ComplexArray, b: ComplexArray, pictures: Sequence[ComplexArray], closed: bool
) -> tuple[float, int] | None:
    """The least share of its length that a limb keeps, if that is too little, and in which picture.

    A limb is what lies between two places of the outline that are `LIMB` of its length apart, on the mean of both
    drawings; it must have half as much on each of them.
    """
    length_a, length_b = _lengths(a), _lengths(b)
    place = 0.5 * (_summed(length_a / length_a.sum(), closed) + _summed(length_b / length_b.sum(), closed))
    first = np.arange(len(length_a))
    last = np.searchsorted(place, place[first] + LIMB)
    inside = last < len(place)
    first, last = first[inside], last[inside]

    def limbs(lengths: FloatArray) -> FloatArray:
        summed = _summed(lengths, closed)
        return summed[last] - summed[first]

    limb_a, limb_b = limbs(length_a), limbs(length_b)
    shorter = np.minimum(limb_a, limb_b)
    counts = (limb_a > 0.5 * LIMB * length_a.sum()) & (limb_b > 0.5 * LIMB * length_b.sum())
    if not counts.any():
        return None
    least = [(float((limbs(_lengths(z))[counts] / shorter[counts]).min()), k) for k, z in enumerate(pictures)]
    return min(least) if min(least)[0] < WITHERED else None


def _lengths(segments: ComplexArray) -> FloatArray:
    """Length of each piece of the outline."""
    points = cubics.evaluate(segments[:, None, :], np.arange(PIECES + 1) / PIECES)
    return np.abs(np.diff(points, axis=1)).ravel()


def _summed(lengths: FloatArray, closed: bool) -> FloatArray:
    """Length up to each piece; of closed outlines twice round."""
    return np.concatenate([[0.0], np.cumsum(np.tile(lengths, 2) if closed else lengths)])
