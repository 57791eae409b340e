"""What is swept, and what is said of it, on made-up scores."""

import numpy as np
import pytest

from shapeblend_cli.options.constants import WorkConstants
from tests.tools.test_truth import SQUARE, WIDE
from tools.quality import sweep
from tools.quality.truth.form import truth
from tools.quality.truth.write import Morph, pair


def found(off, crossed=0):
    """Scores of two pairs each, and of four icons."""
    near = {of: {"strict": [off, off], "corr": [off, off]} for of in sweep.FOLDERS}
    return near | {"icons": {"crossed": [1] * crossed + [0] * (4 - crossed), "little": [0] * 4}}


def test_every_constant_is_swept_with_its_default_but_for_one():
    keys = {field.key for field in WorkConstants.options.values()}
    assert keys - set(sweep.options()) == {sweep.LEFT_OUT}
    for key in sweep.options():
        assert len(sweep.values(key)) > 1
        assert sweep.values(key).count(sweep.default_of(key)) == 1


def test_defaults_are_one_setting_whatever_is_varied():
    settings = sweep.settings()
    assert next(iter(settings.items())) == ("", {})
    assert sweep.label({"kb": sweep.default_of("kb")}) == ""
    assert sweep.label({"kb": "7", "cs": sweep.default_of("cs"), "es": "1"}) == "--kb 7 --es 1"
    assert all(sweep.label(setting) == name for name, setting in settings.items())
    assert len(sweep.combinations()) == 3 ** len([key for key in sweep.JOINTLY if key in sweep.options()])


def test_the_next_value_on_each_side_is_told():
    assert sweep.beside_default("kb") == ["0.3", "3"]
    assert sweep.beside_default("motion") == ["linear", "rigid", "intrinsic", "safe"]


def test_a_trade_says_what_gets_better_and_worse():
    scores = {"": found(0.01), "--kb 3": found(0.008, crossed=2), "--kb 0.3": found(0.0101, crossed=1)}
    setting, better, worse = sweep.trade(scores, "kb", "3")
    assert setting == "`--kb 3`"
    assert better.startswith(
        "letters: in-between 1.00 % → 0.80 %; letters: off 1.000 % → 0.800 %; articulated"
    )
    assert worse == "icons: crossed 0 → 2"
    # A change of one icon or of one per cent is none.
    assert sweep.trade(scores, "kb", "0.3")[1:] == ["–", "–"]


def test_the_document_has_every_setting():
    scores = {name: found(0.01) for name in sweep.settings()}
    text = sweep.document(scores)
    assert "Pairs: letters 2, articulated 2, authored 2, icons 4." in text
    assert f"| `--kb` | **{sweep.default_of('kb')}** | 1.00 % | 1.000 % | 0 |" in text
    rows = [line for line in text.splitlines() if line.startswith("|")]
    swept = sum(len(sweep.values(key)) for key in sweep.options())
    neighbours = sum(len(sweep.beside_default(key)) for key in sweep.options())
    assert len(rows) == 3 * 2 + swept + neighbours + len(sweep.combinations())


@pytest.mark.parametrize("setting", [{}, {"motion": "linear", "kb": "3"}])
def test_one_setting_is_scored(setting):
    rings = SQUARE, WIDE
    ends = [[list(np.column_stack([ring, np.roll(ring, -1)]))] for ring in rings]
    known, a, b = pair(Morph({}, (0.0, 1.0), ends), "x", "single")
    truths = {of: [truth(known, a, b)] for of in sweep.FOLDERS}
    scores = sweep.scored(setting, truths, sweep.icon_pairs("single")[:1])
    for of in sweep.FOLDERS:
        assert max(*scores[of]["strict"], *scores[of]["corr"]) < 0.02
    assert scores["icons"]["crossed"] in ([0], [1])
