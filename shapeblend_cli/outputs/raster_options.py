"""What can be said of pictures, and what contradicts itself.

The command line looks here before anything else is imported, so this imports nothing heavy.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from shapeblend_cli.outputs.times import FASTEST, Run

if TYPE_CHECKING:
    from collections.abc import Mapping

ANIMATED = ("gif", "webp", "apng")
PICTURES = ("png", "sheet", *ANIMATED)
"""The kinds of `outputs.formats.kind_of` that are made of pixels."""

WIDTHS = {"png": 512, "sheet": 200, **dict.fromkeys(ANIMATED, 400)}
"""Pixels of a frame, of a cell of a sheet, or of an animation, unless something is said."""

FRAMES_A_SECOND = 25

TRANSPARENT, WHITE = "transparent", "#ffffff"

MOST_SIDE = 16_383
"""Pixels; WebP has no more."""

MOST_RUNS = 65_535
"""As often can the file of an animation say that it runs."""

TAKEN_BY = {
    "columns": (("sheet",), "a contact sheet, a name ending in .png"),
    "fps": (ANIMATED, "an animation of pixels, a name ending in .gif, .webp or .apng"),
    "width": (
        PICTURES,
        "pictures, a name ending in .png, .gif, .webp or .apng, or a folder with --format png",
    ),
    "background": (
        PICTURES,
        "pictures, a name ending in .png, .gif, .webp or .apng, or a folder with --format png",
    ),
    "format": (("svg", "png"), "a folder, with a file a frame"),
}
"""For each option the kinds that take it, and how to ask for one of them."""


class RasterOptions(NamedTuple):
    """How pictures are drawn; all is None where none are.

    Attributes
    ----------
    width : int > 0
        Pixels, see `WIDTHS`.
    columns : int or None
        Of a sheet; None for as many as look well.
    background : str
        ``#rrggbb`` or ``transparent``.
    fps : int or None
        Pictures a second of an animation; None for the frames that are asked for, with both ends.
    """

    width: int | None = None
    columns: int | None = None
    background: str | None = None
    fps: int | None = None

    @property
    def ground(self) -> str | None:
        """The colour behind drawings; None is transparent."""
        return None if self.background == TRANSPARENT else self.background


def defaults(kind: str, *, by_fps: bool) -> RasterOptions:
    """How pictures are drawn unless something is said.

    Parameters
    ----------
    kind : str
        See `outputs.formats.kind_of`.
    by_fps : bool
        Whether nothing else says how many pictures an animation has.
    """
    if kind not in PICTURES:
        return RasterOptions()
    background = WHITE if kind in ("gif", "sheet") else TRANSPARENT
    fps = FRAMES_A_SECOND if by_fps and kind in ANIMATED else None
    return RasterOptions(WIDTHS[kind], None, background, fps)


def problem(kind: str, output: str, given: Mapping[str, object]) -> str | None:
    """Say which option does not fit what is made, if one does not.

    Parameters
    ----------
    kind : str
        See `outputs.formats.kind_of`.
    output : str
        A folder, the name of a file, or ``-``.
    given : mapping
        The values of the options in `TAKEN_BY` by their names; None where nothing is said.
    """
    for name, (kinds, wanted) in TAKEN_BY.items():
        if given[name] is not None and kind not in kinds:
            other = f"--emit {kind}" if kind in ("pair", "lottie", "avd") else f"--output {output}"
            return f"--{name} is for {wanted}; {other} is none"
    if kind == "gif" and given["background"] == TRANSPARENT:
        return "--background transparent: edges in a GIF cannot be half transparent; .webp and .apng can, or a colour"
    return None


def timing_problem(run: Run, repeat: int | str) -> str | None:
    """Say why an animation of pixels cannot run so, if it cannot.

    Parameters
    ----------
    run : Run
    repeat : int or str
        See `svg.animate.Timing`.
    """
    if run.pictures > FASTEST * run.seconds * (1.0 + 1e-9):
        return (
            f"{run.pictures} pictures in {run.seconds:g} seconds: browsers slow down what is faster than "
            f"{FASTEST} a second; a longer --duration, or fewer pictures, would work"
        )
    if isinstance(repeat, int) and repeat > MOST_RUNS:
        return f"--repeat {repeat}: animations of pixels run {MOST_RUNS} times at most, or forever"
    return None
