"""A batch from its tasks to its results."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from datetime import UTC, datetime
from typing import Any, NamedTuple

from shapeblend_cli.batch.cache import find
from shapeblend_cli.batch.claims import claimed
from shapeblend_cli.batch.options import BatchOptions
from shapeblend_cli.batch.plan import Task
from shapeblend_cli.batch.records import HashOf, Record, State, each_file, relative
from shapeblend_cli.batch.strays import strays
from shapeblend_cli.batch.supervisor import Ended, Stopped
from shapeblend_cli.batch.worker import DONE, FAILED, Answer, Order, job_for, write_answers
from shapeblend_cli.job.job import all_targets
from shapeblend_cli.job.targets import warn_of_others
from shapeblend_cli.system.interrupts import told

CURRENT = "current"

AT_ONCE = 64
"""Maximum number of jobs whose outputs are copied out of a cache in one step."""

MUCH = 2**26
"""Maximum size of the outputs that are copied out of a cache in one step, in bytes."""


class Outcome(NamedTuple):
    """What has become of a task."""

    task: Task
    status: str  # done, current, failed, timeout, memory or died
    answer: Answer
    attempts: int

    def as_json(self) -> dict[str, Any]:
        """Return it as the results have it, with the time that it is now."""
        a, b, *more = self.task.files
        found = {"job": self.task.number, "a": a, "b": b} | ({"more": more} if more else {})
        are_there = self.status in (DONE, CURRENT)
        return found | {
            "output": self.task.output,
            "status": self.status,
            "outputs": list(map(str, self.task.targets)) if are_there else [],
            "seconds": round(self.answer.seconds, 6),
            "error": self.answer.error,
            "attempts": self.attempts,
            "cached": self.answer.is_cached,
            "grade": self.answer.grade,
            "notes": [*self.answer.notes, *self.answer.warnings],
            "ended": f"{datetime.now(UTC):%Y-%m-%dT%H:%M:%SZ}",
        }


def states(tasks: Sequence[Task]) -> Iterator[State]:
    """Say of each task whether it is up to date."""
    hash_of = HashOf()
    for task in tasks:
        yield Record(task.job, task.targets).state(hash_of, bool(task.given.get("force")))


@contextmanager
def begun(tasks: Sequence[Task], options: BatchOptions, note: Callable[[str], None]) -> Iterator[list[State]]:
    """Give the states of tasks, and if there is anything to do keep other batches away from what they write.

    See `claimed` for what `note` is told, and for what is raised.
    """
    found = []
    gone = [each for each in strays(tasks) if each.files] if options.clean else []
    for state in states(tasks):
        found.append(state)
        if state.reason or gone:
            break
    else:
        yield found
        return
    places = [*(task.place for task in tasks), *(each.place for each in gone)]
    with claimed(places, options.wait, note):
        yield list(states(tasks))
    for each in gone:
        each.remove_folders()


Run = Callable[[Sequence[tuple[int, Order]], int], Iterator[Ended]]
"""Does numbered orders until a number of them have failed; see `supervisor.run_all` and `cluster.run_all`."""


def run_tasks(
    tasks: Sequence[Task],
    found: Sequence[State],
    run: Run,
    options: BatchOptions,
    *,
    with_notes: bool = False,
) -> Iterator[Outcome]:
    """Have the tasks done that are not up to date, by their states; yield all of them as they end.

    Without notes, only what files have is noted.

    Raises what `run` raises.
    """
    most = 1 if options.fail_fast else options.keep_going
    failed = 0
    waiting: dict[int, Task] = {}
    for task, state in zip(tasks, found, strict=True):
        if state.refusal is not None:
            yield Outcome(task, FAILED, Answer(FAILED, str(state.refusal)), 0)
            failed += 1
            if failed == most:
                return
        elif state.reason:
            waiting[task.number] = task
        else:
            edited = (
                f"{state.edited}: was edited since it was written, and stays as it is" if state.edited else ""
            )
            yield Outcome(task, CURRENT, Answer(CURRENT, warnings=(edited,) if edited else ()), 0)
    orders = [(number, order_of(task, options, with_notes=with_notes)) for number, task in waiting.items()]
    for number, answer in _cached(orders):
        yield Outcome(waiting.pop(number), answer.status, answer, 0)
        failed += answer.status != DONE
        if failed == most > 0:
            return
    for ended in run([order for order in orders if order[0] in waiting], max(most - failed, 0)):
        yield Outcome(waiting[ended.number], ended.answer.status, ended.answer, ended.attempts)


def order_of(task: Task, options: BatchOptions, *, with_notes: bool = False) -> Order:
    """Return the order that has a task done, with notes if they are asked for, or if a file is to have them."""
    force, batch = bool(task.given.get("force")), tuple(relative(task.source, task.place.parent))
    return Order(
        task.files,
        task.given,
        force,
        options.retries,
        cache=options.cache,
        batch=batch,
        warns=not options.clean,
        is_graded=bool(options.results) or (options.summary or "").lower().endswith(".json"),
        is_noted=with_notes or bool(options.results or options.summary or options.cache),
    )


def clean(tasks: Sequence[Task], ended: Mapping[int, str]) -> Iterator[str]:
    """Remove files that no job writes any more, and yield messages; see `Outcome.status` for how tasks ended.

    Of those that failed, everything stays.
    """
    for each in strays(tasks, {number for number, status in ended.items() if status in (DONE, CURRENT)}):
        yield from each.remove()
    for task in tasks:
        if ended.get(task.number) == DONE:
            texts: list[str] = []
            warn_of_others(task.job, texts.append)
            yield from texts


def from_cache(order: Order) -> tuple[Order, Answer, dict[str, Any]] | None:
    """Return what the cache has of a job, as it is to be written; None if that is nothing, or the job is to be done."""
    if order.cache is None or order.force:
        return None
    job = job_for(order)
    made_of = Record(job, all_targets(job)).made_of()
    found = find(order.cache, job, made_of)
    if found is None:
        return None
    return order, Answer(DONE, notes=found.notes, contents=found.contents, is_cached=True), made_of


def _cached(orders: Sequence[tuple[int, Order]]) -> Iterator[tuple[int, Answer]]:
    """Write what the cache has, many jobs at a time; Stopped is raised if a signal asked to stop."""
    stops: list[int] = []
    found: dict[int, tuple[Order, Answer, dict[str, Any]]] = {}
    size = 0
    with told(stops.append):
        for number, order in orders:
            if stops:
                raise Stopped(stops[0])
            one = from_cache(order)
            if one is not None:
                found[number] = one
                size += sum(len(data) for _, data in each_file(one[1].contents))
            if found and (len(found) >= AT_ONCE or size > MUCH or number == orders[-1][0]):
                yield from zip(found, write_answers([*found.values()]), strict=True)
                found, size = {}, 0


def processors() -> int:
    """Return how many processors there are for this process."""
    try:
        return len(os.sched_getaffinity(0))
    except AttributeError:
        return os.cpu_count() or 1
