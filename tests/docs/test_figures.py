"""A few figures of docs/quality.json are measured anew, with drawings that are made anew."""

import json

import numpy as np
import pytest

from tests.support.equipment import require
from tools import solver
from tools.quality import __main__ as quality
from tools.quality import crossings, raw, times
from tools.quality.data import ROOT, SETS, icon_pairs, subpaths
from tools.quality.faces import section as faces
from tools.quality.morphs import articulated, make
from tools.quality.peers import ALL, LIBRARIES, flubber, kute, shapeblend
from tools.quality.scores import STEPS, Score
from tools.quality.truth import letters
from tools.quality.truth import section as truth
from tools.quality.truth.form import TIMES
from tools.quality.truth.measures import Nearness, apart, strict
from tools.quality.truth.write import centred, is_plain

FOUND = json.loads((ROOT / quality.RAW).read_text(encoding="utf-8"))
TOOLS = {tool.name: tool for tool in ALL}
ANEW = (shapeblend.NAME, flubber.NAME)
"""Other libraries are held by their versions."""

EVERY = {"single": 20, "whole": 10}
EVERY_TRUTH = dict(zip(truth.KINDS, (10, 8, 13, 8, 10, 2), strict=True))
EVERY_FACE = 8
"""One pair in so many is measured anew."""


def same(kind, scores, told, numbers):
    """Compare scores with those of the file."""
    for column, values in raw.columns(kind, scores).items():
        assert values == pytest.approx([told[column][k] for k in numbers], abs=2e-3), column


def test_every_pair_has_its_scores():
    for name in SETS:
        assert FOUND["icons"][name]["pairs"] == [pair.id for pair in icon_pairs(name)]
        counts = [len(subpaths(data)) for pair in icon_pairs(name) for data in (pair.a, pair.b)]
        assert (min(counts), max(counts)) == {"single": (1, 1), "whole": (2, 5)}[name]
    assert list(FOUND["truth"]) == list(truth.KINDS)
    for section, tools in {"icons": [*TOOLS, crossings.NEVER], "truth": list(TOOLS)}.items():
        assert all(list(kept["scores"]) == tools for kept in FOUND[section].values())
    for kept in [*FOUND["icons"].values(), *FOUND["truth"].values()]:
        columns = [column for scores in kept["scores"].values() for column in scores.values()]
        assert {len(column) for column in columns} == {len(kept["pairs"])}


@pytest.mark.parametrize("name", SETS)
@pytest.mark.parametrize("tool", ANEW)
def test_icons_measured_anew(name, tool):
    if tool == flubber.NAME:
        require("flubber")
    numbers = range(0, len(icon_pairs(name)), EVERY[name])
    scores = crossings.scored(TOOLS[tool].blends, [icon_pairs(name)[k] for k in numbers])
    same(Score, scores, FOUND["icons"][name]["scores"][tool], numbers)


@pytest.mark.parametrize("kind", truth.KINDS)
@pytest.mark.parametrize("tool", ANEW)
def test_letters_limbs_and_morphs_measured_anew(kind, tool, truths):
    if tool == flubber.NAME:
        require("flubber")
    every, told = truth.pairs_of(kind), FOUND["truth"][kind]
    assert [one.id for one in every] == told["pairs"]
    numbers = range(0, len(every), EVERY_TRUTH[kind])
    scores = truth.scored(TOOLS[tool], [every[k] for k in numbers])
    same(Nearness, scores, told["scores"][tool], numbers)


def test_faces_measured_anew(monkeypatch):
    require("fonts, icons and animations")
    assert sorted(a for a, _ in faces.PAIRS) == sorted(b for _, b in faces.PAIRS) == sorted(faces.FACES)
    monkeypatch.setattr(faces, "PAIRS", faces.PAIRS[::EVERY_FACE])
    assert faces.measured()["eyes"] == FOUND["faces"]["eyes"][::EVERY_FACE]


def test_times_are_of_commands_that_write_what_they_should(tmp_path):
    few = icon_pairs("single")[:2]
    for way, count in ((times.ours, 1), (times.ours_in_bulk, 2)):
        folder = tmp_path / way.__name__
        folder.mkdir()
        assert way(few[:count], folder) > 0.01
        assert len(list(folder.glob("frames-*/*.svg"))) == count * (STEPS - 1)
    for library in LIBRARIES:
        require("KUTE.js" if library is kute.OF_CURVES else library.name.split()[0])
        times.theirs(library)(few, tmp_path)
        lines = (tmp_path / "frames").read_text(encoding="utf-8").splitlines()
        assert [[f[0] for f in json.loads(line)["frames"]] for line in lines] == [["M"] * (STEPS - 1)] * 2


def test_letters_and_morphs_are_fit_and_change(truths):
    for kind in truth.KINDS:
        for one in truth.pairs_of(kind):
            contours = len(one.frames[0])
            assert (contours == 1) == ("several" not in kind)
            assert len(shapeblend.drawn(one.b)) == contours
            straight = [[p + (q - p) * t for p, q in one.true_links()] for t in TIMES]
            if kind == truth.LIMBS:
                assert all(is_plain(frame) for frame in one.frames), one.id
                assert strict(one, straight) > 1e-3  # limbs go on arcs, which straight ways miss
            else:
                assert apart(*centred(one.frames[0], one.frames[-1])) >= letters.DIFFERENT
                assert strict(one, straight) < 3 * letters.EVEN


def test_letters_and_limbs_are_the_same_every_time(truths, monkeypatch, tmp_path):
    family = next(iter(letters.FAMILIES))
    monkeypatch.setattr(letters, "FAMILIES", {family: letters.FAMILIES[family]})
    monkeypatch.setattr(articulated, "POSES", articulated.POSES[:2])
    letters.make(tmp_path / "letters")
    make.make(tmp_path / "morphs")
    for made, folder in ((tmp_path / "letters", letters.FOLDER), (tmp_path / "morphs", make.FOLDER)):
        files = [*made.glob("**/truth.json"), *made.glob("**/b.svg")]
        assert len(files) > 10
        for file in files:
            assert file.read_bytes() == (folder / file.relative_to(made)).read_bytes()


def test_an_in_between_of_a_letter_is_that_of_the_font(truths):
    one = letters.letter(letters.opened("Archivo"), "Archivo", "I", "wght", 0.0, 1.0)
    widths = [float(np.ptp(np.concatenate(frame).real)) for frame in one.frames]
    assert np.diff(widths) == pytest.approx([(widths[-1] - widths[0]) / 4] * 4, abs=0.2)
    assert widths[-1] > 1.2 * widths[0]


def test_the_papers_other_ways_end_where_the_page_on_the_solver_says():
    for pair in icon_pairs("single")[::40]:
        outlines = solver.outlines(pair, solver.VERTICES)
        simplified, divided = solver.work_above(solver.Wires(*outlines))
        assert 0.0 < simplified < 0.078
        assert divided == 0.0
