"""Write the tables of docs/options.md from the fields of records: `make options`. No arguments."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from shapeblend_cli.batch.options import BatchOptions, RankOptions
from shapeblend_cli.cli.studio import StudioOptions
from shapeblend_cli.cli.terminal import TerminalOptions
from shapeblend_cli.inkscape.options import InkscapeOptions, InstallOptions
from shapeblend_cli.job.job import RECORDS as OF_BLEND
from shapeblend_cli.job.options import StatesOptions
from shapeblend_cli.options.settings import (
    BATCH,
    INKSCAPE,
    PLOT,
    RANK,
    SECTIONS,
    STATES,
    STUDIO,
)
from shapeblend_cli.plot.options import PlotOptions
from tools.quality.data import ROOT
from tools.quality.tables import Table, with_figures

if TYPE_CHECKING:
    from shapeblend_cli.options.fields import Option

PAGE = ROOT / "docs" / "options.md"

BEGIN, END = "<!-- options: written by make options -->", "<!-- end of options -->"

RECORDS = (
    *OF_BLEND,
    TerminalOptions,
    PlotOptions,
    BatchOptions,
    RankOptions,
    StudioOptions,
    StatesOptions,
    InkscapeOptions,
    InstallOptions,
)

OF_COMMANDS = PLOT, BATCH, RANK, STUDIO, STATES, INKSCAPE
"""Sections of the other commands, which come last."""


def tables() -> str:
    """Return a table for each section of the help, with the lines around them."""
    fields = [field for record in RECORDS for field in record.options.values()]
    parts = [BEGIN, ""]
    for section in (*(each for each in SECTIONS if each not in OF_COMMANDS), *OF_COMMANDS):
        rows = [(_typed(field), _help(field)) for field in fields if field.section == section]
        parts.append(Table((section, ""), rows).markdown())
    return "\n".join([*parts, END])


def _typed(field: Option) -> str:
    typed = ", ".join(field.flags).replace("/", " / ")
    return f"`{typed} {field.metavar}`".replace(" `", "`").replace("|", r"\|")


def _help(field: Option) -> str:
    return re.sub(r"(--[a-z-]+[a-z])", r"`\1`", field.full_help.replace("  [", " ["))


if __name__ == "__main__":
    PAGE.write_text(with_figures(PAGE.read_text(encoding="utf-8"), tables(), BEGIN, END), encoding="utf-8")
