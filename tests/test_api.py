"""The Python API."""

import json
from pathlib import Path

import numpy as np
import pytest

import shapeblend_cli as sb
from shapeblend_cli.cli import run
from tests.support.commands import report
from tests.support.drawings import BAR, LEAF, svg
from tools import api_reference

ROOT = Path(__file__).parents[1]
E, F = (str(ROOT / "samples" / f"{name}.svg") for name in "ef")


@pytest.fixture(scope="module")
def letters():
    return sb.blend(E, F)


def test_the_reference_is_current():
    assert api_reference.PAGE.read_text(encoding="utf-8") == api_reference.page()
    assert {*api_reference.ORDER, "ShapeblendError", "__version__"} == {*sb.__all__} == {*dir(sb)}


@pytest.mark.parametrize(
    ("target", "options", "typed"),
    [
        ("x.svg", {"duration": 3.0, "repeat": "pingpong"}, ["--duration", "3", "--repeat", "pingpong"]),
        ("x.svg", {"animate": "css", "precision": 1}, ["--animate", "css", "--precision", "1"]),
        ("x", {"n": 3, "ends": True}, ["-n", "3", "--ends"]),
        ("x", {"emit": "pair"}, ["--emit", "pair"]),
        ("x.json", {"emit": "lottie"}, ["--emit", "lottie"]),
        ("x.png", {"n": 2, "width": 40}, ["-n", "2", "--width", "40"]),
    ],
)
def test_what_is_saved_is_what_the_command_writes(letters, here, target, options, typed):
    saved = letters.save(here / "api" / target, **options)
    assert run([E, F, "-o", f"command/{target}", *typed]) == 0
    assert saved
    for file in saved:
        assert file.read_bytes() == (here / "command" / file.relative_to(here / "api")).read_bytes()


def test_what_a_format_cannot_show_is_a_warning(tmp_path):
    steps = [str(ROOT / "samples" / f"step-{k}.svg") for k in (1, 2)]
    with pytest.warns(UserWarning, match="moves on curved paths, which two files cannot show"):
        sb.blend(*steps, motion="rigid").save(tmp_path / "pair", emit="pair")


def test_nothing_is_replaced_without_force(letters, tmp_path):
    (file,) = letters.save(tmp_path / "x.svg")
    with pytest.raises(sb.ShapeblendError, match=r"x\.svg: exists"):
        letters.save(file)
    assert letters.save(file, force=True) == [file]
    times = tmp_path / "times.json"
    times.write_text('{"0": {"start": 0.5}}')
    with pytest.raises(sb.ShapeblendError, match=r"times\.json: is an input"):
        sb.blend(E, F, timing=str(times)).save(times, force=True)


def test_a_report_is_that_of_the_command(letters, here):
    written = report(E, F, "-o", "x.svg")
    found = json.loads(json.dumps(letters.report()))
    assert found["inputs"] == [E, F]
    assert found["frames"] == written["frames"]
    assert found["pairs"][0]["contours"][0]["dots"] == written["pairs"][0]["contours"][0]["dots"]
    assert found["settings"].items() <= written["settings"].items()


def test_frames_are_pictures(letters):
    first, half = letters.frame(0), letters.frame(0.5)
    assert half._repr_svg_() == half.svg
    assert (repr(half), half.t) == ("<Picture at t = 0.5>", 0.5)
    start = sb.read(E).shapes[0].contours[0].segments
    np.testing.assert_array_equal(first.shapes[0].paths[0].segments, start)
    with pytest.raises(ValueError, match="t must lie between 0 and 1, not 2"):
        letters.frame(2)


def test_several_drawings_are_counted_through():
    blend = sb.blend([E, F, sb.read(E)], sb.Settings(vertices=40), frames=1, motion="linear")
    assert blend.settings == sb.Settings(vertices=40, frames=1, motion="linear")
    assert [(pair.a, pair.b) for pair in blend.pairs] == [(0, 1), (1, 2)]
    assert (blend.frame(1.25).t, blend.frame(2).t) == (0.25, 1.0)
    end = sb.read(E).shapes[0].contours[0].segments
    np.testing.assert_array_equal(blend.frame(2).shapes[0].paths[0].segments, end)
    assert blend.crossings(n=3) == 0


def test_points_are_pairs_or_complex_numbers():
    p, q = np.random.default_rng(3).normal(size=(2, 9, 2))
    pairs, numbers = sb.match(p, q), sb.match(p @ (1, 1j), q @ (1, 1j))
    np.testing.assert_array_equal(pairs.pairs, numbers.dots)
    assert pairs.work == numbers.work


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        (lambda: sb.Settings(vertices=-3), "vertices must be"),
        (lambda: sb.Settings(solver="magic"), "solver must be"),
        (lambda: sb.blend(E, F, k_b=-1.0), "k_b must be"),
        (lambda: sb.blend([E]), "a blend needs two drawings or more; 1 given"),
        (lambda: sb.blend(E, F).save("x.svg", duration=0), "duration must be"),
        (lambda: sb.blend(E, F).save("x.svg", fps=3), "fps is for"),
        (lambda: sb.blend(E, F).save("-"), "only the command writes to"),
        (lambda: sb.blend(E, F).save("x", n=0), "nothing is written: .* ends=True would write"),
        (lambda: sb.blend(E, F).crossings(-1), "n must be 0 or more, not -1"),
        (
            lambda: sb.blend([E, F, E], pins=((0, 0),)),
            "pins, match and stiff apply to two files; 3 given",
        ),
        (lambda: sb.match([0, 1, 2, 2], [0, 1, 1j]), "neighbouring vertices coincide"),
        (lambda: sb.match([0, 1], [0, 1, 1j]), "a list of 3 or more points"),
        (lambda: sb.match([0, 1, np.nan], [0, 1, 1j]), "a vertex is not finite"),
        (lambda: sb.match([(0, 0), (10**400, 1), (2, 2)], [0, 1, 1j]), "a list of 3 or more points"),
        (lambda: sb.match([(0, 0), (1,), (2, 2)], [0, 1, 1j]), "a list of 3 or more points"),
    ],
)
def test_errors_name_the_field(wrong, message, here):
    with pytest.raises(ValueError, match=message):
        wrong()
    assert list(here.iterdir()) == []


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        (lambda: sb.read(text=b"<svg/>"), "text must be str, not bytes"),
        (lambda: sb.blend(E, F, E), "settings must be Settings, not str; a list of drawings"),
        (lambda: sb.blend(E, F).save("x.svg", output="y.svg"), "save takes path in place of output"),
    ],
)
def test_arguments_of_another_kind_are_said(wrong, message, here):
    with pytest.raises(TypeError, match=message):
        wrong()
    assert list(here.iterdir()) == []


def test_a_name_that_is_not_there():
    with pytest.raises(AttributeError, match="has no attribute 'morph'"):
        sb.morph  # noqa: B018


def test_text_is_read_as_a_file_is_and_never_repeated_in_errors(here):
    text = svg(LEAF)
    Path("a.svg").write_text(text, "utf-8")
    assert sb.read(text=text).shapes[0].contours[0].segments.tolist() == (
        sb.read("a.svg").shapes[0].contours[0].segments.tolist()
    )
    for wrong in (text, "\n" + text, "no name\nof a file"):
        with pytest.raises(sb.ShapeblendError, match=r"^SVG text: .*read\(text=...\) would work$"):
            sb.blend(wrong, "a.svg")
    with pytest.raises(TypeError):
        sb.read("a.svg", text=text)


def test_constants_have_the_names_of_options_too():
    assert sb.Settings(ks=2.0, kt=1.0) == sb.Settings(k_s=2.0, k_t=1.0)
    assert sb.Settings(k_s=2.0).replace(ks=3.0).k_s == 3.0


def test_errors_name_fields_and_a_blend_shows_itself_as_an_animation(here):
    blend = sb.blend(sb.read(text=svg(LEAF)), sb.read(text=svg(BAR)))
    for options, words in {"x.gif": {"columns": 2}, "x.svg": {"lossless": True}}.items():
        with pytest.raises(sb.ShapeblendError) as error:
            blend.save(options, **words)
        assert str(error.value).startswith(f"{next(iter(words))} is for")
        assert "--" not in str(error.value)
    assert "<animate" in blend._repr_svg_()
    for suffix in ("json", "lottie", "xml", "svg"):
        assert blend.save(f"x.{suffix}") == [Path(f"x.{suffix}")]
