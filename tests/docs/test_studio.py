"""What docs/studio.md shows is what its command lines write today."""

import json

import pytest
from PIL import Image

from tests.docs.test_pictures import NEAR, differ
from tools.quality.tables import with_figures
from tools.studio.__main__ import BEGIN, END, FOLDER, KEPT, PAGE, drawings, drawn, told
from tools.studio.corrections import CORRECTIONS

FOUND = json.loads(KEPT.read_text(encoding="utf-8"))


@pytest.mark.parametrize("correction", CORRECTIONS, ids=lambda correction: correction.name)
def test_a_correction_is_what_its_command_line_draws(correction):
    with drawings():
        again = drawn(FOUND["corrections"][correction.name])
    with Image.open(FOLDER / f"{correction.name}.png") as kept:
        assert differ(again, kept) < 2 * NEAR  # what is kept has fewer colours


def test_the_document_says_what_was_found():
    text = PAGE.read_text(encoding="utf-8")
    assert with_figures(text, told(FOUND), BEGIN, END) == text
    assert len(CORRECTIONS) >= 5


def test_every_drawing_has_its_licence():
    named = (FOLDER / "README.md").read_text(encoding="utf-8")
    for file in FOLDER.glob("*.svg"):
        assert f"`{file.name}`" in named
