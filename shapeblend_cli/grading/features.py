"""Features of a strip of pictures that tell how good it looks: each is 0 where nothing is wrong.

Both ends are taken to be right. What lies between is compared with an even change from one end to the other, or with
that end which has more. Radii are in pixels of pictures with 96 x 96 of them.
"""

from __future__ import annotations

from itertools import combinations
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

INNER = slice(1, -1)


class Features(NamedTuple):
    """What is wrong with a strip, by how much."""

    edges_lost: float  # length of edges below that of an even change
    size_off: float  # how far the spread of the ink is from an even change
    lumps: float  # ink deeper than `LUMP` beyond that of the ends
    slivers: float  # ink so thin that opening removes it, beyond an even change
    spikes: float  # edges around which there is little ink, beyond those of the ends
    notches: float  # edges around which there is much ink, beyond those of the ends
    directions: float  # edges in directions that neither end has
    lopsided: float  # asymmetry beyond an even change, about the upright or the level axis
    patches: float  # patches of one colour beyond those of the ends
    pieces: float  # separate pieces beyond those of the ends
    pop: float  # the largest change from a frame to the next, over the mean
    detail: float  # length of edges at the ends: what has much detail fails more often


HALVES = Features(
    edges_lost=0.016,
    size_off=0.08,
    lumps=0.012,
    slivers=0.003,
    spikes=0.15,
    notches=0.1,
    directions=0.016,
    lopsided=0.03,
    patches=3.0,
    pieces=1.0,
    pop=0.12,
    detail=5.0,
)
"""Amounts of the features that add half as much to a grade as the worst would: what is seen first counts most."""

PAIRS = np.array(list(combinations([k for k, name in enumerate(Features._fields) if name != "pop"], 2)))
"""Places of two features that people see at once; a sudden change is no fault of a picture."""


def shares(found: FloatArray) -> FloatArray:
    """Return features, (..., 12), as shares of the worst: 0 where nothing is wrong, and less than 1."""
    amounts = np.maximum(found, 0.0)
    return amounts / (amounts + np.array(HALVES))


def terms(found: FloatArray) -> FloatArray:
    """Return shares, (..., 12), and after them their products two by two, in the order of `PAIRS`."""
    return np.concatenate([found, found[..., PAIRS[:, 0]] * found[..., PAIRS[:, 1]]], axis=-1)


def features(strip: Sequence[PictureArray]) -> Features:
    """Measure a strip of pictures at even times.

    Parameters
    ----------
    strip : sequence of (4, n, n) float
        Three to eight pictures: red, green and blue times opacity, and opacity, from 0 to 1; the first and the last
        are the ends.

    Returns
    -------
    Features
    """
    pictures = np.stack(strip)
    if not pictures[:, :3].any():
        pictures = pictures[:, 3:]  # all is black: what changes is opacity alone
    ink = pictures[:, -1]
    solid = ink > 0.5
    bare = 1.0 - ink
    on_white = bare[:, None] if pictures.shape[1] == 1 else pictures[:, :3] + bare[:, None]
    side, area = ink.shape[-1], ink.mean(axis=(1, 2))
    size = 0.5 * (area[0] + area[-1]) + 0.01
    lengths = edges(pictures)
    border, thin, deep = _eroded(solid)
    spikes, notches = _corners(solid, border)
    patches, _, pieces = regions(on_white, solid)
    steps = _steps(pictures) + 1e-3
    edge_ratio = _ratio(lengths, 0.1)
    return Features(
        edges_lost=float(np.maximum(-edge_ratio, 0.0).mean()),
        size_off=float(np.abs(_ratio(_spread(ink), 0.01)).mean()),
        lumps=_beyond_ends(deep / size),
        slivers=_beyond_even(thin / size),
        spikes=_beyond_ends(spikes / side),
        notches=_beyond_ends(notches / side),
        directions=_other_directions(1.0 - on_white.mean(axis=1)),
        lopsided=_beyond_even(_asymmetry(pictures) / (area + 0.02)),
        patches=_beyond_ends(patches),
        pieces=_beyond_ends(pieces),
        pop=float(np.log(steps.max() / steps.mean())),
        detail=float(0.5 * (lengths[0] + lengths[-1])),
    )


def even(values: FloatArray) -> FloatArray:
    """Return an even change from the first value to the last."""
    return np.linspace(values[0], values[-1], len(values))


def _ratio(values: FloatArray, little: float) -> FloatArray:
    """Return the logarithms of values within over those of an even change, both with a little more."""
    return np.log((values + little) / (even(values) + little))[INNER]


def _beyond_ends(values: FloatArray) -> float:
    """Return by how much values within exceed both ends, on average."""
    return float(np.maximum(values - max(values[0], values[-1]), 0.0)[INNER].mean())


def _beyond_even(values: FloatArray) -> float:
    """Return by how much values within exceed an even change, on average."""
    return float(np.maximum(values - even(values), 0.0)[INNER].mean())


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


def _other_directions(dark: PictureArray) -> float:
    """Return the length of edges in directions that neither end has, as a share of those that an end has."""
    smooth = _smoothed(_smoothed(dark))
    right = (smooth[:, 1:-1, 2:] - smooth[:, 1:-1, :-2]).ravel()
    down = (smooth[:, 2:, 1:-1] - smooth[:, :-2, 1:-1]).ravel()
    square = right * right + down * down
    at = np.flatnonzero(square > FAINT)
    sector = (np.arctan2(down[at], right[at]) % np.pi * (SECTORS / np.pi)).astype(np.intp) % SECTORS
    frame = at // (len(square) // len(dark))
    lengths = np.bincount(frame * SECTORS + sector, np.sqrt(square[at]), SECTORS * len(dark))
    lengths = lengths.reshape(-1, SECTORS)
    lengths = 0.5 * lengths + 0.25 * (rolled(lengths.T, 1) + rolled(lengths.T, -1)).T
    known = np.maximum(lengths[0], lengths[-1])
    return float(np.maximum(lengths - known, 0.0).sum(axis=1)[INNER].mean() / (known.sum() + 2.0))


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


def _steps(pictures: PictureArray) -> FloatArray:
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
    for numbers, inked in zip(_colours(on_white, solid), solid, strict=True):
        patches, holes = count_regions(numbers, LEAST_REGION)
        is_plain = np.array_equal(numbers == numbers.max(), inked)
        pieces = patches if is_plain else count_regions(inked.astype(np.intc), LEAST_REGION)[0]
        found.append((patches, holes, pieces))
    patches, holes, pieces = np.array(found, np.float64).T
    return patches, holes, pieces


def _colours(on_white: PictureArray, solid: BoolArray) -> IntArray:
    """Return a number for each colour that can be told apart; 0 where nothing is painted."""
    steps = np.rint(SHADES * on_white).astype(np.intc)
    numbers = steps[:, 0]
    for k in range(1, steps.shape[1]):
        numbers = numbers * (SHADES + 1) + steps[:, k]
    return np.where(solid, numbers + 1, 0).astype(np.intc, copy=False)
