"""Drawings that are another one turned as a whole, or its mirror image, such as a thumb up and a thumb down.

On their ordinary way such drawings are turned inside out. They look better if they turn as a whole, and what is left to
do is done on the way; and where much is left, as a card that is turned over. Long drawings that point in different
directions, such as a pencil and a brush, turn as well where that looks better.
"""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.blending.graded import BETTER, FINE, faults_of
from shapeblend_cli.blending.swaps.swapped import is_swapped
from shapeblend_cli.geometry.polyline import are_near, cumulative_lengths, points_at
from shapeblend_cli.model import Box
from shapeblend_cli.motion.alignment import align_contours
from shapeblend_cli.motion.choose import candidate_of, is_edited
from shapeblend_cli.motion.rigid import Whole
from shapeblend_cli.pairing.same import same_pairs

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from shapeblend_cli.anatomy.decompose import PlacedDrawing
    from shapeblend_cli.model import BoolArray, ComplexArray, ContourBlend, ShapeBlend, Shapes

    Blend = Callable[[PlacedDrawing, PlacedDrawing], Shapes]

MOST_CONTOURS = 100
"""Maximum number of contours of a drawing that is compared with another one turned."""

POINTS = 64
"""Number of points of a drawing that are looked for in the other one."""

NEAR = 0.03
"""Maximum distance of a point from the other drawing, as a share of the drawing's size."""

SAME_SIZE = 0.12
"""Maximum difference of the sides of two drawings, as a share of their size."""

STAYS = 0.6
"""Minimum share of points that are in the other drawing as it is for these to rest on the way, too."""

MOST_STAYS = 0.9
"""Maximum share of points that are in the other drawing as it is for the drawing to be turned."""

COPIED = 0.85
"""Minimum share of points that are in the other drawing when it is turned."""

LITTLE_LEFT = 0.95
"""Maximum sum of the faults of what a drawing does besides turning."""

LITTLE_MOVED = 0.25
"""Maximum mean distance that points of a drawing move besides turning, as a share of its size; or else of their
partners from their own mirror images. Further away, a head becomes a tail, and another head grows."""

CLEAN = 0.05
"""Maximum fault of the outlines of an ordinary blend that is preferred to turning the drawing over."""

RIGHT_FOR_EDITED = 0.3
"""Maximum fault of straight paths for which a long drawing whose nodes seem to have been moved does not turn."""

LONG = 2.0
"""Minimum ratio of the spreads of a long drawing along and across its axis."""

LEAST_TURN = np.radians(20.0)
"""Minimum angle between the axes of two long drawings for one to turn, in radians."""

TURNED, TURNED_OVER, POINTS_ELSEWHERE = (
    "B is A turned as a whole",
    "B is A's mirror image, turned over",
    "a long drawing turns as a whole",
)


def turned_as_a_whole(
    a: PlacedDrawing, b: PlacedDrawing, view: Box, usual: Callable[[], Shapes], blend: Blend
) -> Shapes:
    """Return the blend of two drawings that looks best: as usual, turned as a whole, or turned over.

    `blend` blends A with another drawing on straight paths.
    """
    as_usual = usual()
    if max(len(a.contours), len(b.contours)) > MOST_CONTOURS:
        return as_usual
    way = way_between(a, b)
    if way is None:
        return _turned_to_its_axis(a, b, view, as_usual, blend)
    if faults_of(as_usual, view) <= FINE:
        return as_usual
    turned = way if way.angle else way._replace(angle=np.pi, over=0j)
    beside = blend(a, turned_back(b, turned))
    keeps = turned is way or _keeps_its_parts(beside, lambda points: turned.undo(way.apply(points)))
    if keeps and faults_of(beside, view) <= LITTLE_LEFT:
        return carried(beside, turned, TURNED)
    if turned is way or (not is_swapped(as_usual) and _is_clean(as_usual, view)):
        return as_usual
    return carried(blend(a, turned_back(b, way)), way, TURNED_OVER)


def _turned_to_its_axis(
    a: PlacedDrawing, b: PlacedDrawing, view: Box, as_usual: Shapes, blend: Blend
) -> Shapes:
    """Return the blend of two long drawings that looks best: as usual, or turned from one axis to the other."""
    lines = _lines(a), _lines(b)
    if not all(lines):
        return as_usual
    axis_a, axis_b = _axis(_points(lines[0])), _axis(_points(lines[1]))
    if axis_a is None or axis_b is None or same_pairs(a.contours, b.contours, ()):
        return as_usual
    if all(map(_is_edited_and_right, as_usual)):
        return as_usual
    angle = float(np.angle(axis_b / axis_a))  # axes have no direction, so it is a quarter turn at most
    angle -= np.pi * round(angle / np.pi)
    if abs(angle) < LEAST_TURN:
        return as_usual
    in_a, in_b = (Box.union([contour.box for contour in side.contours]).centre for side in (a, b))
    tried = [(faults_of(as_usual, view), as_usual)]
    for turn in (angle, angle - np.copysign(np.pi, angle)):
        way = Whole(in_a, in_b, float(turn))
        beside = blend(a, turned_back(b, way))
        # The long way round must gain more.
        margin = BETTER * max(1.0, abs(turn) / (0.5 * np.pi))
        tried.append((faults_of(beside, view) + margin, carried(beside, way, POINTS_ELSEWHERE)))
    return min(tried, key=lambda one: one[0])[1]


def _is_edited_and_right(shape: ShapeBlend) -> bool:
    """Return whether nodes of a shape seem to have been moved, and it looks right if they go straight."""
    taken = shape.taken
    return is_edited(shape) and shape.motion is None and (taken is None or taken.wrong <= RIGHT_FOR_EDITED)


def _axis(points: ComplexArray) -> complex | None:
    """Return the direction in which points spread most, if they spread far less across it."""
    count = len(points)
    offsets = points - points.sum() / count
    square, both = complex((offsets**2).sum() / count), float((np.abs(offsets) ** 2).sum() / count)
    if both + abs(square) < LONG**2 * (both - abs(square)):
        return None
    return complex(np.sqrt(square))


def way_between(a: PlacedDrawing, b: PlacedDrawing) -> Whole | None:
    """Return how a drawing is turned as a whole, or turned over, to become about the other; None if it is not."""
    boxes = [Box.union([contour.box for contour in side.contours]) for side in (a, b)]
    size = max(box.larger_side for box in boxes)
    lines = _lines(a), _lines(b)
    if not all(lines):
        return None
    centres = boxes[0].centre, boxes[1].centre
    near = partial(_are_near_lines, tolerance=NEAR * size)

    def differ(turned: bool) -> bool:
        sides = [(boxes[0].width, boxes[0].height), (boxes[1].width, boxes[1].height)]
        there = sides[1][::-1] if turned else sides[1]
        return max(abs(p - q) for p, q in zip(sides[0], there, strict=True)) > SAME_SIZE * size

    if differ(turned=False) and differ(turned=True):
        return None
    points = [_points(side) for side in lines]
    stays = near(points[0] - centres[0] + centres[1], lines[1])
    if stays.mean() > MOST_STAYS:
        return None

    quarter = 0.5 * np.pi
    ways = [Whole(*centres, angle=angle) for angle in (np.pi, quarter, -quarter)]
    ways += [Whole(*centres, over=over) for over in (1.0 + 0j, 1j)]
    for way in ways:
        if differ(turned=abs(way.angle) == quarter):
            continue
        if stays.mean() > STAYS and not (
            way.angle and _rest(partial(way.apply, points[0][stays]), near, lines[0])
        ):
            continue
        there = near(way.apply(points[0]), lines[1])
        if there.mean() >= COPIED and near(way.undo(points[1]), lines[0]).mean() >= COPIED:
            return way
    return None


def turns_what_stays(a: PlacedDrawing, b: PlacedDrawing, contours: Sequence[ContourBlend]) -> bool:
    """Return whether what encloses A is in B, too, but would leave its place if A turned: a switch around its knob.

    Only strokes are asked about: fills that did not turn would be torn.

    Parameters
    ----------
    a, b : PlacedDrawing
        B is A turned as a whole.
    contours : sequence of ContourBlend
        The drawings, matched.
    """
    if len(a.contours) == 1 or any(contour.style.fill is not None for contour in a.contours):
        return False
    box = Box.union([contour.box for contour in a.contours])
    lines, others = _lines(a), _lines(b)
    near = partial(_are_near_lines, tolerance=NEAR * box.larger_side)
    points = _points(lines)
    staying = points[near(points, others)]
    if len(staying) <= STAYS * len(points) or not box.is_enclosed_by(staying):
        return False
    alignment = align_contours(contours)
    return not _rest(partial(alignment.apply, staying - alignment.centre_a), near, lines)


def _rest(
    moved: Callable[[float], ComplexArray], near: Callable[..., BoolArray], lines: Sequence[ComplexArray]
) -> bool:
    """Return whether what is in place at both ends is so on the way, as a face is that turns upside down."""
    return bool(min(near(moved(t), lines).mean() for t in (1 / 3, 1 / 2)) >= COPIED)


def _are_near_lines(points: ComplexArray, lines: Sequence[ComplexArray], tolerance: float) -> BoolArray:
    """Return which points are near any of some polylines."""
    return np.any([are_near(points, line, tolerance) for line in lines], axis=0)


def _lines(drawing: PlacedDrawing) -> list[ComplexArray]:
    """Return the outlines of a drawing as polylines."""
    return [c.polygon.line for c in drawing.contours if len(c.polygon.line) > 1]


def _points(lines: Sequence[ComplexArray]) -> ComplexArray:
    """Return points spread evenly along polylines."""
    lengths = [cumulative_lengths(line) for line in lines]
    step = sum(float(each[-1]) for each in lengths) / POINTS
    return np.concatenate(
        [
            points_at(np.arange(0.5 * step, each[-1] + 0.5 * step, step).clip(max=each[-1]), line, each)
            for line, each in zip(lines, lengths, strict=True)
        ]
    )


def turned_back(b: PlacedDrawing, way: Whole) -> PlacedDrawing:
    """Return B, laid over A."""
    return b._replace(contours=[contour.transformed(way.undo) for contour in b.contours])


def carried(shapes: Shapes, way: Whole, reason: str) -> Shapes:
    """Let shapes, blended with B laid over A, turn on their way and end where B has them."""

    def moved(contour: ContourBlend) -> ContourBlend:
        return contour._replace(
            end=replace(contour.end, segments=way.apply(contour.end.segments)),
            contour_b=replace(contour.contour_b, segments=way.apply(contour.contour_b.segments)),
            polygon_b=replace(contour.polygon_b, vertices=way.apply(contour.polygon_b.vertices)),
            # Its mirror image across the other axis is that turned by half a turn.
            rotation=np.pi if way.over == 1.0 else way.angle,
            mirrored=bool(way.over),
        )

    return tuple(
        shape._replace(contours=tuple(map(moved, shape.contours)), motion=way, reason=reason)
        for shape in shapes
    )


def _keeps_its_parts(shapes: Shapes, image: Callable[[ComplexArray], ComplexArray]) -> bool:
    """Return whether points of a drawing become about themselves, or their own images, on average."""
    contours = [contour for shape in shapes for contour in shape.contours if contour.is_matched]
    if not contours:
        return False
    size = max(contour.polygon_a.box.larger_side for contour in contours)
    dots = [contour.dot_points() for contour in contours]
    points, partners = (np.concatenate(side) for side in zip(*dots, strict=True))
    return any(np.abs(there - partners).mean() <= LITTLE_MOVED * size for there in (points, image(points)))


def _is_clean(shapes: Shapes, view: Box) -> bool:
    """Return whether shapes, no pen lines, keep their outlines on the way, on average."""
    if any(shape.motion_name == "pen" for shape in shapes):
        return False
    judged = [candidate_of(shape, view) for shape in shapes]
    faults, areas = [one.wrong for one in judged], [one.painted + 1e-9 for one in judged]
    return float(np.average(faults, weights=areas)) <= CLEAN
