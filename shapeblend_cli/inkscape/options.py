"""Options of the extension for Inkscape. Nothing heavy is imported here, for the sake of ``--help``."""

from __future__ import annotations

from shapeblend_cli.options import types
from shapeblend_cli.options.fields import Record, option
from shapeblend_cli.options.settings import INKSCAPE


class InkscapeOptions(Record, section=INKSCAPE):
    """The objects that are blended in a document of Inkscape, and the place of the in-betweens."""

    ids: tuple[str, ...] = option(
        types.TEXT,
        default=(),
        many=True,
        flags=("--id",),
        metavar="ID",
        help="Id of a selected object. The lowest object in the document comes first.",
    )
    frames_as: str = option(
        types.choice("group", "layers"),
        default="group",
        key="as",
        help="Put the in-betweens into one group right above the lower object, or each into a layer.",
    )


class InstallOptions(Record, section=INKSCAPE):
    """Where the extension goes."""

    folder: str | None = option(
        types.file(),
        default=None,
        metavar="FOLDER",
        help="Where Inkscape looks for extensions.",
        default_text="the one that Inkscape names, or else the usual one",
    )
