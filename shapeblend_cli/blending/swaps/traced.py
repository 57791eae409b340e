"""The silhouette of a picture: one outline around nearly all that is painted."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.geometry.polygons import signed_area

if TYPE_CHECKING:
    from shapeblend_cli.model import BoolArray, ComplexArray, PictureArray

CLOSING = 2
"""Number of pixels by which ink grows before it shrinks again: gaps up to twice as wide close."""

MARGIN = 2 * CLOSING
"""Number of pixels beside a picture, where ink that reaches its edge grows."""

LOOSE = 0.2
"""Maximum area of what lies apart from the silhouette, as a share of its own."""

HOLES = 0.15
"""Maximum area of the holes in it, as a share of its own: a ring is more than its outline."""

EVEN = 256
"""Number of points, evenly along an outline, that are smoothed."""

SMOOTH = 1.5
"""Standard deviation of the smoothing along an outline, in pixels: its points are corners of pixels."""

VERTICES = 64
"""Number of vertices of a silhouette; it divides `EVEN`."""


def silhouette(ink: PictureArray) -> ComplexArray | None:
    """Return the outline around the ink of a picture, in pixels, or None where there is more to see than one outline.

    Parameters
    ----------
    ink : (side, side) float
        Opacities, from 0 to 1; a row for each y.

    Returns
    -------
    (VERTICES,) complex or None
        About evenly along the outline, which runs from x towards y. The first pixel has its corners at 0 and 1 + 1j.
    """
    loops = outlines(~grown(~grown(np.pad(ink > 0.5, MARGIN), CLOSING), CLOSING))
    areas = [signed_area(loop) for loop in loops]
    if not loops or max(areas) <= 0.0:
        return None
    whole = max(areas)
    holes = -sum(area for area in areas if area < 0.0)
    if sum(area for area in areas if area > 0.0) - whole > LOOSE * whole or holes > HOLES * whole:
        return None
    corners = loops[areas.index(whole)] - MARGIN * (1.0 + 1.0j)
    at = np.arange(EVEN) * (len(corners) / EVEN)
    line = np.append(corners, corners[0])
    even = np.interp(at, np.arange(len(line)), line)
    deviation = 2.0 * np.pi * SMOOTH / len(corners)
    waves = np.fft.fft(even) * np.exp(-0.5 * (deviation * np.fft.fftfreq(EVEN, 1.0 / EVEN)) ** 2)
    smoothed: ComplexArray = np.fft.ifft(waves)[:: EVEN // VERTICES]
    return smoothed


def outlines(mask: BoolArray) -> list[ComplexArray]:
    """Return the outlines of the pixels that are set, each by the corners of pixels along it.

    Outer ones run from x towards y, those of holes the other way round. No pixel at the edge of the mask may be set.
    """
    after: dict[complex, list[complex]] = {}
    for axis, (first, last) in ((0, (0, 1)), (1, (1j, 0))):
        # Where set pixels begin and end in a column, or in a row; edges run with these on one and the same side.
        change = np.diff(mask.astype(np.int8), axis=axis)
        for sign, (start, end) in ((1, (first, last)), (-1, (last, first))):
            rows, columns = np.nonzero(change == sign)
            corners = columns + 1j * rows + (1j if axis == 0 else 1.0)
            for corner in corners.tolist():
                after.setdefault(corner + start, []).append(corner + end)
    loops = []
    while after:
        # Two ways lead on from where pixels touch at a corner only. There an outline turns towards its own pixels.
        place = next(corner for corner, ends in after.items() if len(ends) == 1)
        loop, step = [], 0j
        while place in after:
            loop.append(place)
            ends = after[place]
            end = max(ends, key=lambda end: ((end - place) * step.conjugate()).imag)
            ends.remove(end)
            if not ends:
                del after[place]
            place, step = end, end - place
        loops.append(np.array(loop))
    return loops


def grown(mask: BoolArray, steps: int) -> BoolArray:
    """Return a mask with all pixels within so many steps of those that are set."""
    for _ in range(steps):
        wide = np.pad(mask, 1, mode="edge")
        mask = wide[1:-1, 1:-1] | wide[:-2, 1:-1] | wide[2:, 1:-1] | wide[1:-1, :-2] | wide[1:-1, 2:]
    return mask
