"""Real files of several editors and icon sets, against Chromium."""

import json
from pathlib import Path

import numpy as np
import pytest

from shapeblend_cli.geometry.cubics import bounds
from shapeblend_cli.svg.reading.read import read
from tests.svg.reading.drawings import length

FILES = Path(__file__).with_name("files")
TRUTH = json.loads((FILES / "truth.json").read_text(encoding="utf-8"))


@pytest.mark.parametrize("name", TRUTH)
def test_file_is_read_as_chromium_reads_it(name):
    truth = TRUTH[name]
    drawing = read(str(FILES / name))
    assert len(drawing.shapes) == truth["shapes"]
    assert length(drawing) == pytest.approx(truth["length"], rel=1e-3)
    x, y, width, height = bounds(np.concatenate([c.segments for s in drawing.shapes for c in s.contours]))
    assert np.allclose([x, y, x + width, y + height], truth["bbox"], rtol=0, atol=1e-3 * max(width, height))


def test_every_file_has_a_licence():
    licences = (FILES / "LICENCES.md").read_text(encoding="utf-8")
    assert {path.name for path in FILES.glob("*.svg")} == set(TRUTH)
    assert [name for name in TRUTH if name not in licences] == []
