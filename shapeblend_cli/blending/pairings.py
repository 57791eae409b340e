"""Other pairings of the contours of two drawings with parts of several colours, where the judge prefers them.

The ordinary costs pair as much as they can, and in such drawings that may be too much: a heart that comes loose becomes
a brow. Or they go by place where the paint tells what is what: the back of a folder becomes its front. Whether a pair
reads as a change or as a mistake is seen only in the picture.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.anatomy.decompose import EXTERIOR
from shapeblend_cli.blending.graded import BETTER, FINE, faults_of
from shapeblend_cli.blending.matched import pair_drawings
from shapeblend_cli.geometry.grouping import assign
from shapeblend_cli.model import Box
from shapeblend_cli.paint.oklab import difference, lightness
from shapeblend_cli.pairing.costs import ALONE_COST, PAINT_WEIGHT, FoundWorks, Rates
from shapeblend_cli.pairing.riders import riders

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from shapeblend_cli.anatomy.decompose import PlacedContour
    from shapeblend_cli.blending.matched import PairedDrawings
    from shapeblend_cli.model import ComplexArray, ContourBlend, ShapeBlend, Shapes
    from shapeblend_cli.model.style import Paint

STRICTER = (Rates(paint=1.5 * PAINT_WEIGHT), Rates(alone=ALONE_COST - 0.13), Rates(alone=ALONE_COST - 0.23))
"""Costs of pairings that are tried: another colour counts more, or it costs less to have no partner."""

MOST_ALIKE = 4
"""Maximum number of parts of one paint in each drawing that are paired with each other."""

LEAST_SIZE = 1 / 3
"""Minimum ratio of the sizes of such parts."""

PREFERRED = 0.05
"""Minimum advantage of a pairing that is tried for it to be taken, in faults."""

FORGIVEN = 0.1
"""Maximum disadvantage of the pairing that leaves somewhat more parts alone for it to be taken, in faults: they are
gone early, which the judge does not see, for which they shrink all of the time."""

STRAYS_FORGIVEN = 0.3
"""Maximum disadvantage of the pairing without strays for it to be taken, in faults: the judge does not see what becomes
what, and 24 such pairs looked better to designers, who saw them beside the others, in 14 cases, and worse in one."""

LEAST_STRAY = 0.08
"""Minimum size of a part that strays, as a share of the view's side: smaller ones are hardly seen."""

MOST_STRAY = 0.6
"""Maximum size of a part that strays to where no part of it was, in sizes of the largest one with a partner."""

LIGHTNESS = 0.5
"""Weight of lightness in the colours of a part that strays: what gets darker may still be the same."""

DARK = 0.4
"""Maximum lightness of colours that are all as good as black: eyes stay eyes."""

OTHER = 0.2
"""Minimum difference of the colours of a part that strays to where no part of it was."""

SHADE = 0.15
"""Minimum difference of the colours of a part that strays far."""

UNLIKE = 0.6
"""Minimum difference of the colours of a part that strays in its place, in delta E OK."""

BENT = 0.08
"""Minimum fault of the outlines of a part that becomes another in its place, or near it: noses differ in colour."""

TORN = 0.15
"""Minimum fault of the outlines of a part that strays far to become another of about its colour."""

NEAR = 0.9
"""Maximum distance that a part goes that stays near its place, in sizes of it."""

FAR = 1.0
"""Minimum distance that a part goes that strays far, in sizes of it."""

FARTHEST = 3.0
"""Minimum distance that it goes if it keeps its colour, in sizes of it: eyes do not stay in their places."""

ALIKE = 0.05
"""Maximum difference of colours that are the same, in delta E OK."""

AFFORDABLE = 80
"""Maximum number of contours of a drawing of which other pairings are tried."""


def with_better_pairs(
    paired: PairedDrawings,
    usual: Shapes,
    move: Callable[[PairedDrawings], Shapes],
    view: Box,
    works: FoundWorks,
) -> tuple[PairedDrawings, Shapes]:
    """Return paired drawings and their blend, or those of another pairing that the judge prefers in a view.

    `move` blends paired drawings, and `works` are those that the ordinary pairing has found.
    """
    if not _has_others(paired):
        return paired, usual
    best = faults_of(usual, view)
    if best <= FINE:
        return paired, usual
    found = paired, usual
    seen = [_partners_in(paired)]
    for other, gain in _others(paired, works):
        if _partners_in(other) not in seen:
            seen.append(_partners_in(other))
            shapes = move(other)
            faults = faults_of(shapes, view) + gain
            if faults < best:
                best, found = faults, (other, shapes)
    other = _without_torn_lines(found[0])
    if _partners_in(other) not in seen:
        shapes = move(other)
        faults = faults_of(shapes, view)
        if faults < best - PREFERRED:
            best, found = faults, (other, shapes)
    other = _without_strays(*found, view.larger_side)
    if other is found[0]:
        return found
    shapes = move(other)
    return (other, shapes) if faults_of(shapes, view) < best + STRAYS_FORGIVEN else found


def _others(paired: PairedDrawings, works: FoundWorks) -> Iterator[tuple[PairedDrawings, float]]:
    """Yield other pairings with what they have to gain to be taken, in faults; less than 0 if they may lose."""
    a, b, settings, progress = paired.a, paired.b, paired.settings, paired.progress
    for rates, gain in zip(STRICTER, (PREFERRED, -FORGIVEN, PREFERRED), strict=True):
        yield pair_drawings(a, b, settings, 0.0, progress, rates=rates._replace(works=works)), gain
    alike = _alike(paired)
    if alike:
        other = pair_drawings(a, b, settings, 0.0, progress, wanted=alike, rates=Rates(works=works))
        yield other, BETTER


def _alike(paired: PairedDrawings) -> list[tuple[int, int]]:
    """Return the parts of each paint that both drawings have equally often, the nearest ones by numbers.

    Places are relative to the drawings. Paints whose parts are all paired with each other are left out.
    """
    sides = paired.a.contours, paired.b.contours
    kinds_a, kinds_b = map(_by_paint, sides)
    frames = [Box.union([contour.box for contour in side]) for side in sides]
    partner = {i: j for i, j in paired.pairs}
    found = []
    for paint in kinds_a.keys() & kinds_b.keys():
        p, q = kinds_a[paint], kinds_b[paint]
        if len(p) != len(q) or len(p) > MOST_ALIKE:
            continue
        there = {contour.number for contour in q}
        if all(partner.get(contour.number) in there for contour in p):
            continue
        places = [_places(side, frame) for side, frame in zip((p, q), frames, strict=True)]
        for i, j in assign(np.abs(places[0][:, None] - places[1])):
            sizes = p[i].size, q[j].size
            if min(sizes) >= LEAST_SIZE * max(sizes):
                found.append((p[i].number, q[j].number))
    return sorted(found)


def _without_torn_lines(paired: PairedDrawings) -> PairedDrawings:
    """Leave strokes on the edges of fills that have no partner without one, too: both then move as one."""
    torn = []
    for side, contours in enumerate((paired.a.contours, paired.b.contours)):
        known = {numbers[side] for numbers in paired.pairs}
        alone = {c.number for c in contours if c.role == EXTERIOR and c.style.fill is not None} - known
        torn.append(riders(contours, alone))
    return paired.without(
        [
            numbers
            for numbers in paired.pairs
            if any(number in lines for number, lines in zip(numbers, torn, strict=True))
        ]
    )


def _without_strays(paired: PairedDrawings, shapes: Shapes, side: float) -> PairedDrawings:
    """Leave parts without their partners that lie elsewhere and are unlike these; in a view of a side."""
    main = max((shape.size for shape in shapes if shape.is_matched), default=0.0)
    strays = {
        contour.numbers
        for shape in shapes
        if LEAST_STRAY * side <= shape.size < main
        for contour in shape.contours
        if contour.is_matched and _is_stray(shape, contour, shape.size / main)
    }
    if not strays & paired.pairs.keys():
        return paired
    return _without_torn_lines(paired.without(strays))


def _is_stray(shape: ShapeBlend, contour: ContourBlend, size: float) -> bool:
    """Return whether a contour becomes something else: of another colour elsewhere, or far away of another form.

    The size is that of the shape, in sizes of the largest one.
    """
    first, last = shape.style_a.fill, shape.style_b.fill
    if first is None or last is None:
        return False
    here, there = contour.polygon_a.box, contour.polygon_b.box
    apart = difference(first, last)
    wrong = shape.taken.wrong if shape.taken is not None else 0.0
    if here.overlaps(there):
        return apart > UNLIKE and wrong > BENT
    if size > MOST_STRAY:
        return False
    are_dark = max(lightness(first), lightness(last)) <= DARK
    other = 0.0 if are_dark else difference(first, last, LIGHTNESS)
    way = abs(here.centre - there.centre) / max(here.larger_side, there.larger_side)
    is_torn = wrong > TORN and way > (FAR if apart > ALIKE else FARTHEST)
    is_other = other > OTHER and (way > NEAR or wrong > BENT)
    return is_torn or is_other or (other > SHADE and way > FAR)


def _partners_in(paired: PairedDrawings) -> set[tuple[int | None, int | None, bool]]:
    """Return the numbers of partners, and whether one of them is a piece."""
    return {(*numbers, any(one.is_piece for one in pair)) for numbers, (pair, _) in paired.pairs.items()}


def _has_others(paired: PairedDrawings) -> bool:
    """Return whether other pairings may be tried: where pairs are free, and not all parts are painted alike."""
    sides = paired.a.contours, paired.b.contours
    if paired.is_fixed or paired.settings.unmatched != "auto" or max(map(len, sides)) > AFFORDABLE:
        return False
    return all(len({contour.style.paints for contour in side}) > 1 for side in sides)


def _by_paint(contours: Sequence[PlacedContour]) -> dict[Paint, list[PlacedContour]]:
    """Return the exteriors with a plain fill and no stroke, by their paint."""
    found: dict[Paint, list[PlacedContour]] = {}
    for contour in contours:
        style = contour.style
        if contour.role == EXTERIOR and style.stroke is None and style.fill_gradient is None:
            found.setdefault(style.paints[0], []).append(contour)
    return found


def _places(contours: Sequence[PlacedContour], frame: Box) -> ComplexArray:
    """Return the middles of contours in a frame, whose sides are 1."""
    away = np.array([contour.box.centre for contour in contours]) - complex(frame.x, frame.y)
    return away.real / (frame.width or 1.0) + 1j * away.imag / (frame.height or 1.0)
