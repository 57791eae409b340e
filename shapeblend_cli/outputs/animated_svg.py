"""One SVG document that moves by SMIL, by CSS, or as frames that are visible in turn; and a JavaScript module."""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING

from shapeblend_cli.errors import OptionError
from shapeblend_cli.interpolate.chains import keyframed_shapes
from shapeblend_cli.model import Box
from shapeblend_cli.options.easing import FOREVER, Timing
from shapeblend_cli.outputs.formats import STANDARD_OUTPUT, OutputSpec, Rendered, page_of, views
from shapeblend_cli.paint.names import page_for
from shapeblend_cli.svg.writing.animation import Views

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import Page, Pair
    from shapeblend_cli.options.easing import Knots


FINER = 4.0
"""Ratio of the tolerances of paths in animations and in modules, which programs may show at any size."""


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
    shapes = keyframed_shapes(spec.eased(pairs))
    if spec.animate == "css":
        from shapeblend_cli.svg.writing.css import css_svg

        shown = Box.union(boxes)
        return Rendered([css_svg(shapes, shown, timing, decimals, page_for(page, shown))])
    from shapeblend_cli.svg.writing.smil import smil_svg

    seen = shown_views(boxes, spec.knots)
    return Rendered([smil_svg(shapes, seen, timing, decimals, page_for(page, boxes[0]))])


def check_module(spec: OutputSpec) -> None:
    """Raise OptionError for what a module leaves to its page."""
    timing = spec.timing
    if timing.rests or timing.delay or timing.repeat != FOREVER:
        raise OptionError(
            "a JavaScript module plays as its page says, with the options loop and alternate; it would work "
            "without --repeat, --hold and --delay"
        )


def render_module(spec: OutputSpec, pairs: Sequence[Pair]) -> Rendered:
    """Return a JavaScript module, which moves the same attributes as SMIL does."""
    from shapeblend_cli.svg.writing.smil import smil_svg
    from shapeblend_cli.web.module import module_js

    boxes, decimals = views(pairs), spec.decimals(pairs)
    shapes, seen = keyframed_shapes(spec.eased(pairs), FINER), shown_views(boxes, spec.knots)
    page = page_for(page_of(pairs), boxes[0])
    animated = smil_svg(shapes, seen, Timing(repeat=1), decimals, page, stops=False)
    name = "blend.js" if spec.path == STANDARD_OUTPUT else Path(spec.path).name
    return Rendered([module_js(animated, spec.timing, len(pairs), decimals, name)])


def _render_reacting(spec: OutputSpec, pairs: Sequence[Pair], page: Page) -> Rendered:
    """Return an animation that waits for its trigger."""
    from shapeblend_cli.outputs.move import left_out, moves_of, without_pictures
    from shapeblend_cli.paint.effects import pair_without_effects
    from shapeblend_cli.svg.writing.reacting import Reaction, reacting_css, reacting_smil

    decimals, called = spec.decimals(pairs), page_for(page, pairs[0].views[0])
    if spec.animate == "smil":
        seen = shown_views(views(pairs), spec.knots)
        reaction = Reaction(keyframed_shapes(spec.eased(pairs)), seen, called, spec.trigger)
        return Rendered([reacting_smil(reaction, spec.timing, decimals)])
    pairs, lost = without_pictures(pairs, "CSS transitions")
    bare = [pair_without_effects(pair) for pair in pairs]
    reaction = Reaction(keyframed_shapes(bare), Views(views(pairs)), called, spec.trigger)
    (move,) = moves_of(pairs)
    shown = Box.union(reaction.views.boxes)
    reaction = reaction._replace(page=page_for(page, shown), views=Views([shown, shown]))
    notes = [
        f"{shape.name}: moves on curved paths, which CSS transitions cannot show; it moves straight"
        for shape in move.shapes
        if shape.waypoints
    ]
    notes = [*lost, *notes, *left_out(pairs, "CSS transitions", clips="all")]
    return Rendered([reacting_css(reaction, spec.timing, spec.settings.ease, decimals)], notes)


def shown_views(boxes: Sequence[Box], knots: Knots) -> Views:
    """Return what is shown at each drawing, and with knots of easing at these, never more than at the drawings."""
    if not knots:
        return Views(boxes)
    times, shown = [0.0], [boxes[0]]
    for k, (start, end) in enumerate(pairwise(boxes)):
        for time, share in knots[1:]:
            times.append(k + time)
            shown.append(start.interpolate(end, min(max(share, 0.0), 1.0)))
    return Views(shown, times)
