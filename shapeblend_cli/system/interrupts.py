"""Signals that ask a run to stop: Ctrl-C, what `kill` sends, a terminal that is closed, and the end of --timeout."""

from __future__ import annotations

import signal
import threading
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from shapeblend_cli.errors import OptionError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

STOPS = [
    getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP", "SIGALRM") if hasattr(signal, name)
]


class Interrupted(BaseException):
    """A run was asked to stop. No Exception, so that nothing on the way takes it for something else."""

    def __init__(
        self, message: str, number: int, *, is_late: bool = False, has_written: bool = False
    ) -> None:
        super().__init__(message)
        self.number = number  # of the signal
        self.is_late = is_late  # by --timeout
        self.has_written = has_written  # all files


class _Run:
    """What the run that is listening has come to."""

    has_written = False
    seconds: float | None = None


@contextmanager
def listening() -> Iterator[None]:
    """Raise `Interrupted` when a signal asks to stop, unless the process was started with that signal ignored."""
    _Run.has_written, _Run.seconds = False, None
    with _handling(_interrupt):
        try:
            yield
        finally:
            if hasattr(signal, "setitimer"):
                signal.setitimer(signal.ITIMER_REAL, 0.0)


def stop_after(seconds: float | None) -> None:
    """Have the run that is listening interrupted after a number of seconds."""
    if seconds is None:
        return
    if not hasattr(signal, "setitimer"):
        raise OptionError("--timeout is not available on this system")
    _Run.seconds = seconds
    signal.setitimer(signal.ITIMER_REAL, seconds)


def has_written() -> None:
    """Have `Interrupted` say from now on that all files were written."""
    _Run.has_written = True


@contextmanager
def told(handler: Callable[[int], None]) -> Iterator[None]:
    """Have a handler told the numbers of signals that ask to stop, instead of raising `Interrupted`."""
    with _handling(lambda number, _: handler(number)):
        yield


@contextmanager
def uninterrupted() -> Iterator[None]:
    """Let signals wait until the block is done."""
    waiting: list[int] = []
    before = {number: signal.getsignal(number) for number in STOPS}
    try:
        with _handling(lambda number, _: waiting.append(number)):
            yield
    finally:
        for number in waiting:
            handler = before[number]
            if callable(handler):
                handler(number, None)


@contextmanager
def _handling(handler: Any) -> Iterator[None]:
    """Have signals handled so for a while; only the main thread can."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    before: dict[int, Any] = {}
    try:
        for number in STOPS:
            if signal.getsignal(number) not in (signal.SIG_IGN, None):
                before[number] = signal.signal(number, handler)
        yield
    finally:
        for number, old in before.items():
            signal.signal(number, old)


def _interrupt(number: int, _: object) -> None:
    is_late = _Run.seconds is not None and number == signal.SIGALRM
    what = f"stopped after {_Run.seconds:g} s (--timeout)" if is_late else "interrupted"
    stands = "all files were written" if _Run.has_written else "nothing was written"
    raise Interrupted(f"{what}; {stands}", number, is_late=is_late, has_written=_Run.has_written)
