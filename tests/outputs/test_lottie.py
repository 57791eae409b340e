"""The Lottie file, by the letter of its format; how it plays is seen in a browser."""

import json
import math
import zipfile
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from shapeblend_cli.cli import run
from shapeblend_cli.model import Box, LinearGradient, PaintedShape, RadialGradient, Stop, Style
from shapeblend_cli.options.easing import LINEAR, Ease, Timing
from shapeblend_cli.outputs.lottie.lottie import lottie
from shapeblend_cli.outputs.move import Move, moved_shape, sections
from shapeblend_cli.paint.oklab import blend_colours
from tests.outputs.blends import each_blend, emitted
from tests.support.commands import names, write
from tests.support.contours import circle_contour, polygon_contour
from tests.support.drawings import BAR, EYED, LEAF, RING, svg
from tests.support.motions import rotated_move

VIEW = Box(0.0, 0.0, 24.0, 24.0)
TWO_SECONDS = Timing(2.0)


def of(contour, target, style=None, target_style=None, view=VIEW, timing=TWO_SECONDS):
    """A Lottie of one shape of one contour, and its items by type."""
    sides = PaintedShape((contour,), style or Style()), PaintedShape((target,), target_style or Style())
    shape = moved_shape("shape-1", *sides)
    found = json.loads(lottie([Move((shape,), (view, view))], timing, 4))
    return found, {item["ty"]: item for item in found["layers"][0]["shapes"][0]["it"]}


def properties(value):
    """Every property of a file: what has `a` and `k`."""
    if isinstance(value, dict):
        if value.keys() == {"a", "k"}:
            yield value
        for inner in value.values():
            yield from properties(inner)
    elif isinstance(value, list):
        for inner in value:
            yield from properties(inner)


LINEAR_LOTTIE = ("lottie", "blend.json", "--motion", "linear")
EASE = Ease(0.42, 0.0, 0.58, 1.0)
SQUARE = polygon_contour([2 + 2j, 10 + 2j, 10 + 10j, 2 + 10j])
DIAMOND = polygon_contour([6 + 0j, 12 + 6j, 6 + 12j, 6j])


@each_blend
def test_paths_have_as_many_vertices_at_both_ends_and_properties_keyframes_from_end_to_end(here, blend):
    found = json.loads(emitted(blend, *LINEAR_LOTTIE))
    layers = [layer["nm"] for layer in found["layers"]]
    assert layers
    assert layers == sorted(layers, reverse=True)  # what is painted last is the first layer
    assert [layer["ind"] for layer in found["layers"]] == list(range(1, len(layers) + 1))
    for layer in found["layers"]:
        assert (layer["ty"], layer["ip"], layer["op"]) == (4, 0, 121)
        (group,) = layer["shapes"]
        assert group["it"][-1]["ty"] == "tr"
        for item in group["it"]:
            if item["ty"] == "sh":
                keys = item["ks"]["k"]
                beziers = [key["s"][0] for key in keys] if item["ks"]["a"] else [keys]
                assert len({len(b[name]) for b in beziers for name in "vio"}) == 1
                assert len({b["c"] for b in beziers}) == 1
    for moving in properties(found):
        if moving["a"]:
            *keys, last = moving["k"]
            times = [key["t"] for key in moving["k"]]
            assert (times[0], times[-1]) == (0, 120)
            assert times == sorted(set(times))
            assert len(keys) == 1 or len(last["s"]) == 4, "colours alone have others between"
            assert all(set(key) == {"t", "s", "o", "i"} for key in keys)
            assert set(last) == {"t", "s"}
            assert all(isinstance(key["s"], list) for key in keys)


@each_blend
def test_numbers_are_finite_and_short(here, blend):
    seen = []
    json.loads(
        emitted(blend, *LINEAR_LOTTIE), parse_float=seen.append, parse_constant=lambda text: pytest.fail(text)
    )
    assert all(math.isfinite(float(text)) and len(text) <= 12 for text in seen)
    assert not [text for text in seen if text.endswith(".0")]


def test_straight_segments_have_no_tangents_and_the_first_vertex_is_not_repeated():
    _, items = of(SQUARE, DIAMOND)
    start, end = (key["s"][0] for key in items["sh"]["ks"]["k"])
    still = [[0, 0]] * 4
    assert start == {"c": True, "v": [[2, 2], [10, 2], [10, 10], [2, 10]], "i": still, "o": still}
    assert end["v"] == [[6, 0], [12, 6], [6, 12], [0, 6]]


def test_tangents_are_relative_and_the_closing_segment_comes_in_at_the_first_vertex():
    circle = circle_contour(12 + 12j, 10.0)
    _, items = of(circle, circle)
    assert items["sh"]["ks"]["a"] == 0
    found = items["sh"]["ks"]["k"]
    v, i, o = (np.array(found[name]) @ [1, 1j] for name in "vio")
    np.testing.assert_allclose(v, circle.segments[:, 0], atol=1e-4)
    np.testing.assert_allclose(v + o, circle.segments[:, 1], atol=2e-4)
    np.testing.assert_allclose(v + i, np.roll(circle.segments[:, 2], 1), atol=2e-4)


def test_an_open_line_has_one_vertex_more_than_segments():
    line = polygon_contour([2 + 2j, 10 + 2j, 10 + 10j], closed=False)
    _, items = of(line, line)
    still = [[0, 0]] * 3
    assert items["sh"]["ks"]["k"] == {"c": False, "v": [[2, 2], [10, 2], [10, 10]], "i": still, "o": still}


def test_paint():
    style = Style("#ff0000", 0.5, "evenodd", "#0000ff", 0.25, 2.0, "round", "bevel")
    _, items = of(SQUARE, SQUARE, style, style._replace(fill="#ff3300", stroke_width=4.0))
    assert list(items) == ["sh", "st", "fl", "tr"]  # what comes first is on top
    speed = {"o": {"x": [0], "y": [0]}, "i": {"x": [1], "y": [1]}}
    fill, stroke = items["fl"], items["st"]
    assert fill["c"] == {"a": 1, "k": [{"t": 0, "s": [1, 0, 0, 1], **speed}, {"t": 120, "s": [1, 0.2, 0, 1]}]}
    assert fill["o"] == {"a": 0, "k": 50}
    assert fill["r"] == 2
    assert stroke["w"] == {"a": 1, "k": [{"t": 0, "s": [2], **speed}, {"t": 120, "s": [4]}]}
    assert (stroke["c"]["k"], stroke["o"]["k"]) == ([0, 0, 1, 1], 25)
    assert (stroke["lc"], stroke["lj"], stroke["ml"]) == (2, 3, 4)


def test_colours_of_different_hues_are_mixed_as_in_frames():
    _, items = of(SQUARE, SQUARE, Style("#ff0000"), Style("#0000ff"))
    keys = items["fl"]["c"]["k"]
    assert len(keys) > 2
    for key in keys:
        mixed = blend_colours("#ff0000", "#0000ff", key["t"] / 120)
        assert key["s"][:3] == pytest.approx([c / 255 for c in bytes.fromhex(mixed[1:])], abs=0.01)


def test_dashes_have_more_decimals_than_coordinates():
    dashed = Style(None, stroke="#000000", stroke_dasharray=(0.325123, 2.0), stroke_dashoffset=1.987654)
    _, items = of(SQUARE, SQUARE, dashed, dashed)
    assert [part["v"]["k"] for part in items["st"]["d"]] == [0.325123, 2, 1.987654]


def test_dashes_and_gaps_in_turn():
    dashed = Style(None, stroke="#000000", stroke_dasharray=(4.0, 2.0), stroke_dashoffset=1.0)
    _, items = of(SQUARE, SQUARE, dashed, dashed._replace(stroke_dasharray=(6.0, 2.0)))
    dash, gap, offset = items["st"]["d"]
    assert [part["n"] for part in (dash, gap, offset)] == ["d", "g", "o"]
    assert [key["s"] for key in dash["v"]["k"]] == [[4], [6]]
    assert (gap["v"]["k"], offset["v"]["k"]) == (2, 1)


@pytest.mark.parametrize(("counts", "notes"), [((22, 26), 1), ((22, 11), 0), ((22, 0), 0)])
def test_a_note_tells_which_dashes_there_are_none_of(here, capsys, counts, notes):
    line = '<path d="M2 2H20V9" fill="none" stroke="#c00" stroke-dasharray="{}"/>'
    a, b = (svg(line.format(" ".join(map(str, range(1, count + 1))) or "none")) for count in counts)
    write(a=a, b=b)
    assert run(["a.svg", "b.svg", "--emit", "lottie"]) == 0
    assert capsys.readouterr().err.count("shape-1: Lottie cannot change the number of its dashes") == notes
    assert ('"n":"d"' in Path("blend.json").read_text(encoding="utf-8")) != bool(notes)


def test_gradients_have_a_line_or_a_radius_and_stops():
    stops = Stop(0.0, "#ff0000"), Stop(1.0, "#0000ff", 0.5)
    across = Style(fill_gradient=LinearGradient(2 + 2j, 10 + 2j, stops))
    down = Style(fill_gradient=LinearGradient(2 + 2j, 2 + 10j, stops))
    _, items = of(SQUARE, SQUARE, across, down)
    shade = items["gf"]
    assert (shade["t"], shade["s"]["k"]) == (1, [2, 2])
    assert [key["s"] for key in shade["e"]["k"]] == [[10, 2], [2, 10]]
    assert shade["g"] == {"p": 2, "k": {"a": 0, "k": [0, 1, 0, 0, 1, 0, 0, 1, 0, 1, 1, 0.5]}}
    light = RadialGradient(6 + 6j, (4.0, 4.0), 0.0, 0.5j, 0.0, stops)
    _, items = of(SQUARE, SQUARE, Style(fill_gradient=light), Style(fill_gradient=light))
    shade = items["gf"]
    assert (shade["t"], shade["s"]["k"], shade["e"]["k"]) == (2, [6, 6], [10, 6])
    assert (shade["h"]["k"], shade["a"]["k"]) == (50, 90)


def test_an_oval_gradient_is_a_round_one_in_a_group_that_is_squashed():
    light = RadialGradient(6 + 6j, (4.0, 2.0), 90.0, 0j, 0.0, (Stop(0.0, "#ff0000"), Stop(1.0, "#0000ff")))
    _, items = of(SQUARE, SQUARE, Style(fill_gradient=light), Style(fill_gradient=light))
    assert (items["tr"]["r"]["k"], items["tr"]["s"]["k"]) == (90, [100, 50])
    # What the group makes of a point: squashed, then given a quarter turn.
    placed = [[-y / 2, x] for x, y in (items["gf"]["s"]["k"], *items["sh"]["ks"]["k"]["v"])]
    assert placed == [[6, 6], [2, 2], [10, 2], [10, 10], [2, 10]]


@pytest.mark.parametrize(
    ("attributes", "notes"), [("", 0), ('spreadMethod="reflect"', 1), ('gradientTransform="skewX(30)"', 0)]
)
def test_a_note_tells_which_gradients_there_are_none_of(here, capsys, attributes, notes):
    shade = f'<linearGradient id="g" x2=".5" {attributes}><stop stop-color="red"/><stop offset="1"/></linearGradient>'
    write(a=svg(shade, f'<path d="{BAR}" fill="url(#g)"/>'), b=svg(BAR))
    assert run(["a.svg", "b.svg", "--emit", "lottie"]) == 0
    assert capsys.readouterr().err.count("shape-1: its gradient is a plain colour in Lottie") == notes


@pytest.mark.parametrize("ratio", ["1e-7", "1e-4"])
def test_a_gradient_that_is_nearly_flat_is_a_plain_colour(here, capsys, ratio):
    shade = f'<radialGradient id="g" gradientTransform="scale(1 {ratio})"><stop stop-color="red"/><stop offset="1"/>'
    write(a=svg(f"{shade}</radialGradient>", f'<path d="{BAR}" fill="url(#g)"/>'), b=svg(BAR))
    assert run(["a.svg", "a.svg", "--emit", "lottie"]) == 0
    assert "shape-1: its gradient is a plain colour in Lottie" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("view", "size", "percent", "centre"),
    [
        (Box(0.0, 0.0, 24.0, 24.0), (512, 512), 2133.33333, [12, 12, 0]),
        (Box(-50.0, 10.0, 300.0, 200.0), (300, 200), 100, [100, 110, 0]),
        (Box(0.0, 0.0, 0.5, 1000.25), (1, 512), 51.1872032, [0.25, 500.125, 0]),
        (Box(0.0, 0.0, 1e6, 5e5), (512, 256), 0.0512, [500000, 250000, 0]),
        (Box(0.0, 0.0, 1e20, 1e20), (512, 512), 5.12e-16, [5e19, 5e19, 0]),
    ],
)
def test_the_size_is_whole_and_the_view_is_in_its_middle(view, size, percent, centre):
    found, _ = of(SQUARE, DIAMOND, view=view)
    assert (found["w"], found["h"]) == size
    place = {name: value["k"] for name, value in found["layers"][0]["ks"].items()}
    assert place["s"] == [pytest.approx(percent), pytest.approx(percent), 100]
    assert place["a"] == centre
    assert place["p"] == [size[0] / 2, size[1] / 2, 0]


def test_seconds_and_ease():
    found, items = of(SQUARE, DIAMOND, timing=Timing(0.5, EASE))
    assert (found["fr"], found["op"]) == (60, 31)
    first, last = items["sh"]["ks"]["k"]
    assert (first["t"], first["o"], first["i"]) == (0, {"x": 0.42, "y": 0}, {"x": 0.58, "y": 1})
    assert last["t"] == 30


@pytest.mark.parametrize("ease", [LINEAR, EASE])
def test_paths_have_keyframes_at_their_waypoints(ease):
    move, _ = rotated_move(LEAF, EYED, attributes='fill="#333"')
    (shape,) = move.shapes
    found = json.loads(lottie([move, move], Timing(2.0, ease), 4))
    for layer, begin in zip(found["layers"], (120, 0), strict=True):
        items = layer["shapes"][0]["it"]
        paths = [item["ks"] for item in items if item["ty"] == "sh"]
        assert len(paths) == 2
        for path in paths:
            assert path["a"] == 1
            *keys, last = path["k"]
            times = [key["t"] for key in path["k"]]
            expected = [0.0, *(120 * ease.time_of(way.t) for way in shape.waypoints), 120.0]
            assert times == pytest.approx([begin + time for time in expected], abs=6e-4)
            assert times == sorted(set(times))
            assert set(last) == {"t", "s"}
            assert {len(key["s"][0][name]) for key in path["k"] for name in "vio"} == {len(last["s"][0]["v"])}
            for key in keys:
                assert set(key) == {"t", "s", "o", "i"}
                if ease.is_linear:
                    assert (key["o"], key["i"]) == ({"x": 0, "y": 0}, {"x": 1, "y": 1})


def test_sections_between_waypoints_have_their_share_of_the_ease_and_none_is_without_time():
    move, _ = rotated_move(LEAF, BAR)
    (shape,) = move.shapes
    stops = [
        (0.0, shape.start.paths),
        *((way.t, way.paths) for way in shape.waypoints),
        (1.0, shape.end.paths),
    ]
    found = sections(stops, 100.0, EASE, 3)
    assert len(found) == len(shape.waypoints) + 1
    progress = [0.0, *(way.t for way in shape.waypoints), 1.0]
    for section, low, high in zip(found, progress[:-1], progress[1:], strict=True):
        begin, until = section.times
        for share in (0.2, 0.5, 0.9):
            whole = EASE.at((begin + share * (until - begin)) / 100.0)
            assert low + section.ease.at(share) * (high - low) == pytest.approx(whole, abs=1e-4)
    for section, following in pairwise(found):
        assert section.end is following.start
        assert section.times[1] == following.times[0]
    rounded = sections(stops, 3.0, LINEAR, 0)
    assert [section.times for section in rounded] == [(0.0, 1.0), (1.0, 2.0), (2.0, 3.0)]
    assert sections(stops, 1.0, EASE, 0) == [(shape.start.paths, shape.end.paths, (0.0, 1.0), EASE)]


def test_a_sequence_has_the_layers_of_one_move_after_those_of_another(here, capfdbinary):
    write(a=svg(BAR), b=svg(LEAF), c=svg(RING))
    assert run(["a.svg", "b.svg", "c.svg", "--emit", "lottie", "-o", "-"]) == 0
    assert names() == ["a.svg", "b.svg", "c.svg"]
    found = json.loads(capfdbinary.readouterr().out)
    assert found["op"] == 241
    assert sorted({(layer["ip"], layer["op"]) for layer in found["layers"]}) == [(0, 120), (120, 241)]


def test_what_cannot_change_on_the_way_is_said():
    side = PaintedShape((SQUARE,), Style("#000000", stroke="#000000", stroke_linecap="round"))
    target = side._replace(style=side.style._replace(stroke_linecap="butt"))
    move = Move((moved_shape("shape-1", side, target),), (VIEW, VIEW))
    assert move.unsupported_in("Lottie") == [
        "shape-1: Lottie cannot change the line cap on the way; that of the first drawing stays"
    ]


def test_paint_that_one_side_alone_shows_has_its_rule_and_caps_from_there():
    seen = Style("#000000", 1.0, "evenodd", "#ff0000", stroke_linecap="round", stroke_linejoin="bevel")
    before = seen._replace(fill_opacity=0.0, fill_rule="nonzero", stroke_opacity=0.0, stroke_linecap="butt")
    for styles in ((before, seen), (seen, before)):
        _, items = of(SQUARE, DIAMOND, *styles)
        assert (items["fl"]["r"], items["st"]["lc"], items["st"]["lj"]) == (2, 2, 3)


def test_an_archive_has_the_animation_and_a_manifest(here, capsys):
    write(a=svg(BAR), b=svg(LEAF))
    for name, is_left_out in {
        "one.json": True,
        "one.lottie": False,
        "two.lottie": False,
        "one.xml": True,
    }.items():
        assert run(["a.svg", "b.svg", "-o", name, "--repeat", "pingpong"]) == 0
        assert ("--repeat pingpong is left out of" in capsys.readouterr().err) == is_left_out
    assert Path("one.lottie").read_bytes() == Path("two.lottie").read_bytes()
    with zipfile.ZipFile("one.lottie") as archive:
        manifest = json.loads(archive.read("manifest.json"))
        (animation,) = manifest["animations"]
        assert (animation["loop"], animation["playMode"]) == (True, "bounce")
        assert archive.read(f"animations/{animation['id']}.json") == Path("one.json").read_bytes()
