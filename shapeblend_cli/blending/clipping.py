"""Clip paths that go with the shapes they clip."""

from __future__ import annotations

from typing import TYPE_CHECKING

from shapeblend_cli.blending.blended import blend_shapes
from shapeblend_cli.blending.matched import Progress
from shapeblend_cli.blending.placing import AS_IT_IS, flattened
from shapeblend_cli.blending.turned_drawings import TURNED, carried, turned_back
from shapeblend_cli.errors import InputError
from shapeblend_cli.geometry.polygons import rectangle
from shapeblend_cli.model import (
    Box,
    Clip,
    ClipBlend,
    Contour,
    Drawing,
    Pair,
    Shape,
    ShapeBlend,
    Style,
    control_box,
)
from shapeblend_cli.motion.rigid import Whole
from shapeblend_cli.system.clock import Clock
from shapeblend_cli.system.kept import Kept

if TYPE_CHECKING:
    from collections.abc import Callable

    from shapeblend_cli.model import Motion
    from shapeblend_cli.options.settings import Settings

ROOM = 0.05
"""Margin of the box around a shape that stands for a missing clip, as a share of the shape's larger side."""


def with_clips(
    pair: Pair, settings: Settings, watch: Callable[[str, float], None] = lambda stage, share: None
) -> Pair:
    """Return a pair whose shapes have the clips of both drawings, outermost with outermost.

    A box around the shape stands for a missing clip. Clips that cannot be blended clip nothing on the way. The observer
    is told the stages that clips go through.
    """
    progress = Progress(Clock(), Kept(0), lambda stage, share: watch(f"clips: {stage}", share))
    settings = settings.replace(**dict.fromkeys(("match", "pins", "start", "stiff", "mix", "specks")))
    settings = settings.replace(strokes="keep")  # what is clipped is seen in regions, and not in lines
    view = Box.union(list(pair.views))
    known: dict[tuple[object, object], ClipBlend] = {}

    def blended(a: Clip | None, b: Clip | None, shape: ShapeBlend) -> ClipBlend:
        regions = a or _box_around(shape, 0), b or _box_around(shape, 1)
        key = (id(a) if a else regions[0].paths, id(b) if b else regions[1].paths)
        if key not in known:
            drawings = _as_drawing(regions[0]), _as_drawing(regions[1])
            known[key] = ClipBlend(_region_blend(drawings, settings, view, shape.motion, progress))
        return known[key]

    shapes = []
    for shape in pair.shapes:
        sides = [
            () if k is None else drawn[k].clips for k, drawn in zip(shape.sources, pair.drawn, strict=True)
        ]
        count = max(map(len, sides))
        if None in shape.sources:  # a shape in one drawing only keeps its clips
            sides = [max(sides, key=len)] * 2
        a, b = ([*side, *[None] * (count - len(side))] for side in sides)
        clips = (blended(one, other, shape) for one, other in zip(a, b, strict=True))
        shapes.append(shape._replace(clips=tuple(clip for clip in clips if clip.shapes)))
    return pair._replace(shapes=tuple(shapes))


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


def has_clips(pair: Pair) -> bool:
    """Return whether either drawing has a clip."""
    return any(shape.clips for drawn in pair.drawn for shape in drawn)


def _as_drawing(clip: Clip) -> Drawing:
    contours = tuple(Contour(path.segments, path.straight, path.closed) for path in clip.paths)
    return Drawing("a clip path", None, (Shape(0, None, "clipPath", contours, Style(fill_rule=clip.rule)),))


def _box_around(shape: ShapeBlend, end: int) -> Clip:
    """Return a box around a shape at one of its ends, and its strokes."""
    paths = [contour.end if end else contour.start for contour in shape.contours]
    style = shape.style_b if end else shape.style_a
    box = control_box(paths)
    box = box.expanded(ROOM * box.larger_side + (style.stroke_width if style.stroke else 0.0))
    return Clip((rectangle(box),))
