"""What a command prints on standard error while it runs: notes, details, and a progress bar."""

from __future__ import annotations

import sys
import time
from typing import TYPE_CHECKING, Any

import click

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from shapeblend_cli.files import Run

PATIENCE = 1.0  # seconds before the bar shows
OFTEN, SELDOM = (
    10.0,
    60.0,
)  # seconds before the first line in a pipe or a file, and between further ones at most
UNITS = 1000


def say(text: str) -> None:
    """Print a line on standard error; that it is closed or full fails no run."""
    try:
        click.echo(f"shapeblend: {' '.join(text.split())}", err=True)
    except (OSError, ValueError):
        pass


class Terminal:
    """Standard error; a context that ends the progress bar. If `quiet`, only errors and warnings are printed."""

    def __init__(self, *, quiet: bool = False, now: Callable[[], float] = time.monotonic) -> None:
        self._quiet = quiet
        self._now = now
        self._began = now()
        self._bar: Any = None
        self._shown = 0
        self._next_line = OFTEN

    def __enter__(self) -> Terminal:
        return self

    def __exit__(self, *_error: object) -> None:
        if self._bar is not None:
            self._bar.render_finish()

    def note(self, text: str) -> None:
        """Print a line."""
        if not self._quiet:
            say(text)

    def warn(self, text: str) -> None:
        """Print a line even if quiet."""
        say(text)

    def progress(self, share: float) -> None:
        """Show the share of the work that is done, 0 to 1, if there is a terminal and the work takes long."""
        passed = self._now() - self._began
        if self._quiet or sys.stderr is None or passed < PATIENCE:
            return
        if not sys.stderr.isatty():
            if passed >= self._next_line:
                self._next_line = passed + min(passed, SELDOM)
                say(f"matching: {share:.0%} after {passed:.0f} s")
            return
        if self._bar is None:
            self._bar = click.progressbar(length=UNITS, label="matching", file=sys.stderr)
            self._bar.render_progress()
        units = max(int(share * UNITS), self._shown)
        self._bar.update(units - self._shown)
        self._shown = units


def details(run: Run) -> Iterator[str]:
    """Yield lines that say what was done in a run, and how long it took."""
    for c in (contour for pair in run.pairs for contour in pair.contours):
        found = c.correspondence
        if c.a is None or c.b is None:
            name = f"contour {c.a} of A" if c.b is None else f"contour {c.b} of B"
            change = "shrinks to" if c.b is None else "grows from"
            spot = (c.polygon_b if c.b is None else c.polygon_a).vertices[0]
            kind = "the point" if (c.end if c.b is None else c.start).is_point else "a line at"
            yield (
                f"{name} has no partner and goes where the edge goes that it lies on"
                if c.follows_edge
                else f"{name} {change} {kind} {spot.real:.6g},{spot.imag:.6g}"
            )
            continue
        proof = "proven least" if found.gap == 0.0 else f"lower bound {found.lower_bound:.6g}"
        yield (
            f"contour {c.a} of A ({len(c.polygon_a.vertices)} vertices) to contour {c.b} of B "
            f"({len(c.polygon_b.vertices)}): {len(found.dots)} dots, work {found.work:.6g} = stretching "
            f"{found.stretching:.6g} + bending {found.bending:.6g} + travel {found.travel:.6g}, {proof}, "
            f"{found.zero_angles} angles reach zero, {found.sweeps} sweeps"
        )
    for pair in run.pairs:
        shapes = pair.each_shape
        for number, shape in enumerate(shapes, 1):
            name = f"shape {number}: " if len(shapes) > 1 else ""
            if shape.is_matched:
                yield f"{name}motion {shape.motion_name}: {shape.reason}"
    yield f"{_count(len(run.measures), 'frame')}: {_crossings(run)}"
    yield ", ".join(f"{stage} {1000 * seconds:.1f} ms" for stage, seconds in run.seconds.items())


def _crossings(run: Run) -> str:
    """Say which frames cross themselves, and how often."""
    crossed = [frame for frame in run.measures if frame.self_crossings]
    if not crossed:
        return "none crosses itself"
    several = len(run.pairs) > 1
    times = ", ".join(f"{frame.t:.3g}" + f" of pair {frame.pair}" * several for frame in crossed)
    count = sum(frame.self_crossings for frame in crossed)
    return f"{_count(count, 'crossing')} in {len(crossed)} of them, at t = {times}"


def _count(count: int, what: str) -> str:
    return f"{count} {what}" if count == 1 else f"{count} {what}s"
