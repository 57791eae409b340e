"""A progress bar for runs that take more than a second, on a terminal."""

from __future__ import annotations

import sys
import time
from typing import Any

import click

PATIENCE = 1.0
"""Seconds before the bar shows."""

UNITS = 1000


class Progress:
    """A context in which `show` may be called with the share that is done, from 0 to 1."""

    def __init__(self, quiet: bool) -> None:
        self._wanted = not quiet and sys.stderr.isatty()
        self._began = time.monotonic()
        self._bar: Any = None
        self._shown = 0

    def __enter__(self) -> Progress:
        return self

    def __exit__(self, *_error: object) -> None:
        if self._bar is not None:
            self._bar.render_finish()

    def show(self, share: float) -> None:
        """Show how far the run is."""
        if not self._wanted or time.monotonic() - self._began < PATIENCE:
            return
        if self._bar is None:
            self._bar = click.progressbar(length=UNITS, label="matching", file=sys.stderr)
            self._bar.render_progress()
        units = max(int(share * UNITS), self._shown)
        self._bar.update(units - self._shown)
        self._shown = units
