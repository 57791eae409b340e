"""When two drawings have so little in common that one takes the other's place instead of becoming it.

The paper's work has no such limit: the least of much work is still the least. But a line that is bent nearly all along
reads as scrap on its way, however evenly it moves.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.anatomy.decompose import EXTERIOR, HOLE
from shapeblend_cli.blending.graded import SWAP_GRADE, faults_of, grade_of_shapes, in_full_width, seen_of
from shapeblend_cli.blending.swaps.swapped import is_swapped
from shapeblend_cli.blending.turned_drawings import POINTS_ELSEWHERE
from shapeblend_cli.geometry import cubics
from shapeblend_cli.geometry.polygons import signed_area
from shapeblend_cli.geometry.polyline import are_near
from shapeblend_cli.interpolate.paths import paths_at
from shapeblend_cli.model import Box
from shapeblend_cli.pens.line import evenly, length

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from shapeblend_cli.anatomy.decompose import PlacedDrawing
    from shapeblend_cli.model import ComplexArray, ContourBlend, PictureArray, ShapeBlend, Shapes
    from shapeblend_cli.pens.line import PenDrawing, PenLine

MOST_BENT = 1.1
"""Maximum spread of the turns along a line that becomes another, in radians: the standard deviation by length."""

WAVY_BENT = 0.9
"""Maximum spread of the turns along a wavy line that splits, in radians: a gear would come to worms."""

BENT = 0.6
"""Maximum spread of the turns along a line where much else comes and goes, in radians."""

MOST_ALONE = 0.28
"""Maximum share of the lines of both drawings that comes and goes where a line is bent more than `BENT`."""

SENT_BACK = 1.2
"""Minimum sum of the faults of a blend in which a solid drawing shrivels to a stroke for them to be swapped."""

FAULTY = 0.8
"""Minimum sum of the faults of a blend for trees to be asked how good it is."""

TOLD = 1.3
"""Minimum grade that trees tell of a blend by lines, with its loose ends, for the drawings to be swapped."""

TOLD_IF_BENT = 1.05
"""The same where a line is bent very much: what becomes of it cannot be read."""

TOLD_IF_SIMPLE = 1.6
"""The same where most of one drawing lies on the other one, or where all lines are simple: these can be read."""

TOLD_IF_BARS = 2.0
"""The same where all lines are bars, and few: what goes straight is read in any case."""

TOLD_IF_SPLIT = 1.8
"""The same where all lines split, join, come or go: trees do not know that they are to do so."""

MOST_SIMPLE = 6
"""Maximum number of simple lines of both drawings together: pixel art has more."""

PER_LOOSE_END = 0.15
"""Increase of the grade that trees tell of a blend by lines for each end that comes loose."""

MOST_LOOSE = 2
"""Maximum number of loose ends that make a difference."""

LEG = 0.98
"""Minimum length of a bar, or of both legs of a chevron together, as a share of the length of the line."""

ROUND = 0.9
"""Minimum area of a ring that is a circle, as a share of that of a circle as long."""

LOOSE_TIMES = tuple(k / 8 for k in range(9))
"""Times at which loose ends of lines are counted, both drawings among them."""

TOUCHES = 0.55
"""Maximum distance of the end of a line from another one that it touches, as a share of their mean width."""

OWN = 1.5
"""Length of a line beside its own end that this cannot touch, in widths."""

WHOLLY = 1.5
"""Maximum spread of turns that makes a difference to other drawings than lines, in radians."""


class Hopeless(NamedTuple):
    """The limit beyond which the blend of drawings that are not lines alone is hopeless."""

    least: float  # grade that trees tell, with the two below
    per_bent: float  # increase for each radian by which the largest outline is bent
    in_common: float  # reduction if each drawing covers the other one
    told: float  # grade that trees must tell without these

    def is_reached(self, told: float, covered: float, bent: float) -> bool:
        """Return whether a blend is that bad."""
        grade = told + self.per_bent * bent - self.in_common * covered
        return told >= self.told and grade >= self.least


ANY = Hopeless(1.4, 0.26, 0.84, told=0.0)
"""Limit for all drawings."""

SIGNS = Hopeless(1.7, 1.0, 0.6, told=1.2)
"""Further limit for signs, such as icons: a bent one is soon a lump."""

COLOURED = Hopeless(0.8, 0.26, 0.84, told=SWAP_GRADE)
"""Further limit for drawings of several colours of which much comes and goes: details that melt stand out."""

ALONE = 0.2
"""Minimum share of the shapes of a blend without a partner for much to come and go."""

FEW = 8
"""Maximum number of contours of a blend of signs, with or without a partner."""

BADGED = 0.75
"""Minimum share that signs cover of each other for the difference to be a detail, such as a badge."""

WAVY = 2.0 * np.pi
"""Maximum change of the turns along a line that splits for it to straighten, in radians."""

STRAIGHT = 0.2
"""Maximum change of the turns along a line beside a corner that opens and turns over, in radians."""

SAME_LENGTH = 0.95
"""Minimum ratio of the lengths of an open line that may become its own mirror image, such as a bracket."""

COVERED = 0.6
"""Minimum share of the lines of a drawing that lies on lines of the other one for these to be seen to stay."""

STEP = 0.3
"""Maximum distance of the points along lines of which it is looked up whether they lie on others, in units."""

FLAT = 0.02
"""Maximum area of a ring that is pressed flat, as a share of the square of its larger side."""

POINTS = 4
"""Number of points on each segment between which its directions are compared."""

ALL = 0.9
"""Minimum share of the ink of a drawing in its lines for it to be a sign, such as a check mark."""

MOSTLY = 0.6
"""Minimum share of the ink of a drawing in its lines for these to be most of it."""

SOLID = 0.3
"""Maximum share of the ink of a solid drawing in its lines."""

LINES_OF_SIGN = 4
"""Maximum number of lines of a sign that becomes a plate with something cut out of it, or comes of one."""

FULL = 0.7
"""Minimum area of the outline of such a plate, as a share of its box: a disc has .79."""

LEAST_CUT_OUT = 0.35
"""Minimum size of a sign that is cut out of a plate, as a share of the plate's: a hole may be smaller."""

BARELY = 0.25
"""Maximum share of ink that such a plate and such a sign have in common."""

DETAILED = 4.6
"""Minimum length of the outlines of a solid drawing that cannot shrivel to a single stroke, in sides of the view."""

STRAIGHTFORWARD = 0.1
"""Maximum spread of the turns along outlines that keep their directions, as those of a letter in another weight, in
radians."""

TURNING = ("rigid", "flip")
"""Motions that turn a drawing, or turn it over, without bending its lines."""


def are_too_unlike(
    a: PlacedDrawing, b: PlacedDrawing, shapes: Shapes, pens: tuple[PenDrawing, PenDrawing], view: Box
) -> bool:
    """Return whether no blend shows what becomes what.

    That is so of two signs, of a solid drawing and a single stroke, and of a plate with a sign cut out and a sign
    alone: half way it would be a blot without a sign.
    """
    if _keep_directions(shapes):
        return False
    first, last = pens
    share = min(first.share, last.share)
    if share >= ALL and not any(shape.is_matched for shape in shapes):
        return True
    if share >= MOSTLY:
        return _is_sent_back(shapes, first.lines, last.lines, view)
    solids = [side for side, pen in zip((a, b), pens, strict=True) if pen.share < SOLID]
    signs = [side for side, pen in zip((a, b), pens, strict=True) if _is_sign(side, pen)]
    if solids and signs and _is_cut_out(solids[0]) and ink_in_common(shapes, view) < BARELY:
        return True
    strokes = [pen for pen in pens if pen.share >= ALL and [line.closed for line in pen.lines] == [False]]
    if not (solids and strokes):
        return False
    outlines = sum(length(contour.polygon.line) for contour in solids[0].contours)
    faults = faults_of(in_full_width(shapes), view)
    return outlines > DETAILED * view.larger_side and faults >= SENT_BACK


def _is_sign(drawing: PlacedDrawing, pen: PenDrawing) -> bool:
    """Return whether a drawing is a sign of few lines with ends that surround nothing, unlike many letters."""
    if pen.share < MOSTLY or len(pen.lines) > LINES_OF_SIGN:
        return False
    return all(contour.role != HOLE for contour in drawing.contours) and not all(
        line.closed for line in pen.lines
    )


def _is_cut_out(solid: PlacedDrawing) -> bool:
    """Return whether a drawing is one plate with a sign cut out of it."""
    outlines = [contour for contour in solid.contours if contour.role == EXTERIOR]
    holes = [contour.box for contour in solid.contours if contour.role == HOLE]
    if len(outlines) != 1 or not holes or outlines[0].area < FULL * outlines[0].box.area:
        return False
    return Box.union(holes).larger_side >= LEAST_CUT_OUT * outlines[0].box.larger_side


def _is_sent_back(shapes: Shapes, lines: Sequence[PenLine], others: Sequence[PenLine], view: Box) -> bool:
    """Return whether trees grade a blend by lines too badly, the sooner the more of its ends come loose."""
    if faults_of(in_full_width(shapes), view) < FAULTY:
        return False
    grade, least = grade_of_shapes(shapes, view), _least_told(shapes, lines, others)
    if grade < least - PER_LOOSE_END * MOST_LOOSE:
        return False
    return grade >= least or grade + PER_LOOSE_END * loose_ends(shapes) >= least


def is_hopeless(shapes: Shapes, view: Box) -> bool:
    """Return whether a blend of drawings that are not lines alone is worse than that they take each other's place.

    That is told by its grade, by how much the largest outline is bent, and by how much the drawings have in common.
    """
    if not is_faulty(shapes, view):
        return False
    covered = ink_in_common(shapes, view)
    told, bent = grade_of_shapes(shapes, view), _main_bending(shapes)
    limits = [ANY]
    if covered < BADGED and _are_signs(shapes):
        limits.append(SIGNS)
    if _either_has_colours(shapes) and sum(not shape.is_matched for shape in shapes) >= ALONE * len(shapes):
        limits.append(COLOURED)
    return any(limit.is_reached(told, covered, bent) for limit in limits)


def is_faulty(shapes: Shapes, view: Box) -> bool:
    """Return whether a blend has faults, and may be replaced.

    A single outline always becomes the other one, a copy that turns as a whole is seen to be the same, and so is a
    plate in which lines become each other, and what keeps its directions.
    """
    if is_swapped(shapes) or sum(len(shape.contours) for shape in shapes) == 1 or _keep_directions(shapes):
        return False
    if any(map(_is_inlaid, shapes)) or all(map(_is_turned_copy, shapes)):
        return False
    return faults_of(shapes, view) >= FAULTY


def ink_in_common(shapes: Shapes, view: Box) -> float:
    """Return which share of what either drawing paints both paint, from 0 to 1."""
    first, last = ink_of(shapes, view)
    return float(np.minimum(first, last).sum() / np.maximum(first, last).sum())


def ink_of(shapes: Shapes, view: Box) -> tuple[PictureArray, PictureArray]:
    """Return what is painted of both drawings, as opacities in square pictures of a view."""
    first, *_, last = seen_of(shapes, view).ink
    return first, last


def _are_signs(shapes: Shapes) -> bool:
    """Return whether a blend has few contours, and each drawing one colour."""
    if sum(len(shape.contours) for shape in shapes) > FEW or _either_has_colours(shapes):
        return False
    styles = [style for shape in shapes for style in (shape.style_a, shape.style_b)]
    return not any(style.fill_gradient or style.stroke_gradient for style in styles)


def _either_has_colours(shapes: Shapes) -> bool:
    """Return whether either drawing has several colours; a sign that only changes its colour has one."""
    sides = [
        {
            paint.colour
            for shape in shapes
            if shape.sources[side] is not None
            for paint in shape.style(side).paints
        }
        for side in (0, 1)
    ]
    return any(len(colours - {None}) > 1 for colours in sides)


def _is_turned_copy(shape: ShapeBlend) -> bool:
    """Return whether a shape turns because B is A turned, or turned over, and not because both are long."""
    return shape.motion_name in TURNING and shape.reason != POINTS_ELSEWHERE


def _is_inlaid(shape: ShapeBlend) -> bool:
    """Return whether a shape is a plate with lines that are cut out of it."""
    return shape.motion_name == "pen" and shape.style_a.fill is not None


def _keep_directions(shapes: Shapes) -> bool:
    """Return whether all are outlines that become others which run as they do: these may be thicker, but not unlike."""
    contours = [contour for shape in shapes for contour in shape.contours]
    are_outlines = all(
        contour.is_matched and contour.start.closed and contour.end.closed for contour in contours
    )
    return are_outlines and all(_bending(contour, 0.0) <= STRAIGHTFORWARD for contour in contours)


def _main_bending(shapes: Shapes) -> float:
    """Return the spread of the turns along the largest outline with a partner, in radians, but at most `WHOLLY`.

    It is 0 for one that turns as it is, and `WHOLLY` if none has a partner.
    """
    matched = [(shape, contour) for shape in shapes for contour in shape.contours if contour.is_matched]
    if not matched:
        return WHOLLY
    shape, largest = max(matched, key=lambda each: sum(_areas(each[1])))
    return 0.0 if shape.motion_name in TURNING else min(_bending(largest, 0.0), WHOLLY)


def _is_covered(lines: Sequence[PenLine], others: Sequence[PenLine]) -> bool:
    """Return whether most of some lines lies on others, as a minus does on a plus."""
    points = np.concatenate([evenly(line.drawn, STEP) for line in lines])
    near = np.any([are_near(points, line.drawn, 0.5 * line.width) for line in others], axis=0)
    return bool(near.mean() > COVERED)


def _least_told(shapes: Shapes, lines: Sequence[PenLine], others: Sequence[PenLine]) -> float:
    """Return the grade from which on drawings that are mostly lines make room for each other, of a blend of these."""
    from shapeblend_cli.pens.splits import COPY  # most drawings are no signs

    every = (*lines, *others)
    is_few = len(every) <= MOST_SIMPLE
    if is_few and all(map(_is_bar, every)):
        return TOLD_IF_BARS
    is_bent, is_like = _is_bent(shapes), _is_covered(lines, others) or _is_covered(others, lines)
    becoming = [shape.reason for shape in shapes if shape.is_matched]
    if becoming and all(reason == COPY for reason in becoming) and (is_like or not is_bent):
        return TOLD_IF_SPLIT
    if is_like:
        return TOLD_IF_SIMPLE
    if is_bent:
        return TOLD_IF_BENT
    return TOLD_IF_SIMPLE if is_few and all(map(_is_simple, every)) else TOLD


def _is_bar(line: PenLine) -> bool:
    """Return whether a line is straight."""
    return bool(abs(line.drawn[-1] - line.drawn[0]) >= LEG * line.length)


def _is_simple(line: PenLine) -> bool:
    """Return whether a line is a bar, a chevron or a circle."""
    points = line.drawn
    if line.closed:
        return abs(signed_area(line.points)) >= ROUND * line.length**2 / (4.0 * np.pi)
    first, last = points[0], points[-1]
    ways = np.abs(points - first) + np.abs(points - last)
    return bool(ways.max() >= LEG * line.length)


def _is_bent(shapes: Shapes) -> bool:
    """Return whether a line is bent very much.

    Rings that become rings may bend; one that opens to a line, or is pressed flat to one, may not. Lines that split, as
    the ring of a play button, may straighten, but for wavy ones. Where much comes and goes, less bending is enough.
    """
    from shapeblend_cli.pens.splits import COPY  # most drawings are no signs

    bent = 0.0
    for shape, contour in _lines_of(shapes):
        are_rings = _are_rings(contour)
        if all(are_rings):
            continue
        bending = _bending(contour, WAVY if shape.reason == COPY else 0.0)
        if bending > (WAVY_BENT if shape.reason == COPY else MOST_BENT):
            return True
        bent = max(bent, bending)
    return bent > BENT and _share_alone(shapes) > MOST_ALONE


def loose_ends(shapes: Shapes) -> int:
    """Return how many ends of lines are loose on the way, beyond those in both drawings, at most `MOST_LOOSE`.

    There a line is torn off from others, or a ring is open. Lines that split are cut on purpose.
    """
    from shapeblend_cli.pens.splits import COPY  # most drawings are no signs

    lines = [shape for shape in shapes if shape.is_stroke and shape.style_a.stroke is not None]
    first, *between, last = (_loose_ends(lines, COPY, t) for t in LOOSE_TIMES)
    return min(max(*between, first, last) - max(first, last), MOST_LOOSE)


def _loose_ends(shapes: Sequence[ShapeBlend], copied: str, t: float) -> int:
    """Return how many ends of lines touch no other line at a time, but for ends of lines that are copied."""
    lines: list[tuple[ComplexArray, float]] = []
    ends: list[tuple[complex, ComplexArray, float, int]] = []
    for shape in shapes:
        own = min(max(shape.own_time(t), 0.0), 1.0)
        width = (1.0 - own) * shape.style_a.stroke_width + own * shape.style_b.stroke_width
        for path in paths_at(shape, t):
            points = _points(path.segments)
            along = np.append(0.0, np.cumsum(np.abs(np.diff(points))))
            if along[-1] <= TOUCHES * width:
                continue
            if not path.closed and abs(points[-1] - points[0]) > TOUCHES * width and shape.reason != copied:
                ends.append((points[0], points[along >= OWN * width], width, len(lines)))
                ends.append((points[-1], points[along <= along[-1] - OWN * width], width, len(lines)))
            lines.append((points, width))
    loose = 0
    for place, rest, width, number in ends:
        others = [line for k, line in enumerate(lines) if k != number]
        if len(rest) > 1:
            others.append((rest, width))
        point = np.array([place])
        loose += not any(are_near(point, line, TOUCHES * 0.5 * (width + wide))[0] for line, wide in others)
    return loose


def _areas(contour: ContourBlend) -> tuple[float, float]:
    """Return the areas that a contour encloses in A and in B."""
    first, last = (abs(cubics.signed_area(path.segments)) for path in (contour.start, contour.end))
    return first, last


def _lines_of(shapes: Shapes) -> Iterator[tuple[ShapeBlend, ContourBlend]]:
    """Yield the lines that become other lines, with their shapes, but for those that turn as they are."""
    for shape in shapes:
        if shape.is_stroke and shape.motion_name not in TURNING:
            yield from ((shape, contour) for contour in shape.contours if contour.is_matched)


def _are_rings(contour: ContourBlend) -> tuple[bool, bool]:
    """Return whether a contour is closed, and not pressed flat, in A and in B."""
    sizes = [Box.around(path.segments[:, 0]).larger_side for path in (contour.start, contour.end)]
    wide = [area > FLAT * size**2 for area, size in zip(_areas(contour), sizes, strict=True)]
    return contour.contour_a.closed and wide[0], contour.contour_b.closed and wide[1]


def _share_alone(shapes: Shapes) -> float:
    """Return the share of the lengths of the lines of both drawings that has no partner."""
    alone = whole = 0.0
    for contour in (contour for shape in shapes for contour in shape.contours):
        own = sum(length(_points(path.segments)) for path in (contour.start, contour.end))
        whole += own
        alone += 0.0 if contour.is_matched else own
    return alone / whole


def _bending(contour: ContourBlend, least: float) -> float:
    """Return the spread of the turns of a line's directions, in radians.

    It is 0 if an open line keeps its length, if it has one corner that turns over between straight legs, or if the
    changes from turn to turn are at most `least` in all.
    """
    ends = [_points(path.segments) for path in (contour.start, contour.end)]
    edges = [np.diff(points) for points in ends]
    lengths = [np.abs(each).sum() for each in edges]
    if not contour.start.closed and min(lengths) >= SAME_LENGTH * max(lengths):
        return 0.0
    seen = np.minimum(*map(np.abs, edges)) > 1e-9
    if not seen.any():
        return 0.0
    turns = np.unwrap(np.angle(edges[1][seen] / edges[0][seen]))
    steps = np.abs(np.diff(turns))
    if steps.sum() <= max(least, steps.max() + STRAIGHT):
        return 0.0
    weights = np.abs(edges[0][seen]) / lengths[0] + np.abs(edges[1][seen]) / lengths[1]
    mean = np.average(turns, weights=weights)
    return float(np.sqrt(np.average((turns - mean) ** 2, weights=weights)))


def _points(segments: ComplexArray) -> ComplexArray:
    """Return points along a path, `POINTS` for each of its (k, 4) segments, and its end."""
    return np.append(cubics.polyline(segments, POINTS), segments[-1, 3])
