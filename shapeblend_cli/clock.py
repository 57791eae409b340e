"""How long the stages of a run take."""

from __future__ import annotations

import time


class Clock:
    """Seconds by stage, in the order in which the stages were first left."""

    def __init__(self) -> None:
        self.seconds: dict[str, float] = {}
        self._last = time.perf_counter()

    def lap(self, stage: str) -> float:
        """Add the time since the last lap to a stage, and return it."""
        now = time.perf_counter()
        passed = now - self._last
        self.seconds[stage] = self.seconds.get(stage, 0.0) + passed
        self._last = now
        return passed
