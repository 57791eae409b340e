import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from shapeblend_cli.options.easing import LINEAR, NAMES, PINGPONG, Ease, Timing, frame_times, parse
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
FORMLESS += [f"cubic-bezier({text}" for text in ("1,2,3)", "0,0,1,1", "nan,0,1,1)", "a,0,1,1)")]


@pytest.mark.parametrize("text", [*FORMLESS, "cubic-bezier(0.7,-0.6,0.3,1.6)"])  # the last one overshoots
def test_what_is_no_easing(text):
    with pytest.raises(ValueError, match=r"ease must be linear, ease, .*between 0 and 1, not"):
        Settings(ease=text)


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
