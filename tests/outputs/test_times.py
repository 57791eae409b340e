"""How many pictures an animation has, in which order, and for how long each is shown."""

import pytest

from shapeblend_cli.outputs.raster_animation import FASTEST, Run, run_for


@pytest.mark.parametrize("back", [False, True])
@pytest.mark.parametrize("pairs", [1, 2, 3])
@pytest.mark.parametrize("duration", [0.3, 1.0, 2.0, 7.77])
@pytest.mark.parametrize("fps", [1, 7, 25, 30, 50])
def test_a_run_takes_its_time_and_never_more_pictures_than_are_allowed(fps, duration, pairs, back):
    run = run_for(fps, 5, pairs, duration, back)
    assert run.seconds == pytest.approx(duration * pairs * (2 if back else 1))
    if run.steps > 1:
        assert run.pictures <= fps * run.seconds + 1e-6
    one_more = run._replace(steps=run.steps + 1)
    assert one_more.pictures > fps * run.seconds - 1e-6
    assert len(run.order()) == run.pictures
    for a_second in (100, 1000):
        delays = run.delays(a_second)
        assert len(delays) == run.pictures
        assert sum(delays) == round(run.seconds * a_second)
        assert max(delays) - min(delays) <= 1


def test_common_numbers_come_out_even():
    assert run_for(25, 5, 1, 2.0, False).delays(100) == [4] * 50
    assert run_for(25, 5, 2, 2.0, True).delays(1000) == [40] * 200


def test_delays_do_not_drift():
    run = run_for(30, 5, 1, 2.0, False)
    delays = run.delays(100)
    assert set(delays) == {3, 4}
    shown = 0
    for k, delay in enumerate(delays):
        assert abs(shown - k * 200 / 60) <= 0.5
        shown += delay
    assert shown == 200


def test_frames_that_are_asked_for_are_shown_with_both_ends():
    assert run_for(None, 3, 1, 2.0, False) == Run(1, 4, 2.0, False)
    assert run_for(None, 3, 1, 2.0, False).order() == [0, 1, 2, 3, 4]
    assert run_for(None, 0, 2, 2.0, False).order() == [0, 1, 2]


def test_back_neither_end_is_shown_twice():
    run = run_for(None, 1, 2, 1.0, True)
    assert run.order() == [0, 1, 2, 3, 4, 3, 2, 1]
    assert run.pictures == len(run.order())
    assert run_for(None, 0, 1, 1.0, True).order() == [0, 1]


def test_what_is_allowed_browsers_do_not_slow_down():
    for fps in range(1, FASTEST + 1):
        for pairs in (1, 2, 3):
            assert min(run_for(fps, 5, pairs, 1.3, False).delays(100)) >= 100 / FASTEST
