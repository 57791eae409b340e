"""A process that does one order after another, so that a drawing on which it hangs or dies costs nothing but itself."""

from __future__ import annotations

import pickle
import subprocess
import sys
import threading
from contextlib import suppress
from pathlib import Path
from typing import Any

from shapeblend_cli.errors import ShapeblendError, in_words

START = "import sys; sys.path.append(sys.argv[1]); from shapeblend_cli.studio.process import main; main()"
"""What a process runs. The working folder is not searched for modules, so that no file there is taken for one."""

GRACE = 5
"""Seconds after its time in which a process that nobody stops ends by itself."""

READY, DONE, FAILED = "ready", "done", "failed"


class Failed(ShapeblendError):
    """An order that could not be done; the message says why."""


class Process:
    """A process that is started when it is needed, or before, and again after it ended."""

    def __init__(self) -> None:
        self._turn = threading.Lock()  # one order at a time
        self._change = threading.Lock()  # of the process
        self._process: subprocess.Popen[bytes] | None = None
        self._why = ""
        self._is_closed = False

    def warm_up(self) -> None:
        """Start the process, without waiting for it."""
        threading.Thread(target=self._prepare, daemon=True).start()

    def _prepare(self) -> None:
        with self._turn, suppress(Failed):
            self._started()

    def ask(self, order: Any, seconds: float) -> Any:
        """Have an order done, and return what comes of it.

        Raises
        ------
        Failed
            If it cannot be done, takes more than so many seconds, or is stopped.
        """
        with self._turn:
            process = self._started()
            self._why = ""
            late = f"it took more than {seconds:g} s, and was stopped; simpler drawings or --effort fast would work"
            timer = threading.Timer(seconds, self.stop, (late,))
            timer.daemon = True
            timer.start()
            try:
                assert process.stdin is not None
                pickle.dump((order, seconds), process.stdin)
                process.stdin.flush()
                answer = _received(process)
            except OSError:
                answer = None
            finally:
                timer.cancel()
            if answer is None:
                self._end()
                raise Failed(self._why or "the process that blends has died; it is started again")
            status, value = answer
            if status == FAILED:
                raise Failed(value)
            return value

    def stop(self, why: str) -> None:
        """End the process at once, whatever it does; the order that it was at fails for this reason."""
        with self._change:
            if self._process is not None:
                self._why = why
                self._process.kill()

    def close(self) -> None:
        """End the process for good."""
        self._is_closed = True
        self.stop("the studio has ended")
        with self._turn:
            self._end()

    def _started(self) -> subprocess.Popen[bytes]:
        with self._change:
            if self._is_closed:
                raise Failed("the studio has ended")
            if self._process is not None and self._process.poll() is None:
                return self._process
            self._process = process = _start()
        if _received(process) != READY:
            self._end()
            raise Failed(self._why or "the process that blends does not start")
        return process

    def _end(self) -> None:
        with self._change:
            process, self._process = self._process, None
        if process is not None:
            process.kill()
            for stream in (process.stdin, process.stdout):
                if stream is not None:
                    with suppress(OSError):
                        stream.close()
            process.wait()


def _start() -> subprocess.Popen[bytes]:
    folder = str(Path(__file__).parents[2])
    return subprocess.Popen(
        [sys.executable, "-P", "-c", START, folder],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        start_new_session=True,  # so that Ctrl-C is for the studio alone, which ends it
    )


def _received(process: subprocess.Popen[bytes]) -> Any:
    """Return what a process sends; None if it is gone."""
    assert process.stdout is not None
    try:
        return pickle.load(process.stdout)
    except (EOFError, OSError, ValueError, pickle.UnpicklingError):
        return None


def main() -> None:
    """Do orders from standard input until it ends, and answer by standard output."""
    import gc
    import os
    import signal
    import warnings

    warnings.simplefilter("ignore")
    orders, answers = os.fdopen(os.dup(0), "rb"), os.fdopen(os.dup(1), "wb")
    # Nothing that a library reads or prints must get between them.
    nothing = os.open(os.devnull, os.O_RDWR)
    for number in (0, 1):
        os.dup2(nothing, number)

    from shapeblend_cli.studio.work import do

    gc.freeze()

    def send(value: Any) -> None:
        pickle.dump(value, answers)
        answers.flush()

    send(READY)
    with suppress(EOFError, BrokenPipeError):
        while True:
            order, seconds = pickle.load(orders)
            if hasattr(signal, "alarm"):
                signal.alarm(int(seconds) + GRACE)  # even if whoever asked is gone
            try:
                answer = DONE, do(order)
            except Exception as error:
                answer = FAILED, in_words(error)
            send(answer)
    os._exit(0)
