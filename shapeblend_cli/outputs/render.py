"""What is made of a blend: from frames and pairs to the contents of files."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from shapeblend_cli.interpolate.chains import keyframed_shapes
from shapeblend_cli.interpolate.paths import waypoints
from shapeblend_cli.model import Box
from shapeblend_cli.outputs.raster_options import ANIMATED, PICTURES, WIDTHS
from shapeblend_cli.outputs.times import run_for
from shapeblend_cli.paint.colours import colour_stops
from shapeblend_cli.pipeline import make_frames, shapes_at
from shapeblend_cli.svg.writing.css import css_svg
from shapeblend_cli.svg.writing.document import frame_svg
from shapeblend_cli.svg.writing.rounding import decimals_for
from shapeblend_cli.svg.writing.smil import smil_svg, stacked_svg

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.easing import Timing
    from shapeblend_cli.model import Frame, Pair
    from shapeblend_cli.outputs.raster_options import RasterOptions
    from shapeblend_cli.settings import Settings


class OutputSpec(NamedTuple):
    """What is to be made of a blend.

    Attributes
    ----------
    kind : str
        See `outputs.formats.kind_of`.
    animate : {'smil', 'css', 'frames'}
        How an animated SVG moves.
    timing : Timing
        Of what moves.
    precision : int or None
        Decimals of coordinates; None for as many as the drawings' size asks for.
    choice : RasterOptions
        How pictures are drawn.
    """

    kind: str
    animate: str
    timing: Timing
    precision: int | None
    choice: RasterOptions


def render(
    spec: OutputSpec, pairs: Sequence[Pair], frames: Sequence[Frame], settings: Settings
) -> tuple[list[str | bytes], list[str]]:
    """Make what is wanted.

    Parameters
    ----------
    spec : OutputSpec
    pairs : sequence of Pair
    frames : sequence of Frame
        Of these pairs, by these settings.
    settings : Settings

    Returns
    -------
    contents : list of str or bytes
        In the order of `outputs.formats.file_names`.
    notes : list of str
        What the form cannot say, a phrase each.

    Raises
    ------
    PictureError
        Pictures without a height, or of too many pixels.
    """
    views = [pairs[0].views[0], *(pair.views[1] for pair in pairs)]
    decimals = decimals_for(views) if spec.precision is None else spec.precision
    if spec.kind == "svg":
        return [frame_svg(frame, decimals) for frame in frames], []
    if spec.kind == "animation":
        return [_animation(spec, pairs, views, settings, decimals)], []
    if spec.kind in PICTURES:
        return _pictures(spec, pairs, frames, settings, decimals), []
    return _emitted(spec, pairs, decimals)


def _animation(
    spec: OutputSpec, pairs: Sequence[Pair], views: Sequence[Box], settings: Settings, decimals: int
) -> str:
    """An animated SVG."""
    if spec.animate == "frames":
        frames = make_frames(pairs, settings.replace(ends=True))
        return stacked_svg(frames, spec.timing, len(pairs), decimals)
    moving = keyframed_shapes(pairs)
    if spec.animate == "css":
        return css_svg(moving, Box.union(views), spec.timing, decimals, colour_stops)
    return smil_svg(moving, views, spec.timing, decimals, colour_stops)


def _pictures(
    spec: OutputSpec, pairs: Sequence[Pair], frames: Sequence[Frame], settings: Settings, decimals: int
) -> list[str | bytes]:
    """Pictures of pixels, as high as what is shown of the first drawing makes them."""
    from shapeblend_cli.outputs.contact_sheet import PAGE, as_png, sheet
    from shapeblend_cli.outputs.raster import check_pixels, drawn, size_for
    from shapeblend_cli.outputs.raster_animations import animation

    kind, choice = spec.kind, spec.choice
    view = pairs[0].views[0]
    ground = choice.ground
    size = size_for(choice.width or WIDTHS[kind], (view.width, view.height))
    if kind in ANIMATED:
        timing = spec.timing
        run = run_for(choice.fps, settings.frames, len(pairs), timing.seconds, timing.is_pingpong)
        check_pixels(run.pictures, size)
        frames = make_frames(pairs, settings.replace(frames=run.steps - 1, ends=True))
        svgs = [frame_svg(frame, decimals) for frame in frames]
        runs = timing.repeat if isinstance(timing.repeat, int) else None
        return [animation(kind, svgs, size, run, runs, ground)]
    check_pixels(len(frames), size)
    svgs = [frame_svg(frame, decimals) for frame in frames]
    if kind == "png":
        return [drawn(svg, size, ground) for svg in svgs]
    return [as_png(sheet(svgs, size, choice.columns, ground, PAGE if ground else None))]


def _emitted(spec: OutputSpec, pairs: Sequence[Pair], decimals: int) -> tuple[list[str | bytes], list[str]]:
    """A form for other programs."""
    from shapeblend_cli.outputs.move import Move
    from shapeblend_cli.outputs.other_programs import emitted

    moves = [
        Move(shapes_at(pair, 0.0), shapes_at(pair, 1.0), pair.views, tuple(map(waypoints, pair.shapes)))
        for pair in pairs
    ]
    texts, notes = emitted(spec.kind, moves, spec.timing.seconds, spec.timing.ease, decimals)
    return [*texts], notes
