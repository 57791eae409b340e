"""A process that does one job after another, as a supervisor asks; see `processes`."""

from __future__ import annotations

import hashlib
import os
import signal
import sys
from collections.abc import Callable, Mapping, Sequence
from functools import cache
from pathlib import Path
from time import perf_counter
from typing import Any, NamedTuple

from shapeblend_cli.batch.cache import Found, keep
from shapeblend_cli.batch.records import Record
from shapeblend_cli.errors import in_words
from shapeblend_cli.job.job import Job, all_targets, job_of
from shapeblend_cli.rows.row import command_of
from shapeblend_cli.system.clock import Clock
from shapeblend_cli.system.interrupts import HAS_LIMITS, Interrupted, limit, listening
from shapeblend_cli.system.kept import Kept
from shapeblend_cli.system.processes import MEGABYTES, TOO_LARGE, Parent
from shapeblend_cli.system.write import several, write_files

_supervisor: int | None = None
"""The number of the process that asks this one for jobs."""

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
    contents: Any = None  # what is to be written, by a worker that was given data; or what was found
    is_cached: bool = False  # whether the contents were kept from another time
    grade: dict[str, Any] | None = None  # of the worst blend of the job, if it was asked for and made


Act = Callable[[Order, Callable[[str], None], Callable[[str], None]], Answer]
"""A function of an order, and of functions that note and warn. It returns an answer without notes and seconds."""


def do(order: Order, act: Act | None = None) -> Answer:
    """Do a job, a blend unless an act is given, and return its answer, also after errors."""
    began = perf_counter()
    notes: list[str] = []
    warned: list[str] = []
    try:
        with listening():
            done = (act or _blend)(order, notes.append, warned.append)
    except Interrupted as stop:
        status = DONE if stop.has_written else TIMEOUT if stop.is_late else STOPPED
        done = Answer(status, None if stop.has_written else str(stop))
    except Exception as error:
        done = Answer(FAILED, in_words(error))
    return done._replace(notes=tuple(notes), warnings=tuple(warned), seconds=perf_counter() - began)


def limit_to(order: Order) -> None:
    """Have an order stop that takes more time or memory than it may."""
    if HAS_LIMITS:  # elsewhere the supervisor alone watches the time
        limit(order.seconds, order.megabytes, TOO_LARGE)


def _blend(order: Order, note: Callable[[str], None], warn: Callable[[str], None]) -> Answer:
    from shapeblend_cli.job.make import check_files_of, check_libraries, make
    from shapeblend_cli.svg.reading.read import contents_of

    limit_to(order)
    job = job_for(order)
    check_libraries(job)
    if order.data is None:
        check_files_of(job)
    data = order.data or tuple(map(contents_of, order.files))
    notes: list[str] = []
    sources = dict(zip(order.files, data, strict=True))
    made = make(job, Clock(), notes.append, sources=sources, kept=_kept())
    for text in notes:
        note(text)
    is_graded = order.is_graded and not job.output.settings.mix
    done = Answer(DONE, grade=made.run.worst_grade.as_json() if is_graded else None)
    if order.data is not None:
        return done._replace(contents=made.contents)
    _write(order, job, Found(made.contents, tuple(notes)), made_of(job, sources), warn)
    return done


def made_of(job: Job, sources: Mapping[str, bytes]) -> dict[str, Any]:
    """Return the inputs of a job, these drawings, in the form of its record."""
    return Record(job, all_targets(job)).made_of(lambda file: hashlib.sha256(sources[str(file)]).hexdigest())


def job_for(order: Order) -> Job:
    """Return the job of an order. It replaces all files: its record has decided which ones may be replaced."""
    job = job_of(order.files, order.given, command_of(order.files, order.given))
    return job._replace(write=job.write.replace(force=True))


def _write(
    order: Order,
    job: Job,
    found: Found,
    made_of: dict[str, Any],
    warn: Callable[[str], None],
    is_new: bool = True,
) -> None:
    """Write the contents after their record, unless the supervisor was killed: another batch may be at it."""
    from shapeblend_cli.job.make import write

    if _supervisor not in (None, os.getppid()):
        sys.exit()
    if is_new and order.cache is not None and os.access(order.cache, os.W_OK):
        try:
            keep(order.cache, job, made_of, found)
        except OSError as error:
            warn(f"{order.cache}: nothing can be added to the cache ({error.strerror})")
    Record(job, all_targets(job)).write(made_of, found.contents, order.force, order.batch)
    write(job, found.contents, warn if order.warns else lambda text: None)


@cache
def _kept() -> Kept:
    return Kept()


def write_answer(order: Order, answer: Answer, made_of: dict[str, Any]) -> Answer:
    """Write contents made elsewhere, and return the answer with the outcome; see `Record.made_of`."""
    from shapeblend_cli.job.make import check_files_of

    warned: list[str] = []
    try:
        job = job_for(order)
        check_files_of(job)
        found = Found(answer.contents or {}, answer.notes)
        _write(order, job, found, made_of, warned.append, is_new=not answer.is_cached)
    except Exception as error:
        return answer._replace(status=FAILED, error=in_words(error), contents=None)
    return answer._replace(warnings=(*answer.warnings, *warned), contents=None)


def write_answers(made: Sequence[tuple[Order, Answer, dict[str, Any]]]) -> list[Answer]:
    """Write what was made for several jobs, in as few steps as can be; see `write_answer`."""
    from shapeblend_cli.job.make import check_files_of, warn_of_others

    jobs = [job_for(order) for order, _, _ in made]
    contents: dict[Path, Any] = {}

    def record(job: Job, order: Order, answer: Answer, made_of: dict[str, Any]) -> None:
        Record(job, all_targets(job)).write(made_of, answer.contents, order.force, order.batch)

    try:
        for job, (_, answer, _) in zip(jobs, made, strict=True):
            check_files_of(job)
            contents |= answer.contents
        with several(record, jobs, *zip(*made, strict=True)) as each:
            list(each)
        write_files(contents, force=True)
    except Exception:
        # One by one, each that can be written is.
        return [write_answer(*one) for one in made]
    answers = []
    for job, (order, answer, _) in zip(jobs, made, strict=True):
        warned: list[str] = []
        if order.warns:
            warn_of_others(job, warned.append)
        answers.append(answer._replace(warnings=tuple(warned), contents=None))
    return answers


def main(act: Act | None = None) -> None:
    """Answer until there are no more orders, by blends or by another act; see `do`."""
    global _supervisor
    _supervisor = os.getppid()
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
