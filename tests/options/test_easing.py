import re

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from shapeblend_cli.options.easing import (
    FORMS,
    LINEAR,
    NAMES,
    PINGPONG,
    TOLERANCE,
    Ease,
    Timing,
    frame_times,
    parse,
)
from shapeblend_cli.options.settings import Settings

shares = st.floats(0.0, 1.0)


@pytest.mark.parametrize("name", NAMES)
def test_progress_is_that_of_the_curve(name):
    ease = parse(name)
    s = np.linspace(0.0, 1.0, 20_001)
    x, y = (
        3 * (1 - s) ** 2 * s * p + 3 * (1 - s) * s**2 * q + s**3
        for p, q in ((ease.x1, ease.x2), (ease.y1, ease.y2))
    )
    for time in np.linspace(0.0, 1.0, 41):
        assert ease.at(time) == pytest.approx(np.interp(time, x, y), abs=1e-7)
    assert str(ease) == name


@given(st.builds(Ease, shares, shares, shares, shares), shares, shares)
def test_progress_rises_from_0_to_1(ease, first, second):
    assert (ease.at(0.0), ease.at(1.0)) == (0.0, 1.0)
    low, high = sorted((first, second))
    assert 0.0 <= ease.at(low) <= ease.at(high) + 1e-12 <= 1.0 + 2e-12
    assert ease.mirrored().at(1.0 - low) == pytest.approx(1.0 - ease.at(low), abs=1e-5)
    assert parse(str(ease)) == pytest.approx(ease, abs=1e-5)


@given(st.builds(Ease, shares, shares, shares, shares), st.floats(0.1, 0.45), st.floats(0.55, 0.9), shares)
def test_a_piece_is_a_part_of_the_curve(ease, start, end, time):
    piece = ease.piece(start, end)
    first, last = ease.time_of(start), ease.time_of(end)
    whole = ease.at(first + time * (last - first))
    if last - first > 1e-3:
        assert start + (end - start) * piece.at(time) == pytest.approx(whole, abs=0.03)


def test_time_of_a_progress():
    ease = parse("ease-in")
    assert ease.at(ease.time_of(0.3)) == pytest.approx(0.3)
    assert LINEAR.time_of(0.3) == 0.3


FORMLESS = ["", "easy", "0,0,1,1"]
FORMLESS += [
    f"cubic-bezier({text}"
    for text in ("1,2,3)", "0,0,1,1", "nan,0,1,1)", "a,0,1,1)", "2,0,0,1)", "0,99,0,1)")
]
FORMLESS += [f"spring({text}" for text in ("1,100)", "1,100,0)", "nan,1,1)", "1,1e5,0.01)", "1,100,10")]
FORMLESS += [
    f"linear({text}" for text in ("0)", "0.1,1)", "0,0.9)", "0,nan,1)", "0,9,1)", "0,1 50%)", "0,1%,1)", ")")
]


@pytest.mark.parametrize("text", FORMLESS)
def test_what_is_no_easing(text):
    with pytest.raises(ValueError, match=r"^ease must be .*(spring|bezier|linear)\(.*, (not|and x1 is) "):
        Settings(ease=text)


MEANT = {
    "bounce": "elastic-out",
    "overshoot": "back-out",
    "anticipate": "back-in",
    "easeInOut": "ease-in-out",
    "easeOutBack": "back-out",
    "ease-out-back": "back-out",
    "back.out(1.7)": "back-out",
    "elastic.inOut": "elastic-in-out",
    "power2.out": "ease-out",
}


@pytest.mark.parametrize("text", MEANT)
def test_a_name_from_elsewhere_is_answered_by_what_comes_closest(text):
    with pytest.raises(ValueError, match=f"ease must be a known easing, not .*; {MEANT[text]} would work"):
        Settings(ease=text)
    assert parse(MEANT[text]).at(1.0) == 1.0


NUMBERED = {
    "cubic-bezier(1,2,3)": "'cubic-bezier(1,2,3)', which has 3 numbers; cubic-bezier(",
    "cubic-bezier(1.5,0,1,1)": "with x1 and x2 between 0 and 1, and x1 is 1.5;",
    "cubic-bezier(0,0,-1,1)": "and x2 is -1;",
    "spring": "must be spring(mass,stiffness,damping), not 'spring'; spring(1,100,10) would work",
    "spring(1)": "not 'spring(1)', which has 1 number; spring(1,100,10) would work",
    "steps(5)": "not 'steps(5)'; stops of linear(0,...,1) make steps",
}


@pytest.mark.parametrize("text", NUMBERED)
def test_what_is_wrong_with_an_easing_of_numbers_is_said(text):
    with pytest.raises(ValueError, match=re.escape(NUMBERED[text])):
        Settings(ease=text)


@pytest.mark.parametrize("example", [example for _, example in FORMS.values()])
def test_the_examples_in_errors_are_easings(example):
    assert parse(example).at(1.0) == 1.0


def test_frames_are_spaced_by_it():
    assert frame_times(3, True) == [0.0, 0.25, 0.5, 0.75, 1.0]
    eased = frame_times(3, False, parse("ease-in"))
    assert eased == [parse("ease-in").at(t) for t in (0.25, 0.5, 0.75)]
    assert eased[0] < 0.25


def test_rests_are_between_reaching_a_drawing_and_leaving_it():
    timing = Timing(2.0, hold=(1.0, 3.0))
    assert [timing.when(k) for k in range(3)] == [0.0, 1.5, 4.0]
    assert [timing.when(k, leaves=True) for k in range(3)] == [0.5, 3.0, 5.5]
    assert [timing.when(place) for place in (0.25, 1.5)] == [0.75, 3.5]
    assert timing.length(2) == 5.5
    assert timing._replace(repeat=PINGPONG).length(1) == 0.5 + 1.0 + 1.5 + 1.0


@given(st.integers(1, 5), st.floats(0.0, 5.0))
def test_without_rests_places_are_times(pairs, place):
    assert Timing().when(place) == place
    assert (Timing().length(pairs), Timing(repeat=PINGPONG).length(pairs)) == (pairs, 2 * pairs)


CURVED = {
    "back": (0.0, 1.1),
    "back-in": (-0.1, 1.0),
    "elastic-in-out": (-0.19, 1.19),
    "spring(1,100,30)": (0.0, 1.0),
}
CURVED |= {
    "cubic-bezier(0.3,-0.6,0.3,1.6)": (-0.1, 1.1),
    "linear(0, -0.3 20%, 1.25 70% 80%, 1)": (-0.3, 1.25),
}


@pytest.mark.parametrize("text", CURVED)
def test_easing_beyond_the_drawings_begins_and_ends_at_them(text):
    ease = parse(text)
    shares = [ease.at(time) for time in np.linspace(0.0, 1.0, 501)]
    assert (ease.at(0.0), ease.at(1.0)) == (0.0, 1.0)
    assert (min(shares), max(shares)) == pytest.approx(CURVED[text], abs=0.01)
    assert ease.at(ease.time_of(0.5)) == pytest.approx(0.5)
    assert ease.mirrored().at(0.3) == pytest.approx(1.0 - ease.at(0.7))
    assert parse(str(ease)) == ease
    # What CSS is told are the same lines.
    for time in (0.1, 0.5, 0.9):
        assert parse(ease.css()).at(time) == pytest.approx(ease.at(time), abs=1e-3)


def test_a_spring_settles_as_its_equation_says():
    mass, stiffness, damping = 1.0, 100.0, 10.0
    ease, place, speed = parse(f"spring({mass},{stiffness},{damping})"), 0.0, 0.0
    length, steps = np.log(1000.0) / (damping / (2.0 * mass)), 200_000
    for k in range(steps):
        if k % 20_000 == 0:
            assert ease.at(k / steps) == pytest.approx(place, abs=4e-3)
        speed += (stiffness * (1.0 - place) - damping * speed) / mass * (length / steps)
        place += speed * (length / steps)


@pytest.mark.parametrize(("text", "formula"), [("back-in", lambda t: t**3 * 2.70158 - t**2 * 1.70158)])
def test_lines_are_as_near_as_the_tolerance(text, formula):
    ease = parse(text)
    assert max(abs(ease.at(t) - formula(t)) for t in np.linspace(0.0, 1.0, 997)) < TOLERANCE * 1.01


def test_without_rests_and_delay_the_text_of_timing_is_that_of_older_versions():
    assert (
        repr(Timing()) == "Timing(seconds=2.0, ease=Ease(x1=0.0, y1=0.0, x2=1.0, y2=1.0), repeat='forever')"
    )
    assert "hold" not in repr(Timing(delay=1.0))
    assert repr(Timing(delay=1.0)).endswith("delay=1.0)")
