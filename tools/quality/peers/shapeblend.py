"""shapeblend by its own command, from two files to the files that a user gets."""

from __future__ import annotations

import tempfile
from pathlib import Path

import numpy as np

from shapeblend_cli.cli import run
from shapeblend_cli.geometry.flatten import flatten
from shapeblend_cli.model import Contour
from shapeblend_cli.svg.read import read
from tools.quality.data import Pair, svg
from tools.quality.scores import STEPS

NAME = "shapeblend"

FINE = 2000
"""A contour with curves is cut into about so many pieces. One of straight lines is taken as it is."""


def blends(pairs: list[Pair]) -> list[list[list[np.ndarray]] | None]:
    return [_frames(pair) for pair in pairs]


def animation(pair: Pair) -> str | None:
    """The animated SVG, or None if the command fails."""
    with tempfile.TemporaryDirectory() as folder:
        target = Path(folder, "moving.svg")
        return target.read_text(encoding="utf-8") if _blend(pair, Path(folder), target) else None


def contours(file: str, data: bytes | None = None) -> list[np.ndarray]:
    """The vertices of everything a file draws, a contour each."""
    return [_vertices(contour) for shape in read(file, data).shapes for contour in shape.contours]


def _frames(pair: Pair) -> list[list[np.ndarray]] | None:
    with tempfile.TemporaryDirectory() as folder:
        target = Path(folder, "frames")
        if not _blend(pair, Path(folder), target, "--frames", str(STEPS - 1), "--ends"):
            return None
        files = sorted(target.iterdir())
        assert len(files) == STEPS + 1
        return [contours(str(file)) for file in files]


def _blend(pair: Pair, folder: Path, target: Path, *options: str) -> bool:
    files = []
    for side, data in (("a", pair.a), ("b", pair.b)):
        file = folder / f"{side}.svg"
        file.write_text(svg(data), encoding="utf-8")
        files.append(str(file))
    return run([*files, "--quiet", "--output", str(target), *options]) == 0


def _vertices(contour: Contour) -> np.ndarray:
    if np.ptp(contour.segments.real) == np.ptp(contour.segments.imag) == 0.0:
        return contour.segments[:1, 0]  # a point
    return flatten(contour, 0 if contour.straight.all() else FINE).vertices
