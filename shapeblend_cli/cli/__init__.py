"""The command line: each command reads its options, makes one call, and prints.

Nothing heavy is imported before it is needed: ``--help`` and usage errors need neither numpy nor svgpathtools.
"""

from __future__ import annotations

import os
import sys
import warnings
from collections.abc import Sequence

import click

from shapeblend_cli.cli.group import Commands, DefaultGroup, as_typed, command_of, in_other_words, with_value
from shapeblend_cli.cli.terminal import say
from shapeblend_cli.errors import OptionError, ShapeblendError, in_words
from shapeblend_cli.system.interrupts import Interrupted, listening
from shapeblend_cli.version import __version__

FAILED, USAGE = 1, 2


@click.group(
    cls=DefaultGroup,
    commands=Commands(
        "blend", "studio", "batch", "inspect", "judge", "plot", "rank", "states", "inkscape", "completion"
    ),
    context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100},
)
@click.version_option(__version__, prog_name="shapeblend", message="%(prog)s %(version)s")
def shapeblend() -> None:
    """Blend one SVG drawing into another."""


def run(arguments: Sequence[str], began: float | None = None) -> int:
    """Run a command line; an error is one line on standard error.

    `began` is the time by `perf_counter` at which a process was started for it. Return the exit status: 0 done, 1 the
    input or the run failed, 2 the command line is wrong, 128 and the number of the signal that stopped it; a command
    may return others.
    """
    try:
        with listening():
            status = shapeblend.main(
                list(arguments), prog_name="shapeblend", standalone_mode=False, obj=began
            )
            if sys.stdout is not None:
                sys.stdout.flush()
            return status or 0
    except (click.ClickException, OptionError) as error:
        _say_usage(error, arguments)
        return USAGE
    except Interrupted as error:
        say(str(error))
        return status_of(error)
    except ShapeblendError as error:
        say(str(error))
        return FAILED
    except (BrokenPipeError, SystemExit):
        return FAILED  # whatever read our output is gone, and needs to be told nothing
    except (OSError, MemoryError) as error:
        say(in_words(error))
        return FAILED


def _say_usage(error: click.ClickException | OptionError, arguments: Sequence[str]) -> None:
    """Say what is wrong with a command line, and where its options are listed."""
    typed, command = command_of(arguments, shapeblend, DefaultGroup.default)
    if isinstance(error, click.NoSuchOption):
        text = in_other_words(error, command)
    elif isinstance(error, click.exceptions.NoArgsIsHelpError) and isinstance(command, click.Group):
        *words, last = sorted(command.commands)
        text = f"{typed} takes a command: {', '.join(words)} or {last}"
    elif isinstance(error, click.BadOptionUsage):
        text = with_value(error, command)
    else:
        text = error.format_message() if isinstance(error, click.ClickException) else str(error)
    say(f"{as_typed(text, arguments, command)} ({typed} --help lists the options)")


def status_of(interrupted: Interrupted) -> int:
    """Return the exit status after a signal, as shells have it: 130 after Ctrl-C; 1 after --timeout."""
    return FAILED if interrupted.is_late else 128 + interrupted.number


def run_safely(arguments: Sequence[str], began: float | None = None) -> int:
    """Run a command line as a process of its own, which never ends with a traceback."""
    _occupy_streams()
    sys.unraisablehook = _end
    if not sys.warnoptions:
        warnings.simplefilter("ignore")  # what numpy says of numbers is nothing that a user can put right
    try:
        with listening():  # also while an error is said
            try:
                return run(arguments, began)
            except Exception as error:
                if isinstance(
                    error.__cause__, Interrupted
                ):  # Python wraps errors raised while a class is made
                    raise error.__cause__ from None
                say(in_words(error))
                return FAILED
    except Interrupted as error:
        say(str(error))
        return status_of(error)


def _occupy_streams() -> None:
    """Open standard streams that are closed, so that no file takes their numbers; printing fails as before."""
    for number in range(3):
        try:
            os.fstat(number)
        except OSError:
            os.open(os.devnull, os.O_RDONLY)
    if sys.stdout is None:
        sys.stdout = open(1, "w", encoding="utf-8", closefd=False)


def _end(unraisable: sys.UnraisableHookArgs) -> None:
    """Stop where a signal came while an object was deleted, which Python would only report."""
    if isinstance(unraisable.exc_value, Interrupted):
        say(str(unraisable.exc_value))
        os._exit(status_of(unraisable.exc_value))
