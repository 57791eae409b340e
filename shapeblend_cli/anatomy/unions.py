"""Areas joined, cut and confined by skia-pathops; strokes as the areas that they paint."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.anatomy.decompose import is_straight
from shapeblend_cli.geometry import cubics
from shapeblend_cli.geometry.polygons import ring_edges
from shapeblend_cli.geometry.raster import winding_grid
from shapeblend_cli.model import Box, Contour

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from pathops import Path

    from shapeblend_cli.model import BoolArray, ComplexArray, CubicPath, Style

CURVE_POINTS = 8
"""Number of edges of a curved segment."""

GRID = 144
"""Number of points along the side of the rasters that are compared."""

MOST_UNLIKE = 0.01
"""Maximum share of a painted area that may change."""

PIECES = 6
"""Size of areas that are made of pieces for skia-pathops, whose precision is single, and whose tolerances are those of
pixels: a power of 2."""

CUT = 8
"""The same of areas that are cut, where less must change."""


class Sheet(NamedTuple):
    """The mapping from the units of a drawing to sizes that skia-pathops works with."""

    corner: complex
    scale: float

    @classmethod
    def around(cls, paths: Sequence[CubicPath], size: int) -> Sheet:
        """Return the sheet on which paths have a size: a power of 2."""
        box = Box.around(np.concatenate([path.segments.ravel() for path in paths]))
        return cls(complex(box.x, box.y), 2.0 ** round(size - np.log2(box.larger_side)))

    def area(self, paths: Sequence[CubicPath], rule: str = "nonzero") -> Path:
        """Return what paths paint that are filled."""
        from pathops import FillType, Path

        found = Path(fillType=FillType.EVEN_ODD if rule == "evenodd" else FillType.WINDING)
        for path in paths:
            self._draw(found, path, closed=True)
        return found

    def stroked(self, paths: Sequence[CubicPath], style: Style) -> Path:
        """Return what paths paint that are stroked."""
        from pathops import LineCap, LineJoin, Path

        found = Path()
        for path in paths:
            self._draw(found, path, closed=path.closed)
        cap = {"round": LineCap.ROUND_CAP, "square": LineCap.SQUARE_CAP}.get(
            style.stroke_linecap, LineCap.BUTT_CAP
        )
        join = {"round": LineJoin.ROUND_JOIN, "bevel": LineJoin.BEVEL_JOIN}.get(
            style.stroke_linejoin, LineJoin.MITER_JOIN
        )
        dashes = [self.scale * length for length in style.stroke_dasharray]
        dashes *= 1 + len(dashes) % 2  # an odd number of lengths goes on with gaps and dashes exchanged
        shift = self.scale * style.stroke_dashoffset
        found.stroke(self.scale * style.stroke_width, cap, join, style.stroke_miterlimit, dashes, shift)
        found.convertConicsToQuads()
        return found

    def outlines(self, path: Path) -> list[Contour]:
        """Return the outlines of an area, for either fill rule: exteriors one way and holes the other."""
        from pathops import PathVerb

        subpaths: list[list[tuple[complex, ...]]] = []
        at = 0j
        for verb, pairs in path:
            points = [complex(x, y) / self.scale + self.corner for x, y in pairs]
            if verb == PathVerb.MOVE:
                subpaths.append([])
            elif verb == PathVerb.CLOSE:
                points = [subpaths[-1][0][0]] if subpaths[-1] else [at]
            if verb != PathVerb.MOVE and points[-1] != at:
                subpaths[-1].append((at, *points))
            at = points[-1]
        return [
            outline(np.stack(list(map(_cubic, each))), np.array([len(segment) == 2 for segment in each]))
            for each in subpaths
            if each
        ]

    def _draw(self, found: Path, path: CubicPath, *, closed: bool) -> None:
        segments = self.scale * (path.segments - self.corner)
        found.moveTo(*_pairs(segments[0, :1]))
        for segment, is_line in zip(segments, path.straight, strict=True):
            if is_line:
                found.lineTo(*_pairs(segment[3:]))
            else:
                found.cubicTo(*_pairs(segment[1:]))
        if closed:
            found.close()


def united(contours: Sequence[Contour]) -> list[Contour]:
    """Return the outlines of a union, exteriors one way and holes the other; none if they are not found."""
    from pathops import PathOpsError

    sheet = Sheet.around(contours, PIECES)
    path = sheet.area(contours)
    try:
        path.simplify(keep_starting_points=False)
    except PathOpsError:
        return []
    return sheet.outlines(path)


def outline(segments: ComplexArray, straight: BoolArray) -> Contour:
    """Return a closed contour, straight segments with inner points at thirds; no node at its start within a line."""
    if straight[0] and straight[-1] and len(segments) > 3 and is_straight(segments[[-1, 0, 0], [0, 0, 3]]):
        segments[0, 0] = segments[-1, 0]
        segments, straight = segments[:-1], straight[:-1]
    ends = segments[straight, 3:]
    segments[straight] = cubics.line(segments[straight, :1], ends)
    segments[straight, 3:] = ends  # exactly, where the next one begins
    return Contour(segments, straight, closed=True)


def rasters(box: Box, *sides: tuple[Sequence[CubicPath], str]) -> Iterator[BoolArray]:
    """Yield where closed paths paint by their rules, each on a raster of a box."""
    corner, step = complex(box.x, box.y), box.larger_side / GRID
    for paths, rule in sides:
        if not paths:
            yield np.zeros((GRID, GRID), np.bool_)
            continue
        windings = winding_grid(*ring_edges([polyline(path) for path in paths]), corner, step, GRID)
        yield windings % 2 != 0 if rule == "evenodd" else windings != 0


def are_alike(before: BoolArray, after: BoolArray) -> bool:
    """Return whether two rasters show the same but for slivers."""
    return int((before != after).sum()) <= MOST_UNLIKE * int(before.sum())


def polyline(path: CubicPath) -> ComplexArray:
    """Return points along a closed path."""
    return path.segments[:, 0] if path.straight.all() else cubics.polyline(path.segments, CURVE_POINTS)


def _cubic(points: tuple[complex, ...]) -> ComplexArray:
    """Return a line, whose inner points are at its ends, a quadratic or a cubic as a cubic."""
    first, *inner, last = points
    if len(inner) == 1:
        inner = [(end + 2.0 * inner[0]) / 3.0 for end in (first, last)]
    return np.array([first, *(inner or (first, last)), last])


def _pairs(points: ComplexArray) -> list[float]:
    return np.ascontiguousarray(points).view(float).tolist()
