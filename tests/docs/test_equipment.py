"""Nothing that a test needs is missing in CI, and pictures are drawn by the versions that drew those in docs."""

import os
import tomllib
from importlib.metadata import version
from pathlib import Path

import pytest

from tests.support.equipment import EQUIPMENT

PROJECT = tomllib.loads((Path(__file__).parents[2] / "pyproject.toml").read_text(encoding="utf-8"))


@pytest.mark.parametrize("name", EQUIPMENT)
def test_no_test_was_skipped_for_lack_of(name):
    problem = EQUIPMENT[name]()
    if problem and os.environ.get("CI") != "true":
        pytest.skip(f"no {name}: {problem}")
    assert problem is None, f"tests that need {name} were skipped, here or by make test-browser: {problem}"


def test_renderers_are_those_that_are_pinned():
    pinned = [text.split("==") for text in PROJECT["project"]["optional-dependencies"]["dev"] if "==" in text]
    assert {name for name, _ in pinned} == {"pillow", "resvg_py"}
    assert {name: version(name) for name, _ in pinned} == dict(pinned), "run make install"
