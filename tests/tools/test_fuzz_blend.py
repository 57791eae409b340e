"""The fuzzer of whole blends finds what it looks for, and nothing else."""

import pytest

from tests.support.drawings import BAR, LEAF, svg
from tools import fuzz_blend
from tools.fuzz_reader import SEEDS, seeds

GOOD = [svg(BAR).encode(), svg(LEAF).encode()]


def test_a_case_is_made_from_its_number_alone():
    files = seeds(SEEDS[1:])
    assert fuzz_blend.case(5, files) == fuzz_blend.case(5, files) != fuzz_blend.case(6, files)


def test_nothing_is_found_in_good_runs_and_in_errors_of_ours(here):
    assert fuzz_blend.complaint(GOOD, ["-o", "x.svg", "-n", "1"]) == (None, "done")
    assert fuzz_blend.complaint([GOOD[0], b"no drawing"], []) == (None, "refused")
    assert fuzz_blend.complaint(GOOD, ["--columns", "3"]) == (None, "usage")


@pytest.mark.parametrize("text", ['<svg d="M0 nan"/>', "<svg", '<svg x="-inf 3"/>'])
def test_what_is_not_finite_or_not_xml_is_found(here, monkeypatch, text):
    monkeypatch.setattr(fuzz_blend, "run", lambda _: (here / "x.svg").write_text(text) and 0)
    found, end = fuzz_blend.complaint(GOOD, [])
    assert (end, found.startswith("x.svg: ")) == ("failed", True)


def test_an_error_that_is_not_ours_is_found(here, monkeypatch):
    monkeypatch.setattr(fuzz_blend, "run", lambda _: [][0])
    found, end = fuzz_blend.complaint(GOOD, [])
    assert (end, "IndexError" in found) == ("failed", True)
