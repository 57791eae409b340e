"""The figures in docs/*.json: the documents are made of them, and a few of them are measured anew."""

import json

import numpy as np
import pytest

from tests.support.equipment import require
from tools import bulk, solver_table
from tools.quality import __main__ as quality
from tools.quality import crossings, letters, motions, raw, sizes, sweep, times
from tools.quality.data import ROOT, SETS, icon_pairs
from tools.quality.judge import section as judge
from tools.quality.morphs import section as limbs
from tools.quality.motions import Choice
from tools.quality.peers import ALL, arc_length, flubber, kute, polymorph, shapeblend
from tools.quality.scores import STEPS, Score
from tools.quality.truth import form
from tools.quality.truth.measures import Nearness

FOUND = json.loads((ROOT / quality.RAW).read_text(encoding="utf-8"))
SWEPT = json.loads(sweep.RAW.read_text(encoding="utf-8"))
SOLVED = json.loads(solver_table.RAW.read_text(encoding="utf-8"))
SINGLE = icon_pairs("single")
TOOLS = {tool.name: tool for tool in ALL}

LIBRARIES = (*flubber.LIBRARIES, kute.FINE, kute.OF_CURVES, polymorph.FINE)
MEASURED = (shapeblend.NAME, arc_length.NAME, *(library.name for library in LIBRARIES))

EVERY = {
    "icons": {"single": 40, "whole": 20},
    "letters": {"single": 10, "multi": 8, "cut": 13},
    "morphs": dict(zip(limbs.SETS, (8, 10, 2), strict=True)),
}
"""One pair in so many is measured anew."""
SWEPT_EVERY = 12
JUDGED_EVERY = 20
SOLVED_NEAR = {"rel": 1e-3, "abs": 1e-6}


def chosen(what, name):
    """The numbers of the pairs that are measured anew."""
    return range(0, len(FOUND[what][name]["pairs"]), EVERY[what][name])


def same(kind, scores, told, numbers):
    """Compare scores with those of the file."""
    for column, values in raw.columns(kind, scores).items():
        assert values == pytest.approx([told[column][k] for k in numbers], abs=2e-3), column


def test_documents_are_what_was_measured():
    readme = (ROOT / quality.README).read_text(encoding="utf-8")
    for name, text in quality.documents(FOUND, readme).items():
        assert (ROOT / name).read_text(encoding="utf-8") == text
    assert sweep.DOCUMENT.read_text(encoding="utf-8") == sweep.document(SWEPT)
    assert solver_table.DOCUMENT.read_text(encoding="utf-8") == solver_table.document(SOLVED)
    assert solver_table.figures(SOLVED) in solver_table.GUIDE.read_text(encoding="utf-8")
    assert bulk.DOCUMENT.read_text(encoding="utf-8") == bulk.document(json.loads(bulk.RAW.read_text("utf-8")))


def test_every_pair_has_its_scores():
    assert FOUND["missing"] == []
    for name in SETS:
        assert FOUND["icons"][name]["pairs"] == [pair.id for pair in icon_pairs(name)]
        assert list(FOUND["icons"][name]["scores"]) == list(TOOLS)
    for name in letters.KINDS:
        assert list(FOUND["letters"][name]["scores"]) == [tool.name for tool in ALL if tool.linked]
    for what in limbs.SETS:
        assert list(FOUND["morphs"][what]["scores"]) == [tool.name for tool in ALL if tool.linked]
    for kept in [*FOUND["icons"].values(), *FOUND["letters"].values(), *FOUND["morphs"].values()]:
        columns = [column for scores in kept["scores"].values() for column in scores.values()]
        assert {len(column) for column in columns} == {len(kept["pairs"])}
    assert {len(column) for column in SOLVED["icons"].values()} == {len(SINGLE)}
    assert {len(column) for column in SOLVED["fine"].values()} == {len(SINGLE[:: solver_table.EVERY])}


def require_for(tool):
    if tool in {library.name for library in LIBRARIES}:
        require(tool.split()[0])


@pytest.mark.parametrize("name", SETS)
@pytest.mark.parametrize("tool", MEASURED)
def test_icons_measured_anew(name, tool):
    require_for(tool)
    numbers = chosen("icons", name)
    scores = crossings.scored(TOOLS[tool], [icon_pairs(name)[k] for k in numbers])
    same(Score, scores, FOUND["icons"][name]["scores"][tool], numbers)


@pytest.mark.parametrize("name", SETS)
def test_motions_measured_anew(name):
    numbers = chosen("icons", name)
    choices = [motions.choice(shapeblend.report(icon_pairs(name)[k])) for k in numbers]
    told = raw.records(Choice, FOUND["motions"][name])
    assert choices == [told[k] for k in numbers]


@pytest.mark.parametrize("name", SETS)
def test_sizes_measured_anew(name, libraries):
    told = FOUND["sizes"][name]
    pair = next(pair for pair in icon_pairs(name) if pair.id == told["pairs"][0])
    assert sizes.segments([pair], libraries) == {
        tool: counts[:1] for tool, counts in told["segments"].items()
    }
    for tool, files in sizes.animations([pair], libraries).items():
        for kind, (text,) in files.items():
            assert len(text) == pytest.approx(told["bytes"][tool][kind][0], rel=0.01), (tool, kind)


@pytest.mark.parametrize("name", letters.KINDS)
@pytest.mark.parametrize("tool", MEASURED)
def test_letters_measured_anew(name, tool, fonts):
    require_for(tool)
    numbers = chosen("letters", name)
    truths = letters.pairs_of(fonts, name)
    assert [truth.id for truth in truths] == FOUND["letters"][name]["pairs"]
    scores = letters.scored(TOOLS[tool], [truths[k] for k in numbers])
    same(Nearness, scores, FOUND["letters"][name]["scores"][tool], numbers)


@pytest.mark.parametrize("what", limbs.SETS)
@pytest.mark.parametrize("tool", MEASURED)
def test_limbs_and_morphs_measured_anew(what, tool, morphs):
    require_for(tool)
    numbers = chosen("morphs", what)
    split, name = limbs.SETS[what]
    truths = list(form.load(morphs / split, name))
    assert [truth.id for truth in truths] == FOUND["morphs"][what]["pairs"]
    scores = letters.scored(TOOLS[tool], [truths[k] for k in numbers])
    same(Nearness, scores, FOUND["morphs"][what]["scores"][tool], numbers)


@pytest.mark.parametrize("seed", judge.SEEDS)
def test_the_judge_measured_anew(seed):
    require("graded icons")
    told, every = FOUND["judge"][str(seed)], judge.graded(seed)
    assert told["pairs"] == [" ".join(one.pair) for one in every]
    for k in range(0, len(every), JUDGED_EVERY):
        found = judge.measure(every[k])
        assert found.numbers == pytest.approx({n: c[k] for n, c in told["numbers"].items()}, abs=2e-3)
        assert found.taken == told["taken"][k]


def test_times_are_of_commands_that_write_what_they_should(libraries, tmp_path):
    pairs = icon_pairs("single")[:2]
    for way, count in ((times.ours, 1), (times.ours_in_bulk, 2)):
        folder = tmp_path / way.__name__
        folder.mkdir()
        assert min(way(pairs[:count], folder)) > 0.01
        assert len(list(folder.glob("frames-*/*.svg"))) == count * (STEPS - 1)
    for library in times.TIMED:
        times.theirs(library)(pairs, tmp_path)
        lines = (tmp_path / "frames").read_text(encoding="utf-8").splitlines()
        assert [[f[0] for f in json.loads(line)["frames"]] for line in lines] == [["M"] * (STEPS - 1)] * 2
    times.evenly(pairs, tmp_path)
    assert len((tmp_path / "frames").read_text(encoding="utf-8").splitlines()) == 2 * (STEPS - 1)


def test_every_setting_was_swept_and_every_option_has_one_default():
    assert list(SWEPT) == list(sweep.settings())
    for key in sweep.options():
        rows = [sweep.row(SWEPT, key, value) for value in sweep.values(key)]
        assert sum(row[1].startswith("**") for row in rows) == 1, key


@pytest.mark.parametrize("number", [0, 2, -1])
def test_defaults_measured_anew(number, fonts, morphs):
    name, setting = list(sweep.settings().items())[number]
    truths = {
        of: [truth for set_ in form.SETS for truth in form.load(folder, set_)][:: sweep.EVERY[of]]
        for of, folder in sweep.FOLDERS.items()
    }
    few = {of: some[::SWEPT_EVERY] for of, some in truths.items()}
    found = sweep.scored(setting, few, SINGLE[:: sweep.EVERY["icons"]][::SWEPT_EVERY])
    for of, kinds in found.items():
        for kind, values in kinds.items():
            assert values == pytest.approx(SWEPT[name][of][kind][::SWEPT_EVERY], abs=2e-3), (of, kind)


def test_defaults_are_near_the_best():
    """No other setting is much nearer to the truth on all sets without crossing more icons."""
    default = SWEPT[""]
    for name, other in SWEPT.items():
        shares = [np.mean(other[of]["corr"]) / np.mean(default[of]["corr"]) for of in sweep.FOLDERS]
        crossed = [
            sum(found["icons"]["crossed"]) + sum(found["icons"]["little"]) for found in (other, default)
        ]
        assert max(shares) > 0.8 or crossed[0] > crossed[1], name


@pytest.mark.parametrize("number", range(0, len(SINGLE), 16))
def test_solved_icons_anew(number):
    found = solver_table.on_icon(*solver_table.outlines(SINGLE[number], solver_table.VERTICES))
    for name in ("simplified", "divided"):
        assert found[name] == pytest.approx(SOLVED["icons"][name][number], **SOLVED_NEAR)


@pytest.mark.parametrize("number", [3, 21])
def test_finely_solved_icons_anew(number):
    pair = SINGLE[:: solver_table.EVERY][number]
    found = solver_table.on_fine_icon(*solver_table.outlines(pair, solver_table.FINE))
    assert found["coarse"] == pytest.approx(SOLVED["fine"]["coarse"][number], **SOLVED_NEAR)


def test_symmetric_shapes_are_still_proven():
    assert SOLVED["family"]["proven"] == [1] * 100
