"""The stages in their order: place, flatten, pair, match, move, interpolate. Files are read before and written after.

Each stage is a function from values to values. Polygons are normalised, section 3.3, where their work is compared.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from shapeblend_cli.anatomy import decompose
from shapeblend_cli.anatomy.pieces import with_areas
from shapeblend_cli.blending.blended import blend_shapes, with_lines_in_common
from shapeblend_cli.blending.clipping import has_clips, with_clips
from shapeblend_cli.blending.matched import Progress
from shapeblend_cli.blending.placing import lay
from shapeblend_cli.frames.views import with_room
from shapeblend_cli.model import Box, Pair
from shapeblend_cli.options.easing import knots_of
from shapeblend_cli.paint.names import with_names
from shapeblend_cli.system.clock import Clock
from shapeblend_cli.system.kept import Kept
from shapeblend_cli.wires.constraints import check_stiff

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from shapeblend_cli.blending.placing import LaidDrawing
    from shapeblend_cli.model import Drawing
    from shapeblend_cli.options.settings import Settings


def match_all(
    drawings: Sequence[Drawing],
    settings: Settings,
    clock: Clock | None = None,
    watch: Callable[[str, float], None] = lambda stage, share: None,
    kept: Kept | None = None,
) -> tuple[list[Pair], list[str]]:
    """Blend drawings, each with the next one, or to mix them with the first: everything up to the first frame.

    Parameters
    ----------
    drawings : sequence of Drawing
        Two or more; all are laid over the first.
    settings : Settings
    clock : Clock, optional
        Measures the stages `flatten`, `match` and `interpolate`.
    watch : callable, optional
        Called now and then with the name of a stage and the share of it that is done, from 0 to 1.
    kept : Kept, optional
        Contours of drawings that were flattened before.

    Returns
    -------
    pairs : list of Pair
    notes : list of str
        What was left out, one phrase each.
    """
    clock, kept = clock or Clock(), kept or Kept(0)
    drawings, specks = to_blend(drawings, settings)
    if settings.mix and (len(drawings) > 2 or settings.is_star):
        drawings, left_out = _without_pictures(drawings)
        specks = [*specks, *left_out]
    if settings.mix:
        drawings, settings = _mixed(drawings, settings)
    watch("flattening", 0.0)
    laid, notes = lay(drawings, settings, kept)
    check_stiff([contour.polygon for contour in laid[0].placed.contours], settings)
    clock.lap("flatten")
    mixes = settings.has_states or (len(laid) > 2 and bool(settings.mix))

    def matched(settings: Settings) -> list[Pair]:
        count = len(laid) - 1
        parts = [Progress(clock, kept.steps, watch, (k, count), kept) for k in range(count)]
        return [_pair(laid, 0 if mixes else k, k + 1, settings, part) for k, part in enumerate(parts)]

    pairs = matched(settings)
    if settings.mix and settings.motion == "linear" and settings.strokes != "keep":
        # Lines have to be found in all pairs or in none.
        found = with_lines_in_common(pairs, laid[0].placed)
        if found is None:
            found = with_lines_in_common(matched(settings.replace(strokes="recover")), laid[0].placed)
        pairs = matched(settings.replace(strokes="keep")) if found is None else found
    pairs = with_room(pairs, settings.viewbox)
    if not mixes:
        pairs = [with_clips(pair, settings, watch) if has_clips(pair) else pair for pair in pairs]
    elif any(map(has_clips, pairs)):
        notes = [*notes, "clip paths are left out of mixtures and states; frames and animated SVGs have them"]
    if settings.warp != "off" and any(shape.style_a.picture for pair in pairs for shape in pair.shapes):
        pairs, not_bent = _bent(pairs, settings.warp)
        notes = [*notes, *not_bent]
    if settings.has_spans:
        from shapeblend_cli.frames.stagger import eased, staggered, timed

        if settings.stagger:
            pairs = [staggered(pair, settings.stagger, settings.stagger_by) for pair in pairs]
        else:
            pairs = timed(pairs, drawings, settings.timing)
        if settings.eases_parts:
            pairs = [eased(pair, knots_of(settings.ease), each=True) for pair in pairs]
    pairs = with_names(pairs, drawings)
    if any(shape.effects for drawing in drawings for shape in drawing.shapes):
        pairs, others = _with_effects(pairs, mixes, settings, watch)
        notes = [*notes, *others]
    return pairs, [*specks, *notes]


def _with_effects(
    pairs: Sequence[Pair], mixes: bool, settings: Settings, watch: Callable[[str, float], None]
) -> tuple[list[Pair], list[str]]:
    """Return pairs with filters and all else that is done to groups, and notes on what is not as it was."""
    from shapeblend_cli.blending.clipping import with_effect_clips
    from shapeblend_cli.paint.effects import has_effects, pair_without_effects, with_effects

    if mixes:
        left_out = (
            "filters and blend modes are left out of mixtures and states; frames and animated SVGs have them"
        )
        grouped = [with_effects(pair)[0] if has_effects(pair) else pair for pair in pairs]
        return [pair_without_effects(pair) for pair in grouped], [left_out]
    found, notes = [], dict[str, None]()
    for pair in pairs:
        if has_effects(pair):
            pair, own = with_effects(pair)
            pair = with_effect_clips(pair, settings, watch)
            notes |= dict.fromkeys(own)
        found.append(pair)
    return found, [*notes]


def _pair(laid: Sequence[LaidDrawing], i: int, k: int, settings: Settings, progress: Progress) -> Pair:
    """Blend two of several drawings."""
    a, b = laid[i], laid[k]
    view = Box.union([a.view, b.view])
    if _has_pictures(a) or _has_pictures(b):
        from shapeblend_cli.blending.images.picture_blends import blend_with_pictures  # few drawings have any

        shapes = blend_with_pictures(a.placed, b.placed, settings, view, progress)
    else:
        shapes = blend_shapes(a.placed, b.placed, settings, view, progress)
    if settings.motion == "auto" and any(shape.motion_name in ("rigid", "pen") for shape in shapes):
        from shapeblend_cli.blending.kept_in_view import kept_in_view  # many drawings do not turn

        shapes = kept_in_view(shapes, view)
    progress.clock.lap("interpolate")
    return Pair(i, k, shapes, (a.painted, b.painted), (a.view, b.view), (a.page, b.page))


def _has_pictures(laid: LaidDrawing) -> bool:
    return any(contour.style.picture is not None for contour in laid.placed.contours)


def _without_pictures(drawings: Sequence[Drawing]) -> tuple[Sequence[Drawing], list[str]]:
    """Return drawings for a mixture, and a note if they had pictures."""
    if not any(shape.style.picture for drawing in drawings for shape in drawing.shapes):
        return drawings, []
    from shapeblend_cli.blending.images.picture_blends import without_pictures

    note = "pictures are left out of mixtures and states; frames and animated SVGs have them"
    return [without_pictures(drawing) for drawing in drawings], [note]


def _bent(pairs: list[Pair], warp: str) -> tuple[list[Pair], list[str]]:
    """Return pairs with the bending of their pictures, and notes."""
    from shapeblend_cli.blending.images.warping import with_bends

    found = [with_bends(pair, warp) for pair in pairs]
    return [pair for pair, _ in found], list(dict.fromkeys(note for _, notes in found for note in notes))


def to_blend(drawings: Sequence[Drawing], settings: Settings) -> tuple[Sequence[Drawing], list[str]]:
    """Return what is blended of drawings, with its numbers, and notes on specks that are left out."""
    drawings = [with_areas(drawing) for drawing in _with_kept_text(drawings, settings)]
    if settings.specks is None:
        return drawings, []
    found = [decompose.without_specks(drawing, settings.specks) for drawing in drawings]
    return [drawing for drawing, _ in found], [note for _, notes in found for note in notes]


def _with_kept_text(drawings: Sequence[Drawing], settings: Settings) -> Sequence[Drawing]:
    """Return drawings with one shape for each text that stays text, if they were read so; mixtures have letters."""
    if settings.mix or not any(shape.whole for shape in drawings[0].shapes):
        return drawings
    from shapeblend_cli.blending.images.kept_text import with_common_texts  # few runs keep text

    return with_common_texts(drawings)


def _mixed(drawings: Sequence[Drawing], settings: Settings) -> tuple[list[Drawing], Settings]:
    """Return the drawings that are in some mixture, and settings for these.

    If there are more than two, outlines stay whole and move straight: a turn between two drawings would be another one
    between two others.
    """
    from shapeblend_cli.interpolate.stars import drawings_in  # most runs make no mixtures

    used = drawings_in(settings.mix)
    if len(used) > 2:
        settings = settings.replace(motion="linear", unmatched="point")
    return [drawings[k] for k in used], settings
