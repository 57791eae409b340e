"""How long the stages of a run take."""

from __future__ import annotations

from time import perf_counter
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable


class Clock:
    """Seconds by stage, in the order in which the stages were first left; `now` returns a time in seconds."""

    def __init__(self, now: Callable[[], float] = perf_counter) -> None:
        self.seconds: dict[str, float] = {}
        self._now = now
        self.began = self._last = now()

    def lap(self, stage: str) -> float:
        """Add the time since the last lap to a stage, and return it."""
        now = self._now()
        passed = now - self._last
        self.seconds[stage] = self.seconds.get(stage, 0.0) + passed
        self._last = now
        return passed
