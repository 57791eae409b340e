"""Clip paths that go with the shapes they clip."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING

from shapeblend_cli.blending.blended import blend_shapes
from shapeblend_cli.blending.matched import Progress
from shapeblend_cli.blending.placing import AS_IT_IS, flattened
from shapeblend_cli.blending.swaps.swapped import is_swapped
from shapeblend_cli.blending.turned_drawings import TURNED, carried, turned_back
from shapeblend_cli.errors import InputError
from shapeblend_cli.geometry.polygons import rectangle
from shapeblend_cli.interpolate.paths import with_curves
from shapeblend_cli.model import (
    Box,
    Clip,
    ClipBlend,
    Contour,
    Drawing,
    EffectBlend,
    Pair,
    Shape,
    ShapeBlend,
    Style,
    control_box,
)
from shapeblend_cli.motion.rigid import Whole
from shapeblend_cli.system.clock import Clock
from shapeblend_cli.system.kept import Kept
from shapeblend_cli.wires.contour_blends import grow_from_point

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import Motion
    from shapeblend_cli.options.settings import Settings

ROOM = 0.05
"""Margin of the box around a shape that stands for a missing clip, as a share of the shape's larger side."""


Watch = Callable[[str, float], None]


def with_clips(pair: Pair, settings: Settings, watch: Watch) -> Pair:
    """Return a pair whose shapes have the clips of both drawings, outermost with outermost.

    A box around the shape stands for a missing clip. Clips that cannot be blended clip nothing on the way. Those of a
    drawing that takes the place of the other one grow with it, and shrink with it. The observer is told the stages that
    clips go through.
    """
    clips = _Clips(pair, settings, watch)
    is_exchange = is_swapped(pair.shapes)
    shapes = []
    for shape in pair.shapes:
        sides = [
            () if k is None else drawn[k].clips for k, drawn in zip(shape.sources, pair.drawn, strict=True)
        ]
        if None in shape.sources:  # a shape in one drawing only keeps its clips
            sides = [max(sides, key=len)] * 2
        if is_exchange:
            shapes.append(shape._replace(clips=clips.scaled(sides[0], shape)))
            continue
        boxes = partial(_box_around, shape)
        shapes.append(shape._replace(clips=clips.blended(sides, boxes, shape.motion)))
    return pair._replace(shapes=tuple(shapes))


def with_effect_clips(pair: Pair, settings: Settings, watch: Watch) -> Pair:
    """Return a pair whose effects have the clips of both drawings; the region of a filter stands for a missing one."""
    clips = _Clips(pair, settings, watch)
    known: dict[int, EffectBlend] = {}

    def clipped(blend: EffectBlend, shape: ShapeBlend) -> EffectBlend:
        if blend.number not in known:
            ends = blend.start, blend.end

            def around(end: int) -> Clip:
                made = ends[end].filter
                return _box_around(shape, end) if made is None else Clip((rectangle(made.region),))

            sides = [end.clips for end in ends]
            known[blend.number] = blend._replace(clips=clips.blended(sides, around, shape.motion))
        return known[blend.number]

    shapes = (
        shape._replace(effects=tuple(clipped(blend, shape) for blend in shape.effects))
        for shape in pair.shapes
    )
    return pair._replace(shapes=tuple(shapes))


class _Clips:
    """The clips of a pair that move, each blended once."""

    def __init__(self, pair: Pair, settings: Settings, watch: Watch) -> None:
        self._progress = Progress(Clock(), Kept(0), lambda stage, share: watch(f"clips: {stage}", share))
        settings = settings.replace(**dict.fromkeys(("match", "pins", "start", "stiff", "mix", "specks")))
        # What is clipped is seen in regions, not in lines; and it would be gone while these are swapped.
        self._settings = settings.replace(strokes="keep", swap="never")
        self._view = Box.union(list(pair.views))
        self._known: dict[tuple[object, object], ClipBlend] = {}

    def blended(
        self, sides: Sequence[Sequence[Clip]], around: Callable[[int], Clip], motion: Motion | None
    ) -> tuple[ClipBlend, ...]:
        """Return the clips between those of two sides; `around` has a region for an end that has fewer."""
        count = max(map(len, sides))
        a, b = ([*side, *[None] * (count - len(side))] for side in sides)
        clips = (self._one(one, other, around, motion) for one, other in zip(a, b, strict=True))
        return tuple(clip for clip in clips if clip.shapes)

    def scaled(self, clips: Sequence[Clip], shape: ShapeBlend) -> tuple[ClipBlend, ...]:
        """Return the clips of a shape of one drawing, which shrink to the point to which the shape does."""
        is_new = shape.sources[0] is None
        centre = complex(shape.contours[0].path(not is_new).segments[0, 0])
        found = []
        for clip in clips:
            key = id(clip), is_new
            if key not in self._known:
                self._known[key] = ClipBlend(
                    _scaled_region(_as_drawing(clip), self._settings, centre, is_new)
                )
            found.append(self._known[key])
        return tuple(clip for clip in found if clip.shapes)

    def _one(
        self, a: Clip | None, b: Clip | None, around: Callable[[int], Clip], motion: Motion | None
    ) -> ClipBlend:
        regions = a or around(0), b or around(1)
        key = (id(a) if a else regions[0].paths, id(b) if b else regions[1].paths)
        if key not in self._known:
            drawings = _as_drawing(regions[0]), _as_drawing(regions[1])
            shapes = _region_blend(drawings, self._settings, self._view, motion, self._progress)
            self._known[key] = ClipBlend(shapes)
        return self._known[key]


def _region_blend(
    drawings: tuple[Drawing, Drawing],
    settings: Settings,
    view: Box,
    motion: Motion | None,
    progress: Progress,
) -> tuple[ShapeBlend, ...]:
    """Blend the regions of two clips, each a drawing of a single shape; nothing if a region is empty.

    They turn with a shape whose motion turns the whole drawing.
    """
    progress.tell("flattening", 0.0)
    try:
        (a, b), _ = flattened(drawings, [AS_IT_IS, AS_IT_IS], settings.vertices, Kept(0))
    except InputError:
        return ()
    if not isinstance(motion, Whole):
        return blend_shapes(a, b, settings, view, progress)
    straight = settings.replace(motion="linear")
    return carried(blend_shapes(a, turned_back(b, motion), straight, view, progress), motion, TURNED)


def _scaled_region(
    region: Drawing, settings: Settings, centre: complex, is_new: bool
) -> tuple[ShapeBlend, ...]:
    """Return the region of a clip that grows from a point, or shrinks to it; nothing if it is empty."""
    try:
        (placed,), _ = flattened([region], [AS_IT_IS], settings.vertices, Kept(0))
    except InputError:
        return ()
    contours = tuple(
        with_curves(grow_from_point(contour, centre, of_b=is_new)) for contour in placed.contours
    )
    style = region.shapes[0].style
    return (ShapeBlend(contours, style, style),)


def has_clips(pair: Pair) -> bool:
    """Return whether either drawing has a clip."""
    return any(shape.clips for drawn in pair.drawn for shape in drawn)


def _as_drawing(clip: Clip) -> Drawing:
    contours = tuple(Contour(path.segments, path.straight, path.closed) for path in clip.paths)
    return Drawing("a clip path", None, (Shape(0, None, "clipPath", contours, Style(fill_rule=clip.rule)),))


def _box_around(shape: ShapeBlend, end: int) -> Clip:
    """Return a box around a shape at one of its ends, and its strokes."""
    style = shape.style(end)
    box = control_box([contour.path(end) for contour in shape.contours])
    box = box.expanded(ROOM * box.larger_side + (style.stroke_width if style.stroke else 0.0))
    return Clip((rectangle(box),))
