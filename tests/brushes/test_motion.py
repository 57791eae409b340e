"""How brush strokes move."""

import numpy as np
import pytest

from shapeblend_cli.brushes.areas import Region
from shapeblend_cli.brushes.sides import brushes_of
from shapeblend_cli.brushes.stroke_blends import matched, paired_strokes, vertices_of
from shapeblend_cli.brushes.strokes import strokes_of
from shapeblend_cli.geometry.polygons import signed_area
from tests.support.handwriting import letter_s, stroke

BAR = stroke(np.linspace(3.0 + 12.0j, 21.0 + 12.0j, 40), 1.6)
POST = stroke(np.linspace(12.0 + 3.0j, 12.0 + 21.0j, 40), 1.6)
SHORT = stroke(np.linspace(12.0 + 12.0j, 12.0 + 20.0j, 40), 1.6)


def brushes(*rings):
    """Strokes, each a region of its own."""
    regions = [Region(k, [ring if signed_area(ring) > 0.0 else ring[::-1]]) for k, ring in enumerate(rings)]
    return [brush for region in regions for brush in brushes_of(region, strokes_of(region))]


def becoming(a, b, turns=False):
    """How strokes become others."""
    paired = paired_strokes(a, b)
    return matched(paired, vertices_of(paired), turns=turns)


def widths(outline, at):
    """How wide an outline is along the line at a height, or at each of some."""
    following = np.roll(outline, -1)
    found = []
    for y in np.atleast_1d(at):
        crossed = (outline.imag <= y) != (following.imag <= y)
        p, q = outline[crossed], following[crossed]
        found.append(np.ptp(p.real + (q.real - p.real) * (y - p.imag) / (q.imag - p.imag)))
    return np.array(found)


@pytest.mark.parametrize("turns", [False, True])
def test_strokes_keep_their_width(turns):
    found = becoming(brushes(letter_s()), brushes(POST), turns)
    assert found.pairs == [(0, 0)]
    (outline,) = found.motion.outlines(0.9)
    assert np.abs(widths(outline, [9.0, 12.0, 15.0]) - 1.6).max() < 0.4


def test_both_ends_are_exact():
    a, b = brushes(letter_s()), brushes(POST)
    found = becoming(a, b)
    for t, (brush,) in ((0.0, a), (1.0, b)):
        (outline,) = found.motion.outlines(t)
        assert abs(signed_area(outline)) == pytest.approx(abs(signed_area(brush.polygon)), rel=0.01)


def test_a_stroke_that_turns_keeps_its_length():
    found = becoming(brushes(BAR), brushes(POST), turns=True)
    (outline,) = found.motion.outlines(0.5)
    assert np.abs(outline[:, None] - outline).max() > 17.0


def test_strokes_in_parts_of_their_own_come_in_place():
    found = becoming(brushes(POST), brushes(POST, SHORT + 6.0))
    assert found.pairs == [(0, 0), (None, 1)]
    early, late = (found.motion.outlines(t)[1] for t in (0.2, 0.9))
    assert np.ptp(early.imag) < 0.5 * np.ptp(late.imag)
    assert abs(early.mean() - (18.0 + 16.0j)) < 0.5


def test_dots_become_only_dots():
    dot = 12.0 + 3.0j + 1.2 * np.exp(2j * np.pi * np.arange(40) / 40.0)
    found = becoming(brushes(dot, SHORT), brushes(POST))
    assert sorted(found.pairs, key=str) == [(0, None), (1, 0)]


def test_what_is_scaled_is_as_many_times_as_large():
    motion = becoming(brushes(letter_s(), BAR), brushes(POST)).motion
    for one, other in zip(motion.outlines(0.3), motion.scaled(2.0).outlines(0.3), strict=True):
        assert np.abs(2.0 * one - other).max() < 1e-9
