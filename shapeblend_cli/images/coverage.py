"""How much of each pixel lies inside a path."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.model.arrays import numbered

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import Clip, ComplexArray, CubicPath, FloatArray, UIntArray

TOLERANCE = 0.005
"""Maximum distance of a curve from its chords, in pixels."""

MOST_CHORDS = 1000
"""Maximum number of chords of a segment."""

MOST_CROSSINGS = 1_000_000
"""Maximum number of crossings of edges and lines that are looked at together, unless one row has more."""

LINES = 16
"""Number of lines in a row of pixels, on each of which what lies inside is exact."""


def coverage(clips: Sequence[Clip], corner: complex, scale: float, width: int, height: int) -> UIntArray:
    """Return how much of each pixel lies in all of some regions.

    Parameters
    ----------
    clips : sequence of Clip
    corner : complex
        Where the first pixel begins.
    scale : float
        Pixels in a unit of length.
    width, height : int
        Size in pixels.

    Returns
    -------
    (height, width) uint8
        255 where a pixel lies inside as a whole.
    """
    seen = np.full((height, width), 255, np.uint8)
    for clip in clips:
        lines = [scale * (_line(path, scale) - corner) for path in clip.paths]
        share = _covered(lines, clip.rule, width, height)
        seen = np.rint(seen * share).astype(np.uint8)
    return seen


def _line(path: CubicPath, scale: float) -> ComplexArray:
    """Return the points of a path of chords."""
    segments = path.segments
    bends = np.abs(np.diff(segments, 2, axis=1)).max(axis=1)
    # A chord of a cubic is off by an eighth of its second derivative, which is at most six times the bend.
    counts = np.ceil(np.sqrt(0.75 * scale * bends / TOLERANCE))
    counts = np.clip(np.where(path.straight, 1.0, counts), 1, MOST_CHORDS).astype(int)
    numbers = np.repeat(np.arange(len(segments)), counts)
    t = numbered(counts) / counts[numbers]
    s, (a, b, c, d) = 1.0 - t, segments[numbers].T
    points = s**3 * a + 3.0 * s * s * t * b + 3.0 * s * t * t * c + t**3 * d
    return np.append(points, segments[-1, 3])


def _covered(lines: Sequence[ComplexArray], rule: str, width: int, height: int) -> FloatArray:
    """Return the share of each pixel, from 0 to 1, that is inside of closed lines by a fill rule."""
    starts, ends = np.concatenate(lines), np.concatenate([np.roll(line, -1) for line in lines])
    # The middles of lines within rows that an edge crosses are those from `first` on, before `last`.
    heights = np.stack([starts.imag, ends.imag]) * LINES - 0.5
    first, last = np.clip(np.ceil(np.sort(heights, axis=0)), 0, height * LINES).astype(int)
    counts = last - first
    if counts.sum() > MOST_CROSSINGS and height > 1:
        half = height // 2
        lower = [line - 1j * half for line in lines]
        parts = _covered(lines, rule, width, half), _covered(lower, rule, width, height - half)
        return np.concatenate(parts)
    edge = np.repeat(np.arange(len(starts)), counts)
    line = numbered(counts) + first[edge]
    slope = (ends.real - starts.real) / np.where(ends.imag == starts.imag, 1.0, ends.imag - starts.imag)
    x = starts.real[edge] + ((line + 0.5) / LINES - starts.imag[edge]) * slope[edge]
    order = np.lexsort((x, line))
    x, line = np.clip(x[order], 0.0, width), line[order]
    # Along each line, and so along all of them, the windings add up to none.
    turn = np.where(ends.imag > starts.imag, 1, -1)[edge[order]]
    winding = np.cumsum(turn)
    is_inside = winding % 2 != 0 if rule == "evenodd" else winding != 0
    change = np.diff(is_inside.astype(int), prepend=0)
    column = np.floor(x).astype(int)
    place = line // LINES * (width + 2) + column
    beyond = change * (x - column)
    size = height * (width + 2)
    changes = np.bincount(place, change - beyond, size) + np.bincount(place + 1, beyond, size)
    covered: FloatArray = np.cumsum(changes.reshape(height, width + 2), axis=1)[:, :width] / LINES
    return np.clip(covered, 0.0, 1.0)
