"""Lines that are drawn on or back where formats trim paths."""

import json
import re
from pathlib import Path

import numpy as np
import pytest

from shapeblend_cli.cli import run
from shapeblend_cli.geometry.polyline import cumulative_lengths, points_at
from shapeblend_cli.interpolate.paths import paths_at
from shapeblend_cli.pens.moves import DRAWN_ON, STAYS
from tests.pens.test_line_blends import ICONS, blend, strokes

NAMES = "ph-eye", "ph-eye-slash"


def drawn(trim, t):
    """The two ends of the part of a trimmed line that is seen at a time."""
    path = (1 - t) * trim.start.segments + t * trim.end.segments
    points = np.append(path[:, 0], path[-1, 3])
    along = cumulative_lengths(points)
    times = [time for time, _ in trim.parts]
    shares = np.array([np.interp(t, times, [part[side] for _, part in trim.parts]) for side in (0, 1)])
    return points_at(shares * along[-1], points, along)


@pytest.mark.parametrize("backwards", [False, True])
def test_the_part_of_a_trimmed_line_that_is_seen_is_that_of_the_frames(backwards):
    pair = blend(*NAMES[:: -1 if backwards else 1], strokes="recover")
    trimmed = [shape for shape in pair.shapes if shape.trim]
    assert {shape.reason for shape in trimmed} >= {STAYS}
    for shape in trimmed:
        for t in (0.0, 0.3, 0.5, 0.9, 1.0):
            (path,) = paths_at(shape, shape.time_of(t))
            ends = path.segments[[0, -1], [0, 3]]
            assert np.abs(drawn(shape.trim, t) - ends).max() < 0.01 * pair.views[0].larger_side


def test_a_lottie_has_trim_paths_and_an_avd_too(here):
    files = [*(str(ICONS / f"{name}.svg") for name in NAMES), "--strokes", "recover"]
    assert run([*files, "--emit", "lottie", "-o", "x.json", "-q"]) == 0
    layers = json.loads(Path("x.json").read_text())["layers"]
    items = [[item["ty"] for item in layer["shapes"][0]["it"]] for layer in layers]
    assert all(kinds == ["sh", "tm", "st", "tr"] for kinds in items)
    assert run([*files, "--emit", "avd", "-o", "x.xml", "-q"]) == 0
    text = Path("x.xml").read_text()
    assert re.search('propertyName="trimPathEnd" .*valueFrom="0" android:valueTo="1"', text)


def test_a_line_that_comes_late_is_trimmed_late():
    pair = blend(strokes("M2 20H20"), strokes("M4 2V20M16 8V12"), strokes="recover")
    (new,) = [shape for shape in pair.shapes if shape.reason == DRAWN_ON]
    assert new.span[0] > 0.0
    (_, (low, high)), *_, (_, last) = new.trim.parts
    assert low == high
    assert last == (0.0, 1.0)


def test_a_line_that_comes_to_what_rests_comes_all_of_the_time():
    pair = blend(strokes("M2 12H8"), strokes("M2 12H8M16 8V16"), strokes="recover")
    (new,) = [shape for shape in pair.shapes if shape.reason == DRAWN_ON]
    assert new.span == (0.0, 1.0)
