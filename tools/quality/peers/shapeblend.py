"""shapeblend by its own command, from two files to the files that a user gets."""

from __future__ import annotations

import json
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from shapely import LinearRing, LineString, get_parts, union_all

from shapeblend_cli.cli import run
from shapeblend_cli.geometry.flatten import flatten
from shapeblend_cli.model import Contour
from shapeblend_cli.svg.reading.read import read
from tools.quality.data import Pair, svg
from tools.quality.scores import STEPS
from tools.quality.truth.form import TIMES, Linked, Truth

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapely.geometry.base import BaseGeometry

    from shapeblend_cli.model.style import Style

NAME = "shapeblend"

CAPS = {"butt": "flat", "round": "round", "square": "square"}
"""What shapely calls the ends of lines."""

FINE = 2000
"""A contour with curves is cut into about so many pieces. One of straight lines is taken as it is."""


def blends(pairs: list[Pair], also: Sequence[str] = ()) -> list[list[list[np.ndarray]] | None]:
    files = (frames(pair, also=also) for pair in pairs)
    return [each and [painted(text) for text in each] for each in files]


def linked(truths: list[Truth], also: Sequence[str] = ()) -> list[Linked | None]:
    """In-betweens as they come, of files that lie as they are, beside what the report says goes where."""
    return [_linked(truth, also) for truth in truths]


def _linked(truth: Truth, also: Sequence[str]) -> Linked | None:
    with tempfile.TemporaryDirectory() as folder:
        target, file = Path(folder, "frames"), Path(folder, "report.json")
        options = ["--place", "asis", "--frames", str(len(TIMES)), "--report", str(file), *also]
        if not _blend((truth.a, truth.b), Path(folder), target, *options):
            return None
        files = _files(target)
        pairs = json.loads(file.read_text(encoding="utf-8"))["pairs"]
    links = [
        links_of(contour) for pair in pairs for contour in pair["contours"] if None not in contour.values()
    ]
    return Linked([drawn(text) for text in files], links, segments(files[TIMES.index(0.5)]))


def links_of(contour: dict) -> tuple[np.ndarray, np.ndarray]:
    """What the report says of a contour: points of A, and the points of B they go to."""
    a, b = np.array(contour["dots"]).T
    return (np.array(contour["vertices_a"]) @ [1, 1j])[a], (np.array(contour["vertices_b"]) @ [1, 1j])[b]


def frames(pair: Pair, steps: int = STEPS, also: Sequence[str] = ()) -> list[str] | None:
    """The files at even times, both ends among them, or None if the command fails."""
    with tempfile.TemporaryDirectory() as folder:
        target = Path(folder, "frames")
        options = ["--frames", str(steps - 1), "--ends", *also]
        done = _blend((svg(pair.a), svg(pair.b)), Path(folder), target, *options)
        return _files(target) if done else None


def segments(text: str) -> int:
    """How many segments the contours of a file have."""
    shapes = read("a file", text.encode()).shapes
    return sum(len(contour.segments) for shape in shapes for contour in shape.contours)


def drawn(text: str) -> list[np.ndarray]:
    """The vertices of everything a file draws, a contour each."""
    shapes = read("a file", text.encode()).shapes
    return [_vertices(contour) for shape in shapes for contour in shape.contours]


def painted(text: str) -> list[np.ndarray]:
    """The vertices of everything a file draws, a contour each, with the outlines of its strokes together."""
    shapes = read("a file", text.encode()).shapes
    filled = [shape for shape in shapes if shape.style.stroke is None]
    lines = [
        _stroked(contour, shape.style)
        for shape in shapes
        if shape.style.stroke is not None
        for contour in shape.contours
    ]
    contours = [_vertices(contour) for shape in filled for contour in shape.contours]
    for part in get_parts(union_all(lines)):
        contours += [np.array(ring.coords)[:-1] @ [1, 1j] for ring in (part.exterior, *part.interiors)]
    return contours


def _stroked(contour: Contour, style: Style) -> BaseGeometry:
    """What a line paints that has no fill."""
    vertices = _vertices(contour)
    points = np.column_stack([vertices.real, vertices.imag])
    line = LinearRing(points) if contour.closed else LineString(points)
    cap = CAPS[style.stroke_linecap]
    return line.buffer(
        0.5 * style.stroke_width, cap_style=cap, join_style=style.stroke_linejoin.replace("miter", "mitre")
    )


def _files(folder: Path) -> list[str]:
    """The frames in it, in order."""
    return [file.read_text(encoding="utf-8") for file in sorted(folder.iterdir())]


def _blend(svgs: tuple[str, str], folder: Path, target: Path, *options: str) -> bool:
    files = [folder / "a.svg", folder / "b.svg"]
    for file, text in zip(files, svgs, strict=True):
        file.write_text(text, encoding="utf-8")
    return run([*map(str, files), "--quiet", "--output", str(target), *options]) == 0


def _vertices(contour: Contour) -> np.ndarray:
    if np.ptp(contour.segments.real) == np.ptp(contour.segments.imag) == 0.0:
        return contour.segments[:1, 0]  # a point
    return flatten(contour, 0 if contour.straight.all() else FINE).vertices
