"""Gaps around islands that close."""

import numpy as np
import pytest

from shapeblend_cli.blending.plates import gaps
from shapeblend_cli.blending.plates.gaps import CLOSED
from shapeblend_cli.frames.frames import shapes_at
from shapeblend_cli.grading.painting import picture
from shapeblend_cli.model import Box, control_box
from shapeblend_cli.pens.moves import DRAWN_BACK, DRAWN_ON
from tests.pens.test_line_blends import blend
from tests.support.drawings import filled

PLATE = "M1 1H23V23H1Z"
HOLE, ISLAND = "M12 3A9 9 0 1 1 12 21A9 9 0 1 1 12 3Z", "M12 6A6 6 0 1 0 12 18A6 6 0 1 0 12 6Z"
SIGN = "M11 7H13V11H17V13H13V17H11V13H7V11H11Z"
VIEW = Box(0.0, 0.0, 24.0, 24.0)
RING, SOLID = filled(f"{PLATE} {HOLE} {ISLAND}"), filled(f"{PLATE} {SIGN}")


def ink(pair, t):
    """Return the share of the view that is painted at a time."""
    return float(picture(shapes_at(pair, t), VIEW)[3].mean())


@pytest.fixture(autouse=True)
def looked_for(monkeypatch):
    """Look for gaps whatever the usual blend is like."""
    monkeypatch.setattr(gaps, "SHIPS", 0.0)


@pytest.mark.parametrize("backwards", [False, True])
def test_a_gap_closes_before_a_sign_opens(backwards):
    pair = blend(*[RING, SOLID][:: -1 if backwards else 1])
    assert [shape.reason for shape in pair.shapes] == [CLOSED]
    inks = [ink(pair, 1.0 - t if backwards else t) for t in (0.0, 0.1, 0.2, 0.3, 0.4, 0.6, 0.8, 1.0)]
    assert (np.diff(inks[:5]) > 0.0).all()
    assert (np.diff(inks[4:]) < 0.0).all()
    assert inks[4] == pytest.approx((22 / 24) ** 2, rel=0.01)


def test_a_hole_that_stays_is_no_gap_that_closes():
    pair = blend(RING, filled(f"{PLATE} {HOLE}"))
    assert all(shape.reason != CLOSED for shape in pair.shapes)


def test_two_islands_are_no_gap():
    islands = "M8 11H10V13H8Z M14 11H16V13H14Z"
    assert all(shape.reason != CLOSED for shape in blend(filled(f"{PLATE} {HOLE} {islands}"), SOLID).shapes)


def test_a_usual_blend_that_can_ship_stays(monkeypatch):
    monkeypatch.setattr(gaps, "SHIPS", 3.1)
    assert all(shape.reason != CLOSED for shape in blend(RING, SOLID).shapes)


HANDLE = "M16.319 14.905L22.021 20.607L20.607 22.021L14.905 16.319"
LENS, DISC = "M10 4A6 6 0 1 0 10 16A6 6 0 1 0 10 4Z", "M10 5.5A4.5 4.5 0 1 1 10 14.5A4.5 4.5 0 1 1 10 5.5Z"
GLASS = filled(f"{HANDLE}A8 8 0 1 1 16.319 14.905Z {LENS} {DISC}")


@pytest.mark.parametrize("backwards", [False, True])
def test_a_handle_is_drawn_back_while_the_ring_becomes_a_plate(backwards, monkeypatch):
    monkeypatch.setattr(gaps, "SHIPS", 3.1)
    pair = blend(*[GLASS, SOLID][:: -1 if backwards else 1])
    assert [shape.reason for shape in pair.shapes] == [CLOSED, DRAWN_ON if backwards else DRAWN_BACK]
    box = control_box(shapes_at(pair, 0.5)[0].paths[:1])
    assert box.width == pytest.approx(box.height, rel=0.01)


@pytest.mark.parametrize("backwards", [False, True])
def test_an_island_without_room_gets_a_seat_and_its_gap_goes_along(backwards):
    house = filled("M12 2L22 11V22H15V15H9V22H2V11Z")
    pair = blend(*[house, GLASS][:: -1 if backwards else 1])
    for t in (0.1, 0.3, 0.5):
        painted = shapes_at(pair, 1.0 - t if backwards else t)
        outline = painted[0]._replace(paths=painted[0].paths[:1])
        assert picture(painted[:1], VIEW)[3].sum() == pytest.approx(
            picture([outline], VIEW)[3].sum(), abs=2.0
        )
