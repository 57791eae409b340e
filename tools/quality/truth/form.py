"""The form in which pairs and their truth lie in a folder, read.

`index.json` lists the pairs. A pair has a folder with `a.svg`, `b.svg` and `truth.json`, which holds the true outlines
as polygons at two or more times, vertex for vertex, all in the coordinates of A, and the scale and shift of B's file;
and how far along the outlines of both files each vertex is.
"""

from __future__ import annotations

import json
import re
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from tools.quality.data import Pair

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence
    from pathlib import Path

    from tools.quality.scores import Frame

SETS = {"single": "one contour", "multi": "several contours"}
"""The sets of pairs, and what a shape has in each."""

TIMES = (0.25, 0.5, 0.75)
"""When in-betweens are compared."""

DATA = re.compile(r'\bd="([^"]+)"')


class Truth(NamedTuple):
    """A pair whose blend is known.

    Attributes
    ----------
    id, set : str
    a, b : str
        The two files.
    scale : float
    shift : complex
        B's file has the true end `q` at `scale * q + shift`.
    times : array of float
        From 0 to 1.
    frames : sequence of frames
        The true outlines at these times, in the coordinates of A.
    along : sequence of array
        For each contour how far along A's and B's outlines its vertices are, two rows, as shares of their lengths.
        Those of B fall where its file goes the other way round.
    open : bool
        Whether its outlines are lines with ends.
    """

    id: str
    set: str
    a: str
    b: str
    scale: float
    shift: complex
    times: np.ndarray
    frames: Sequence[Frame]
    along: Sequence[np.ndarray]
    open: bool = False

    @property
    def pair(self) -> Pair:
        """Its path data."""
        return Pair(self.id, *(DATA.findall(text)[0] for text in (self.a, self.b)))

    def size_at(self, t: float) -> float:
        """How much larger than the true in-between one is that goes straight from file to file."""
        return (1.0 - t) + t * self.scale

    def own_time(self, t: float) -> float:
        """The time of the truth at which its in-between lies where the files have it at time t.

        Straight from file to file, (1 - t) p + t (scale q + shift) is `size_at(t)` times the blend of p and q at
        another time, t scale / size_at(t), shifted by t shift.
        """
        return t * self.scale / self.size_at(t)

    def at(self, t: float) -> Frame:
        """The true in-between of the outlines that lie where the files have them at time t."""
        return self.at_own(self.own_time(t))

    def at_own(self, time: float) -> Frame:
        """The true in-between at a time of its own."""
        k = min(max(int(np.searchsorted(self.times, time)) - 1, 0), len(self.times) - 2)
        u = (time - self.times[k]) / (self.times[k + 1] - self.times[k])
        return [p + u * (q - p) for p, q in zip(self.frames[k], self.frames[k + 1], strict=True)]

    def laid_back(self, frame: Frame, t: float) -> Frame:
        """A frame at time t with the scale and the shift taken out that it has from B's file."""
        return [(contour - t * self.shift) / self.size_at(t) for contour in frame]

    def true_links(self) -> list[tuple[np.ndarray, np.ndarray]]:
        """For each contour its vertices in A's file and where they belong in B's."""
        ends = zip(self.frames[0], self.frames[-1], strict=True)
        return [(p, self.scale * q + self.shift) for p, q in ends]


class Linked(NamedTuple):
    """What a tool makes of a pair.

    Attributes
    ----------
    frames : sequence of frames
        At `TIMES`, placed as the files have it.
    links : sequence of (array, array)
        For each contour points of A, and the points of B they go to, in order.
    segments : int
        How many segments the middle one is written with.
    """

    frames: Sequence[Frame]
    links: Sequence[tuple[np.ndarray, np.ndarray]]
    segments: int


def load(folder: Path, name: str) -> Iterator[Truth]:
    """The pairs of a set that have a truth."""
    for entry in json.loads((folder / "index.json").read_text(encoding="utf-8"))["pairs"]:
        if entry["set"] == name:
            place = folder / entry["dir"]
            known = json.loads((place / "truth.json").read_text(encoding="utf-8"))
            files = [(place / file).read_text(encoding="utf-8") for file in ("a.svg", "b.svg")]
            yield truth(known, *files)


def truth(known: dict, a: str, b: str) -> Truth:
    """A pair from what its `truth.json` says."""
    times = sorted(known["frames"], key=float)
    frames = [[np.array(contour) @ [1, 1j] for contour in known["frames"][time]] for time in times]
    laid = known["transform"]
    return Truth(
        known["id"],
        known["set"],
        a,
        b,
        laid["scale"],
        complex(laid["dx"], laid["dy"]),
        np.array(times, dtype=float),
        frames,
        [np.array(contour).T for contour in known["pairs"]],
        known.get("open", False),
    )
