"""What users require of lines."""

import json
from pathlib import Path

import numpy as np
import pytest

from shapeblend_cli.cli import run
from shapeblend_cli.errors import MatchError
from shapeblend_cli.interpolate.paths import paths_at
from shapeblend_cli.pens.line_blends import REQUIRED
from shapeblend_cli.pens.moves import BECOMES, STAYS
from tests.pens.test_line_blends import ICONS, blend, reasons, strokes
from tests.support.drawings import drawing


def numbers(pair, reason=REQUIRED):
    return {
        tuple(part and part.name for part in shape.contours[0].lines)
        for shape in pair.shapes
        if shape.reason == reason
    }


def places(shape, t):
    (path,) = paths_at(shape, t)
    return np.append(path.segments[:, 0], path.segments[-1, 3])


def test_lines_become_those_that_are_named():
    assert numbers(blend("lucide-menu", "lucide-x", match=(("1", "0"), ("2", "1")))) == {
        ("1", "0"),
        ("2", "1"),
    }
    assert numbers(blend("ph-plus", "ph-check", match=(("0.2", "0"),))) == {("0.2", "0")}


def test_a_point_takes_the_nearest_line():
    pair = blend("lucide-menu", "lucide-x", match=((6 + 12.3j, 17 + 16j),))
    assert numbers(pair) == {("1", "1")}


def test_ids_name_the_lines_of_their_shapes():
    a = drawing(
        '<path id="up" d="M4 4V20" fill="none" stroke="#000"/><path d="M8 4V20" fill="none" stroke="#000"/>'
    )
    b = drawing(
        '<path d="M4 4H20" fill="none" stroke="#000"/><path id="low" d="M4 8H20" fill="none" stroke="#000"/>'
    )
    assert numbers(blend(a, b, match=(("up", "#low"),))) == {("0", "1")}


def test_pinned_points_meet():
    pair = blend("ph-plus", "ph-check", pins=((40 + 128j, 40 + 144j), (112 + 128j, 96 + 200j)))
    (line,) = [shape for shape in pair.shapes if shape.reason == REQUIRED]
    vertex = np.abs(places(line, 0.0) - (112 + 128j)).argmin()
    assert abs(places(line, 1.0)[vertex] - (96 + 200j)) < 3.0


def test_either_end_of_a_line_can_be_pinned_to_an_end():
    for end, other in ((18 + 6j, 6 + 18j), (6 + 18j, 18 + 6j)):
        pair = blend("lucide-menu", "lucide-x", pins=((4 + 5j, end),))
        (line,) = [shape for shape in pair.shapes if shape.reason == REQUIRED]
        first = np.abs(places(line, 0.0)[[0, -1]] - (4 + 5j)).argmin()
        assert abs(places(line, 1.0)[[0, -1]][first] - end) < 0.01
        assert abs(places(line, 1.0)[[0, -1]][1 - first] - other) < 0.01


def test_stiff_lines_correspond_otherwise():
    loose, stiff = (
        blend(strokes("M2 4H12V14"), strokes("M2 20C8 20 20 14 22 4"), strokes="recover", **more)
        for more in ({}, {"stiff": ((12 + 4j, 4.0, 50.0),)})
    )
    assert reasons(loose) == reasons(stiff) == [BECOMES]
    middle = [
        places(pair.shapes[0], 1.0)[np.abs(places(pair.shapes[0], 0.0) - (12 + 4j)).argmin()]
        for pair in (loose, stiff)
    ]
    assert abs(middle[0] - middle[1]) > 1e-3


def test_a_name_that_nothing_has_is_an_error():
    with pytest.raises(MatchError, match=r"has no line or contour '9'; its names are 0"):
        blend("lucide-menu", "lucide-x", match=(("9", "0"),))


def test_lines_and_solid_shapes_that_are_to_become_each_other_are_outlines():
    bars, disc = "M2 3H22V5H2Z M2 8H22V10H2Z", "M12 14A3 3 0 1 0 12 20A3 3 0 1 0 12 14Z"
    pair = blend(drawing(bars, disc), drawing(disc, bars), match=(("0", "0"),))
    assert not {STAYS, BECOMES, REQUIRED} & set(reasons(pair))


def test_the_report_says_which_part_of_a_line_moves_and_why_it_was_cut(here):
    files = [str(ICONS / f"ph-{name}.svg") for name in ("eye", "eye-slash")]
    assert run([*files, "--strokes", "recover", "--report", "r.json", "-n", "0", "-q"]) == 0
    (pair,) = json.loads(Path("r.json").read_text())["pairs"]
    parts = [each["lines"][0] for each in pair["contours"] if each["lines"][0]]
    assert {part["name"] for part in parts} == {"0", "2"}
    for part in parts:
        assert 0.0 < part["end"] - part["begin"] < 1.0
        assert "is elsewhere or ends" in part["because"]
