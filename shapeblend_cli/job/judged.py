"""Strips of frames that anyone made, graded: SVG, PNG and GIF files."""

from __future__ import annotations

import os
import re
from typing import TYPE_CHECKING, NamedTuple

from shapeblend_cli.blending.placing import as_drawn
from shapeblend_cli.errors import InputError
from shapeblend_cli.geometry import cubics
from shapeblend_cli.grading.grade import Grade, grade
from shapeblend_cli.grading.painting import SIDE, picture
from shapeblend_cli.model import Box
from shapeblend_cli.outputs.pixels import pictures_in
from shapeblend_cli.svg.reading.read import read

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import Drawing, PictureArray

LEAST_FRAMES = 3
"""Minimum number of frames of a strip: both ends and something between."""

MOST_FRAMES = 10_000
"""Maximum number of frames of a strip."""

SUFFIXES = (".svg", ".svgz", ".png", ".gif")
"""Endings of the names of files that are graded."""


class Judged(NamedTuple):
    """A strip, by its folder or its first file, and its grade."""

    name: str
    frames: int
    grade: Grade


def strips_of(names: Sequence[str]) -> list[tuple[str, list[str]]]:
    """Return the strips that names mean: each folder and each GIF is one, and all other files together are one.

    The frames in a folder are in the order of their names, numbers by their values.

    Raises
    ------
    InputError
        A folder without frames, or a file of another kind.
    """
    strips, files = [], []
    for name in names:
        if os.path.isdir(name):
            found = [os.path.join(name, file) for file in sorted(os.listdir(name), key=_natural)]
            frames = [file for file in found if file.lower().endswith(SUFFIXES)]
            if not frames:
                raise InputError(
                    name, f"the folder has no frames; files ending in {', '.join(SUFFIXES)} would work"
                )
            strips.append((name, frames))
        elif not name.lower().endswith(SUFFIXES):
            missing = "" if os.path.lexists(name) else "no such file or folder; "
            raise InputError(
                name, f"{missing}frames are files ending in {', '.join(SUFFIXES)}, or folders of them"
            )
        elif name.lower().endswith(".gif"):
            strips.append((name, [name]))
        else:
            files.append(name)
    return [*strips, (files[0], files)] if files else strips


def judge_files(name: str, files: Sequence[str]) -> Judged:
    """Grade a strip of files.

    Raises
    ------
    InputError
        A file that cannot be read, or a strip of fewer than three frames.
    PictureError
        PNG or GIF files where Pillow is not installed.
    """
    if len(files) > MOST_FRAMES:
        raise InputError(name, f"{len(files)} frames, and up to {MOST_FRAMES} can be judged")
    drawings = {file: read(file, lenient=True) for file in files if file.lower().endswith((".svg", ".svgz"))}
    view = _view(list(drawings.values()))
    strip: list[PictureArray] = []
    for file in files:
        if file in drawings:
            assert view is not None
            strip.append(picture(as_drawn(drawings[file]), view))
        else:
            strip += pictures_in(file, SIDE)
    if len(strip) < LEAST_FRAMES:
        frames = f"{len(strip)} frame{'s' * (len(strip) != 1)}"
        raise InputError(name, f"{frames} found; both ends and a frame between them would work")
    return Judged(name, len(strip), grade(strip))


def _view(drawings: Sequence[Drawing]) -> Box | None:
    """Return the view that all drawings have in common: of their viewBoxes, else of their shapes."""
    boxes = [drawing.viewbox for drawing in drawings if drawing.viewbox is not None]
    if len(boxes) < len(drawings):
        shapes = [shape for drawing in drawings for shape in drawing.shapes]
        boxes += [cubics.bounds(contour.segments) for shape in shapes for contour in shape.contours]
    return Box.union(boxes) if boxes else None


def _natural(name: str) -> list[tuple[int, str]]:
    """Return the words and numbers of a name, by which frame-10 comes after frame-9."""
    return [(int(part), "") if part.isdecimal() else (-1, part) for part in re.split(r"(\d+)", name) if part]
