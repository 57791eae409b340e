"""Drawings that are brush strokes throughout: their strokes become each other."""

import numpy as np
import pytest

from shapeblend_cli.blending.strokes.brushed import BECOMES, DRAWN_ON
from shapeblend_cli.frames.frames import shapes_at
from shapeblend_cli.grading.painting import picture
from shapeblend_cli.model import Box
from shapeblend_cli.options.settings import Settings
from shapeblend_cli.pipeline import match_all
from tests.support.drawings import drawing
from tests.support.handwriting import letter_o, letter_s, path, stroke

pytestmark = pytest.mark.usefixtures("blended_once")

S, RING = path(letter_s()), path(*letter_o())
VIEW = Box(0.0, 0.0, 24.0, 24.0)
BAR = path(stroke(np.linspace(4.0 + 12.0j, 20.0 + 12.0j, 30), 1.5))


def blended(a, b, **settings):
    """Two drawings, blended."""
    (pair,), _ = match_all([drawing(a), drawing(b)], Settings(swap="never", **settings))
    return pair


def ink(pair, t):
    """The area that is painted at a time."""
    return float(picture(shapes_at(pair, t), VIEW)[3].sum())


def test_strokes_keep_their_thickness():
    pair = blended(S, RING)
    (shape,) = pair.shapes
    assert (shape.reason, shape.motion_name) == (BECOMES, "brush")
    inks = [ink(pair, t) for t in (0.0, 0.25, 0.5, 0.75, 1.0)]
    assert max(inks) < 1.1 * max(inks[0], inks[-1])


@pytest.mark.parametrize("pair", [(S, RING), (RING, S), (S + BAR, RING)])
@pytest.mark.parametrize("t", [0.0, 1.0])
def test_both_ends_are_the_drawings(pair, t):
    blend = blended(*pair)
    painted, drawn = (picture(shapes, VIEW)[3] for shapes in (shapes_at(blend, t), blend.drawn[int(t)]))
    assert np.abs(painted - drawn).sum() < 0.02 * drawn.sum()


def test_a_stroke_without_a_partner_is_drawn_on_from_the_one_on_which_it_rests():
    pair = blended(RING, S + BAR)
    (shape,) = pair.shapes
    assert [contour.reason for contour in shape.contours] == [BECOMES, DRAWN_ON]
    bars = [shape.motion.segments(shape.contours, t)[1][:, 0] for t in (0.1, 0.9)]
    assert [float(np.ptp(bar.real)) > 8.0 for bar in bars] == [False, True]


@pytest.mark.parametrize(
    "settings",
    [
        {"motion": "linear"},
        {"strokes": "recover"},
        {"strokes": "keep"},
        {"curves": False},
        {"match": ((0, 0),)},
    ],
)
def test_what_is_asked_for_comes_first(settings):
    assert all(shape.motion_name != "brush" for shape in blended(S, RING, **settings).shapes)


def test_a_body_with_limbs_is_no_handwriting():
    body = "M6 8H18V18H6Z M5 9L2 4L3 3L6 8Z"
    assert all(shape.motion_name != "brush" for shape in blended(body, RING).shapes)


def test_outlines_that_were_made_from_each_other_stay_so():
    pair = blended(S, path(24.0 - letter_s().conj()))
    assert all(shape.reason != BECOMES for shape in pair.shapes)
