"""A process that does one job after another, as a supervisor asks, see `processes`; and the writing of what it made.

The supervisor writes, many jobs at a time: to wait for the disk takes as long for many files as for one, and meanwhile
processes do further jobs.
"""

from __future__ import annotations

import hashlib
import os
import signal
from collections.abc import Callable, Mapping, Sequence
from functools import cache
from pathlib import Path
from time import perf_counter
from typing import Any, NamedTuple

from shapeblend_cli.batch.cache import Found, keep
from shapeblend_cli.batch.records import Record
from shapeblend_cli.errors import in_words
from shapeblend_cli.job.job import Job, all_targets, job_of
from shapeblend_cli.job.targets import check_files_of, check_libraries, warn_of_others, write
from shapeblend_cli.rows.row import command_of
from shapeblend_cli.system.clock import Clock
from shapeblend_cli.system.interrupts import HAS_LIMITS, Interrupted, limit, listening
from shapeblend_cli.system.kept import Kept
from shapeblend_cli.system.processes import MEGABYTES, TOO_LARGE, Parent
from shapeblend_cli.system.write import several, write_files

DONE, FAILED, TIMEOUT, MEMORY, STOPPED = "done", "failed", "timeout", "memory", "stopped"

SECONDS = 300.0
"""Time limit of a job without --timeout, in seconds: one that hangs is not to hold up a batch for a night."""


class Order(NamedTuple):
    """A job to do."""

    files: tuple[str, ...]
    given: dict[str, Any]  # values of options by the names of their fields
    force: bool  # whether files that no batch wrote are replaced
    retries: int = 0  # further attempts, if it fails
    data: tuple[bytes, ...] | None = None  # what is in the files, for a worker that does not have them
    cache: str | None = None  # the folder where what is made is kept, too
    batch: tuple[str, ...] = ()  # where the job comes from, for its record
    warns: bool = True  # whether files of other runs that remain are worth a line
    is_graded: bool = False  # whether somebody wants to know how good the blend looks
    is_noted: bool = True  # whether somebody reads the notes, for some of which blends are graded

    @property
    def seconds(self) -> float:
        """Time limit, in seconds."""
        return float(self.given.get("timeout") or SECONDS)

    @property
    def megabytes(self) -> float:
        """Memory limit, in megabytes."""
        return float(self.given.get("max_memory") or MEGABYTES)


class Answer(NamedTuple):
    """What has become of a job."""

    status: str
    error: str | None = None
    notes: tuple[str, ...] = ()
    warnings: tuple[str, ...] = ()
    seconds: float = 0.0
    contents: Any = None  # what is to be written; or what was found
    made_of: dict[str, Any] | None = None  # of what is to be written, see `Record.made_of`
    is_cached: bool = False  # whether the contents were kept from another time
    grade: dict[str, Any] | None = None  # of the worst blend of the job, if it was asked for and made


Act = Callable[[Order, Callable[[str], None]], Answer]
"""A function of an order, and of one that notes. It returns an answer without notes and seconds."""


def do(order: Order, act: Act | None = None) -> Answer:
    """Do a job, a blend unless an act is given, and return its answer, also after errors."""
    began = perf_counter()
    notes: list[str] = []
    try:
        with listening():
            done = (act or _blend)(order, notes.append)
    except Interrupted as stop:
        done = Answer(TIMEOUT if stop.is_late else STOPPED, str(stop))
    except Exception as error:
        done = Answer(FAILED, in_words(error))
    return done._replace(notes=tuple(notes), seconds=perf_counter() - began)


def limit_to(order: Order) -> None:
    """Have an order stop that takes more time or memory than it may."""
    if HAS_LIMITS:  # elsewhere the supervisor alone watches the time
        limit(order.seconds, order.megabytes, TOO_LARGE)


def _blend(order: Order, note: Callable[[str], None]) -> Answer:
    from shapeblend_cli.job.make import make
    from shapeblend_cli.svg.reading.read import contents_of

    limit_to(order)
    job = job_for(order)
    check_libraries(job)
    if order.data is None:
        check_files_of(job)
    data = order.data or tuple(map(contents_of, order.files))
    sources = dict(zip(order.files, data, strict=True))
    made = make(job, Clock(), note if order.is_noted else None, sources=sources, kept=_kept())
    is_graded = order.is_graded and not job.output.settings.mix
    grade = made.run.worst_grade.as_json() if is_graded else None
    of = made_of(job, sources) if order.data is None else None
    return Answer(DONE, contents=made.contents, made_of=of, grade=grade)


def made_of(job: Job, sources: Mapping[str, bytes]) -> dict[str, Any]:
    """Return the inputs of a job, these drawings, in the form of its record."""
    return Record(job, all_targets(job)).made_of(lambda file: hashlib.sha256(sources[str(file)]).hexdigest())


def job_for(order: Order) -> Job:
    """Return the job of an order. It replaces all files: its record has decided which ones may be replaced."""
    job = job_of(order.files, order.given, command_of(order.files, order.given))
    return job._replace(write=job.write.replace(force=True))


def write_answer(order: Order, answer: Answer, made_of: dict[str, Any]) -> Answer:
    """Write what a job has made, after its record, and return the answer with the outcome; see `Record.made_of`."""
    warned: list[str] = []
    try:
        job = job_for(order)
        check_files_of(job)
        _keep(order, job, answer, made_of, warned.append)
        _record(order, job, answer, made_of)
        write(job, answer.contents or {}, warned.append if order.warns else lambda text: None)
    except Exception as error:
        return answer._replace(status=FAILED, error=in_words(error), contents=None, made_of=None)
    return answer._replace(warnings=(*answer.warnings, *warned), contents=None, made_of=None)


def write_answers(made: Sequence[tuple[Order, Answer, dict[str, Any]]]) -> list[Answer]:
    """Write what several jobs have made, in as few steps as can be; see `write_answer`."""
    contents: dict[Path, Any] = {}
    orders, answers, inputs = zip(*made, strict=True)
    warned: list[list[str]] = [[] for _ in made]
    try:
        jobs = [job_for(order) for order in orders]
        for job, (order, answer, of), texts in zip(jobs, made, warned, strict=True):
            check_files_of(job)
            contents |= answer.contents
            _keep(order, job, answer, of, texts.append)
        with several(_record, orders, jobs, answers, inputs) as each:
            list(each)
        write_files(contents, force=True)
        for job, order, texts in zip(jobs, orders, warned, strict=True):
            if order.warns:
                warn_of_others(job, texts.append)
    except Exception:
        # One by one, each that can be written is.
        return [write_answer(*one) for one in made]
    return [
        answer._replace(warnings=(*answer.warnings, *texts), contents=None, made_of=None)
        for answer, texts in zip(answers, warned, strict=True)
    ]


def _record(order: Order, job: Job, answer: Answer, made_of: dict[str, Any]) -> None:
    Record(job, all_targets(job)).write(made_of, answer.contents or {}, order.force, order.batch)


def _keep(
    order: Order, job: Job, answer: Answer, made_of: dict[str, Any], warn: Callable[[str], None]
) -> None:
    """Keep what was made in the cache, if there is one."""
    if answer.is_cached or order.cache is None or not os.access(order.cache, os.W_OK):
        return
    try:
        keep(order.cache, job, made_of, Found(answer.contents or {}, answer.notes))
    except OSError as error:
        warn(f"{order.cache}: nothing can be added to the cache ({error.strerror})")


@cache
def _kept() -> Kept:
    return Kept()


def main(act: Act | None = None) -> None:
    """Answer until there are no more orders, by blends or by another act; see `do`."""
    if hasattr(signal, "SIGINT"):
        signal.signal(signal.SIGINT, signal.SIG_IGN)  # the supervisor is told, and knows what to do
    parent = Parent()
    import shapeblend_cli.job.make  # noqa: F401

    for order in parent.orders():
        answer = do(order) if act is None else do(order, act)
        parent.answer(answer)
        if answer.status in (TIMEOUT, STOPPED):
            break  # a process that was interrupted anywhere is trusted with no other job
    os._exit(0)


if __name__ == "__main__":
    main()
