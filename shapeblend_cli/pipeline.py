"""The stages in their order: place, flatten, pair, match, move, interpolate. Files are read before and written after.

Each stage is a function from values to values. Polygons are normalised, section 3.3, where their work is compared.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from shapeblend_cli.anatomy.decompose import without_specks
from shapeblend_cli.blending.blended import blend_shapes
from shapeblend_cli.blending.clipping import has_clips, with_clips
from shapeblend_cli.blending.placing import as_drawn, flattened, pages_of, place, views_of
from shapeblend_cli.frames.stagger import staggered
from shapeblend_cli.frames.views import views_with_room
from shapeblend_cli.interpolate.stars import drawings_in
from shapeblend_cli.model import Box, Pair
from shapeblend_cli.paint.names import with_names
from shapeblend_cli.system.clock import Clock
from shapeblend_cli.system.kept import Kept
from shapeblend_cli.wires.constraints import check_stiff
from shapeblend_cli.wires.direction import watch_part

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import Drawing
    from shapeblend_cli.options.settings import Settings
    from shapeblend_cli.wires.direction import Watch


def match_all(
    drawings: Sequence[Drawing],
    settings: Settings,
    clock: Clock | None = None,
    watch: Watch | None = None,
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
        Called now and then with the share of the matching that is done, from 0 to 1.
    kept : Kept, optional
        Contours of drawings that were flattened before.

    Returns
    -------
    pairs : list of Pair
    notes : list of str
        What was left out, one phrase each.
    """
    clock, kept = clock or Clock(), kept or Kept(0)
    specks: list[str] = []
    if settings.specks is not None:
        found = [without_specks(drawing, settings.specks) for drawing in drawings]
        drawings, specks = [drawing for drawing, _ in found], [text for _, texts in found for text in texts]
    if settings.mix:
        drawings, settings = _mixed(drawings, settings)
    if len(drawings) > 2:  # a line that is cut for one pair is not the line that the next pair begins with
        settings = settings.replace(strokes="keep")
    maps = place(drawings, settings.place)
    flat, notes = flattened(drawings, maps, settings.vertices, kept)
    check_stiff([contour.polygon for contour in flat[0].contours], settings)
    drawn = [as_drawn(drawing, to_a) for drawing, to_a in zip(drawings, maps, strict=True)]
    views = views_of(drawings, maps, drawn, settings)
    clock.lap("flatten")
    pairs = []
    is_star = len(flat) > 2 and bool(settings.mix)
    for k in range(1, len(flat)):
        i = 0 if is_star else k - 1
        view = Box.union([views[i], views[k]])
        progress = clock, watch_part(watch, k - 1, len(flat) - 1)
        shapes = blend_shapes(flat[i], flat[k], settings, view, progress, kept.steps)
        pairs.append(Pair(i, k, shapes, drawn=(drawn[i], drawn[k]), views=(views[i], views[k])))
        clock.lap("interpolate")
    views = views_with_room(pairs, settings.viewbox)
    pages = pages_of(drawings, maps, settings.place)
    pairs = [
        pair._replace(views=(views[pair.a], views[pair.b]), pages=(pages[pair.a], pages[pair.b]))
        for pair in pairs
    ]
    if not is_star:
        pairs = [with_clips(pair, settings) if has_clips(pair) else pair for pair in pairs]
    elif any(map(has_clips, pairs)):
        notes = [*notes, "clip paths are left out of mixtures and states; frames and animated SVGs have them"]
    if settings.stagger:
        pairs = [staggered(pair, settings.stagger, settings.stagger_by) for pair in pairs]
    return with_names(pairs, drawings), [*specks, *notes]


def _mixed(drawings: Sequence[Drawing], settings: Settings) -> tuple[list[Drawing], Settings]:
    """Return the drawings that are in some mixture, and settings for these.

    Two are blended as ever. More go straight, since what turns between two drawings turns otherwise between others, and
    each outline stays whole.
    """
    used = drawings_in(settings.mix)
    if len(used) > 2:
        settings = settings.replace(motion="linear", unmatched="point")
    return [drawings[k] for k in used], settings
