"""Gradients between two gradients."""

import cmath
import math

import pytest

from shapeblend_cli.model import LinearGradient, RadialGradient, Stop
from shapeblend_cli.paint.gradients import blend_gradients, common_stops
from shapeblend_cli.paint.oklab import blend_colours

RED, BLUE, LIME = "#ff0000", "#0000ff", "#00ff00"
FADE = (Stop(0.0, RED), Stop(1.0, BLUE))


def test_stops_are_at_the_offsets_of_both_and_paint_the_same_abrupt_changes_too():
    a, b = common_stops(FADE, (Stop(0.25, LIME, 0.5), Stop(1.0, LIME, 1.0)))
    assert a == (Stop(0.0, RED), Stop(0.25, "#bf0040"), Stop(1.0, BLUE))
    assert b == (Stop(0.0, LIME, 0.5), Stop(0.25, LIME, 0.5), Stop(1.0, LIME, 1.0))
    hard = (Stop(0.5, RED), Stop(0.5, BLUE))
    a, b = common_stops(hard, FADE)
    assert a == (Stop(0.0, RED), Stop(0.5, RED), Stop(0.5, BLUE), Stop(1.0, BLUE))
    assert b == (Stop(0.0, RED), Stop(0.5, "#800080"), Stop(0.5, "#800080"), Stop(1.0, BLUE))


def test_linear_gradients_halfway():
    a = LinearGradient(0j, 10 + 0j, FADE)
    b = LinearGradient(2j, 10 + 10j, (Stop(0.0, BLUE), Stop(1.0, RED, 0.0)), "repeat")
    found = blend_gradients(a, b, 0.5)
    assert (found.start, found.end, found.spread) == (1j, 10 + 5j, "repeat")
    assert found.stops[0] == Stop(0.0, blend_colours(RED, BLUE, 0.5))
    # The colour of a stop that cannot be seen is seen beside it.
    assert found.stops[1] == Stop(1.0, blend_colours(RED, BLUE, 0.5), 0.5)
    assert blend_gradients(a, b, 0.0) == a


def test_radial_gradients_halfway():
    a = RadialGradient(0j, (2.0, 2.0), 0.0, 0j, 0.0, FADE)
    b = RadialGradient(4 + 2j, (6.0, 4.0), 0.0, 0.5 + 0j, 0.5, FADE)
    found = blend_gradients(a, b, 0.5)
    assert found == RadialGradient(2 + 1j, (4.0, 3.0), 0.0, 0.25 + 0j, 0.25, FADE)


def focus_in_the_drawing(gradient):
    z = complex(gradient.focus.real * gradient.radii[0], gradient.focus.imag * gradient.radii[1])
    return gradient.centre + z * cmath.rect(1, math.radians(gradient.angle))


@pytest.mark.parametrize(("of_a", "of_b", "halfway"), [(80.0, -80.0, 90.0), (10.0, 40.0, 25.0)])
def test_an_ellipse_turns_the_shorter_way_and_its_focus_with_it(of_a, of_b, halfway):
    a = RadialGradient(0j, (4.0, 2.0), of_a, 0.5 + 0.25j, 0.0, FADE)
    b = RadialGradient(0j, (4.0, 2.0), of_b, 0.5 + 0.25j, 0.0, FADE)
    assert blend_gradients(a, b, 0.5).angle == pytest.approx(halfway)
    for t, end in ((0.0, a), (1.0, b)):
        assert focus_in_the_drawing(blend_gradients(a, b, t)) == pytest.approx(focus_in_the_drawing(end))


def test_a_circle_is_an_ellipse_at_any_angle():
    circle = RadialGradient(0j, (3.0, 3.0), 0.0, 0.5j, 0.0, FADE)
    ellipse = RadialGradient(0j, (4.0, 2.0), 70.0, 0j, 0.0, FADE)
    for first, second, t in ((circle, ellipse, 0.0), (ellipse, circle, 1.0)):
        found = blend_gradients(first, second, t)
        assert found.angle == 70.0
        assert focus_in_the_drawing(found) == pytest.approx(1.5j)


def test_a_linear_and_a_radial_gradient_have_nothing_in_between():
    linear = LinearGradient(0j, 10 + 0j, FADE)
    assert blend_gradients(linear, RadialGradient(0j, (2.0, 2.0), 0.0, 0j, 0.0, FADE), 0.5) is None
