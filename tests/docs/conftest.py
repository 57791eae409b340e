"""What drawing and measuring anew needs beside the package."""

import pytest

from tests.support.equipment import require
from tools.quality.truth import letters


@pytest.fixture(scope="session")
def node():
    """flubber, ready to run."""
    require("flubber")


@pytest.fixture(scope="session")
def fonts():
    """The folder with all letters, made anew."""
    require("fonts")
    letters.make(letters.FOLDER)
    return letters.FOLDER
