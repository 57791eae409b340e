"""Options of plots. Nothing heavy is imported here, for the sake of ``--help``."""

from __future__ import annotations

from shapeblend_cli.options import types
from shapeblend_cli.options.fields import Record, option
from shapeblend_cli.options.settings import PLOT


class PlotOptions(Record, section=PLOT):
    """The subject of a plot, and its file."""

    output: str | None = option(
        types.file(),
        default=None,
        flags=("-o", "--output"),
        help="The SVG file to write; - for standard output.",
        default_text="KIND.svg",
    )
    force: bool = option(types.FLAG, default=False, flags=("-f", "--force"), help="Replace an existing file.")
    contour: int | None = option(
        types.whole(0),
        default=None,
        metavar="K",
        help="A contour of A, by its number in the report.",
        default_text="the largest that is matched",
    )
    dot: tuple[int, int] | None = option(
        types.START,
        default=None,
        metavar="I,J",
        help="For angle: vertex I of A and vertex J of B, which correspond.",
        default_text="the dot with the most bending work",
    )
