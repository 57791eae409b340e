"""The table that the defaults rest on: made of docs/defaults.json, and some of it measured anew."""

import json

import numpy as np
import pytest

from tools.quality import sweep
from tools.quality.data import icon_pairs
from tools.quality.truth import letters
from tools.quality.truth.form import SETS, load

FOUND = json.loads(sweep.RAW.read_text(encoding="utf-8"))
EVERY = 12


def test_the_document_is_what_the_scores_give():
    assert sweep.DOCUMENT.read_text(encoding="utf-8") == sweep.document(FOUND)


def test_every_option_has_its_values_and_one_default():
    assert {option: tuple(values) for option, values in FOUND.items()} == sweep.OPTIONS
    for option, values in FOUND.items():
        rows = [sweep.row(option, value, sweep.Found(**scores)) for value, scores in values.items()]
        assert sum(row[1].startswith("**") for row in rows) == 1, option


@pytest.mark.parametrize(("option", "value"), [("mb", "3"), ("kb", "0")])
def test_some_of_it_measured_anew(option, value, fonts):
    truths = [truth for name in SETS for truth in load(letters.FOLDER, name)][::EVERY]
    found = sweep.scored(option, value, truths, icon_pairs("single")[:: sweep.EVERY][::EVERY])
    told = sweep.Found(**FOUND[option][value])
    for column, values in found._asdict().items():
        assert values == pytest.approx(getattr(told, column)[::EVERY], abs=2e-3), column


def test_the_defaults_are_near_the_best():
    """No other value of an option is much nearer to the letters without crossing more icons."""
    for option, values in FOUND.items():
        default = sweep.Found(**values[sweep.default_of(option)])
        for value, scores in values.items():
            other = sweep.Found(**scores)
            better = np.mean(other.strict) < 0.6 * np.mean(default.strict)
            assert not better or sum(other.crossed) > sum(default.crossed), (option, value)
