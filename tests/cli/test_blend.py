"""The command as its users run it."""

import json
import re
from xml.etree import ElementTree

import numpy as np
import pytest

from shapeblend_cli.cli import run
from tests.support.commands import contours, names, points, process, report, viewbox, write

SVG = "{http://www.w3.org/2000/svg}"
SQUARE = "M0 0H10V10H0Z"
TRIANGLE = "M0 0H10L0 10Z"


def svg(d, attributes=""):
    return f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 10 10"><path d="{d}" {attributes}/></svg>'


@pytest.fixture
def here(here):
    write(a=svg(SQUARE, 'fill="#ff0000"'), b=svg(TRIANGLE, 'fill="#0000ff"'))
    return here


def path_of(file):
    (path,) = ElementTree.parse(file).getroot().iter(SVG + "path")
    return path


def test_five_frames_in_a_folder_named_blend_whose_names_have_one_width(here, capsys):
    assert run(["a.svg", "b.svg"]) == 0
    assert capsys.readouterr() == ("", "")
    assert names() == ["a.svg", "b.svg", "blend", *(f"blend/frame-{k}.svg" for k in range(1, 6))]
    assert run(["a.svg", "b.svg", "-n", "10", "--ends", "-o", "out"]) == 0
    assert [p.name for p in sorted((here / "out").iterdir())] == [f"frame-{k:02d}.svg" for k in range(1, 13)]


def test_frames_at_the_ends_are_the_polygons_of_the_inputs(here):
    (contour,) = contours("a.svg", "b.svg", "-n", "1", "--ends", "-o", "out", "--polygons")
    dots = np.array(contour["dots"])
    for frame, side, fill in ((1, 0, "#ff0000"), (3, 1, "#0000ff")):
        path = path_of(here / f"out/frame-{frame}.svg")
        vertices = np.array(contour[["vertices_a", "vertices_b"][side]]) @ [1, 1j]
        np.testing.assert_allclose(points(path.get("d")), vertices[dots[:, side]], atol=1e-4)
        assert path.get("fill") == fill
    middle = path_of(here / "out/frame-2.svg")
    assert middle.get("fill") == "#ac1eb7"
    ends = [points(path_of(here / f"out/frame-{k}.svg").get("d")) for k in (1, 3)]
    np.testing.assert_allclose(points(middle.get("d")), sum(ends) / 2, atol=1e-4)


def test_the_viewbox_is_that_of_the_inputs(here):
    assert run(["a.svg", "b.svg", "--ends", "-o", "out"]) == 0
    assert [viewbox(file) for file in here.glob("out/*")] == [[0, 0, 10, 10]] * 7
    write(b=svg(TRIANGLE).replace("0 0 10 10", "-5 0 20 10"))
    assert run(["a.svg", "b.svg", "-n", "1", "--ends", "-o", "out", "--place", "asis", "-f"]) == 0
    boxes = [viewbox(f"out/frame-{k}.svg") for k in (1, 2, 3)]
    assert boxes == [[0, 0, 10, 10], [-2.5, 0, 15, 10], [-5, 0, 20, 10]]


TOO_SMALL = 'viewBox="2 2 4 4"'


@pytest.mark.parametrize("keeping", ["auto", "keep"])
def test_a_viewbox_that_cuts_off_a_drawing_is_kept(here, keeping):
    write(a=svg(SQUARE).replace('viewBox="0 0 10 10"', TOO_SMALL))
    assert run(["a.svg", "a.svg", "--ends", "-o", "out", "--viewbox", keeping]) == 0
    assert [viewbox(file) for file in here.glob("out/*")] == [[2, 2, 4, 4]] * 7


@pytest.mark.parametrize(
    ("given", "keeping"), [("", "auto"), ("", "keep"), (TOO_SMALL, "grow"), ('viewBox="-9 -9 9 9"', "auto")]
)
def test_the_view_holds_what_is_drawn(here, given, keeping):
    write(
        a=svg(SQUARE).replace('viewBox="0 0 10 10"', given),
        b=svg(TRIANGLE).replace('viewBox="0 0 10 10"', given),
    )
    assert run(["a.svg", "b.svg", "--ends", "-o", "out", "--viewbox", keeping]) == 0
    for file in here.glob("out/*"):
        x, y, width, height = viewbox(file)
        z = points(file.read_text())
        assert x < z.real.min() < z.real.max() < x + width
        assert y < z.imag.min() < z.imag.max() < y + height
        assert max(width, height) < (12 if given != 'viewBox="-9 -9 9 9"' else 20)


@pytest.mark.parametrize("arguments", [["-o", "x.svg"], ["-o", "-"]])
def test_one_animated_file_with_two_keyframes_of_equal_commands(here, capfdbinary, arguments):
    assert run(["a.svg", "b.svg", *arguments]) == 0
    out = capfdbinary.readouterr().out
    text = (here / "x.svg").read_bytes() if arguments[1] == "x.svg" else out
    assert names() == ["a.svg", "b.svg"] + ["x.svg"] * (arguments[1] == "x.svg")
    (path,) = ElementTree.fromstring(text).iter(SVG + "path")
    animated = {a.get("attributeName"): a.get("values").split(";") for a in path}
    assert set(animated) == {"d", "fill"}
    assert (animated["fill"][0], animated["fill"][-1], path.get("fill")) == ("#ff0000", "#0000ff", "#ff0000")
    start, end = animated["d"]
    assert start == path.get("d")
    assert re.sub(r"[-\d. ]+", "", start) == re.sub(r"[-\d. ]+", "", end)


def test_the_report_is_that_of_the_page(here, capfdbinary):
    assert run(["a.svg", "b.svg", "-n", "2", "--report", "-", "--kb", "0.5", "--preset", "fig1"]) == 0
    report = json.loads(capfdbinary.readouterr().out)
    assert list(report) == ["report", "version", "inputs", "settings", "pairs", "frames", "seconds"]
    assert report["inputs"] == ["a.svg", "b.svg"]
    settings = report["settings"]
    assert {k: settings[k] for k in ("ks", "kb", "es", "eb", "pb", "mb", "cs", "bending", "kt", "smoothing")} == {
        "ks": 1.0, "kb": 0.5, "es": 2.0, "eb": 2.0, "pb": 1000.0, "mb": 10.0, "cs": 0.5,
        "bending": "paper", "kt": 0.0, "smoothing": 0.0,
    }  # fmt: skip
    assert [settings[k] for k in ("frames", "vertices", "place", "start")] == [2, 200, "viewbox", "auto"]
    (pair,) = report["pairs"]
    (contour,) = pair["contours"]
    assert list(contour) == [
        "a", "b", "closed", "vertices_a", "vertices_b", "scale_a", "scale_b", "dots", "start",
        "work", "stretching", "bending", "travel", "lower_bound", "gap",
        "diagonal_deviation", "zero_angles", "sweeps", "seconds",
        "turned_back", "motion", "motion_because", "candidates", "pair_because", "lines",
    ]  # fmt: skip
    assert [contour[k] for k in ("a", "b", "closed")] == [0, 0, True]
    assert contour["scale_a"] == pytest.approx(10.0)
    assert contour["work"] == pytest.approx(contour["stretching"] + contour["bending"])
    assert contour["start"] == contour["dots"][0]
    steps = np.diff(np.array(contour["dots"] + contour["dots"][:1]), axis=0)
    steps %= [len(contour["vertices_a"]), len(contour["vertices_b"])]
    assert {tuple(s) for s in steps.tolist()} <= {(1, 0), (0, 1), (1, 1)}
    assert [f["file"] for f in report["frames"]] == ["frame-1.svg", "frame-2.svg"]
    assert [f["t"] for f in report["frames"]] == pytest.approx([1 / 3, 2 / 3])
    assert {f["self_crossings"] for f in report["frames"]} == {0}
    assert 50 < report["frames"][1]["area"] < report["frames"][0]["area"] < 100


def test_the_solver_alone(here, capfdbinary):
    assert run(["a.svg", "b.svg", "-n", "0", "--report", "-", "--start", "0,0", "--vertices", "0"]) == 0
    found = json.loads(capfdbinary.readouterr().out)
    (contour,) = found["pairs"][0]["contours"]
    assert contour["start"] == [0, 0]
    assert contour["vertices_a"] == [[0, 0], [10, 0], [10, 10], [0, 10]]
    assert found["frames"] == []
    assert names() == ["a.svg", "b.svg"]


def test_a_second_run_needs_force_and_leaves_what_it_does_not_write(here, capsys):
    assert run(["a.svg", "b.svg", "-n", "2"]) == 0
    before = (here / "blend/frame-1.svg").read_bytes()
    (here / "blend/mine.txt").write_text("keep")
    assert run(["b.svg", "a.svg", "-n", "2"]) == 1
    assert capsys.readouterr().err == "shapeblend: blend/frame-1.svg: exists; --force replaces it\n"
    assert (here / "blend/frame-1.svg").read_bytes() == before
    assert run(["b.svg", "a.svg", "-n", "2", "--force"]) == 0
    assert (here / "blend/frame-1.svg").read_bytes() != before
    assert (here / "blend/mine.txt").read_text() == "keep"


def test_frames_of_a_longer_run_are_left_and_named(here, capsys):
    assert run(["a.svg", "b.svg", "-n", "4", "-o", "out"]) == 0
    assert run(["a.svg", "b.svg", "-n", "2", "-o", "out", "-f"]) == 0
    said = capsys.readouterr().err
    assert said == "shapeblend: out: 2 frame files of another run remain, frame-3.svg among them\n"
    assert len(list((here / "out").iterdir())) == 4


@pytest.mark.parametrize(("place", "shift"), [("viewbox", 0.0), ("asis", 90.0), ("bbox", 0.0)])
def test_place(here, place, shift):
    # The same square, ten times as large and somewhere else in its file.
    write(b=svg("M90 90H190V190H90Z").replace("0 0 10 10", "90 90 100 100"))
    (contour,) = contours("a.svg", "b.svg", "-n", "0", "--place", place, "--vertices", "0")
    b = np.array(contour["vertices_b"])
    assert b.min(axis=0).tolist() == pytest.approx([shift, shift])
    assert np.ptp(b, axis=0).tolist() == pytest.approx([100, 100] if place == "asis" else [10, 10])
    assert contour["work"] == pytest.approx(0.0, abs=1e-9)


def test_open_lines_blend_in_the_direction_that_costs_less(here):
    paint = 'fill="none" stroke="#00ff00" stroke-width="2"'
    write(a=svg("M0 0H8V2", paint), b=svg("M8 3V1H0", paint))
    (contour,) = contours("a.svg", "b.svg", "-n", "1", "-o", "out")
    assert contour["closed"] is False
    assert contour["vertices_b"][0] == pytest.approx([0, 1])
    assert contour["dots"][0] == [0, 0]
    assert contour["dots"][-1] == [len(contour["vertices_a"]) - 1, len(contour["vertices_b"]) - 1]
    assert contour["work"] == pytest.approx(0.0, abs=1e-9)
    path = path_of(here / "out/frame-1.svg")
    assert not path.get("d").endswith("Z")
    assert (path.get("fill"), path.get("stroke"), path.get("stroke-width")) == ("none", "#00ff00", "2")


def test_what_is_left_out_is_said_unless_quiet(here, capsys):
    write(a=svg(SQUARE).replace("</svg>", '<path d="M2 2H4Z"/></svg>'))
    assert run(["a.svg", "b.svg", "-o", "one", "--vertices", "0"]) == 0
    said = capsys.readouterr().err
    assert said == "shapeblend: a.svg: contour 1, closed with 2 distinct vertices, left out\n"
    assert run(["a.svg", "b.svg", "-o", "two", "-q", "--vertices", "0"]) == 0
    assert capsys.readouterr().err == ""
    assert run(["a.svg", "b.svg", "-o", "three", "-v"]) == 0
    assert "work" in capsys.readouterr().err


def test_a_shape_that_is_only_filled_is_closed_by_its_fill(here):
    write(a=svg("M0 0H10V10H0"))
    assert [contour["closed"] for contour in contours("a.svg", "b.svg", "-n", "0")] == [True]


@pytest.mark.parametrize(
    ("d", "line"),
    [
        (SQUARE, "2 frames: none crosses itself"),
        # A square ring whose hole leaves it.
        (f"{SQUARE} M8 2V8H14V2Z", "2 frames: 4 crossings in 2 of them, at t = 0.333, 0.667"),
    ],
)
def test_details_say_when_frames_cross_themselves(here, capsys, d, line):
    write(a=svg(d), b=svg(d))
    assert run(["a.svg", "b.svg", "-n", "2", "-o", "out", "-v"]) == 0
    assert f"shapeblend: {line}" in capsys.readouterr().err.splitlines()


BAD = {
    "missing": (None, "no such file"),
    "folder": ("folder", "is a folder; shapeblend batch --chain"),
    "empty": ("", "empty"),
    "not XML": ("hello", "XML"),
    "not SVG": ("<html/>", "svg"),
    "no shape": ('<svg xmlns="http://www.w3.org/2000/svg"/>', "shape"),
    "empty path": (svg(""), "shape"),
    "one-point path": (svg("M3 3Z"), "shape"),
    "nan": (svg("M0 0L nan 4L3 3Z"), "path"),
    "infinite": (svg("M0 0L1e999 4L3 3Z"), "path"),
    "many contours": (svg("M0 0H1V1Z" * 2001), "2001 contours"),
    "many segments": (svg("M0 0" + "h1v1" * 25_001), "50002 segments"),
    "flat": (svg("M0 0H5Z"), "2 distinct vertices"),
}


@pytest.mark.parametrize(("content", "problem"), BAD.values(), ids=BAD)
@pytest.mark.parametrize("files", [["bad.svg", "b.svg"], ["b.svg", "bad.svg"]], ids=["first", "second"])
def test_bad_input_is_one_line_and_nothing_written(here, refused, files, content, problem):
    bad = here / "bad.svg"
    if content == "folder":
        bad.mkdir()
    elif content is not None:
        bad.write_text(content)
    line = refused([*files, "--vertices", "0", "--report", "r.json"], 1, "shapeblend: bad.svg: ")
    assert problem.lower() in line.lower()


def test_as_a_module_and_its_version():
    assert re.fullmatch(rb"shapeblend \d+\.\d+\.\d+\n", process("--version").stdout)


def test_the_band_of_a_preset_can_be_left_out(three):
    settings = report("a.svg", "b.svg", "-n", "0", "--preset", "fig27", "--band", "none")["settings"]
    assert (settings["preset"], settings["band"]) == ("fig27", None)
    assert report("a.svg", "b.svg", "-n", "0", "--preset", "fig27")["settings"]["band"] > 0.0
