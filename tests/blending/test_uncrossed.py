"""Outlines that would cross themselves, or lose much of their area, are matched in another way."""

import pytest

from shapeblend_cli.blending import matched, uncrossed
from shapeblend_cli.blending.uncrossed import Fault, fault_of, with_crossings_undone
from shapeblend_cli.motion.rigid import Whole
from shapeblend_cli.wires.match import match_contours
from tests.support.drawings import drawing
from tests.support.motions import pair_of

G = "M52 18l-8 6a14 14 0 1 0 2 14h-12v-9h24a26 26 0 1 1-6-11z"
DOWN = "M12 6h24v36l12-12 7 7-24 23L8 37l7-7 12 12V15H12z"
STAR = "M32 4l8 20h22L44 37l7 22-19-13-19 13 7-22L2 24h22z"
PLUS = "M28 8h8v20h20v8H36v20h-8V36H8v-8h20z"


def drawn(path):
    return drawing(f'<path d="{path}"/>', viewbox="0 0 64 64")


def fault(a, b, **options):
    return fault_of(pair_of(drawn(a), drawn(b), **options).shapes)


@pytest.mark.parametrize(("a", "b"), [(G, DOWN), (DOWN, G), (G, STAR)])
def test_an_outline_does_not_cross_itself_if_another_way_is_as_good(a, b, monkeypatch):
    assert fault(a, b) == Fault()
    monkeypatch.setattr(uncrossed, "WAYS", ())
    assert fault(a, b).crossed > 1


def test_what_looks_much_worse_without_crossings_is_not_taken(monkeypatch):
    monkeypatch.setattr(uncrossed, "WORSE", -3.0)
    monkeypatch.setattr(uncrossed, "BETTER", 3.0)
    assert fault(G, DOWN).crossed > 1


def test_motion_by_lengths_and_angles_is_said_to_be_taken_for_crossings(monkeypatch):
    monkeypatch.setattr(uncrossed, "WAYS", (({"motion": "intrinsic", "k_t": 20.0},),))
    monkeypatch.setattr(uncrossed, "WORSE", 3.0)
    (shape,) = pair_of(drawn(G), drawn(DOWN), motion="auto").shapes
    assert shape.motion_name == "intrinsic"
    assert shape.reason == "motions that are less wrong make outlines cross"


def test_what_users_ask_for_is_left_as_it_is():
    assert fault(G, DOWN, k_t=7.0, k_b=1.0).crossed > 1
    assert fault(G, DOWN, motion="linear").crossed > 1


def test_nothing_is_graded_where_nothing_crosses(monkeypatch):
    def fail(*arguments):
        raise AssertionError

    monkeypatch.setattr(uncrossed, "faults_of", fail)
    assert fault(PLUS, STAR) == Fault()


def test_a_drawing_that_is_turned_over_may_lose_its_area():
    def fail(*arguments):
        raise AssertionError

    pair = pair_of(drawn(PLUS), drawn(PLUS))
    (shape,) = pair.shapes
    turned = (shape._replace(motion=Whole(32 + 32j, 32 + 32j, over=1j)),)
    assert fault_of(turned).is_lost
    assert with_crossings_undone(turned, fail, fail, pair.views[0]) is turned


def test_contours_that_cross_themselves_at_an_end_may_cross_in_between():
    bow = "M4 4L60 60V4L4 60z"
    assert fault(bow, "M8 4L56 60V8L8 56z") == Fault()


def test_less_is_wrong_only_where_nothing_more_is():
    assert Fault(1, False).is_less(Fault(2, False))
    assert not Fault(1, True).is_less(Fault(2, False))
    assert not Fault(2, False).is_less(Fault(2, False))


def test_no_other_way_is_tried_where_outlines_cross_nearly_always(monkeypatch):
    monkeypatch.setattr(uncrossed, "MOST_CROSSED", 1)
    assert fault(G, DOWN).crossed > 1


def test_ways_that_match_alike_are_matched_once(monkeypatch):
    made = []

    def match(a, b, settings, constraints, rotation=0.0, watch=None):
        made.append((a.number, b.number, settings.k_t, settings.k_b, rotation))
        return match_contours(a, b, settings, constraints, rotation, watch)

    monkeypatch.setattr(matched, "match_contours", match)
    monkeypatch.setattr(uncrossed, "WAYS", uncrossed.WAYS[-1:])
    assert fault(G, DOWN) == Fault()
    assert len(made) == len(set(made)) == 3
