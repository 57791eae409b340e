"""Outlines that are softer on their way."""

import numpy as np
import pytest

from shapeblend_cli.blending.silhouettes.softening import softened, softness
from shapeblend_cli.geometry import cubics
from shapeblend_cli.interpolate.paths import segments_at
from tests.blending.silhouettes.test_blend import silhouette, two

TEETH = np.concatenate([np.arange(40) + 2j * (np.arange(40) % 2), [40.0 - 30j, -30j]])
DISC = 20.0 * np.exp(2j * np.pi * np.arange(64) / 64)


def around(segments):
    return np.abs(segments[:, 3] - segments[:, 0]).sum()


def test_teeth_are_averaged_out():
    line = cubics.lines(TEETH, closed=True)
    teeth = softened(line, 2.0)[5:35, 0].imag
    assert np.ptp(teeth) < 0.5
    assert abs(teeth.mean() - 1.0) < 0.1


@pytest.mark.parametrize("deviation", [1.0, 100.0])
def test_a_disc_hardly_shrinks(deviation):
    found = softened(cubics.lines(DISC, closed=True), deviation)
    assert np.abs(found[:, 0]) == pytest.approx(20.0, rel=0.02)


def test_segments_meet_and_straight_ones_stay_straight():
    line = cubics.lines(TEETH, closed=True)
    line[3, 1] += 1.0
    found = softened(line, 2.0)
    assert (found[:, 3] == np.roll(found[:, 0], -1)).all()
    assert (cubics.chord_deviation(np.delete(found, 3, axis=0)) < 1e-9).all()


def test_nothing_is_softened_at_the_ends():
    line = cubics.lines(TEETH, closed=True)
    assert [softness(t) for t in (-0.1, 0.0, 0.5, 1.0, 1.1)] == [0.0, 0.0, 1.0, 0.0, 0.0]
    assert softened(line, 0.0) is line
    assert softened(np.zeros((3, 4), complex), 1.0) is not None


def test_silhouettes_are_softer_halfway():
    (shape,) = silhouette(two()).shapes
    (inner,) = shape.motion.shapes
    halfway = around(shape.motion.segments(shape.contours, 0.5)[0])
    assert halfway < 0.97 * around(segments_at(inner, 0.5)[0])
