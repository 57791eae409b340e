"""The pairs of shapes that tools are measured on. They bring their licences: `LICENCE.md` beside the file."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Iterator

ROOT = Path(__file__).resolve().parents[2]
ICONS = ROOT / "tests" / "bench" / "data" / "pairs.json"
VIEWBOX = "0 0 100 100"

SETS = {"single": "one contour", "whole": "two to five contours"}
"""The sets of icon pairs, and what an icon has in each."""

CHORDS = 16
"""A curve is measured as so many straight pieces."""

SUBPATH = re.compile(r"M[^M]*")
COMMAND = re.compile(r"([MLQCZ])([^MLQCZ]*)")
NUMBER = re.compile(r"-?\d+(?:\.\d+)?")


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
    points = np.array(list(_points(subpath)))
    return points[:-1] if points[0] == points[-1] else points


def _points(subpath: str) -> Iterator[complex]:
    point = 0j
    u = np.arange(1, CHORDS + 1) / CHORDS
    v = 1.0 - u
    for letter, text in COMMAND.findall(subpath):
        numbers = [float(number) for number in NUMBER.findall(text)]
        ends = [complex(x, y) for x, y in zip(numbers[::2], numbers[1::2], strict=True)]
        if letter == "C":
            for k in range(0, len(ends), 3):
                c, d, q = ends[k : k + 3]
                yield from v**3 * point + 3 * v * v * u * c + 3 * v * u * u * d + u**3 * q
                point = q
        elif letter == "Q":
            for c, q in zip(ends[::2], ends[1::2], strict=True):
                yield from v * v * point + 2 * v * u * c + u * u * q
                point = q
        else:
            yield from ends
            point = ends[-1] if ends else point


def svg(data: str) -> str:
    """A file that draws a shape."""
    return f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{VIEWBOX}"><path d="{data}"/></svg>\n'
