"""Other pairings are taken where they look better: unlike parts are left alone, and like ones become each other."""

import pytest

from shapeblend_cli.blending import pairings
from tests.support.drawings import drawing
from tests.support.motions import pair_of

HAND, FIST = "M12 24h40v36h-40z", "M12 20h40v40h-40z"
WAVES = '<path fill="#5dadec" d="M4 4h4v16h-4z"/><path fill="#5dadec" d="M12 4h4v12h-4z"/>'
FINGERS = '<path fill="#ef9645" d="M14 12h14v12h-14z"/><path fill="#ef9645" d="M32 12h14v12h-14z"/>'
A = drawing(f'<path fill="#ffdc5d" d="{HAND}"/>{WAVES}', viewbox="0 0 64 64")
B = drawing(f'<path fill="#ffdc5d" d="{FIST}"/>{FINGERS}', viewbox="0 0 64 64")


def partners(pair):
    numbers = ((contour.a, contour.b) for shape in pair.shapes for contour in shape.contours)
    return {(i, j) for i, j in numbers if i is not None and j is not None}


def test_parts_do_not_become_unlike_ones_if_that_looks_better(monkeypatch):
    def number_of_pairs(shapes, view):
        return float(sum(contour.is_matched for shape in shapes for contour in shape.contours))

    monkeypatch.setattr(pairings, "faults_of", number_of_pairs)
    assert partners(pair_of(A, B)) == {(0, 0)}
    assert partners(pair_of(B, A)) == {(0, 0)}


@pytest.mark.parametrize(("worse", "is_taken"), [(0.02, True), (0.2, False)])
def test_unlike_parts_are_rather_alone_if_that_looks_about_as_good(monkeypatch, worse, is_taken):
    def grade(shapes, view):
        return 2.0 - worse * sum(contour.is_matched for shape in shapes for contour in shape.contours)

    far, near = (f'<path fill="#5dadec" d="{path}"/>' for path in ("M44 4h12v8h-12z", "M14 12h14v12h-14z"))
    ends = [
        drawing(f'<path fill="#ffdc5d" d="{body}"/>{part}', viewbox="0 0 64 64")
        for body, part in ((HAND, far), (FIST, near))
    ]
    monkeypatch.setattr(pairings, "faults_of", grade)
    for pair in (ends, ends[::-1]):
        assert partners(pair_of(*pair)) == ({(0, 0)} if is_taken else {(0, 0), (1, 1)})


def test_a_small_gain_changes_nothing(monkeypatch):
    monkeypatch.setattr(pairings, "PREFERRED", 0.5)
    assert len(partners(pair_of(A, B))) > 1


def test_what_users_ask_for_is_left_as_it_is():
    assert len(partners(pair_of(A, B, motion="linear"))) > 1
    assert (2, 1) in partners(pair_of(A, B, match=[("2", "1")]))


def test_drawings_of_one_paint_are_left_as_they_are(monkeypatch):
    def fail(*arguments):
        raise AssertionError

    monkeypatch.setattr(pairings, "faults_of", fail)
    bars = drawing(f'<path d="{HAND}"/><path d="M4 4h4v16h-4z"/>'), drawing(f'<path d="{FIST}"/>')
    assert (0, 0) in partners(pair_of(*bars, swap="never"))


def test_the_line_around_a_fill_without_a_partner_goes_with_it():
    body, skid, rotor = "M20 24h30v20h-30z", "M24 44L10 62h20L46 44", "M4 12h56"
    line = '<path fill="none" stroke="#000" stroke-width="2" d="{}"/>'
    plane = f'<path fill="#9b9b9a" d="{skid}z"/><path fill="#d0cfce" d="{body}"/>'
    other = f'<path fill="#d0cfce" d="{body}"/>{line.format(body)}{line.format(rotor)}'
    a = drawing(f"{plane}{line.format(skid)}{line.format(body)}", viewbox="0 0 64 64")
    b = drawing(f"{other}{line.format('M35 12v12')}", viewbox="0 0 64 64")
    assert partners(pair_of(a, b, swap="never")) == {(1, 0), (3, 1)}
    assert partners(pair_of(b, a, swap="never")) == {(0, 1), (1, 3)}


def test_parts_of_one_paint_become_each_other_if_that_looks_better():
    def folder(back, front):
        return drawing(
            f'<path fill="#ffa000" d="{back}"/><path fill="#ffca28" d="{front}"/>', viewbox="0 0 48 48"
        )

    shut = folder("M4 8h14l4 4h22v8H4z", "M4 12h40v28H4z")
    opened = folder("M4 8h14l4 4h20v28H4z", "M12 18h34L40 40H8z")
    assert partners(pair_of(shut, opened)) == {(0, 0), (1, 1)}
    assert partners(pair_of(opened, shut)) == {(0, 0), (1, 1)}


@pytest.mark.parametrize(
    ("colour", "there", "worse", "is_alone"),
    [
        ("#5dadec", "M33 42h14v10h-14z", 0.0, True),
        ("#5dadec", "M33 42h14v10h-14z", 0.2, True),
        ("#5dadec", "M33 42h14v10h-14z", 0.5, False),
        ("#5dadec", "M22 32h14v10h-14z", 0.0, False),  # where it was, in part
        ("#ff6070", "M33 42h14v10h-14z", 0.0, False),  # about as red
    ],
)
def test_what_would_stray_to_something_of_another_colour_is_rather_alone(
    monkeypatch, colour, there, worse, is_alone
):
    def grade(shapes, view):
        return 2.0 - worse * sum(contour.is_matched for shape in shapes for contour in shape.contours)

    ends = [
        drawing(f'<path fill="#ffdc5d" d="{body}"/><path fill="{paint}" d="{part}"/>', viewbox="0 0 64 64")
        for body, paint, part in ((HAND, "#dd2e44", "M18 30h14v10h-14z"), (FIST, colour, there))
    ]
    monkeypatch.setattr(pairings, "faults_of", grade)
    for pair in (ends, ends[::-1]):
        assert partners(pair_of(*pair)) == ({(0, 0)} if is_alone else {(0, 0), (1, 1)})


def test_the_line_around_what_would_stray_goes_with_it(monkeypatch):
    part, there = "M18 30h14v10h-14z", "M33 42h14v10h-14z"
    line = f'<path fill="none" stroke="#31373d" stroke-width="2" d="{part}"/>'
    a = drawing(
        f'<path fill="#ffdc5d" d="{HAND}"/><path fill="#dd2e44" d="{part}"/>{line}', viewbox="0 0 64 64"
    )
    b = drawing(f'<path fill="#ffdc5d" d="{FIST}"/><path fill="#5dadec" d="{there}"/>', viewbox="0 0 64 64")
    monkeypatch.setattr(pairings, "faults_of", lambda shapes, view: 2.0)
    for pair in ((a, b), (b, a)):
        assert partners(pair_of(*pair)) == {(0, 0)}


def test_dark_parts_stay_what_they_are(monkeypatch):
    ends = [
        drawing(f'<path fill="#ffdc5d" d="{body}"/><path fill="{eye}" d="{part}"/>', viewbox="0 0 64 64")
        for body, eye, part in (
            (HAND, "#000000", "M18 30h10v10h-10z"),
            (FIST, "#31373d", "M33 42h10v10h-10z"),
        )
    ]
    monkeypatch.setattr(pairings, "faults_of", lambda shapes, view: 1.0)
    assert partners(pair_of(*ends)) == {(0, 0), (1, 1)}
