"""The contours of two drawings: which becomes which, and how."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from shapeblend_cli.anatomy.decompose import PlacedDrawing
from shapeblend_cli.interpolate.paths import with_curves
from shapeblend_cli.model import Box, ShapeBlend
from shapeblend_cli.motion.sweep import Sweep
from shapeblend_cli.options.settings import Settings
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
from shapeblend_cli.wires.direction import watch_part
from shapeblend_cli.wires.match import match_contours

if TYPE_CHECKING:
    from collections.abc import Callable, Hashable, Sequence

    from shapeblend_cli.anatomy.decompose import ContourPair
    from shapeblend_cli.model import ContourBlend, Place
    from shapeblend_cli.motion.alignment import Alignment
    from shapeblend_cli.pairing.changes import Change
    from shapeblend_cli.pairing.required import ConstrainedPairs, NumbersOrNone
    from shapeblend_cli.wires.direction import Watch


class PairedDrawings(NamedTuple):
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
        made = self._once(key, contours, lambda: with_drawn_curves(shape, self.settings).contours)
        return shape._replace(contours=made)

    def judged(
        self, shape: ShapeBlend, view: Box, common: Alignment | None, choose: Callable[[], ShapeBlend]
    ) -> ShapeBlend:
        """Return a shape that moves as was chosen, unless that is kept."""
        ids = tuple(map(id, shape.contours))
        key = "motion", ids, shape._replace(contours=()), view, common, self.rotation, self._of_wires
        return self._once(key, shape, choose)


def pair_drawings(
    a: PlacedDrawing, b: PlacedDrawing, settings: Settings, rotation: float, by: tuple[Clock, Kept]
) -> PairedDrawings:
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
    return PairedDrawings(a, b, rotation, constrained, changed, riders, asked, settings, clock, steps)


def match_pairs(paired: PairedDrawings, watch: Watch | None) -> tuple[tuple[ShapeBlend, ...], list[Place]]:
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


def match_again(paired: PairedDrawings, shape: ShapeBlend, rotation: float) -> ShapeBlend:
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


def explained(shapes: Sequence[ShapeBlend], paired: PairedDrawings) -> tuple[ShapeBlend, ...]:
    """Say of each contour why it has its partner, or none, and what it lies in."""
    pairs = [pair for pair, _ in paired.pairs.values()]
    a, b = paired.a.contours, paired.b.contours
    if paired.rotation:
        b = rotated_back(a, b, paired.rotation)
    reasons = reasons_for(a, b, pairs, paired.required, paired.riders)
    return tuple(shape._replace(contours=tuple(map(reasons.added_to, shape.contours))) for shape in shapes)


def with_drawn_curves(shape: ShapeBlend, settings: Settings) -> ShapeBlend:
    """Return a shape that moves between the drawings' own curves, unless polygons are asked for."""
    if not settings.curves:
        return shape
    return shape._replace(contours=tuple(map(with_curves, shape.contours)))
