"""Scores beside a known truth, on made-up shapes with known answers; and pairs written in the form."""

import json
import shutil
import sys

import numpy as np
import pytest

from shapeblend_cli.geometry.polygons import signed_area
from tools.quality.peers import ALL, arc_length, shapeblend
from tools.quality.scores import area
from tools.quality.truth import __main__ as command
from tools.quality.truth.form import TIMES, Linked, Truth, truth
from tools.quality.truth.measures import (
    GROSS,
    NO_ANSWER,
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
from tools.quality.truth.write import LEAST_PIECES, Morph, is_plain, pair, svg

SQUARE = np.array([0, 10, 10 + 10j, 10j])
WIDE = SQUARE.real * 2 + 1j * SQUARE.imag
HOLE = SQUARE[::-1] * 0.4 + 3 + 3j
FAR = SQUARE + 40


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
    reached = np.append(0.0, np.cumsum(np.abs(np.diff(contour, append=contour[0]))))
    return np.interp(np.mod(places, 1.0) * reached[-1], reached, np.append(contour, contour[0]))


EVEN = np.arange(40) / 40


@pytest.mark.parametrize("scale", [1.0, 0.5, 3.0])
@pytest.mark.parametrize("shift", [0j, 30 - 7j])
def test_what_goes_straight_between_the_files_is_the_truth(scale, shift):
    one = known([SQUARE, HOLE], [WIDE, HOLE + 5], scale, shift)
    frames, links = straight(one)
    nothing = pytest.approx(0.0, abs=1e-9)
    assert nearness(one, Linked(frames, links, 8)) == Nearness(nothing, nothing, False, 1.0, 8)


def test_what_keeps_still_is_off_by_the_area_it_lacks_and_what_is_elsewhere_by_all():
    # At t the truth is 10 (1 + t) wide, of which 10 are covered.
    still = [[SQUARE]] * 3
    assert strict(known([SQUARE], [WIDE]), still) == pytest.approx(np.mean([t / (1 + t) for t in TIMES]))
    assert strict(known([SQUARE], [SQUARE]), [[FAR]] * 3) == 1.0
    assert strict(known([SQUARE], [SQUARE]), [[]] * 3) == 1.0


def test_a_truth_that_is_not_even_is_followed_piece_by_piece():
    one = known([SQUARE], [WIDE])
    bent = one._replace(frames=[[SQUARE], [SQUARE], [SQUARE], [SQUARE], [WIDE]])
    assert strict(bent, [[SQUARE]] * 3) == pytest.approx(0.0)
    assert area(bent.at(0.875)[0]) == pytest.approx(150.0)


def test_regions_are_filled_by_the_even_odd_rule():
    assert region([SQUARE, HOLE]).area == region([SQUARE, HOLE[::-1]]).area == pytest.approx(84.0)
    bow_tie = SQUARE[[0, 2, 1, 3]]
    assert region([bow_tie]).area == pytest.approx(50.0)
    assert apart([SQUARE], [SQUARE, HOLE]) == pytest.approx(0.16)


@pytest.mark.parametrize("back", [False, True], ids=["forwards", "backwards"])
@pytest.mark.parametrize("off", [0.0, 0.02, 0.25, -0.25, 0.5, 0.98])
def test_a_correspondence_that_is_off_all_along(off, back):
    one = known([SQUARE], [3 * SQUARE + 5], 0.5, 8j)
    (a, b), *_ = one.true_links()
    p, q = around(a, EVEN), around(b, EVEN + off)
    if back:
        p, q = p[::-1], q[::-1]
    assert corr(one, [(p, q)]) == pytest.approx(min(abs(off), 1 - abs(off)), abs=1e-9)


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
    assert corr(one, [small]) == pytest.approx(0.375)
    assert corr(one, [(SQUARE, 3 * FAR), (3 * FAR, SQUARE)]) == corr(one, []) == pytest.approx(0.5)


def test_the_truth_may_be_uneven_along_the_outline():
    # The first side grows to three fifths of the outline: even steps arrive somewhere else, the designer's do not.
    oblong = np.array([0, 60, 60 + 10j, 10j])
    one = known([SQUARE], [oblong])
    assert corr(one, one.true_links()) == pytest.approx(0.0)
    assert corr(one, [(around(SQUARE, EVEN), around(oblong, EVEN))]) > GROSS


def test_turns():
    assert turns(SQUARE).tolist() == turns(SQUARE[::-1]).tolist() == [90.0] * 4
    chopped = np.array([1, 9, 10 + 1j, 10 + 10j, 10j, 1j])
    assert turns(chopped)[:2] == pytest.approx([45.0, 45.0])
    assert turns(chopped, 9.0)[0] > 60
    circle = 50 * np.exp(2j * np.pi * np.arange(100) / 100)
    assert turns(circle, 1.0) == pytest.approx(3.6, abs=2.5)


def test_corners_are_kept_near_their_places_only():
    one = known([SQUARE], [SQUARE])
    assert corners(one, [SQUARE]) == 1.0
    assert corners(one, [around(SQUARE, EVEN)]) == 1.0
    assert corners(one, [np.append(SQUARE[:3], [6j, 4j])]) == 0.75
    assert corners(one, [SQUARE + 1]) == 0.0
    assert corners(one, [SQUARE, FAR]) == 1.0
    assert corners(one, [FAR]) == 0.0


def test_only_what_is_a_corner_at_both_ends_counts():
    round_one = 5 * np.exp(2j * np.pi * np.arange(64) / 64)
    assert corners(known([round_one], [2 * round_one]), [SQUARE]) is None
    flat = np.array([0, 5, 10, 10 + 10j, 10j])
    bent = np.array([0, 5 + 4j, 10, 10 + 10j, 10j])
    assert corners(known([flat], [bent]), [np.array([0, 10, 10 + 10j, 10j])]) == 1.0


def test_no_answer_is_as_far_off_as_can_be():
    assert nearness(known([SQUARE], [SQUARE]), None) == NO_ANSWER
    assert (NO_ANSWER.strict, NO_ANSWER.corr, NO_ANSWER.corners) == (1.0, 0.5, 0.0)


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
    drawn = [[signed_area(c) for c in shapeblend.drawn(text)] for text in (one.a, one.b)]
    for side, links in zip(drawn, zip(*one.true_links(), strict=True), strict=True):
        true = [abs(signed_area(contour)) for contour in links]
        assert sorted(map(abs, side)) == pytest.approx(sorted(true), rel=0.01)
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
    for number in range(20):
        what, a, b = pair(made(contours=[SQUARE]), str(number), "single")
        one = truth(what, a, b)
        (q,), (along,) = shapeblend.drawn(b), what["pairs"]
        (_, there), *_ = one.true_links()
        found = around(q, np.array(along)[:, 1])
        np.testing.assert_allclose(found, there, atol=0.1)


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


def test_curves_stay_near_their_polygons_and_lines_are_written_as_lines():
    one = made()
    assert len(one.frames[0][0]) >= 3 + LEAST_PIECES
    assert all(len(p) == len(q) for p, q in zip(one.frames[0], one.frames[-1], strict=True))
    assert svg([[np.array([0, 5, 10]), np.array([10, 10j]), np.array([10j, 5j, 0])]]).count("Q") == 0


def test_the_command_measures_a_folder(monkeypatch, tmp_path, capsys):
    what, a, b = pair(made(), "x", "multi")
    place = tmp_path / "multi" / "x"
    place.mkdir(parents=True)
    for name, text in (("a.svg", a), ("b.svg", b), ("truth.json", json.dumps(what))):
        (place / name).write_text(text, encoding="utf-8")
    pairs = [{"id": "x", "set": "multi", "dir": "multi/x"}, {"id": "y", "set": "other", "dir": "y"}]
    (tmp_path / "index.json").write_text(json.dumps({"pairs": pairs}), encoding="utf-8")
    names = (shapeblend.NAME, arc_length.NAME)
    monkeypatch.setattr(command, "ALL", [tool for tool in ALL if tool.name in names])
    monkeypatch.setattr(sys, "argv", ["truth", str(tmp_path)])
    command.main()
    rows = [line.split(" | ") for line in capsys.readouterr().out.splitlines()[2:]]
    assert [row[:3] for row in rows] == [["| multi", name, "1"] for name in names]
    assert float(rows[0][3]) < 0.01
    shutil.rmtree(place)
    monkeypatch.setattr(sys, "argv", ["truth", str(tmp_path), "--set", "single"])
    command.main()
    assert len(capsys.readouterr().out.splitlines()) == 2
