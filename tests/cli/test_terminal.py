"""What a person at a terminal sees."""

import contextlib
import os
import pty
import re
import signal
import sys
import time
from functools import partial

import numpy as np
import pytest

from shapeblend_cli.cli import run, terminal
from shapeblend_cli.system.clock import Clock
from tests.support.commands import names, process, read_to, start_on_terminal, write
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


@pytest.mark.parametrize(
    ("asked", "said"),
    [
        ("", ["wrote 5 frames, blend/frame-1.svg to frame-5.svg, in"]),
        ("-n 1", ["wrote 1 frame, blend/frame-1.svg, in"]),
        ("-n 0 -v", ["wrote nothing: --frames 0 asks for no in-betweens; --ends would write the drawings"]),
        ("-n 0 --preview look.html", ["wrote look.html; a browser shows it"]),
        ("-o m.svg", ["wrote m.svg, one animated SVG, 2 s long, ", "; a browser plays it"]),
        ("-o m.svg --duration 300ms", ["wrote m.svg, one animated SVG, 0.3 s long, "]),
        ("-o m.svg --duration 300", ["wrote m.svg, one animated SVG, 5 min long, "]),
        ("-o m.svg --hold 0.5 --repeat pingpong", ["wrote m.svg, one animated SVG, 5 s long, "]),
        (
            "-o m.json --preview look.html",
            ["wrote m.json, a Lottie", "\r\nshapeblend: wrote look.html; a browser shows it"],
        ),
        (
            "--emit pair -o two --report r.json",
            ["wrote two/a.svg and two/b.svg, in ", "\r\nshapeblend: wrote r.json"],
        ),
    ],
)
def test_a_run_says_what_it_wrote(files, asked, said):
    seen = on_screen(lambda: run([*files, *asked.split()])).decode()
    seen = seen[seen.index("shapeblend: wrote ") :]  # after how far it is, which a slow machine shows
    assert all(text in seen for text in said)


@pytest.mark.parametrize("asked", ["-o m.svg --mix .5,.5", "-o m.png", ""])
def test_what_stands_still_has_no_length(files, asked):
    assert b" long, " not in on_screen(lambda: run([*files, *asked.split()]))


@pytest.mark.parametrize("asked", ["-q", "-o -"])
def test_nothing_is_said_where_nobody_asks_or_looks(files, asked):
    assert on_screen(lambda: run([*files, *asked.split()])) == b""


def test_ctrl_c_leaves_nothing_behind(here):
    rng = np.random.default_rng(3)
    for name, m in (("a", 2300), ("b", 2500)):
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
    shown, _, said = (seen + read_to(ours)).rpartition(terminal.CLEAR.encode())
    os.close(ours)
    assert b"\n" not in shown
    assert said.split() == b"shapeblend: interrupted; nothing was written".split()
    assert process.wait(timeout=60) == 130
    assert names() == ["a.svg", "b.svg"]


@pytest.fixture
def impatient(monkeypatch):
    """Show at once how far a run is."""
    for name in ("PATIENCE", "OFTEN", "SELDOM"):
        monkeypatch.setattr(terminal, name, 0.01)


def test_a_terminal_shows_how_far_a_run_is_and_clears_that(impatient):
    def work():
        with terminal.Terminal() as shown:
            shown.progress("matching", 0.5)
            shown.progress("matching", 0.1)  # it does not go back
            shown._is_shown = False  # it may say that it is starting
            while not shown._is_shown:
                time.sleep(0.01)
            shown.note("a line")

    seen = on_screen(work).decode()
    assert "matching 50%, 0 s" in seen
    assert f"{terminal.CLEAR}shapeblend: a line" in seen
    assert seen.rpartition(terminal.CLEAR)[2].strip() in ("", "shapeblend: a line")


def test_a_command_shows_it_and_goes_on(files, impatient):
    codes = []
    seen = on_screen(lambda: codes.append(run(files)))
    assert codes == [0]
    assert b"matching" in seen


def test_a_line_now_and_then_where_there_is_no_terminal(impatient, capfd):
    said = ""
    with terminal.Terminal() as shown:
        shown.progress("matching", 1.0)
        while "drawing 40%" not in said:
            shown.progress("drawing", 0.4)
            time.sleep(0.01)
            said += capfd.readouterr().err
    assert all(line.startswith("shapeblend: drawing 40%, 0 s") for line in said.splitlines()[1:])


def test_short_runs_and_quiet_ones_show_nothing(files, capfd, monkeypatch):
    assert run(files) == 0
    for name in ("PATIENCE", "OFTEN", "SELDOM"):
        monkeypatch.setattr(terminal, name, 0.001)
    assert run([*files, "-o", "quiet", "-q"]) == 0
    assert capfd.readouterr() == ("", "")


def test_verbose_says_how_long_the_start_took_where_there_was_one(files, capsys):
    began = time.perf_counter()
    said = process(*files, "-v").stderr.decode().splitlines()[-1]
    passed = 1000.0 * (time.perf_counter() - began)
    start, read = re.match(r"shapeblend: start ([\d.]+) ms, read ([\d.]+) ms, ", said).groups()
    assert 0.0 < float(read) < float(start) < passed
    assert run([*files, "-o", "again", "-v"]) == 0
    assert capsys.readouterr().err.splitlines()[-1].startswith("shapeblend: read ")


def test_a_clock_adds_up_the_laps_of_a_stage():
    clock = Clock(now=iter((1.0, 3.0, 7.0, 8.0)).__next__)
    assert [clock.lap(stage) for stage in ("read", "match", "read")] == [2.0, 4.0, 1.0]
    assert list(clock.seconds.items()) == [("read", 3.0), ("match", 4.0)]
