"""Jobs done by the workers of a dask scheduler. Drawings travel as bytes, and whoever asked for the batch writes.

The scheduler sees to it that each job is done by one worker, and by another one if that is gone. What is here keeps it
supplied, a few jobs for each worker at a time; writes what comes back; and keeps away from workers of other versions.

A worker has jobs done by processes of its own (`compute`), one for each that it does at a time: a job that ends its
process, takes too long or fills the memory does that to such a process and not to the worker, and a worker with several
threads keeps several processors busy.
"""

from __future__ import annotations

import logging
import os
import pickle
import threading
import time
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager, suppress
from queue import Empty, SimpleQueue
from typing import Any, NamedTuple, cast

from shapeblend_cli.batch.records import method
from shapeblend_cli.batch.supervisor import DIED, CannotStart, Ended, Stopped, Worker, died
from shapeblend_cli.batch.worker import DONE, FAILED, Answer, Order, made_of, write_answer
from shapeblend_cli.errors import InputError, ShapeblendError, with_extra
from shapeblend_cli.job.job import job_of
from shapeblend_cli.system.interrupts import told
from shapeblend_cli.version import __version__

PATIENCE = 8.0
"""Maximum wait for an answer of the scheduler, and for a worker, in seconds."""

OFTEN = 1.0
"""Time between two looks at the workers, in seconds."""

AHEAD = 3
"""Jobs that the scheduler has at a time, for each thread of a worker."""

LEAST = 8
"""Minimum number of jobs that the scheduler has at a time."""

ATTEMPTS = 3
"""Maximum number of times that a job is sent, if sending fails or a worker does not understand it."""

LONGEST_REST = 60.0
"""Maximum idle time of a worker's process, in seconds."""

Identity = tuple[str, str]
"""The version of a program, and a hash of it."""


class ClusterError(ShapeblendError):
    """The scheduler cannot be reached, or none of its workers can do the jobs."""


class _Sent(NamedTuple):
    """A job that was sent."""

    order: Order  # without the data
    made_of: dict[str, Any]
    future: Any
    is_alone: bool  # whether it is done while no other job is


class _Back(NamedTuple):
    """What came back of a job: its answer in bytes, nothing from a worker that refuses it, or an error."""

    number: int
    future: Any
    found: bytes | BaseException | None


def run_all(
    orders: Iterable[tuple[int, Order]], address: str, most: int, note: Callable[[str], None]
) -> Iterator[Ended]:
    """Do numbered jobs on a cluster, write what they make, and yield each as it ends, like `supervisor.run_all`.

    `note` is told which workers are not used.

    Raises
    ------
    Stopped
        If a signal asked to stop; what was being written is whole.
    ClusterError
        If there is no scheduler, or not any more, or none of its workers can be used.
    """
    waiting = deque(orders)
    failed = 0
    if not waiting:
        return
    events: SimpleQueue[_Back | Stopped] = SimpleQueue()
    with told(lambda number: events.put(Stopped(number))), _connected(address) as client:
        batch = _Batch(client, _Workers(client, address, note), events)
        batch.workers.wait(events)
        while waiting or batch.sent or batch.alone:
            yield from batch.supply(waiting)
            try:
                event = events.get(timeout=OFTEN)
            except Empty:
                batch.workers.look()
                continue
            if isinstance(event, Stopped):
                raise event
            batch.workers.look_now_and_then()
            back = batch.take(event, waiting)
            if back is not None:
                if back.answer.status != DONE:
                    failed += 1
                    if failed == most:
                        waiting.clear()
                        batch.alone.clear()
                yield back


@contextmanager
def _connected(address: str) -> Iterator[Any]:
    """Give a client of a scheduler. Its library prints nothing; what there is to say is said in a line."""
    try:
        import distributed
    except ImportError:
        raise ClusterError(f"--cluster needs dask.distributed; {with_extra('cluster')} installs it") from None
    before = logging.root.manager.disable
    logging.disable(logging.CRITICAL)
    client: Any = None
    try:
        try:
            client = cast(Any, distributed.Client)(address, timeout=PATIENCE, set_as_default=False)
        except (OSError, ValueError, TypeError) as error:
            reason = " ".join(str(error).split()) or type(error).__name__
            raise ClusterError(
                f"{address}: no scheduler answers there ({reason}); one that `dask scheduler` has started would work"
            ) from None
        yield client
    finally:
        if client is not None:
            # In a thread, as a scheduler that is gone would be waited for.
            end = threading.Thread(target=_close, args=(client,), daemon=True)
            end.start()
            end.join(2.0)
        logging.disable(before)


def _close(client: Any) -> None:
    with suppress(Exception):
        client.close(timeout=1)


class _Workers:
    """The workers of a scheduler, and which of them have the same program as this process."""

    def __init__(self, client: Any, address: str, note: Callable[[str], None]) -> None:
        self._client = client
        self._address = address
        self._note = note
        self._threads: dict[str, int] = {}
        self._refusals: dict[str, str] = {}  # by address; empty for those that can be used
        self._last = 0.0

    def wait(self, events: SimpleQueue[Any]) -> None:
        """Wait for the first worker that can be used; a signal ends that."""
        end = time.monotonic() + PATIENCE
        self.look()
        while not self.usable:
            if self._threads:
                raise ClusterError(
                    f"{self._address}: none of its workers can be used; {next(filter(None, self._refusals.values()))}"
                )
            if time.monotonic() > end:
                raise ClusterError(
                    f"{self._address}: the scheduler has no workers; `dask worker {self._address}` would start one"
                )
            with suppress(Empty):
                raise events.get(timeout=0.2)
            self.look()

    @property
    def usable(self) -> list[str]:
        """The addresses of those that can be used."""
        return [address for address in self._threads if not self._refusals.get(address)]

    @property
    def restriction(self) -> list[str] | None:
        """Those that jobs are for; None if they are all."""
        usable = self.usable
        return usable if len(usable) < len(self._threads) else None

    @property
    def room(self) -> int:
        """How many jobs the scheduler may have at a time."""
        return max(LEAST, AHEAD * sum(self._threads[address] for address in self.usable))

    def look_now_and_then(self) -> None:
        """Look which workers there are, unless that was done just now."""
        if time.monotonic() - self._last > OFTEN:
            self.look()

    def look(self) -> None:
        """Look for workers, and ask new ones for their identity; ClusterError if the scheduler does not answer."""
        if self._client.status != "running":
            raise gone(self._address)
        try:
            self._threads = self._client.nthreads()
            new = [address for address in self._threads if address not in self._refusals]
            found = self._client.run(identity, workers=new, on_error="return") if new else {}
        except Exception:
            raise gone(self._address) from None
        for worker, answer in found.items():
            if isinstance(answer, OSError):
                continue  # it is gone
            self._refusals[worker] = _refusal(worker, answer, identity())
            if self._refusals[worker]:
                self._note(f"{self._refusals[worker]}; it gets no jobs")
        self._last = time.monotonic()


def gone(address: str) -> ClusterError:
    """Return the error that is raised if the scheduler is gone."""
    return ClusterError(
        f"{address}: the scheduler is gone; what was written stays, and the same command does the rest"
    )


def _refusal(worker: str, answer: Identity | Exception, expected: Identity) -> str:
    """Say why a worker cannot be used, by its identity; empty if it can."""
    if isinstance(answer, Exception):
        return (
            f"the worker {worker} does not have this version of shapeblend ({' '.join(str(answer).split())})"
        )
    if tuple(answer) == expected:
        return ""
    other = f"shapeblend {answer[0]}" + (" of other code" if answer[0] == expected[0] else "")
    return f"the worker {worker} has {other}, and this is {expected[0]}"


class _Batch:
    """The jobs that a scheduler has."""

    def __init__(self, client: Any, workers: _Workers, events: SimpleQueue[Any]) -> None:
        self.workers = workers
        self.sent: dict[int, _Sent] = {}
        self.alone: deque[tuple[int, Order]] = deque()  # which may be what kills the workers that do them
        self._client = client
        self._events = events
        self._attempts: dict[int, int] = {}
        self._run = os.urandom(6).hex()

    def supply(self, waiting: deque[tuple[int, Order]]) -> Iterator[Ended]:
        """Send jobs while there is room; yield those whose drawings cannot be read."""
        while waiting and len(self.sent) < self.workers.room and self.workers.usable:
            yield from self._send(*waiting.popleft(), is_alone=False)
        if self.alone and not waiting and not self.sent and self.workers.usable:
            yield from self._send(*self.alone.popleft(), is_alone=True)

    def _send(self, number: int, order: Order, *, is_alone: bool) -> Iterator[Ended]:
        from shapeblend_cli.svg.reading.read import contents_of

        try:
            data = tuple(map(contents_of, order.files))
        except InputError as error:
            yield Ended(number, Answer(FAILED, str(error)), 1)
            return
        of = made_of(job_of(order.files, order.given, ()), dict(zip(order.files, data, strict=True)))
        attempt = self._attempts[number] = self._attempts.get(number, 0) + 1
        future = self._client.submit(
            compute,
            identity(),
            pickle.dumps(order._replace(data=data)),
            key=f"shapeblend-{self._run}-{number}-{attempt}",
            pure=False,
            workers=self.workers.restriction,
            # Those that can be used may all end, and others come.
            allow_other_workers=self.workers.restriction is not None,
        )
        self.sent[number] = _Sent(order, of, future, is_alone)
        future.add_done_callback(lambda future: self._came_back(number, future))

    def _came_back(self, number: int, future: Any) -> None:
        """Fetch what a job has come to, in a thread of the library. If its worker is gone, it is done again first."""
        try:
            found = future.result()
        except BaseException as error:
            found = error
        self._events.put(_Back(number, future, found))

    def take(self, back: _Back, waiting: deque[tuple[int, Order]]) -> Ended | None:
        """Write the answer, and return the outcome of the job; None if it has to be done again."""
        from distributed import KilledWorker

        number, found = back.number, back.found
        sent = self.sent.pop(number)
        back.future.release()
        if isinstance(found, bytes):
            answer, attempts = pickle.loads(found)
            if answer.contents is not None:
                answer = write_answer(sent.order, answer, sent.made_of)
            return Ended(number, answer, attempts)
        if isinstance(found, KilledWorker):
            # Of the jobs that a worker had when it died, any may have been the reason.
            if not sent.is_alone:
                self.alone.append((number, sent.order))
                return None
            attempts = 2 * (int(found.allowed_failures) + 1)
            problem = died(sent.order, attempts, "and the worker of the cluster with it")
            return Ended(number, Answer(DIED, problem), attempts)
        self.workers.look()  # which raises an error if the scheduler is gone
        if found is None or self._attempts[number] < ATTEMPTS:
            waiting.append((number, sent.order))
            return None
        problem = f"{' and '.join(sent.order.files)}: no worker of the cluster can do it"
        return Ended(number, Answer(FAILED, f"{problem} ({' '.join(str(found).split())})"), ATTEMPTS)


class _Idle(NamedTuple):
    worker: Worker
    since: float


_idle: list[_Idle] = []
_lock = threading.Lock()


def identity() -> Identity:
    """Return the identity of this program: two programs with the same one make the same outputs."""
    return __version__, method()


def compute(expected: Identity, order: bytes) -> bytes | None:
    """Do a job whose order has the data, and return its answer and the attempts; None if this is another program."""
    if identity() != expected:
        return None
    return pickle.dumps(_done(pickle.loads(order)))


def _done(order: Order) -> tuple[Answer, int]:
    with _lock:
        worker = _idle.pop().worker if _idle else Worker()
    try:
        done = worker.do(order)
        assert done is not None, "nobody stops it"
        return done
    except CannotStart as error:
        return Answer(FAILED, str(error)), 1
    finally:
        with _lock:
            _idle.append(_Idle(worker, time.monotonic()))
        timer = threading.Timer(LONGEST_REST, _end_idle)
        timer.daemon = True
        timer.start()


def _end_idle() -> None:
    """End the processes that have had nothing to do for long."""
    last = time.monotonic() - LONGEST_REST
    with _lock:
        old = [each for each in _idle if each.since <= last]
        _idle[:] = [each for each in _idle if each.since > last]
    for each in old:
        each.worker.end()
