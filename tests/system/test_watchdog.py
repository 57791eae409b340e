"""What ends a process that does not listen, and what leaves it alone."""

import os
import signal
import subprocess
import sys

import pytest

START = """if True:
    import itertools, os, signal, time
    from shapeblend_cli.system.interrupts import Interrupted, has_written, limit, listening, told, uninterrupted

    def hang():
        "Keep the interpreter in one instruction, for hours."
        sum(itertools.repeat(1, 10**12))

    def fill(megabytes):
        return b"1" * int(megabytes * 1e6)

    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    with listening():
"""


def said(code):
    """Run a line of code in a run that is listening; return the exit status and what was said."""
    done = subprocess.run(
        [sys.executable, "-c", START + 8 * " " + code], capture_output=True, text=True, timeout=120
    )
    return done.returncode, done.stderr


def test_a_deaf_process_is_ended_when_its_time_is_over():
    assert said("limit(0.1, None); hang()") == (
        1,
        "shapeblend: stopped after 0.1 s (--timeout); nothing was written\n",
    )


def test_a_deaf_process_is_ended_by_a_signal():
    kill = "os.system(f'(sleep 0.1; kill {os.getpid()}) &')"
    assert said(f"limit(None, None); {kill}; hang()") == (
        143,
        "shapeblend: interrupted; nothing was written\n",
    )


def test_a_process_is_ended_above_its_memory_and_not_below():
    full = "shapeblend: stopped at 300 MB of memory (--max-memory); nothing was written\n"
    assert said("limit(None, 300, 75); fill(400); hang()") == (75, full)
    assert said("limit(None, 300); fill(100); time.sleep(0.2)") == (0, "")


@pytest.mark.parametrize(
    "code",
    [
        "with told(lambda number: None): limit(0.1, None); time.sleep(2)",
        "limit(None, 300)\n        with uninterrupted(): x = fill(400); time.sleep(0.2); del x; time.sleep(0.2)",
        "limit(None, 300); has_written(); x = fill(400); time.sleep(0.2)",
    ],
    ids=["a signal is handled", "files are moved", "all is written"],
)
def test_a_process_is_left_alone_where(code):
    assert said(code) == (0, "")


@pytest.mark.parametrize(("seconds", "looks"), [(0.0, 501), (0.1, 6)], ids=["it waits", "it computes"])
def test_a_process_that_waits_for_its_turn_has_more_time_to_handle_a_signal(
    load_uncompiled, monkeypatch, seconds, looks
):
    module = load_uncompiled("shapeblend_cli.system.watchdog")
    pipe, end = os.pipe()
    os.write(end, bytes([signal.SIGTERM]))
    pauses = []

    def ended(status):
        raise SystemExit(status)

    monkeypatch.setattr(module.os, "_exit", ended)
    monkeypatch.setattr(module.time, "sleep", pauses.append)
    monkeypatch.setattr(module.time, "process_time", lambda: seconds * len(pauses))
    with pytest.raises(SystemExit) as end_of_process:
        module.Watchdog(pipe, -1, 1024, 0).watch(b"", b"", b"", 75)
    assert (end_of_process.value.code, len(pauses)) == (143, looks)
    os.close(pipe)
    os.close(end)


def test_it_runs_uncompiled(load_uncompiled, monkeypatch):
    module = load_uncompiled("shapeblend_cli.system.watchdog")
    ends = []

    def end(status):
        ends.append(status)
        dog.is_over = True

    monkeypatch.setattr(module.os, "_exit", end)
    dog = module.Watchdog(0, -1, 1024, 1)
    dog.watch(b"", b"", b"", 75)
    assert ends[0] == 75
