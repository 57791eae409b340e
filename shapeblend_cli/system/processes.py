"""Processes that do one order after another, as they are asked by standard input, and answer by standard output.

Both carry pickles. A module that such a process runs has a `main`, which takes orders from its `Parent`.
"""

from __future__ import annotations

import gc
import os
import pickle
import signal
import subprocess
import sys
import threading
import time
import warnings
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from queue import SimpleQueue
from typing import Any, BinaryIO

READY = "ready"

MEGABYTES = 2000.0
"""Memory limit of a process without --max-memory, in megabytes: four times what nearly all drawings take."""

TOO_LARGE = 75
"""Exit status of a process above its memory limit."""

GRACE = 1.0
"""Seconds in which a process that is at work when its parent has died may end by itself."""

START = (
    "import sys; sys.path.append(sys.argv[1]); import importlib; importlib.import_module(sys.argv[2]).main()"
)
"""Program of a process. The working folder is not searched for modules, so that no file there is taken for one."""


class Child:
    """A process that runs a module, as its parent sees it."""

    def __init__(self, module: str) -> None:
        folder = str(Path(__file__).parents[2])
        self._process = subprocess.Popen(
            [sys.executable, "-P", "-c", START, folder, module],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            start_new_session=True,  # so that Ctrl-C is for its parent alone
            env={"OPENBLAS_NUM_THREADS": "1"} | os.environ,  # as of a command
        )
        self.kill, self.terminate = self._process.kill, self._process.terminate

    @property
    def is_running(self) -> bool:
        """Whether it has not ended."""
        return self._process.poll() is None

    def becomes_ready(self) -> bool:
        """Wait until it has loaded all that it needs; return whether it has, and not ended instead."""
        return bool(self._received() == READY)

    def ask(self, order: Any) -> Any:
        """Have an order done, and return the answer; None if the process is gone."""
        assert self._process.stdin is not None
        try:
            pickle.dump(order, self._process.stdin)
            self._process.stdin.flush()
        except OSError:
            return None
        return self._received()

    def end(self) -> int:
        """Have it end, as there are no further orders; wait for that, and return its status."""
        for stream in (self._process.stdin, self._process.stdout):
            if stream is not None:
                with suppress(OSError):
                    stream.close()
        return self._process.wait()

    def _received(self) -> Any:
        """Return what the process sends; None if it is gone."""
        assert self._process.stdout is not None
        try:
            return pickle.load(self._process.stdout)
        except (EOFError, OSError, ValueError, pickle.UnpicklingError):
            return None


class Parent:
    """The parent of this process. When the parent is gone the process ends, even in the middle of an order."""

    def __init__(self) -> None:
        warnings.simplefilter("ignore")
        self._answers = os.fdopen(os.dup(1), "wb")
        self._orders: SimpleQueue[tuple[Any, ...]] = SimpleQueue()
        self._is_at_work = True
        threading.Thread(target=self._receive, args=(os.fdopen(os.dup(0), "rb"),), daemon=True).start()
        # Nothing that a library reads or prints must get between them.
        nothing = os.open(os.devnull, os.O_RDWR)
        for number in (0, 1):
            os.dup2(nothing, number)

    def orders(self) -> Iterator[Any]:
        """Yield orders until there are no more; all that is slow to load is loaded before."""
        gc.freeze()
        self.answer(READY)
        while received := self._orders.get():
            yield from received

    def answer(self, value: Any) -> None:
        """Send the answer to an order."""
        self._is_at_work = False
        pickle.dump(value, self._answers)
        self._answers.flush()

    def _receive(self, stream: BinaryIO) -> None:
        """Receive orders. That there are no more while one is being done says that the parent has died."""
        with suppress(Exception):  # after what cannot be read nothing else can
            while True:
                order = pickle.load(stream)
                self._is_at_work = True
                self._orders.put((order,))
        self._orders.put(())
        if self._is_at_work:
            os.kill(os.getpid(), signal.SIGTERM)
            time.sleep(GRACE)
            os._exit(1)
