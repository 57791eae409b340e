"""Processes that die, take too long or are stopped, and what stands then."""

import errno
import heapq
import json
import os
import re
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import numpy as np
import pytest

from shapeblend_cli.batch import supervisor, worker
from shapeblend_cli.batch.worker import Answer, Order
from shapeblend_cli.cli import run
from shapeblend_cli.cli.terminal import Pace
from shapeblend_cli.job import make
from tests.support.commands import read_to, start_on_terminal, write
from tests.support.drawings import BAR, LEAF, svg

COMMAND = [sys.executable, "-m", "shapeblend_cli", "batch"]

LINE = ("--all", "in", "-o", "m/{n}.svg")


def test_many_processes_do_what_one_does(drawings, batch):
    for count, folder in ((1, "one"), (3, "three")):
        status, results, printed = batch("--all", "in", "-o", f"{folder}/{{n}}.svg", "-j", str(count))
        assert (status, len(results)) == (0, 6)
        assert "shapeblend: 6 done" in printed.err
        assert all(each["attempts"] == 1 and each["seconds"] > 0.0 for each in results.values())
    for path in Path("one").glob("*.svg"):
        assert path.read_bytes() == Path("three", path.name).read_bytes()


@pytest.mark.usefixtures("forked")
def test_a_process_that_dies_costs_its_job_one_more_attempt(drawings, broken, batch):
    broken("once('died-' + output[-5]) and output[-5] in '25' and os.kill(os.getpid(), 9)")
    status, results, _ = batch(*LINE, "-j", "2")
    assert (status, len(list(Path("m").glob("*.svg")))) == (0, 6)
    assert [results[n]["attempts"] for n in range(1, 7)] == [1, 2, 1, 1, 2, 1]


@pytest.mark.usefixtures("forked")
def test_a_job_that_kills_every_process_has_died_and_the_others_are_done(drawings, broken, batch):
    broken("output.endswith('3.svg') and os.kill(os.getpid(), 11)")
    status, results, printed = batch(*LINE, "-j", "2")
    assert status == 1
    assert [results[n]["status"] for n in range(1, 7)] == ["done"] * 2 + ["died"] + ["done"] * 3
    assert re.fullmatch(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ", results[3].pop("ended"))
    assert results[3] | {"seconds": 0} == {
        "job": 3,
        "a": "in/1.svg",
        "b": "in/10.svg",
        "output": "m/3.svg",
        "status": "died",
        "outputs": [],
        "seconds": 0,
        "error": "in/1.svg and in/10.svg: the process that did it died twice, by signal 11 at last",
        "attempts": 2,
        "cached": False,
        "grade": None,
        "notes": [],
    }
    assert "shapeblend: 5 done, 1 died" in printed.err


@pytest.mark.usefixtures("forked")
@pytest.mark.parametrize("how", ["time.sleep(60)", "[signal.pthread_sigmask(0, [14]), time.sleep(60)]"])
def test_a_job_that_takes_too_long(how, drawings, broken, batch, monkeypatch):
    """By itself, or where it does not listen, because the supervisor kills its process."""
    monkeypatch.setattr("shapeblend_cli.batch.supervisor.GRACE", 0.5)
    broken(f"output.endswith('3.svg') and {how}")
    status, results, _ = batch(*LINE, "-j", "2", "--timeout", "1")
    assert status == 1
    assert [results[n]["status"] for n in range(1, 7)] == ["done"] * 2 + ["timeout"] + ["done"] * 3
    assert "stopped after 1 s (--timeout)" in results[3]["error"]


def test_a_job_that_takes_too_much_memory(drawings, broken, batch):
    """Before that is said, the job is tried in a new process, as the old one may have kept something of others."""
    broken("sys.modules['kept'] = b'111' * 10**8 if output.endswith('3.svg') else b''")
    status, results, printed = batch(*LINE, "-j", "2", "--max-memory", "200")
    assert status == 1
    assert [results[n]["status"] for n in range(1, 7)] == ["done"] * 2 + ["memory"] + ["done"] * 3
    assert results[3]["error"] == "stopped at 200 MB of memory (--max-memory); nothing was written"
    assert "5 done, 1 took too much memory" in printed.err


def test_jobs_have_limits():
    assert (Order((), {}, False).seconds, Order((), {}, False).megabytes) == (300.0, 2000.0)


@pytest.mark.usefixtures("forked")
def test_failures_stop_no_other_job_unless_as_many_as_are_asked_for(drawings, batch):
    Path("in/1.svg").write_text("<svg/>", "utf-8")
    status, results, printed = batch("--chain", "in", "-o", "m/{n}.svg", "-j", "1")
    assert (status, [results[n]["status"] for n in (1, 2, 3)]) == (1, ["failed", "done", "done"])
    assert "in/1.svg: " in results[1]["error"]
    assert "1 failed" in printed.err
    for number, option in enumerate(("--fail-fast", "--keep-going=2", "--keep-going=3"), 1):
        status, results, printed = batch("--all", "in", "-o", "n/{n}.svg", "-j", "1", option)
        assert (status, len(results)) == (1, number)
        assert f"shapeblend: {number} failed, {6 - number} left" in printed.err


@pytest.mark.usefixtures("forked")
def test_jobs_that_fail_take_too_long_or_die_are_tried_again(drawings, broken, batch, monkeypatch):
    monkeypatch.setattr("shapeblend_cli.batch.supervisor.GRACE", 0.5)
    broken(
        "{'1': lambda: os.rename(*('in/1.svg', 'gone')[:: 1 if once('away') else -1]),"
        "'2': lambda: once('late') and time.sleep(60),"
        "'3': lambda: any(map(once, 'abc')) and os.kill(os.getpid(), 9)}[output[0]]()"
    )
    rows = "in/1.svg,in/2.svg,1.svg,\nin/2.svg,in/9.svg,2.svg,1\nin/9.svg,in/10.svg,3.svg,\n"
    Path("jobs.csv").write_text(f"a,b,o,timeout\n{rows}", "utf-8")
    status, results, _ = batch("jobs.csv", "--retries", "3")
    assert (status, results[1]["attempts"], results[3]["attempts"]) == (0, 2, 4)
    assert results[2]["attempts"] > 1


class Slow:
    """Writes nothing, and waits while it does; `made` has the numbers of jobs that were written in one step."""

    def __init__(self, monkeypatch, *, fails=0):
        self.begun, self.goes_on, self.fails, self.made = threading.Event(), threading.Event(), fails, []
        monkeypatch.setattr(supervisor, "write_answers", self.write)
        monkeypatch.setattr(supervisor, "write_answer", lambda *one: self.write([one])[0])

    def write(self, made):
        self.begun.set()
        assert self.goes_on.wait(60)
        self.made.append(len(made))
        self.fails -= 1
        return [answer._replace(status="done" if self.fails < 0 else "failed") for _, answer, _ in made]


def test_what_is_made_while_files_are_written_is_written_in_one_step(monkeypatch):
    disk, ended, told = Slow(monkeypatch), [], []
    writer = supervisor.Writer(ended.append, told.append)
    for number in range(70):
        answer = Answer("done", contents={Path(f"{number}.svg"): "..."}, made_of={})
        writer.take(Order((), {}, False), supervisor.Ended(number, answer, 1))
        assert disk.begun.wait(60)
    disk.goes_on.set()
    writer.end()
    writer.join()
    assert disk.made == [1, supervisor.AT_ONCE, 5]
    assert [each.number for each in ended] == [*range(70)]
    assert told == [None]


def test_jobs_wait_while_there_is_much_to_be_written(monkeypatch):
    disk, ended = Slow(monkeypatch), []
    monkeypatch.setattr(supervisor, "MUCH", 10)
    writer = supervisor.Writer(ended.append, lambda error: None)

    def make():
        for number in range(4):
            answer = Answer("done", contents={Path("x.svg"): "123456"}, made_of={})
            writer.take(Order((), {}, False), supervisor.Ended(number, answer, 1))

    maker = threading.Thread(target=make)
    maker.start()
    maker.join(0.2)
    assert maker.is_alive()
    disk.goes_on.set()
    maker.join(60)
    writer.end()
    writer.join()
    assert disk.made == [1, 1, 1, 1]


@pytest.mark.parametrize(
    ("retries", "status", "attempts"), [(0, "failed", 1), (1, "failed", 2), (3, "done", 3)]
)
def test_what_cannot_be_written_is_tried_again(monkeypatch, retries, status, attempts):
    disk, ended = Slow(monkeypatch, fails=2), []
    disk.goes_on.set()
    writer = supervisor.Writer(ended.append, lambda error: None)
    answer = Answer("done", contents={}, made_of={})
    writer.take(Order((), {}, False, retries), supervisor.Ended(7, answer, 1))
    writer.end()
    writer.join()
    assert [(each.number, each.answer.status, each.attempts) for each in ended] == [(7, status, attempts)]


def test_nobody_waits_for_a_writer_that_failed(monkeypatch):
    disk, told = Slow(monkeypatch), []
    monkeypatch.setattr(supervisor, "MUCH", 10)
    monkeypatch.setattr(disk, "made", None)  # which fails when something is added
    writer = supervisor.Writer(lambda ended: None, told.append)

    def make():
        for number in range(4):
            answer = Answer("done", contents={Path("x.svg"): "123456"}, made_of={})
            writer.take(Order((), {}, False), supervisor.Ended(number, answer, 1))

    maker = threading.Thread(target=make, daemon=True)
    maker.start()
    disk.goes_on.set()
    maker.join(5)
    assert not maker.is_alive()
    assert [type(each) for each in told] == [supervisor.CannotWrite, type(None)]


@pytest.mark.usefixtures("forked")
def test_a_batch_whose_writer_fails_ends_with_one_line(drawings, monkeypatch, capsys):
    def fail(made):
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC), "m")

    monkeypatch.setattr(supervisor, "write_answers", fail)
    monkeypatch.setattr(supervisor, "MUCH", 10)
    assert run(["batch", *LINE, "-j", "2", "--quiet", "--summary", "s.json"]) == 1
    line = "m: cannot be written (No space left on device)"
    assert capsys.readouterr().err == f"shapeblend: {line}\n"
    assert json.loads(Path("s.json").read_bytes())["error"] == line


@pytest.mark.usefixtures("forked")
def test_a_folder_that_is_taken_away_after_it_is_written_is_written_again(drawings, batch, monkeypatch):
    look = worker.warn_of_others

    def take_away(job, warn):
        if not Path("away").exists():
            Path(job.output.path).rename("away")
        look(job, warn)

    monkeypatch.setattr(worker, "warn_of_others", take_away)
    status, results, _ = batch("--chain", "in", "-o", "m/{n}", "-j", "1")
    assert (status, len(results), len(list(Path("m").glob("*/*.svg")))) == (0, 3, 15)


@pytest.mark.usefixtures("forked")
@pytest.mark.parametrize("option", ["", "--verbose", "--results=r.jsonl", "--summary=s.xml", "--cache=c"])
def test_blends_are_graded_for_notes_only_if_somebody_reads_them(option, drawings, monkeypatch):
    monkeypatch.setattr(make, "is_suspect", lambda shapes: Path("looked").touch())
    assert run(["batch", *LINE, "-j", "1", *filter(None, [option])]) == 0
    assert Path("looked").exists() is bool(option)


def test_processes_that_do_not_start_are_one_line(drawings, monkeypatch, capsys):
    monkeypatch.setattr("shapeblend_cli.system.processes.START", "import nothing_of_that_name")
    assert run(["batch", *LINE]) == 1
    assert "the processes that do the jobs do not start: with exit status 1" in capsys.readouterr().err


def test_modules_in_the_working_folder_are_not_taken_for_others(drawings, statuses):
    Path("json.py").write_text("raise SystemExit(3)", "utf-8")
    Path("numpy.py").write_text("raise SystemExit(3)", "utf-8")
    assert statuses("--chain", "in", "-o", "m/{n}.svg") == (0, "done done done")


def many(count):
    """Make a folder of so many drawings."""
    Path("in").mkdir()
    write(**{f"in/{k}": svg(f"M{k} 0" + (BAR if k % 2 else LEAF)) for k in range(count)})


def wait_for(file, text=b"\n"):
    """Wait until a file has some text."""
    end = time.monotonic() + 60.0
    while not (Path(file).exists() and text in Path(file).read_bytes()):
        assert time.monotonic() < end
        time.sleep(0.01)


@pytest.mark.parametrize(("number", "status"), [("SIGINT", 130), ("SIGTERM", 143)])
def test_a_signal_ends_it_when_what_is_being_written_is_whole(number, status, here):
    many(40)
    line = ["--chain", "in", "-o", "m/{n}.svg", "-j", "2", "--results", "r.jsonl"]
    process = subprocess.Popen([*COMMAND, *line], stderr=subprocess.PIPE)
    wait_for("r.jsonl")
    process.send_signal(getattr(signal, number))
    _, err = process.communicate(timeout=60)
    assert process.returncode == status
    assert b"interrupted; files that were being written are complete" in err
    told = {name for each in Path("r.jsonl").read_text().splitlines() for name in json.loads(each)["outputs"]}
    assert told == {str(path) for path in Path("m").glob("*.svg")}
    assert 0 < len(told) < 39
    assert not [path for path in Path("m").iterdir() if path.name.startswith(".shapeblend-")]


DEAF = (
    "[signal.signal(number, signal.SIG_IGN) for number in (14, 15)]"
    " + [print(os.getpid(), file=open('deaf', 'w')), time.sleep(600)]"
)


def is_gone(group):
    """Whether a process group has ended, seconds after its end was wanted."""
    for _ in range(500):
        try:
            os.killpg(group, 0)
        except ProcessLookupError:
            return True
        time.sleep(0.02)
    return False


def test_a_second_signal_ends_at_once_a_process_that_does_not_listen(drawings, broken):
    broken(DEAF)
    with open("broken/sitecustomize.py", "a", encoding="utf-8") as file:
        file.write("import shapeblend_cli.batch.supervisor as supervisor\nsupervisor.GRACE = 600.0\n")
    process = subprocess.Popen([*COMMAND, *LINE, "-j", "1"], stderr=subprocess.PIPE)
    wait_for("deaf")
    process.send_signal(signal.SIGINT)
    with pytest.raises(subprocess.TimeoutExpired):
        process.wait(0.5)
    process.send_signal(signal.SIGINT)
    _, err = process.communicate(timeout=60)
    assert (process.returncode, b"interrupted" in err, b"Traceback" in err) == (130, True, False)
    assert is_gone(int(Path("deaf").read_text()))
    assert not list(Path("m").glob("*.svg"))


@pytest.mark.usefixtures("forked")
def test_a_job_that_took_too_long_leaves_no_process(drawings, broken, batch, monkeypatch):
    monkeypatch.setattr("shapeblend_cli.batch.supervisor.GRACE", 0.5)
    broken(f"output.endswith('3.svg') and {DEAF}")
    status, results, _ = batch(*LINE, "-j", "2", "--timeout", "1")
    assert (status, results[3]["status"]) == (1, "timeout")
    assert is_gone(int(Path("deaf").read_text()))


@pytest.mark.parametrize(("spread", "workers"), [(0.3, 2), (0.8, 4), (1.0, 1)])
def test_an_estimate_is_right_within_a_third_or_is_not_given(spread, workers):
    """Jobs that take about as long as others, and some that take much longer, in any order."""
    errors, silent = [], 0
    for seed in range(20):
        durations = np.random.default_rng(seed).lognormal(-2.0, spread, 600)
        free, ends = [0.0] * workers, []
        for seconds in durations:
            begin = heapq.heappop(free)
            heapq.heappush(free, begin + seconds)
            ends.append((begin + seconds, seconds))
        ends.sort()
        clock = [0.0]
        pace = Pace(lambda clock=clock: clock[0])
        for number, (end, seconds) in enumerate(ends, 1):
            clock[0] = end
            pace.ended(seconds)
            left = pace.left(len(ends) - number)
            if number < 0.8 * len(ends):
                if left is None:
                    silent += 1
                else:
                    errors.append(abs(left / (ends[-1][0] - end) - 1.0))
    assert len(errors) > silent  # it is given for most of the time
    assert np.mean(np.array(errors) < 0.3) > 0.95


def test_no_estimate_of_few_jobs_or_of_jobs_that_differ_much():
    pace = Pace()
    for number in range(19):
        assert pace.left(100) is None, number
        pace.ended(1.0)
    unlike = Pace()
    for number in range(200):
        unlike.ended(100.0 if number % 50 == 0 else 0.1)
        assert unlike.left(100) is None


def test_a_terminal_shows_a_bar(here):
    many(90)
    process, ours = start_on_terminal([*COMMAND, "--chain", "in", "-o", "m/{n}.svg", "-j", "1"])
    seen = read_to(ours, b" s left, ")
    assert b"[" in seen
    assert b" of 89 jobs, about " in seen
    process.kill()
    process.wait()
    os.close(ours)
