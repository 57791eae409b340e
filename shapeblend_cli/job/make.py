"""From files to files: the pipeline with reading before it and writing after it."""

from __future__ import annotations

import os
import re
import sys
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from functools import cached_property
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, NamedTuple

from shapeblend_cli.blending.graded import grade_of, is_suspect
from shapeblend_cli.blending.placing import place
from shapeblend_cli.blending.swapped import is_swapped
from shapeblend_cli.errors import InputError, MatchError, OutputError, PictureError
from shapeblend_cli.job.job import Job, all_targets
from shapeblend_cli.matching.solve import COMPILED
from shapeblend_cli.model import Drawing, Pair
from shapeblend_cli.options.settings import ReadOptions, Settings
from shapeblend_cli.outputs.formats import STANDARD_OUTPUT, OutputSpec
from shapeblend_cli.pipeline import match_all, with_kept_text, without_specks
from shapeblend_cli.svg.reading.read import STANDARD_INPUT, contents_of, read
from shapeblend_cli.system.clock import Clock
from shapeblend_cli.system.kept import Kept
from shapeblend_cli.system.write import Content, Contents, check_targets, write_files
from shapeblend_cli.version import __version__

if TYPE_CHECKING:
    from shapeblend_cli.grading.grade import Grade
    from shapeblend_cli.job.report import Measures

SLOW = (
    "the solver was installed without a C compiler and runs uncompiled, far slower; "
    "installing again with a C compiler makes it fast"
)


class Run:
    """The pairs of a run, and the times of its stages."""

    def __init__(self, pairs: list[Pair], settings: Settings, clock: Clock) -> None:
        self.pairs = pairs
        self.settings = settings
        self.clock = clock
        self._grades: dict[int, Grade] = {}

    def grade(self, k: int) -> Grade:
        """Return the grade of a pair, by its number; it is drawn once."""
        if k not in self._grades:
            self._grades[k] = grade_of(self.pairs[k])
        return self._grades[k]

    @property
    def grades(self) -> list[Grade]:
        """The grades of all pairs."""
        return [self.grade(k) for k in range(len(self.pairs))]

    @property
    def worst_grade(self) -> Grade:
        """The grade of the pair that looks worst."""
        return max(self.grades, key=lambda grade: grade.number)

    @cached_property
    def measures(self) -> list[Measures]:
        """Measures of the frames that settings ask for, written or not."""
        from shapeblend_cli.frames.frames import times_of_frames
        from shapeblend_cli.job.report import measure

        return [measure(pair, t) for pair, t in times_of_frames(self.pairs, self.settings)]


class Made(NamedTuple):
    """The results of a run, before they are written."""

    run: Run
    contents: Contents  # of files and folders
    standard_output: str | bytes


def blend_files(
    job: Job,
    note: Callable[[str], None] | None,
    warn: Callable[[str], None],
    progress: Callable[[str, float], None],
) -> Run:
    """Read files, blend each with the next, and write all outputs or none.

    `note` takes what the user should know, a line at a time, and is None if nobody reads it; `warn` takes what even one
    who wants to read little should; `progress` takes the name of a stage and the share of it that is done, 0 to 1.
    """
    check_libraries(job)
    check_files_of(job)
    clock = Clock()
    progress("reading", 0.0)
    made = make(job, clock, note, progress)
    progress("writing", 0.0)
    write(job, made.contents, warn, made.standard_output)
    clock.lap("write")
    return made.run


def check_libraries(job: Job) -> None:
    """Raise OutputError if a job needs a library that is not there."""
    with _named(job.output.path):
        job.output.format.check_libraries()


def check_files_of(job: Job) -> None:
    """Raise OutputError if a job must not write one of its targets; see `check_targets`."""
    _check(all_targets(job), job.files, job.write.force)


def check_output(output: str, files: Sequence[str], force: bool) -> None:
    """Raise OutputError if a text that is made of files must not be written to an output; see `check_targets`."""
    if output != STANDARD_OUTPUT:
        _check([Path(output)], files, force)


def _check(targets: Iterable[Path], files: Sequence[str], force: bool) -> None:
    check_targets(targets, [Path(file) for file in files if file != STANDARD_INPUT], force)


def make(
    job: Job,
    clock: Clock,
    note: Callable[[str], None] | None,
    progress: Callable[[str, float], None] = lambda stage, share: None,
    sources: Mapping[str, bytes] = MappingProxyType({}),
    kept: Kept | None = None,
) -> Made:
    """Read files, blend each with the next, and return the outputs; see `blend_files` for the parameters.

    Files among the `sources` have these contents, and are not opened. Drawings and steps in `kept` are not made again.
    """
    notes: list[str] = []

    def note_and_keep(text: str) -> None:
        notes.append(text)
        if note is not None:
            note(text)

    if not COMPILED:
        note_and_keep(SLOW)
    output, settings = job.output, job.output.settings
    drawings = read_files(job.files, job.read, clock, note_and_keep, sources, kept)
    pairs = match_drawings(drawings, settings, clock, note_and_keep, progress, kept)
    run = Run(pairs, settings, clock)
    _say_if_swapped(job, run, note_and_keep)
    _say_if_poor(job, run, note_and_keep, is_read=note is not None or bool(job.write.preview))
    progress("drawing", 0.0)
    with _named(output.path):
        rendered = output.format.render(output._replace(watch=progress), pairs)
    clock.lap("render")
    for text in rendered.notes:
        note_and_keep(text)
    contents: dict[Path, Content | dict[str, Content]] = {}
    standard_output: str | bytes = ""
    if output.path == STANDARD_OUTPUT:
        (standard_output,) = rendered.contents
    else:
        contents.update(output.by_target(rendered))
    if job.write.report or job.write.preview:
        from shapeblend_cli.job.report import report  # most runs write none

        parts = job.reported(), pairs, run.grades, run.measures, output.frame_files()
        found = report(__version__, job.files, *parts, clock.seconds)
        if job.write.report:
            import json  # most runs write no report

            text = json.dumps(found, allow_nan=False) + "\n"
            if job.write.report == STANDARD_OUTPUT:
                standard_output = text
            else:
                contents[Path(job.write.report)] = text
        if job.write.preview:
            contents[Path(job.write.preview)] = _preview(job, found, (drawings, pairs), notes)
            clock.lap("preview")
    if job.write.tries:
        progress("trying others", 0.0)
        contents[Path(job.write.tries)] = _tries(drawings, settings, pairs[0])
        clock.lap("tries")
    return Made(run, contents, standard_output)


def write(
    job: Job, contents: Contents, warn: Callable[[str], None], standard_output: str | bytes = ""
) -> None:
    """Write what was made, all of it or nothing."""
    write_files(contents, job.write.force)
    print_text(standard_output, "; the files were written" if any(contents.values()) else "")
    warn_of_others(job, warn)


def warn_of_others(job: Job, warn: Callable[[str], None]) -> None:
    """Say that there are frames of another run in the folder of a job."""
    if stale := _stale_frames(job.output):
        warn(f"{job.output.path}: {len(stale)} frame files of another run remain, {min(stale)} among them")


def write_output(output: str, text: str, force: bool) -> None:
    """Write a text to a file, or to standard output."""
    if output == STANDARD_OUTPUT:
        print_text(text)
    else:
        write_files({Path(output): text}, force)


def match_files(
    files: Sequence[str],
    options: ReadOptions,
    settings: Settings,
    clock: Clock,
    note: Callable[[str], None],
    progress: Callable[[str, float], None],
) -> list[Pair]:
    """Read files and match each with the next; see `blend_files` for the parameters."""
    return match_drawings(read_files(files, options, clock, note), settings, clock, note, progress)


def read_files(
    files: Sequence[str],
    options: ReadOptions,
    clock: Clock,
    note: Callable[[str], None],
    sources: Mapping[str, bytes] = MappingProxyType({}),
    kept: Kept | None = None,
) -> list[Drawing]:
    """Read files; those among the `sources` have these contents, and are not opened."""
    kept = kept or Kept(0)
    drawings = []
    for file, selector in zip(files, options.selections(len(files)), strict=True):
        content = sources[file] if file in sources else contents_of(file)
        key = file, content, options.lenient, options.text, options.images, selector
        drawing = kept.find(key)
        if drawing is None:
            drawing = read(
                file,
                content,
                lenient=options.lenient,
                select=selector,
                is_to_blend=True,
                text=options.text,
                images=options.images,
            )
            if options.images != "beside":  # files beside it may change
                kept.keep(key, drawing, len(content))
        drawings.append(drawing)
    for drawing in drawings:
        for text in drawing.notes:
            note(f"{drawing.file}: {text}")
    clock.lap("read")
    return drawings


def kept_of(
    drawings: Sequence[Drawing], settings: Settings, note: Callable[[str], None]
) -> Sequence[Drawing]:
    """Return what is matched, with its numbers: without specks that are left out, and with text that stays text."""
    drawings, notes = without_specks(with_kept_text(drawings, settings), settings)
    for text in notes:
        note(text)
    return drawings


def match_drawings(
    drawings: Sequence[Drawing],
    settings: Settings,
    clock: Clock,
    note: Callable[[str], None],
    progress: Callable[[str, float], None],
    kept: Kept | None = None,
) -> list[Pair]:
    """Match each drawing with the next."""
    try:
        pairs, notes = match_all(drawings, settings, clock, progress, kept)
    except MatchError as error:
        raise InputError(" and ".join(drawing.file for drawing in drawings), str(error)) from error
    for text in notes:
        note(text)
    return pairs


def _say_if_swapped(job: Job, run: Run, note: Callable[[str], None]) -> None:
    """Say which drawings are not blended, if nobody asked for that."""
    if job.output.settings.swap == "always":
        return
    for pair in run.pairs:
        if is_swapped(pair.shapes):
            note(
                f"{_files(job, pair)}: too little in common for a blend, so one shrinks and the other grows; see --swap"
            )


def _say_if_poor(job: Job, run: Run, note: Callable[[str], None], *, is_read: bool) -> None:
    """Warn of poor in-betweens, with their worst fault and a remedy; raise InputError if that is asked for."""
    is_asked = job.write.fail_on == "poor"
    if job.output.settings.mix or not (is_asked or is_read):
        return
    graded = [
        (run.grade(k), pair) for k, pair in enumerate(run.pairs) if is_asked or is_suspect(pair.each_shape)
    ]
    if not graded:
        return
    grade, pair = max(graded, key=lambda each: each[0].number)
    if not grade.is_poor:
        return
    files = _files(job, pair)
    sheet = "" if job.write.tries else ", and --try FILE.svg shows other blends"
    why = f": {grade.why}" if grade.why else ""
    problem = f"the in-betweens look poor, grade {grade.number:.1f}{why}; --pin or --match may help{sheet}"
    if is_asked:
        raise InputError(files, problem)
    note(f"{files}: {problem}")


def _files(job: Job, pair: Pair) -> str:
    """Name the files of a pair."""
    return f"{job.files[pair.a]} and {job.files[pair.b]}"


@contextmanager
def _named(output: str) -> Iterator[None]:
    """Name the output in errors about pictures that cannot be drawn."""
    try:
        yield
    except PictureError as error:
        raise OutputError(output, str(error)) from error


def _stale_frames(output: OutputSpec) -> set[str]:
    """Return the names of frame files in the folder that are none of the run's own."""
    names = {name for name in output.frame_files() if name}
    suffixes = {re.escape(Path(name).suffix) for name in names}
    if not suffixes:
        return set()
    frames = re.compile(rf"frame-[0-9]+({'|'.join(suffixes)})")
    return {name for name in os.listdir(output.path) if frames.fullmatch(name)} - names


def _preview(
    job: Job, found: dict[str, Any], blended: tuple[Sequence[Drawing], Sequence[Pair]], notes: Sequence[str]
) -> str:
    from shapeblend_cli.frames.frames import end_frames
    from shapeblend_cli.preview.page import preview

    settings, (drawings, pairs) = job.output.settings, blended
    maps = place(drawings, settings.place)
    ends = end_frames(pairs, settings)
    return preview(found, pairs, ends, settings, job.output.timing, job.command, notes, maps)


def _tries(drawings: Sequence[Drawing], settings: Settings, pair: Pair) -> str:
    from shapeblend_cli.job.tries import tries, tries_sheet  # most runs try nothing else

    return tries_sheet(tries(drawings, settings, pair), as_drawn=settings.draws_ends)


def print_text(text: str | bytes, stands: str = "") -> None:
    """Write to standard output as UTF-8 in every locale; an error names the files that were written."""
    if not text:
        return
    try:
        sys.stdout.buffer.write(text.encode("utf-8", "replace") if isinstance(text, str) else text)
        sys.stdout.buffer.flush()
    except BrokenPipeError:
        raise
    except OSError as error:
        raise OutputError("standard output", f"cannot be written ({error.strerror}){stands}") from error
