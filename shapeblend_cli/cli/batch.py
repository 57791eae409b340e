"""``shapeblend batch``."""

from __future__ import annotations

import os
import shlex
from collections import Counter
from collections.abc import Callable, Hashable, Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import click

from shapeblend_cli.batch.options import BatchOptions
from shapeblend_cli.cli.group import SectionedCommand
from shapeblend_cli.cli.parameters import NAME, options_of
from shapeblend_cli.cli.terminal import BatchTerminal, TerminalOptions, say
from shapeblend_cli.errors import OptionError, ShapeblendError
from shapeblend_cli.job.job import RECORDS, STANDARD_INPUT
from shapeblend_cli.job.options import REPORT_TO_FILE
from shapeblend_cli.system.interrupts import Interrupted

if TYPE_CHECKING:
    from shapeblend_cli.batch.aside import Aside
    from shapeblend_cli.batch.plan import Task
    from shapeblend_cli.batch.records import State
    from shapeblend_cli.batch.run import Outcome, Run
    from shapeblend_cli.rows.row import Row
    from shapeblend_cli.rows.sources import Found

FAILED = 1

PATTERN = "blend/{a}-{b}"
"""Default of --output, without a suffix."""

PATTERN_OF_PAIRS = "blend/{a}"
"""Default of --output with --pairs, without a suffix."""

EXAMPLES = (
    ("shapeblend batch --chain icons -o 'moving/{a}-{b}.svg'", "an animation from each icon to the next"),
    ("shapeblend batch --pairs off on -o 'moving/{a}.svg'", "off/wifi.svg into on/wifi.svg, and so on"),
    ("shapeblend batch --all icons -o 'moving/{a}-{b}.json' --emit lottie", "every two icons"),
    ("shapeblend batch jobs.csv", "one job a line, with a,b,o,duration ... in the first line"),
)

_HELPS = {
    "output": "What each job writes: a folder of frames, an animated .svg and so on, by the end of the name, as for a "
    "single blend. {a} and {b} stand for the names of the drawings, and {n} for the number of the job.  [default: "
    f"{PATTERN}]",
    "report": REPORT_TO_FILE,
    "force": "Do every job, and replace files even if no batch has written them, or if they were edited since.",
    "timeout": "Stop a job after S seconds; the files it was to write stay as they were.  [default: 300]",
    "max_memory": "Stop a job that takes more than MB megabytes of memory; the files it was to write stay as they "
    "were.  [default: 2000]",
}


@click.command(
    cls=SectionedCommand,
    examples=EXAMPLES,
    params=options_of(BatchOptions, *RECORDS, TerminalOptions, helps=_HELPS),
)
@click.argument("names", type=NAME, nargs=-1, metavar="[JOBS.jsonl|JOBS.csv|JOBS.toml|-]")
def batch(names: tuple[str, ...], **given: Any) -> int:
    """Make many blends at once, skipping those that are up to date.

    The jobs come from a manifest, one a line, or from --pairs, --chain or --all. Options apply to all jobs that do not
    have their own. A batch that is run again does what is missing or out of date, and nothing else. It uses all
    processors.
    """
    options, printed = BatchOptions.of(given), TerminalOptions.of(given)
    if printed.quiet and printed.verbose:
        raise click.UsageError("--quiet and --verbose contradict each other")
    if options.cluster is not None and options.jobs is not None:
        raise click.UsageError(
            "--jobs is for processes on this machine; a cluster has the workers that were started"
        )
    if options.fail_fast and options.keep_going > 1:
        raise click.UsageError("--fail-fast is --keep-going 1; one of the two would work")
    if options.clean and (options.shard is not None or STANDARD_INPUT in names):
        raise click.UsageError("--clean goes with a whole batch, of a manifest that is a file or of folders")
    if options.watch and (options.dry_run or STANDARD_INPUT in names):
        raise click.UsageError(
            "--watch goes with a manifest that is a file, or with folders, and not with --dry-run"
        )
    return (_watch if options.watch else _batch)(names, options, printed, given)


def _batch(
    names: tuple[str, ...], options: BatchOptions, printed: TerminalOptions, given: Mapping[str, Any]
) -> int:
    from shapeblend_cli.batch.aside import Aside
    from shapeblend_cli.batch.run import states

    tasks, notes = _tasks(names, options, given)
    if options.dry_run:
        for note in () if printed.quiet else notes:
            say(note)
        _show(tasks, states(tasks), options)
        return 0
    return _do(tasks, notes, Aside(options, " ".join(_source(names, options))), options, printed)


def _watch(
    names: tuple[str, ...], options: BatchOptions, printed: TerminalOptions, given: Mapping[str, Any]
) -> int:
    """Do a batch, and again what changes, until a signal asks to stop."""
    from shapeblend_cli.batch.aside import Aside
    from shapeblend_cli.system.watch import stamps, wait_for_change

    tasks, notes = _tasks(names, options, given)
    aside = Aside(options, " ".join(_source(names, options)))

    def look() -> Hashable:
        """Return the stamps of the drawings at hand, or of the last tasks' drawings, and of the manifest."""
        try:
            found = _found(names, options)
        except (OptionError, click.UsageError) as error:
            return str(error)
        rows: Sequence[Row | Task] = found.rows if found else tasks
        return stamps({file for row in rows for file in row.files}.union(names))

    is_first = True
    while True:
        seen = look()
        status = _do(tasks, notes, aside, options, printed, is_first=is_first)
        if status > FAILED:
            return status
        if is_first and not printed.quiet:
            say("waiting for drawings to change; Ctrl-C ends this")
        is_first = False
        while True:
            if number := wait_for_change(look, seen):
                return 128 + number
            seen = look()
            try:
                tasks, notes = _tasks(names, options, {**given, "force": None})
                break
            except ShapeblendError as error:
                say(str(error))


def _do(
    tasks: Sequence[Task],
    notes: Sequence[str],
    aside: Aside,
    options: BatchOptions,
    printed: TerminalOptions,
    is_first: bool = True,
) -> int:
    """Do the tasks that are not up to date; in later rounds, print only news."""
    from shapeblend_cli.batch.cache import open_cache
    from shapeblend_cli.batch.run import CURRENT, begun, clean, run_tasks
    from shapeblend_cli.batch.supervisor import Stopped

    counts: Counter[str] = Counter()
    ended: dict[int, str] = {}
    status = 0
    aside.begin(tasks)
    try:
        with BatchTerminal(len(tasks), aside.message, quiet=printed.quiet) as terminal:
            for note in notes:
                terminal.note(note)
            if options.cache is not None and not open_cache(options.cache):
                terminal.note(f"{options.cache}: cannot be written to; nothing is added to the cache")
            with begun(tasks, options, terminal.note) as found:
                for line in _reasons(tasks, found) if options.why else ():
                    terminal.note(line)
                try:
                    way = _way(options, terminal.warn)
                    for outcome in run_tasks(tasks, found, way, options, with_notes=printed.verbose):
                        ended[outcome.task.number] = outcome.status
                        counts["cached" if outcome.answer.is_cached else outcome.status] += 1
                        aside.ended(outcome, is_first or outcome.status != CURRENT)
                        _tell(outcome, terminal, with_notes=printed.verbose)
                        if outcome.answer.error is not None:
                            status = FAILED
                    for text in clean(tasks, ended) if options.clean else ():
                        terminal.warn(text)
                except Stopped as stop:
                    terminal.warn(
                        "interrupted; files that were being written are complete, and the same command does the rest"
                    )
                    status = 128 + stop.number
            terminal.note(_summary(counts, len(tasks)))
    except (ShapeblendError, Interrupted) as error:
        aside.end(tasks, str(error))
        raise
    aside.end(tasks)
    return status


def _tell(outcome: Outcome, terminal: BatchTerminal, *, with_notes: bool) -> None:
    error = outcome.answer.error
    terminal.ended(error is None, outcome.answer.seconds if outcome.attempts else None)
    for text in outcome.answer.notes if with_notes else ():
        terminal.note(f"{outcome.task.output}: {text}")
    for text in outcome.answer.warnings:
        terminal.warn(text)
    if error is not None:
        terminal.warn(f"{outcome.task.where}: {error}")


def _way(options: BatchOptions, note: Callable[[str], None]) -> Run:
    """Return what does jobs: processes here, or a cluster."""
    if options.cluster is not None:
        from shapeblend_cli.batch import cluster

        return lambda orders, most: cluster.run_all(orders, str(options.cluster), most, note)
    from shapeblend_cli.batch.run import processors
    from shapeblend_cli.batch.supervisor import run_all

    return lambda orders, most: run_all(orders, options.jobs or processors(), most)


def _tasks(
    names: tuple[str, ...], options: BatchOptions, given: Mapping[str, Any]
) -> tuple[list[Task], list[str]]:
    from shapeblend_cli.batch.aside import check_aside
    from shapeblend_cli.batch.plan import plan
    from shapeblend_cli.rows.manifest import read_manifest
    from shapeblend_cli.rows.row import named

    found = _found(names, options)
    rows, defaults = (found.rows, {}) if found else read_manifest(names[0])
    asked = {name: value for name, value in given.items() if value is not None and value != ()}
    pattern = PATTERN_OF_PAIRS if options.pairs else PATTERN
    tasks = plan(rows, {**defaults, **named(asked)}, pattern, _source(names, options), options.outside)
    if found is not None:
        file = found.first_found(str(target) for task in tasks for target in task.targets)
        if file is not None:
            raise OptionError(
                f"{file} would be taken for one of the drawings the next time; another folder in --output would work"
            )
    check_aside(options, tasks)
    if options.shard is not None:
        number, count = options.shard
        tasks = tasks[number - 1 :: count]
    return tasks, found.notes if found else []


def _source(names: Sequence[str], options: BatchOptions) -> tuple[str, ...]:
    """Return where the jobs come from: a word and paths."""
    from shapeblend_cli.rows.sources import root_of

    if options.pairs is not None:
        return "--pairs", *options.pairs
    if options.chain is not None:
        return "--chain", root_of(options.chain)
    if options.every_two is not None:
        return "--all", root_of(options.every_two)
    return "batch", *names


def _found(names: tuple[str, ...], options: BatchOptions) -> Found | None:
    """Return the jobs that options find; None if there is a manifest."""
    from shapeblend_cli.rows import sources
    from shapeblend_cli.rows.manifest import is_manifest

    ways = sum(way is not None for way in (options.pairs, options.chain, options.every_two))
    # Without quotes, a shell makes further names of a pattern.
    are_drawings = ways == 1 and options.pairs is None and not any(map(is_manifest, names))
    if ways + (0 if are_drawings else len(names)) != 1:
        raise click.UsageError(
            _meant(names)
            if len(names) > 1 and not ways
            else "a batch is one of: a manifest, --pairs FROM TO, --chain '*.svg', --all FOLDER"
        )
    if options.pairs is not None:
        return sources.same_names(*options.pairs)
    if options.chain is not None:
        return sources.chain(options.chain, names)
    if options.every_two is not None:
        return sources.every_two(options.every_two, names)
    return None


def _meant(names: Sequence[str]) -> str:
    """Return what would be done with names of which a batch takes one, a manifest."""
    shown = f"{', '.join(names[:-1])} and {names[-1]}" if len(names) < 4 else f"{len(names)} names"
    if all(map(os.path.isdir, names)):
        return f"{shown} are folders: --pairs {shlex.join(names[:2])} would work"
    if all(name.lower().endswith(".svg") for name in names):
        return f"{shown} are drawings: shapeblend {shlex.join(names)} blends them, and --chain takes a folder"
    return f"a batch takes one manifest, or --pairs FROM TO, --chain '*.svg' or --all FOLDER; {shown} given"


def _show(tasks: Sequence[Task], found: Iterable[State], options: BatchOptions) -> None:
    from shapeblend_cli.batch.run import from_cache, order_of
    from shapeblend_cli.batch.strays import strays

    for each in strays(tasks) if options.clean else ():
        for file in each.files:
            click.echo(f"{file}\twould be removed, as no job writes it any more")
    for task, state in zip(tasks, found, strict=True):
        if state.refusal is not None:
            click.echo(f"{task.output}\twould fail: {state.refusal}")
        elif state.reason:
            is_cached = options.cache is not None and from_cache(order_of(task, options)) is not None
            click.echo(f"{task.output}\t{state.reason}{'; the cache has it' if is_cached else ''}")
        elif options.why:
            edited = f", but {state.edited} was edited since" if state.edited else ""
            click.echo(f"{task.output}\tup to date{edited}")


def _reasons(tasks: Sequence[Task], found: Sequence[State]) -> list[str]:
    return [
        f"{task.output}: {state.reason}" for task, state in zip(tasks, found, strict=True) if state.reason
    ]


def _summary(ended: Mapping[str, int], count: int) -> str:
    words = {
        "done": "done",
        "cached": "from the cache",
        "current": "up to date",
        "failed": "failed",
        "timeout": "took too long",
        "memory": "took too much memory",
        "died": "died",
    }
    parts = [f"{ended[status]} {text}" for status, text in words.items() if ended.get(status)]
    left = count - sum(ended.values())
    return ", ".join([*parts, *([f"{left} left"] if left else [])]) or "no jobs"
