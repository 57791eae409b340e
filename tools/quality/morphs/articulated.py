"""Silhouettes of icons whose limbs are turned about joints that were set by hand, as `poses.tsv` lists them."""

from __future__ import annotations

import csv
import random
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.geometry.flatten import flatten
from shapeblend_cli.svg.reading.read import read
from tools.quality.morphs.rig import Limb, Rig
from tools.quality.npm import icon_file
from tools.quality.scores import area
from tools.quality.truth.write import SEED, Morph

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from tools.quality.truth.write import Segments

TIMES = tuple(np.linspace(0.0, 1.0, 9).tolist())
"""So many that straight ways between them are nearly the arcs on which limbs go."""


class Pose(NamedTuple):
    """A silhouette and what its limbs do.

    Attributes
    ----------
    family, icon, name : str
    limbs : sequence of Limb
        One that hangs on another comes before it.
    """

    family: str
    icon: str
    name: str
    limbs: Sequence[Limb]


def _limb(text: str) -> Limb:
    """Return a limb as the table has it: joint, tip, degrees, and the factor of its length if it grows."""
    joint, tip, degrees, *length = text.split()
    (jx, jy), (tx, ty) = (map(float, place.split(",")) for place in (joint, tip))
    return Limb((jx, jy), (tx, ty), float(degrees), *map(float, length))


with Path(__file__).with_name("poses.tsv").open(encoding="utf-8") as file:
    POSES = tuple(
        Pose(*where, [_limb(text) for text in limbs.split("; ")])
        for *where, limbs in list(csv.reader(file, delimiter="\t"))[1:]
    )


def silhouette(family: str, name: str) -> Segments:
    """Return the largest contour of an icon."""
    text = icon_file(family, name).replace("currentColor", "#000")
    contours = [contour for shape in read(name, text.encode()).shapes for contour in shape.contours]
    return list(max(contours, key=lambda contour: area(flatten(contour, 0).vertices)).segments)


def morph(pose: Pose, number: int) -> Morph:
    """A pose from rest to the whole turn."""
    rig = Rig(silhouette(pose.family, pose.icon), pose.limbs)
    pieces = rig.pieces(random.Random(f"{SEED} articulated {number}"))
    what = {"family": pose.icon, "char": pose.name, "axis": "articulated"}
    return Morph(what, TIMES, [[rig.outline(pieces, time)] for time in TIMES], [rig.contour])


def morphs() -> Iterator[Morph]:
    """All of them."""
    for number, pose in enumerate(POSES):
        yield morph(pose, number)
