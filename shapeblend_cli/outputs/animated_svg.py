"""One SVG document that moves by SMIL, by CSS, or as frames that are visible in turn."""

from __future__ import annotations

from typing import TYPE_CHECKING

from shapeblend_cli.interpolate.chains import keyframed_shapes
from shapeblend_cli.model import Box
from shapeblend_cli.outputs.formats import OutputSpec, Rendered, page_of, views
from shapeblend_cli.paint.names import page_for

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import Page, Pair


def render(spec: OutputSpec, pairs: Sequence[Pair]) -> Rendered:
    """Frames that are visible in turn include the drawings. One mixture stands still."""
    boxes, timing, decimals = views(pairs), spec.timing, spec.decimals(pairs)
    if spec.settings.mix:
        from shapeblend_cli.frames.frames import make_frames
        from shapeblend_cli.svg.writing.document import frame_svg

        (frame,) = make_frames(pairs, spec.settings)
        return Rendered([frame_svg(frame, decimals)])
    page = page_of(pairs)
    if spec.animate == "frames":
        from shapeblend_cli.frames.frames import make_frames
        from shapeblend_cli.svg.writing.smil import stacked_svg

        frames = make_frames(pairs, spec.settings.replace(ends=True))
        return Rendered([stacked_svg(frames, timing, len(pairs), decimals, page_for(page, frames[0].view))])
    if not spec.trigger.is_load:
        return _render_reacting(spec, pairs, page)
    shapes = keyframed_shapes(pairs)
    if spec.animate == "css":
        from shapeblend_cli.svg.writing.css import css_svg

        shown = Box.union(boxes)
        return Rendered([css_svg(shapes, shown, timing, decimals, page_for(page, shown))])
    from shapeblend_cli.svg.writing.smil import smil_svg

    return Rendered([smil_svg(shapes, boxes, timing, decimals, page_for(page, boxes[0]))])


def _render_reacting(spec: OutputSpec, pairs: Sequence[Pair], page: Page) -> Rendered:
    """Return an animation that waits for its trigger."""
    from shapeblend_cli.outputs.move import clips_left_out, moves_of
    from shapeblend_cli.svg.writing.reacting import Reaction, reacting_css, reacting_smil

    reaction = Reaction(
        keyframed_shapes(pairs), views(pairs), page_for(page, pairs[0].views[0]), spec.trigger
    )
    decimals = spec.decimals(pairs)
    if spec.animate == "smil":
        return Rendered([reacting_smil(reaction, spec.timing, decimals)])
    (move,) = moves_of(pairs)
    shown = Box.union(reaction.views)
    reaction = reaction._replace(page=page_for(page, shown), views=[shown, shown])
    notes = [
        f"{shape.name}: moves on curved paths, which CSS transitions cannot show; it moves straight"
        for shape in move.shapes
        if shape.waypoints
    ]
    notes += clips_left_out(pairs, "CSS transitions")
    return Rendered([reacting_css(reaction, spec.timing, decimals)], notes)
