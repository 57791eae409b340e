"""Pairs of known truth, written in the form that `form.py` reads.

The files give nothing of the truth away: B begins at another point, goes the other way round every second time, has its
contours in another order, and is scaled and shifted.
"""

from __future__ import annotations

import json
import random
from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.geometry.polygons import signed_area
from shapeblend_cli.model import Box
from tools.quality.scores import is_crossed, is_overlapping
from tools.quality.truth.measures import extent, reached

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence
    from pathlib import Path

    from tools.quality.scores import Frame

    Segments = list[np.ndarray]  # of a contour, each its control points
    Outline = list[Segments]  # of a drawing

SEED = 2024
SIZE = 100.0
"""How large drawings are, about."""

STRAY = 2e-4
"""Share of the size by which a true polygon may stray from its curves."""

LEAST_PIECES = 4
"""A curve is cut into no fewer pieces, so that none of its turns looks like a corner."""


class Morph(NamedTuple):
    """A drawing that changes, with the same segments at all times.

    Attributes
    ----------
    what : dict
        What it is, for those who look at the files.
    times : sequence of float
        From 0 to 1.
    outlines : sequence of outlines
        At these times, y downwards.
    drawn : outline or None
        What A's file draws, if that has fewer segments.
    """

    what: Mapping[str, str]
    times: Sequence[float]
    outlines: Sequence[Outline]
    drawn: Outline | None = None

    @property
    def frames(self) -> list[Frame]:
        """The outlines as polygons, vertex for vertex."""
        pieces = [
            [max(_pieces(segment) for segment in same) for same in zip(*contours, strict=True)]
            for contours in zip(self.outlines[0], self.outlines[-1], strict=True)
        ]
        return [
            [_polygon(contour, counts) for contour, counts in zip(outline, pieces, strict=True)]
            for outline in self.outlines
        ]


def _pieces(segment: np.ndarray) -> int:
    """Into how many pieces it is cut, at even parameters."""
    if len(segment) == 2:
        return 1
    bend = float(np.abs(np.diff(segment, 2)).max()) * (len(segment) - 1) * (len(segment) - 2) / 8
    return max(LEAST_PIECES, int(np.ceil(np.sqrt(bend / (STRAY * SIZE)))))


def _polygon(contour: Segments, counts: Sequence[int]) -> np.ndarray:
    points = [at(segment, np.arange(count) / count) for segment, count in zip(contour, counts, strict=True)]
    return np.round(np.concatenate(points), 3)


def at(segment: np.ndarray, u: np.ndarray) -> np.ndarray:
    """Points of a segment, by blending its control points again and again."""
    points = segment[:, None] + 0.0 * u
    while len(points) > 1:
        points = np.array([p + (q - p) * u for p, q in pairwise(points)])
    return points[0]


def is_plain(frame: Frame) -> bool:
    """Whether nothing crosses, and holes go the other way round than what they are in."""
    if any(is_crossed(contour) for contour in frame) or is_overlapping(frame):
        return False
    around = [
        [ring for ring in frame if ring is not contour and _is_in(contour[0], ring)] for contour in frame
    ]
    ways = [
        [np.sign(signed_area(ring)) for ring in [contour, *rings]]
        for contour, rings in zip(frame, around, strict=True)
    ]
    return all((len(way) % 2 == 1) == (sum(way) != 0) for way in ways)


def _is_in(point: complex, ring: np.ndarray) -> bool:
    angles = np.angle((np.roll(ring, -1) - point) / (ring - point))
    return abs(angles.sum()) > np.pi


def centred(p: Frame, q: Frame) -> tuple[Frame, Frame]:
    """Both with the middle of their boxes at 0."""
    return tuple([contour - _middle(frame) for contour in frame] for frame in (p, q))


def _middle(frame: Frame) -> complex:
    return Box.around(np.concatenate(frame)).centre


def write(folder: Path, sets: Mapping[str, Iterable[Morph]]) -> None:
    """Write all sets."""
    entries = []
    for name, morphs in sets.items():
        for number, one in enumerate(morphs):
            label = f"{name}-{number:03}"
            known, a, b = pair(one, label, name)
            target = folder / name / label
            target.mkdir(parents=True, exist_ok=True)
            (target / "a.svg").write_text(a, encoding="utf-8")
            (target / "b.svg").write_text(b, encoding="utf-8")
            (target / "truth.json").write_text(f"{json.dumps(known)}\n", encoding="utf-8")
            entries.append({"id": label, "set": name, **one.what, "dir": f"{name}/{label}"})
    index = {"seed": SEED, "pairs": entries}
    (folder / "index.json").write_text(f"{json.dumps(index, indent=1)}\n", encoding="utf-8")


def pair(one: Morph, label: str, name: str) -> tuple[dict, str, str]:
    """What is known of a morph, and its two files."""
    chance = random.Random(f"{SEED} {label}")
    scale = round(chance.uniform(0.8, 1.25), 4)
    shift = complex(round(chance.uniform(-30, 30), 2), round(chance.uniform(-30, 30), 2))
    back = chance.random() < 0.5
    frames = one.frames
    order = list(range(len(frames[0])))
    chance.shuffle(order)
    starts = [chance.randrange(len(contour)) for contour in one.outlines[-1]]
    moved = [[scale * segment + shift for segment in contour] for contour in one.outlines[-1]]
    drawn = [_begun(contour, start, back) for contour, start in zip(moved, starts, strict=True)]
    known = {
        "id": label,
        "set": name,
        **one.what,
        "transform": {"scale": scale, "dx": shift.real, "dy": shift.imag},
        "reversed": back,
        "contour_map": [[k, order.index(k)] for k in range(len(order))],
        "frames": {
            f"{t:g}": [_points(contour) for contour in frame]
            for t, frame in zip(one.times, frames, strict=True)
        },
        "pairs": [
            _where(p, q, complex(contour[0][0] - shift) / scale, back)
            for p, q, contour in zip(frames[0], frames[-1], drawn, strict=True)
        ],
    }
    return known, svg(one.drawn or one.outlines[0]), svg([drawn[k] for k in order])


def _begun(contour: Segments, start: int, back: bool) -> Segments:
    """A contour from another of its segments on, the other way round if so told."""
    turned = contour[start:] + contour[:start]
    return [segment[::-1] for segment in turned[::-1]] if back else turned


def _where(p: np.ndarray, q: np.ndarray, start: complex, back: bool) -> list[list[float]]:
    """For each vertex how far round it is, in A's file and in B's, each from its own start and in its own direction."""
    u, v = (reached(contour)[:-1] for contour in (p, q))
    v -= v[np.abs(q - start).argmin()]
    v = -v if back else v
    v -= np.round(v[0])
    return [[round(float(s), 5), round(float(r), 5)] for s, r in zip(u, v, strict=True)]


def _points(contour: np.ndarray) -> list[list[float]]:
    return [[z.real, z.imag] for z in contour.tolist()]


def svg(outline: Outline) -> str:
    """A file that draws an outline with room around it."""
    points = np.concatenate([np.concatenate(contour) for contour in outline])
    box = Box.around(points).expanded(0.05 * extent([points]))
    x, y, width, height = map(round, box)
    data = "".join(_data(contour) for contour in outline)
    return f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{x} {y} {width} {height}"><path d="{data}"/></svg>\n'


def _data(contour: Segments) -> str:
    """Path data; the line that closes a contour is left to Z, and curves that are lines here are written as such."""
    segments = [segment[[0, -1]] if _is_straight(segment) else segment for segment in contour]
    if len(segments[-1]) == 2:
        segments = segments[:-1]
    drawn = ("LQC"[len(segment) - 2] + " ".join(map(_number, segment[1:])) for segment in segments)
    return f"M{_number(contour[0][0])}{''.join(drawn)}Z"


def _is_straight(segment: np.ndarray) -> bool:
    """Whether it is a line by the decimals that are written."""
    chord = segment[-1] - segment[0]
    away = np.abs((np.conj(chord) * (segment[1:-1] - segment[0])).imag)
    return bool((away <= 1e-3 * abs(chord)).all())


def _number(z: complex) -> str:
    return f"{z.real:.3f},{z.imag:.3f}"
