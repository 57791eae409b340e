"""A process that does one job after another, as a supervisor asks by standard input, and answers by standard output.

Both carry pickles. All that is slow to load is loaded once, before the first job.
"""

from __future__ import annotations

import os
import pickle
import signal
import warnings
from collections.abc import Callable
from time import perf_counter
from typing import Any, BinaryIO, NamedTuple

from shapeblend_cli.batch.records import Record
from shapeblend_cli.batch.rows import command_of
from shapeblend_cli.errors import in_words
from shapeblend_cli.interrupts import Interrupted, listening, stop_after
from shapeblend_cli.jobs import all_targets, job_of

READY = "ready"

DONE, FAILED, TIMEOUT, STOPPED = "done", "failed", "timeout", "stopped"


class Order(NamedTuple):
    """A job to do."""

    files: tuple[str, ...]
    given: dict[str, Any]  # values of options by the names of their fields
    force: bool  # whether files that no batch wrote are replaced


class Answer(NamedTuple):
    """What has become of a job."""

    status: str
    error: str | None = None
    notes: tuple[str, ...] = ()
    warnings: tuple[str, ...] = ()
    seconds: float = 0.0


def do(order: Order) -> Answer:
    """Do a job, and say what has become of it, whatever happens."""
    began = perf_counter()
    notes: list[str] = []
    warned: list[str] = []

    def answer(status: str, error: str | None = None) -> Answer:
        return Answer(status, error, tuple(notes), tuple(warned), perf_counter() - began)

    try:
        with listening():
            _blend(order, notes.append, warned.append)
    except Interrupted as stop:
        if stop.has_written:
            return answer(DONE)
        return answer(TIMEOUT if stop.is_late else STOPPED, str(stop))
    except Exception as error:
        return answer(FAILED, in_words(error))
    return answer(DONE)


def _blend(order: Order, note: Callable[[str], None], warn: Callable[[str], None]) -> None:
    from shapeblend_cli.files import blend_files

    if hasattr(signal, "setitimer"):  # elsewhere the supervisor alone watches the time
        stop_after(order.given.get("timeout"))
    job = job_of(order.files, order.given, command_of(order.files, order.given))
    record = Record(job, all_targets(job))
    made_of = (
        record.made_of()
    )  # before anything is read: what changes meanwhile is done again by the next batch

    def keep_record(contents: Any) -> None:
        record.write(made_of, contents, order.force)

    # The record knows better than `force` what may be replaced.
    blend_files(
        job._replace(write=job.write.replace(force=True)), note, warn, lambda share: None, keep_record
    )


def main() -> None:
    """Answer until standard input ends."""
    if hasattr(signal, "SIGINT"):
        signal.signal(signal.SIGINT, signal.SIG_IGN)  # the supervisor is told, and knows what to do
    warnings.simplefilter("ignore")
    orders, answers = os.fdopen(os.dup(0), "rb"), os.fdopen(os.dup(1), "wb")
    # Nothing that a library reads or prints must get between them.
    nothing = os.open(os.devnull, os.O_RDWR)
    for number in (0, 1):
        os.dup2(nothing, number)
    import gc

    import shapeblend_cli.files  # noqa: F401

    gc.freeze()
    _send(answers, READY)
    while (order := _receive(orders)) is not None:
        answer = do(order)
        _send(answers, answer)
        if answer.status in (TIMEOUT, STOPPED):
            break  # a process that was interrupted anywhere is trusted with no other job
    os._exit(0)


def _send(stream: BinaryIO, value: Any) -> None:
    pickle.dump(value, stream)
    stream.flush()


def _receive(stream: BinaryIO) -> Order | None:
    try:
        order: Order = pickle.load(stream)
    except EOFError:
        return None
    return order


if __name__ == "__main__":
    main()
