"""Two drawings become shapes that move: pair, match, move."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, NamedTuple

from shapeblend_cli.anatomy.decompose import EXTERIOR
from shapeblend_cli.anatomy.letters import has_letters
from shapeblend_cli.blending.graded import BETTER, FINE, faults_of, grade_of_shapes, in_full_width
from shapeblend_cli.blending.matched import match_pairs, pair_drawings, with_reasons
from shapeblend_cli.blending.moved import move_shapes
from shapeblend_cli.blending.pairings import with_better_pairs
from shapeblend_cli.blending.parts.alone import carried_by_lines
from shapeblend_cli.blending.parts.paced import with_parts_paced
from shapeblend_cli.blending.plates.gaps import with_gaps_closed
from shapeblend_cli.blending.plates.inlays import plates_of, with_inlays, without_inlays
from shapeblend_cli.blending.plates.plain import is_plain
from shapeblend_cli.blending.plates.slots import with_slots_closed
from shapeblend_cli.blending.strokes.brushed import with_brushes
from shapeblend_cli.blending.strokes.expanded import all_outlines, with_outlines
from shapeblend_cli.blending.strokes.loose import loose_lines
from shapeblend_cli.blending.swaps.swapped import ASKED, is_swapped, swapped
from shapeblend_cli.blending.swaps.unlike import (
    ALL,
    are_too_unlike,
    ink_in_common,
    ink_of,
    is_hopeless,
)
from shapeblend_cli.blending.turned_drawings import turned_as_a_whole, turns_what_stays
from shapeblend_cli.blending.uncrossed import with_crossings_undone
from shapeblend_cli.frames.fades import in_paint_order
from shapeblend_cli.model import Box
from shapeblend_cli.motion.rotation import is_rotated_copy, rotation_between
from shapeblend_cli.pairing.changes import are_painted_alike, crossed_out
from shapeblend_cli.pairing.costs import FoundWorks, Rates
from shapeblend_cli.pens.drawings import MOST_LINES, enough_lines, pen_drawing
from shapeblend_cli.pens.line import UNITS
from shapeblend_cli.pens.named_lines import wants_lines

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from shapeblend_cli.anatomy.decompose import PlacedDrawing
    from shapeblend_cli.blending.matched import PairedDrawings, Progress
    from shapeblend_cli.model import Pair, Place, ShapeBlend, Shapes
    from shapeblend_cli.options.settings import Settings
    from shapeblend_cli.pens.line import PenDrawing
    from shapeblend_cli.pens.line_blends import LineBlend

MARGIN = 0.8
"""Minimum advantage of outlines over lines in a drawing that is partly drawn with a pen, in faults."""

FAILS = 1.45
"""Minimum sum of the faults of a blend by lines that is likely to be sent back."""

SHIPS = 1.2
"""Maximum sum of the faults of a blend by outlines that is not sent back."""

LESS = 0.4
"""Minimum advantage of outlines that are not sent back over such lines, in faults."""

CLEAR = 1.1
"""Maximum grade of a blend by outlines of drawings that would be swapped if they were blended by their lines."""

IN_COMMON = 0.15
"""Minimum share of the ink of two drawings of lines that both have for them to be blended by outlines, too."""

LEAST_KEPT = 0.42
"""Minimum share of the lines of the drawing with more of them that stays for the drawings never to be swapped."""

AWAY = 0.02
"""Maximum distance between the sides of the boxes around a drawing and the same one filled, as a share of the view's
larger side."""

MOST_STEPS = 1000
"""Maximum number of steps of a blend that are kept for the others that are tried: many pairs and matches are the
same."""


class _Asked(NamedTuple):
    """Two drawings to be blended in a view, and how."""

    a: PlacedDrawing
    b: PlacedDrawing
    settings: Settings
    view: Box
    progress: Progress

    @property
    def drawn(self) -> tuple[PlacedDrawing, PlacedDrawing, Settings, Box]:
        """Both drawings, the settings and the view."""
        return self.a, self.b, self.settings, self.view


def blend_shapes(
    a: PlacedDrawing, b: PlacedDrawing, settings: Settings, view: Box, progress: Progress
) -> Shapes:
    """Pair the contours of two drawings, match them, and choose how their shapes move in a view.

    Drawings that are mostly drawn with a pen are blended by their lines, above the rest. A drawing that is the other
    one turned, or its mirror image, may turn as a whole.
    """
    if settings.swap == "always" and not (settings.mix or settings.has_spans):
        return swapped(a, b, settings, view, ASKED)
    asked = _Asked(a, b, settings, view, progress)
    is_named = bool(settings.match or settings.pins or settings.stiff)
    pens = _pens(asked)
    lines = _lines(asked, pens) if is_named else None
    rotation = 0.0
    if settings.motion != "linear" and lines is None:
        largest = [max(side.contours, key=lambda contour: contour.size).polygon for side in (a, b)]
        rotation = progress.once("rotation", largest, (), partial(rotation_between, *largest)) or 0.0
    if rotation:
        paired = pair_drawings(a, b, settings, rotation, progress)
        shapes, places = match_pairs(paired)
        contours = [contour for shape in shapes for contour in shape.contours]
        if is_rotated_copy(contours) and not turns_what_stays(a, b, contours):
            return _moved(paired, shapes, places, view)
    may_cross_out = settings.strokes != "recover" and not settings.is_star
    for outlined in _in_outlines(asked, pens) if may_cross_out else ():
        if crossed := crossed_out(*outlined, settings):
            paired = pair_drawings(*outlined, settings, 0.0, progress, crossed)
            return _blended(paired, view)
    if not is_named:
        lines = _lines(asked, pens)
    progress.clock.lap("match")

    if settings.is_free:
        progress = progress.keeping(MOST_STEPS)
        asked = asked._replace(progress=progress)
    may_swap = settings.swap == "auto" and settings.is_free and not is_named
    may_swap = may_swap and (lines is None or lines.kept_of_longer < LEAST_KEPT)

    def swap(shapes: Shapes) -> Shapes:
        if may_swap and pens and not is_swapped(shapes) and are_too_unlike(a, b, shapes, pens, view):
            return swapped(a, b, settings, view)
        return shapes

    def usual() -> Shapes:
        return _by_lines_or_outlines(asked, pens, lines, swap)

    is_all_lines = lines is not None and lines.is_sure and not any(lines.rest)
    if is_named or not settings.is_free or is_all_lines:
        return usual()

    def straight(a: PlacedDrawing, b: PlacedDrawing) -> Shapes:
        linear = settings.replace(motion="linear")
        paired = pair_drawings(*with_outlines(a, b, linear, view), linear, 0.0, progress)
        return _blended(paired, view)

    shapes = turned_as_a_whole(a, b, view, usual, straight)
    # Who says that drawings stay where they lie wants to see them go from one place to the other.
    may_fill = settings.swap == "auto" and settings.place != "asis" and not all(map(has_letters, (a, b)))
    return _finished(asked, shapes, may_swap=may_swap and may_fill, may_fill=may_fill)


def _finished(asked: _Asked, usual: Shapes, *, may_swap: bool, may_fill: bool) -> Shapes:
    """Return the usual blend of two drawings, or what looks better: a special one, a swap, a level, or no crossings."""
    settings, view = asked.settings, asked.view
    a, b = with_outlines(*asked.drawn)
    if are_plain := is_plain(a) and is_plain(b):
        special = with_gaps_closed(a, b, settings, view, usual)
        special = with_slots_closed(a, b, view, special)
        special = with_brushes(a, b, settings, view, special)
        if special is not usual:
            return _exchanged(asked, special) if may_swap else special
        shapes = usual
    else:
        from shapeblend_cli.blending.parts.faded import with_details_faded  # icons mostly have one colour

        shapes = with_details_faded(usual, view.larger_side)
    if may_swap:
        shapes = _exchanged(asked, shapes)
    if are_plain and shapes is usual:
        pair = partial(_paired, a, b, settings, asked.progress)
        shapes = with_crossings_undone(usual, pair, partial(_blended_and_paced, view=view), view)
        # Without crossings, too, it may be beyond hope.
        if may_swap and shapes is not usual:
            shapes = _exchanged(asked, shapes)
    if may_fill and _are_as_large(asked):
        from shapeblend_cli.blending.swaps.filled import filled  # few drawings come so far

        return filled(asked.a, asked.b, shapes, view, curves=settings.curves)
    return shapes


def _are_as_large(asked: _Asked) -> bool:
    """Return whether the boxes around both drawings are one, nearly."""
    a, b = (Box.union([c.box.expanded(c.style.reach) for c in side.contours]) for side in asked[:2])
    return a.sides_apart(b) <= AWAY * asked.view.larger_side


def _exchanged(asked: _Asked, shapes: Shapes) -> Shapes:
    """Return a blend, or if it looks bad one in which the drawings take each other's place."""
    a, b, settings, view, progress = asked
    if not is_hopeless(shapes, view):
        return shapes
    from shapeblend_cli.blending.swaps.reshaped import reshaped  # few blends come so far

    def blend(a: PlacedDrawing, b: PlacedDrawing) -> Shapes:
        return _blended(pair_drawings(a, b, settings, 0.0, progress, wanted=[(0, 0)]), view)

    found = reshaped(a, b, ink_of(shapes, view), view, blend, curves=settings.curves)
    return found or swapped(a, b, settings, view)


def _in_outlines(
    asked: _Asked, pens: tuple[PenDrawing, PenDrawing] | None
) -> Iterator[tuple[PlacedDrawing, PlacedDrawing]]:
    """Yield two drawings as they are, and with strokes as outlines if one of these may cross fills out."""
    yield asked.a, asked.b
    if pens is None or not any(pen.bodies for pen in pens):
        return
    if any(line.is_slash for pen in pens for line in pen.lines):
        outlined = all_outlines(*asked.drawn)
        if outlined is not None:
            yield outlined


def _by_lines_or_outlines(
    asked: _Asked,
    pens: tuple[PenDrawing, PenDrawing] | None,
    lines: LineBlend | None,
    swap: Callable[[Shapes], Shapes],
) -> Shapes:
    """Blend two drawings by their pen lines and what is beside these, or by all outlines if that looks better.

    `swap` returns a blend, or if the drawings are too unlike, one in which they take each other's place.
    """
    view = asked.view
    is_sign = asked.settings.is_free and pens is not None and max(pen.share for pen in pens) >= ALL

    def paced(shapes: Shapes, kept: float = 1.0, *, by_size: bool = True) -> Shapes:
        if not asked.settings.is_free:
            return shapes
        return with_parts_paced(shapes, view.larger_side, kept if is_sign else None, by_size=by_size)

    if lines is None:
        return swap(paced(_by_outlines(asked)))
    a, b = (side._replace(contours=left) for side, left in zip(asked[:2], lines.rest, strict=True))
    is_all = not any(lines.rest)
    solid = () if is_all else _by_outlines(asked._replace(a=a, b=b, settings=lines.settings))

    def together(by_size: bool) -> Shapes:
        shapes = (*paced(solid, lines.kept_of_shorter, by_size=by_size), *lines.shapes)
        return carried_by_lines(shapes) if asked.settings.is_free else shapes

    if lines.is_sure:
        lined = together(by_size=True)
        shapes = swap(lined)
        if is_swapped(shapes) and ink_in_common(lined, view) >= IN_COMMON:
            outlines = paced(_by_outlines(asked))
            return outlines if grade_of_shapes(outlines, view) < CLEAR else shapes
        return shapes
    # Parts that are gone early would hide from the judge what becomes of them.
    plain = together(by_size=False)
    faults = faults_of(in_full_width(plain), view)
    outlines = _by_outlines(asked)
    other = faults_of(paced(outlines, by_size=False), view)
    if other < faults - (LESS if faults >= FAILS and other < SHIPS else MARGIN):
        return swap(paced(outlines))
    given_way = swap(plain)
    shapes = given_way if is_swapped(given_way) else swap(together(by_size=True))
    if is_swapped(shapes) or is_hopeless(shapes, view):
        outlines = paced(outlines)
        return outlines if grade_of_shapes(outlines, view) < CLEAR else shapes
    return shapes


def _by_outlines(asked: _Asked) -> Shapes:
    """Blend two drawings by their outlines, of which some may be cut, and by the lines that are cut out of plates."""
    a, b, settings, view, progress = asked
    move = partial(_blended, view=view)
    plates = plates_of(*asked.drawn) if wants_lines(settings) else []
    if plates:
        solid = [without_inlays(drawing, plates, side) for side, drawing in enumerate((a, b))]
        paired = pair_drawings(solid[0], solid[1], settings, 0.0, progress)
        inlaid = with_inlays(move(paired), plates, view)
        if inlaid is not None:
            return tuple(inlaid)
    sides = with_outlines(*asked.drawn)
    works = _works(*sides, progress)
    paired = _paired(*sides, settings, progress)
    shapes = move(paired)
    if not settings.is_free:
        return shapes
    paired, shapes = with_better_pairs(paired, shapes, move, view, works)
    return _with_bodies(paired, shapes, view)


def _paired(a: PlacedDrawing, b: PlacedDrawing, settings: Settings, progress: Progress) -> PairedDrawings:
    """Pair the contours of two drawings as usual, if that is not done yet."""
    contours = [*a.contours, *b.contours]

    def pair() -> PairedDrawings:
        return pair_drawings(a, b, settings, 0.0, progress, rates=Rates(works=_works(a, b, progress)))

    given = len(a.contours), repr(settings)
    return progress.once("pairs", contours, given, pair)._replace(progress=progress)


def _works(a: PlacedDrawing, b: PlacedDrawing, progress: Progress) -> FoundWorks:
    """Return what pairings of two drawings have found of the costs of work so far."""
    return progress.once("works", [*a.contours, *b.contours], len(a.contours), lambda: FoundWorks({}, {}))


def _with_bodies(paired: PairedDrawings, usual: Shapes, view: Box) -> Shapes:
    """Return the blend in which the largest fill of A becomes that of B, if that looks better.

    That is asked if either had no partner, and both have about one colour.
    """
    a, b, settings, progress = paired.a, paired.b, paired.settings, paired.progress
    if paired.is_fixed:
        return usual
    fills = [[c for c in side.contours if c.role == EXTERIOR and c.style.fill is not None] for side in (a, b)]
    if not all(fills):
        return usual
    largest = [max(side, key=lambda contour: contour.area) for side in fills]
    numbers = largest[0].number, largest[1].number
    known = {i for i, _ in paired.pairs}, {j for _, j in paired.pairs}
    are_paired = all(number in side for number, side in zip(numbers, known, strict=True))
    if are_paired or not are_painted_alike(largest[0].style, largest[1].style):
        return usual
    faults = faults_of(usual, view)
    if faults <= FINE:
        return usual
    rates = Rates(works=_works(a, b, progress))
    other = pair_drawings(a, b, settings, 0.0, progress, wanted=[numbers], rates=rates)
    shapes = _blended(other, view)
    return shapes if faults_of(shapes, view) < faults - BETTER else usual


def _pens(asked: _Asked) -> tuple[PenDrawing, PenDrawing] | None:
    """Return two drawings as pen lines, if they may be blended by these and there are any."""
    if not wants_lines(asked.settings):
        return None
    scale = UNITS / asked.view.larger_side
    pens = tuple(
        asked.progress.once_for("pens", side, scale, partial(pen_drawing, side, scale, MOST_LINES))
        for side in asked[:2]
    )
    return (pens[0], pens[1]) if any(pen.lines for pen in pens) else None


def _lines(asked: _Asked, pens: tuple[PenDrawing, PenDrawing] | None) -> LineBlend | None:
    """Return how the pen lines of two drawings become each other, if they are blended by these."""
    if pens is None:
        return None
    a, b, settings, view, _ = asked
    scale, is_asked = UNITS / view.larger_side, settings.strokes == "recover"
    enough = enough_lines(a, b, pens, scale, is_asked=is_asked)
    if enough is None:
        return None
    from shapeblend_cli.pens.line_blends import blend_lines  # many drawings have few lines

    return blend_lines(a, b, enough, settings, scale)


def with_lines_in_common(pairs: Sequence[Pair], a: PlacedDrawing) -> list[Pair] | None:
    """Give all pairs of a drawing with others the same paths for its pen lines; None if that cannot be."""
    from shapeblend_cli.blending.strokes.several import with_common_lines  # most runs make no mixtures

    scale = UNITS / Box.union(list(pairs[0].views)).larger_side
    free = 1 + max(contour.number for contour in a.contours)
    return with_common_lines(pairs, pen_drawing(a, scale).lines, scale, free)


def _blended(paired: PairedDrawings, view: Box) -> Shapes:
    """Return paired drawings as shapes that are matched, and move."""
    return _moved(paired, *match_pairs(paired), view)


def _blended_and_paced(paired: PairedDrawings, view: Box) -> Shapes:
    """Return paired drawings as shapes that are matched and move, those without a partner early or late."""
    return with_parts_paced(_blended(paired, view), view.larger_side, None, by_size=True)


def _moved(paired: PairedDrawings, shapes: Shapes, places: list[Place], view: Box) -> Shapes:
    """Return matched shapes that move, in the order of paint."""
    moving: Sequence[ShapeBlend] = with_reasons(move_shapes(paired, shapes, view), paired)
    scale = UNITS / view.larger_side
    if loose := loose_lines(paired, moving, scale):
        from shapeblend_cli.blending.strokes.drawn import with_drawn_strokes  # few drawings have such lines

        moving, places = with_drawn_strokes(moving, places, loose, paired.settings.constants, scale)
    return in_paint_order(moving, places)
