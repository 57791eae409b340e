"""A process that does one order after another, so that a drawing on which it hangs or dies costs nothing but itself."""

from __future__ import annotations

import os
import threading
from contextlib import suppress
from typing import Any

from shapeblend_cli.errors import ShapeblendError, in_words
from shapeblend_cli.system.interrupts import HAS_LIMITS, limit, listening
from shapeblend_cli.system.processes import GRACE, TOO_LARGE, Child, Parent

DONE, FAILED = "done", "failed"

REMEDY = "and was stopped; simpler drawings or --effort fast would work"


class Failed(ShapeblendError):
    """An order that could not be done; the message says why."""


class Process:
    """A process that is started when it is needed, or before, and again after it ended."""

    def __init__(self) -> None:
        self._turn = threading.Lock()  # one order at a time
        self._change = threading.Lock()  # of the process
        self._process: Child | None = None
        self._why = ""
        self._is_closed = False

    def warm_up(self) -> None:
        """Start the process, without waiting for it."""
        threading.Thread(target=self._prepare, daemon=True).start()

    def _prepare(self) -> None:
        with self._turn, suppress(Failed):
            self._started()

    def ask(self, order: Any, seconds: float, megabytes: float) -> Any:
        """Have an order done, and return what comes of it.

        Raises
        ------
        Failed
            If it cannot be done, takes more time or memory than that, or is stopped.
        """
        with self._turn:
            process = self._started()
            self._why = ""
            late = f"it took more than {seconds:g} s, {REMEDY}"
            timer = threading.Timer(seconds, self.stop, (late,))
            timer.daemon = True
            timer.start()
            try:
                answer = process.ask((order, seconds, megabytes))
            finally:
                timer.cancel()
            if answer is None:
                if self._end() == TOO_LARGE:
                    self._why = f"it took more than {megabytes:g} MB of memory, {REMEDY}"
                raise Failed(self._why or "the process that blends has died; it is started again")
            status, value = answer
            if status == FAILED:
                raise Failed(value)
            return value

    def stop(self, why: str) -> None:
        """End the process at once; its present order fails for this reason."""
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

    def _started(self) -> Child:
        with self._change:
            if self._is_closed:
                raise Failed("the studio has ended")
            if self._process is not None:
                if self._process.is_running:
                    return self._process
                self._process.end()
            self._process = process = Child(__name__)
        if not process.becomes_ready():
            self._end()
            raise Failed(self._why or "the process that blends does not start")
        return process

    def _end(self) -> int:
        """End the process, if there is one, and return its status."""
        with self._change:
            process, self._process = self._process, None
        if process is None:
            return 0
        process.kill()
        return process.end()


def main() -> None:
    """Do orders until there are no more."""
    parent = Parent()
    from shapeblend_cli.studio.answers import do

    for order, seconds, megabytes in parent.orders():
        try:
            with listening():
                if HAS_LIMITS:
                    limit(seconds + GRACE, megabytes, TOO_LARGE)
                answer = DONE, do(order)
        except Exception as error:
            answer = FAILED, in_words(error)
        parent.answer(answer)
    os._exit(0)
