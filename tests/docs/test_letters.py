"""Letters of variable fonts, made anew."""

import numpy as np
import pytest

from tools.quality.peers import shapeblend
from tools.quality.truth import letters
from tools.quality.truth.form import TIMES, load
from tools.quality.truth.measures import apart, strict
from tools.quality.truth.write import centred


def test_letters_of_fonts(fonts):
    for name, each in letters.COUNTS.items():
        found = list(load(fonts, name))
        assert len(found) == each * len(letters.FAMILIES)
        for one in found:
            assert (len(one.frames[0]) == 1) == (name == "single")
            assert apart(*centred(one.frames[0], one.frames[-1])) >= letters.DIFFERENT
            straight = [[p + (q - p) * t for p, q in one.true_links()] for t in TIMES]
            assert strict(one, straight) < 3 * letters.EVEN
            assert len(shapeblend.drawn(one.b)) == len(one.frames[0])


def test_an_in_between_of_a_letter_is_that_of_the_font(fonts):
    one = letters.letter(letters.opened("Archivo"), "Archivo", "I", "wght", 0.0, 1.0)
    widths = [float(np.ptp(np.concatenate(frame).real)) for frame in one.frames]
    assert np.diff(widths) == pytest.approx([(widths[-1] - widths[0]) / 4] * 4, abs=0.2)
    assert widths[-1] > 1.2 * widths[0]


def test_letters_are_the_same_every_time(fonts, monkeypatch, tmp_path):
    family = next(iter(letters.FAMILIES))
    monkeypatch.setattr(letters, "FAMILIES", {family: letters.FAMILIES[family]})
    letters.make(tmp_path)
    files = sorted(tmp_path.glob("*/*/*"))
    assert len(files) == 3 * sum(letters.COUNTS.values())
    for file in files:
        assert file.read_bytes() == (fonts / file.relative_to(tmp_path)).read_bytes()
