"""Which of several blends of two drawings looks best: by what differs between strips of pictures of them.

The features are older than those of the judge, and so are their weights, which were fitted to grades of 941 strips.
The judge agrees better with people about strips of different drawings. Of blends of the same two drawings, people
rather preferred those that were chosen by these.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.grading.features import INNER, edges, even, largest, regions
from shapeblend_cli.grading.grade import WORST, without_ground

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import BoolArray, FloatArray, PictureArray

LITTLE = 1e-3
"""Addition to amounts before ratios, as a share of the picture: what is less is not seen."""


class Faults(NamedTuple):
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
    lopsided: float  # asymmetry beyond that of the ends


BASE = -0.205
"""Grade of a strip without faults."""

WEIGHTS = Faults(
    edges_lost=0.593,
    edges_off=0.067,
    ink_lost=0.135,
    ink_off=0.009,
    swollen=0.552,
    thickness_off=0.563,
    patches=0.166,
    pieces=0.320,
    holes=0.293,
    detail=0.121,
    detour=0.975,
    pop=0.504,
    lopsided=0.076,
)
"""Additions to the grade for the square root of each fault: what little there is of one counts much."""


def grade_among_blends(strip: Sequence[PictureArray]) -> float:
    """Return about a grade, from 0 to 3, by which blends of two drawings compare; see `grade.grade`."""
    pictures = np.stack(without_ground(strip))
    ink = pictures[:, 3]
    solid = ink > 0.5
    on_white = pictures[:, :3] + (1.0 - ink[:, None])
    lengths, area = edges(pictures), ink.mean(axis=(1, 2))
    patches, holes, pieces = regions(on_white, solid)
    steps = largest(pictures[1:] - pictures[:-1]).mean(axis=(1, 2))
    whole = float(largest(pictures[-1:] - pictures[:1]).mean())
    edge_ratio, ink_ratio, mean_ratio = _ratio(lengths), _ratio(area), _ratio(area / (lengths + LITTLE))
    faults = Faults(
        edges_lost=float(np.maximum(-edge_ratio, 0.0).max()),
        edges_off=float(np.abs(edge_ratio).mean()),
        ink_lost=float(np.maximum(-ink_ratio, 0.0).max()),
        ink_off=float(np.abs(ink_ratio).mean()),
        swollen=float(np.maximum(_ratio(_thickness(solid), 0.01), 0.0).max()),
        thickness_off=float(np.abs(mean_ratio).mean()),
        patches=_more(patches - even(patches)),
        pieces=_more(pieces - max(pieces[0], pieces[-1])),
        holes=_more(holes - max(holes[0], holes[-1])),
        detail=float(np.log1p(0.5 * (patches[0] + patches[-1]))),
        detour=float(np.log((steps.sum() + 5.0 * LITTLE) / (whole + 5.0 * LITTLE))),
        pop=float(np.log((steps.max() + LITTLE) / (steps.mean() + LITTLE))),
        lopsided=_more_asymmetric(pictures),
    )
    roots = np.sqrt(np.maximum(faults, 0.0))
    return min(max(BASE + float(roots @ np.array(WEIGHTS)), 0.0), WORST)


def _ratio(values: FloatArray, little: float = LITTLE) -> FloatArray:
    """Return the logarithms of values within over those of an even change."""
    return np.log((values + little) / (even(values) + little))[INNER]


def _more(excess: FloatArray) -> float:
    """Return the logarithm of one and a mean excess within."""
    return float(np.log1p(np.maximum(excess[INNER], 0.0).mean()))


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


def _more_asymmetric(pictures: PictureArray) -> float:
    """Return by how much more pictures within differ from their mirror images than the ends do, as a share of ink."""
    off = largest(pictures - pictures[..., ::-1]).mean(axis=(1, 2))
    off /= pictures[:, 3].mean(axis=(1, 2)) + 0.02
    return float(np.maximum(off - max(off[0], off[-1]), 0.0)[INNER].mean())
