"""The sum of the features of a strip."""

import numpy as np
import pytest

from shapeblend_cli.grading.features import HALVES, Features
from shapeblend_cli.grading.grade import PHRASES, grade, seen_in, weighed
from shapeblend_cli.grading.weights import TOGETHER

NONE = Features(*[0.0] * len(HALVES))._replace(detail=10.0)


def graded(**amounts):
    return weighed(NONE._replace(**amounts))


def test_two_faults_at_once_look_worse_than_both_alone():
    none, spikes, notches = graded(), graded(spikes=1.0), graded(notches=1.0)
    both = graded(spikes=1.0, notches=1.0)
    assert both.number - none.number > (spikes.number - none.number) + (notches.number - none.number) + 0.2


def test_a_fault_is_the_reason_that_weighs_only_beside_others():
    assert graded(lopsided=1.0).why == PHRASES["lopsided"]


def test_no_weight_of_two_features_is_negative():
    assert all(weight > 0.0 for weight in TOGETHER.values())
    assert {name for two in TOGETHER for name in two} <= {*Features._fields} - {"pop"}


@pytest.mark.parametrize("size", [(24, 96), (96, 24), (96, 96)])
def test_a_ground_is_left_out_of_pictures_that_are_no_squares_too(size):
    bare = [np.zeros((4, *size), np.float32) for _ in range(7)]
    on_white = [np.ones((4, *size), np.float32) for _ in range(7)]
    for k in range(7):
        part = np.s_[:, 8:16, 8 : 10 + k]
        bare[k][part] = on_white[k][part] = np.reshape([0.2, 0.4, 0.0, 1.0], (4, 1, 1))
    assert np.array_equal(seen_in(on_white).pictures, seen_in(bare).pictures)
    assert grade(on_white) == grade(bare)
    assert seen_in(bare).pictures.shape == (7, 4, 96, 96)
