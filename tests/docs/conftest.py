"""What measuring anew needs beside the package."""

import pytest

from tests.support.equipment import require
from tools.quality.morphs import make
from tools.quality.truth import letters


@pytest.fixture(scope="session")
def truths():
    """Letters, limbs and morphs whose in-betweens are known, made anew."""
    require("fonts, icons and animations")
    letters.make(letters.FOLDER)
    make.make(make.FOLDER)
