"""Pictures that are bent with the outlines around them, as the paper has it: the blend of outlines drives theirs."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.errors import with_extra
from shapeblend_cli.geometry import cubics
from shapeblend_cli.geometry.polygons import signed_area, winding_numbers
from shapeblend_cli.images.bending import Bending
from shapeblend_cli.images.bent import BentPicture
from shapeblend_cli.images.triangles import NotSimpleError, is_available
from shapeblend_cli.interpolate.paths import paths_at
from shapeblend_cli.model import ClipBlend
from shapeblend_cli.model.words import words_in

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.images.bending import Mesh
    from shapeblend_cli.model import (
        ComplexArray,
        ContourBlend,
        CubicPath,
        FloatArray,
        Pair,
        Picture,
        ShapeBlend,
    )

POINTS = 96
"""Number of points on an outline, about; each of its segments has one or more."""

LEAST_FILLED = 0.5
"""Minimum share of the area of an outline that a picture covers if it is bent with it, without being clipped by it."""

NEAR = 0.01
"""Tolerance of outlines that are the same, and of pictures in them, as a share of their size."""

LOOKS = tuple(float(t) for t in np.linspace(0.0, 1.0, 25))
"""Times at which it is looked whether an outline can be bent."""

NOT_BENT = "a picture is not bent with its outline, which crosses itself on the way; it moves as a whole"


class OutlineBend:
    """The bending of a picture with an outline that moves."""

    def __init__(self, outline: ShapeBlend, *, as_triangles: bool) -> None:
        self._outline = outline._replace(span=(0.0, 1.0), pace=())
        self.as_triangles = as_triangles
        (contour,) = outline.contours
        self._shares = _shares(contour)
        ends = [_sampled(path, self._shares) for path in (contour.start, contour.end)]
        self._is_clockwise = signed_area(ends[0]) < 0.0

    @cached_property
    def bending(self) -> Bending | None:
        """How the outline is bent; None if it crosses itself on the way."""
        between = [(t, self._at(t)) for t in LOOKS]
        try:
            return Bending(between[0][1], between[-1][1], between)
        except NotSimpleError:
            return None

    def _at(self, t: float) -> ComplexArray:
        """Return points of the outline at time t, in the direction of a positive area."""
        points = _sampled(paths_at(self._outline, t)[0], self._shares)
        return _spread(points[::-1] if self._is_clockwise else points)

    def mesh(self, t: float) -> Mesh | None:
        """Return the triangles at time t."""
        if self.bending is None:
            return None
        try:
            return self.bending.mesh(self._at(t), t)
        except NotSimpleError:
            return None

    def at(self, shape: ShapeBlend, t: float) -> BentPicture | None:
        """Return the picture of a shape at time t; None where it cannot be bent."""
        own = min(max(shape.own_time(t), 0.0), 1.0)
        mesh = self.mesh(own)
        a, b = shape.style_a, shape.style_b
        if mesh is None or a.picture is None or b.picture is None:
            return None
        share = 1.0 if shape.fade is None else shape.fade.share(own)
        weights = share * (1.0 - own) * a.fill_opacity, share * own * b.fill_opacity
        # Of a picture in one drawing only, its own place counts.
        way = own if None not in shape.sources else float(shape.sources[0] is None)
        return BentPicture((a.picture, b.picture), weights, way, mesh)


def with_bends(pair: Pair, warp: str) -> tuple[Pair, list[str]]:
    """Return a pair whose pictures are bent with the outlines around them, and notes on those that cannot be."""
    shapes: list[ShapeBlend] = list(pair.shapes)
    notes: list[str] = []
    for k, shape in enumerate(pair.shapes):
        if shape.style_a.picture is None or words_in(shape.style_a.picture) is not None:
            continue
        found = _outline_of(k, pair.shapes)
        if found is None:
            continue
        if not is_available():
            notes.append(f"pictures are not bent with their outlines; {with_extra('images')} would do that")
            continue
        outline, clips = found
        bend = OutlineBend(outline, as_triangles=warp == "svg")
        if bend.bending is None:
            notes.append(NOT_BENT)
        else:
            shapes[k] = shape._replace(bend=bend, clips=clips)
    return pair._replace(shapes=tuple(shapes)), notes


def _outline_of(k: int, shapes: Sequence[ShapeBlend]) -> tuple[ShapeBlend, tuple[ClipBlend, ...]] | None:
    """Return the outline that a picture is bent with, and its clips then; None if there is none."""
    picture = shapes[k]
    is_alone = None in picture.sources
    if picture.clips and not is_alone:
        regions = [
            clip.shapes[0] for clip in picture.clips if len(clip.shapes) == 1 and _bends(clip.shapes[0])
        ]
        return (regions[-1], picture.clips) if regions else None
    if picture.clips:
        # One of the outlines that are seen may run where the picture is clipped.
        end = 0 if picture.sources[1] is None else 1
        region = picture.clips[-1].shapes
        for shape in shapes:
            if len(region) == 1 and len(region[0].contours) == 1 and _bends(shape):
                if _are_same(region[0].contours[0], shape.contours[0], end):
                    return shape, (*picture.clips[:-1], ClipBlend((shape,)))
        return None
    for near in (k + 1, k - 1):
        if 0 <= near < len(shapes) and _bends(shapes[near]) and _surrounds(shapes[near], picture):
            return shapes[near], ()
    return None


def _bends(shape: ShapeBlend) -> bool:
    """Return whether a shape is a single closed outline at both ends."""
    if shape.style_a.picture is not None or len(shape.contours) != 1:
        return False
    (contour,) = shape.contours
    return contour.is_matched and contour.start.closed and signed_area(contour.polygon_a.vertices) != 0.0


def _are_same(one: ContourBlend, other: ContourBlend, end: int) -> bool:
    """Return whether two outlines run in the same place in one of the drawings."""
    p, q = one.polygon(end), other.polygon(end)
    apart = np.abs(p.vertices[:, None] - _edges(q.line)).min(axis=1)
    back = np.abs(q.vertices[:, None] - _edges(p.line)).min(axis=1)
    return float(max(apart.max(), back.max())) <= NEAR * p.box.diagonal


def _edges(line: ComplexArray) -> ComplexArray:
    """Return points along a line, close to each other."""
    steps = np.linspace(0.0, 1.0, 8, endpoint=False)
    return (line[:-1, None] + np.diff(line)[:, None] * steps).ravel()


def _surrounds(shape: ShapeBlend, picture: ShapeBlend) -> bool:
    """Return whether an outline is around a picture, which fills most of it, wherever the picture is."""
    styles = picture.style_a, picture.style_b
    (contour,) = shape.contours
    for end, polygon in enumerate((contour.polygon_a, contour.polygon_b)):
        own = styles[end].picture
        if picture.sources[end] is None or own is None:
            continue
        corners = np.array(own.pose.corners)
        inner = corners + NEAR * (corners.mean() - corners)
        area = abs(signed_area(polygon.vertices))
        if not winding_numbers(inner, polygon.vertices).all() or _area(own) < LEAST_FILLED * area:
            return False
    return True


def _area(picture: Picture) -> float:
    return abs((picture.across.conjugate() * picture.down).imag)


def _shares(contour: ContourBlend) -> list[FloatArray]:
    """Return the parameters of points on each segment of an outline, by its length at both ends."""
    lengths = np.mean(
        [
            cubics.lengths(path.segments) / max(cubics.lengths(path.segments).sum(), 1e-300)
            for path in (contour.start, contour.end)
        ],
        axis=0,
    )
    counts = np.maximum(np.ceil(POINTS * lengths).astype(int), 1)
    return [np.arange(count) / count for count in counts.tolist()]


def _sampled(path: CubicPath, shares: Sequence[FloatArray]) -> ComplexArray:
    """Return points of a path at parameters of its segments."""
    numbers = np.repeat(np.arange(len(shares)), [len(share) for share in shares])
    return cubics.evaluate(path.segments[numbers], np.concatenate(shares))


def _spread(points: ComplexArray) -> ComplexArray:
    """Return points of a closed outline, those that coincide spread along the edge after them."""
    least = 1e-4 * float(np.abs(np.diff(points)).sum()) / len(points)
    steps = np.abs(np.roll(points, -1) - points)
    if steps.min() > least:
        return points
    # As shares of the whole way round, with at least so much from each to the next.
    even = np.maximum(steps, least)
    along = np.append(0.0, np.cumsum(steps))
    wanted = np.append(0.0, np.cumsum(even)[:-1]) * along[-1] / even.sum()
    line = np.append(points, points[0])
    return np.interp(wanted, along, line.real) + 1j * np.interp(wanted, along, line.imag)
