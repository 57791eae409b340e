"""Holes of a plate that close before it parts."""

import pytest

from shapeblend_cli.blending.plates.slots import CLOSED
from shapeblend_cli.frames.frames import shapes_at
from shapeblend_cli.grading.painting import picture
from shapeblend_cli.model import Box
from tests.pens.test_line_blends import blend
from tests.support.drawings import filled

VIEW = Box(0.0, 0.0, 24.0, 24.0)
PLATE = "M1 1H23V23H1Z"
SLOTS = "M4 5V7H20V5Z M4 11V13H20V11Z M4 17V19H20V17Z"
CELLS = "M2 2H11V11H2Z M13 2H22V11H13Z M2 13H11V22H2Z M13 13H22V22H13Z"
LIST, GRID = filled(f"{PLATE} {SLOTS}"), filled(CELLS)


def ink(pair, t):
    """Return the share of the view that is painted at a time."""
    return float(picture(shapes_at(pair, t), VIEW)[3].mean())


@pytest.mark.parametrize("backwards", [False, True])
def test_slots_that_a_cut_would_cross_close_before_a_plate_parts(backwards):
    pair = blend(*[LIST, GRID][:: -1 if backwards else 1])
    (shape,) = pair.shapes
    assert sum(contour.reason == CLOSED for contour in shape.contours) == 3
    inks = [ink(pair, 1.0 - t if backwards else t) for t in (0.0, 0.2, 0.4, 0.6, 0.8, 1.0)]
    assert inks[:3] == sorted(inks[:3])
    assert inks[2] == pytest.approx((22 / 24) ** 2, rel=0.01)
    assert inks[2:] == sorted(inks[2:], reverse=True)


def test_holes_beside_the_cut_stay_in_their_parts():
    pair = blend(filled(f"{PLATE} M5 5V7H8V5Z"), GRID)
    assert all(contour.reason != CLOSED for shape in pair.shapes for contour in shape.contours)
