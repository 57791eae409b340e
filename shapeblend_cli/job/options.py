"""Options of a run: its files, its report and its limits. Nothing heavy is imported here."""

from __future__ import annotations

from typing import Any

from shapeblend_cli.options import types
from shapeblend_cli.options.fields import Record, option
from shapeblend_cli.options.settings import OTHER, OUTPUT, STATES


class WriteOptions(Record, section=OUTPUT):
    """Which files a run writes."""

    force: bool = option(types.FLAG, default=False, flags=("-f", "--force"), help="Replace existing files.")
    report: str | None = option(
        types.file(),
        default=None,
        help="Write the correspondence, its work, and measurements of the frames as JSON; - for standard output.",
    )
    preview: str | None = option(
        types.file(".htm", ".html"),
        default=None,
        metavar="FILE.html",
        help="Write a web page that shows the blend, its correspondence and its graph.",
    )
    tries: str | None = option(
        types.file(".svg"),
        default=None,
        flags=("--try",),
        metavar="FILE.svg",
        help="Write a sheet of other blends of two drawings, to choose from by eye, each with its options and its "
        "grade; 0 is best, 3 worst.",
    )
    fail_on: str = option(
        types.choice("never", "poor"),
        default="never",
        help="poor: fail, and write nothing, if the in-betweens are graded 2 or worse.",
    )


REPORT_TO_FILE = "Write the correspondence, its work, and measurements of the frames as JSON."
"""Help of --report for commands that print no report."""


class RunOptions(Record, section=OTHER):
    """Time and memory that a command may take."""

    timeout: float | None = option(
        types.number(0.0, 1e6, above=True),
        default=None,
        metavar="S",
        help="Stop after S seconds, with an error and with nothing written.",
        default_text="none",
    )
    max_memory: float | None = option(
        types.number(0.0, 1e9, above=True),
        default=None,
        metavar="MB",
        help="Stop if the run takes more than MB megabytes of memory, with an error and with nothing written.",
        default_text="none",
    )


class StatesOptions(Record, section=STATES):
    """A drawing of several states."""

    output: str = option(
        types.file(".svg", ".js", "-"),
        default="states.svg",
        flags=("-o", "--output"),
        metavar="FILE",
        help="An SVG, or a JavaScript module (.js) with a custom element for web pages; - for an SVG on standard "
        "output.",
    )
    force: bool = option(types.FLAG, default=False, flags=("-f", "--force"), help="Replace an existing file.")
    trigger: str = option(
        types.choice("none", "click", "hover"),
        default="none",
        help="What changes the state. none: only the page around it; click: a click, Enter or Space moves "
        "on to the next state; hover: the second state is shown while the pointer is on it or it has the keyboard's "
        "focus. A custom element reacts so unless its attribute trigger says otherwise.",
    )
    duration: float = option(
        types.seconds(0.0, 3600.0), default=0.3, help="Seconds from one state to another; 300ms works, too."
    )
    element: str | None = option(
        types.ELEMENT,
        default=None,
        metavar="NAME",
        help="Name of the custom element, with a hyphen in it.",
        default_text="the name of the file, with -states",
    )
    precision: int | None = option(
        types.whole(0, 10),
        default=None,
        help="Decimal places of coordinates.",
        default_text="by the size of the drawings",
    )


REPORTED = (
    "frames ends output emit force select_a select_b lenient place vertices start pins reverse stiff match unmatched "
    "solver band effort preset ks kb es eb pb mb cs bending kt smoothing motion viewbox style curves precision animate "
    "duration ease repeat hold format width columns background fps report preview"
)
"""Order of the settings in reports of format 1; further settings follow."""

UNREPORTED = "max_memory"
"""Option that reports leave out: no result depends on it."""


def report_settings(*records: Record) -> dict[str, Any]:
    """Return the values of records as the report lists them."""
    values = {key: value for record in records for key, value in record.listed.items()}
    values["start"] = values["start"] or "auto"
    return {key: values[key] for key in (*REPORTED.split(), *values) if key in values and key != UNREPORTED}
