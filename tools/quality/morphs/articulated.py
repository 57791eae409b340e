"""Silhouettes of icons whose limbs are turned about joints that were set by hand."""

from __future__ import annotations

import random
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from tools.quality.morphs.packages import icon
from tools.quality.morphs.rig import Limb, Rig
from tools.quality.truth.write import SEED, Morph

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

TIMES = tuple(np.linspace(0.0, 1.0, 9).tolist())
"""So many that straight ways between them are nearly the arcs on which limbs go."""

FLUENT, GAME = "fluent-emoji-high-contrast", "game-icons"


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


POSES = (
    Pose(
        FLUENT,
        "black-cat",
        "stalk",
        [Limb((92, 36), (68, 3), 45), Limb((34, 73), (34, 96), 25), Limb((85, 74), (78, 96), -20)],
    ),
    Pose(FLUENT, "deer", "graze", [Limb((25, 38), (3, 30), -40), Limb((30, 80), (32, 99), 20)]),
    Pose(
        FLUENT,
        "dog",
        "trot",
        [Limb((27, 34), (1, 20), 40), Limb((28, 48), (14, 71), 50), Limb((84, 50), (98, 80), -30)],
    ),
    Pose(FLUENT, "giraffe", "bow", [Limb((26, 46), (2, 25), -45), Limb((84, 58), (95, 76), -50)]),
    Pose(
        FLUENT,
        "spider",
        "lift four legs",
        [
            Limb((30, 33), (14, 2), 40),
            Limb((68, 33), (83, 2), -40),
            Limb((25, 70), (1, 80), -30),
            Limb((73, 70), (97, 80), 30),
        ],
    ),
    Pose(
        FLUENT,
        "spider",
        "walk",
        [
            Limb((25, 42), (1, 18), -50),
            Limb((73, 42), (97, 18), 25),
            Limb((30, 77), (14, 98), 40),
            Limb((68, 77), (83, 98), 25),
        ],
    ),
    Pose(FLUENT, "man-cartwheeling", "land", [Limb((46, 38), (2, 44), -45), Limb((66, 33), (97, 3), 45)]),
    Pose(
        FLUENT,
        "man-cartwheeling",
        "split",
        [Limb((66, 33), (97, 3), 50), Limb((72, 66), (86, 84), -40), Limb((48, 60), (46, 93), 25)],
    ),
    Pose(
        FLUENT,
        "man-running",
        "pass",
        [
            Limb((33, 32), (2, 35), -40),
            Limb((52, 28), (74, 40), -50),
            Limb((38, 62), (5, 92), -35),
            Limb((58, 66), (92, 74), 45),
        ],
    ),
    Pose(FLUENT, "poodle", "wag", [Limb((86, 30), (97, 15), -50), Limb((33, 38), (1, 30), 30)]),
    Pose(
        FLUENT,
        "poodle",
        "step",
        [Limb((33, 66), (33, 97), 35), Limb((85, 68), (90, 98), -30), Limb((86, 30), (97, 15), 40)],
    ),
    Pose(FLUENT, "sauropod", "graze", [Limb((20, 40), (2, 12), -50), Limb((88, 56), (80, 20), 30)]),
    Pose(FLUENT, "cactus", "arms out", [Limb((27, 72), (12, 24), -45), Limb((67, 48), (82, 14), 50)]),
    Pose(FLUENT, "leg", "kick", [Limb((53, 48), (72, 95), -60)]),
    Pose(GAME, "high-kick", "kick lower", [Limb((44, 38), (97, 8), 60), Limb((36, 18), (62, 2), -45)]),
    Pose(GAME, "kangaroo", "tail up", [Limb((24, 48), (2, 73), 60), Limb((84, 18), (100, 17), 30)]),
    Pose(
        GAME,
        "kangaroo",
        "land",
        [Limb((40, 45), (22, 88), -45), Limb((24, 48), (2, 73), 30), Limb((76, 32), (70, 47), -30)],
    ),
    Pose(GAME, "kneeling", "plead", [Limb((65, 65), (88, 34), -20), Limb((54, 24), (78, 5), -20)]),
    Pose(
        GAME,
        "jump-across",
        "run",
        [
            Limb((38, 30), (5, 37), -45),
            Limb((60, 37), (92, 22), 35),
            Limb((40, 78), (3, 95), 35),
            Limb((62, 62), (98, 80), 40),
        ],
    ),
    Pose(GAME, "jump-across", "bend the knee", [Limb((80, 58), (98, 80), 60), Limb((38, 30), (5, 37), 50)]),
    Pose(
        GAME,
        "run",
        "stride",
        [Limb((40, 66), (1, 66), 40), Limb((52, 42), (74, 87), -35), Limb((70, 24), (99, 26), 30)],
    ),
    Pose(GAME, "camel", "drink", [Limb((80, 38), (97, 12), 70)]),
    Pose(
        GAME,
        "camel",
        "walk",
        [Limb((62, 50), (70, 95), -25), Limb((14, 52), (22, 95), 20), Limb((80, 38), (97, 12), 25)],
    ),
    Pose(GAME, "discobolus", "throw", [Limb((58, 10), (2, 4), -40), Limb((74, 34), (76, 73), -45)]),
    Pose(GAME, "diplodocus", "neck down", [Limb((90, 48), (58, 10), 60), Limb((32, 72), (2, 87), 25)]),
    Pose(
        GAME,
        "turtle",
        "swim",
        [Limb((67, 37), (98, 46), -40), Limb((33, 37), (2, 46), 30), Limb((64, 82), (77, 96), -30)],
    ),
    Pose(GAME, "swan", "bow", [Limb((80, 50), (99, 21), 40), Limb((22, 62), (2, 53), 40)]),
    Pose(
        GAME,
        "hand",
        "spread",
        [Limb((42, 54), (18, 19), -20), Limb((80, 50), (97, 23), 20), Limb((35, 88), (2, 87), 35)],
    ),
    Pose(
        GAME,
        "hand",
        "three",
        [
            Limb((42, 54), (18, 19), 15, 0.5),
            Limb((35, 88), (2, 87), 50, 0.7),
            Limb((67, 43), (71, 3), 0, 1.2),
        ],
    ),
    Pose(GAME, "diplodocus", "long neck", [Limb((90, 48), (58, 10), -30, 1.5)]),
)


def morph(pose: Pose, number: int) -> Morph:
    """A pose from rest to the whole turn."""
    rig = Rig(icon(pose.family, pose.icon), pose.limbs)
    pieces = rig.pieces(random.Random(f"{SEED} articulated {number}"))
    what = {"family": pose.icon, "char": pose.name, "axis": "articulated"}
    return Morph(what, TIMES, [[rig.outline(pieces, time)] for time in TIMES], [rig.contour])


def morphs() -> Iterator[Morph]:
    """All of them."""
    for number, pose in enumerate(POSES):
        yield morph(pose, number)
