"""Options that several commands take, and what is made of them."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import click

from shapeblend_cli.constants import PRESETS
from shapeblend_cli.outputs import raster_options
from shapeblend_cli.outputs.times import FASTEST, run_for
from shapeblend_cli.parameters import (
    SELECTOR,
    START,
    BandType,
    ColourType,
    ConstantType,
    MatchType,
    PinType,
    StiffType,
)

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from shapeblend_cli.outputs.raster_options import RasterOptions
    from shapeblend_cli.settings import Settings

CONSTANTS = {
    "ks": (1.0, "Stiffness against stretching."),
    "kb": (1.0, "Stiffness against bending."),
    "es": (2.0, "Exponent of stretching."),
    "eb": (1.0, "Exponent of bending."),
    "pb": (1000.0, "Penalty for an angle that closes to zero."),
    "mb": (3.0, "Penalty for an angle that goes back and forth."),
    "cs": (0.5, "Edges collapse to points: near 0 hardly ever, 1 easily."),
}
"""The paper's seven constants: default and help."""

STANDARD_INPUT = "-"


lenient_option = click.option(
    "--lenient", is_flag=True, help="Draw broken path data and points up to the error, as browsers do."
)


MATCHING = (
    click.option(
        "--select-a",
        type=SELECTOR,
        help="Which shapes of A: #id, or a CSS selector.  [default: all painted ones]",
    ),
    click.option("--select-b", type=SELECTOR, help="Which shapes of B, and of further files."),
    lenient_option,
    click.option(
        "--place",
        type=click.Choice(["viewbox", "bbox", "asis"]),
        default="viewbox",
        show_default=True,
        help="How B is laid over A: viewBox on viewBox, box on box, or file coordinates as they stand.",
    ),
    click.option(
        "--vertices",
        type=click.IntRange(0, 100_000),
        default=200,
        show_default=True,
        metavar="N",
        help="Vertices a contour, about. Nodes of the drawing always stay; 0 adds none but what a curve needs.",
    ),
    click.option(
        "--start",
        type=START,
        metavar="auto|I,J",
        default="auto",
        show_default=True,
        help="Starting correspondence: proven best over all, or vertex I of A with vertex J of B.",
    ),
    click.option(
        "--pin",
        "pins",
        type=PinType(),
        metavar="I,J|x,y:x,y",
        multiple=True,
        help="Vertices that must correspond, by number, or the nearest to a point of A and a point of B. Repeatable.",
    ),
    click.option(
        "--reverse",
        type=click.Choice(["auto", "yes", "no"]),
        default="auto",
        show_default=True,
        help="Go through B's outline backwards. auto: closed outlines in the same direction; both are tried where "
        "that is not decided, and for open ones.",
    ),
    click.option(
        "--stiff",
        type=StiffType(),
        metavar="x,y,r=W",
        multiple=True,
        help="Make A's wire W times as stiff within r of a point. Repeatable.",
    ),
    click.option(
        "--match",
        "pairs",
        type=MatchType(),
        multiple=True,
        help="Contours that become one another: a number or an id of A and one of B. Repeatable.",
    ),
    click.option(
        "--unmatched",
        type=click.Choice(["point", "split"]),
        default="point",
        show_default=True,
        help="point: what has no partner grows from a point, or shrinks to one; split: an outline is cut for it.",
    ),
    click.option(
        "--solver",
        type=click.Choice(["exact", "simplified"]),
        default="exact",
        show_default=True,
        help="The paper's section 4, or 4.1.",
    ),
    click.option(
        "--band",
        type=BandType(),
        metavar="DD|none",
        help="Diagonal deviation a path may have from its start (section 5.2), 0 to 1.  [default: none]",
    ),
    click.option(
        "--effort",
        type=click.Choice(["auto", "exact", "fast"]),
        default="auto",
        show_default=True,
        help="exact: proven, however long it takes; auto: where that is quick; fast: coarse to fine early on.",
    ),
    click.option(
        "--motion",
        type=click.Choice(["auto", "linear", "rigid", "intrinsic", "safe"]),
        default="auto",
        show_default=True,
        help="How outlines travel: linear: on straight paths; rigid: turned as a whole; intrinsic: by lengths and "
        "angles; safe: never crossing themselves; auto: straight, else the first of these without a fault.",
    ),
)


PICTURES = (
    click.option(
        "--format",
        "frame_format",
        type=click.Choice(["svg", "png"]),
        help="What a folder of frames is filled with.  [default: svg]",
    ),
    click.option(
        "--width",
        type=click.IntRange(1, raster_options.MOST_SIDE),
        metavar="PX",
        help="Pixels of pictures; of a contact sheet, those of a cell.  [default: 400 of .gif, .webp and .apng, 512 "
        "of frames, 200 of a cell]",
    ),
    click.option(
        "--columns",
        type=click.IntRange(1, 10_000),
        metavar="N",
        help="Of a contact sheet.  [default: by count]",
    ),
    click.option(
        "--fps",
        type=click.IntRange(1, FASTEST),
        metavar="N",
        help="Pictures a second of .gif, .webp and .apng.  [default: 25, unless --frames is given]",
    ),
    click.option(
        "--background",
        type=ColourType(),
        help="Colour behind pictures, or transparent.  [default: transparent; white in a .gif and a contact sheet]",
    ),
)


def picture_options(command: Callable[..., Any]) -> Callable[..., Any]:
    """Everything that is about pictures of pixels."""
    for option in reversed(PICTURES):
        command = option(command)
    return command


def picture_choice(kind: str, output: str, frames: int | None, said: dict[str, Any]) -> RasterOptions:
    """How pictures are drawn: the values of `picture_options` with the defaults filled in, all None without pictures.

    Parameters
    ----------
    kind, output
        See `outputs.raster_options.problem`.
    frames : int or None
        In-betweens, where something is said of them.
    said : dict
        The values of the options by their names.

    Raises
    ------
    click.UsageError
        Options that do not fit what is made, or contradict each other.
    """
    if found := raster_options.problem(kind, output, said):
        raise click.UsageError(found)
    if frames is not None and said["fps"] is not None:
        raise click.UsageError("--frames and --fps both say how many pictures there are; one will do")
    defaults = raster_options.defaults(kind, by_fps=frames is None)
    return defaults._replace(**{n: said[n] for n in defaults._fields if said[n] is not None})


def check_pictures(
    kind: str, drawn: RasterOptions, frames: int, ends: bool, pairs: int, duration: float, repeat: int | str
) -> None:
    """Refuse animations of pixels that cannot run so, and contact sheets of nothing.

    Raises
    ------
    click.UsageError
    """
    if kind == "sheet" and not (frames or ends):
        raise click.UsageError(
            "--frames 0 leaves nothing for a contact sheet; --frames 1 or --ends would work"
        )
    if kind in raster_options.ANIMATED:
        run = run_for(drawn.fps, frames, pairs, duration, repeat == "pingpong")
        if found := raster_options.timing_problem(run, repeat):
            raise click.UsageError(found)


def matching_options(command: Callable[..., Any]) -> Callable[..., Any]:
    """Everything that decides which place of A goes to which of B, and by which way."""
    command = constant_options(command)
    for option in reversed(MATCHING):
        command = option(command)
    return command


def check_matching(files: Sequence[str], matching: dict[str, Any]) -> None:
    """Refuse files and options that do not go together.

    Raises
    ------
    click.UsageError
    """
    if len(files) < 2:
        raise click.UsageError(f"two files or more are blended, A.svg and B.svg; {len(files)} given")
    if files.count(STANDARD_INPUT) > 1:
        raise click.UsageError("standard input can be one of the files, not more")
    if len(files) > 2 and any(matching[name] for name in ("start", "pins", "pairs", "stiff")):
        raise click.UsageError(f"--start, --pin, --match and --stiff are about two files; {len(files)} given")


def matching_in_force(matching: dict[str, Any]) -> dict[str, Any]:
    """The values of `matching_options`, presets and defaults filled in, as the report has them."""
    preset = matching["preset"]
    start = matching["start"]
    return {
        **{name: matching[name] for name in ("select_a", "select_b", "lenient", "place", "vertices")},
        "start": list(start) if start else "auto",
        "pins": [[_plain(side) for side in pin] for pin in matching["pins"]],
        "reverse": matching["reverse"],
        "stiff": [[_plain(point), radius, weight] for point, radius, weight in matching["stiff"]],
        "match": [list(pair) for pair in matching["pairs"]],
        "unmatched": matching["unmatched"],
        "solver": matching["solver"],
        "band": matching_settings(matching).band,
        "effort": matching["effort"],
        "preset": preset,
        **{name: getattr(matching_settings(matching), constant_field(name)) for name in CONSTANTS},
        "motion": matching["motion"],
    }


def _plain(side: complex) -> int | list[float]:
    """A vertex number or a point, for JSON."""
    return side if isinstance(side, int) else [side.real, side.imag]


def matching_settings(matching: dict[str, Any]) -> Settings:
    """The settings that the values of `matching_options` make."""
    from shapeblend_cli.settings import Settings

    given = {constant_field(name): value for name, value in matching.items()}
    return Settings.of(given | {"match": matching["pairs"]})


def constant_field(name: str) -> str:
    """The name of a constant among the settings."""
    return f"{name[0]}_{name[1]}" if name in CONSTANTS else name


def selections(matching: dict[str, Any], files: int) -> tuple[str | None, ...]:
    """Which shapes of each file are wanted."""
    return matching["select_a"], *[matching["select_b"]] * (files - 1)


def constant_options(command: Callable[..., Any]) -> Callable[..., Any]:
    """``--ks`` to ``--cs`` and ``--preset``."""
    add = click.option(
        "--preset",
        type=click.Choice(list(PRESETS)),
        help="The constants and the band of a row of the paper's table 1; what is given beside it wins.",
    )
    command = add(command)
    for name, (default, text) in reversed(CONSTANTS.items()):
        kind = ConstantType(name in ("es", "eb", "cs"), 1.0 if name == "cs" else math.inf)
        command = click.option(f"--{name}", type=kind, help=f"{text}  [default: {default:g}]")(command)
    return command
