"""The command line: options in, one call of the pipeline, errors to exit codes.

Nothing heavy is imported before it is needed: ``--help`` and usage errors come from here alone.
"""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Any

import click

from shapeblend_cli import __version__
from shapeblend_cli.commands import TYPED, DefaultGroup, SectionedCommand
from shapeblend_cli.errors import ShapeblendError
from shapeblend_cli.options import (
    CONSTANTS,
    check_matching,
    check_pictures,
    lenient_option,
    matching_in_force,
    matching_options,
    matching_settings,
    picture_choice,
    picture_options,
    selections,
)
from shapeblend_cli.outputs.formats import FORMS, FRAME_KINDS, STANDARD_OUTPUT, kind_of, problem
from shapeblend_cli.parameters import SELECTOR, START, EaseType, PageType, RepeatType
from shapeblend_cli.plot.kinds import DOTTED, KINDS
from shapeblend_cli.progress import Progress

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.easing import Ease

FAILED, USAGE = 1, 2

FRAMES = 5
"""In-betweens, unless something is said."""


MATCHING = {
    "Which shapes": ("select_a", "select_b", "lenient", "place", "pairs", "unmatched"),
    "What goes where": ("vertices", "start", "pins", "reverse", "stiff", "solver", "band", "effort"),
    "The wire, by the paper's seven constants": ("preset", *CONSTANTS),
}
"""Sections of the help that `blend` and `plot` have in common."""

SECTIONS = {
    "What is made": ("frames", "ends", "output", "emit", "force", "report_file", "preview_file"),
    **MATCHING,
    "On the way": ("motion", "style", "curves", "precision"),
    "Animations": ("duration", "ease", "repeat", "animate"),
    "Pictures, with the extra shapeblend[preview]": ("frame_format", "width", "columns", "fps", "background"),
}
"""The help of blending."""

PLOT_SECTIONS = {
    "What is drawn": ("output", "force", "contour", "dot"),
    **MATCHING,
    "On the way": ("motion",),
}

EXAMPLES = (
    ("shapeblend a.svg b.svg", "five in-betweens: blend/frame-1.svg ... blend/frame-5.svg"),
    ("shapeblend a.svg b.svg -o moving.svg", "one SVG that moves by itself, in any browser"),
    ("shapeblend a.svg b.svg --preview look.html", "a page to look at the blend, and at what goes where"),
    ("shapeblend a.svg b.svg c.svg -n 9 --ends", "frames through three drawings, these among them"),
)


@click.group(
    cls=DefaultGroup,
    context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100},
)
@click.version_option(__version__, prog_name="shapeblend", message="%(prog)s %(version)s")
def shapeblend() -> None:
    """Blend one SVG shape into another."""


@shapeblend.command(cls=SectionedCommand, sections=SECTIONS, examples=EXAMPLES)
@click.argument("files", type=click.Path(), nargs=-1, required=True, metavar="A.svg B.svg [C.svg ...]")
@click.option(
    "-n",
    "--frames",
    type=click.IntRange(0, 10_000),
    metavar="N",
    help="In-betweens.  [default: 5; in .gif, .webp and .apng by --fps]",
)
@click.option("--ends", is_flag=True, help="Write t = 0 and t = 1 too.")
@click.option(
    "-o",
    "--output",
    type=click.Path(),
    metavar="PATH",
    help="A folder: one file a frame. A name ending in .svg: one animated SVG; in .gif, .webp or .apng: an animation "
    "of pixels; in .png: a contact sheet of all frames. -: an animated SVG on standard output.  "
    "[default: blend; with --emit lottie blend.json, with avd blend.xml]",
)
@click.option(
    "--emit",
    type=click.Choice(list(FORMS)),
    default="frames",
    show_default=True,
    help="frames: as --output says; pair: A and B with equal commands, for other programs to move between; "
    "lottie: an animation as JSON; avd: an animated vector drawable for Android.",
)
@click.option("-f", "--force", is_flag=True, help="Replace existing files.")
@matching_options
@click.option(
    "--style",
    type=click.Choice(["blend", "a", "b"]),
    default="blend",
    show_default=True,
    help="Paint that blends too, or all frames painted as in A, or as in B.",
)
@click.option(
    "--curves/--polygons",
    default=True,
    show_default=True,
    help="Frames of the drawings' own curves, or of the solver's polygons.",
)
@click.option(
    "--precision",
    type=click.IntRange(0, 10),
    metavar="N",
    help="Decimals of coordinates.  [default: by the drawings' size]",
)
@click.option(
    "--animate",
    type=click.Choice(["smil", "css", "frames"]),
    default="smil",
    show_default=True,
    help="How an animated SVG moves. css stands still for who prefers reduced motion, and in Safari; frames are "
    "pictures shown in turn, and work everywhere.",
)
@click.option(
    "--duration",
    type=click.FloatRange(0.01, 3600.0),
    default=2.0,
    show_default=True,
    metavar="S",
    help="Seconds an animation takes from one drawing to the next.",
)
@click.option(
    "--ease",
    type=EaseType(),
    default="linear",
    show_default=True,
    help="linear, ease, ease-in, ease-out, ease-in-out or cubic-bezier(x1,y1,x2,y2): spaces in-betweens and moves "
    "animations.",
)
@click.option(
    "--repeat",
    type=RepeatType(),
    metavar="N|forever|pingpong",
    default="forever",
    show_default=True,
    help="How often an animation runs; pingpong: there and back.",
)
@picture_options
@click.option(
    "--report",
    "report_file",
    type=click.Path(),
    metavar="FILE",
    help="Write what was found as JSON; - for standard output.",
)
@click.option(
    "--preview",
    "preview_file",
    type=PageType(),
    metavar="FILE.html",
    help="Write a page that shows the blend, its correspondence and its graph, for any browser.",
)
@click.option("-q", "--quiet", is_flag=True, help="Only errors.")
@click.option("-v", "--verbose", is_flag=True, help="Say what was done, and how long it took.")
def blend(
    files: tuple[str, ...],
    frames: int | None,
    ends: bool,
    output: str | None,
    emit: str,
    force: bool,
    style: str,
    curves: bool,
    precision: int | None,
    animate: str,
    duration: float,
    ease: Ease,
    repeat: int | str,
    frame_format: str | None,
    width: int | None,
    columns: int | None,
    fps: int | None,
    background: str | None,
    report_file: str | None,
    preview_file: str | None,
    quiet: bool,
    verbose: bool,
    **matching: Any,
) -> None:
    """Blend A.svg into B.svg, and on into further files, with the least work of bending and stretching.

    Writes the in-betweens as SVG files, one SVG that moves, or pictures. One of the files may be -, standard input.
    """
    check_matching(files, matching)
    output = FORMS[emit].output if output is None else output
    if found := problem(emit, output, len(files)):
        raise click.UsageError(found)
    kind = kind_of(emit, output, frame_format)
    said = {"format": frame_format, "width": width, "columns": columns, "fps": fps, "background": background}
    choice = picture_choice(kind, output, frames, said)
    frames = FRAMES if frames is None else frames
    check_pictures(kind, choice, frames, ends, len(files) - 1, duration, repeat)
    if output == report_file == STANDARD_OUTPUT:
        raise click.UsageError("--output and --report cannot both be standard output")
    if quiet and verbose:
        raise click.UsageError("--quiet and --verbose contradict each other")
    if emit == "pair" and matching["motion"] == "auto":
        matching["motion"] = "linear"  # what programs do between two files
    settings = {
        "frames": frames,
        "ends": ends,
        "output": output,
        "emit": emit,
        "force": force,
        **matching_in_force(matching),
        "style": style,
        "curves": curves,
        "precision": precision,
        "animate": animate,
        "duration": duration,
        "ease": str(ease),
        "repeat": repeat,
        "format": kind if kind in FRAME_KINDS else None,
        **choice._asdict(),
        "report": report_file,
        "preview": preview_file,
    }

    from shapeblend_cli.easing import Timing
    from shapeblend_cli.files import Job, blend_files
    from shapeblend_cli.outputs.render import OutputSpec

    job = Job(
        files=files,
        output=output,
        force=force,
        report_file=report_file,
        preview_file=preview_file,
        typed=("shapeblend", *_typed()),
        reported_settings=settings,
        select=selections(matching, len(files)),
        lenient=matching["lenient"],
        wanted=OutputSpec(kind, animate, Timing(duration, ease, repeat), precision, choice),
        blend=matching_settings(matching).replace(
            frames=frames, ends=ends, style=style, curves=curves, ease=ease
        ),
    )
    with Progress(quiet) as progress:
        blend_files(job, _nothing if quiet else _note, _note if verbose else None, progress.show)


@shapeblend.command()
@click.argument("file", type=click.Path(), metavar="FILE")
@click.option(
    "--select", type=SELECTOR, help="Which shapes: #id, or a CSS selector.  [default: all painted ones]"
)
@lenient_option
@click.option("--json", "as_json", is_flag=True, help="For programs.")
def inspect(file: str, select: str | None, lenient: bool, as_json: bool) -> None:
    """List the shapes a file draws; - is standard input."""
    from shapeblend_cli.report import inspection
    from shapeblend_cli.svg.reading.read import read

    drawing = read(file, lenient=lenient, select=select)
    found = inspection(drawing) | {"file": file}
    if as_json:
        import json

        click.echo(json.dumps(found, indent=1, allow_nan=False))
        return
    from shapeblend_cli.listing import show

    for note in drawing.notes:
        _note(f"{drawing.file}: {note}")
    show(found)


@shapeblend.command(cls=SectionedCommand, sections=PLOT_SECTIONS)
@click.argument("kind", type=click.Choice(list(KINDS)), metavar="KIND")
@click.argument("files", type=click.Path(), nargs=-1, required=True, metavar="A.svg B.svg")
@click.option(
    "-o", "--output", type=click.Path(), metavar="FILE", help="- for standard output.  [default: KIND.svg]"
)
@click.option("-f", "--force", is_flag=True, help="Replace an existing file.")
@click.option(
    "--contour",
    type=click.IntRange(0),
    metavar="K",
    help="A contour of A, by its number in the report.  [default: the largest that is matched]",
)
@click.option(
    "--dot",
    type=START,
    metavar="I,J",
    help="Vertices of A and B that correspond: of angle; of starts only I counts.  [default: most bending work; 0]",
)
@matching_options
@click.option("-q", "--quiet", is_flag=True, help="Only errors.")
def plot(
    kind: str,
    files: tuple[str, ...],
    output: str | None,
    force: bool,
    contour: int | None,
    dot: tuple[int, int] | None,
    quiet: bool,
    **matching: Any,
) -> None:
    """Draw how two files correspond, in the form of the paper's figures.

    KIND is graph (the least-work path among all correspondences), surface (the in-betweens over time), angle
    (how the angle of a dot moves) or starts (the least work by starting correspondence).
    """
    if len(files) != 2:
        raise click.UsageError(f"a plot is of two files, A.svg and B.svg; {len(files)} given")
    check_matching(files, matching)
    if dot is not None and kind not in DOTTED:
        raise click.UsageError(f"--dot is of {' and '.join(DOTTED)}; {kind} shows all dots")
    if kind == "starts" and (matching["start"] or matching["pins"]):
        raise click.UsageError("starts compares all starts; --start and --pin would leave one")

    from shapeblend_cli.plot.write import Plot, plot_files

    wanted = Plot(
        kind=kind,
        files=(files[0], files[1]),
        output=output or f"{kind}.svg",
        force=force,
        select=selections(matching, len(files)),
        lenient=matching["lenient"],
        blend=matching_settings(matching).replace(curves=False),
        contour=contour,
        dot=dot,
    )
    with Progress(quiet) as progress:
        plot_files(wanted, _nothing if quiet else _note, progress.show)


@shapeblend.command()
@click.argument("shell", type=click.Choice(["bash", "zsh", "fish"]))
def completion(shell: str) -> None:
    """Print what makes a shell complete this command.

    \b
    bash, in ~/.bashrc:                         eval "$(shapeblend completion bash)"
    zsh, in ~/.zshrc:                           eval "$(shapeblend completion zsh)"
    fish, in ~/.config/fish/config.fish:        shapeblend completion fish | source
    """  # noqa: D301  # click knows \\b
    from click.shell_completion import get_completion_class

    script = get_completion_class(shell)
    assert script is not None
    click.echo(script(shapeblend, {}, "shapeblend", "_SHAPEBLEND_COMPLETE").source())


def _typed() -> list[str]:
    """The arguments of a blend as they were typed."""
    arguments: list[str] = click.get_current_context().meta[TYPED]
    return arguments[1:]


def _note(text: str) -> None:
    click.echo(f"shapeblend: {text}", err=True)


def _nothing(text: str) -> None:
    pass


def run(arguments: Sequence[str]) -> int:
    """Run a command line; an error is one line on standard error.

    Returns
    -------
    int
        Exit status: 0 done, 1 the input or the run failed, 2 the command line is wrong.
    """
    try:
        shapeblend.main(list(arguments), prog_name="shapeblend", standalone_mode=False)
    except click.ClickException as error:
        _note(f"{' '.join(error.format_message().split())} (shapeblend --help lists the options)")
        return USAGE
    except click.Abort:
        _note("interrupted; nothing was written")
        return FAILED
    except ShapeblendError as error:
        _note(" ".join(str(error).split()))
        return FAILED
    except BrokenPipeError:
        sys.stderr.close()  # the reader of our output has gone, and so has nothing to be told
        return FAILED
    except MemoryError:
        _note("not enough memory for outlines of so many vertices; a smaller --vertices would help")
        return FAILED
    return 0
