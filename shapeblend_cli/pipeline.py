"""The stages in their order: place, flatten, pair, match, move, interpolate. Files are read before and written after.

Each stage is a function from values to values. Polygons are normalised, section 3.3, where their work is compared.
"""

from __future__ import annotations

from functools import partial
from pathlib import PurePath
from typing import TYPE_CHECKING, Any, NamedTuple

from shapeblend_cli.anatomy.decompose import PlacedContour, PlacedDrawing, decompose, main_orientation
from shapeblend_cli.anatomy.specks import without_specks
from shapeblend_cli.errors import InputError
from shapeblend_cli.frames.clipping import has_clips, with_clips
from shapeblend_cli.frames.fades import in_paint_order
from shapeblend_cli.frames.stagger import staggered
from shapeblend_cli.frames.views import view_of, views_with_room
from shapeblend_cli.geometry.placement import place_over
from shapeblend_cli.geometry.similarity import Similarity
from shapeblend_cli.interpolate.paths import with_curves
from shapeblend_cli.interpolate.stars import drawings_in
from shapeblend_cli.model import (
    Box,
    CubicPath,
    Drawing,
    Page,
    PaintedShape,
    Pair,
    ShapeBlend,
)
from shapeblend_cli.motion.alignment import Alignment, align, point_pairs, shared_alignments
from shapeblend_cli.motion.choose import (
    ASKED,
    LEADS,
    MANY,
    RIGHT,
    TINY,
    RotatedShape,
    best_motion,
    moved_as_asked,
    reason_to_be_straight,
    straight,
    turned,
)
from shapeblend_cli.motion.parts import parts_of, turn_of
from shapeblend_cli.motion.rotation import is_rotated_copy, rotation_between
from shapeblend_cli.motion.sweep import Sweep
from shapeblend_cli.options.settings import Settings
from shapeblend_cli.paint.names import with_names
from shapeblend_cli.paint.styles import painted_as
from shapeblend_cli.pairing.changes import changes
from shapeblend_cli.pairing.pair import pair_rotated_contours, rotated_back
from shapeblend_cli.pairing.reasons import reasons_for
from shapeblend_cli.pairing.required import constrain, point_pins, required_pairs
from shapeblend_cli.pairing.riders import riders_of_pairs
from shapeblend_cli.pairing.same import same_pairs
from shapeblend_cli.pairing.shapes import Match, shape_blends
from shapeblend_cli.system.clock import Clock
from shapeblend_cli.system.kept import Kept
from shapeblend_cli.wires.constraints import check_stiff
from shapeblend_cli.wires.contour_blends import match_contours
from shapeblend_cli.wires.direction import watch_part

if TYPE_CHECKING:
    from collections.abc import Callable, Hashable, Sequence

    from shapeblend_cli.anatomy.decompose import ContourPair
    from shapeblend_cli.model import ContourBlend, Place
    from shapeblend_cli.pairing.changes import Change
    from shapeblend_cli.pairing.required import ConstrainedPairs, NumbersOrNone
    from shapeblend_cli.wires.direction import Watch


AFFORDABLE_SEGMENTS = 2000
"""Once several motions have been tried on shapes of so many segments, further ones move straight. That takes
a few seconds; a drawing of hundreds of shapes would take minutes."""


AS_IT_IS = Similarity()

SMALL = 0.05
"""Shapes of less than this share of the largest one's size move straight: how they turn is hardly seen."""


def match_all(
    drawings: Sequence[Drawing],
    settings: Settings,
    clock: Clock | None = None,
    watch: Watch | None = None,
    kept: Kept | None = None,
) -> tuple[list[Pair], list[str]]:
    """Blend drawings, each with the next one, or to mix them with the first: everything up to the first frame.

    Parameters
    ----------
    drawings : sequence of Drawing
        Two or more; all are laid over the first.
    settings : Settings
    clock : Clock, optional
        Measures the stages `flatten`, `match` and `interpolate`.
    watch : callable, optional
        Called now and then with the share of the matching that is done, from 0 to 1.
    kept : Kept, optional
        Contours of drawings that were flattened before.

    Returns
    -------
    pairs : list of Pair
    notes : list of str
        What was left out, one phrase each.
    """
    clock, kept = clock or Clock(), kept or Kept(0)
    specks: list[str] = []
    if settings.specks is not None:
        found = [without_specks(drawing, settings.specks) for drawing in drawings]
        drawings, specks = [drawing for drawing, _ in found], [text for _, texts in found for text in texts]
    if settings.mix:
        drawings, settings = _mixed(drawings, settings)
    maps = place(drawings, settings.place)
    flat, notes = _flatten(drawings, maps, settings.vertices, kept)
    check_stiff([contour.polygon for contour in flat[0].contours], settings)
    drawn = [as_drawn(drawing, to_a) for drawing, to_a in zip(drawings, maps, strict=True)]
    views = _views(drawings, maps, drawn, settings)
    clock.lap("flatten")
    pairs = []
    is_star = len(flat) > 2 and bool(settings.mix)
    for k in range(1, len(flat)):
        i = 0 if is_star else k - 1
        view = Box.union([views[i], views[k]])
        progress = clock, watch_part(watch, k - 1, len(flat) - 1)
        shapes = _blend_shapes(flat[i], flat[k], settings, view, progress, kept.steps)
        pairs.append(Pair(i, k, shapes, drawn=(drawn[i], drawn[k]), views=(views[i], views[k])))
        clock.lap("interpolate")
    views = views_with_room(pairs, settings.viewbox)
    pages = _pages(drawings, maps, settings.place)
    pairs = [
        pair._replace(views=(views[pair.a], views[pair.b]), pages=(pages[pair.a], pages[pair.b]))
        for pair in pairs
    ]
    if not is_star:
        pairs = [_clipped(pair, settings) if has_clips(pair) else pair for pair in pairs]
    elif any(map(has_clips, pairs)):
        notes = [*notes, "clip paths are left out of mixtures and states; frames and animated SVGs have them"]
    if settings.stagger:
        pairs = [staggered(pair, settings.stagger, settings.stagger_by) for pair in pairs]
    return with_names(pairs, drawings), [*specks, *notes]


def place(drawings: Sequence[Drawing], place: str) -> list[Similarity]:
    """Return the maps that lay drawings over the first."""
    first, *others = drawings
    return [Similarity(), *(place_over(first, drawing, place) for drawing in others)]


def _flatten(
    drawings: Sequence[Drawing], maps: Sequence[Similarity], vertices: int, kept: Kept
) -> tuple[list[PlacedDrawing], list[str]]:
    """Decompose drawings into flattened contours, those of all oriented as in the first."""
    placed: list[PlacedDrawing] = []
    notes: list[str] = []
    orientation = None
    for drawing, to_a in zip(drawings, maps, strict=True):
        contours, left_out = _contours(drawing, to_a, vertices, orientation, kept)
        orientation = orientation or main_orientation([contour.polygon for contour in contours])
        placed.append(PlacedDrawing(drawing, to_a, contours))
        notes += left_out
    return placed, notes


def _contours(
    drawing: Drawing, to_a: Similarity, vertices: int, orientation: int | None, kept: Kept
) -> tuple[list[PlacedContour], list[str]]:
    """Decompose a drawing, unless that is kept."""
    # The number of a drawing is no other one's for as long as it is there, and it is kept with its contours.
    key = id(drawing), to_a, vertices, orientation
    found = kept.find(key)
    if found is None:
        found = drawing, decompose(drawing, to_a, vertices, orientation)
        size = sum(contour.segments.nbytes for shape in drawing.shapes for contour in shape.contours)
        kept.keep(key, found, size)
    contours: tuple[list[PlacedContour], list[str]] = found[1]
    return contours


def as_drawn(drawing: Drawing, to_a: Similarity = AS_IT_IS) -> tuple[PaintedShape, ...]:
    """Return what a drawing paints, laid over A. Shapes that have a clip in common still do."""
    clips = {
        id(clip): clip._replace(
            paths=tuple(CubicPath(to_a.points(c.segments), c.straight, c.closed) for c in clip.paths)
        )
        for shape in drawing.shapes
        for clip in shape.clips
    }
    return tuple(
        PaintedShape(
            tuple(CubicPath(to_a.points(c.segments), c.straight, c.closed) for c in shape.contours),
            to_a.style(shape.style),
            name=shape.name,
            groups=shape.groups,
            clips=tuple(clips[id(clip)] for clip in shape.clips),
        )
        for shape in drawing.shapes
    )


def _clipped(pair: Pair, settings: Settings) -> Pair:
    """Let the clips of a pair go along."""
    settings = settings.replace(**dict.fromkeys(("match", "pins", "start", "stiff", "mix", "specks")))

    def match(a: Drawing, b: Drawing) -> tuple[ShapeBlend, ...]:
        try:
            flat, _ = _flatten([a, b], [AS_IT_IS, AS_IT_IS], settings.vertices, Kept(0))
        except InputError:
            return ()
        view = Box.union(list(pair.views))
        return _blend_shapes(flat[0], flat[1], settings, view, (Clock(), None), Kept(0).steps)

    return with_clips(pair, match)


def _pages(drawings: Sequence[Drawing], maps: Sequence[Similarity], place: str) -> list[Page]:
    """Return the page of each drawing, laid over A; the first one's size if they are laid by their bounds."""
    pages = []
    for drawing, to_a in zip(drawings, maps, strict=True):
        own = drawing.page
        page = own._replace(box=own.box and to_a.box(own.box))
        if place == "bbox":
            page = drawings[0].page._replace(name=own.name)
        pages.append(page._replace(heading=PurePath(drawing.file).stem))
    return pages


def _views(
    drawings: Sequence[Drawing],
    maps: Sequence[Similarity],
    drawn: Sequence[tuple[PaintedShape, ...]],
    settings: Settings,
) -> list[Box]:
    """Return what to show of each drawing: its own viewBox, or the first one's if they are laid by their bounds."""
    viewboxes = [
        drawing.viewbox and to_a.box(drawing.viewbox) for drawing, to_a in zip(drawings, maps, strict=True)
    ]
    is_bbox = settings.place == "bbox"
    if is_bbox:
        viewboxes = [drawings[0].viewbox] * len(drawings)
    return [
        view_of(shapes, viewbox, settings.viewbox, own=k == 0 or not is_bbox)
        for k, (shapes, viewbox) in enumerate(zip(drawn, viewboxes, strict=True))
    ]


def _blend_shapes(
    a: PlacedDrawing,
    b: PlacedDrawing,
    settings: Settings,
    view: Box,
    progress: tuple[Clock, Watch | None],
    steps: Kept,
) -> tuple[ShapeBlend, ...]:
    """Pair the contours of two drawings, match them, and choose how their shapes move in a view."""
    clock, watch = progress
    rotation = 0.0
    if settings.motion != "linear":
        largest = [max(side.contours, key=lambda contour: contour.size) for side in (a, b)]
        rotation = rotation_between(*(contour.polygon for contour in largest)) or 0.0
    paired = _pair(a, b, settings, rotation, (clock, steps))
    shapes, places = _match(paired, watch)
    if rotation and not is_rotated_copy([contour for shape in shapes for contour in shape.contours]):
        paired = _pair(a, b, settings, 0.0, (clock, steps))
        shapes, places = _match(paired, watch)
    moved = in_paint_order(_explained(_move(paired, shapes, view), paired), places)
    clock.lap("interpolate")
    return moved


class _PairedDrawings(NamedTuple):
    """Two drawings whose contours are paired, B rotated back by an angle, and what matching them takes."""

    a: PlacedDrawing
    b: PlacedDrawing
    rotation: float
    pairs: ConstrainedPairs
    changes: Sequence[Change]
    riders: tuple[dict[int, int], dict[int, int]]
    required: Sequence[tuple[int, int]]
    settings: Settings
    clock: Clock
    steps: Kept

    @property
    def _of_wires(self) -> str:
        """The settings without those that name places: what these ask of two contours is in their constraints."""
        named = dict.fromkeys(("pins", "match", "start", "frames", "ends", "ease"))
        return repr(self.settings.replace(**named))

    def _once(self, key: Hashable, of: object, make: Callable[[], Any]) -> Any:
        """Return a step that is kept, or made now.

        Its key has numbers of objects, by ``id``: these are what it is made `of`, and are kept with it, so that the
        numbers are no other objects'.
        """
        found = self.steps.find(key)
        if found is None:
            found = of, make()
            self.steps.keep(key, found, size=0)
        return found[1]

    def leads(self, shape: ShapeBlend) -> bool:
        """Return whether strokes ride on a shape, which is why it moves straight as they do."""
        leaders = [set(side.values()) for side in self.riders]
        return any(contour.a in leaders[0] or contour.b in leaders[1] for contour in shape.contours)

    def match(self, numbers: NumbersOrNone, rotation: float, watch: Watch | None = None) -> Match:
        """Match the pair of contours with two numbers, B rotated back by an angle."""
        pair, constraints = self.pairs[numbers]
        required = constraints.start, tuple(constraints.pins)

        def solved() -> ContourBlend:
            blend = match_contours(*pair, self.settings, constraints, rotation, watch)
            return blend._replace(seconds=self.clock.lap("match"))

        key = "match", *map(id, pair), required, rotation, self._of_wires
        return Match(pair, self._once(key, pair, solved))

    def curved(self, shape: ShapeBlend) -> ShapeBlend:
        """Return a shape that moves between the drawings' own curves, unless polygons are asked for."""
        contours = shape.contours
        key = "curves", *map(id, contours), self.settings.curves
        curved = self._once(key, contours, lambda: _with_curves(shape, self.settings).contours)
        return shape._replace(contours=curved)

    def judged(
        self, shape: ShapeBlend, view: Box, common: Alignment | None, choose: Callable[[], ShapeBlend]
    ) -> ShapeBlend:
        """Return a shape that moves as was chosen, unless that is kept."""
        ids = tuple(map(id, shape.contours))
        key = "motion", ids, shape._replace(contours=()), view, common, self.rotation, self._of_wires
        return self._once(key, shape, choose)


def _pair(
    a: PlacedDrawing, b: PlacedDrawing, settings: Settings, rotation: float, by: tuple[Clock, Kept]
) -> _PairedDrawings:
    """Pair the contours of two drawings."""
    clock, steps = by
    pins = point_pins(a, b, settings)
    asked = required_pairs(a, b, settings) + [pin.pair for pin in pins]
    required = asked
    changed: Sequence[Change] = ()
    rest = a.contours, b.contours
    is_star = settings.mix and settings.motion == "linear" and settings.unmatched == "point"
    if not (rotation or is_star):
        changed = changes(*rest, settings)
        for change in changed:
            rest = change.without(rest[0], 0), change.without(rest[1], 1)
    pairs: Sequence[ContourPair] = ()
    if all(rest):
        if not rotation:
            required = asked + same_pairs(*rest, asked)
        boxes = Box.union([c.box for c in a.contours]), Box.union([c.box for c in b.contours])
        frames = boxes if changed else None
        pairs = pair_rotated_contours(*rest, settings, required, rotation, frames=frames)
    riders: tuple[dict[int, int], dict[int, int]] = {}, {}
    # Strokes that ride go at the time of what they ride on.
    if settings.motion in ("auto", "linear") and not rotation and not settings.stagger:
        riders = riders_of_pairs(rest, pairs, required)
    pairs = [
        pair for pair in pairs if not any(one.number in side for one, side in zip(pair, riders, strict=True))
    ]
    clock.lap("match")
    constrained = constrain(pairs, settings, pins)
    return _PairedDrawings(a, b, rotation, constrained, changed, riders, asked, settings, clock, steps)


def _match(paired: _PairedDrawings, watch: Watch | None) -> tuple[tuple[ShapeBlend, ...], list[Place]]:
    """Match all pairs, and put them together to shapes, with the contours that grow or shrink.

    Return them with their places in the order of paint.
    """
    count = len(paired.pairs)
    matches = [
        paired.match(numbers, paired.rotation, watch_part(watch, k, count))
        for k, numbers in enumerate(paired.pairs)
    ]
    shapes, places = shape_blends(
        paired.a.contours, paired.b.contours, matches, paired.changes, paired.riders
    )
    if paired.settings.motion == "auto":
        sweeps = {id(change.contours[0]): Sweep(change.windows) for change in paired.changes}
        shapes = tuple(shape._replace(motion=sweeps.get(id(shape.contours[0]))) for shape in shapes)
    styled = tuple(_in_style(shape, paired.settings.style) for shape in shapes)
    paired.clock.lap("match")
    return styled, places


def _match_again(paired: _PairedDrawings, shape: ShapeBlend, rotation: float) -> ShapeBlend:
    """Match the contours of a shape for another angle."""
    paired.clock.lap("interpolate")
    return shape._replace(
        contours=tuple(
            paired.match((contour.a, contour.b), rotation).blend if contour.is_matched else contour
            for contour in shape.contours
        )
    )


def _in_style(shape: ShapeBlend, style: str) -> ShapeBlend:
    """Paint a shape as the settings say; one without a partner keeps its own paint."""
    if not (any(c.a is not None for c in shape.contours) and any(c.b is not None for c in shape.contours)):
        return shape
    style_a, style_b = painted_as(shape.style_a, shape.style_b, style)
    return shape._replace(style_a=style_a, style_b=style_b)


def _move(paired: _PairedDrawings, shapes: Sequence[ShapeBlend], view: Box) -> tuple[ShapeBlend, ...]:
    """Choose how shapes move: as is asked for, or as the judge has it."""
    settings = paired.settings
    shared: Sequence[Alignment | None] = [None] * len(shapes)
    if paired.rotation:
        shared = [align(point_pairs([contour for shape in shapes for contour in shape.contours]))] * len(
            shapes
        )
    elif settings.motion != "linear" and len(shapes) > 1:
        shared = shared_alignments(shapes)
    moved: dict[int, ShapeBlend] = {}
    affordable = AFFORDABLE_SEGMENTS
    largest = max((shape.size for shape in shapes), default=0.0)
    # The largest first, as what is wrong with them is seen most.
    for k in sorted(range(len(shapes)), key=lambda k: -shapes[k].size):
        matched = shapes[k]
        shape = paired.curved(matched)
        if reason := reason_to_be_straight(shape):
            moved[k] = shape._replace(reason=reason)
        elif settings.motion == "linear":
            moved[k] = shape._replace(reason=ASKED)
        elif settings.motion != "auto":
            moved[k] = moved_as_asked(shape, settings.motion, _rotated(paired, matched, shape, shared[k]))
        elif paired.rotation:
            moved[k] = turned(_rotated(paired, matched, shape, shared[k]))
        elif paired.leads(shape):
            moved[k] = shape._replace(reason=LEADS)
        elif shape.size < SMALL * largest:
            moved[k] = shape._replace(reason=TINY)
        elif affordable <= 0:
            moved[k] = shape._replace(reason=MANY)
        else:
            affordable -= sum(len(contour.start.segments) for contour in shape.contours)
            moved[k] = paired.judged(
                shape, view, shared[k], partial(_best, paired, matched, shape, view, shared[k])
            )
    return tuple(moved[k] for k in range(len(shapes)))


def _best(
    paired: _PairedDrawings, matched: ShapeBlend, shape: ShapeBlend, view: Box, common: Alignment | None
) -> ShapeBlend:
    """Return a shape that moves straight, or as the judge has it where that looks wrong."""
    shape = straight(shape, view)
    if shape.candidates[0].wrong <= RIGHT:
        return shape
    return best_motion(shape, _rotated(paired, matched, shape, common), view)


def _rotated(
    paired: _PairedDrawings, matched: ShapeBlend, shape: ShapeBlend, common: Alignment | None
) -> RotatedShape:
    """Return a shape with B rotated back, if its largest contour is A's rotated, and what its motion separates."""
    if paired.rotation:
        assert common is not None, "what is rotated is aligned"
        return RotatedShape(shape, common)
    again, alignment = _rotate_back(paired, matched, common)
    if again is not matched and is_rotated_copy(again.contours):
        return RotatedShape(_with_curves(again, paired.settings), alignment)
    turning = _turn_parts(paired, matched, alignment)
    return RotatedShape(
        shape if again is matched else _with_curves(again, paired.settings),
        alignment,
        turning and (_with_curves(turning[0], paired.settings), turning[1]),
    )


def _turn_parts(
    paired: _PairedDrawings, shape: ShapeBlend, alignment: Alignment
) -> tuple[ShapeBlend, tuple[Alignment, ...]] | None:
    """Match parts of a shape again that are A's rotated; return it with the similarity of each contour.

    That of other parts is given. None without such parts.
    """
    contours = list(shape.contours)
    alignments = [alignment] * len(contours)
    parts = parts_of(contours) if len(contours) > 1 else []
    middle = Box.union([contour.polygon_a.box for contour in contours]).centre
    turns = False
    for numbers in parts if len(parts) > 1 else ():
        part = shape._replace(contours=tuple(contours[k] for k in numbers))
        rotation = _rotation_of(part)
        if rotation is None:
            continue
        part = _match_again(paired, part, rotation)
        if is_rotated_copy(part.contours):
            turns = True
            turn = turn_of(part.contours, middle)
            for k, contour in zip(numbers, part.contours, strict=True):
                contours[k], alignments[k] = contour, turn
    return (shape._replace(contours=tuple(contours)), tuple(alignments)) if turns else None


def _rotate_back(
    paired: _PairedDrawings, shape: ShapeBlend, common: Alignment | None
) -> tuple[ShapeBlend, Alignment]:
    """Align a shape; match it again first, with B rotated back, if its largest contour is A's rotated.

    Points that travel cost work, so the first match does not show that.
    """
    rotation = _rotation_of(shape)
    if rotation is not None:
        shape = _match_again(paired, shape, rotation)
    elif common is not None:
        return shape, common
    return shape, align(point_pairs(shape.contours))


def _rotation_of(shape: ShapeBlend) -> float | None:
    """Return the angle by which the largest contour of B is A's rotated, None if it is not."""
    matched = [contour for contour in shape.contours if contour.is_matched]
    if not matched:
        return None
    largest = max(matched, key=lambda contour: contour.scale_a)
    return rotation_between(largest.polygon_a, largest.polygon_b)


def _explained(shapes: Sequence[ShapeBlend], paired: _PairedDrawings) -> tuple[ShapeBlend, ...]:
    """Say of each contour why it has its partner, or none, and what it lies in."""
    pairs = [pair for pair, _ in paired.pairs.values()]
    a, b = paired.a.contours, paired.b.contours
    if paired.rotation:
        b = rotated_back(a, b, paired.rotation)
    reasons = reasons_for(a, b, pairs, paired.required, paired.riders)
    return tuple(shape._replace(contours=tuple(map(reasons.added_to, shape.contours))) for shape in shapes)


def _with_curves(shape: ShapeBlend, settings: Settings) -> ShapeBlend:
    """Return a shape that moves between the drawings' own curves, unless polygons are asked for."""
    if not settings.curves:
        return shape
    return shape._replace(contours=tuple(map(with_curves, shape.contours)))


def _mixed(drawings: Sequence[Drawing], settings: Settings) -> tuple[list[Drawing], Settings]:
    """Return the drawings that are in some mixture, and settings for these.

    Two are blended as ever. More go straight, since what turns between two drawings turns otherwise between others, and
    each outline stays whole.
    """
    used = drawings_in(settings.mix)
    if len(used) > 2:
        settings = settings.replace(motion="linear", unmatched="point")
    return [drawings[k] for k in used], settings
