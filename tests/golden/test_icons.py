"""Blends of real icons, each of them another case of pairing or motion, look as they did."""

from pathlib import Path

import numpy as np
import pytest

import shapeblend_cli as sb
from tests.support.contours import furthest, polyline

HERE = Path(__file__).parent / "icons"
PAIRS = sorted(path.parent.name for path in HERE.glob("*/a.svg"))

VISIBLE = 0.005
"""Maximum distance between outlines that look alike, as a share of the view."""


def outlines(shape):
    for contour in shape.contours:
        end = contour.segments[0, 0] if contour.closed else contour.segments[-1, 3]
        yield np.append(polyline(contour, 16), end)


def assert_looks_like(found, expected):
    for shape, other in zip(found.shapes, expected.shapes, strict=True):
        assert shape.style == other.style
        for line, known in zip(outlines(shape), outlines(other), strict=True):
            away = max(furthest(line, known), furthest(known, line))
            assert away <= VISIBLE * expected.viewbox.larger_side


@pytest.mark.parametrize("name", PAIRS)
def test_icons_look_as_they_did_on_their_way(name, tmp_path, request):
    blend = sb.blend(HERE / name / "a.svg", HERE / name / "b.svg", times=(0.6,))
    (file,) = blend.save(tmp_path / "out", precision=1)
    expected = HERE / name / "between.svg"
    if request.config.getoption("--update-golden"):
        expected.write_bytes(file.read_bytes())
    assert_looks_like(sb.read(file), sb.read(expected))
