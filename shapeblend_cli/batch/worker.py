"""A process that does one job after another, as a supervisor asks; see `processes`."""

from __future__ import annotations

import os
import signal
import sys
from collections.abc import Callable
from functools import cache
from time import perf_counter
from typing import Any, NamedTuple

from shapeblend_cli.batch.records import Record
from shapeblend_cli.batch.rows import command_of
from shapeblend_cli.clock import Clock
from shapeblend_cli.errors import in_words
from shapeblend_cli.interrupts import Interrupted, listening, stop_after
from shapeblend_cli.jobs import Job, all_targets, job_of
from shapeblend_cli.kept import Kept
from shapeblend_cli.output import Contents
from shapeblend_cli.processes import Parent

_supervisor: int | None = None
"""The number of the process that asks this one for jobs."""

DONE, FAILED, TIMEOUT, STOPPED = "done", "failed", "timeout", "stopped"


class Order(NamedTuple):
    """A job to do."""

    files: tuple[str, ...]
    given: dict[str, Any]  # values of options by the names of their fields
    force: bool  # whether files that no batch wrote are replaced
    retries: int = 0  # further attempts, if it fails
    data: tuple[bytes, ...] | None = None  # what is in the files, for a worker that does not have them


class Answer(NamedTuple):
    """What has become of a job."""

    status: str
    error: str | None = None
    notes: tuple[str, ...] = ()
    warnings: tuple[str, ...] = ()
    seconds: float = 0.0
    contents: Any = None  # what is to be written, by a worker that was given data; or what was found


Act = Callable[[Order, Callable[[str], None], Callable[[str], None]], Any]
"""What is done with an order: it is told how to note and how to warn, and returns the contents of the answer."""


def do(order: Order, act: Act | None = None) -> Answer:
    """Do a job, which is a blend unless an act is given, and say what has become of it, whatever happens."""
    began = perf_counter()
    notes: list[str] = []
    warned: list[str] = []
    contents = None

    def answer(status: str, error: str | None = None) -> Answer:
        return Answer(status, error, tuple(notes), tuple(warned), perf_counter() - began, contents)

    try:
        with listening():
            contents = (act or _blend)(order, notes.append, warned.append)
    except Interrupted as stop:
        if stop.has_written:
            return answer(DONE)
        return answer(TIMEOUT if stop.is_late else STOPPED, str(stop))
    except Exception as error:
        return answer(FAILED, in_words(error))
    return answer(DONE)


def watch_time(order: Order) -> None:
    """Have an order that takes longer than it may stop."""
    if hasattr(signal, "setitimer"):  # elsewhere the supervisor alone watches the time
        stop_after(order.given.get("timeout"))


def _blend(order: Order, note: Callable[[str], None], warn: Callable[[str], None]) -> Contents | None:
    from shapeblend_cli.files import check_files_of, check_libraries, make

    watch_time(order)
    job = _job(order)
    check_libraries(job)
    if order.data is not None:
        return make(
            job, Clock(), note, sources=dict(zip(order.files, order.data, strict=True)), kept=_kept()
        ).contents
    # Before anything is read: what changes meanwhile is done again by the next batch.
    made_of = Record(job, all_targets(job)).made_of()
    check_files_of(job)
    _write(job, make(job, Clock(), note, kept=_kept()).contents, made_of, order.force, warn)
    return None


def _job(order: Order) -> Job:
    """Return the job of an order. It replaces whatever there is: the record knows better what may be replaced."""
    job = job_of(order.files, order.given, command_of(order.files, order.given))
    return job._replace(write=job.write.replace(force=True))


def _write(
    job: Job, contents: Contents, made_of: dict[str, Any], force: bool, warn: Callable[[str], None]
) -> None:
    """Write what was made, after its record, unless whoever asked for it was killed: another batch may be at it."""
    from shapeblend_cli.files import write

    if _supervisor not in (None, os.getppid()):
        sys.exit()
    Record(job, all_targets(job)).write(made_of, contents, force)
    write(job, contents, warn)


@cache
def _kept() -> Kept:
    """Return what this process keeps of drawings."""
    return Kept()


def write_answer(order: Order, answer: Answer, made_of: dict[str, Any]) -> Answer:
    """Write what a worker made of data, and say what has become of the job then; see `Record.made_of`."""
    from shapeblend_cli.files import check_files_of

    warned: list[str] = []
    try:
        job = _job(order)
        check_files_of(job)
        _write(job, answer.contents or {}, made_of, order.force, warned.append)
    except Exception as error:
        return answer._replace(status=FAILED, error=in_words(error), contents=None)
    return answer._replace(warnings=(*answer.warnings, *warned), contents=None)


def main(act: Act | None = None) -> None:
    """Answer until there are no more orders, by blends or by another act; see `do`."""
    global _supervisor
    _supervisor = os.getppid()
    if hasattr(signal, "SIGINT"):
        signal.signal(signal.SIGINT, signal.SIG_IGN)  # the supervisor is told, and knows what to do
    parent = Parent()
    import shapeblend_cli.files  # noqa: F401

    for order in parent.orders():
        answer = do(order) if act is None else do(order, act)
        parent.answer(answer)
        if answer.status in (TIMEOUT, STOPPED):
            break  # a process that was interrupted anywhere is trusted with no other job
    os._exit(0)


if __name__ == "__main__":
    main()
