"""Features of a strip of pictures that tell how good it looks: each is 0 where nothing is wrong.

Both ends are taken to be right. What lies between is compared with an even change from one end to the other, or with
that end which has more.
"""

from __future__ import annotations

from itertools import combinations
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.grading.seen import even, strange

if TYPE_CHECKING:
    from shapeblend_cli.grading.seen import Seen
    from shapeblend_cli.model import FloatArray

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


def features(seen: Seen) -> Features:
    """Return what is wrong with a strip of which is known what is seen."""
    area = seen.area
    size = 0.5 * (area[0] + area[-1]) + 0.01
    changes = seen.steps + 1e-3
    edge_ratio = _ratio(seen.edges, 0.1)
    others, known = strange(seen.lengths)
    return Features(
        edges_lost=float(np.maximum(-edge_ratio, 0.0).mean()),
        size_off=float(np.abs(_ratio(seen.spread, 0.01)).mean()),
        lumps=_beyond_ends(seen.deep / size),
        slivers=_beyond_even(seen.thin / size),
        spikes=_beyond_ends(seen.spikes),
        notches=_beyond_ends(seen.notches),
        directions=float(others[INNER].mean() / (known + 2.0)),
        lopsided=_beyond_even(seen.asymmetry / (area + 0.02)),
        patches=_beyond_ends(seen.patches),
        pieces=_beyond_ends(seen.pieces),
        pop=float(np.log(changes.max() / changes.mean())),
        detail=float(0.5 * (seen.edges[0] + seen.edges[-1])),
    )


def _ratio(values: FloatArray, little: float) -> FloatArray:
    """Return the logarithms of values within over those of an even change, both with a little more."""
    return np.log((values + little) / (even(values) + little))[INNER]


def _beyond_ends(values: FloatArray) -> float:
    """Return by how much values within exceed both ends, on average."""
    return float(np.maximum(values - max(values[0], values[-1]), 0.0)[INNER].mean())


def _beyond_even(values: FloatArray) -> float:
    """Return by how much values within exceed an even change, on average."""
    return float(np.maximum(values - even(values), 0.0)[INNER].mean())
