"""What a person at a terminal sees."""

import os
import pty
import signal
import subprocess
import sys
import time
from functools import partial

import numpy as np
import pytest


@pytest.fixture
def large(tmp_path):
    """Two outlines that take more than a second to solve exactly."""
    rng = np.random.default_rng(3)
    for name, m in (("a", 2900), ("b", 3100)):
        angle = 2 * np.pi * np.arange(m) / m
        waves = sum(rng.normal() / k * np.cos(k * angle + rng.uniform(0, 7)) for k in range(1, 200))
        z = np.exp(0.1 * waves + 1j * angle)
        points = " ".join(f"{v.real:.5f},{v.imag:.5f}" for v in z)
        (tmp_path / f"{name}.svg").write_text(
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="-2 -2 4 4"><path d="M{points}Z"/></svg>'
        )
    return tmp_path


COMMAND = [sys.executable, "-m", "shapeblend_cli", "a.svg", "b.svg", "--effort", "exact"]


def test_ctrl_c_leaves_nothing_behind(large):
    # Shells have what runs in the background ignore the signal, and this one too if the tests do.
    heard = partial(signal.signal, signal.SIGINT, signal.SIG_DFL)
    run = subprocess.Popen(COMMAND, cwd=large, stderr=subprocess.PIPE, text=True, preexec_fn=heard)
    time.sleep(0.8)
    run.send_signal(signal.SIGINT)
    said = run.communicate(timeout=60)[1]
    assert run.returncode == 1
    assert said.split() == "shapeblend: interrupted; nothing was written".split()
    assert sorted(os.listdir(large)) == ["a.svg", "b.svg"]


def test_a_bar_shows_on_a_terminal_when_it_takes_long(large):
    ours, theirs = pty.openpty()
    run = subprocess.Popen(COMMAND, cwd=large, stdout=theirs, stderr=theirs, stdin=subprocess.DEVNULL)
    os.close(theirs)
    seen = b""
    while True:
        try:
            part = os.read(ours, 4096)
        except OSError:  # the other side has closed
            break
        if not part:
            break
        seen += part
    os.close(ours)
    assert run.wait(timeout=60) == 0
    assert b"matching" in seen
    assert b"%" in seen


def test_no_bar_where_there_is_no_terminal(large):
    done = subprocess.run(COMMAND, cwd=large, capture_output=True, check=True)
    assert (done.stdout, done.stderr) == (b"", b"")
