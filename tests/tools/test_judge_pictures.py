"""The pictures of docs/motion.md show what they are there for."""

import re

import pytest

from shapeblend_cli.motion.judge import Judgement
from tools.judge_pictures import DOCS, EXAMPLES, drawn, term


def test_each_term_of_the_judge_has_a_picture_and_a_row_in_the_document():
    document = (DOCS / "motion.md").read_text(encoding="utf-8")
    assert list(EXAMPLES) == list(Judgement._fields) == re.findall(r"^\| `(\w+)` \|", document, re.MULTILINE)
    assert re.findall(r"\(judge-(\w+)\.svg\)", document) == list(EXAMPLES)


@pytest.mark.parametrize("name", EXAMPLES)
def test_the_fault_is_in_the_upper_row_alone_and_the_ends_are_the_same(name):
    wrong, right, view = EXAMPLES[name]
    assert term(name, wrong, view) > 0.02 > 2 * term(name, right, view)
    told = re.findall(r"text-anchor='end'[^>]*>([\d.]+)<", drawn(name))
    assert told == [f"{term(name, moving, view):.2f}" for moving in (wrong, right)]
