"""The figures of the solver: the documents are made of docs/solver.json, and a few of them are measured anew."""

import json

import pytest

from tools import solver_table
from tools.quality.data import icon_pairs

FOUND = json.loads(solver_table.RAW.read_text(encoding="utf-8"))
PAIRS = icon_pairs("single")
NEAR = {"rel": 1e-3, "abs": 1e-6}


def test_the_documents_are_what_was_measured():
    assert solver_table.DOCUMENT.read_text(encoding="utf-8") == solver_table.document(FOUND)
    assert solver_table.figures(FOUND) in solver_table.README.read_text(encoding="utf-8")


def test_every_pair_is_there():
    assert {len(column) for column in FOUND["icons"].values()} == {len(PAIRS)}
    assert {len(column) for column in FOUND["fine"].values()} == {len(PAIRS[:: solver_table.EVERY])}


@pytest.mark.parametrize("number", range(0, len(PAIRS), 16))
def test_icons_anew(number):
    found = solver_table.on_icon(*solver_table.outlines(PAIRS[number], solver_table.VERTICES))
    for name in ("simplified", "divided"):
        assert found[name] == pytest.approx(FOUND["icons"][name][number], **NEAR)


@pytest.mark.parametrize("number", [3, 21])
def test_fine_icons_anew(number):
    pair = PAIRS[:: solver_table.EVERY][number]
    found = solver_table.on_fine_icon(*solver_table.outlines(pair, solver_table.FINE))
    assert found["coarse"] == pytest.approx(FOUND["fine"]["coarse"][number], **NEAR)


def test_symmetric_shapes_are_still_proven():
    assert FOUND["family"]["proven"] == [1] * 100
