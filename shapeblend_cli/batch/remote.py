"""What a worker of a cluster does: it has jobs done by processes of its own, one for each that it does at a time.

A job that ends its process, takes too long or fills the memory does that to such a process and not to the worker, and
a worker with several threads keeps several processors busy.
"""

from __future__ import annotations

import pickle
import threading
import time
from typing import NamedTuple

from shapeblend_cli.batch.records import method
from shapeblend_cli.batch.supervisor import CannotStart, Worker
from shapeblend_cli.batch.worker import FAILED, Answer, Order
from shapeblend_cli.version import __version__

PATIENCE = 60.0
"""Maximum idle time of a process, in seconds."""

Identity = tuple[str, str]
"""The version of a program, and a hash of it."""


class _Idle(NamedTuple):
    worker: Worker
    since: float


_idle: list[_Idle] = []
_lock = threading.Lock()


def identity() -> Identity:
    """Return what is the same where the same outputs are made."""
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
        timer = threading.Timer(PATIENCE, _end_idle)
        timer.daemon = True
        timer.start()


def _end_idle() -> None:
    """End the processes that have had nothing to do for long."""
    last = time.monotonic() - PATIENCE
    with _lock:
        old = [each for each in _idle if each.since <= last]
        _idle[:] = [each for each in _idle if each.since > last]
    for each in old:
        each.worker.end()
