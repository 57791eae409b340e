"""The frames of a blend: the shapes at a time, and the times that settings ask for."""

from __future__ import annotations

from typing import TYPE_CHECKING

from shapeblend_cli.interpolate.paths import paths_at
from shapeblend_cli.model import (
    Box,
    Clip,
    ClipBlend,
    Effect,
    EffectBlend,
    Frame,
    PaintedShape,
    Pair,
    ShapeBlend,
    Style,
)
from shapeblend_cli.options.easing import frame_times
from shapeblend_cli.paint.names import common_page, page_for
from shapeblend_cli.paint.styles import paint_times, shape_styles

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.options.settings import Settings


def times_of_frames(pairs: Sequence[Pair], settings: Settings) -> list[tuple[Pair, float]]:
    """Return the pair and the time of each in-between, and with `settings.ends` of the drawings, in order."""
    if settings.times:
        ease = settings.common_ease
        return [(pair, ease.at(t) if 0.0 < t < 1.0 else t) for pair in pairs for t in settings.times]
    times = frame_times(settings.frames, settings.ends, settings.common_ease)
    # Pairs but the first begin with the drawing with which the pair before ends.
    return [(pair, t) for pair in pairs for t in (times[1:] if settings.ends and pair.a else times)]


def make_frames(pairs: Sequence[Pair], settings: Settings) -> list[Frame]:
    """Draw the frames that settings ask for."""
    if settings.mix:
        return _mixed_frames(pairs, settings)
    return [frame_at(pair, t, as_drawn=settings.draws_ends) for pair, t in times_of_frames(pairs, settings)]


def end_frames(pairs: Sequence[Pair], settings: Settings) -> list[Frame]:
    """Draw the drawings, in order, as frames show them."""
    return make_frames(pairs, settings.replace(frames=0, ends=True, times=None))


def _mixed_frames(pairs: Sequence[Pair], settings: Settings) -> list[Frame]:
    from shapeblend_cli.interpolate.stars import drawings_in, mixed_shape, star_shapes

    used = drawings_in(settings.mix)
    rows = [[weights[k] for k in used] for weights in settings.mix]
    if len(used) == 2:
        return [frame_at(pairs[0], row[1], as_drawn=settings.draws_ends) for row in rows]
    shapes = star_shapes(pairs)
    drawn = [pairs[0].drawn[0], *(pair.drawn[1] for pair in pairs)]
    views = [pairs[0].views[0], *(pair.views[1] for pair in pairs)]
    pages = [pairs[0].pages[0], *(pair.pages[1] for pair in pairs)]
    frames = []
    for row in rows:
        view = Box(*(sum(w * v for w, v in zip(row, side, strict=True)) for side in zip(*views, strict=True)))
        page = common_page([page for page, weight in zip(pages, row, strict=True) if weight])
        if 1.0 in row and settings.draws_ends:
            painted = drawn[row.index(1.0)]
        else:
            mixed = [mixed_shape(shape, row) for shape in shapes]
            painted = tuple(shape for shape in mixed if shape is not None)
        frames.append(Frame(0.0, 0, painted, view, page_for(page, view)))
    return frames


def shapes_at(pair: Pair, t: float) -> tuple[PaintedShape, ...]:
    """Return the shapes of a pair at time t, with the same commands at all times: also contours that are points."""
    clips: dict[tuple[int, float], Clip] = {}  # shapes that share a clip still share it

    def clip_at(clip: ClipBlend, time: float) -> Clip:
        key = id(clip), time
        if key not in clips:
            paths = tuple(path for shape in clip.shapes for path in paths_at(shape, time))
            clips[key] = Clip(paths, clip.rule)
        return clips[key]

    effects: dict[int, Effect] = {}

    def effect_of(blend: EffectBlend) -> Effect:
        from shapeblend_cli.paint.effects import effect_at  # few drawings have any

        if blend.number not in effects:
            clipped = tuple(clip_at(clip, blend.own_time(t)) for clip in blend.clips)
            effects[blend.number] = effect_at(blend, t)._replace(clips=clipped)
        return effects[blend.number]

    return tuple(
        PaintedShape(
            paths_at(shape, t),
            *shape_styles(shape, min(max(t, 0.0), 1.0)),
            shape.name,
            shape.groups,
            tuple(clip_at(clip, shape.own_time(t)) for clip in shape.clips),
            bent=None if shape.bend is None else shape.bend.at(shape, t),
            as_triangles=shape.bend is not None and shape.bend.as_triangles,
            effects=tuple(effect_of(blend) for blend in shape.effects),
        )
        for shape in pair.shapes
    )


def fading_styles(shape: ShapeBlend) -> tuple[tuple[float, Style], ...]:
    """Return times within (0, 1) between which the opacities of a shape change evenly, with its upper styles."""
    changes = () if shape.fade is None else (shape.fade.begin, shape.fade.until)
    return tuple((t, shape_styles(shape, t)[0]) for t in paint_times(shape, changes))


def frame_at(pair: Pair, t: float, *, as_drawn: bool) -> Frame:
    """Return the frame at time t; at t = 0 and t = 1 it may be the drawing itself.

    Before 0 and after 1 outlines move on, and everything else stays.
    """
    if not 0.0 <= t <= 1.0:
        end = float(t > 1.0)
        frame = frame_at(pair, end, as_drawn=False)
        return frame._replace(t=t, shapes=_without_points(pair, t))
    view = pair.views[0].interpolate(pair.views[1], t)
    if t not in (0.0, 1.0):
        page = page_for(common_page(pair.pages), view)
        return Frame(t, pair.a, tuple(shape for shape, _ in _seen(pair, t)), view, page)
    shapes = pair.drawn[int(t)] if as_drawn else _without_points(pair, t)
    return Frame(t, pair.a, shapes, view, page_for(pair.pages[int(t)], view))


def _seen(pair: Pair, t: float) -> list[tuple[PaintedShape, ShapeBlend]]:
    """Return the shapes at time t without copies that cannot be seen."""
    return [
        (shape, blend)
        for shape, blend in zip(shapes_at(pair, t), pair.shapes, strict=True)
        if blend.fade is None or blend.fade.share(blend.own_time(t)) > 0.0
    ]


def _without_points(pair: Pair, t: float) -> tuple[PaintedShape, ...]:
    """Return the shapes at an end of time or beyond it, without contours that are a point there."""
    painted = []
    for shape, blend in _seen(pair, t):
        paths = tuple(
            path
            for contour, path in zip(blend.contours, shape.paths, strict=True)
            if not (contour.shrinks if t > 0.0 else contour.grows)
        )
        if paths:
            painted.append(shape._replace(paths=paths))
    return tuple(painted)
