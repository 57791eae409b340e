"""What there is to see in each picture of a strip: edges, ink, corners, pieces.

Radii are in pixels of pictures with 96 x 96 of them.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.geometry.regions import count_regions
from shapeblend_cli.model.arrays import rolled

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import BoolArray, FloatArray, IntArray, PictureArray, UIntArray

LEAST_REGION = 6
"""Minimum size of a region that is seen, in pixels."""

SHADES = 7
"""Number of steps of each channel between colours that are told apart."""

LUMP = 6
"""Maximum depth of ink that is no lump, in erosions by one pixel: twice as thick as most pens."""

NEAR = 3
"""Distance from a pixel to the sides of the square in which spikes are told, in pixels."""

AROUND = 7
"""Distance from a pixel to the sides of the square in which notches are told, in pixels."""

SPIKE = 0.3
"""Maximum share of ink around a pixel of a spike: at a straight edge it is a half."""

NOTCH = 0.7
"""Minimum share of ink around a pixel on the edge of a notch."""

SECTORS = 24
"""Number of directions of edges that are told apart."""

FAINT = 0.003
"""Minimum square of the change of brightness over two pixels of an edge whose direction is taken."""

COARSE = 4
"""Sides of the squares in which sudden changes are told, in pixels."""


class Seen(NamedTuple):
    """What is seen in each of n pictures."""

    pictures: PictureArray  # (n, channels, side, side); if all is black, opacity is the only channel
    on_white: PictureArray  # (n, 1 or 3, side, side), on white paper
    dark: PictureArray  # (n, side, side), how dark it is there, smoothed
    edges: FloatArray  # (n,) and so are those below: length of edges, in sides
    spread: FloatArray  # how far the ink lies from its centre, in sides
    border: FloatArray  # number of border pixels, over the side
    deep: FloatArray  # share of ink deeper than `LUMP`
    thin: FloatArray  # share of ink that opening removes
    spikes: FloatArray  # number of border pixels with little ink near them, over the side
    notches: FloatArray  # number of those with much ink around them, over the side
    patches: FloatArray  # number of patches of one colour
    holes: FloatArray
    pieces: FloatArray  # number of separate pieces
    asymmetry: FloatArray  # difference from the mirror image
    lengths: FloatArray  # (n, `SECTORS`), length of edges by directions
    steps: FloatArray  # (n - 1,), change from each picture to the next

    @property
    def ink(self) -> PictureArray:
        """Opacity, (n, side, side)."""
        return self.pictures[:, -1]

    @property
    def area(self) -> FloatArray:
        """Share of each picture that is inked, (n,)."""
        return self.ink.mean(axis=(1, 2))


def look(strip: Sequence[PictureArray]) -> Seen:
    """Return what is seen in a strip of pictures at even times.

    Parameters
    ----------
    strip : sequence of (4, n, n) float
        Three to eight pictures: red, green and blue times opacity, and opacity, from 0 to 1; the first and the last
        are the ends.
    """
    pictures = np.stack(strip)
    if not pictures[:, :3].any():
        pictures = pictures[:, 3:]  # all is black: what changes is opacity alone
    ink = pictures[:, -1]
    solid, side = ink > 0.5, ink.shape[-1]
    bare = 1.0 - ink
    on_white = bare[:, None] if pictures.shape[1] == 1 else pictures[:, :3] + bare[:, None]
    dark = _smoothed(_smoothed(1.0 - on_white.mean(axis=1)))
    border, thin, deep = _eroded(solid)
    spikes, notches = _corners(solid, border)
    patches, holes, pieces = regions(on_white, solid)
    return Seen(
        pictures=pictures,
        on_white=on_white,
        dark=dark,
        edges=edges(pictures),
        spread=_spread(ink),
        border=border.mean(axis=(1, 2)) * side,
        deep=deep,
        thin=thin,
        spikes=spikes / side,
        notches=notches / side,
        patches=patches,
        holes=holes,
        pieces=pieces,
        asymmetry=_asymmetry(pictures),
        lengths=_lengths(dark),
        steps=steps(pictures),
    )


def even(values: FloatArray) -> FloatArray:
    """Return an even change from the first value to the last."""
    return np.linspace(values[0], values[-1], len(values))


def largest(differences: PictureArray) -> PictureArray:
    """Return the largest difference of the channels, (n, channels, ...), at each pixel."""
    first, *others = np.abs(differences, out=differences).swapaxes(0, 1)
    for other in others:
        np.maximum(first, other, out=first)
    return first


def edges(pictures: PictureArray) -> FloatArray:
    """Return the length of edges in each picture, in its sides: by crossings in four directions (Crofton)."""
    side = pictures.shape[-1]
    lengths = np.zeros(len(pictures))
    for rows, columns, spacing in ((0, 1, 1.0), (1, 0, 1.0), (1, 1, 2**-0.5), (1, -1, 2**-0.5)):
        one = pictures[..., : side - rows, max(0, -columns) : side - max(0, columns)]
        next_one = pictures[..., rows:, max(0, columns) : side + min(0, columns)]
        lengths += spacing * largest(next_one - one).sum(axis=(1, 2))
    return np.pi / 8.0 * lengths / side


def _spread(ink: PictureArray) -> FloatArray:
    """Return how far the ink of each picture lies from its centre, in sides of the picture: the standard deviation."""
    places = np.arange(ink.shape[-1]) / ink.shape[-1]
    moments = np.zeros(len(ink))
    total = ink.sum(axis=(1, 2)) + 1e-9
    for axis in (1, 2):
        along = ink.sum(axis=axis)
        moments += along @ places**2 / total - (along @ places / total) ** 2
    return np.sqrt(np.maximum(moments, 0.0))


def _shifted(bits: UIntArray, corners: bool, grow: bool) -> UIntArray:
    """Return pictures eroded, or grown, by one pixel: in eight directions or, without corners, in four."""
    join = np.bitwise_or if grow else np.bitwise_and
    padded = np.pad(bits, 1)
    middle = padded[1:-1]
    across = join(join(middle[:, :-2], middle[:, 2:]), bits)
    if not corners:
        return join(join(padded[:-2, 1:-1], padded[2:, 1:-1]), across)
    padded[1:-1, 1:-1] = across
    return join(join(padded[:-2, 1:-1], padded[2:, 1:-1]), across)


def _eroded(solid: BoolArray) -> tuple[BoolArray, FloatArray, FloatArray]:
    """Return the border pixels of ink, and the shares that opening removes and that lie deeper than `LUMP`."""
    # A bit for each picture: all are eroded at once.
    bits = left = border = thin = np.packbits(solid, axis=0)[0]
    for k in range(LUMP):
        left = _shifted(left, corners=k % 2 == 0, grow=False)  # square and diamond in turn: an octagon
        if k == 0:
            border = bits & ~left
        if k == 1:
            thin = bits & ~_shifted(_shifted(left, corners=False, grow=True), corners=True, grow=True)
    borders, thins, deep = np.unpackbits(np.stack([border, thin, left])[:, None], axis=1, count=len(solid))
    return borders.astype(np.bool_), thins.mean(axis=(1, 2)), deep.mean(axis=(1, 2))


def _corners(solid: BoolArray, border: BoolArray) -> tuple[FloatArray, FloatArray]:
    """Return how many pixels of each border have little ink near them, and how many have much around them."""
    margin, count = AROUND + 1, len(solid)
    sums = np.pad(solid, ((0, 0), (margin, AROUND), (margin, AROUND)))
    sums = sums.cumsum(axis=2, dtype=np.int16).cumsum(axis=1, dtype=np.int16)
    width, frame = sums.shape[2], sums.shape[1] * sums.shape[2]
    frames, rows, columns = np.nonzero(border)
    at, flat, found = frames * frame + (rows + margin) * width + columns + margin, sums.ravel(), []
    for reach in (NEAR, AROUND):
        low, high = (reach + 1) * (width + 1), reach * (width + 1)
        across = reach * (width - 1)
        ink = flat[at + high] - flat[at - across - width] - flat[at + across - 1] + flat[at - low]
        found.append(ink / (2.0 * reach + 1.0) ** 2)
    little, much = (found[0] < SPIKE).astype(np.float64), (found[1] > NOTCH).astype(np.float64)
    counts = [np.bincount(frames, one, count) for one in (little, much)]
    return np.asarray(counts[0], np.float64), np.asarray(counts[1], np.float64)


def _lengths(dark: PictureArray) -> FloatArray:
    """Return the length of edges of each smooth picture by their directions, (n, `SECTORS`)."""
    right = (dark[:, 1:-1, 2:] - dark[:, 1:-1, :-2]).ravel()
    down = (dark[:, 2:, 1:-1] - dark[:, :-2, 1:-1]).ravel()
    square = right * right + down * down
    at = np.flatnonzero(square > FAINT)
    sector = (np.arctan2(down[at], right[at]) % np.pi * (SECTORS / np.pi)).astype(np.intp) % SECTORS
    frame = at // (len(square) // len(dark))
    lengths = np.bincount(frame * SECTORS + sector, np.sqrt(square[at]), SECTORS * len(dark))
    return np.asarray(lengths.reshape(-1, SECTORS), np.float64)


def strange(lengths: FloatArray) -> tuple[FloatArray, float]:
    """Return the lengths of edges, (n,), in directions that neither end has, and of those that an end has."""
    lengths = 0.5 * lengths + 0.25 * (rolled(lengths.T, 1) + rolled(lengths.T, -1)).T
    known = np.maximum(lengths[0], lengths[-1])
    return np.maximum(lengths - known, 0.0).sum(axis=1), float(known.sum())


def _smoothed(dark: PictureArray) -> PictureArray:
    """Return means with weights of 1, 2, 1 in both directions; what lies outside is bright."""
    rows = 2.0 * dark
    rows[:, 1:] += dark[:, :-1]
    rows[:, :-1] += dark[:, 1:]
    found = 2.0 * rows
    found[:, :, 1:] += rows[:, :, :-1]
    found[:, :, :-1] += rows[:, :, 1:]
    found /= 16.0
    return found


def steps(pictures: PictureArray) -> FloatArray:
    """Return the mean change from each picture to the next, in coarse squares."""
    end = pictures.shape[-1] // COARSE * COARSE
    rows = np.add.reduce([pictures[:, :, k:end:COARSE, :end] for k in range(COARSE)])
    coarse = np.add.reduce([rows[..., k::COARSE] for k in range(COARSE)]) / COARSE**2
    return largest(coarse[1:] - coarse[:-1]).mean(axis=(1, 2))


def _asymmetry(pictures: PictureArray) -> FloatArray:
    """Return how far each picture differs from its mirror image, about that of two axes where it does so less."""
    half = pictures.shape[-1] // 2
    across = largest(pictures[..., :half] - pictures[..., : -half - 1 : -1])
    upside = largest(pictures[..., :half, :] - pictures[..., : -half - 1 : -1, :])
    return np.minimum(across.mean(axis=(1, 2)), upside.mean(axis=(1, 2)))


def regions(on_white: PictureArray, solid: BoolArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return the numbers of patches of one colour, of holes, and of separate pieces, in each picture."""
    found = []
    for shown, inked in zip(on_white, solid, strict=True):
        numbers = _colours(shown, inked)
        patches, holes = count_regions(numbers, LEAST_REGION)
        is_plain = np.array_equal(numbers == numbers.max(), inked)
        pieces = patches if is_plain else count_regions(inked.astype(np.intc), LEAST_REGION)[0]
        found.append((patches, holes, pieces))
    patches, holes, pieces = np.array(found, np.float64).T
    return patches, holes, pieces


def _colours(on_white: PictureArray, solid: BoolArray) -> IntArray:
    """Return a number for each colour of a picture that can be told apart; 0 where nothing is painted."""
    numbers, *others = np.rint(SHADES * on_white).astype(np.intc)
    for steps in others:
        numbers = numbers * (SHADES + 1) + steps
    return np.where(solid, numbers + 1, 0).astype(np.intc, copy=False)
