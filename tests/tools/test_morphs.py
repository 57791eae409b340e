"""Morphs beside their truth, on made-up shapes with known answers."""

import json
import sys

import numpy as np
import pytest

from tests.tools.test_truth import EVEN, HOLE, SQUARE, WIDE, around, known, straight
from tools.quality.morphs import __main__ as command
from tools.quality.morphs import lines
from tools.quality.morphs.shape import anchors, outlines_apart, searched, shape
from tools.quality.truth.form import TIMES, Linked, Truth
from tools.quality.truth.measures import strict

LINE = np.array([0, 40, 40 + 30j])
LONGER = np.array([0, 80, 80 + 30j])
ALONG = np.array([[0, 4 / 7, 1], [0, 8 / 11, 1]])


@pytest.mark.parametrize("scale", [0.5, 1.0, 2.0])
def test_the_shape_is_right_wherever_however_large_and_whenever(scale):
    one = known([SQUARE, HOLE], [WIDE, HOLE + 5], scale, 30 - 7j)
    frames, _ = straight(one)
    assert shape(one, frames) == pytest.approx(0.0, abs=1e-4)
    moved = [[1.3 * contour + 8 - 3j for contour in frame] for frame in frames]
    assert shape(one, moved) < 0.01 < 0.3 < strict(one, moved)
    late = [[contour / one.size_at(t) for contour in one.at_own(t**1.3)] for t in TIMES]
    assert shape(one, late) < 0.01


def test_what_does_nothing_is_not_forgiven():
    one = known([SQUARE], [5 * SQUARE.real + 1j * SQUARE.imag])
    # The least odds at t are t / (1 - t) / 2.5: the truth is longer by then, and the square is scaled to suit.
    assert 0.3 < shape(one, [[SQUARE]] * 3) < strict(one, [[SQUARE]] * 3)


def test_anchors_are_known_for_a_square_and_for_a_drawing_without_area():
    outline, box, area = anchors([SQUARE])
    assert outline.centre == box.centre == pytest.approx(area.centre) == 5 + 5j
    assert (box.size, area.size) == (pytest.approx(200**0.5), pytest.approx(10.0))
    # Half of the sides is 5 from the middle across and its points -5 to 5 along, in the mean of squares 25 + 25 / 3.
    assert outline.size == pytest.approx((25 + 25 / 3) ** 0.5)
    assert anchors([np.array([0, 10])])[2] == (5, 10.0)


def test_a_minimum_is_found_among_the_places_that_were_tried():
    tried = searched(lambda x: (x - 0.3) ** 2, 0.0, 1.0)
    assert min(tried, key=tried.get) == pytest.approx(0.3, abs=5e-3)
    assert len(tried) == 7 + 9 + 1


def test_outlines_are_apart_by_their_mean_distance():
    assert outlines_apart([SQUARE], [SQUARE]) == pytest.approx(0.0)
    assert outlines_apart([SQUARE], [SQUARE * 1.2 - 1 - 1j]) == pytest.approx(1.0, abs=0.05)


def open_truth(back=False, scale=1.0, shift=0j):
    along = np.array([ALONG[0], 1 - ALONG[1]]) if back else ALONG
    return Truth("", "", "", "", scale, shift, np.array([0.0, 1.0]), [[LINE], [LONGER]], [along], open=True)


def linked(one, v):
    (a, b), *_ = one.true_links()
    u = np.linspace(0, 1, 50)
    points = [
        np.interp(places, known, line) for places, known, line in zip((u, v(u)), ALONG, (a, b), strict=True)
    ]
    return Linked([[p + (q - p) * t for p, q in one.true_links()] for t in TIMES], [tuple(points)], 2)


@pytest.mark.parametrize("back", [False, True], ids=["forwards", "backwards"])
@pytest.mark.parametrize(("scale", "shift"), [(1.0, 0j), (0.5, 30 - 7j)])
def test_open_lines(back, scale, shift):
    one = open_truth(back, scale, shift)
    true = linked(one, lambda u: np.interp(u, *ALONG))
    assert lines.nearness(one, true) == pytest.approx((0.0, 0.0), abs=1e-3)
    p, q = true.links[0]
    turned = true._replace(links=[(p[::-1], q[::-1])])
    assert lines.nearness(one, turned).corr == pytest.approx(0.0, abs=1e-3)
    off = linked(one, lambda u: 0.9 * np.interp(u, *ALONG))
    assert lines.nearness(one, off).corr == pytest.approx(0.05, abs=0.01)
    wrong = true._replace(links=[(p, q[::-1])])
    assert lines.nearness(one, wrong).corr > 0.4
    still = true._replace(frames=[true.frames[0]] * 3)
    assert lines.nearness(one, still).dist > 0.03


def test_no_line_or_two_are_as_far_off_as_can_be():
    one = open_truth()
    assert lines.nearness(one, None) == lines.NO_ANSWER
    assert lines.nearness(one, Linked([[LINE, LINE]] * 3, [(LINE, LONGER)], 4)) == lines.NO_ANSWER
    assert command.found(one, None)[1:] == (0.5, True, None, None, 1.0)
    assert command.found(known([SQUARE], [WIDE]), None)[1:] == (0.5, True, 1.0, 1.0, None)


def written(place, name, data, one):
    """A pair as a file has it."""
    place.mkdir(parents=True)
    paint = 'fill="none" stroke="#000"' if one.open else ""
    for file, d in zip(("a.svg", "b.svg"), data, strict=True):
        (place / file).write_text(
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 90 40"><path {paint} d="{d}"/></svg>',
            encoding="utf-8",
        )
    frames = {
        str(t): [[[z.real, z.imag] for z in contour.tolist()] for contour in frame]
        for t, frame in zip(one.times, one.frames, strict=True)
    }
    known = {
        "id": place.name,
        "set": name,
        "transform": {"scale": 1.0, "dx": 0.0, "dy": 0.0},
        "frames": frames,
        "pairs": [along.T.tolist() for along in one.along],
        "open": one.open,
    }
    (place / "truth.json").write_text(json.dumps(known), encoding="utf-8")
    return {"id": place.name, "set": name, "dir": f"{name}/{place.name}"}


def test_the_command_measures_one_split_or_several(tmp_path, monkeypatch, capsys):
    squares = ("M0 0H10V10H0Z", "M20 10V0H0V10Z")
    index = [written(tmp_path / "regions" / "single" / "x", "single", squares, known([SQUARE], [WIDE]))]
    (tmp_path / "regions" / "index.json").write_text(json.dumps({"pairs": index}), encoding="utf-8")
    drawn = ("M0 0L40 0L40 30", "M0 0L80 0L80 30")
    index = [written(tmp_path / "open" / "single" / "y", "single", drawn, open_truth())]
    (tmp_path / "open" / "index.json").write_text(json.dumps({"pairs": index}), encoding="utf-8")

    def told(*arguments):
        monkeypatch.setattr(sys, "argv", ["morphs", *map(str, arguments)])
        command.main()
        out = capsys.readouterr().out.splitlines()
        return [[cell.strip() for cell in line.strip("|").split("|")] for line in out if line[0] == "|"], out

    (_, _, line, region), _ = told(tmp_path)
    assert [line[:3], region[:3]] == [["open", "single", "1"], ["regions", "single", "1"]]
    assert (line[6:9], region[6], region[9]) == (["0.000", "", ""], "0.000", "")
    assert max(float(line[9]), *map(float, line[3:6] + region[3:6] + region[7:9])) < 0.04
    (*_, alone), out = told(tmp_path / "regions", "--pairs", "--vertices", "0")
    assert alone[0] == "regions"
    assert out[0].split()[0] == "x"


def test_places_of_a_square_go_where_they_should():
    one = known([SQUARE], [WIDE])
    assert command.found(one, Linked(*straight(one), 4)).corr == pytest.approx(0.0, abs=1e-9)
    p, q = around(SQUARE, EVEN), around(WIDE, EVEN + 0.1)
    assert command.found(one, Linked(straight(one)[0], [(p, q)], 4)).gross
