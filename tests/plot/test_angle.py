"""The figure of an angle."""

import math

import numpy as np
import pytest

from shapeblend_cli.errors import MatchError
from shapeblend_cli.plot import angle
from tests.plot.conftest import LINES, pieces, points, words


@pytest.mark.parametrize("preset", [None, "paper"])
def test_the_dot_is_the_one_of_most_bending_work(subject_of, preset):
    subject = subject_of("cow", "deer", preset=preset)
    found = angle.angle_of(subject)
    _, _, bending = subject.wires.bends_on(subject.correspondence.dots)
    assert found.bending == bending.max()
    assert bending.sum() == pytest.approx(subject.correspondence.bending)
    if preset == "paper":  # by turning it costs how much more the wires turn, not how the angle goes
        assert found.theta.bending(subject.wires, found.dot[0]) == pytest.approx(found.bending)


def test_a_dot_that_is_named_is_taken(subject_of):
    dots = subject_of("e", "f").correspondence.dots
    i, j = (int(v) for v in dots[17])
    assert angle.angle_of(subject_of("e", "f", dot=(i, j))).dot == (i, j)


@pytest.mark.parametrize(
    ("drawings", "settings", "message"),
    [
        (
            ("e", "f"),
            {"dot": (3, 100)},
            r"vertices 3 of A and 100 of B do not correspond; 3,\d+ is a dot of the path",
        ),
        (LINES, {"vertices": 0, "dot": (0, 0)}, "0,0 is an end of an open contour and has no angle; "),
        (("M0 0L3 5",) * 2, {"vertices": 0}, "contours with more would work"),
    ],
    ids=["not on the path", "an end of an open line", "a line of two ends"],
)
def test_a_dot_without_an_angle_is_refused(subject_of, drawings, settings, message):
    with pytest.raises(MatchError, match=message):
        angle.angle_of(subject_of(*drawings, **settings))


def test_the_curve_that_is_drawn_goes_through_theta(subject_of):
    subject = subject_of("bird-1", "bird-2")
    theta = angle.angle_of(subject).theta
    text = angle.draw(subject)
    line = np.array(points(pieces(text, "q")[1].get("d")))
    values = np.degrees(theta.angles)
    levels = [float(w.rstrip("°")) for w in words(text) if w.endswith("°") and w.rstrip("°").isdigit()]
    places = [float(e.get("y")) - 4.0 for e in pieces(text, "tick-y")]
    slope, offset = np.polyfit(places, levels, 1)
    assert slope * line.imag + offset == pytest.approx(values, abs=0.3 * abs(slope))


def test_a_control_point_that_is_infinitesimal_is_a_direction(subject_of):
    # Figure 24: two vertices of the square at one of the triangle, at 90 degrees and half of 45.
    subject = subject_of("triangle", "square", vertices=0, preset="paper")
    found = angle.angle_of(subject)
    assert 0 in found.theta.control
    (direction,) = (d for d in found.theta.directions if d is not None)
    assert math.degrees(direction) == pytest.approx(112.5)
    assert "Q₀ → 0 at 112.5°" in words(angle.draw(subject))
