"""shapeblend by its own command, from two files to the files that a user gets."""

from __future__ import annotations

import json
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

DEFAULT = "auto"
MOTIONS = ("linear", "rigid", "intrinsic", "safe")
"""What else `--motion` takes."""

FINE = 2000
"""A contour with curves is cut into about so many pieces. One of straight lines is taken as it is."""


def named(motion: str) -> str:
    """What the command is called that blends with a motion."""
    return NAME if motion == DEFAULT else f"{NAME} --motion {motion}"


def blends(pairs: list[Pair], motion: str = DEFAULT) -> list[list[list[np.ndarray]] | None]:
    files = (frames(pair, motion) for pair in pairs)
    return [each and [drawn(text) for text in each] for each in files]


def frames(pair: Pair, motion: str = DEFAULT) -> list[str] | None:
    """The files at the times of `STEPS`, or None if the command fails."""
    with tempfile.TemporaryDirectory() as folder:
        target = Path(folder, "frames")
        options = ["--frames", str(STEPS - 1), "--ends", "--motion", motion]
        if not _blend(pair, Path(folder), target, *options):
            return None
        files = [file.read_text(encoding="utf-8") for file in sorted(target.iterdir())]
        assert len(files) == STEPS + 1
        return files


def report(pair: Pair) -> dict | None:
    """What the command reports, or None if it fails."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder, "report.json")
        if not _blend(pair, Path(folder), Path(folder, "none"), "--frames", "0", "--report", str(file)):
            return None
        return json.loads(file.read_text(encoding="utf-8"))


def animation(pair: Pair) -> str | None:
    """The animated SVG, or None if the command fails."""
    with tempfile.TemporaryDirectory() as folder:
        target = Path(folder, "moving.svg")
        return target.read_text(encoding="utf-8") if _blend(pair, Path(folder), target) else None


def drawn(text: str) -> list[np.ndarray]:
    """The vertices of everything a file draws, a contour each."""
    shapes = read("a file", text.encode()).shapes
    return [_vertices(contour) for shape in shapes for contour in shape.contours]


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
