"""The figures of docs/quality.json: the documents are made of them, and a few of them are measured anew."""

import json

import pytest

from tests.support.equipment import require
from tools.quality import __main__ as quality
from tools.quality import crossings, letters, motions, raw, sizes, times
from tools.quality.data import ROOT, SETS, icon_pairs
from tools.quality.motions import Choice
from tools.quality.peers import ALL, arc_length, flubber, shapeblend
from tools.quality.scores import STEPS, Score
from tools.quality.truth import form
from tools.quality.truth.measures import Nearness

FOUND = json.loads((ROOT / quality.RAW).read_text(encoding="utf-8"))
TOOLS = {tool.name: tool for tool in ALL}

MEASURED = (shapeblend.NAME, arc_length.NAME, flubber.NAME, flubber.COARSE)

EVERY = {"icons": {"single": 40, "whole": 20}, "letters": {"single": 10, "multi": 8}}
"""One pair in so many is measured anew."""


def chosen(what, name):
    """The numbers of the pairs that are measured anew."""
    return range(0, len(FOUND[what][name]["pairs"]), EVERY[what][name])


def same(kind, scores, told, numbers):
    """Compare scores with those of the file."""
    for column, values in raw.columns(kind, scores).items():
        assert values == pytest.approx([told[column][k] for k in numbers], abs=2e-3), column


@pytest.mark.parametrize("name", [quality.README, quality.QUALITY])
def test_documents_are_what_the_scores_give(name):
    readme = (ROOT / quality.README).read_text(encoding="utf-8")
    assert (ROOT / name).read_text(encoding="utf-8") == quality.documents(FOUND, readme)[name]


def test_every_pair_has_its_scores():
    assert FOUND["missing"] == []
    for name in SETS:
        assert FOUND["icons"][name]["pairs"] == [pair.id for pair in icon_pairs(name)]
        assert list(FOUND["icons"][name]["scores"]) == list(TOOLS)
    for name in form.SETS:
        assert list(FOUND["letters"][name]["scores"]) == [tool.name for tool in ALL if tool.linked]
    for kept in [*FOUND["icons"].values(), *FOUND["letters"].values()]:
        columns = [column for scores in kept["scores"].values() for column in scores.values()]
        assert {len(column) for column in columns} == {len(kept["pairs"])}


def require_for(tool):
    if tool.startswith(flubber.NAME):
        require("flubber")


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
def test_sizes_measured_anew(name, node):
    told = FOUND["sizes"][name]
    pair = next(pair for pair in icon_pairs(name) if pair.id == told["pairs"][0])
    assert sizes.segments([pair], True) == {tool: counts[:1] for tool, counts in told["segments"].items()}
    for tool, files in sizes.animations([pair], True).items():
        for kind, (text,) in files.items():
            assert len(text) == pytest.approx(told["bytes"][tool][kind][0], rel=0.01), (tool, kind)


@pytest.mark.parametrize("name", form.SETS)
@pytest.mark.parametrize("tool", MEASURED)
def test_letters_measured_anew(name, tool, fonts):
    require_for(tool)
    numbers = chosen("letters", name)
    truths = list(form.load(fonts, name))
    assert [truth.id for truth in truths] == FOUND["letters"][name]["pairs"]
    scores = letters.scored(TOOLS[tool], [truths[k] for k in numbers])
    same(Nearness, scores, FOUND["letters"][name]["scores"][tool], numbers)


def test_times_are_of_commands_that_write_what_they_should(node, tmp_path):
    pair = icon_pairs("single")[0]
    times.ours(pair, str(tmp_path))
    assert len(list((tmp_path / "frames").iterdir())) == STEPS - 1
    (tmp_path / "other").mkdir()
    times.theirs(pair, str(tmp_path / "other"))
    (line,) = (tmp_path / "other" / "frames").read_text(encoding="utf-8").splitlines()
    assert [frame[0] for frame in json.loads(line)["frames"]] == ["M"] * (STEPS - 1)
