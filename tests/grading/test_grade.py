"""The sum of the features of a strip."""

import numpy as np
import pytest

from shapeblend_cli.grading import grade as module
from shapeblend_cli.grading.features import HALVES, Features
from shapeblend_cli.grading.grade import PHRASES, grade
from shapeblend_cli.grading.weights import TOGETHER

NONE = Features(*[0.0] * len(HALVES))._replace(detail=10.0)


@pytest.fixture
def graded(monkeypatch):
    def with_amounts(**amounts):
        monkeypatch.setattr(module, "features", lambda _: NONE._replace(**amounts))
        return grade([np.zeros((4, 8, 8))] * 3)

    return with_amounts


def test_two_faults_at_once_look_worse_than_both_alone(graded):
    none, spikes, notches = graded(), graded(spikes=1.0), graded(notches=1.0)
    both = graded(spikes=1.0, notches=1.0)
    assert both.number - none.number > (spikes.number - none.number) + (notches.number - none.number) + 0.2


def test_a_fault_is_the_reason_that_weighs_only_beside_others(graded):
    assert graded(lopsided=1.0).why == PHRASES["lopsided"]


def test_no_weight_of_two_features_is_negative():
    assert all(weight > 0.0 for weight in TOGETHER.values())
    assert {name for two in TOGETHER for name in two} <= {*Features._fields} - {"pop"}
