"""Outlines in which much goes wrong are matched in another way where that looks better."""

import pytest

from shapeblend_cli.blending import rematched
from shapeblend_cli.blending.graded import grade_of_shapes
from shapeblend_cli.blending.matched import PairedDrawings
from shapeblend_cli.options.settings import Settings
from tests.support.drawings import drawing
from tests.support.motions import pair_of

HAND = "M54 16v23q0 21-21 21-15 0-21-12L6 34l5-5 8 9h2V12q0-4 4-4t4 4v16h3V8q0-4 4-4t4 4v22h3V16q0-4 5-4t5 4z"
FIST = "M58 30v2a26 26 0 0 1-52-2q9 4 13 0 6 6 12 1l4 3q-5 4-5 10h4q0-9 8-9v-3h-8V22h16z"
FINGERS = '<path d="M6 18q5-8 10 0v8q-5 8-10 0z"/><path d="M20 13q5-8 10 0v12q-5 8-10 0z"/>'
A = drawing(f'<path d="{HAND}"/>', viewbox="0 0 64 64")
B = drawing(f'<path d="{FIST}"/>{FINGERS}', viewbox="0 0 64 64")

EYE = '<circle cx="{0}" cy="{0}" r="3" fill="#222"/>'
WHALE = "M2 22q14-10 20 2 6 8 16 2 8-6 4-16l8 4 8-8q4 10-4 14 4 30-26 34-28 0-26-32z"
RAY = "M6 54l8-30q10-18 24-6l18-12-6 22 8 24-18-12q-16 20-34 14z"
SEA = [
    drawing(f'<path fill="#3388cc" d="{WHALE}"/>{EYE.format(26)}', viewbox="0 0 64 64"),
    drawing(f'<path fill="#4499ee" d="{RAY}"/>{EYE.format(22)}', viewbox="0 0 64 64"),
]


def alone(pair):
    return sum(not contour.is_matched for contour in pair.contours)


def test_fingers_that_come_apart_are_cut_from_the_hand():
    assert alone(pair_of(A, B)) == alone(pair_of(B, A)) == 0


def test_points_stay_nearer_to_their_places_if_that_looks_better(monkeypatch):
    def compared():
        pair = pair_of(*SEA)
        return grade_of_shapes(pair.shapes, pair.views[0])

    better = compared()
    monkeypatch.setattr(rematched, "IN_PLACE", ())
    assert better < compared() - 0.3


def test_a_small_gain_cuts_nothing(monkeypatch):
    monkeypatch.setattr(rematched, "TORN", 1.0)
    assert alone(pair_of(A, B)) == 2


def test_nothing_is_cut_for_what_is_elsewhere(monkeypatch):
    monkeypatch.setattr(rematched, "FAR", 0.0)
    assert alone(pair_of(A, B)) == 2


def test_nothing_is_matched_again_for_a_small_part(monkeypatch):
    monkeypatch.setattr(rematched, "LARGE", 1.1)
    assert alone(pair_of(A, B)) == 2


def test_what_users_ask_for_is_left_as_it_is():
    assert alone(pair_of(A, B, unmatched="point")) == 2
    assert alone(pair_of(A, B, motion="linear")) == 2


def test_outlines_that_look_right_are_not_matched_again(monkeypatch):
    def fail(*arguments):
        raise AssertionError

    monkeypatch.setattr(rematched, "grade_of_shapes", fail)
    bars = drawing('<path d="M4 24h40v12H4z"/>'), drawing('<path d="M4 20h40v18H4z"/><path d="M8 2h9v9H8z"/>')
    assert alone(pair_of(*bars)) == 1


@pytest.mark.parametrize(
    ("most", "grade", "stiffnesses"),
    [(1.4, 1.8, []), (1.5, 1.8, [60.0, 20.0]), (1.5, 1.96, [60.0]), (1.5, 2.3, [60.0])],
)
def test_no_other_stiffness_is_tried_where_little_is_gained_or_much_would_have_to_be(
    monkeypatch, most, grade, stiffnesses
):
    tried = []
    usual = rematched._Graded(2.0, _paired_with(7.0), (), ())

    def graded(paired, move, view):
        tried.append(paired.settings.k_t)
        return usual._replace(grade=grade)

    monkeypatch.setattr(rematched, "_graded", graded)
    assert rematched._best(usual, (60.0, 20.0), None, None, most).grade == min([2.0, *(grade for _ in tried)])
    assert tried == stiffnesses


def _paired_with(stiffness):
    settings = Settings(k_t=stiffness)
    return PairedDrawings(None, None, 0.0, {}, (), ({}, {}), (), settings, None)
