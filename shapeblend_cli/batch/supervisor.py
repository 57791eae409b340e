"""Worker processes, and who watches over them: a worker that dies costs its own job one more attempt, and no other.

Each worker has a thread that hands it one job at a time. What becomes of jobs goes to a queue, which the main thread
empties; signals go there, too.
"""

from __future__ import annotations

import threading
import time
from collections import deque
from collections.abc import Iterable, Iterator
from itertools import count
from queue import SimpleQueue
from typing import NamedTuple

from shapeblend_cli.batch.worker import DONE, MEMORY, STOPPED, TIMEOUT, Answer, Order
from shapeblend_cli.errors import ShapeblendError
from shapeblend_cli.system.interrupts import NOTHING, late, told, too_large
from shapeblend_cli.system.processes import TOO_LARGE, Child

ATTEMPTS = 2
"""Minimum number of attempts at a job whose process dies, and of starts of a process."""

DIED = "died"

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


def run_all(
    orders: Iterable[tuple[int, Order]], processes: int, most: int = 0, module: str = BLENDS
) -> Iterator[Ended]:
    """Do numbered jobs in a number of processes, and yield each as it ends.

    After `most` failures no further jobs are started; with 0, failures stop nothing.

    Raises
    ------
    Stopped
        If a signal asked to stop, after all processes have ended; what they were writing is whole.
    CannotStart
        If no process can be started.
    """
    waiting = deque(orders)
    failed: list[int] = []
    events: SimpleQueue[Ended | Exception | None] = SimpleQueue()
    workers = [Worker(module) for _ in range(min(processes, len(waiting)))]

    def work(worker: Worker) -> None:
        """Do jobs until there are no more."""
        try:
            while True:
                try:
                    number, order = waiting.popleft()
                except IndexError:
                    break
                done = worker.do(order)
                if done is None:
                    break
                if done[0].status != DONE:
                    failed.append(number)
                    if len(failed) == most:
                        waiting.clear()
                events.put(Ended(number, *done))
        except Exception as error:
            events.put(error)
        finally:
            worker.end()
            events.put(None)

    error: Exception | None = None
    with told(lambda number: events.put(Stopped(number))):
        for worker in workers:
            threading.Thread(target=work, args=(worker,), daemon=True).start()
        running = len(workers)
        try:
            while running:
                event = events.get()
                if event is None:
                    running -= 1
                elif isinstance(event, Ended):
                    yield event
                else:
                    is_again = error is not None
                    error = error or event
                    waiting.clear()
                    for worker in workers:
                        worker.stop(at_once=is_again and isinstance(event, Stopped))
        finally:
            waiting.clear()
            for worker in workers:
                worker.stop()
    if error is not None:
        raise error


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
