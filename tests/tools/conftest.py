"""What some tests of the tools need and not every machine has."""

import os

import pytest

from tools.quality.peers import flubber
from tools.quality.truth import letters


def installed(problem):
    """Skip a test that lacks something, but not in CI."""
    if problem:
        assert os.environ.get("CI") != "true", problem
        pytest.skip(problem)


@pytest.fixture(scope="session")
def node():
    """flubber, ready to run."""
    installed(flubber.ready())


@pytest.fixture(scope="session")
def fonts():
    """The folder with all letters, made anew."""
    installed(letters.ready())
    letters.make(letters.FOLDER)
    return letters.FOLDER
