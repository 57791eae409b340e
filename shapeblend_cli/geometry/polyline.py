"""Polylines: length along them, points at given lengths, repeated points, and fewer points."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from shapeblend_cli.model import ComplexArray, FloatArray, IntArray


def from_end_to_end(vertices: ComplexArray, closed: bool) -> ComplexArray:
    """Return the vertices, of a closed polygon with the first repeated at the end."""
    return np.append(vertices, vertices[0]) if closed else vertices


def cumulative_lengths(points: ComplexArray) -> FloatArray:
    """Return the length from the first point up to each, (n,) float."""
    return np.concatenate([[0.0], np.cumsum(np.abs(np.diff(points)))])


def points_at(positions: FloatArray, points: ComplexArray, known: FloatArray) -> ComplexArray:
    """Return points at positions along a polyline, where the positions of its own points are known."""
    x, y = np.interp(positions, known, points.real), np.interp(positions, known, points.imag)
    return np.asarray(x + 1j * y)


def distinct(points: ComplexArray, closed: bool, distance: float) -> IntArray:
    """Return the numbers of the points that are further than `distance` from the last one kept."""
    near = np.abs(np.diff(points)) <= distance
    if near.any():
        kept = [0]
        for k in range(1, len(points)):
            if abs(points[k] - points[kept[-1]]) > distance:
                kept.append(k)
    else:
        kept = list(range(len(points)))
    while closed and len(kept) > 1 and abs(points[kept[-1]] - points[kept[0]]) <= distance:
        kept.pop()
    return np.array(kept, np.intp)


def thin(points: ComplexArray, most: int) -> ComplexArray:
    """Return every k-th point, with the smallest k for at most `most` points."""
    return points[:: -(-len(points) // most)]


def nearest_places(points: ComplexArray, line: ComplexArray) -> tuple[FloatArray, FloatArray]:
    """Return the distance of each point from a polyline, and the nearest place: edge number plus share of the edge.

    Parameters
    ----------
    points : (p,) complex
    line : (n,) complex, n >= 2

    Returns
    -------
    distance, place : (p,) float
    """
    edges = np.diff(line)
    offsets = points[:, None] - line[:-1]
    squares = np.maximum(edges.real**2 + edges.imag**2, 1e-300)
    shares = np.clip((offsets * edges.conj()).real / squares, 0.0, 1.0)
    distances = np.abs(offsets - shares * edges)
    nearest = distances.argmin(axis=1)
    rows = np.arange(len(points))
    return distances[rows, nearest], nearest + shares[rows, nearest]
