"""The largest fills of two drawings become each other where one would come from nothing, and that looks better."""

from shapeblend_cli.blending import blended, pairings
from tests.support.drawings import drawing
from tests.support.motions import pair_of

BAR, SQUARE, PLATE = "M4 30H30V66H4Z", "M6 4H26V22H6Z", "M4 4H68V68H4Z"
A = drawing(
    f'<path fill="#fcea2b" d="{BAR}"/><path fill="#f1b31c" d="{SQUARE}"/>',
    viewbox="0 0 72 72",
)
B = drawing(
    f'<path fill="#fcea2b" d="{PLATE}"/><path fill="#f4aa41" d="{BAR}"/><path fill="#f1b31c" d="{SQUARE}"/>',
    viewbox="0 0 72 72",
)


def numbers(pair):
    return [(contour.a, contour.b) for shape in pair.shapes for contour in shape.contours]


def test_the_largest_fills_become_each_other_if_that_looks_better():
    assert numbers(pair_of(A, B)) == [(0, 0), (None, 1), (1, 2)]
    assert numbers(pair_of(B, A)) == [(0, 0), (1, None), (2, 1)]


def test_what_users_name_is_left_as_it_is():
    assert (0, 1) in numbers(pair_of(A, B, match=[("0", "1")]))


def test_a_small_gain_changes_nothing(monkeypatch):
    for module in (blended, pairings):
        monkeypatch.setattr(module, "BETTER", 1.5)
    assert numbers(pair_of(A, B)) == [(None, 0), (0, 1), (1, 2)]
