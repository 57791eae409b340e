"""The axis of a drawing that is its own mirror image, left to right, and which contours mirror each other about it."""

from __future__ import annotations

from collections import defaultdict
from functools import lru_cache
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.anatomy.structure import along, corners, structure_of

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from shapeblend_cli.anatomy.decompose import PlacedContour
    from shapeblend_cli.anatomy.structure import Structure
    from shapeblend_cli.model import ComplexArray, FloatArray

SAMPLES = 24
"""Number of points of a contour that are mirrored."""

NEAR = 0.03
"""Maximum distance of the boxes of mirrored contours, as a share of the drawing's size."""

OFF = 0.08
"""Maximum mean distance of the points of mirrored contours, as a share of their own size."""

MOST_AXES = 12
"""Maximum number of axes that are tried."""

AT_ONCE = 1 << 15
"""Number of pairs of boxes that are compared at once."""

SORTED_AT_ONCE = 1 << 11
"""Number of pairs that are gone through before those of contours that have a twin by then are left out."""

FEW = 4
"""Maximum number of contours whose anatomy is not kept: it is soon found again."""

LEAST = 0.5
"""Minimum share of contours, by their sizes, whose mirror image is in a drawing that has an axis."""


class Mirror(NamedTuple):
    """The vertical axis of a drawing, and the place of each contour's mirror image in the sequence.

    That is the contour itself for one on the axis, and None for one without a mirror image.
    """

    x: float
    twin: list[int | None]

    def twins(self, contours: Sequence[PlacedContour]) -> list[tuple[int, int]]:
        """Return the pairs that mirror each other, the left contour first."""
        pairs = [(i, j) for i, j in enumerate(self.twin) if j is not None and i < j]
        return [(i, j) if contours[i].centre.real <= contours[j].centre.real else (j, i) for i, j in pairs]


def anatomy_of(contours: Sequence[PlacedContour]) -> tuple[Structure, Mirror | None]:
    """Return the structure of a drawing, and its axis: to pair contours, and to tell the reasons."""
    return _kept_anatomy(tuple(contours)) if len(contours) > FEW else _anatomy(contours)


def _anatomy(contours: Sequence[PlacedContour]) -> tuple[Structure, Mirror | None]:
    structure = structure_of(contours)
    return structure, mirror_of(contours, structure)


_kept_anatomy = lru_cache(maxsize=2)(_anatomy)


def mirror_of(contours: Sequence[PlacedContour], structure: Structure) -> Mirror | None:
    """Find the axis about which most contours mirror each other or themselves; None if there is none.

    What lies in twins in the same place of each, as lights in eyes do, are twins too.
    """
    lows, highs = corners([contour.polygon for contour in contours])
    sizes = np.abs(highs - lows)
    width = float((highs.real.max() - lows.real.min()) or 1.0)
    extent = max(width, float(highs.imag.max() - lows.imag.min()))
    tolerance = NEAR * extent
    best: tuple[float, float] = 0.0, 0.0
    for x in _axes(lows, highs, sizes, tolerance):
        close = (_mirrored_boxes(lows, highs, x, some) <= tolerance for some in _runs(len(sizes)))
        share = float(sizes[np.concatenate([each.any(axis=1) for each in close])].sum() / sizes.sum())
        if share > best[0] + 1e-9:
            best = share, x
    share, x = best
    if share < LEAST:
        return None
    twin = _twins(contours, (lows, highs), x, tolerance)
    if sum(sizes[k] for k, j in enumerate(twin) if j is not None) < LEAST * sizes.sum():
        return None
    children: defaultdict[int | None, list[int]] = defaultdict(list)
    for k, parent in enumerate(structure.parent):
        children[parent].append(k)
    for i, j in enumerate(list(twin)):
        if j is not None and i < j:
            _add_repeated(twin, contours, (i, j), (children[i], children[j]))
    return Mirror(x, twin)


def _axes(lows: ComplexArray, highs: ComplexArray, sizes: FloatArray, tolerance: float) -> list[float]:
    """Return where an axis may be: through the middle of all, and of the largest contours."""
    centres = (lows.real + highs.real) / 2
    middles = [(float(lows.real.min()) + float(highs.real.max())) / 2]
    for k in np.argsort(-sizes, kind="stable"):
        if all(abs(centres[k] - x) > tolerance / 8 for x in middles):
            middles.append(float(centres[k]))
        if len(middles) == MOST_AXES:
            break
    return middles


def _runs(count: int) -> Iterator[slice]:
    """Yield runs of numbers that are few enough for tables of a run and all to stay in the cache."""
    step = 1 + AT_ONCE // count
    yield from (slice(first, first + step) for first in range(0, count, step))


def _mirrored_boxes(lows: ComplexArray, highs: ComplexArray, x: float, some: slice) -> FloatArray:
    """Return the distance of the mirror image of box i, one of some, from box j, (i, j) float."""
    left, right = 2 * x - highs.real[some], 2 * x - lows.real[some]
    away = np.abs(left[:, None] - lows.real)
    for side in (
        right[:, None] - highs.real,
        lows.imag[some, None] - lows.imag,
        highs.imag[some, None] - highs.imag,
    ):
        np.maximum(away, np.abs(side), out=away)
    return away


def _twins(
    contours: Sequence[PlacedContour], boxes: tuple[ComplexArray, ComplexArray], x: float, tolerance: float
) -> list[int | None]:
    """Return the mirror image of each contour, none twice: of several of one kind one of its paint, and the nearest."""
    sizes = np.abs(boxes[1] - boxes[0])
    codes: dict[object, int] = {}
    paint = np.array([codes.setdefault((c.style.fill, c.style.stroke), len(codes)) for c in contours])
    points = [along(contour.polygon, SAMPLES) for contour in contours]

    def is_mirrored(i: int, j: int) -> bool:
        """Return whether contour j is the mirror image of contour i, and of its kind."""
        if not _are_of_one_kind(contours[i], contours[j]):
            return False
        mirrored = 2 * x - points[i].conj()
        apart = np.abs(mirrored[:, None] - points[j])
        spread = (apart.min(axis=0).mean() + apart.min(axis=1).mean()) / 2
        return bool(spread <= OFF * max(sizes[i], sizes[j]))

    twin: list[int | None] = [None] * len(contours)
    close: list[FloatArray] = []
    for some in _runs(len(contours)):
        away = _mirrored_boxes(*boxes, x, some)
        rows, columns = np.nonzero(np.triu(away <= tolerance, some.start))
        is_other = paint[rows + some.start] != paint[columns]
        close.append(np.array([columns, rows + some.start, away[rows, columns], is_other]))
    found = np.concatenate(close, axis=1)
    is_free = np.ones(len(contours), np.bool_)
    order = np.lexsort(found)
    for first in range(0, len(order), SORTED_AT_ONCE):
        pairs = found[:2, order[first : first + SORTED_AT_ONCE]].astype(np.intp)
        for j, i in pairs[:, is_free[pairs].all(axis=0)].T.tolist():
            if is_free[i] and is_free[j] and is_mirrored(i, j):
                twin[i], twin[j] = j, i
                is_free[[i, j]] = False
    return twin


def _add_repeated(
    twin: list[int | None],
    contours: Sequence[PlacedContour],
    parts: tuple[int, int],
    children: tuple[Sequence[int], Sequence[int]],
) -> None:
    """Make twins of contours without a mirror image that lie in the same place of two twins, their children."""
    inner = [[k for k in some if twin[k] is None] for some in children]
    for k in inner[0]:
        p, around = contours[k], [contours[part] for part in parts]
        near = OFF * around[0].size
        for other in inner[1]:
            q = contours[other]
            moved = (p.centre - around[0].centre) - (q.centre - around[1].centre)
            if abs(moved) <= near and abs(p.size - q.size) <= near and _are_of_one_kind(p, q):
                twin[k], twin[other] = other, k
                inner[1].remove(other)
                break


def _are_of_one_kind(p: PlacedContour, q: PlacedContour) -> bool:
    paints = ((c.style.fill is None, c.style.stroke is None) for c in (p, q))
    return p.role == q.role and len(set(paints)) == 1
