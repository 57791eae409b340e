"""The animated vector drawable: no Android is here, so it is held against Android's reference."""

import re
from itertools import pairwise
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest

from shapeblend_cli.cli import run
from shapeblend_cli.model import Box, PaintedShape, Style
from shapeblend_cli.options.easing import LINEAR, Ease, Timing
from shapeblend_cli.outputs.avd import animated_vector
from shapeblend_cli.outputs.move import Move, moved_shape
from shapeblend_cli.svg.writing.path_data import path_data
from tests.outputs.blends import BLENDS, each_blend, emitted, write_blend
from tests.support.commands import write
from tests.support.contours import polygon_contour
from tests.support.drawings import BAR, LEAF, svg
from tests.support.motions import rotated_move
from tests.support.pictures import difference, pixels

EASE = Ease(0.42, 0.0, 0.58, 1.0)
ANDROID = "{http://schemas.android.com/apk/res/android}"
AAPT = "{http://schemas.android.com/aapt}"
NUMBER = re.compile(r"-?\d+(?:\.\d+)?")
COMMANDS = re.compile(r"(?:[MLC ]-?\d+(?:\.\d+)?,-?\d+(?:\.\d+)?(?: -?\d+(?:\.\d+)?,-?\d+(?:\.\d+)?)*|Z)+")

# What the reference lists: attributes of a path, as SVG has them, and which of them an animator may move.
MOVES = {
    "pathData": "pathType",
    **dict.fromkeys(("fillColor", "strokeColor"), "colorType"),
    **dict.fromkeys(("fillAlpha", "strokeAlpha", "strokeWidth"), "floatType"),
}
TO_SVG = {
    **{"pathData": "d", "fillColor": "fill", "fillAlpha": "fill-opacity", "fillType": "fill-rule"},
    **{"strokeColor": "stroke", "strokeAlpha": "stroke-opacity", "strokeWidth": "stroke-width"},
    **{"strokeLineCap": "stroke-linecap", "strokeLineJoin": "stroke-linejoin"},
    "strokeMiterLimit": "stroke-miterlimit",
}
PATH = {"name", *TO_SVG}


def emit_avd(blend):
    return ElementTree.fromstring(emitted(blend, "avd", "blend.xml", "--motion", "linear"))


def android(element):
    return {name.removeprefix(ANDROID): value for name, value in element.attrib.items()}


def inline(element, name):
    (found,) = (attr for attr in element.findall(AAPT + "attr") if attr.get("name") == f"android:{name}")
    (value,) = found
    return value


def animators(root):
    """Which path, what moves, from where, to where."""
    for target in root.findall("target"):
        for animator in inline(target, "animation").iter("objectAnimator"):
            yield android(target)["name"], android(animator)


def shown(root, at_the_end):
    """An SVG of what Android shows before or after the animation."""
    vector = inline(root, "drawable")
    size = android(vector)
    moved = {
        (name, a["propertyName"]): a["valueTo" if at_the_end else "valueFrom"] for name, a in animators(root)
    }
    paths = []
    for path in vector.iter("path"):
        attributes = {"fillColor": "none"} | android(path)
        name = attributes.pop("name")
        attributes |= {key: value for (of, key), value in moved.items() if of == name}
        attributes["fillType"] = attributes.get("fillType", "nonzero").lower()
        if attributes.get("strokeWidth") == "0":  # a hairline of a point, which resvg does not draw at all
            attributes.pop("strokeColor")
        paths.append(
            "<path " + " ".join(f'{TO_SVG[key]}="{value}"' for key, value in attributes.items()) + "/>"
        )
    group = vector.find("group")
    shift = {} if group is None else android(group)
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {size["viewportWidth"]} {size["viewportHeight"]}">'
        f'<g transform="translate({shift.get("translateX", 0)} {shift.get("translateY", 0)})">'
        f"{''.join(paths)}</g></svg>"
    )


@each_blend
def test_it_is_what_the_reference_describes_alike_at_both_ends_which_are_the_drawings(here, blend):
    root = emit_avd(blend)
    assert root.tag == "animated-vector"
    vector = inline(root, "drawable")
    assert vector.tag == "vector"
    assert set(android(vector)) == {"width", "height", "viewportWidth", "viewportHeight"}
    assert all(android(vector)[side].endswith("dp") for side in ("width", "height"))
    drawn = [android(path) for path in vector.iter("path")]
    paths = {path["name"]: path for path in drawn}
    assert list(paths) == [f"shape-{k + 1}" for k in range(len(drawn))]
    for path in drawn:
        assert set(path) <= PATH
        assert COMMANDS.fullmatch(path["pathData"])
    assert {element.tag for element in vector} <= {"path", "group"}
    targets = [android(target)["name"] for target in root.findall("target")]
    assert len(set(targets)) == len(targets)
    assert set(targets) <= set(paths)
    for name, animator in animators(root):
        key = animator["propertyName"]
        assert animator["valueType"] == MOVES[key]
        assert animator["duration"] == "2000"
        assert animator["valueFrom"] != animator["valueTo"]
        assert paths[name].get(key, "1") == animator["valueFrom"]  # only an opacity has a default
        if key == "pathData":
            assert NUMBER.sub("0", animator["valueFrom"]) == NUMBER.sub("0", animator["valueTo"])
            assert COMMANDS.fullmatch(animator["valueTo"])
    if blend not in ("another viewBox", "lines"):
        for drawing, at_the_end in zip(BLENDS[blend], (False, True), strict=True):
            assert difference(pixels(shown(root, at_the_end)), pixels(drawing)) < 1e-3


def test_the_corner_of_the_view_is_moved_to_the_origin(here):
    root = emit_avd("another viewBox")
    vector = inline(root, "drawable")
    assert android(vector) == {
        "width": "40dp", "height": "40dp", "viewportWidth": "40", "viewportHeight": "40"
    }  # fmt: skip
    assert android(vector.find("group")) == {"translateX": "50", "translateY": "20"}


def test_seconds_ease_and_size():
    shape = PaintedShape((polygon_contour([0j, 1000 + 0j, 1000 + 500j]),), Style("#000000"))
    view = Box(0.0, 0.0, 1000.0, 500.0)
    move = Move((moved_shape("shape-1", shape, shape._replace(style=Style("#ffffff"))),), (view, view))
    root = ElementTree.fromstring(animated_vector(move, Timing(0.3, EASE), 3))
    ((_, animator),) = animators(root)
    assert animator == {
        "propertyName": "fillColor",
        "duration": "300",
        "valueFrom": "#000000",
        "valueTo": "#ffffff",
        "valueType": "colorType",
    }
    (curve,) = root.iter("pathInterpolator")
    assert android(curve) == {"controlX1": "0.42", "controlY1": "0", "controlX2": "0.58", "controlY2": "1"}
    size = android(inline(root, "drawable"))
    assert (size["width"], size["height"], size["viewportWidth"]) == ("200dp", "100dp", "1000")


@pytest.mark.parametrize("ease", [LINEAR, EASE])
@pytest.mark.parametrize(("colours", "seconds"), [(("#333333", "#999999"), 2.0), (("#333333",) * 2, 0.05)])
def test_paths_go_from_waypoint_to_waypoint_one_after_the_other(ease, colours, seconds):
    leaf, bar = (f'<path d="{d}" fill="{c}"/>' for d, c in zip((LEAF, BAR), colours, strict=True))
    move, _ = rotated_move(leaf, bar)
    root = ElementTree.fromstring(animated_vector(move, Timing(seconds, ease), 3))
    (shape,) = move.shapes
    animation = inline(root.find("target"), "animation")
    assert animation.tag == "set"
    if colours[0] == colours[1]:
        sequence = animation
    else:
        assert android(animation) == {}
        sequence, fill = animation
        assert (android(fill)["propertyName"], android(fill)["duration"]) == ("fillColor", "2000")
    assert android(sequence) == {"ordering": "sequentially"}
    steps = [android(step) for step in sequence]
    assert {(step["propertyName"], step["valueType"]) for step in steps} == {("pathData", "pathType")}
    durations = [int(step["duration"]) for step in steps]
    assert sum(durations) == 1000 * seconds
    assert min(durations) > 0
    if seconds == 2.0:
        times = [2000 * ease.time_of(way.t) for way in shape.waypoints] + [2000]
        assert np.cumsum(durations) == pytest.approx(times, abs=0.5)
        assert [step["valueTo"] for step in steps[:-1]] == [
            path_data(way.paths, 3) for way in shape.waypoints
        ]
    (path,) = inline(root, "drawable").iter("path")
    assert android(path)["pathData"] == steps[0]["valueFrom"]
    assert steps[-1]["valueTo"] == path_data(shape.end.paths, 3)
    for step, following in pairwise(steps):
        assert step["valueTo"] == following["valueFrom"]
    assert len({NUMBER.sub("0", step["valueTo"]) for step in steps}) == 1


def test_drawings_that_are_the_same_have_nothing_to_move(here):
    write_blend("holes")
    assert run(["a.svg", "a.svg", "--emit", "avd", "-o", "-", "--report", "r.json"]) == 0
    assert run(["a.svg", "a.svg", "--emit", "avd"]) == 0
    assert ElementTree.parse(here / "blend.xml").getroot().findall("target") == []


def test_what_cannot_change_on_the_way_is_said(here, capsys):
    emitted("lines", "avd", "blend.xml")
    assert capsys.readouterr().err.splitlines() == [
        f"shapeblend: shape-1: Android cannot change the line {what} on the way; that of the first drawing stays"
        for what in ("cap", "join")
    ]


def test_a_path_that_is_too_long_for_android_is_said(here, capsys):
    emitted("holes", "avd", "blend.xml", "--polygons", "--vertices", "500", "--precision", "10")
    (line,) = capsys.readouterr().err.splitlines()
    assert re.fullmatch(
        r"shapeblend: shape-1: its path has \d{5} characters, and Android takes 32767; .*", line
    )


def test_the_miter_limit_is_the_drawings_and_a_note_says_that_there_are_no_dashes(here, capsys):
    line = '<path d="M2 2H20V9" fill="none" stroke="#c00" stroke-miterlimit="9" {}/>'
    write(a=svg(line.format("")), b=svg(line.format('stroke-dasharray="4 2"')))
    assert run(["a.svg", "b.svg", "--emit", "avd"]) == 0
    assert 'android:strokeMiterLimit="9"' in Path("blend.xml").read_text(encoding="utf-8")
    assert "shape-1: Android draws no dashes; its stroke is solid" in capsys.readouterr().err


def test_easing_beyond_the_drawings_is_a_sequence_of_steps_that_go_there(here):
    write(a=svg("M4 4H12V20H4Z"), b=svg("M4 4H14V20H4Z"))
    assert run(["a.svg", "b.svg", "-o", "x.xml", "--ease", "back", "--duration", "1", "-q"]) == 0
    root = ElementTree.fromstring(Path("x.xml").read_text("utf-8"))
    steps = [animator for _, animator in animators(root) if animator["propertyName"] == "pathData"]
    widest = [max(map(float, NUMBER.findall(step["valueTo"])[::2])) for step in steps]
    assert sum(int(step["duration"]) for step in steps) == pytest.approx(1000, abs=len(steps))
    assert (max(widest), widest[-1]) == (pytest.approx(14.2, abs=0.02), 14.0)
    assert all(one["valueTo"] == two["valueFrom"] for one, two in pairwise(steps))
