"""Other ways to match outlines in which much goes wrong, where the judge prefers them.

The ordinary way may take one limb for another, and a body opens like a mouth, or a head shrinks beside the neck from
which another one grows.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.blending.graded import grade_of_shapes, is_suspect
from shapeblend_cli.blending.matched import pair_drawings
from shapeblend_cli.blending.pairings import partners_in
from shapeblend_cli.blending.parts.paced import with_parts_paced
from shapeblend_cli.blending.plates.inverted import is_plain
from shapeblend_cli.pairing.costs import Rates

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from shapeblend_cli.blending.matched import PairedDrawings
    from shapeblend_cli.model import Box, ShapeBlend

    Shapes = tuple[ShapeBlend, ...]

FLAWED = 0.95
"""Minimum grade of a blend for other ways to be tried, which take as long as all the rest."""

LARGE = 0.5
"""Minimum size of a shape with wrong outlines, in sides of the view: the grade hardly depends on smaller ones."""

IN_PLACE = (60.0, 20.0)
"""Stiffnesses against travel that are tried, with which points stay nearer to their places, the highest first."""

GAINING = 0.05
"""Minimum advantage of a blend with one of them for the next one to be tried, in grades: where the highest one
gains less, the next one hardly ever gains `NEARER`."""

NEARER = 0.12
"""Minimum advantage of a blend whose points stay nearer to their places for it to be taken, in grades."""

TORN = 0.35
"""Minimum advantage of a blend in which outlines are cut to pieces, in grades: the judge hardly sees its slots."""

OUT_OF_REACH = 0.5
"""Minimum distance to the grade up to which a blend is taken for no other stiffness to be tried: few gain it."""

FAR = 0.25
"""Maximum distance from a piece to its partner, in sizes of the largest contour."""


class _Graded(NamedTuple):
    """A blend, and how good it looks."""

    grade: float
    paired: PairedDrawings
    shapes: Shapes
    paced: Shapes  # as they are seen: parts without a partner leave early and come late

    @classmethod
    def of(cls, paired: PairedDrawings, shapes: Shapes, view: Box) -> _Graded:
        """Grade the blend of paired drawings in a view."""
        paced = with_parts_paced(shapes, view.larger_side, None, by_size=True)
        return cls(grade_of_shapes(paced, view), paired, shapes, paced)


def with_other_matches(
    paired: PairedDrawings,
    usual: Shapes,
    move: Callable[[PairedDrawings], Shapes],
    view: Box,
    works: dict[tuple[int, int], float],
    *,
    may_cut: bool,
) -> tuple[PairedDrawings, Shapes]:
    """Return paired drawings and their blend, or those of another way to match that the judge prefers in a view.

    `move` blends paired drawings, and `works` are those that the ordinary pairing has found. Silhouettes, which have
    one colour, are also cut to pieces for the parts of the other one if they `may_cut`: not signs drawn with a pen.
    """
    # Two single outlines hardly ever gain by it, and to draw and grade them takes time.
    is_plain_pair = len(paired.a.contours) == len(paired.b.contours) == 1
    large = [shape for shape in usual if shape.size >= LARGE * view.larger_side]
    if paired.is_fixed or is_plain_pair or not is_suspect(large):
        return paired, usual
    first = _Graded.of(paired, usual, view)
    if first.grade < FLAWED:
        return paired, usual
    least = _nearer(first, move, view)
    found = least if least.grade < first.grade - NEARER else first
    pieces = _in_pieces(paired, works) if may_cut else None
    if pieces is not None:
        lowest, *other = sorted({paired.settings.k_t, least.paired.settings.k_t})
        most = found.grade - TORN
        cut = _best(_graded(_stiffer(pieces, lowest), move, view), other, move, view, most)
        if cut.grade < most:
            found = cut
    return found.paired, found.shapes


def with_points_nearer(
    paired: PairedDrawings, usual: Shapes, move: Callable[[PairedDrawings], Shapes], view: Box, most: float
) -> tuple[Shapes, float]:
    """Return the blend of paired drawings, or one whose points stay nearer to their places if that looks better.

    `move` blends paired drawings. However good the blend is, others are tried, unless it is far from the grade up to
    which it is taken. Its parts without a partner leave early and come late; its grade is returned with it.
    """
    first = _Graded.of(paired, usual, view)
    least = _nearer(first, move, view, most)
    found = least if least.grade < first.grade - NEARER else first
    return found.paced, found.grade


def _nearer(
    usual: _Graded, move: Callable[[PairedDrawings], Shapes], view: Box, most: float = np.inf
) -> _Graded:
    """Return the best one of a blend and those whose points stay nearer to their places."""
    if usual.paired.settings.is_given("k_t"):
        return usual
    return _best(usual, IN_PLACE, move, view, most)


def _best(
    first: _Graded,
    stiffnesses: Sequence[float],
    move: Callable[[PairedDrawings], Shapes],
    view: Box,
    most: float,
) -> _Graded:
    """Return the best one of a blend and those with other stiffnesses, which is taken up to a grade."""
    least = first
    for stiffness in stiffnesses:
        if least.grade > most + OUT_OF_REACH:
            break
        other = _graded(_stiffer(first.paired, stiffness), move, view)
        least = other if other.grade < least.grade else least
        if other.grade > first.grade - GAINING:
            break
    return least


def _graded(paired: PairedDrawings, move: Callable[[PairedDrawings], Shapes], view: Box) -> _Graded:
    """Blend paired drawings in a view, and grade that."""
    return _Graded.of(paired, move(paired), view)


def _stiffer(paired: PairedDrawings, stiffness: float) -> PairedDrawings:
    """Return paired drawings that are matched with another stiffness against travel."""
    if stiffness == paired.settings.k_t:
        return paired
    return paired._replace(settings=paired.settings.replace(k_t=stiffness))


def _in_pieces(paired: PairedDrawings, works: dict[tuple[int, int], float]) -> PairedDrawings | None:
    """Return silhouettes that are cut to pieces for all parts without a partner.

    None if there are none to cut, or if a piece would go far: what is there is another part of the body.
    """
    a, b, settings = paired.a, paired.b, paired.settings
    if settings.is_given("unmatched") or not (is_plain(a) and is_plain(b)):
        return None
    settings = settings.replace(unmatched="split")
    pieces = pair_drawings(a, b, settings, 0.0, paired.progress, rates=Rates(works=works))
    if partners_in(pieces) == partners_in(paired):
        return None
    reach = FAR * max(contour.size for contour in (*a.contours, *b.contours))
    cut = [pair for pair, _ in pieces.pairs.values() if any(one.is_piece for one in pair)]
    return pieces if all(abs(p.centre - q.centre) <= reach for p, q in cut) else None
