"""What drawing and measuring anew needs beside the package."""

import pytest

from tests.support.equipment import require
from tools.quality.morphs import make
from tools.quality.peers import LIBRARIES
from tools.quality.truth import letters


@pytest.fixture(scope="session")
def node():
    """flubber, ready to run."""
    require("flubber")


@pytest.fixture(scope="session")
def libraries(node):
    """All that node runs, ready to run."""
    require("KUTE.js")
    require("polymorph")
    return LIBRARIES


@pytest.fixture(scope="session")
def fonts():
    """The folder with all letters, made anew."""
    require("fonts")
    letters.make(letters.FOLDER)
    return letters.FOLDER


@pytest.fixture(scope="session")
def morphs():
    """The folder with limbs and morphs, made anew."""
    require("morphs")
    make.make(make.FOLDER)
    return make.FOLDER
