"""Worker processes, and who watches over them: a worker that dies costs its own job one more attempt, and no other.

Each worker has a thread that hands it one job at a time. What it makes goes to the writer. What becomes of jobs goes to
a queue, which the main thread empties; signals go there, too.
"""

from __future__ import annotations

import threading
import time
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from itertools import count
from queue import SimpleQueue
from typing import NamedTuple

from shapeblend_cli.batch.records import each_file
from shapeblend_cli.batch.worker import (
    DONE,
    MEMORY,
    STOPPED,
    TIMEOUT,
    Answer,
    Order,
    write_answer,
    write_answers,
)
from shapeblend_cli.errors import ShapeblendError, in_words
from shapeblend_cli.system.interrupts import NOTHING, late, told, too_large
from shapeblend_cli.system.processes import TOO_LARGE, Child

ATTEMPTS = 2
"""Minimum number of attempts at a job whose process dies, and of starts of a process."""

DIED = "died"

AT_ONCE = 64
"""Maximum number of jobs whose outputs are written in one step."""

MUCH = 2**26
"""Maximum size of outputs that are written in one step, in bytes, and of those that wait while further jobs begin."""

GRACE = 1.0
"""Time for a job to end by itself after its limit, or when it is asked to, in seconds; then its process is killed."""

BLENDS = "shapeblend_cli.batch.worker"
"""Module whose `main` a worker runs by default."""


class Ended(NamedTuple):
    """A job that has ended."""

    number: int
    answer: Answer
    attempts: int


class Stopped(ShapeblendError):
    """The batch was asked to stop by a signal."""

    def __init__(self, number: int) -> None:
        super().__init__("interrupted")
        self.number = number  # of the signal


class CannotStart(ShapeblendError):
    """Worker processes end before they have loaded all that they need."""


class CannotWrite(ShapeblendError):
    """What jobs have made cannot be written, and that is not due to one of them."""


def run_all(
    orders: Iterable[tuple[int, Order]], processes: int, most: int = 0, module: str = BLENDS
) -> Iterator[Ended]:
    """Do numbered jobs in a number of processes, write what they make, and yield each as it ends.

    After `most` failures no further jobs are started; with 0, failures stop nothing.

    Raises
    ------
    Stopped
        If a signal asked to stop, after all processes have ended; what they were writing is whole.
    CannotStart
        If no process can be started.
    CannotWrite
        If nothing that jobs make can be written any more.
    """
    jobs = _Jobs(orders, most)
    if not jobs.waiting:
        return
    workers = [Worker(module) for _ in range(min(processes, len(jobs.waiting)))]
    writer = Writer(jobs.end, jobs.events.put)
    error: Exception | None = None
    with told(lambda number: jobs.events.put(Stopped(number))):
        for worker in workers:
            threading.Thread(target=jobs.work, args=(worker, writer), daemon=True).start()
        running = len(workers) + 1
        try:
            while running:
                event = jobs.events.get()
                if event is None:
                    running -= 1
                    if running == 1:
                        writer.end()
                elif isinstance(event, Ended):
                    yield event
                else:
                    is_again = error is not None
                    error = error or event
                    jobs.waiting.clear()
                    for worker in workers:
                        worker.stop(at_once=is_again and isinstance(event, Stopped))
        finally:
            jobs.waiting.clear()
            for worker in workers:
                worker.stop()
            writer.end()
            writer.join()
    if error is not None:
        raise error


class _Jobs:
    """Jobs that wait, and what becomes of others; None for each thread that has ended."""

    def __init__(self, orders: Iterable[tuple[int, Order]], most: int) -> None:
        self.waiting = deque(orders)
        self.events: SimpleQueue[Ended | Exception | None] = SimpleQueue()
        self._most = most
        self._failed: list[int] = []

    def work(self, worker: Worker, writer: Writer) -> None:
        """Do jobs until there are no more."""
        try:
            while True:
                try:
                    number, order = self.waiting.popleft()
                except IndexError:
                    break
                done = worker.do(order)
                if done is None:
                    break
                ended = Ended(number, *done)
                if ended.answer.made_of is None:
                    self.end(ended)
                else:
                    writer.take(order, ended)
        except Exception as error:
            self.events.put(error)
        finally:
            worker.end()
            self.events.put(None)

    def end(self, ended: Ended) -> None:
        """Take that a job has ended."""
        if ended.answer.status != DONE:
            self._failed.append(ended.number)
            if len(self._failed) == self._most:
                self.waiting.clear()
        self.events.put(ended)


class Writer:
    """A thread that writes what jobs have made, in turn, and meanwhile further ones are done.

    It writes all that is there at a time. `end` takes jobs as they end, and `tell` errors, and None in the end. After
    an error nobody waits for it, and what it takes is left.
    """

    def __init__(self, end: Callable[[Ended], None], tell: Callable[[Exception | None], None]) -> None:
        self._end, self._tell = end, tell
        self._made: deque[tuple[Order, Ended, int]] = deque()  # with sizes in bytes
        self._size = 0
        self._is_over = False
        self._turn = threading.Condition()
        self._thread = threading.Thread(target=self._work, daemon=True)
        self._thread.start()
        self.join = self._thread.join

    def take(self, order: Order, ended: Ended) -> None:
        """Take what a job has made, after a wait while there is much that has to be written."""
        size = sum(len(data) for _, data in each_file(ended.answer.contents))
        with self._turn:
            self._turn.wait_for(lambda: self._is_over or not self._size or self._size + size <= MUCH)
            self._made.append((order, ended, size))
            self._size += size
            self._turn.notify_all()

    def end(self) -> None:
        """End after what is there is written."""
        with self._turn:
            self._is_over = True
            self._turn.notify_all()

    def _work(self) -> None:
        try:
            while made := self._next():
                self._write(made)
        except Exception as error:
            self._tell(CannotWrite(in_words(error)))
        finally:
            self.end()
            self._tell(None)

    def _next(self) -> list[tuple[Order, Ended]]:
        """Return what is to be written next; nothing at the end."""
        with self._turn:
            self._turn.wait_for(lambda: self._made or self._is_over)
            found = [self._made.popleft() for _ in range(min(len(self._made), AT_ONCE))]
            self._size -= sum(size for _, _, size in found)
            self._turn.notify_all()
        return [(order, ended) for order, ended, _ in found]

    def _write(self, made: list[tuple[Order, Ended]]) -> None:
        """Write what some jobs have made, again as often as a job may be tried."""
        answers = write_answers([(order, ended.answer, ended.answer.made_of or {}) for order, ended in made])
        for (order, ended), answer in zip(made, answers, strict=True):
            attempts = ended.attempts
            while answer.status != DONE and attempts <= order.retries:
                answer = write_answer(order, ended.answer, ended.answer.made_of or {})
                attempts += 1
            self._end(Ended(ended.number, answer, attempts))


class Worker:
    """A process that does a job at a time. It is started when it is needed, and again after it has died."""

    def __init__(self, module: str = BLENDS) -> None:
        self._module = module
        self._process: Child | None = None
        self._is_stopped = False
        self._lock = threading.Lock()

    def do(self, order: Order) -> tuple[Answer, int] | None:
        """Do a job, and return its answer and the number of attempts; None if it was stopped.

        Raises
        ------
        CannotStart
            If no process can be started.
        """
        for attempt in count(1):
            is_fresh = self._process is None
            process = self._started()
            if process is None:
                return None
            answer = self._asked(process, order)
            if answer is None and self._is_stopped:
                return None
            if answer is not None and answer.status == STOPPED:
                if self._is_stopped:
                    return None
                answer = None  # somebody else has told the process to stop
            if answer is None:
                code = self.end()
                if code == TOO_LARGE and is_fresh:
                    answer = Answer(MEMORY, f"{too_large(order.megabytes)}; {NOTHING}")
                elif code == TOO_LARGE:
                    continue  # what was kept of other jobs may have been part of it
                elif attempt >= max(ATTEMPTS, 1 + order.retries):
                    return Answer(DIED, died(order, attempt, f"{_ending(code)} at last")), attempt
                else:
                    continue
            if answer.status == TIMEOUT:
                self.end()
            if answer.status == DONE or attempt > order.retries:
                return answer, attempt
        return None

    def stop(self, *, at_once: bool = False) -> None:
        """Have the process end, after what it is writing is whole. It is not started again."""
        with self._lock:
            self._is_stopped = True
            if self._process is None or not self._process.is_running:
                return
            if at_once:
                self._process.kill()
                return
            self._process.terminate()
            end = threading.Timer(GRACE, self._process.kill)  # which leaves no file half written, either
            end.daemon = True
            end.start()

    def end(self) -> int:
        """End the process, and return its status."""
        with self._lock:
            process, self._process = self._process, None
        return process.end() if process is not None else 0

    def _started(self) -> Child | None:
        """Return the process, started where it is not running; None after `stop`."""
        if self._process is not None:
            return self._process
        for _ in range(ATTEMPTS):
            with self._lock:
                if self._is_stopped:
                    return None
                self._process = Child(self._module)
            if self._process.becomes_ready():
                return self._process
            code = self.end()
            if self._is_stopped:
                return None
        raise CannotStart(f"the processes that do the jobs do not start: {_ending(code)}")

    def _asked(self, process: Child, order: Order) -> Answer | None:
        """Return the answer to a job; None if the process died."""
        began = time.monotonic()
        timer = threading.Timer(order.seconds + GRACE, process.kill)
        timer.start()
        try:
            answer: Answer | None = process.ask(order)
        finally:
            timer.cancel()
        passed = time.monotonic() - began
        if answer is None and passed >= order.seconds:
            return Answer(TIMEOUT, f"{late(order.seconds)}; {NOTHING}", seconds=passed)
        return answer


def died(order: Order, attempts: int, how: str) -> str:
    """Return the message that the process of a job died, and how often."""
    times = "twice" if attempts == 2 else f"{attempts} times"
    return f"{' and '.join(order.files)}: the process that did it died {times}, {how}"


def _ending(code: int) -> str:
    return f"by signal {-code}" if code < 0 else f"with exit status {code}"
