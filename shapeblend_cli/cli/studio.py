"""``shapeblend studio``."""

from __future__ import annotations

import os
import shlex
import sys
import threading
from typing import Any

import click

from shapeblend_cli.cli.blend import opened
from shapeblend_cli.cli.group import SectionedCommand
from shapeblend_cli.cli.parameters import NAME, options_of
from shapeblend_cli.errors import InputError
from shapeblend_cli.job.job import RECORDS, STANDARD_INPUT
from shapeblend_cli.job.options import REPORT_TO_FILE
from shapeblend_cli.options import types
from shapeblend_cli.options.fields import Record, option
from shapeblend_cli.options.settings import STUDIO
from shapeblend_cli.system.interrupts import told

EXAMPLES = (
    ("shapeblend studio a.svg b.svg", "look at the blend, and correct it by hand"),
    ("shapeblend studio blend.json", "go on with a project"),
    ("shapeblend studio", "an empty page to drop drawings into"),
)

PATIENCE = 600.0
"""Number of seconds without a sign of the page after which it is taken for closed. A page in the background gives one
every minute."""

HELPS = {
    "report": REPORT_TO_FILE,
    "timeout": "Stop a blend after S seconds, and the writing of files after ten times as long.  [default: 60]",
    "max_memory": "Stop a blend that takes more than MB megabytes of memory.  [default: 2000]",
}


class StudioOptions(Record, section=STUDIO):
    """How the studio is opened."""

    port: int | None = option(
        types.whole(1, 65_535), default=None, help="Port of the page.", default_text="a free one"
    )
    open: bool = option(
        types.FLAG,
        default=True,
        flags=("--open/--no-open",),
        help="Open the page in the browser, or only print its address.",
        default_text="open, if there is a screen",
    )
    until_closed: bool = option(
        types.FLAG,
        default=False,
        help="End by itself ten minutes after the page was closed, for programs that start a studio.",
    )


@click.command(
    cls=SectionedCommand,
    examples=EXAMPLES,
    params=options_of(StudioOptions, *RECORDS, without=("force",), helps=HELPS),
)
@click.argument("files", type=NAME, nargs=-1, metavar="[A.svg B.svg ...]")
def studio(files: tuple[str, ...], **given: Any) -> None:
    """Correct a blend by hand in the browser.

    Pair parts, pin points, choose among other blends, and export. The page is served to this machine only, and loads
    nothing from elsewhere. It shows the command line that does the same, and saves projects that the command takes.
    Options are those of a blend. Ctrl-C ends the studio.
    """
    options = StudioOptions.of(given)
    named_first = files[0] if files else ""
    files, given = opened(files, given)
    _check(files)
    named = {name for record in RECORDS for name in record.options}
    beside = {name: value for name, value in given.items() if name in named and value not in (None, ())}

    from shapeblend_cli.outputs.registry import DEFAULT
    from shapeblend_cli.rows import is_project
    from shapeblend_cli.rows.project import Project
    from shapeblend_cli.studio.server import Studio
    from shapeblend_cli.studio.session import Session

    folder = os.path.dirname(named_first) if is_project(named_first) else ""
    if not (is_project(named_first) or {"output", "emit", "format"} & beside.keys()):
        beside["output"] = f"{DEFAULT}.svg"  # what is seen: a blend that moves
    session = Session(Project(files, beside), folder)
    try:
        server = Studio(session, options.port or 0)
    except OSError as error:
        raise click.ClickException(
            f"port {options.port}: {error.strerror}; without --port a free port is found"
        ) from None
    session.start()
    ended = threading.Event()
    with told(lambda number: ended.set()):
        threading.Thread(target=server.serve_forever, args=(0.05,), daemon=True).start()
        click.echo(f"The studio is at {server.address}")
        click.echo("Ctrl-C ends it.")
        sys.stdout.flush()
        if options.open and _has_browser():
            import webbrowser

            webbrowser.open(server.address)
        while not ended.wait(0.2):
            if options.until_closed and server.quiet_for > PATIENCE:
                break
    if not session.is_saved:
        click.echo(f"What was not saved: {shlex.join(session.project.command)}")
    server.shutdown()
    server.server_close()
    session.stop()


def _check(files: tuple[str, ...]) -> None:
    """Refuse files that cannot be read, before anything is opened. The page tells of faults in their contents."""
    for file in files:
        if file == STANDARD_INPUT:
            raise click.UsageError("the studio takes files, not standard input")
        try:
            with open(file, "rb"):
                pass
        except (OSError, ValueError) as error:
            reason = getattr(error, "strerror", None) or error
            raise InputError(file, f"cannot be read ({reason}); a readable SVG file would work") from None


def _has_browser() -> bool:
    """Return whether there is a screen, as browsers in a terminal would not show the page."""
    return (
        os.name == "nt"
        or sys.platform == "darwin"
        or any(map(os.environ.get, ("DISPLAY", "WAYLAND_DISPLAY")))
    )
