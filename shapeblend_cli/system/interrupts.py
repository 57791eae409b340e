"""Signals that ask a run to stop: Ctrl-C, what `kill` sends, a terminal that is closed, and the end of --timeout.

Python handles them between its instructions, and the kernels look for them. In other native code nothing does: there
the watchdog ends the process, as it does above the limit of memory.
"""

from __future__ import annotations

import os
import signal
import sys
import threading
from contextlib import contextmanager, suppress
from typing import TYPE_CHECKING, Any

from shapeblend_cli.errors import OptionError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from shapeblend_cli.system.watchdog import Watchdog

STOPS = [
    getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP", "SIGALRM") if hasattr(signal, name)
]


STOPPED, NOTHING = "interrupted", "nothing was written"


class Interrupted(BaseException):
    """A run was asked to stop. No Exception, so that nothing on the way takes it for something else."""

    def __init__(
        self, message: str, number: int, *, is_late: bool = False, has_written: bool = False
    ) -> None:
        super().__init__(message)
        self.number = number  # of the signal
        self.is_late = is_late  # by --timeout
        self.has_written = has_written  # all files


HAS_LIMITS = hasattr(signal, "setitimer")
"""Whether the system can limit the time and the memory of a run; Windows cannot."""


class _Run:
    """What the run that is listening has come to."""

    has_written = False
    seconds: float | None = None
    watchdog: Watchdog | None = None
    pipe: int | None = None  # in which signals wait to be handled


@contextmanager
def listening() -> Iterator[None]:
    """Raise `Interrupted` when a signal asks to stop, unless the process was started with that signal ignored."""
    _Run.has_written, _Run.seconds = False, None
    with _handling(_interrupt):
        try:
            yield
        finally:
            if HAS_LIMITS:
                signal.setitimer(signal.ITIMER_REAL, 0.0)
            _call_off()


def limit(seconds: float | None, megabytes: float | None, status: int = 1) -> None:
    """Have the run that is listening end after a time, or above a size of memory, then with an exit status."""
    if not HAS_LIMITS:
        for value, name in ((seconds, "--timeout"), (megabytes, "--max-memory")):
            if value is not None:
                raise OptionError(f"{name} is not available on this system")
    elif threading.current_thread() is threading.main_thread():
        _Run.seconds = seconds
        _watch(megabytes or 0.0, status)
        signal.setitimer(signal.ITIMER_REAL, seconds or 0.0)


def _watch(megabytes: float, status: int) -> None:
    """Start the watchdog."""
    from shapeblend_cli.system.watchdog import Watchdog

    _call_off()
    pipe, end = os.pipe()
    files = [pipe, end]
    for each in files:
        os.set_blocking(each, False)
    statm, unit = -1, 1 if sys.platform == "darwin" else 1024
    with suppress(OSError):
        statm, unit = os.open("/proc/self/statm", os.O_RDONLY), os.sysconf("SC_PAGE_SIZE")
        files.append(statm)
    watchdog = Watchdog(pipe, statm, unit, int(1e6 * megabytes))
    clear = "\r\x1b[K" if sys.stderr is not None and sys.stderr.isatty() else ""  # of how far the run was
    whys = STOPPED, late(_Run.seconds or 0.0), too_large(megabytes)
    stopped, stopped_late, full = (f"{clear}shapeblend: {why}; {NOTHING}\n".encode() for why in whys)

    def watch() -> None:
        watchdog.watch(stopped, stopped_late, full, status)
        for each in files:
            os.close(each)

    signal.set_wakeup_fd(end, warn_on_full_buffer=False)
    _Run.watchdog, _Run.pipe = watchdog, pipe
    threading.Thread(target=watch, daemon=True).start()


def _call_off() -> None:
    """Have the watchdog end."""
    if _Run.watchdog is not None:
        signal.set_wakeup_fd(-1)
        _Run.watchdog.is_over = True
        _Run.watchdog = _Run.pipe = None


def has_written() -> None:
    """Have `Interrupted` say from now on that all files were written."""
    _Run.has_written = True
    _call_off()


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
    if _Run.watchdog is not None:
        _Run.watchdog.is_held = True
    try:
        with _handling(lambda number, _: waiting.append(number)):
            yield
    finally:
        if _Run.watchdog is not None:
            _Run.watchdog.is_held = False
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

    def handle(number: int, frame: Any) -> None:
        if _Run.pipe is not None:
            with suppress(OSError):
                os.read(_Run.pipe, 4096)
        handler(number, frame)

    try:
        for number in STOPS:
            if signal.getsignal(number) not in (signal.SIG_IGN, None):
                before[number] = signal.signal(number, handle)
        yield
    finally:
        for number, old in before.items():
            signal.signal(number, old)


def _interrupt(number: int, _: object) -> None:
    is_late = _Run.seconds is not None and number == signal.SIGALRM
    what = late(_Run.seconds) if is_late and _Run.seconds else STOPPED
    stands = "all files were written" if _Run.has_written else NOTHING
    raise Interrupted(f"{what}; {stands}", number, is_late=is_late, has_written=_Run.has_written)


def late(seconds: float) -> str:
    """Say that a run was stopped after its time."""
    return f"stopped after {seconds:g} s (--timeout)"


def too_large(megabytes: float) -> str:
    """Say that a run was stopped for its memory."""
    return f"stopped at {megabytes:g} MB of memory (--max-memory)"
