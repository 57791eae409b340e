"""A batch from its tasks to its results."""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from typing import Any, NamedTuple

from shapeblend_cli.batch.plan import Task
from shapeblend_cli.batch.records import HashOf, Record, State
from shapeblend_cli.batch.supervisor import Ended
from shapeblend_cli.batch.worker import DONE, FAILED, Answer, Order
from shapeblend_cli.errors import OutputError
from shapeblend_cli.outputs.formats import STANDARD_OUTPUT
from shapeblend_cli.system.staging import clear

CURRENT = "current"


class Outcome(NamedTuple):
    """What has become of a task."""

    task: Task
    status: str  # done, current, failed, timeout or died
    answer: Answer
    attempts: int

    def as_json(self) -> dict[str, Any]:
        """Return it as the results have it."""
        a, b, *more = self.task.files
        found = {"job": self.task.number, "a": a, "b": b} | ({"more": more} if more else {})
        are_there = self.status in (DONE, CURRENT)
        return found | {
            "status": self.status,
            "outputs": list(map(str, self.task.targets)) if are_there else [],
            "seconds": round(self.answer.seconds, 6),
            "error": self.answer.error,
            "attempts": self.attempts,
            "notes": [*self.answer.notes, *self.answer.warnings],
        }


def states(tasks: Sequence[Task]) -> list[State]:
    """Say of each task whether it is up to date, after clearing up after batches that were killed."""
    for folder in sorted(
        {parent for task in tasks for t in task.targets for parent in (t.parent, t.parent.parent)}
    ):
        if folder.is_dir():
            clear(folder)
    hash_of = HashOf()
    return [Record(task.job, task.targets).state(hash_of, bool(task.given.get("force"))) for task in tasks]


Orders = Sequence[tuple[int, Order]]


def run_tasks(
    tasks: Sequence[Task], found: Sequence[State], run: Callable[[Orders], Iterator[Ended]], fail_fast: bool
) -> Iterator[Outcome]:
    """Have the tasks done that are not up to date; yield all of them as they end.

    `found` are the tasks' states, and `run` does numbered orders: see `supervisor.run_all` and `cluster.run_all`, also
    for what is raised.
    """
    waiting: dict[int, Task] = {}
    for task, state in zip(tasks, found, strict=True):
        if state.refusal is not None:
            yield Outcome(task, FAILED, Answer(FAILED, str(state.refusal)), 0)
            if fail_fast:
                return
        elif state.reason:
            waiting[task.number] = task
        else:
            edited = (
                f"{state.edited}: was edited since it was written, and stays as it is" if state.edited else ""
            )
            yield Outcome(task, CURRENT, Answer(CURRENT, warnings=(edited,) if edited else ()), 0)
    orders = [(n, Order(t.files, t.given, bool(t.given.get("force")))) for n, t in waiting.items()]
    for ended in run(orders):
        yield Outcome(waiting[ended.number], ended.answer.status, ended.answer, ended.attempts)


@contextmanager
def results(file: str | None) -> Iterator[Callable[[Outcome], None]]:
    """Open a file for results, or standard output; give a function that writes one, as a line that is there at once."""
    if file is None:
        yield lambda outcome: None
        return
    stream = None
    if file != STANDARD_OUTPUT:
        try:
            stream = open(file, "wb")
        except (OSError, ValueError) as error:
            raise _cannot_write(file, error) from error

    def write(outcome: Outcome) -> None:
        line = json.dumps(outcome.as_json(), allow_nan=False) + "\n"
        if stream is None:
            sys.stdout.write(line)
            sys.stdout.flush()
            return
        try:
            stream.write(line.encode())
            stream.flush()
        except OSError as error:
            raise _cannot_write(file, error) from error

    try:
        yield write
    finally:
        if stream is not None:
            with suppress(OSError):
                stream.close()


def _cannot_write(file: str, error: OSError | ValueError) -> OutputError:
    return OutputError(file, f"cannot be written ({getattr(error, 'strerror', None) or error})")


def check_results(file: str, tasks: Sequence[Task], manifest: str | None) -> None:
    """Raise OutputError if results would replace what the batch reads or writes."""
    place = os.path.realpath(file)
    taken = {os.path.realpath(path) for task in tasks for path in (*task.files, *map(str, task.targets))}
    if place in taken or (manifest is not None and place == os.path.realpath(manifest)):
        raise OutputError(file, "is read or written by the batch; another name for the results would work")


def processors() -> int:
    """Return how many processors there are for this process."""
    try:
        return len(os.sched_getaffinity(0))
    except AttributeError:
        return os.cpu_count() or 1
