"""The strokes of a region, and their outlines."""

import numpy as np
import pytest

from shapeblend_cli.brushes.areas import Region
from shapeblend_cli.brushes.sides import PIXEL, brushes_of
from shapeblend_cli.brushes.strokes import strokes_of
from tests.support.handwriting import letter_o, letter_s, stroke

RISING = stroke(np.linspace(4.0 + 20.0j, 20.0 + 4.0j, 40), 1.6)
T = np.array([3, 22, 22, 13.5, 13.5, 11.5, 11.5, 3]) + 1j * np.array([3, 3, 5, 5, 18, 18, 5, 5])
CROSS = np.array([11, 13, 13, 22, 22, 13, 13, 11, 11, 2, 2, 11]) + 1j * np.array(
    [2, 2, 11, 11, 13, 13, 22, 22, 13, 13, 11, 11]
)
BAR = np.array([-8.0 - 1.5j, 8.0 - 1.5j, 8.0 + 1.5j, -8.0 + 1.5j])
DOT = 12.0 + 12.0j + 1.5 * np.exp(1j * np.linspace(0.0, 2.0 * np.pi, 40, endpoint=False))


def region(*rings):
    """A region with an exterior and holes, with it on their left."""
    every = []
    for k, ring in enumerate(rings):
        area = float((ring.conj() * np.roll(ring, -1)).imag.sum())
        every.append(ring if (area > 0.0) == (k == 0) else ring[::-1])
    return Region(0, every)


def kinds(area):
    """Of each stroke whether it is closed and which of its ends are free, the longest first."""
    found = sorted(strokes_of(area), key=lambda one: -np.abs(np.diff(one.points)).sum())
    return [(one.closed, sorted(one.is_free)) for one in found]


@pytest.mark.parametrize(
    ("rings", "strokes"),
    [
        ([RISING], [(False, [True, True])]),
        ([letter_s()], [(False, [True, True])]),
        (letter_o(), [(True, [False, False])]),
        ([CROSS], [(False, [True, True])] * 2),
        ([T], [(False, [True, True]), (False, [False, True])]),
        ([DOT], [(False, [True, True])]),
    ],
)
def test_strokes(rings, strokes):
    area = region(*rings)
    assert kinds(area) == strokes


@pytest.mark.parametrize("degrees", [0, 60, 120, 240, 300])
def test_a_bar_with_corners_is_one_stroke_in_any_direction(degrees):
    bar = BAR * np.exp(1j * np.radians(degrees)) + 12.0 + 12.0j
    assert kinds(region(bar)) == [(False, [True, True])]


@pytest.mark.parametrize("rings", [[RISING], [letter_s()], letter_o(), [CROSS], [T], [DOT]])
def test_strokes_paint_the_region(rings):
    area = region(*rings)
    brushes = brushes_of(area, strokes_of(area))
    off = area.unlike([brush.polygon for brush in brushes], PIXEL) * PIXEL**2
    assert off < 0.02 * area.area


def test_a_centre_line_is_in_the_middle():
    (line,) = strokes_of(region(RISING))
    assert np.abs((line.points * np.exp(0.25j * np.pi)).imag - (12.0 + 12.0j).imag * 2.0**0.5).max() < 0.05
