"""The contours of two drawings: their pairs, and the match of each pair."""

from __future__ import annotations

from functools import lru_cache, partial
from typing import TYPE_CHECKING, NamedTuple, TypeVar

from shapeblend_cli.anatomy.decompose import PlacedDrawing
from shapeblend_cli.blending.copies import MATCHED_ONE_BY_ONE, Copies
from shapeblend_cli.interpolate.paths import with_curves
from shapeblend_cli.model import Box, ShapeBlend
from shapeblend_cli.options.settings import Settings
from shapeblend_cli.paint.styles import painted_as
from shapeblend_cli.pairing.changes import changes, unchanged
from shapeblend_cli.pairing.costs import USUAL, Rates
from shapeblend_cli.pairing.paint_order import Overlaps
from shapeblend_cli.pairing.pair import pair_rotated_contours, rotated_back
from shapeblend_cli.pairing.reasons import reasons_for
from shapeblend_cli.pairing.required import constrain, point_pins, required_pairs
from shapeblend_cli.pairing.riders import riders_of_pairs
from shapeblend_cli.pairing.same import same_pairs
from shapeblend_cli.pairing.shapes import Match, shape_blends
from shapeblend_cli.system.clock import Clock
from shapeblend_cli.system.kept import Kept
from shapeblend_cli.wires.direction import watch_part
from shapeblend_cli.wires.match import match_contours

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Hashable, Sequence

    from shapeblend_cli.anatomy.decompose import ContourPair
    from shapeblend_cli.model import ContourBlend, Place
    from shapeblend_cli.motion.alignment import Alignment
    from shapeblend_cli.pairing.changes import Change
    from shapeblend_cli.pairing.required import ConstrainedPairs, NumbersOrNone
    from shapeblend_cli.wires.constraints import Numbers
    from shapeblend_cli.wires.direction import Watch

T = TypeVar("T")

NOTHING = Kept(0)
"""Nothing that is kept."""


class Progress(NamedTuple):
    """The clock and the observer of one of several pairs, and the steps that are kept for the next run."""

    clock: Clock
    steps: Kept
    watch: Callable[[str, float], None] = lambda stage, share: None
    pair: tuple[int, int] = (0, 1)  # its number, and how many there are
    drawings: Kept = NOTHING  # what was made of single drawings

    def keeping(self, most: int) -> Progress:
        """Return the same with steps of its own, at most so many, unless steps are kept already."""
        return self if self.steps.keeps else self._replace(steps=Kept(most))

    def once(self, step: str, objects: Sequence[object], given: Hashable, make: Callable[[], T]) -> T:
        """Return what a step gives for objects: as it was kept for the very same ones, else as it is made now."""
        if not self.steps.keeps:
            return make()
        return _once(self.steps, (step, *map(id, objects), given), objects, make, 0)

    def once_for(self, step: str, placed: PlacedDrawing, given: Hashable, make: Callable[[], T]) -> T:
        """Return a step made of a drawing alone: as it was kept, also for other pairs, else as it is made now."""
        objects = placed.drawing, *placed.contours
        if self.steps.keeps:
            return self.once(step, objects, given, make)
        if not self.drawings.keeps:
            return make()
        size = placed.drawing.bytes_of_segments
        return _once(self.drawings, (step, *map(id, objects), given), objects, make, size)

    def tell(self, stage: str, share: float) -> None:
        """Say how much of a stage is done, from 0 to 1."""
        self.watch(stage, (self.pair[0] + share) / self.pair[1])


def _once(kept: Kept, key: Hashable, objects: Sequence[object], make: Callable[[], T], size: int) -> T:
    """Return what is kept by a key, or what is made now of objects and a number of bytes."""
    found = kept.find(key)
    if found is None:
        found = objects, make()  # as long as the objects are kept, no others have their ids
        kept.keep(key, found, size)
    made: T = found[1]
    return made


class PairedDrawings(NamedTuple):
    """Two drawings with paired contours, and all that matching these takes."""

    a: PlacedDrawing
    b: PlacedDrawing
    rotation: float  # of B against A, in radians
    pairs: ConstrainedPairs
    changes: Sequence[Change]
    riders: tuple[dict[int, int], dict[int, int]]  # numbers of strokes and of the fills on which they ride
    required: Sequence[tuple[int, int]]
    settings: Settings
    progress: Progress
    copies: Copies | None = None  # of crowds

    @property
    def is_fixed(self) -> bool:
        """Whether something else than costs decides pairs, or crowds of copies are matched together."""
        return bool(self.changes or self.required or self.copies is not None)

    def without(self, numbers: Collection[NumbersOrNone]) -> PairedDrawings:
        """Return the same without some pairs of contours, by their numbers, and without what rides on these."""
        pairs = {pair: each for pair, each in self.pairs.items() if pair not in numbers}
        leaders = [{pair[side] for pair in pairs} for side in (0, 1)]
        first, last = (
            {rider: leader for rider, leader in riding.items() if leader in known}
            for riding, known in zip(self.riders, leaders, strict=True)
        )
        return self._replace(pairs=pairs, riders=(first, last))

    def leads(self, shape: ShapeBlend) -> bool:
        """Return whether strokes ride on a shape, which therefore moves straight as they do."""
        leaders = [set(side.values()) for side in self.riders]
        return any(contour.a in leaders[0] or contour.b in leaders[1] for contour in shape.contours)

    def match(self, numbers: NumbersOrNone, rotation: float, watch: Watch | None = None) -> Match:
        """Match the pair of contours with two numbers, B rotated back by an angle."""
        pair, constraints = self.pairs[numbers]
        required = constraints.start, tuple(constraints.pins)

        def search() -> ContourBlend:
            return match_contours(*pair, self.settings, constraints, rotation, watch)

        def solve() -> ContourBlend:
            is_free = not (constraints.start or constraints.pins or self.settings.stiff)
            blend = self.copies.matched(pair, rotation, search) if self.copies and is_free else search()
            return blend._replace(seconds=self.progress.clock.lap("match"))

        given = required, rotation, self._settings_of_matches
        return Match(pair, self.progress.once("match", pair, given, solve))

    def match_again(self, shape: ShapeBlend, rotation: float) -> ShapeBlend:
        """Match the contours of a shape for another angle."""
        self.progress.clock.lap("interpolate")
        contours = (
            self.match(contour.numbers, rotation).blend if contour.is_matched else contour
            for contour in shape.contours
        )
        return shape._replace(contours=tuple(contours))

    def curved(self, shape: ShapeBlend) -> ShapeBlend:
        """Return a shape that moves between the drawings' own curves, unless polygons are asked for."""
        if not self.settings.curves:
            return shape
        contours, copies = shape.contours, self.copies

        def curve(blend: ContourBlend) -> ContourBlend:
            if copies and blend.is_matched:
                return copies.curved(blend, with_curves)
            return self.progress.once("curve", (blend,), (), lambda: with_curves(blend))

        return shape._replace(
            contours=self.progress.once("curves", contours, (), lambda: tuple(map(curve, contours)))
        )

    def judged(
        self, shape: ShapeBlend, view: Box, common: Alignment | None, choose: Callable[[], ShapeBlend]
    ) -> ShapeBlend:
        """Return a shape with the motion that `choose` gives it, or that it was given before."""
        given = shape._replace(contours=()), view, common, self.rotation, self._unnamed_settings
        return self.progress.once("motion", shape.contours, given, choose)

    @property
    def _unnamed_settings(self) -> str:
        """The settings that motions depend on, without those that are in the constraints of each pair.

        Nothing where no steps are kept by them.
        """
        return _unnamed(self.settings) if self.progress.steps.keeps else ""

    @property
    def _settings_of_matches(self) -> str:
        """The same without the motion, which matches do not depend on."""
        return _unnamed(self.settings.replace(motion="auto")) if self.progress.steps.keeps else ""


@lru_cache(maxsize=8)
def _unnamed(settings: Settings) -> str:
    """Return settings as a text, without those that are in the constraints of each pair."""
    named = dict.fromkeys(("pins", "match", "start", "frames", "ends", "ease"))
    return repr(settings.replace(**named))


def pair_drawings(
    a: PlacedDrawing,
    b: PlacedDrawing,
    settings: Settings,
    rotation: float,
    progress: Progress,
    changed: Sequence[Change] = (),
    wanted: Sequence[Numbers] = (),
    rates: Rates = USUAL,
) -> PairedDrawings:
    """Pair the contours of two drawings as if B were rotated back by an angle, except where a change is known.

    `wanted` are numbers of contours that are paired besides those that the settings name.
    """
    progress.tell("pairing", 0.0)
    pins = point_pins(a, b, settings)
    asked = required_pairs(a, b, settings) + [pin.pair for pin in pins]
    if not (changed or rotation or settings.is_star):
        changed = changes(a.contours, b.contours, settings)
    rest = unchanged(a.contours, changed, 0), unchanged(b.contours, changed, 1)
    required = [*asked, *wanted]
    pairs: Sequence[ContourPair] = ()
    if all(rest):
        if not rotation:
            required += same_pairs(*rest, required)
        boxes = Box.union([c.box for c in a.contours]), Box.union([c.box for c in b.contours])
        frames = boxes if changed else None
        pairs = pair_rotated_contours(*rest, settings, required, rotation, frames=frames, rates=rates)
    riders: tuple[dict[int, int], dict[int, int]] = {}, {}
    # With --stagger, strokes have times of their own.
    if settings.motion in ("auto", "linear") and not rotation and not settings.has_spans:
        riders = riders_of_pairs(rest, pairs, required)
    pairs = [(p, q) for p, q in pairs if p.number not in riders[0] and q.number not in riders[1]]
    progress.clock.lap("match")
    constrained = constrain(pairs, settings, pins)
    copies = Copies() if max(map(len, (a.contours, b.contours))) > MATCHED_ONE_BY_ONE else None
    return PairedDrawings(a, b, rotation, constrained, changed, riders, asked, settings, progress, copies)


def match_pairs(paired: PairedDrawings) -> tuple[tuple[ShapeBlend, ...], list[Place]]:
    """Match all pairs, and put them together to shapes, with the contours that grow or shrink.

    Return them with their places in the order of paint.
    """
    count, watch = len(paired.pairs), partial(paired.progress.tell, "matching")
    matches = [
        paired.match(numbers, paired.rotation, watch_part(watch, k, count))
        for k, numbers in enumerate(paired.pairs)
    ]
    sides = paired.a.contours, paired.b.contours
    overlaps = [paired.progress.once("overlaps", side, (), partial(Overlaps, side)) for side in sides]
    shapes, places = shape_blends(*sides, matches, paired.changes, paired.riders, overlaps)
    styled = tuple(_in_style(shape, paired.settings.style) for shape in shapes)
    paired.progress.clock.lap("match")
    return styled, places


def _in_style(shape: ShapeBlend, style: str) -> ShapeBlend:
    """Paint a shape as `--style` says; one without a partner keeps its own paint."""
    if not (any(c.a is not None for c in shape.contours) and any(c.b is not None for c in shape.contours)):
        return shape
    style_a, style_b = painted_as(shape.style_a, shape.style_b, style)
    return shape._replace(style_a=style_a, style_b=style_b)


def with_reasons(shapes: Sequence[ShapeBlend], paired: PairedDrawings) -> tuple[ShapeBlend, ...]:
    """Give each contour the reason for its partner, or for the lack of one, and the contours around it."""
    pairs = [pair for pair, _ in paired.pairs.values()]
    a, b = paired.a.contours, paired.b.contours
    if not (a and b):  # all that one drawing has are pen lines
        return tuple(shapes)
    if paired.rotation:
        b = rotated_back(a, b, paired.rotation)
    reasons = reasons_for(a, b, pairs, paired.required, paired.riders)
    return tuple(shape._replace(contours=tuple(map(reasons.added_to, shape.contours))) for shape in shapes)
