"""Waiting until files change."""

from __future__ import annotations

import os
import threading
from collections.abc import Callable, Hashable, Iterable

from shapeblend_cli.system.interrupts import told

EVERY = 0.5
"""Time between two looks at the files, in seconds."""

SETTLED = 0.2
"""Time for which changed files must stay as they are before they are read, in seconds."""


def stamps(files: Iterable[str]) -> Hashable:
    """Return what tells files from themselves once they are edited, replaced, or gone."""
    return frozenset((file, _stamp(file)) for file in files)


def _stamp(file: str) -> tuple[int, ...]:
    try:
        found = os.stat(file)
    except (OSError, ValueError):
        return ()
    return found.st_mtime_ns, found.st_size, found.st_ino


def wait_for_change(look: Callable[[], Hashable], seen: Hashable) -> int:
    """Wait until a look gives something else than what was seen, and return 0; or the number of a signal to stop."""
    stop = threading.Event()
    numbers: list[int] = []

    def note(number: int) -> None:
        numbers.append(number)
        stop.set()

    with told(note):
        while not stop.wait(EVERY):
            if look() != seen:
                now = look()
                while not stop.wait(SETTLED) and (later := look()) != now:
                    now = later
                break
    return numbers[0] if numbers else 0
