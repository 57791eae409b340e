"""Effects between two effects: which becomes which, and filters, opacities and blend modes on the way."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.model import (
    NORMAL,
    SOURCE,
    Box,
    Effect,
    EffectBlend,
    Filter,
    Mask,
    MaskLayer,
    PaintedShape,
    Pair,
    ShapeBlend,
    Step,
)
from shapeblend_cli.model import WHOLE as WHOLE_SPAN
from shapeblend_cli.paint.oklab import blend_colours
from shapeblend_cli.paint.styles import INSTANT

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

    from shapeblend_cli.model import KeyframedEffect

    Key = tuple[int | None, int | None]  # numbers of an effect of A and of one of B that are one

SAME = 0.5
"""Minimum share of shapes that effects have in common which become each other."""

REACH = 3.0
"""Distance at which a blur is no longer seen, in standard deviations."""

NUMBERS = 1_000_000
"""Minimum difference between the numbers of effects of two pairs."""

FLAT = 1e-3
"""Minimum side of a box with which a mask is stretched, as a share of the larger sides."""

ROOM = 0.1
"""Margin of the region of a filter around shapes, as a share of their larger side."""

_SRGB = ("color-interpolation-filters", "sRGB")
_BLURRING = frozenset(("feFlood", "feBlend", "feGaussianBlur", "feMerge"))


def blend_filters(a: Filter, b: Filter, t: float) -> Filter:
    """Return the filter at time t between two of one kind."""
    return Filter(
        a.region.interpolate(b.region, t),
        tuple(_step(p, q, t) for p, q in zip(a.steps, b.steps, strict=True)),
    )


def _step(a: Step, b: Step, t: float) -> Step:
    if a == b:
        return a
    numbers = tuple(
        (name, tuple((1.0 - t) * x + t * y for x, y in zip(values, others, strict=True)))
        for (name, values), (_, others) in zip(a.numbers, b.numbers, strict=True)
    )
    alphas = [dict(step.numbers).get("flood-opacity", (1.0,))[0] for step in (a, b)]
    return a._replace(
        numbers=numbers,
        colours=tuple(
            (name, blend_colours(colour, other, t, *alphas))
            for (name, colour), (_, other) in zip(a.colours, b.colours, strict=True)
        ),
        region=a.region.interpolate(b.region, t) if a.region and b.region else None,
        parts=tuple(_step(p, q, t) for p, q in zip(a.parts, b.parts, strict=True)),
    )


def with_nothing(whole: Filter) -> tuple[Filter, Filter]:
    """Return a filter of a look, and one of its kind that changes nothing.

    What only blurs gets sharp. Of all else, such as shadows and glows, a share is mixed with what it is made from.
    """
    if {step.tag for step in whole.steps} <= _BLURRING and not _is_sharp(whole, len(whole.steps) - 1):
        sharp = (_with_numbers(step, "stdDeviation", (0.0, 0.0)) for step in whole.steps)
        return whole, whole._replace(steps=tuple(sharp))
    mixed = Step("feComposite", (len(whole.steps) - 1, SOURCE), (_SRGB, ("operator", "arithmetic")))
    looks = (
        whole._replace(steps=(*whole.steps, mixed._replace(numbers=(("k2", (k2,)), ("k3", (1.0 - k2,))))))
        for k2 in (1.0, 0.0)
    )
    return next(looks), next(looks)


def _is_sharp(whole: Filter, k: int) -> bool:
    """Return whether what a filter is applied to is seen in what a step returns, without a blur."""
    step = whole.steps[k]
    if step.tag == "feGaussianBlur":
        return False
    return any(_is_sharp(whole, each) if isinstance(each, int) else each == SOURCE for each in step.inputs)


def _with_numbers(step: Step, name: str, values: tuple[float, ...]) -> Step:
    return step._replace(
        numbers=tuple((own, values if own == name else found) for own, found in step.numbers)
    )


def reach_of(whole: Filter) -> float:
    """Return how far a filter may paint beyond what it is applied to."""
    reach = 0.0
    for step in whole.steps:
        numbers = dict(step.numbers)
        reach += REACH * max(numbers.get("stdDeviation", (0.0,))) + max(numbers.get("radius", (0.0,)))
        reach += sum(abs(numbers.get(name, (0.0,))[0]) for name in ("dx", "dy"))
    return reach


def effect_at(blend: EffectBlend, t: float) -> Effect:
    """Return an effect at time t, without its clips; modes, which have nothing in between, change at half time."""
    t = blend.own_time(t)
    a, b = blend.start, blend.end
    half = a if t < 0.5 else b
    made = None if a.filter is None or b.filter is None else blend_filters(a.filter, b.filter, t)
    mask = None if a.mask is None or b.mask is None else _blend_masks(a.mask, b.mask, t)
    return half._replace(filter=made, clips=(), mask=mask, opacity=(1.0 - t) * a.opacity + t * b.opacity)


def _blend_masks(a: Mask, b: Mask, t: float) -> Mask:
    """Return the mask at time t between two with the same layers, whose shares and places may differ."""
    if a == b:
        return a
    layers = tuple(
        p._replace(
            share=(1.0 - t) * p.share + t * q.share,
            shift=(1.0 - t) * p.shift + t * q.shift,
            scale=((1.0 - t) * p.scale[0] + t * q.scale[0], (1.0 - t) * p.scale[1] + t * q.scale[1]),
        )
        for p, q in zip(a.layers, b.layers, strict=True)
    )
    return Mask(a.region.interpolate(b.region, t), layers)


def keyed_effects(
    keyed: KeyframedEffect, drawings: int, samples: int = 1
) -> tuple[list[float], list[Effect]]:
    """Return an effect at all drawings and on the way, with the times, counted in drawings.

    Between two times all numbers change evenly, and colours nearly so; with more `samples` there are as many steps.
    """
    blend, first = keyed.blend, keyed.first
    own = _changes(blend)
    inner = sorted(own | {0.0, 1.0})
    inner = [p + (q - p) * k / samples for p, q in pairwise(inner) for k in range(samples)]
    times = sorted({*map(float, range(drawings)), *(first + t for t in inner)})
    return times, [effect_at(blend, min(max(time - first, 0.0), 1.0)) for time in times]


def _changes(blend: EffectBlend) -> set[float]:
    """Return the times between which an effect changes evenly, and one where modes change between two of them."""
    if not blend.pace:
        begin, until = blend.span
        return {begin, until}
    times = {t for t, _ in blend.pace}
    for (start, low), (end, high) in pairwise(blend.pace):
        for value in (0.0, 0.5, 1.0):
            if min(low, high) < value < max(low, high):
                at = start + (end - start) * (value - low) / (high - low)
                # What has nothing in between changes half way between two times.
                times |= {at - INSTANT, at + INSTANT} if value == 0.5 else {at}
    return {t for t in times if 0.0 <= t <= 1.0}


class _Side(NamedTuple):
    """The effects of a drawing, by their numbers."""

    effects: Mapping[int, Effect]
    members: Mapping[int, set[int]]  # numbers of shapes of the blend that are in both drawings


def has_effects(pair: Pair) -> bool:
    """Return whether either drawing has an effect."""
    return any(shape.effects for drawn in pair.drawn for shape in drawn)


def with_effects(pair: Pair) -> tuple[Pair, list[str]]:
    """Return a pair whose shapes have the effects of both drawings, and notes on groups that are cut.

    An effect becomes the one of the other drawing with the same shapes; without a partner it goes, or comes, by its
    strength. Shapes that share an effect still share it.
    """
    sides = [_side(pair, end) for end in (0, 1)]
    partners = _partners(*sides)
    chains = [_chain(shape, pair, partners) for shape in pair.shapes]
    members: dict[Key, list[ShapeBlend]] = {}
    for shape, chain in zip(pair.shapes, chains, strict=True):
        for key in chain:
            members.setdefault(key, []).append(shape)
    made: dict[Key, list[EffectBlend]] = {}
    count = NUMBERS * pair.a
    for key, inside in members.items():
        a, b = (
            side.effects[number] if number is not None else None
            for side, number in zip(sides, key, strict=True)
        )
        blends = _blends(a, b, inside, count)
        made[key] = blends
        count += len(blends)
    shapes = tuple(
        shape._replace(effects=tuple(blend for key in chain for blend in made[key]))
        for shape, chain in zip(pair.shapes, chains, strict=True)
    )
    return pair._replace(shapes=shapes), cut_groups(shapes)


def _side(pair: Pair, end: int) -> _Side:
    drawn = pair.drawn[end]
    effects = {effect.number: effect for shape in drawn for effect in shape.effects}
    members: dict[int, set[int]] = {number: set() for number in effects}
    for k, shape in enumerate(pair.shapes):
        own = shape.sources[end]
        if own is not None and None not in shape.sources:
            for effect in drawn[own].effects:
                members[effect.number].add(k)
    return _Side(effects, members)


def _partners(a: _Side, b: _Side) -> dict[int, int]:
    """Return the effects of B by those of A that they become, each once."""
    found = []
    for number, inside in a.members.items():
        for other, inside_b in b.members.items():
            common = len(inside & inside_b)
            if common and common >= SAME * min(len(inside), len(inside_b)):
                share = common / len(inside | inside_b)
                found.append((-share - _likeness(a.effects[number], b.effects[other]), number, other))
    partners: dict[int, int] = {}
    for _, number, other in sorted(found):
        if number not in partners and other not in partners.values():
            partners[number] = other
    return partners


def _likeness(a: Effect, b: Effect) -> float:
    """Return how much two effects are of one kind, from 0 to 4."""
    kinds = [effect.filter.kind if effect.filter else None for effect in (a, b)]
    return float(
        (kinds[0] == kinds[1])
        + ((a.mask is None) == (b.mask is None))
        + ((a.filter is None) == (b.filter is None))
        + ((a.mode == NORMAL) == (b.mode == NORMAL))
    )


def _chain(shape: ShapeBlend, pair: Pair, partners: Mapping[int, int]) -> list[Key]:
    """Return the effects around a shape, the outermost first, each as what it is in both drawings."""
    one, other = (
        None if k is None else [effect.number for effect in drawn[k].effects]
        for k, drawn in zip(shape.sources, pair.drawn, strict=True)
    )
    if other is None:
        return [(number, partners.get(number)) for number in one or ()]
    if one is None:
        partner_of_b = {b: a for a, b in partners.items()}
        return [(partner_of_b.get(number), number) for number in other]
    chain: list[Key] = []
    following = 0
    for number in one:
        partner = partners.get(number)
        if partner not in other[following:]:
            chain.append((number, None))
            continue
        at = other.index(partner)
        chain += [(None, each) for each in other[following:at]]
        chain.append((number, partner))
        following = at + 1
    return [*chain, *((None, each) for each in other[following:])]


def _blends(
    a: Effect | None, b: Effect | None, inside: Sequence[ShapeBlend], count: int
) -> list[EffectBlend]:
    """Return an effect on its way, given its shapes; two if its filters are of different kinds, the second inside."""
    place = _in_common([shape.groups for shape in inside])
    spans, paces = ({shape.span for shape in inside}, {shape.pace for shape in inside})
    is_one = len(spans) == 1 and len(paces) == 1
    span, pace = (inside[0].span, inside[0].pace) if is_one else (WHOLE_SPAN, ())
    start = (a or Effect(0))._replace(number=count, place=place)
    end = (b or Effect(0))._replace(number=count, place=place)
    start, end = _with_masks(start, end, inside)
    if start.filter is None and end.filter is None:
        return [EffectBlend(start, end, span, pace)]
    if start.filter is not None and end.filter is not None:
        if start.filter.kind == end.filter.kind:
            return [EffectBlend(start, end, span, pace)]
        inner = Effect(count + 1, start.filter, start.clips, place=place)
        without = Effect(count + 1, place=place)
        fading = _from_or_to_nothing(EffectBlend(inner, without, span, pace), inside)
        coming = EffectBlend(start._replace(filter=None, clips=()), end, span, pace)
        return [_from_or_to_nothing(coming, inside), fading]
    return [_from_or_to_nothing(EffectBlend(start, end, span, pace), inside)]


def _with_masks(start: Effect, end: Effect, inside: Sequence[ShapeBlend]) -> tuple[Effect, Effect]:
    """Return two effects whose masks have the same layers: B's covers A's, and both move with what they mask.

    If none of the shapes has a partner, the mask keeps its layer and moves with them.
    """
    if start.mask == end.mask:
        return start, end
    boxes = [_box(inside, 0), _box(inside, 1)]
    regions = [mask.region for mask in (start.mask, end.mask) if mask is not None]
    region = Box.union([*regions, *boxes])
    region = region.expanded(ROOM * region.larger_side)
    if None in (start.mask, end.mask) and all(None in shape.sources for shape in inside):
        if start.mask is not None:
            (layer,) = start.mask.layers
            layers = layer, _moved(layer, *boxes)
        else:
            assert end.mask is not None, "they differ"
            (layer,) = end.mask.layers
            layers = _moved(layer, *boxes[::-1]), layer
        own = [Mask(region, (each,)) for each in layers]
        return start._replace(mask=own[0]), end._replace(mask=own[1])
    drawn = [_drawn(mask, region) for mask in (start.mask, end.mask)]
    there, back = ([_moved(layer, *way) for layer in drawn] for way in (boxes, boxes[::-1]))
    masks = (
        Mask(region, (drawn[0], back[1]._replace(share=0.0))),
        Mask(region, (there[0], drawn[1])),
    )
    return start._replace(mask=masks[0]), end._replace(mask=masks[1])


def _drawn(mask: Mask | None, region: Box) -> MaskLayer:
    return MaskLayer(None, region) if mask is None else mask.layers[0]


def _moved(layer: MaskLayer, box: Box, onto: Box) -> MaskLayer:
    """Return a layer mapped as a box is onto another one; a side without extent keeps its length."""
    if layer.content is None:
        return layer
    x, y = (
        other / own if min(own, other) > FLAT * max(box.larger_side, onto.larger_side) else 1.0
        for own, other in ((box.width, onto.width), (box.height, onto.height))
    )
    shift = layer.shift - box.centre
    place = complex(x * shift.real, y * shift.imag) + onto.centre
    return layer._replace(shift=place, scale=(x * layer.scale[0], y * layer.scale[1]))


def _from_or_to_nothing(blend: EffectBlend, inside: Sequence[ShapeBlend]) -> EffectBlend:
    """Return an effect with a filter at one end, with one of its kind that changes nothing at the other."""
    ends = [blend.start, blend.end]
    k = 0 if ends[0].filter is not None else 1
    whole = ends[k].filter
    assert whole is not None, "one of the two has a filter"
    look, nothing = with_nothing(whole)
    around = _box(inside, 1 - k)
    around = around.expanded(ROOM * around.larger_side + reach_of(whole))
    ends[k] = ends[k]._replace(filter=look)
    ends[1 - k] = ends[1 - k]._replace(filter=nothing._replace(region=around))
    return blend._replace(start=ends[0], end=ends[1])


def _box(inside: Iterable[ShapeBlend], end: int) -> Box:
    """Return the box around shapes at one of their ends, with their strokes."""
    return Box.union([shape.box(end) for shape in inside])


def _in_common(groups: Sequence[Sequence[object]]) -> int:
    """Return how many groups are around all shapes."""
    first, *others = groups
    count = len(first)
    for other in others:
        count = next(
            (k for k in range(min(count, len(other))) if first[k] != other[k]), min(count, len(other))
        )
    return count


def cut_groups(shapes: Sequence[ShapeBlend]) -> list[str]:
    """Return a note if shapes that share an effect are not painted one after the other."""
    runs: dict[int, int] = {}
    open_before: set[int] = set()
    for shape in shapes:
        numbers = {blend.number for blend in shape.effects}
        for number in numbers - open_before if shape.fade is None else ():
            runs[number] = runs.get(number, 0) + 1
        open_before = numbers
    cut = sum(count > 1 for count in runs.values())
    if not cut:
        return []
    groups = "1 group" if cut == 1 else f"{cut} groups"
    return [
        f"{groups} with a filter, an opacity or a blend mode cut on the way: other shapes are painted between its own"
    ]


def without_effects(shapes: Sequence[PaintedShape]) -> tuple[PaintedShape, ...]:
    """Return shapes without effects, but each with the opacities of the groups around it."""
    return tuple(_faded(shape) for shape in shapes)


def _faded(shape: PaintedShape) -> PaintedShape:
    if not shape.effects:
        return shape
    opacity = float(np.prod([effect.opacity for effect in shape.effects]))
    below = shape.below and shape.below.faded(opacity)
    return shape._replace(style=shape.style.faded(opacity), below=below, effects=())


def pair_without_effects(pair: Pair) -> Pair:
    """Return a pair whose shapes have no effects, but each the opacities of the groups around it."""
    shapes = []
    for shape in pair.shapes:
        ends = [[getattr(blend, side).opacity for blend in shape.effects] for side in ("start", "end")]
        a, b = (float(np.prod(opacities)) for opacities in ends)
        shapes.append(
            shape._replace(style_a=shape.style_a.faded(a), style_b=shape.style_b.faded(b), effects=())
            if shape.effects
            else shape
        )
    one, other = pair.drawn
    return pair._replace(shapes=tuple(shapes), drawn=(without_effects(one), without_effects(other)))


def kinds_in(pairs: Sequence[Pair]) -> str:
    """Return what effects there are, in words, with a verb."""
    effects = [
        end
        for pair in pairs
        for shape in pair.shapes
        for each in shape.effects
        for end in (each.start, each.end)
    ]
    kinds = [
        *(["filters"] if any(effect.filter for effect in effects) else []),
        *(["masks"] if any(effect.mask for effect in effects) else []),
        *(["blend modes"] if any(effect.mode != NORMAL for effect in effects) else []),
        *(["opacities of groups as a whole"] if any(effect.opacity < 1.0 for effect in effects) else []),
    ]
    return " and ".join([", ".join(kinds[:-1]), kinds[-1]] if len(kinds) > 1 else kinds) + " are"
