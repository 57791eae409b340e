# cython: boundscheck=False, wraparound=False
"""A thread that ends the process where the interpreter cannot: in a long call of native code, or for want of memory.

Python handles signals between its own instructions, and drawing a large picture is one of them. This file is compiled
by Cython, so that the thread does without the interpreter. It runs uncompiled as well, where it waits for its turn.
Windows has neither the signals nor the calls.
"""

from __future__ import annotations

try:
    import cython
except ImportError:  # Cython is needed to build, not to run
    from shapeblend_cli import _cython as cython

if cython.compiled:
    from cython.cimports.libc import signal
    from cython.cimports.libc.time import CLOCKS_PER_SEC, clock
    from cython.cimports.posix import resource, select, time, unistd
else:
    import os
    import resource
    import select
    import signal
    import time

COMPILED = cython.compiled

PAUSE = cython.declare(cython.int, 20_000)
"""Time between two looks, in microseconds: a process can fill some tens of megabytes in it."""

PATIENCE = cython.declare(cython.double, 0.5)
"""Maximum time of the processor that a signal may go unhandled, in seconds.

A process that waits for a processor cannot handle signals, so time on the wall says nothing.
"""

LONG_PATIENCE = cython.declare(cython.int, 500)
"""Maximum number of looks in a row that find a signal unhandled: 10 s, of a process that waits for something else."""


@cython.cclass
class Watchdog:
    """What the thread looks at.

    Parameters
    ----------
    pipe : int
        The end for reading of a pipe into which signals write their numbers. Who handles signals empties it.
    statm : int
        The open file in which Linux says how many pages of memory the process has; -1 elsewhere.
    unit : int
        Bytes in a page; elsewhere, in the unit in which the system says how much memory was used.
    most : int
        Maximum memory, in bytes; 0 for any.

    Attributes
    ----------
    is_held : bool
        Whether the process must not be ended now.
    is_over : bool
        Whether there is nothing to watch any more.
    """

    pipe: cython.int
    statm: cython.int
    unit: cython.longlong
    most: cython.longlong
    is_held = cython.declare(cython.bint, visibility="public")
    is_over = cython.declare(cython.bint, visibility="public")

    def __init__(self, pipe: int, statm: int, unit: int, most: int) -> None:
        self.pipe, self.statm, self.unit, self.most = pipe, statm, unit, most
        self.is_held = self.is_over = False

    def watch(self, stopped: bytes, late: bytes, full: bytes, status: int) -> None:
        """Look until it is over, or end the process.

        Parameters
        ----------
        stopped, late, full : bytes
            What standard error is told if a signal is not handled, or SIGALRM is not, or memory is above its maximum.
        status : int
            Exit status in the last case. In the first it is that of a shell, and in the second 1.
        """
        texts: tuple[cython.p_char, cython.p_char, cython.p_char] = (stopped, late, full)
        lengths: tuple[cython.int, cython.int, cython.int] = (len(stopped), len(late), len(full))
        full_status: cython.int = status
        unhandled: cython.int = 0
        since: cython.double = _seconds()
        number: cython.int = 0
        with cython.nogil:
            while not self.is_over:
                _pause()
                if self.is_over or self.is_held:
                    continue
                if self.most > 0 and _memory(self.statm, self.unit) > self.most:
                    _end(texts[2], lengths[2], full_status)
                if not _has_signal(self.pipe):
                    unhandled, since = 0, _seconds()
                    continue
                unhandled += 1
                if unhandled > LONG_PATIENCE or _seconds() - since > PATIENCE:
                    number = _signal(self.pipe)
                    if number == signal.SIGALRM:
                        _end(texts[1], lengths[1], 1)
                    _end(texts[0], lengths[0], 128 + number)


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def _has_signal(pipe: cython.int) -> cython.bint:
    """Return whether there is a signal that nobody has handled."""
    if cython.compiled:
        pipes = cython.declare(select.fd_set)
        no_time = cython.declare(time.timeval)
        no_time.tv_sec = no_time.tv_usec = 0
        select.FD_ZERO(cython.address(pipes))
        select.FD_SET(pipe, cython.address(pipes))
        found: cython.int = select.select(
            pipe + 1, cython.address(pipes), cython.NULL, cython.NULL, cython.address(no_time)
        )
        return found > 0
    else:
        return bool(select.select([pipe], [], [], 0.0)[0])


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def _seconds() -> cython.double:
    """Return the time of the processor that the process has taken, in seconds."""
    if cython.compiled:
        ticks: cython.double = clock()
        return ticks / CLOCKS_PER_SEC
    else:
        return time.process_time()


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def _signal(pipe: cython.int) -> cython.int:
    """Return the number of the first signal that nobody has handled."""
    if cython.compiled:
        number = cython.declare(cython.char[1])
        return number[0] if unistd.read(pipe, number, 1) == 1 else 0
    else:
        return os.read(pipe, 1)[0]


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def _memory(statm: cython.int, unit: cython.longlong) -> cython.longlong:
    """Return how many bytes of memory the process has now; where the system does not say so, has had at most."""
    if cython.compiled:
        if statm < 0:
            used = cython.declare(resource.rusage)
            resource.getrusage(resource.RUSAGE_SELF, cython.address(used))
            return used.ru_maxrss * unit
        text = cython.declare(cython.char[64])
        count: cython.Py_ssize_t = unistd.pread(statm, text, 64, 0)
        k: cython.Py_ssize_t = 0
        while k < count and text[k] != 32:  # the first number is that of addresses
            k += 1
        k += 1
        pages: cython.longlong = 0
        while k < count and 48 <= text[k] <= 57:
            pages = 10 * pages + text[k] - 48
            k += 1
        return pages * unit
    else:
        if statm < 0:
            return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * unit
        return int(os.pread(statm, 64, 0).split()[1]) * unit


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def _pause() -> cython.void:
    if cython.compiled:
        unistd.usleep(PAUSE)
    else:
        time.sleep(1e-6 * PAUSE)


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def _end(text: cython.p_char, length: cython.Py_ssize_t, status: cython.int) -> cython.void:
    """End the process at once, after a line on standard error."""
    if cython.compiled:
        unistd.write(2, text, length)
        unistd._exit(status)
    else:
        os.write(2, text)
        os._exit(status)
