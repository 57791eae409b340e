"""Measure how well pen lines are recovered from filled shapes: python -m tools.recovery [FOLDER ...].

Each SVG file of a folder is an icon. Without folders, icons of four sets from npm are measured: phosphor and bootstrap,
which are drawn with a pen and then expanded, and two solid ones, of each of which a number is drawn by lot.

An icon counts as drawn with a pen throughout if its thickness says so, which knows nothing of the recovery: its mean
thickness is twice its area over the length of its outlines; a thinner disc reaches all of its ink, and a thicker one
nearly none. Its lines are compared with its fill by their overlap: the area that both cover, as a
share of the area that either covers.
"""

from __future__ import annotations

import random
import sys
import tempfile
import time
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from shapely import LinearRing, LineString, Point, symmetric_difference_all, union_all

import shapeblend_cli as sb
from shapeblend_cli.pens.drawings import file_pens
from shapeblend_cli.pens.recovery.region import outline_points
from tools.quality.npm import icon_file, icon_set, install
from tools.quality.scores import inside
from tools.quality.tables import Table, share

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from shapely.geometry.base import BaseGeometry

    from shapeblend_cli.model import Drawing
    from shapeblend_cli.pens.line import PenLine

GOOD = 0.985
"""Minimum overlap of an icon drawn with a pen and its lines for these to be right."""

THIN, THICK = 0.8, 1.5
"""Diameters of the discs that measure the thickness of an icon, in mean thicknesses."""

REACHED, LEFT = 0.998, 0.05
"""Shares of the ink of an icon drawn with a pen: the least that the thin disc reaches, the most of the thick one."""

SOLID = 250
"""Number of icons that are drawn by lot of each solid set."""

REPEATS = 3
"""Number of times that the recovery of an icon is timed; the shortest counts."""


class Icon(NamedTuple):
    """An icon, and what is recovered of it."""

    is_pen: bool
    overlap: float
    lines: int
    milliseconds: float


def filled(drawing: Drawing) -> BaseGeometry:
    """Return what the fills of a drawing cover, by the even-odd rule within each shape."""
    return union_all(
        [
            symmetric_difference_all([inside(outline_points(each.segments)) for each in shape.contours])
            for shape in drawing.shapes
            if shape.style.fill
        ]
    )


def is_drawn_with_a_pen(region: BaseGeometry) -> bool:
    """Whether a region is of one thickness throughout."""
    thickness = 2.0 * region.area / region.length

    def reached(diameter: float) -> float:
        return region.buffer(-diameter / 2.0).buffer(diameter / 2.0).area / region.area

    return reached(THIN * thickness) >= REACHED and reached(THICK * thickness) <= LEFT


def stroked(line: PenLine, scale: float) -> BaseGeometry:
    """Return what a line covers, in the file's units."""
    points = np.column_stack([line.points.real, line.points.imag]) / scale
    if len(points) == 1:
        return Point(points[0]).buffer(line.width / scale / 2.0)
    cap = {"butt": "flat"}.get(line.style.stroke_linecap, line.style.stroke_linecap)
    join = {"miter": "mitre"}.get(line.style.stroke_linejoin, line.style.stroke_linejoin)
    course = LinearRing(points) if line.closed and len(points) > 2 else LineString(points)
    return course.buffer(line.width / scale / 2.0, cap_style=cap, join_style=join)


def measured(file: Path) -> Icon | None:
    """Recover the lines of an icon, and compare them with its fill; None if it has none."""
    drawing = sb.read(file)
    region = filled(drawing)
    if region.is_empty:
        return None
    taken = []
    for _ in range(REPEATS):
        begin = time.process_time()
        pens, scale = file_pens(drawing)
        taken.append(time.process_time() - begin)
    lines = union_all([stroked(line, scale) for line in pens.lines])
    overlap = (lines & region).area / (lines | region).area
    return Icon(is_drawn_with_a_pen(region), overlap, len(pens.lines), 1000.0 * min(taken))


def icons_of(name: str, is_taken: Callable[[str], bool], most: int | None, folder: Path) -> Path:
    """Write icons of a set from npm to a folder, and return it."""
    names = sorted(filter(is_taken, icon_set(name)["icons"]))
    target = folder / name
    target.mkdir()
    for each in random.Random(31).sample(names, most) if most else names:
        (target / f"{each}.svg").write_text(icon_file(name, each), "utf-8")
    return target


def icon_folders(folder: Path) -> Iterator[Path]:
    """Write the sets from npm."""
    if problem := install():
        sys.exit(f"no icons: {problem}")
    weights = ("-bold", "-duotone", "-fill", "-light", "-thin")
    yield icons_of("ph", lambda name: not name.endswith(weights), None, folder)
    yield icons_of("bi", lambda name: not name.endswith("-fill"), None, folder)
    yield icons_of("game-icons", lambda name: True, SOLID, folder)
    yield icons_of("fluent-emoji-high-contrast", lambda name: True, SOLID, folder)


def row(name: str, icons: list[Icon]) -> list[str]:
    """Return a row of the table."""
    pens = [icon.overlap for icon in icons if icon.is_pen]
    return [
        name,
        str(len(icons)),
        str(len(pens)),
        share(overlap > GOOD for overlap in pens) if pens else "–",
        f"{np.median(pens):.4f}" if pens else "–",
        str(sum(icon.lines > 0 for icon in icons if not icon.is_pen)),
        f"{np.median([icon.milliseconds for icon in icons]):.1f}",
    ]


HEADER = (
    "set",
    "icons",
    "drawn with a pen throughout",
    f"of these, overlap above {GOOD}",
    "median overlap",
    "others with lines",
    "processor ms an icon, median",
)


def main() -> None:
    with tempfile.TemporaryDirectory() as temporary:
        folders = [Path(each) for each in sys.argv[1:]] or list(icon_folders(Path(temporary)))
        rows = []
        for folder in folders:
            icons = [icon for file in sorted(folder.glob("*.svg")) if (icon := measured(file))]
            if not icons:
                sys.exit(
                    f"{folder}: no SVG file with a filled shape in it; a folder of such icons would work"
                )
            rows.append(row(folder.name, icons))
    print(Table(HEADER, rows).markdown(), end="")


if __name__ == "__main__":
    main()
