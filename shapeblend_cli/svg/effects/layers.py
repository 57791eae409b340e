"""The effects of a document: what elements declare while they are read, and what of it shapes have in the end.

The box of a group is not known before all in it is read, so effects are made at the end.
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.geometry import cubics
from shapeblend_cli.model import ALPHA, NORMAL, SOURCE, Box, Effect, Filter, Mask, Step
from shapeblend_cli.svg.styles.values import share
from shapeblend_cli.svg.xml.messages import check_limit

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from shapeblend_cli.model import Clip, Group, Shape
    from shapeblend_cli.svg.effects.tiles import Draw
    from shapeblend_cli.svg.styles.cascade import Cascade, Inherited
    from shapeblend_cli.svg.styles.declarations import Declarations
    from shapeblend_cli.svg.xml.messages import Notes
    from shapeblend_cli.svg.xml.transforms import Affine
    from shapeblend_cli.svg.xml.units import Lengths
    from shapeblend_cli.svg.xml.xmltree import Node

DECLARED = frozenset(("filter", "mix-blend-mode", "isolation", "opacity"))
"""Properties that are effects."""

MOST_EFFECTS = 16
"""Maximum number of effects around a shape; further ones are left out."""

MOST_OF_ALL = 2_000
"""Maximum number of steps of all filters of a drawing, counted once for each element that has them."""

MOST_COMPARED = 200
"""Maximum number of shapes of a group that are compared; of more, some are taken to overlap."""

ROOM = 1.0
"""Distance from what is drawn at which filters end, as a share of the larger side of the drawing."""

WIDEST_BLUR = 0.5
"""Maximum standard deviation of a blur, as a share of the larger side of the drawing: beyond, nothing is left of it."""

WIDEST_BRUSH = 0.05
"""Maximum radius by which a filter thickens, as a share of the larger side of the drawing: time grows with its area."""

MODES = frozenset(
    "normal multiply screen overlay darken lighten color-dodge color-burn hard-light soft-light difference exclusion "
    "hue saturation color luminosity".split()
)
"""Values of ``mix-blend-mode`` that are written."""

REACH = 3.0
"""Distance at which a blur is no longer seen, in standard deviations."""

NOT_APPLIED = "filter not applied"

NO_MASK = "mask not applied"


class Given(NamedTuple):
    """An element with effects, and what is in force for it."""

    declared: Declarations
    matrix: Affine
    inherited: Inherited
    lengths: Lengths
    depth: int  # number of groups around it
    mask: Node | None = None  # that is no region, but soft

    @property
    def opacity(self) -> float:
        """Its own opacity."""
        own = share(self.declared.get("opacity", "1"))
        return 1.0 if own is None else own

    @property
    def mode(self) -> str:
        """Its blend mode."""
        mode = self.declared.get("mix-blend-mode", NORMAL).strip().lower()
        return mode if mode in MODES else NORMAL

    @property
    def isolates(self) -> bool:
        """Whether blend modes in it see only what is in it."""
        return self.declared.get("isolation", "").strip().lower() == "isolate"

    @property
    def filter(self) -> str:
        """What it declares as its filter; empty for none."""
        value = self.declared.get("filter", "none").strip()
        return "" if value.lower() in ("none", "initial", "unset", "") else value


class Clipped(NamedTuple):
    """A clip, and how many effects are around the element that has it."""

    effects: int
    clip: Clip


class Drawn(NamedTuple):
    """A shape as it was read, with all that is around it, the outermost first."""

    shape: Shape
    effects: tuple[int, ...]  # numbers
    clips: tuple[Clipped, ...]


class Layers:
    """The effects of a document, whose nodes it knows by their ids."""

    def __init__(
        self, ids: Mapping[str, Node], cascade: Cascade, notes: Notes, draw: Draw, *, is_inner: bool = False
    ) -> None:
        self._ids = ids
        self._is_inner = is_inner  # whether in something that is drawn elsewhere, such as a pattern
        self._segments = 0  # of what filters show
        self._draw = draw
        self._cascade = cascade
        self._notes = notes
        self._given: list[Given] = []
        self._steps = 0

    def add(self, given: Given, around: tuple[int, ...]) -> tuple[int, ...]:
        """Return the numbers of the effects around an element with its own."""
        is_soft = given.mask is not None
        if not (is_soft or given.filter or given.opacity < 1.0 or given.mode != NORMAL or given.isolates):
            return around
        if len(around) >= MOST_EFFECTS:
            self._notes.add(f"more than {MOST_EFFECTS} filters and opacities around each other left out")
            return around
        self._given.append(given)
        return (*around, len(self._given) - 1)

    def finish(
        self, drawn: Sequence[Drawn], view: Box | None, covers: Callable[[Clip, Box], bool]
    ) -> list[Shape]:
        """Return shapes with their effects and clips; a clip that `covers` what is painted is left out."""
        if not (self._given and drawn):
            return [_clipped(each.shape, [one.clip for one in each.clips], covers) for each in drawn]
        members: dict[int, list[int]] = {}
        for k, each in enumerate(drawn):
            for number in each.effects:
                members.setdefault(number, []).append(k)
        frame = _frame([each.shape for each in drawn], view)
        kept: dict[int, Effect] = {}
        for number in sorted(members, reverse=True):  # the inner ones first
            inside = [drawn[k] for k in members[number]]
            has_modes = any(
                kept[inner].mode != NORMAL
                for each in inside
                for inner in each.effects[each.effects.index(number) + 1 :]
                if inner in kept
            )
            effect = self._effect(number, [each.shape for each in inside], has_modes, frame)
            if effect is not None:
                kept[number] = effect
        return [_finished(each, kept, covers) for each in drawn]

    def _effect(self, number: int, inside: Sequence[Shape], has_modes: bool, frame: Box) -> Effect | None:
        """Return an effect on some shapes; None if it is as good as in the paint of these."""
        given = self._given[number]
        made = self._filter(given, inside, frame) if given.filter else None
        mask = None if given.mask is None else self._mask(given.mask, given, inside, frame)
        # Opacity of a group is that of all of it: only where nothing overlaps may each shape have it.
        opacity = given.opacity if given.opacity < 1.0 else 1.0
        if made is None and mask is None and given.mode == NORMAL:
            if not has_modes and not (opacity < 1.0 and _overlap(inside)):
                return None
        place = min(given.depth, _in_common([shape.groups for shape in inside]))
        return Effect(number, made, (), mask, opacity, given.mode, given.isolates and has_modes, place)

    def _mask(self, node: Node, given: Given, inside: Sequence[Shape], frame: Box) -> Mask | None:
        """Return a mask of an element; None if it cannot be applied."""
        from shapeblend_cli.svg.effects import tiles  # few drawings have any

        is_alpha = self._cascade.declared(node, keep=True).get("mask-type", "luminance").strip() == "alpha"

        def drawn(node: Node, matrix: Affine, lengths: Lengths) -> Sequence[Shape] | None:
            shapes = self._draw(node, matrix, lengths)
            return tiles.whitened(shapes) if shapes and is_alpha else shapes

        found = tiles.mask_of(node, given.matrix, _box(inside, given.matrix), given.lengths, drawn)
        if found is None:
            self._notes.add(NO_MASK)
            return None
        region = _common(found.region, frame)
        return Mask(region, tuple(layer._replace(region=region) for layer in found.layers))

    def _filter(self, given: Given, inside: Sequence[Shape], frame: Box) -> Filter | None:
        """Return the filter of an element, all that it lists in one; None if it cannot be applied."""
        from shapeblend_cli.svg.effects import functions
        from shapeblend_cli.svg.effects.placed import Units

        listed = functions.calls(given.filter)
        if listed is None:
            self._notes.add(NOT_APPLIED)
            return None
        found: Filter | None = None
        for call in listed:
            if call.name == "url":
                after = self._linked(call.arguments, given, inside)
            else:
                units = Units(given.matrix, None, given.lengths)
                steps = functions.steps_of(call, units, given.inherited)
                after = None if steps is None else Filter(frame, steps)
            if after is None:
                self._notes.add(NOT_APPLIED)
                return None
            found = after if found is None else _after(found, after)
        assert found is not None  # as something is listed
        self._steps += len(found.steps)
        check_limit(self._steps, MOST_OF_ALL, "steps of filters")
        return _bounded(found, frame)

    def _linked(self, arguments: Sequence[str], given: Given, inside: Sequence[Shape]) -> Filter | None:
        """Return the filter that is the element of a link; None if there is none, or one that is not known."""
        from shapeblend_cli.svg.effects import tiles
        from shapeblend_cli.svg.effects.images import MOST_SEGMENTS, Shown, segments_in
        from shapeblend_cli.svg.effects.placed import Units
        from shapeblend_cli.svg.effects.primitives import MOST_STEPS, SPACE, Steps

        link = arguments[0].strip() if arguments else ""
        node = self._ids.get(link[1:]) if link.startswith("#") else None
        if node is None or node.tag != "filter":
            return None
        box = _box(inside, given.matrix)
        in_box = (node.get("primitiveUnits") or "").strip() == "objectBoundingBox"
        region = tiles.region_of(node, "filterUnits", box, given.lengths)
        if region is None or (in_box and box is None):
            return None
        units = Units(given.matrix, box if in_box else None, given.lengths)
        shown = Shown(region, self._ids, self._draw, self._is_inner)
        steps = Steps(units, self._cascade, given.inherited, self._notes, shown)
        space = self._cascade.declared(node, keep=True).get(SPACE, "linearRGB").strip()
        for child in node.children:
            if len(steps.found) >= MOST_STEPS:
                self._notes.add(f"more than {MOST_STEPS} steps of a filter left out")
                break
            if not steps.add(child, space) and child.tag.startswith("fe"):
                self._notes.add(f"{child.tag} of a filter not applied")
                return None
        self._segments += segments_in(steps.found)
        check_limit(self._segments, MOST_SEGMENTS, "segments in filters")
        return Filter(units.region(region), tuple(steps.found)) if steps.found else None


def _box(inside: Sequence[Shape], matrix: Affine) -> Box | None:
    """Return the box around shapes, without their strokes, in the coordinates of their element."""
    a, b, c, d, e, f = matrix
    det = matrix.determinant
    if not inside or det == 0.0:
        return None
    inverse = type(matrix)(d / det, -b / det, -c / det, a / det, (c * f - d * e) / det, (b * e - a * f) / det)
    segments = [inverse.points(contour.segments) for shape in inside for contour in shape.contours]
    return cubics.bounds(np.concatenate(segments))


def _frame(shapes: Sequence[Shape], view: Box | None) -> Box:
    """Return the box beyond which filters paint nothing."""
    drawn = [cubics.bounds(contour.segments) for shape in shapes for contour in shape.contours]
    around = Box.union([*drawn, *([view] if view is not None else [])])
    return around.expanded(ROOM * around.larger_side)


def _common(box: Box, frame: Box) -> Box:
    """Return the part of a box that is in a frame."""
    left, top, right, bottom = box.bounds
    x0, y0, x1, y1 = frame.bounds
    left, right = max(left, x0), min(right, x1)
    top, bottom = max(top, y0), min(bottom, y1)
    return Box(left, top, max(right - left, 0.0), max(bottom - top, 0.0))


def _bounded(found: Filter, frame: Box) -> Filter:
    """Return a filter that is drawn in little time: it ends where nothing is seen, and no blur is too wide."""
    region = _common(found.region, frame)
    size = frame.larger_side / (1.0 + 2.0 * ROOM)
    most = {"stdDeviation": WIDEST_BLUR * size, "radius": WIDEST_BRUSH * size}
    steps = []
    for step in found.steps:
        numbers = tuple(
            (name, tuple(min(value, most[name]) for value in values) if name in most else values)
            for name, values in step.numbers
        )
        steps.append(step._replace(numbers=numbers))
    return Filter(region, tuple(steps))


def _after(first: Filter, second: Filter) -> Filter:
    """Return one filter for two, the second of which is applied to what the first returns."""
    shift = len(first.steps)
    steps = [*first.steps]
    alpha: int | None = None
    if any(ALPHA in step.inputs for step in second.steps):
        alpha = shift
        steps.append(Step("feColorMatrix", (shift - 1,), (), (("values", (0.0,) * 18 + (1.0, 0.0)),)))
        shift += 1
    known: dict[str | int, str | int] = {SOURCE: len(first.steps) - 1}
    if alpha is not None:
        known[ALPHA] = alpha
    for step in second.steps:
        inputs = tuple(each + shift if isinstance(each, int) else known[each] for each in step.inputs)
        steps.append(step._replace(inputs=inputs))
    return Filter(Box.union([first.region, second.region]), tuple(steps))


def _painted_box(shape: Shape) -> Box:
    reach = shape.style.reach
    return Box.union([cubics.bounds(contour.segments).expanded(reach) for contour in shape.contours])


def _overlap(inside: Sequence[Shape]) -> bool:
    """Return whether something of some shapes may be painted on something else of them."""
    if any(shape.style.fill is not None and shape.style.stroke is not None for shape in inside):
        return True
    if len(inside) > MOST_COMPARED:
        return True
    boxes = [_painted_box(shape) for shape in inside]
    return any(box.overlaps(other) for k, box in enumerate(boxes) for other in boxes[:k])


def _in_common(groups: Sequence[Sequence[Group]]) -> int:
    """Return how many groups are around all shapes."""
    first, *others = groups
    count = len(first)
    for other in others:
        count = min(count, len(other))
        while count and first[count - 1].number != other[count - 1].number:
            count -= 1
    return count


def _clipped(shape: Shape, clips: Sequence[Clip], covers: Callable[[Clip, Box], bool]) -> Shape:
    """Return a shape with the clips that it is not wholly inside of."""
    if not clips:
        return shape
    painted = _painted_box(shape)
    return replace(shape, clips=tuple(clip for clip in clips if not covers(clip, painted)))


def _finished(drawn: Drawn, kept: Mapping[int, Effect], covers: Callable[[Clip, Box], bool]) -> Shape:
    """Return a shape with effects, whose opacities are no longer in its paint, and with clips.

    A clip outside of a filter clips what the filter has made of the shape.
    """
    own: list[Clip] = []
    outside: dict[int, list[Clip]] = {}
    filters = [(k, n) for k, n in enumerate(drawn.effects) if n in kept and kept[n].filter is not None]
    for around, clip in drawn.clips:
        number = next((n for k, n in filters if k >= around), None)
        if number is None:
            own.append(clip)
            continue
        made = kept[number].filter
        if made is not None and not covers(clip, made.region):
            outside.setdefault(number, []).append(clip)
    effects = [
        kept[number]._replace(clips=tuple(outside.get(number, ())))
        for number in drawn.effects
        if number in kept
    ]
    opacity = math.prod(effect.opacity for effect in effects)
    shape = _clipped(drawn.shape, own, covers)
    style = shape.style
    if opacity < 1.0:
        style = style._replace(
            fill_opacity=_without(style.fill_opacity, opacity),
            stroke_opacity=_without(style.stroke_opacity, opacity),
        )
    return replace(shape, style=style, effects=tuple(effects)) if effects else shape


def _without(share: float, opacity: float) -> float:
    return min(round(share / opacity, 12), 1.0)
