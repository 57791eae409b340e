"""From files to files: the pipeline with reading before it and writing after it."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import cached_property
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, NamedTuple

from shapeblend_cli.anatomy.pieces import with_areas
from shapeblend_cli.blending.graded import grade_of, is_suspect
from shapeblend_cli.blending.placing import place
from shapeblend_cli.blending.swaps.swapped import is_reshaped, is_swapped
from shapeblend_cli.errors import InputError, MatchError
from shapeblend_cli.job.job import Job
from shapeblend_cli.job.targets import check_files_of, check_libraries, named, write
from shapeblend_cli.matching.solve import COMPILED
from shapeblend_cli.model import Drawing, Pair
from shapeblend_cli.options.settings import ReadOptions, Settings
from shapeblend_cli.outputs.formats import STANDARD_OUTPUT
from shapeblend_cli.pipeline import match_all, to_blend
from shapeblend_cli.svg.reading.read import contents_of, read
from shapeblend_cli.system.clock import Clock
from shapeblend_cli.system.kept import Kept
from shapeblend_cli.system.write import Content, Contents
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
    with named(output.path):
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
            # Here, so that it is done once for all, and kept.
            drawing = with_areas(drawing)._replace(has_areas=True)
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
    """Return what is blended of drawings, with its numbers."""
    drawings, notes = to_blend(drawings, settings)
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
            how = (
                "they change over half way, where their silhouettes meet"
                if is_reshaped(pair.shapes)
                else "one shrinks and the other grows"
            )
            note(f"{_files(job, pair)}: would not blend well, so {how}; see --swap")


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
