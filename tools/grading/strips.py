"""Strips that people graded, with all that is measured in them, from which trees are grown."""

from __future__ import annotations

import gzip
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.grading.features import Features
from shapeblend_cli.grading.grade import weighed
from shapeblend_cli.grading.measures import NAMES

if TYPE_CHECKING:
    from shapeblend_cli.model import BoolArray, FloatArray

STRIPS = Path(__file__).with_name("strips.tsv.gz")

WEIGHTS = {
    "designers' drawings": 3.0,
    "designers' icons": 2.0,
    "drawings of npm sets": 1.0,
    "icons of npm sets": 1.0,
}
"""Weight of each strip, by its kind: designers looked longest."""


class Strips(NamedTuple):
    """Strips, a row each."""

    groups: list[str]  # strips of one group are never on both sides of a fold
    pairs: list[str]
    made: list[str]
    kinds: list[str]
    grades: FloatArray
    is_better: BoolArray  # preferred by both graders to the other strip of the same drawings
    values: FloatArray  # (n, measures and the sum of faults)

    def take(self, some: BoolArray) -> Strips:
        """Return some of the strips."""
        at = np.flatnonzero(some).tolist()
        groups, pairs, made, kinds = ([texts[k] for k in at] for texts in self[:4])
        return Strips(groups, pairs, made, kinds, *(values[some] for values in self[4:]))


def strips() -> Strips:
    """Read the strips that people graded."""
    head, *rows = (line.split("\t") for line in gzip.decompress(STRIPS.read_bytes()).decode().splitlines())
    assert head[6:] == [*Features._fields, *NAMES]
    numbers = np.array([row[4:] for row in rows], np.float64)
    faults = numbers[:, 2 : 2 + len(Features._fields)]
    sums = [weighed(Features(*row)).number for row in faults.tolist()]
    values = np.column_stack([numbers[:, 2 + len(Features._fields) :], sums])
    groups, pairs, made, kinds = ([row[k] for row in rows] for k in range(4))
    return Strips(groups, pairs, made, kinds, numbers[:, 0], numbers[:, 1] > 0, values)
