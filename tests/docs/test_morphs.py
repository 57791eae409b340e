"""Limbs and morphs, made anew."""

import numpy as np

from tools.quality.morphs import articulated, authored, make
from tools.quality.peers import shapeblend
from tools.quality.truth.form import TIMES, load
from tools.quality.truth.measures import strict
from tools.quality.truth.write import is_plain


def test_limbs_are_turned_without_crossing(morphs):
    found = list(load(morphs / "articulated", "single"))
    assert len(found) == len(articulated.POSES) == 30
    for one in found:
        assert len(one.times) == len(articulated.TIMES)
        assert all(is_plain(frame) for frame in one.frames), one.id
        # Limbs go on arcs, which straight ways miss.
        straight = [[p + (q - p) * t for p, q in one.true_links()] for t in TIMES]
        assert strict(one, straight) > 1e-3
        assert np.diff(one.times).max() < 0.2


def test_morphs_are_straight_and_of_their_sets(morphs):
    for name, least in (("single", 30), ("multi", 4)):
        found = list(load(morphs / "authored", name))
        assert len(found) >= least
        for one in found:
            assert (len(one.frames[0]) == 1) == (name == "single")
            assert len(shapeblend.drawn(one.b)) == len(one.frames[0])


def test_morphs_are_the_same_every_time(morphs, monkeypatch, tmp_path):
    monkeypatch.setattr(articulated, "POSES", articulated.POSES[:2])
    monkeypatch.setattr(authored, "ANIMATIONS", authored.ANIMATIONS[:1])
    make.make(tmp_path)
    assert (tmp_path / "LICENCE.md").exists()
    for file in sorted(tmp_path.glob("*/single/*/*")):
        assert file.read_bytes() == (morphs / file.relative_to(tmp_path)).read_bytes()
