"""Features of a strip of pictures that tell how good it looks: each is 0 where nothing is wrong.

Both ends are taken to be right. What lies between is compared with an even change from one end to the other, mostly by
the logarithm of the ratio, so that twice as much is as wrong as half as much.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.geometry.regions import count_regions

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import BoolArray, FloatArray, IntArray, PictureArray

LEAST_REGION = 6
"""Minimum size of a region that is seen, in pixels."""

SHADES = 7
"""Number of steps of each channel between colours that are told apart."""

LITTLE = 1e-3
"""Addition to amounts before ratios, as a share of the picture: what is less is not seen."""

INNER = slice(1, -1)


class Features(NamedTuple):
    """What is wrong with a strip, by how much."""

    edges_lost: float  # the deepest loss of the total length of edges
    edges_off: float  # how far that length is from an even change, on average
    ink_lost: float  # the deepest loss of the painted area
    ink_off: float  # how far that area is from an even change, on average
    swollen: float  # the largest gain of the greatest thickness
    thickness_off: float  # how far the mean thickness is from an even change, on average
    patches: float  # patches of one colour beyond those of an even change
    pieces: float  # separate pieces beyond those at the ends
    holes: float  # holes beyond those at the ends
    detail: float  # patches at the ends: what has many parts fails more often
    detour: float  # change from frame to frame, added up, over the change from end to end
    pop: float  # the largest change from a frame to the next, over the mean
    common_lost: float  # ink lost that both ends have
    outside: float  # ink where neither end has any
    lopsided: float  # asymmetry beyond that of the ends
    grey: float  # the deepest loss of saturation below both ends


def features(strip: Sequence[PictureArray]) -> Features:
    """Measure a strip of three pictures or more at even times.

    Parameters
    ----------
    strip : sequence of (4, n, n) float
        Red, green and blue times opacity, and opacity, from 0 to 1; the first and the last are the ends.

    Returns
    -------
    Features
    """
    pictures = np.stack(strip)
    ink = pictures[:, 3]
    solid = ink > 0.5
    on_white = pictures[:, :3] + (1.0 - ink[:, None])
    edges, area = _edges(pictures), ink.mean(axis=(1, 2))
    greatest = _thickness(solid)
    regions = np.array([count_regions(numbers, LEAST_REGION) for numbers in _colours(on_white, solid)])
    pieces = np.array([count_regions(one.astype(np.intc), LEAST_REGION)[0] for one in solid])
    saturation = _saturation(on_white, solid)
    steps = _largest(pictures[1:] - pictures[:-1]).mean(axis=(1, 2))
    whole = float(_largest(pictures[-1:] - pictures[:1]).mean())
    both, either = np.minimum(ink[0], ink[-1]), _grown(np.maximum(ink[0], ink[-1]))
    edge_ratio, ink_ratio, mean_ratio = _ratio(edges), _ratio(area), _ratio(area / (edges + LITTLE))
    missing, beyond = (
        np.maximum(both - ink, 0.0).mean(axis=(1, 2)),
        np.maximum(ink - either, 0.0).mean(axis=(1, 2)),
    )
    return Features(
        edges_lost=float(np.maximum(-edge_ratio, 0.0).max()),
        edges_off=float(np.abs(edge_ratio).mean()),
        ink_lost=float(np.maximum(-ink_ratio, 0.0).max()),
        ink_off=float(np.abs(ink_ratio).mean()),
        swollen=float(np.maximum(_ratio(greatest, 0.01), 0.0).max()),
        thickness_off=float(np.abs(mean_ratio).mean()),
        patches=_more(regions[:, 0] - _even(regions[:, 0])),
        pieces=_more(pieces - max(pieces[0], pieces[-1])),
        holes=_more(regions[:, 1] - max(regions[0, 1], regions[-1, 1])),
        detail=float(np.log1p(0.5 * (regions[0, 0] + regions[-1, 0]))),
        detour=float(np.log((steps.sum() + 5.0 * LITTLE) / (whole + 5.0 * LITTLE))),
        pop=float(np.log((steps.max() + LITTLE) / (steps.mean() + LITTLE))),
        common_lost=float(missing[INNER].mean() / (both.mean() + 0.02)),
        outside=float(beyond[INNER].mean() / (either.mean() + 0.02)),
        lopsided=_more_asymmetric(pictures),
        grey=float(np.maximum(min(saturation[0], saturation[-1]) - saturation, 0.0).max()),
    )


def _even(values: FloatArray) -> FloatArray:
    """Return an even change from the first value to the last."""
    return np.linspace(values[0], values[-1], len(values))


def _ratio(values: FloatArray, little: float = LITTLE) -> FloatArray:
    """Return the logarithms of values within over those of an even change."""
    return np.log((values + little) / (_even(values) + little))[INNER]


def _more(excess: FloatArray) -> float:
    """Return the logarithm of one and a mean excess within."""
    return float(np.log1p(np.maximum(excess[INNER], 0.0).mean()))


def _largest(differences: PictureArray) -> PictureArray:
    """Return the largest difference of the four channels, (n, 4, ...), at each pixel."""
    red, green, blue, opacity = np.abs(differences, out=differences).swapaxes(0, 1)
    return np.maximum(np.maximum(red, green), np.maximum(blue, opacity))


def _edges(pictures: PictureArray) -> FloatArray:
    """Return the length of edges in each picture, in its sides: by crossings in four directions (Crofton)."""
    side = pictures.shape[-1]
    lengths = np.zeros(len(pictures))
    for rows, columns, spacing in ((0, 1, 1.0), (1, 0, 1.0), (1, 1, 2**-0.5), (1, -1, 2**-0.5)):
        one = pictures[..., : side - rows, max(0, -columns) : side - max(0, columns)]
        next_one = pictures[..., rows:, max(0, columns) : side + min(0, columns)]
        lengths += spacing * _largest(next_one - one).sum(axis=(1, 2))
    return np.pi / 8.0 * lengths / side


def _thickness(solid: BoolArray) -> FloatArray:
    """Return the greatest thickness in each picture, in its sides: how often its ink can be eroded."""
    return np.array([_erosions(one) for one in solid]) / solid.shape[1]


def _erosions(solid: BoolArray) -> int:
    """Return how often the ink of a picture can be eroded; its pixels are the bits of one number, row after row."""
    row = solid.shape[1] + 1  # what leaves a row at its end is in an empty column
    ink = int.from_bytes(np.packbits(np.pad(solid, ((0, 0), (0, 1)))).tobytes(), "big")
    rounds = 0
    while ink:
        rounds += 1
        across = ink & ink << 1 & ink >> 1
        column = across if rounds % 2 else ink  # square and diamond in turn: an octagon
        ink = across & column << row & column >> row
    return rounds


def _colours(on_white: PictureArray, solid: BoolArray) -> IntArray:
    """Return a number for each colour that can be told apart; 0 where nothing is painted."""
    steps = np.rint(SHADES * on_white).astype(np.intc)
    numbers = (steps[:, 0] * (SHADES + 1) + steps[:, 1]) * (SHADES + 1) + steps[:, 2] + 1
    return np.where(solid, numbers, 0).astype(np.intc)


def _saturation(on_white: PictureArray, solid: BoolArray) -> FloatArray:
    """Return the mean difference of the channels of what is painted."""
    spread = on_white.max(axis=1) - on_white.min(axis=1)
    return (spread * solid).sum(axis=(1, 2)) / np.maximum(solid.sum(axis=(1, 2)), 1)


def _grown(ink: PictureArray) -> PictureArray:
    """Return ink and what lies next to it."""
    padded = np.pad(ink, 1)
    grown = ink.copy()
    for rows in (0, 1, 2):
        for columns in (0, 1, 2):
            np.maximum(grown, padded[rows : rows + len(ink), columns : columns + len(ink)], out=grown)
    return grown


def _more_asymmetric(pictures: PictureArray) -> float:
    """Return by how much more pictures within differ from their mirror images than the ends do, as a share of ink."""
    off = _largest(pictures - pictures[..., ::-1]).mean(axis=(1, 2))
    off /= pictures[:, 3].mean(axis=(1, 2)) + 0.02
    return float(np.maximum(off - max(off[0], off[-1]), 0.0)[INNER].mean())
