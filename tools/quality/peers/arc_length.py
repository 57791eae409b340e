"""What takes no thought: vertices at even arc length, vertex to vertex, from the best of all starts.

Contours are paired in order of size. One that is left over grows out of its centroid, or shrinks to it.
"""

from __future__ import annotations

import numpy as np

from shapeblend_cli.geometry.polygons import centroid, signed_area
from shapeblend_cli.geometry.polyline import cumulative_lengths, from_end_to_end
from tools.quality.data import Pair, polygon, subpaths
from tools.quality.scores import STEPS, area
from tools.quality.truth.form import TIMES, Linked, Truth

NAME = "even arc length"
VERTICES = 120


def blends(pairs: list[Pair]) -> list[list[list[np.ndarray]] | None]:
    return [frames(contours(a), contours(b)) for _, a, b in pairs]


def linked(truths: list[Truth]) -> list[Linked | None]:
    """In-betweens beside what goes where."""
    return [_linked(contours(truth.pair.a), contours(truth.pair.b)) for truth in truths]


def _linked(a: list[np.ndarray], b: list[np.ndarray]) -> Linked:
    matched = links(a, b)
    return Linked([between(matched, t) for t in TIMES], matched, VERTICES * len(matched))


def contours(data: str) -> list[np.ndarray]:
    return [polygon(subpath) for subpath in subpaths(data)]


def frames(a: list[np.ndarray], b: list[np.ndarray]) -> list[list[np.ndarray]]:
    """All frames between two drawings, given as their contours."""
    matched = links(a, b)
    return [between(matched, k / STEPS) for k in range(STEPS + 1)]


def between(matched: list[tuple[np.ndarray, np.ndarray]], t: float) -> list[np.ndarray]:
    return [p + (q - p) * t for p, q in matched]


def links(a: list[np.ndarray], b: list[np.ndarray]) -> list[tuple[np.ndarray, np.ndarray]]:
    """Which vertices go where, for each contour that the in-betweens have."""
    a, b = (sorted(contours, key=area, reverse=True) for contours in (a, b))
    matched = [matching(even(p), even(q)) for p, q in zip(a, b, strict=False)]
    matched += [(even(p), np.full(VERTICES, centroid(p))) for p in a[len(b) :]]
    matched += [(np.full(VERTICES, centroid(q)), even(q)) for q in b[len(a) :]]
    return matched


def matching(p: np.ndarray, q: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Both with q turned to the direction of p, and begun where squared distances add up to the least."""
    if signed_area(p) * signed_area(q) < 0:
        q = np.roll(q[::-1], 1)
    starts = np.add.outer(np.arange(len(q)), np.arange(len(q))) % len(q)
    return p, q[starts[(np.abs(q[starts] - p) ** 2).sum(axis=1).argmin()]]


def even(contour: np.ndarray) -> np.ndarray:
    """Vertices at even arc length, from the first one on."""
    around = from_end_to_end(contour, closed=True)
    reached = cumulative_lengths(around)
    return np.interp(reached[-1] * np.arange(VERTICES) / VERTICES, reached, around)
