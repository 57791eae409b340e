"""Outlines of one colour in which much goes wrong are matched in another way where that looks better."""

from shapeblend_cli.blending import silhouettes
from tests.support.drawings import drawing
from tests.support.motions import pair_of

HAND = "M54 16v23q0 21-21 21-15 0-21-12L6 34l5-5 8 9h2V12q0-4 4-4t4 4v16h3V8q0-4 4-4t4 4v22h3V16q0-4 5-4t5 4z"
FIST = "M58 30v2a26 26 0 0 1-52-2q9 4 13 0 6 6 12 1l4 3q-5 4-5 10h4q0-9 8-9v-3h-8V22h16z"
FINGERS = '<path d="M6 18q5-8 10 0v8q-5 8-10 0z"/><path d="M20 13q5-8 10 0v12q-5 8-10 0z"/>'
A = drawing(f'<path d="{HAND}"/>', viewbox="0 0 64 64")
B = drawing(f'<path d="{FIST}"/>{FINGERS}', viewbox="0 0 64 64")


def alone(pair):
    return sum(not contour.is_matched for contour in pair.contours)


def test_fingers_that_come_apart_are_cut_from_the_hand():
    assert alone(pair_of(A, B)) == alone(pair_of(B, A)) == 0


def test_a_small_gain_cuts_nothing(monkeypatch):
    ways = tuple((changed, 0.6) for changed, _ in silhouettes.WAYS)
    monkeypatch.setattr(silhouettes, "WAYS", ways)
    assert alone(pair_of(A, B)) == 2


def test_what_users_ask_for_is_left_as_it_is():
    assert alone(pair_of(A, B, unmatched="point")) == 2
    assert alone(pair_of(A, B, motion="linear")) == 2


def test_outlines_that_look_right_are_not_matched_again(monkeypatch):
    def fail(*arguments):
        raise AssertionError

    monkeypatch.setattr(silhouettes, "grade_of_shapes", fail)
    bars = drawing('<path d="M4 24h40v12H4z"/>'), drawing('<path d="M4 20h40v18H4z"/><path d="M8 2h9v9H8z"/>')
    assert alone(pair_of(*bars)) == 1
