"""The pairs of shapes that tools are measured on. They bring their licences: `LICENCE.md` beside the file."""

from __future__ import annotations

import json
import re
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.geometry.polygons import signed_area

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

ROOT = Path(__file__).resolve().parents[2]
ICONS = ROOT / "tests" / "bench" / "data" / "pairs.json"
VIEWBOX = "0 0 100 100"

SETS = {"single": "one contour", "whole": "two to five contours"}
"""The sets of icon pairs, and what an icon has in each."""

CHORDS = 16
"""A curve is measured as so many straight pieces."""

SUBPATH = re.compile(r"M[^M]*")
COMMAND = re.compile(r"([MLQCZ])([^MLQCZ]*)")
NUMBER = re.compile(r"-?\d+(?:\.\d+)?(?:e[-+]?\d+)?")
POINTS = {"M": 1, "L": 1, "Q": 2, "C": 3, "Z": 1}
"""How many points a command has."""

DECIMALS = 3
"""How many shapeblend writes for drawings 100 wide."""


class Pair(NamedTuple):
    """Path data of two shapes: absolute M, L, Q, C and Z, every contour closed."""

    id: str
    a: str
    b: str


def icon_pairs(name: str) -> list[Pair]:
    """The pairs of one of the `SETS`."""
    return [Pair(**pair) for pair in json.loads(ICONS.read_text(encoding="utf-8"))[name]]


def subpaths(data: str) -> list[str]:
    """Path data with a contour each."""
    return [part.strip() for part in SUBPATH.findall(data)]


def polygon(subpath: str) -> np.ndarray:
    """The vertices of one contour, as complex numbers."""
    points = vertices(subpath)
    return points[:-1] if points[0] == points[-1] else points


def vertices(subpath: str) -> np.ndarray:
    """The vertices of one contour, the last of which may be the first again."""
    return np.array([_start(subpath), *(point for piece in segments(subpath) for point in _along(piece))])


def segments(subpath: str) -> Iterator[list[complex]]:
    """The lines and curves of one contour, each by its two to four points."""
    point = _start(subpath)
    for letter, text in COMMAND.findall(subpath):
        numbers = [float(number) for number in NUMBER.findall(text)]
        points = [complex(x, y) for x, y in zip(numbers[::2], numbers[1::2], strict=True)]
        count = POINTS[letter]
        for k in range(letter == "M", len(points), count):
            yield [point, *points[k : k + count]]
            point = points[k + count - 1]


def _start(subpath: str) -> complex:
    x, y = NUMBER.findall(subpath)[:2]
    return complex(float(x), float(y))


def _along(piece: list[complex]) -> Iterable[complex]:
    """Points of a line or curve behind its first one."""
    u = np.arange(1, CHORDS + 1) / CHORDS
    v = 1.0 - u
    if len(piece) == 4:
        p, c, d, q = piece
        return v**3 * p + 3 * v * v * u * c + 3 * v * u * u * d + u**3 * q
    if len(piece) == 3:
        p, c, q = piece
        return v * v * p + 2 * v * u * c + u * u * q
    return piece[1:]


def pieces(data: str) -> int:
    """How many lines and curves path data has, the lines that close contours included."""
    return sum(len(_closed(subpath)) for subpath in subpaths(data))


def _closed(subpath: str) -> list[list[complex]]:
    """The lines and curves of one contour, the one that closes it included."""
    drawn = list(segments(subpath))
    first, last = drawn[0][0], drawn[-1][-1]
    return drawn if first == last else [*drawn, [last, first]]


def cut_in_two(data: str, share: float, rng: np.random.Generator) -> str:
    """Path data with a share of its lines and curves cut in two, which changes nothing that is drawn."""
    return " ".join(f"{_data(list(_cut(_closed(sub), share, rng)))} Z" for sub in subpaths(data))


def _cut(drawn: list[list[complex]], share: float, rng: np.random.Generator) -> Iterator[list[complex]]:
    for piece in drawn:
        is_cut, u = rng.random() < share, rng.uniform(0.3, 0.7)
        if not is_cut:
            yield piece
            continue
        rows = [piece]
        while len(rows[-1]) > 1:
            rows.append([p + (q - p) * u for p, q in pairwise(rows[-1])])
        yield [row[0] for row in rows]
        yield [row[-1] for row in reversed(rows)]


def open_data(subpath: str) -> str:
    """Path data of a contour in which the line that closes it is drawn, and no Z says so."""
    return _data(_closed(subpath))


def one_way_round(data: str) -> str:
    """Path data with all contours turned the same way round."""
    return " ".join(
        subpath if signed_area(polygon(subpath)) > 0.0 else f"{_data(_turned(subpath))} Z"
        for subpath in subpaths(data)
    )


def _turned(subpath: str) -> list[list[complex]]:
    return [piece[::-1] for piece in reversed(_closed(subpath))]


def _data(drawn: list[list[complex]]) -> str:
    commands = (("", "L", "Q", "C")[len(piece) - 1] + _numbers(piece[1:]) for piece in drawn)
    return " ".join([f"M{_numbers(drawn[0][:1])}", *commands])


def _numbers(points: list[complex]) -> str:
    return " ".join(f"{z.real:.6f},{z.imag:.6f}" for z in points)


def svg(data: str) -> str:
    """A file that draws a shape."""
    return f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{VIEWBOX}"><path d="{data}"/></svg>\n'
