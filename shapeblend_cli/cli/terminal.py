"""Notes, details and progress on standard error while a command runs."""

from __future__ import annotations

import os
import sys
import threading
import time
from contextlib import suppress
from typing import TYPE_CHECKING, Self

import click

from shapeblend_cli.options import types
from shapeblend_cli.options.fields import Record, option
from shapeblend_cli.options.settings import OTHER

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from shapeblend_cli.job.job import Job
    from shapeblend_cli.job.make import Run
    from shapeblend_cli.outputs.formats import OutputSpec

PATIENCE = 1.0  # seconds before a terminal shows how far a run is, and between two looks
OFTEN, SELDOM = (
    10.0,
    60.0,
)  # seconds before the first line in a pipe or a file, and between further ones at most
NOTHING = "wrote nothing: --frames 0 asks for no in-betweens; --ends would write the drawings"
BAR = 30  # characters of the bar that shows how far a batch is
CLEAR = "\r\x1b[K"


ONLY_ERRORS = "Print only errors."
"""Help of --quiet for commands that write no frames."""


class TerminalOptions(Record, section=OTHER):
    """How much a command prints."""

    quiet: bool = option(
        types.FLAG,
        default=False,
        flags=("-q", "--quiet"),
        help="Print only errors, and a line if frame files of another run remain.",
    )
    verbose: bool = option(
        types.FLAG,
        default=False,
        flags=("-v", "--verbose"),
        help="Print what was done, and how long it took.",
    )


def say(text: str) -> None:
    """Print a line on standard error; that it is closed or full fails no run."""
    _write(f"shapeblend: {' '.join(text.split())}\n")


def _write(text: str) -> None:
    with suppress(OSError, ValueError):
        click.echo(text, err=True, nl=False)


class Terminal:
    """Standard error; a context in which it is told now and then how far a run is, and for how long it has been at it.

    It shows the stage and the share of it that is done; the seconds are those of the run. If `quiet`, only errors and
    warnings are printed.
    """

    def __init__(self, *, quiet: bool = False) -> None:
        self._quiet = quiet
        self._stage, self._shares = "", {"": 0.0}  # of each stage so far
        self._is_shown = False
        self._is_done = threading.Event()
        self._turn = threading.Lock()  # to print: a line comes between a clearing and the next tick
        self._ticks = threading.Thread(target=self._tick, daemon=True)

    def __enter__(self) -> Self:
        if not self._quiet and sys.stderr is not None:
            self._ticks.start()
        return self

    def __exit__(self, *_error: object) -> None:
        self._is_done.set()
        if self._ticks.is_alive():
            self._ticks.join()
        self._clear()

    def note(self, text: str) -> None:
        """Print a line."""
        if not self._quiet:
            self.warn(text)

    def warn(self, text: str) -> None:
        """Print a line even if quiet."""
        with self._turn:
            self._clear()
            say(text)

    def progress(self, stage: str, share: float) -> None:
        """Take the name of a stage, and the share of it that is done, 0 to 1."""
        self._shares[stage] = max(self._shares.get(stage, 0.0), share)
        self._stage = stage

    def _tick(self) -> None:
        """Say how far the run is until it is done."""
        began = time.monotonic()
        is_terminal = sys.stderr.isatty()
        wait = PATIENCE if is_terminal else OFTEN
        while not self._is_done.wait(wait):
            passed = time.monotonic() - began
            text = self._state()
            if is_terminal:
                with self._turn:
                    _write(f"{CLEAR}{text}, {passed:.0f} s")
                    self._is_shown = True
            else:
                say(f"{text}, {passed:.0f} s")
                wait = min(passed, SELDOM)

    def _state(self) -> str:
        percent = min(int(100 * self._shares[self._stage]), 99)  # all of it would be the next stage
        return f"{self._stage or 'starting'} {percent}%" if percent else self._stage or "starting"

    def _clear(self) -> None:
        if self._is_shown:
            self._is_shown = False
            _write(CLEAR)


class Pace:
    """How long the rest of many jobs takes, judged by those that have ended, where these are alike enough to say."""

    ENOUGH = 20  # jobs
    SURE = (
        0.1  # how uncertain their mean may be, as a share of it: a third of what an estimate may be wrong by
    )

    def __init__(self, now: Callable[[], float] = time.monotonic) -> None:
        self._now = now
        self._began = now()
        self._count = 0
        self._sum = self._squares = 0.0

    def ended(self, seconds: float) -> None:
        """Take how long a job took by itself."""
        self._count += 1
        self._sum += seconds
        self._squares += seconds * seconds

    def left(self, jobs: int) -> float | None:
        """Return the time of further jobs, in seconds; None where it cannot be estimated."""
        n = self._count
        if n < self.ENOUGH or not self._sum:
            return None
        mean = self._sum / n
        variance = max(self._squares / n - mean * mean, 0.0)
        if (variance / n) ** 0.5 > self.SURE * mean:
            return None
        return jobs * (self._now() - self._began) / n


class BatchTerminal(Terminal):
    """Standard error while a batch runs; it is told which jobs have ended. A log gets all lines."""

    def __init__(
        self, count: int, log: Callable[[str], None] = lambda text: None, *, quiet: bool = False
    ) -> None:
        super().__init__(quiet=quiet)
        self._log = log
        self._count = count
        self._ended = 0
        self._failed = 0
        self._pace = Pace()

    def note(self, text: str) -> None:
        """Print a line."""
        if self._quiet:
            self._log(text)
        super().note(text)

    def warn(self, text: str) -> None:
        """Print a line even if quiet."""
        self._log(text)
        super().warn(text)

    def ended(self, is_done: bool, seconds: float | None) -> None:
        """Take that a job has ended, and how long it took; None if there was nothing to do."""
        self._ended += 1
        self._failed += not is_done
        if seconds is not None:
            self._pace.ended(seconds)

    def _state(self) -> str:
        share = self._ended / max(self._count, 1)
        bar = "#" * int(BAR * share)
        failed = f", {self._failed} failed" if self._failed else ""
        drawn = f"[{bar:-<{BAR}}] " if sys.stderr.isatty() else ""
        left = self._pace.left(self._count - self._ended)
        rest = f", about {_duration(left)} left" if left else ""
        return f"{drawn}{self._ended} of {_count(self._count, 'job')}{failed}{rest}"


def _duration(seconds: float) -> str:
    """Say how long, as exactly as an estimate is."""
    for unit, size in (("h", 3600.0), ("min", 60.0)):
        if seconds >= 2.0 * size:
            return f"{seconds / size:.0f} {unit}"
    return f"{max(seconds, 1.0):.0f} s"


def results(job: Job, seconds: float) -> Iterator[str]:
    """Yield what a run has written, and what shows it."""
    output, files = job.output, job.output.files()
    others = [name for name in (job.write.report, job.write.tries) if name is not None]
    took = f"in {seconds:.1f} s"
    if not files:
        if not (job.write.preview or others or output.path == "-"):
            yield NOTHING
    elif output.format.has_frame_files:
        which = files[0] if len(files) == 1 else f"{files[0]} to {os.path.basename(files[-1])}"
        yield f"wrote {_count(len(files), 'frame')}, {which}, {took}"
    elif output.format.suffix:
        size = os.path.getsize(output.path) / 1000.0
        shown = "; a browser plays it" if output.format.takes_triggers else ""
        yield f"wrote {output.path}, {output.format.help}, {_length(output)}{size:.3g} kB, {took}{shown}"
    else:
        yield f"wrote {' and '.join(files)}, {took}"
    if job.write.preview:
        yield f"wrote {job.write.preview}; a browser shows it"
    if named := [str(name) for name in others if name != "-"]:
        yield f"wrote {' and '.join(named)}"


def _length(output: OutputSpec) -> str:
    """Say how long a run of an animation is; there and back if it plays so."""
    if not output.format.plays or output.settings.mix:
        return ""
    seconds = output.timing.seconds * output.timing.length(output.drawings - 1)
    return f"{_duration(seconds) if seconds >= 120.0 else f'{seconds:.3g} s'} long, "


def details(run: Run, began: float | None) -> Iterator[str]:
    """Yield the details of a run and its times, with the start of its process if that `began` for it."""
    shapes = [shape for pair in run.pairs for shape in pair.each_shape]
    for c, reason in ((c, shape.reason) for shape in shapes for c in shape.contours):
        found = c.correspondence
        if c.a is None or c.b is None:
            name = f"contour {c.a} of A" if c.b is None else f"contour {c.b} of B"
            change = "shrinks to" if c.b is None else "grows from"
            spot = (c.polygon_b if c.b is None else c.polygon_a).vertices[0]
            kind = "the point" if (c.end if c.b is None else c.start).is_point else "a line at"
            yield (
                f"{name} has no partner and {reason.removeprefix('it ')}"
                if c.follows_edge
                else f"{name} {change} {kind} {spot.real:.6g},{spot.imag:.6g}"
            )
            continue
        terms = " + ".join(f"{name} {work:.6g}" for name, work in found.terms._asdict().items())
        proof = "proven least" if found.gap == 0.0 else f"lower bound {found.lower_bound:.6g}"
        yield (
            f"contour {c.a} of A ({len(c.polygon_a.vertices)} vertices) to contour {c.b} of B "
            f"({len(c.polygon_b.vertices)}): {len(found.dots)} dots, work {found.work:.6g} = {terms}, {proof}, "
            f"{found.zero_angles} angles reach zero, {found.sweeps} sweeps"
        )
    for pair in run.pairs:
        shapes = pair.each_shape
        for number, shape in enumerate(shapes, 1):
            name = f"shape {number}: " if len(shapes) > 1 else ""
            if shape.is_matched:
                yield f"{name}motion {shape.motion_name}: {shape.reason}"
    yield f"{_count(len(run.measures), 'frame')}: {_crossings(run)}"
    start = {} if began is None else {"start": run.clock.began - began}
    seconds = start | run.clock.seconds
    yield ", ".join(f"{stage} {1000 * taken:.1f} ms" for stage, taken in seconds.items())


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
