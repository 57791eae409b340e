"""Signals that come while kernels work."""

import signal
import sys
import time
from functools import partial

import numpy as np
import pytest

from shapeblend_cli.geometry.crossings import polygon_crossings
from shapeblend_cli.matching import sweeps
from shapeblend_cli.matching.angles import Bending, Corners, fill_bends
from shapeblend_cli.matching.smoothing import smoothed
from shapeblend_cli.matching.tables import Progress, Terminals, Window
from shapeblend_cli.matching.travel import Stations, add_travel
from shapeblend_cli.matching.work import Wires
from shapeblend_cli.options.constants import WorkConstants
from shapeblend_cli.system.interrupts import Interrupted, listening
from shapeblend_cli.system.write import several
from tests.support.contours import polygon


class Stop(Exception):
    """What the signal raises."""


def stop(*_):
    raise Stop


MANY, ROWS = 3_000_000, 2_000
RING = np.exp(2j * np.pi * np.arange(ROWS) / ROWS)
TABLES = Wires(RING[::100], RING[::100]).tables()
ANYWHERE = Terminals(0, ROWS - 1, np.zeros(3))
VERTICES = np.zeros(MANY, np.intp)


def wide():
    """Return a window of many columns, in flat arrays that have room for two."""
    window = Window.full(MANY, ROWS)
    return window._replace(column_offset=np.arange(MANY) % 2 * ROWS)


def bends():
    ring, bends = Corners(RING, True), np.zeros((2 * ROWS, 7))
    return partial(
        fill_bends, ring, ring, Bending(WorkConstants(), 1.0, 1.0), VERTICES, np.ones(MANY), wide(), bends
    )


def travel():
    stations = Stations(RING, np.ones(ROWS))
    return partial(add_travel, stations, stations, 1.0, VERTICES, wide(), np.zeros((2 * ROWS, 7)))


def sweep_back():
    to_go = np.empty((2 * ROWS, 3))
    return partial(sweeps.cost_to_go, TABLES, wide(), ANYWHERE, to_go, np.empty(0, np.uint8))


def sweep():
    progress = Progress(wide(), ANYWHERE, np.empty((MANY, 2), np.intp))
    arrays = sweeps.Arrays(TABLES, wide(), wide(), np.empty((0, 3)), progress)
    return partial(sweeps.sweep, arrays, ANYWHERE, np.inf, progress, MANY - 1, False)


def smooth():
    return partial(smoothed, np.exp(2j * np.pi * np.arange(300_000) / 300_000), True, 0.1)


def crossings():
    points = np.random.default_rng(1).random((200_000, 2)) @ (1, 1j)
    return partial(polygon_crossings, [polygon(points)])


@pytest.mark.parametrize("kernel", [bends, travel, sweep_back, sweep, smooth, crossings])
def test_kernels_that_work_for_a_minute_look_for_signals(kernel):
    work, began = kernel(), time.monotonic()
    before = signal.signal(signal.SIGALRM, stop)
    signal.setitimer(signal.ITIMER_REAL, 0.05)
    try:
        with pytest.raises(Stop):
            work()
    finally:
        signal.signal(signal.SIGALRM, before)
    assert time.monotonic() - began < 20.0


def test_a_stop_while_files_are_handed_to_threads_waits_for_all_of_them():
    unfinished = []

    def act(k):
        unfinished.append(k)
        if k == 0:
            signal.raise_signal(signal.SIGTERM)
        time.sleep(0.003)
        unfinished.remove(k)

    before = signal.signal(signal.SIGTERM, signal.SIG_DFL), sys.getswitchinterval()
    sys.setswitchinterval(1e-6)
    try:
        for _ in range(200):
            with pytest.raises(Interrupted), listening(), several(act, range(16)) as each:
                list(each)
            assert not unfinished
    finally:
        signal.signal(signal.SIGTERM, before[0])
        sys.setswitchinterval(before[1])
