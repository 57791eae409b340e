"""How what is inside an outline is carried along as the outline is bent.

Inside points are means of their neighbours, with weights that are positive (mean value coordinates, Floater 2003).
Where the outline is bent, and its points with it, the means of their new places are the new places of inside points. So
every affine map is exact, and in between the weights go from those of one outline to those of the other. No triangle
may turn over. If one would, both outlines are laid out on a circle instead, where such means never turn over (Tutte
1963): a place in one outline goes to the place in the other that is laid at the same spot.
"""

from __future__ import annotations

import math
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.images.triangles import NotSimpleError, doubled_areas, triangulated

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import BoolArray, ComplexArray, FloatArray, IntArray

INNER = 150
"""Number of points inside an outline, about."""

LEAST_AREA = 1e-12
"""Minimum area of a triangle, as a share of the area of the outline's box."""


class Mesh(NamedTuple):
    """Triangles inside an outline, and where their corners are in both drawings."""

    points: ComplexArray  # (n,), the outline's come first
    triangles: IntArray  # (k, 3)
    in_a: ComplexArray  # (n,)
    in_b: ComplexArray  # (n,)


class Bending:
    """The bending of one outline into another one, with what is inside."""

    def __init__(
        self, a: ComplexArray, b: ComplexArray, between: Sequence[tuple[float, ComplexArray]]
    ) -> None:
        """Find a way for two outlines of as many points, and outlines at times between; else raise NotSimpleError."""
        self._a, self._b = a, b
        self._by_weights = next((way for way in self._ways() if _holds(way, between)), None)
        if self._by_weights is None:
            for t, outline in between:
                if not _is_sound(self.mesh(outline, t)):
                    raise NotSimpleError

    @property
    def is_laid_out(self) -> bool:
        """Whether both outlines are laid out on a circle."""
        return self._by_weights is None

    def mesh(self, outline: ComplexArray, t: float) -> Mesh:
        """Return the triangles inside the outline at time t; raise NotSimpleError if it crosses itself."""
        if self._by_weights is not None:
            mesh = self._by_weights.mesh(outline, t)
            if _is_sound(mesh):
                return mesh
        return self._laid_out(outline)

    def _ways(self) -> list[_ByWeights]:
        """Return ways with the triangles of one outline in the other one, too."""
        found = []
        for here, there, is_back in ((self._a, self._b, False), (self._b, self._a, True)):
            try:
                way = _ByWeights.of(here, there, is_back=is_back)
            except NotSimpleError:
                continue
            if way is not None:
                found.append(way)
        return found

    @cached_property
    def _circle(self) -> ComplexArray:
        """The places of the outlines' points on a circle, by the mean of their distances."""
        steps = np.mean(
            [np.abs(np.roll(p, -1) - p) / np.abs(np.roll(p, -1) - p).sum() for p in (self._a, self._b)], 0
        )
        steps = np.maximum(steps, 1e-3 / len(steps))
        angles = 2.0 * np.pi * (np.cumsum(steps) - steps[0]) / steps.sum()
        return np.exp(1j * angles)

    @cached_property
    def _layouts(self) -> tuple[_Layout, _Layout]:
        return _Layout.of(self._a, self._circle), _Layout.of(self._b, self._circle)

    def _laid_out(self, outline: ComplexArray) -> Mesh:
        """Return the triangles of an outline, and the places that are at the same spots of the circle."""
        own = _Layout.of(outline, self._circle)
        places = [layout.at(own.spots[len(outline) :]) for layout in self._layouts]
        in_a, in_b = (np.append(end, inner) for end, inner in zip((self._a, self._b), places, strict=True))
        return Mesh(own.points, own.triangles, in_a, in_b)


class _ByWeights(NamedTuple):
    """Triangles that are the same at all times, by the weights of their points at both ends."""

    triangles: IntArray
    ends: tuple[ComplexArray, ComplexArray]
    weights: tuple[FloatArray, FloatArray]

    @classmethod
    def of(cls, here: ComplexArray, there: ComplexArray, *, is_back: bool) -> _ByWeights | None:
        """Return the triangles of an outline here in the one there; None if one turns over there."""
        points, triangles = triangulated(here, _spacing(here))
        own = _weights(points, triangles, len(here))
        others = np.append(there, _means(own, there))
        if not _are_sound(others, triangles):
            return None
        other = _weights(others, triangles, len(there))
        ends, weights = (points, others), (own, other)
        return cls(triangles, ends[::-1], weights[::-1]) if is_back else cls(triangles, ends, weights)

    def mesh(self, outline: ComplexArray, t: float) -> Mesh:
        """Return the triangles inside an outline at time t, whether they are sound or not."""
        start, end = self.weights
        inner = _means((1.0 - t) * start + t * end, outline)
        return Mesh(np.append(outline, inner), self.triangles, *self.ends)


class _Layout(NamedTuple):
    """The triangles of an outline, and the spots of their corners within a circle."""

    points: ComplexArray
    triangles: IntArray
    spots: ComplexArray

    @classmethod
    def of(cls, outline: ComplexArray, circle: ComplexArray) -> _Layout:
        """Return an outline with its points laid on a circle."""
        points, triangles = triangulated(outline, _spacing(outline))
        inner = _means(_weights(points, triangles, len(outline)), circle)
        return cls(points, triangles, np.append(circle, inner))

    def at(self, spots: ComplexArray) -> ComplexArray:
        """Return the places that are laid at some spots."""
        a, b, c = self.spots[self.triangles.T]
        areas = doubled_areas(self.spots, self.triangles)
        sides = [((q - p).conj() * (spots[:, None] - p)).imag / areas for p, q in ((b, c), (c, a), (a, b))]
        found = np.min(sides, axis=0).argmax(axis=1)  # by rounding it may be just beyond
        shares = np.stack([side[np.arange(len(spots)), found] for side in sides], axis=1)
        places: ComplexArray = (shares * self.points[self.triangles[found]]).sum(axis=1)
        return places


def _spacing(outline: ComplexArray) -> float:
    area = 0.5 * float((outline.conj() * np.roll(outline, -1)).imag.sum())
    if area <= 0.0:
        raise NotSimpleError
    return math.sqrt(1.15 * area / INNER)


def _weights(points: ComplexArray, triangles: IntArray, count: int) -> FloatArray:
    """Return the weights of all points for each that is not among the first `count`, positive, with a sum of 1."""
    weights = np.zeros((len(points), len(points)))
    for k in range(3):
        own, left, right = (triangles[:, (k + n) % 3] for n in range(3))
        one, other = points[left] - points[own], points[right] - points[own]
        # The tangent of half of the angle between them.
        product = other * one.conj()
        half = product.imag / (np.abs(product) + product.real)
        np.add.at(weights, (own, left), half / np.abs(one))
        np.add.at(weights, (own, right), half / np.abs(other))
    inner = weights[count:]
    found: FloatArray = inner / inner.sum(axis=1, keepdims=True)
    return found


def _means(weights: FloatArray, outline: ComplexArray) -> ComplexArray:
    """Return the places of inside points: each is the mean of all others by its weights."""
    count = len(outline)
    sides = np.einsum("ij,jk->ik", weights[:, :count], np.stack([outline.real, outline.imag], axis=1))
    found = _solved(np.eye(len(weights)) - weights[:, count:], sides)
    return found[:, 0] + 1j * found[:, 1]


def _solved(matrix: FloatArray, sides: FloatArray) -> FloatArray:
    """Return the solution of equations whose diagonal outweighs the rest of each row: no rows change places.

    Not by LAPACK, whose threads wait for each other longer than this takes where processors are busy.
    """
    rows, count = np.concatenate([matrix, sides], axis=1), len(matrix)
    for k in range(count - 1):
        below = np.flatnonzero(rows[k + 1 :, k]) + k + 1
        rows[below, k:] -= (rows[below, k] / rows[k, k])[:, None] * rows[k, k:]
    found = np.zeros_like(sides)
    for k in range(count - 1, -1, -1):
        known = (rows[k, k + 1 : count, None] * found[k + 1 :]).sum(axis=0)
        found[k] = (rows[k, count:] - known) / rows[k, k]
    return found


def _are_sound(points: ComplexArray, triangles: IntArray) -> bool:
    """Return whether no triangle is turned over, or without an area."""
    box = np.ptp(points.real) * np.ptp(points.imag)
    areas: BoolArray = doubled_areas(points, triangles) > LEAST_AREA * box
    return bool(areas.all())


def _is_sound(mesh: Mesh) -> bool:
    """Return whether a mesh has no triangle that is turned over."""
    return _are_sound(mesh.points, mesh.triangles)


def _holds(way: _ByWeights, between: Sequence[tuple[float, ComplexArray]]) -> bool:
    """Return whether no triangle is turned over at any of some times."""
    return all(_is_sound(way.mesh(outline, t)) for t, outline in between)
