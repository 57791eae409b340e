"""The command line: each command reads its options, makes one call, and prints.

Nothing heavy is imported before it is needed: ``--help`` and usage errors need neither numpy nor svgpathtools.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence

import click

from shapeblend_cli.cli.blend import blend
from shapeblend_cli.cli.completion import completion
from shapeblend_cli.cli.group import DefaultGroup
from shapeblend_cli.cli.inspect import inspect
from shapeblend_cli.cli.plot import plot
from shapeblend_cli.cli.terminal import Terminal
from shapeblend_cli.errors import OptionError, ShapeblendError
from shapeblend_cli.version import __version__

FAILED, USAGE = 1, 2


@click.group(
    cls=DefaultGroup,
    commands=[blend, inspect, plot, completion],
    context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100},
)
@click.version_option(__version__, prog_name="shapeblend", message="%(prog)s %(version)s")
def shapeblend() -> None:
    """Blend one SVG drawing into another."""


def run(arguments: Sequence[str]) -> int:
    """Run a command line; an error is one line on standard error.

    Return the exit status: 0 done, 1 the input or the run failed, 2 the command line is wrong.
    """
    note = Terminal().note
    try:
        shapeblend.main(list(arguments), prog_name="shapeblend", standalone_mode=False)
    except click.ClickException as error:
        note(f"{' '.join(error.format_message().split())} (shapeblend --help lists the options)")
        return USAGE
    except OptionError as error:
        note(f"{error} (shapeblend --help lists the options)")
        return USAGE
    except click.Abort:
        note("interrupted; nothing was written")
        return FAILED
    except ShapeblendError as error:
        note(" ".join(str(error).split()))
        return FAILED
    except BrokenPipeError:
        sys.stderr.close()  # whatever read our output is gone, and needs to be told nothing
        return FAILED
    except MemoryError:
        note("not enough memory for contours of so many vertices; a smaller --vertices would help")
        return FAILED
    return 0
