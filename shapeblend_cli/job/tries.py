"""Other blends of the same drawings, for people who choose by eye in two seconds."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from shapeblend_cli.blending.graded import grade_of
from shapeblend_cli.errors import MatchError
from shapeblend_cli.frames.frames import frame_at, shapes_at
from shapeblend_cli.geometry import cubics
from shapeblend_cli.geometry.polygons import ring_edges
from shapeblend_cli.geometry.raster import winding_grid
from shapeblend_cli.model import Box
from shapeblend_cli.pipeline import match_all
from shapeblend_cli.svg.writing.document import frame_svg
from shapeblend_cli.svg.writing.figure import Row, sheet
from shapeblend_cli.svg.writing.rounding import decimals_for

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from shapeblend_cli.model import BoolArray, Drawing, IntArray, PaintedShape, Pair
    from shapeblend_cli.options.settings import Settings

WAYS: Mapping[str, dict[str, Any]] = {
    "Strokes stay strokes": {"strokes": "keep"},
    "Every point goes straight": {"motion": "linear"},
    "Bends as limbs do": {"motion": "intrinsic"},
    "Turns in one piece": {"motion": "rigid"},
    "As in the paper": {"preset": "paper"},
    "Lone parts grow from points": {"unmatched": "point"},
    "Parts split and join": {"unmatched": "split"},
    "One takes the other's place": {"swap": "always"},
    "Lines bend, however much": {"swap": "never"},
    "B in the frame of A": {"place": "bbox"},
    "Corners bend more easily": {"k_b": 0.3},
    "Points may go far": {"k_t": 0.0},
}
"""Settings that are tried one at a time, unless they are given, by what they do."""

TIMES = tuple(k / 8 for k in range(9))
"""Moments of a blend on a sheet."""

CHORDS = 8
"""Number of chords of each segment in coarse pictures."""

SIDE = 48
"""Points along the larger side of the grid on which two blends are compared."""

DIFFERENT = 0.03
"""Minimum visible difference of two blends at some moment, as a share of the painted area."""

NEAR = 1
"""Maximum distance at which the same paint is in the same place for the eye, in steps of the grid: thin lines that lie
beside each other by less have no point in common, and yet look the same."""

LARGER_SIDE = 96.0
"""Larger side of a picture on a sheet, in pixels."""


class Try(NamedTuple):
    """A blend, what sets it apart, the options that give it, and its grade."""

    name: str
    options: str
    grade: float
    pair: Pair
    changed: dict[str, Any]  # values of settings by name


def tries(drawings: Sequence[Drawing], settings: Settings, pair: Pair) -> list[Try]:
    """Return the blend of two drawings and those others that differ from it and from each other to the eye.

    The one at hand comes first, then the others, the best first.
    """
    found = [Try("As it is", "as it is", grade_of(pair).number, pair, {})]
    seen = [_pictures(pair)]
    for name, changed in WAYS.items():
        if any(settings.is_given(name) for name in changed):
            continue
        try:
            (other,), _ = match_all(drawings, settings.replace(**changed))
        except MatchError:
            continue
        pictures = _pictures(other)
        if all(_differ(pictures, known) for known in seen):
            seen.append(pictures)
            found.append(Try(name, _as_typed(settings, changed), grade_of(other).number, other, changed))
    return [found[0], *sorted(found[1:], key=lambda one: one.grade)]


def tries_sheet(found: Sequence[Try], *, as_drawn: bool) -> str:
    """Return an SVG document with a row for each blend: its number, the options that give it, and its moments."""
    rows = [Row(f"{one.grade:.1f}  {one.options}", moments(one.pair, as_drawn=as_drawn)) for one in found]
    return sheet(rows, *size_on_sheet(found[0].pair.views[0]))


def moments(pair: Pair, *, as_drawn: bool) -> list[str]:
    """Return a blend at the moments that a sheet shows, as SVG documents of one view."""
    frames = [frame_at(pair, t, as_drawn=as_drawn) for t in TIMES]
    view = Box.union([frame.view for frame in frames])
    decimals = decimals_for([view])
    return [frame_svg(frame.picture._replace(view=view), decimals) for frame in frames]


def size_on_sheet(view: Box) -> tuple[float, float]:
    """Return how wide and high pictures of a view are on a sheet, in pixels."""
    scale = LARGER_SIDE / view.larger_side
    return view.width * scale, view.height * scale


def _as_typed(settings: Settings, changed: dict[str, Any]) -> str:
    flags = {name: settings.options[name].flags[-1] for name in changed}
    return " ".join(
        f"{flags[name]} {value:g}" if isinstance(value, float) else f"{flags[name]} {value}"
        for name, value in changed.items()
    )


def _pictures(pair: Pair) -> list[IntArray]:
    """Return coarse pictures of a blend at moments within: which paint is uppermost at each point."""
    view = Box.union(list(pair.views))
    return [_picture(shapes_at(pair, t), view) for t in TIMES[2:-1:2]]


def _picture(shapes: Sequence[PaintedShape], view: Box) -> IntArray:
    step = view.larger_side / SIDE
    corner = complex(view.x, view.y)
    picture = np.zeros((SIDE, SIDE), np.intp)
    for shape in shapes:
        paint = shape.style
        rings = [cubics.polyline(path.segments, CHORDS) for path in shape.paths]
        if paint.fill is not None:
            starts, ends = ring_edges(rings)
            picture[winding_grid(starts, ends, corner, step, SIDE) != 0] = _number(paint.fill)
        if paint.stroke is not None:
            at = (np.concatenate(rings) - corner) / step
            row, column = at.imag.astype(np.intp), at.real.astype(np.intp)
            inside = (row >= 0) & (row < SIDE) & (column >= 0) & (column < SIDE)
            picture[row[inside], column[inside]] = _number(paint.stroke)
    return picture


def _number(colour: str) -> int:
    return 1 + int(colour.lstrip("#"), 16)


def _differ(a: Sequence[IntArray], b: Sequence[IntArray]) -> bool:
    """Return whether pictures of two blends differ at some moment, in what they paint."""
    return any(
        np.count_nonzero(_lacks(p, q) | _lacks(q, p)) > DIFFERENT * np.count_nonzero(p | q)
        for p, q in zip(a, b, strict=True)
    )


def _lacks(picture: IntArray, other: IntArray) -> BoolArray:
    """Return the points of a picture whose paint another picture does not have there, nor near."""
    padded = np.pad(other, NEAR, mode="edge")
    rows, columns = other.shape
    places = [slice(start, None) for start in range(2 * NEAR + 1)]
    found = np.zeros(other.shape, bool)
    for down in places:
        for right in places:
            found |= padded[down, right][:rows, :columns] == picture
    return ~found
