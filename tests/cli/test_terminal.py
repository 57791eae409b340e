"""What a person at a terminal sees."""

import contextlib
import os
import pty
import signal
import sys
from functools import partial

import numpy as np
import pytest

from shapeblend_cli.cli import run, terminal
from shapeblend_cli.clock import Clock
from tests.support.commands import names, read_to, start_on_terminal, write
from tests.support.drawings import LEAF, SQUARES, svg


def on_screen(action):
    """What a function writes with a terminal in place of standard error."""
    ours, theirs = pty.openpty()
    with os.fdopen(theirs, "w") as stderr, contextlib.redirect_stderr(stderr):
        action()
    seen = read_to(ours)
    os.close(ours)
    return seen


@pytest.fixture
def files(here):
    """The arguments for two small drawings."""
    write(a=svg(LEAF), b=svg(SQUARES))
    return ["a.svg", "b.svg", "--effort", "exact"]


def test_ctrl_c_leaves_nothing_behind(here):
    rng = np.random.default_rng(3)
    for name, m in (("a", 2900), ("b", 3100)):
        angle = 2 * np.pi * np.arange(m) / m
        waves = sum(rng.normal() / k * np.cos(k * angle + rng.uniform(0, 7)) for k in range(1, 200))
        points = " ".join(f"{z.real:.5f},{z.imag:.5f}" for z in np.exp(0.1 * waves + 1j * angle))
        write(**{name: svg(f"M{points}Z", viewbox="-2 -2 4 4")})
    command = [sys.executable, "-m", "shapeblend_cli", "a.svg", "b.svg", "--effort", "exact"]
    # Shells have what runs in the background ignore the signal, and this one too if the tests do.
    heard = partial(signal.signal, signal.SIGINT, signal.SIG_DFL)
    process, ours = start_on_terminal(command, preexec_fn=heard)
    seen = read_to(ours, b"%")
    assert b"matching" in seen
    process.send_signal(signal.SIGINT)
    # The bar may be drawn again before the signal is heard; it ends where the cursor shows again.
    bar, _, said = (seen + read_to(ours)).rpartition(b"\x1b[?25h")
    os.close(ours)
    assert b"\n" not in bar
    assert said.split() == b"shapeblend: interrupted; nothing was written".split()
    assert process.wait(timeout=60) == 1
    assert names() == ["a.svg", "b.svg"]


def test_a_bar_shows_on_a_terminal_when_it_takes_long():
    def work():
        now = 0.0
        with terminal.Terminal(now=lambda: now) as shown:
            shown.progress(0.1)
            now = terminal.PATIENCE
            shown.progress(0.5)

    seen = on_screen(work)
    assert b"matching" in seen
    assert b"50%" in seen
    assert b"10%" not in seen


def test_a_command_shows_the_bar_and_goes_on(files, monkeypatch):
    monkeypatch.setattr(terminal, "PATIENCE", 0.0)
    codes = []
    seen = on_screen(lambda: codes.append(run(files)))
    assert codes == [0]
    assert b"matching" in seen
    assert b"%" in seen


def test_no_bar_where_there_is_no_terminal(files, monkeypatch, capfd):
    monkeypatch.setattr(terminal, "PATIENCE", 0.0)
    assert run(files) == 0
    assert capfd.readouterr() == ("", "")


def test_a_line_now_and_then_where_there_is_no_terminal(capfd):
    now = 0.0
    with terminal.Terminal(now=lambda: now) as shown:
        for now in range(100):
            shown.progress(now / 100)
    lines = capfd.readouterr().err.splitlines()
    assert lines[0] == "shapeblend: matching: 10% after 10 s"
    assert 2 <= len(lines) <= 5


def test_a_clock_adds_up_the_laps_of_a_stage():
    clock = Clock(now=iter((1.0, 3.0, 7.0, 8.0)).__next__)
    assert [clock.lap(stage) for stage in ("read", "match", "read")] == [2.0, 4.0, 1.0]
    assert list(clock.seconds.items()) == [("read", 3.0), ("match", 4.0)]
