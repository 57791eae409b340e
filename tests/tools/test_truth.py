"""Scores beside a known truth, on made-up shapes with known answers; and pairs written in the form."""

import json
import sys

import numpy as np
import pytest

from shapeblend_cli.geometry.polygons import signed_area
from tools.quality.peers import ALL, arc_length, shapeblend
from tools.quality.truth import __main__ as command
from tools.quality.truth.form import TIMES, Linked, Truth, truth
from tools.quality.truth.measures import (
    NO_ANSWER,
    NO_LINE,
    Nearness,
    apart,
    corners,
    corr,
    nearness,
    reached,
    region,
    strict,
    turns,
)
from tools.quality.truth.write import Morph, is_plain, pair

SQUARE = np.array([0, 10, 10 + 10j, 10j])
WIDE = SQUARE.real * 2 + 1j * SQUARE.imag
HOLE = SQUARE[::-1] * 0.4 + 3 + 3j
FAR = SQUARE + 40
EVEN = np.arange(40) / 40

LINE, LONGER = np.array([0, 40, 40 + 30j]), np.array([0, 80, 80 + 30j])
ALONG = np.array([[0, 4 / 7, 1], [0, 8 / 11, 1]])


def known(first, last, scale=1.0, shift=0j):
    """A truth that goes straight from one frame to the other."""
    times = np.array([0.0, 0.25, 0.5, 0.75, 1.0])
    frames = [[p + (q - p) * t for p, q in zip(first, last, strict=True)] for t in times]
    along = [np.array([reached(p)[:-1], reached(q)[:-1]]) for p, q in zip(first, last, strict=True)]
    return Truth("", "", "", "", scale, shift, times, frames, along)


def straight(truth):
    """The frames of a tool that goes straight between the files, and knows what goes where."""
    links = truth.true_links()
    return [[p + (q - p) * t for p, q in links] for t in TIMES], links


def around(contour, places):
    """Points of a contour, at shares of its length."""
    known = reached(contour)
    return np.interp(np.mod(places, 1.0), known, np.append(contour, contour[0]))


@pytest.mark.parametrize(("scale", "shift"), [(1.0, 0j), (3.0, 30 - 7j)])
def test_what_goes_straight_between_the_files_is_the_truth(scale, shift):
    one = known([SQUARE, HOLE], [WIDE, HOLE + 5], scale, shift)
    frames, links = straight(one)
    nothing = pytest.approx(0.0, abs=1e-9)
    assert nearness(one, Linked(frames, links, 8)) == Nearness(nothing, nothing, None, False, 1.0, 8)


def test_what_keeps_still_is_off_by_the_area_it_lacks_and_what_is_elsewhere_by_all():
    # At t the truth is 10 (1 + t) wide, of which 10 are covered.
    still = [[SQUARE]] * 3
    assert strict(known([SQUARE], [WIDE]), still) == pytest.approx(np.mean([t / (1 + t) for t in TIMES]))
    assert strict(known([SQUARE], [SQUARE]), [[FAR]] * 3) == 1.0
    assert strict(known([SQUARE], [SQUARE]), [[]] * 3) == 1.0


def test_a_truth_that_is_not_even_is_followed_piece_by_piece():
    bent = known([SQUARE], [WIDE])._replace(frames=[[SQUARE], [SQUARE], [SQUARE], [SQUARE], [WIDE]])
    assert strict(bent, [[SQUARE]] * 3) == pytest.approx(0.0)


def test_regions_are_filled_by_the_even_odd_rule():
    assert region([SQUARE, HOLE]).area == region([SQUARE, HOLE[::-1]]).area == pytest.approx(84.0)
    assert apart([SQUARE], [SQUARE, HOLE]) == pytest.approx(0.16)


@pytest.mark.parametrize("back", [False, True], ids=["forwards", "backwards"])
@pytest.mark.parametrize("off", [0.0, 0.02, -0.25, 0.5])
def test_a_correspondence_that_is_off_all_along(off, back):
    one = known([SQUARE], [3 * SQUARE + 5], 0.5, 8j)
    (a, b), *_ = one.true_links()
    p, q = around(a, EVEN), around(b, EVEN + off)
    if back:
        p, q = p[::-1], q[::-1]
    assert corr(one, [(p, q)]) == pytest.approx(abs(off), abs=1e-9)


def test_a_correspondence_is_off_by_its_mean_the_other_way_round_or_half_the_way():
    one = known([SQUARE], [SQUARE])
    assert corr(one, [(around(SQUARE, EVEN), around(SQUARE, -EVEN))]) == pytest.approx(0.25, abs=1e-3)
    # Places up to a half arrive where they should; those beyond lag by up to a tenth, in a triangle.
    u = np.linspace(0, 1, 400, endpoint=False)
    v = np.where(u < 0.5, u, u - 0.1 * (1 - np.abs(4 * u - 3)))
    assert corr(one, [(around(SQUARE, u), around(SQUARE, v))]) == pytest.approx(0.025, abs=1e-3)


def test_contours_count_by_their_length_and_wrong_ones_a_half():
    one = known([SQUARE, 3 * FAR], [SQUARE, 3 * FAR])
    small, large = ((contour, contour) for contour in (SQUARE, 3 * FAR))
    assert corr(one, [large, small]) == pytest.approx(0.0)
    assert corr(one, [large]) == pytest.approx(0.125)
    assert corr(one, [(SQUARE, 3 * FAR), (3 * FAR, SQUARE)]) == corr(one, []) == pytest.approx(0.5)
    assert nearness(one, Linked([[SQUARE]] * 3, [large], 8)).gross


def test_turns():
    assert turns(SQUARE).tolist() == turns(SQUARE[::-1]).tolist() == [90.0] * 4
    chopped = np.array([1, 9, 10 + 1j, 10 + 10j, 10j, 1j])
    assert turns(chopped)[:2] == pytest.approx([45.0, 45.0])
    assert turns(chopped, 9.0)[0] > 60


def test_corners_are_kept_near_their_places_only_and_count_only_if_both_ends_have_them():
    one = known([SQUARE], [SQUARE])
    assert corners(one, [around(SQUARE, EVEN)]) == 1.0
    assert corners(one, [np.append(SQUARE[:3], [6j, 4j])]) == 0.75
    assert corners(one, [SQUARE + 1]) == 0.0
    round_one = 5 * np.exp(2j * np.pi * np.arange(64) / 64)
    assert corners(known([round_one], [2 * round_one]), [SQUARE]) is None


def open_truth(back=False, scale=1.0, shift=0j):
    along = np.array([ALONG[0], 1 - ALONG[1]]) if back else ALONG
    return Truth("", "", "", "", scale, shift, np.array([0.0, 1.0]), [[LINE], [LONGER]], [along], open=True)


def linked(one, v):
    (ends,) = one.true_links()
    u = np.linspace(0, 1, 50)
    points = [np.interp(at, known, line) for at, known, line in zip((u, v(u)), ALONG, ends, strict=True)]
    return Linked(straight(one)[0], [tuple(points)], 2)


@pytest.mark.parametrize("back", [False, True], ids=["forwards", "backwards"])
@pytest.mark.parametrize(("scale", "shift"), [(1.0, 0j), (0.5, 30 - 7j)])
def test_open_lines(back, scale, shift):
    one = open_truth(back, scale, shift)
    true = linked(one, lambda u: np.interp(u, *ALONG))
    assert nearness(one, true)[:3] == (pytest.approx(0.0, abs=1e-3), None, pytest.approx(0.0, abs=1e-3))
    p, q = true.links[0]
    assert nearness(one, true._replace(links=[(p[::-1], q[::-1])])).corr == pytest.approx(0.0, abs=1e-3)
    off = nearness(one, linked(one, lambda u: 0.9 * np.interp(u, *ALONG)))
    assert off.corr == pytest.approx(0.05, abs=0.01)
    assert not off.gross
    assert nearness(one, true._replace(links=[(p, q[::-1])])).gross
    assert nearness(one, true._replace(frames=[true.frames[0]] * 3)).dist > 0.03


def test_no_answer_is_as_far_off_as_can_be():
    assert nearness(known([SQUARE], [SQUARE]), None) == NO_ANSWER
    assert (NO_ANSWER.strict, NO_ANSWER.corr, NO_ANSWER.corners) == (1.0, 0.5, 0.0)
    assert nearness(open_truth(), None) == NO_LINE
    assert nearness(open_truth(), Linked([[LINE, LINE]] * 3, [(LINE, LONGER)], 4)) == NO_LINE


def made(contours=(SQUARE, HOLE)):
    """A letter of straight sides and one curve, that gets wider."""

    def outline(t):
        sides = [[np.array(side) for side in zip(ring, np.roll(ring, -1), strict=True)] for ring in contours]
        sides[0][1] = np.insert(sides[0][1], 1, 13 + 5j)
        return [[side.real * (1 + t) + 1j * side.imag for side in contour] for contour in sides]

    times = (0.0, 0.25, 0.5, 0.75, 1.0)
    return Morph({"family": "made"}, times, [outline(t) for t in times])


@pytest.mark.parametrize("label", ["one", "two", "three", "four"])
def test_a_letter_is_written_in_the_form(label):
    what, *files = pair(made(), label, "multi")
    one = truth(json.loads(json.dumps(what)), *files)
    drawn = [[abs(signed_area(c)) for c in shapeblend.drawn(text)] for text in (one.a, one.b)]
    for side, links in zip(drawn, zip(*one.true_links(), strict=True), strict=True):
        assert sorted(side) == pytest.approx(sorted(abs(signed_area(link)) for link in links), rel=0.01)
    frames, links = straight(one)
    assert strict(one, frames) == pytest.approx(0.0, abs=1e-4)
    assert corr(one, links) == pytest.approx(0.0, abs=1e-9)
    # A tool that reads the files finds what lies there.
    assert strict(one, shapeblend.linked([one])[0].frames) < 0.02
    assert corr(one, shapeblend.linked([one])[0].links) < 0.02


def test_files_give_nothing_away():
    every = [pair(made(), str(number), "multi")[0] for number in range(40)]
    assert {one["reversed"] for one in every} == {True, False}
    assert {tuple(map(tuple, one["contour_map"])) for one in every} == {((0, 0), (1, 1)), ((0, 1), (1, 0))}
    assert len({round(one["pairs"][0][0][1], 2) % 1 for one in every}) > 4
    assert len({one["transform"]["scale"] for one in every}) == 40


def test_what_goes_where_is_told_from_the_start_of_the_file():
    for number in range(8):
        what, a, b = pair(made(contours=[SQUARE]), str(number), "single")
        (q,), (along,) = shapeblend.drawn(b), what["pairs"]
        (_, there), *_ = truth(what, a, b).true_links()
        np.testing.assert_allclose(around(q, np.array(along)[:, 1]), there, atol=0.1)


@pytest.mark.parametrize(
    ("frame", "plain"),
    [
        pytest.param([SQUARE, HOLE], True, id="hole"),
        pytest.param([SQUARE, HOLE[::-1]], False, id="hole that one rule fills"),
        pytest.param([SQUARE, FAR], True, id="apart"),
        pytest.param([SQUARE, SQUARE + 5], False, id="crossing each other"),
        pytest.param([SQUARE[[0, 2, 1, 3]]], False, id="crossing itself"),
        pytest.param([SQUARE * 4, HOLE * 4, SQUARE * 0.5 + 16 + 16j], True, id="in a hole"),
    ],
)
def test_letters_that_rules_fill_differently_are_known(frame, plain):
    assert is_plain(frame) is plain


def test_the_command_measures_one_split_or_several(monkeypatch, tmp_path, capsys):
    def write(split, name, what, a, b):
        place = tmp_path / split / name / "x"
        place.mkdir(parents=True)
        for file, text in (("a.svg", a), ("b.svg", b), ("truth.json", json.dumps(what))):
            (place / file).write_text(text, encoding="utf-8")
        index = {"pairs": [{"id": "x", "set": name, "dir": f"{name}/x"}]}
        (tmp_path / split / "index.json").write_text(json.dumps(index), encoding="utf-8")

    def told(*arguments):
        monkeypatch.setattr(sys, "argv", ["truth", *map(str, arguments)])
        command.main()
        lines = capsys.readouterr().out.splitlines()
        return [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]

    write("letters", "multi", *pair(made(), "x", "multi"))
    frames = {t: [[[z.real, z.imag] for z in line.tolist()]] for t, line in (("0", LINE), ("1", LONGER))}
    laid = {"scale": 1.0, "dx": 0.0, "dy": 0.0}
    what = {
        "id": "x",
        "set": "single",
        "transform": laid,
        "frames": frames,
        "pairs": [ALONG.T.tolist()],
        "open": True,
    }
    start = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 90 40"><path fill="none" stroke="#000" d='
    write("open", "single", what, *(f'{start}"M0 0L{x} 0L{x} 30"/></svg>' for x in (40, 80)))
    *_, letters, lines = told(tmp_path, "--polygons")
    assert [letters[:4], lines[:4]] == [
        ["letters", "multi", "shapeblend", "1"],
        ["open", "single", "shapeblend", "1"],
    ]
    assert (float(letters[8]) < 0.02, letters[10]) == (True, "–")
    assert (lines[8], float(lines[10]) < 0.04) == ("–", True)
    names = (shapeblend.NAME, arc_length.NAME)
    monkeypatch.setattr(command, "ALL", [tool for tool in ALL if tool.name in names])
    monkeypatch.setattr(command, "ready", lambda: None)
    *pairs, _, _, ours, evenly = told(tmp_path / "letters", "--peers", "--pairs")
    assert (len(pairs), ours[2], evenly[2]) == (2, *names)
