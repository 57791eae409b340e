"""``shapeblend inkscape``: the extension for Inkscape, and the commands that it calls."""

from __future__ import annotations

import os
import subprocess
import sys
from typing import Any

import click

from shapeblend_cli.cli.group import SectionedCommand
from shapeblend_cli.cli.parameters import NAME, options_of
from shapeblend_cli.cli.terminal import say
from shapeblend_cli.errors import OptionError
from shapeblend_cli.inkscape.options import InkscapeOptions, InstallOptions
from shapeblend_cli.job.options import WriteOptions
from shapeblend_cli.options.settings import Settings
from shapeblend_cli.outputs.formats import STANDARD_OUTPUT
from shapeblend_cli.outputs.options import OutputOptions, specify

PLACED = ("place", "viewbox", "start")
"""Settings that objects of one document have no use for: they stay in place, and are joined at no vertex."""


@click.group()
def inkscape() -> None:
    """Add an extension to Inkscape that blends selected objects."""


@inkscape.command(cls=SectionedCommand, params=options_of(InstallOptions))
def install(**given: Any) -> None:
    """Put the extension into the folder where Inkscape looks for it.

    Restart Inkscape to get Extensions > Shapeblend. Run this again if shapeblend moves to another folder.
    """
    from shapeblend_cli.inkscape.extension import install as install_into

    files = install_into(InstallOptions.of(given).folder)
    say(
        f"{files[0].parent}: the extension is installed; restart Inkscape, and look under Extensions > Shapeblend"
    )


@inkscape.command(
    cls=SectionedCommand, params=options_of(InkscapeOptions, Settings, without=(*PLACED, "match"))
)
@click.argument("file", type=NAME, metavar="FILE")
def blend(file: str, **given: Any) -> None:
    """Print an Inkscape document with in-betweens of two objects. The extension calls this.

    Two dots or a line labelled "pin 1" are a pin: a point of one object that becomes a point of the other. Parts of
    both that are labelled "pair 1" become each other.
    """
    options, settings = InkscapeOptions.of(given), Settings.of(given)
    if not (settings.frames or settings.ends):
        raise OptionError("--frames 0 leaves nothing to put between the objects; --frames 1 would work")

    from shapeblend_cli.inkscape.objects import blend_objects

    as_layers = options.frames_as == "layers"
    _print(blend_objects(file, options.ids, settings, as_layers=as_layers, note=_noter()))


@inkscape.command(
    cls=SectionedCommand,
    params=options_of(
        InkscapeOptions,
        OutputOptions,
        Settings,
        WriteOptions,
        without=(*PLACED, *"frames_as match report preview tries fail_on".split()),
    ),
)
@click.argument("file", type=NAME, metavar="FILE")
def animate(file: str, **given: Any) -> None:
    """Write an animation from object to object of an Inkscape document. The extension calls this.

    The document itself is printed unchanged.
    """
    options = InkscapeOptions.of(given)
    if given["output"] is None:
        raise OptionError("an animation needs the name of a file, such as --output moving.svg")
    output = specify(OutputOptions.of(given), Settings.of(given), max(2, len(options.ids)))
    if output.path == STANDARD_OUTPUT:
        raise OptionError("standard output is for the document; --output with the name of a file would work")

    from shapeblend_cli.inkscape.objects import animate_objects

    force = WriteOptions.of(given).force
    _print(animate_objects(file, options.ids, output, force=force, note=_noter()))


@inkscape.command(cls=SectionedCommand, params=options_of(InkscapeOptions, without=("frames_as",)))
@click.argument("file", type=NAME, metavar="FILE")
def studio(file: str, **given: Any) -> None:
    """Open objects of an Inkscape document in the studio. The extension calls this.

    The document itself is printed unchanged. The studio goes on by itself, and ends some time after its page is closed.
    """
    from shapeblend_cli.inkscape.objects import open_objects

    words, document = open_objects(file, InkscapeOptions.of(given).ids, _noter())
    subprocess.Popen(
        [sys.executable, "-m", "shapeblend_cli", "studio", *words, "--place", "asis", "--until-closed"],
        cwd=os.path.dirname(words[0]),
        stdin=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        start_new_session=True,
    )
    _print(document)


def _noter() -> Any:
    """Return a function that says each line once."""
    told: set[str] = set()

    def note(text: str) -> None:
        if text not in told:
            told.add(text)
            say(text)

    return note


def _print(document: bytes) -> None:
    sys.stdout.buffer.write(document)
    sys.stdout.flush()
