"""`--motion`, as its users see it."""

import re

import numpy as np
import pytest

from shapeblend_cli.cli import run
from tests.support.commands import contours, points, viewbox, write
from tests.support.drawings import BAR, LEAF, SQUARES, svg

L = "M3 3H9V17H19V21H3Z"
L_TURNED = "M21 3V9H7V19H3V3Z"


@pytest.fixture
def here(here):
    write(l=svg(L), turned=svg(L_TURNED), bar=svg(BAR), leaf=svg(LEAF), squares=svg(SQUARES))
    return here


def test_the_report_says_how_each_contour_moves_and_why(here):
    (contour,) = contours("l.svg", "turned.svg")
    assert contour["motion"] == "rigid"
    assert contour["turned_back"] == pytest.approx(90, abs=1.5)
    assert contour["motion_because"] == "B is A turned by 90 degrees"
    (contour,) = contours("bar.svg", "leaf.svg")
    assert (contour["motion"], contour["turned_back"]) == ("linear", 0.0)
    judged = {one["name"]: one["wrong"] for one in contour["candidates"]}
    assert list(judged) == ["linear", "rigid", "intrinsic"]
    because = ", ".join(f"{name} {wrong:.3f}" for name, wrong in judged.items())
    assert contour["motion_because"] == f"the least wrong: {because}"
    for motion in ("linear", "rigid", "intrinsic"):
        (contour,) = contours("bar.svg", "leaf.svg", "--motion", motion)
        assert (contour["motion"], contour["motion_because"]) == (motion, "asked for")


def test_verbose_says_the_motion_and_why_of_each_shape(here, capsys):
    assert run(["l.svg", "turned.svg", "-v"]) == 0
    assert "shapeblend: motion rigid: B is A turned by 90 degrees\n" in capsys.readouterr().err
    assert run(["bar.svg", "leaf.svg", "-v", "-f"]) == 0
    assert "shapeblend: motion linear: the least wrong: linear " in capsys.readouterr().err
    write(two=svg(L, "M14 3H20V9Z"))
    assert run(["two.svg", "two.svg", "-v", "-f"]) == 0
    said = capsys.readouterr().err
    for number in (1, 2):
        assert f"shapeblend: shape {number}: motion linear: straight paths look right\n" in said


def test_frames_turn_and_straight_ones_do_not(here):
    assert run(["l.svg", "turned.svg", "-n", "1", "--polygons", "--vertices", "0"]) == 0
    edges = abs(np.diff(points((here / "blend/frame-1.svg").read_text())))
    np.testing.assert_allclose(edges, [6, 14, 10, 4, 16], atol=0.01)
    straight = ["--motion", "linear", "--kt", "0", "-f"]  # or points stay near, and A is not turned back
    assert run(["l.svg", "turned.svg", "-n", "1", "--polygons", "--vertices", "0", *straight]) == 0
    shrunk = abs(np.diff(points((here / "blend/frame-1.svg").read_text())))
    np.testing.assert_allclose(shrunk, edges / np.sqrt(2.0), atol=0.01)


def test_three_files_move_each_pair_in_its_way(here):
    files = ["l.svg", "turned.svg", "turned.svg"]
    assert [c["motion"] for c in contours(*files)] == ["rigid", "linear"]
    assert run([*files, "-o", "x.svg"]) == 0
    (values,) = re.findall(r'values="(M[^"]*)"', (here / "x.svg").read_text())
    assert len(values.split(";")) > 4  # the turn is made of several, what is straight of one


def test_transitions_go_straight_and_say_so_if_that_was_not_asked_for(here, capsys):
    write(a=svg("M2 10H22V14H2Z"), b=svg("M10 2H14V22H10Z"))
    assert run("a.svg b.svg --trigger hover --animate css -o x.svg".split()) == 0
    assert capsys.readouterr().err == ""
    assert run("a.svg b.svg --trigger hover --animate css -o y.svg --motion rigid".split()) == 0
    assert "moves on curved paths, which CSS transitions cannot show" in capsys.readouterr().err


def test_a_pair_goes_straight_unless_asked(here, capsys):
    (contour,) = contours("l.svg", "turned.svg", "--emit", "pair")
    assert contour["motion"] == "linear"
    assert capsys.readouterr().err == ""
    assert run(["l.svg", "turned.svg", "--emit", "pair", "--motion", "rigid", "-f"]) == 0
    (line,) = capsys.readouterr().err.splitlines()
    assert "moves on curved paths, which two files cannot show" in line


@pytest.mark.parametrize("output", [["-n", "5", "--ends"], ["-n", "0", "--ends"]])
def test_what_leaves_the_viewbox_on_its_way_is_shown(here, output):
    write(a=svg("M0 0H24V24H0V10H4V6H0Z"), b=svg("M24 0V24H0V0H14V4H18V0Z"))
    (contour,) = contours("a.svg", "b.svg", *output)
    assert contour["motion"] == "rigid"
    found = [viewbox(file) for file in here.glob("blend/*")]
    assert all(view == found[0] for view in found)
    x, y, width, height = found[0]
    reach = 12 * 2**0.5  # the corners', half way
    assert x < 12 - reach
    assert y < 12 - reach
    assert x + width > 12 + reach
    assert y + height > 12 + reach
    assert max(width, height) < 40
    for path in (here / "blend").glob("*.svg"):
        z = points(path.read_text())
        assert x < z.real.min() < z.real.max() < x + width
        assert y < z.imag.min() < z.imag.max() < y + height
    assert run(["a.svg", "b.svg", "-o", "straight", "--motion", "linear"]) == 0
    assert [viewbox(file) for file in here.glob("straight/*")] == [[0, 0, 24, 24]] * 5


def test_the_viewbox_is_kept_if_that_is_asked_for_or_hardly_anything_is_cut_off(here):
    write(a=svg("M0 0H24V24H0V10H4V6H0Z"), b=svg("M24 0V24H0V0H14V4H18V0Z"))
    assert run(["a.svg", "b.svg", "-o", "kept", "--ends", "--viewbox", "keep"]) == 0
    write(a=svg(L), b=svg(L_TURNED))
    for keeping in ("auto", "grow"):
        assert run(["a.svg", "b.svg", "-o", keeping, "--ends", "--viewbox", keeping]) == 0
    assert [viewbox(file) for file in here.glob("kept/*")] == [[0, 0, 24, 24]] * 7
    assert [viewbox(file) for file in here.glob("auto/*")] == [[0, 0, 24, 24]] * 7
    assert all(viewbox(file)[2] > 24 for file in here.glob("grow/*"))


def test_what_stays_inside_leaves_the_viewbox_as_it_is(here):
    write(l=svg(L, viewbox="-4 -4 32 32"), turned=svg(L_TURNED, viewbox="-4 -4 32 32"))
    assert run(["l.svg", "turned.svg", "-o", "out", "--ends"]) == 0
    assert [viewbox(file) for file in here.glob("out/*")] == [[-4, -4, 32, 32]] * 7


BOX, EDGE = "M2 2H18V10H2Z", "follows the edge that it lies on"
CARD = "M4 4H20V20H4Z M10 8V12H15V8Z"
CROSSED_OUT = "M1 2L2 1L23 22L22 23L19 20H4V5Z M7 4H20V17L15 12V8H11Z"
EDGED = svg(BOX, '<path d="M2 2H18V10" fill="none" stroke="#c00"/>')


@pytest.mark.parametrize(
    ("a", "b", "line"),
    [
        (svg(BOX), EDGED, f"contour 1 of B has no partner and {EDGE}"),
        (EDGED, svg(BOX), f"contour 1 of A has no partner and {EDGE}"),
        (svg(BOX), svg(BOX, "M20 20H24V24H20Z"), "contour 1 of B grows from the point 22,22"),
        (svg(CARD), svg(CROSSED_OUT), " of B grows from a line at "),
    ],
)
def test_verbose_says_what_becomes_of_contours_without_a_partner(here, capsys, a, b, line):
    write(a=a, b=b)
    assert run(["a.svg", "b.svg", "-v"]) == 0
    assert line in capsys.readouterr().err
