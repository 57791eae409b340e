"""From files to files: the pipeline with reading before it and writing after it."""

from __future__ import annotations

import sys
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from shapeblend_cli import __version__
from shapeblend_cli.clock import Clock
from shapeblend_cli.errors import InputError, MatchError, OutputError, PictureError
from shapeblend_cli.match.solve import COMPILED
from shapeblend_cli.measure import measure
from shapeblend_cli.output import check_targets, write_files
from shapeblend_cli.outputs.formats import FRAME_KINDS, STANDARD_OUTPUT, file_names, frame_names
from shapeblend_cli.outputs.libraries import check_libraries
from shapeblend_cli.outputs.raster_options import PICTURES
from shapeblend_cli.outputs.render import render
from shapeblend_cli.pipeline import make_frames, match_all
from shapeblend_cli.report import report
from shapeblend_cli.svg.reading.read import STANDARD_INPUT, read

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from shapeblend_cli.measure import Measures
    from shapeblend_cli.model import Frame, Pair
    from shapeblend_cli.outputs.render import OutputSpec
    from shapeblend_cli.settings import Settings

SLOW = (
    "the solver was installed without a C compiler and runs uncompiled, far slower; "
    "installing again with a C compiler makes it fast"
)


class Job(NamedTuple):
    """One run of the command: files in, files out.

    Attributes
    ----------
    files : tuple of str
        Two or more. One of them may be ``-``, standard input.
    output : str
        A folder, the name of a file, or ``-``.
    force : bool
        Replace existing files.
    report_file, preview_file : str or None
    typed : tuple of str
        The command line.
    blend : Settings
    reported_settings : dict
        Every option's value in force, for the report.
    select : tuple of str or None
        Which shapes of each file; None is all it paints.
    lenient : bool
        Draw broken path data up to the error.
    wanted : OutputSpec
    """

    files: tuple[str, ...]
    output: str
    force: bool
    report_file: str | None
    preview_file: str | None
    typed: tuple[str, ...]
    blend: Settings
    reported_settings: dict[str, Any]
    select: tuple[str | None, ...]
    lenient: bool
    wanted: OutputSpec

    @property
    def frame_count(self) -> int:
        """How many frames there are of all pairs."""
        pairs = len(self.files) - 1
        return pairs * self.blend.frames + (pairs + 1 if self.blend.ends else 0)

    def targets(self) -> list[Path]:
        """The files of the blend, in order; none for standard output."""
        return [Path(name) for name in file_names(self.wanted.kind, self.output, self.frame_count)]


def blend_files(
    job: Job,
    say: Callable[[str], None],
    detail: Callable[[str], None] | None,
    watch: Callable[[float], None],
) -> None:
    """Read files, blend each with the next, and write what was asked for, all of it or nothing.

    Parameters
    ----------
    job : Job
    say : callable
        Takes what the user should know, a line at a time.
    detail : callable or None
        Takes what was done and how long it took.
    watch : callable
        Told now and then which share of the matching is done, from 0 to 1.

    Raises
    ------
    ShapeblendError
        With one line that names the file, what was found and what would work.
    """
    clock = Clock()
    said: list[str] = []

    def tell(note: str) -> None:
        said.append(note)
        say(note)

    if not COMPILED:
        tell(SLOW)
    if job.wanted.kind in PICTURES:
        with _named(job.output):
            check_libraries(job.wanted.kind)
    paths = _targets(job)
    check_targets(paths, [Path(file) for file in job.files if file != STANDARD_INPUT], job.force)

    pairs = match_files(job.files, job.select, job.lenient, job.blend, clock, tell, watch)
    frames = make_frames(pairs, job.blend)
    clock.lap("interpolate")

    with _named(job.output):
        products, notes = render(job.wanted, pairs, frames, job.blend)
    for note in notes:
        tell(note)
    contents: dict[Path, str | bytes] = {}
    standard_output: str | bytes = ""
    if job.output == STANDARD_OUTPUT:
        (standard_output,) = products
    else:
        contents.update(zip(job.targets(), products, strict=True))
    names = _frame_files(job)
    is_reported = job.report_file is not None or job.preview_file is not None
    measures = [measure(pairs[frame.pair], frame.t) for frame in frames] if is_reported or detail else []
    if is_reported:
        found = report(
            __version__, job.files, job.reported_settings, pairs, frames, measures, names, clock.seconds
        )
        if job.report_file is not None:
            import json  # most runs write no report

            text = json.dumps(found, allow_nan=False) + "\n"
            if job.report_file == STANDARD_OUTPUT:
                standard_output = text
            else:
                contents[Path(job.report_file)] = text
        if job.preview_file is not None:
            contents[Path(job.preview_file)] = _preview(job, found, pairs, said)
            clock.lap("preview")
    write_files(contents)
    print_text(standard_output)
    stale = _stale(job.output, names)
    if stale:
        say(f"{job.output}: {len(stale)} frame files of another run are left, {min(stale)} among them")
    clock.lap("write")
    if detail is not None:
        for line in _details(pairs, frames, measures, clock):
            detail(line)


def match_files(
    files: Sequence[str],
    select: Sequence[str | None],
    lenient: bool,
    settings: Settings,
    clock: Clock,
    say: Callable[[str], None],
    watch: Callable[[float], None],
) -> list[Pair]:
    """Read files and match each with the next; see `Job` and `blend_files` for the parameters."""
    drawings = [
        read(file, lenient=lenient, select=wanted) for file, wanted in zip(files, select, strict=True)
    ]
    for drawing in drawings:
        for note in drawing.notes:
            say(f"{drawing.file}: {note}")
    clock.lap("read")
    try:
        pairs, notes = match_all(drawings, settings, clock, watch)
    except MatchError as error:
        raise InputError(" and ".join(drawing.file for drawing in drawings), str(error)) from error
    for note in notes:
        say(note)
    return pairs


@contextmanager
def _named(output: str) -> Iterator[None]:
    """Say which output it is that pictures cannot be drawn for."""
    try:
        yield
    except PictureError as error:
        raise OutputError(output, str(error)) from error


def _frame_files(job: Job) -> Sequence[str | None]:
    """For each frame the name of the file that shows it alone, if there is one."""
    if job.wanted.kind in FRAME_KINDS:
        return frame_names(job.wanted.kind, job.frame_count)
    return [None] * job.frame_count


def _stale(folder: str, names: Sequence[str | None]) -> set[str]:
    """The names of frame files in a folder that are none of a run's own."""
    kinds = {name.rpartition(".")[2] for name in names if name}
    return {path.name for kind in kinds for path in Path(folder).glob(f"frame-*.{kind}")} - {*names}


def _preview(job: Job, found: dict[str, Any], pairs: Sequence[Pair], notes: Sequence[str]) -> str:
    """The page that shows a run."""
    from shapeblend_cli.preview.page import preview  # most runs write none

    ends = make_frames(pairs, job.blend.replace(frames=0, ends=True))
    return preview(found, pairs, ends, job.blend, job.wanted.timing, job.typed, notes)


def _targets(job: Job) -> list[Path]:
    """Every file the job will write."""
    targets = job.targets()
    if job.report_file not in (None, STANDARD_OUTPUT):
        targets.append(Path(str(job.report_file)))
    if job.preview_file is not None:
        targets.append(Path(job.preview_file))
    twice = [target for k, target in enumerate(targets) if target in targets[:k]]
    if twice:
        raise OutputError(str(twice[0]), "is named for two different outputs; another name would work")
    return targets


def print_text(text: str | bytes) -> None:
    """Write to standard output as UTF-8, whatever the locale."""
    if text:
        sys.stdout.buffer.write(text.encode("utf-8") if isinstance(text, str) else text)
        sys.stdout.buffer.flush()


def _proof(lower_bound: float | None) -> str:
    return "not proven least" if lower_bound is None else f"at least {lower_bound:.6g}"


def _details(
    pairs: Sequence[Pair], frames: Sequence[Frame], measures: Sequence[Measures], clock: Clock
) -> list[str]:
    lines = []
    for c in (contour for pair in pairs for contour in pair.contours):
        found = c.correspondence
        if c.a is None or c.b is None:
            way = f"contour {c.a} of A shrinks to" if c.b is None else f"contour {c.b} of B grows from"
            spot = (c.polygon_b if c.b is None else c.polygon_a).vertices[0]
            lines.append(f"{way} the point {spot.real:.6g},{spot.imag:.6g}")
            continue
        lines.append(
            f"contour {c.a} of A ({len(c.polygon_a.vertices)} vertices) to contour {c.b} of B "
            f"({len(c.polygon_b.vertices)}): {len(found.dots)} dots, work {found.work:.6g} = stretching "
            f"{found.stretching:.6g} + bending {found.bending:.6g}, {_proof(found.lower_bound)}, "
            f"{found.zero_angles} angles reach zero, {found.sweeps} sweeps"
        )
    for pair in pairs:
        for number, shape in enumerate(pair.shapes, 1):
            which = f"shape {number}: " if len(pair.shapes) > 1 else ""
            if shape.is_matched:
                lines.append(f"{which}motion {shape.motion_name}: {shape.reason}")
    lines.append(f"{_counted(len(frames), 'frame')}: {_crossed(frames, measures)}")
    lines.append(", ".join(f"{stage} {1000 * seconds:.1f} ms" for stage, seconds in clock.seconds.items()))
    return lines


def _crossed(frames: Sequence[Frame], measures: Sequence[Measures]) -> str:
    """Which frames cross themselves, and how often."""
    crossed = [(frame, count) for frame, (count, _) in zip(frames, measures, strict=True) if count]
    if not crossed:
        return "none crosses itself"
    several = len({frame.pair for frame in frames}) > 1
    times = ", ".join(f"{frame.t:.3g}" + f" of pair {frame.pair}" * several for frame, _ in crossed)
    total = sum(count for _, count in crossed)
    return f"{_counted(total, 'crossing')} in {len(crossed)} of them, at t = {times}"


def _counted(count: int, what: str) -> str:
    return f"{count} {what}" if count == 1 else f"{count} {what}s"
