"""How commands are found, and how their help is laid out."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator, Mapping
from importlib import import_module
from typing import TYPE_CHECKING, Any

import click

from shapeblend_cli.options.settings import OTHER, SECTIONS

if TYPE_CHECKING:
    from collections.abc import Sequence

    from click.shell_completion import CompletionItem

TYPED = "shapeblend_cli.typed"
"""Key in the `meta` of a context: the arguments as they were typed, after the name of the command."""

NAMES = 30
"""Width of the column of option names, in characters. It is the same in every section."""


MEANT = {
    "--output": "out outfile output-file dest target",
    "--frames": "steps count number in-betweens",
    "--duration": "time length speed seconds",
    "--hold": "pause rest dwell",
    "--delay": "wait begin start-delay",
    "--repeat": "looping iterations times-played",
    "--repeat pingpong": "reverse-loop pingpong yoyo alternate boomerang",
    "--ease": "timing-function curve spring bounce overshoot cubic-bezier",
    "--force": "overwrite replace yes",
    "--width": "size resolution scale",
    "--background": "bg colour color",
    "--background transparent": "transparent alpha",
    "--pin": "point points anchor",
    "--match": "pair pairs map mapping",
    "--motion": "interpolate interpolation method",
    "--preview": "open show view browser",
    "--quiet": "silent",
    "--output NAME.gif": "gif",
    "--output NAME.mp4": "video mp4",
    "--output NAME.png": "png sprite contact-sheet",
    "--output NAME.svg": "svg animation animated-svg smil",
    "--output NAME.js": "js javascript react vue svelte component web",
    "--stagger": "sequence cascade one-by-one",
    "--select-a": "select only",
    "--emit lottie": "lottie json",
    "--trigger hover": "hover",
    "--trigger click": "click",
    "--vertices": "samples points-per-shape segments",
}
"""Options, and what people who do not know them type for them."""


def in_other_words(error: click.NoSuchOption, command: click.Command) -> str:
    """Return the message of an unknown option, with the option of the command that it means if that is known."""
    name = error.option_name.lstrip("-").lower().replace("_", "-")
    meant = [option for option, words in MEANT.items() if name in words.split()]
    if not meant:
        from difflib import get_close_matches

        known = {
            each.lstrip("-") for param in command.params for each in (*param.opts, *param.secondary_opts)
        }
        meant = [f"--{near}" for near in get_close_matches(name, sorted({*known, "help", "version"}), 1, 0.7)]
    return f"No such option '{error.option_name}'" + (f". Did you mean '{meant[0]}'?" if meant else "")


def with_value(error: click.BadOptionUsage, command: click.Command) -> str:
    """Return the message of an option without its value, with what that has to be."""
    found = [option for option in command.params if error.option_name in option.opts]
    takes = f" '{error.option_name} {found[0].metavar}' would work." if found and found[0].metavar else ""
    return error.format_message() + takes


def as_typed(message: str, arguments: Sequence[str], command: click.Command) -> str:
    """Return a message that names options as they were typed, where they have another long name in it.

    Examples
    --------
    >>> loop = click.Option(["--loop", "--repeat"])
    >>> as_typed("--repeat is for animations", ["--loop=3"], click.Command("blend", params=[loop]))
    '--loop is for animations'
    """
    typed = {argument.partition("=")[0] for argument in arguments}
    for names in ([name for name in param.opts if name.startswith("--")] for param in command.params):
        for name in names[:-1] if not typed & {*names[-1:]} else ():
            if name in typed:
                message = re.sub(rf"{names[-1]}(?![\w-])", name, message)
    return message


def command_of(arguments: Sequence[str], group: click.Group, default: str) -> tuple[str, click.Command]:
    """Return the command that arguments name, as it is typed, or the default one of a group, as nobody types it."""
    if not arguments or arguments[0] not in group.commands:
        return "shapeblend", group.commands[default]
    words, command = ["shapeblend", arguments[0]], group.commands[arguments[0]]
    if isinstance(command, click.Group) and arguments[1:] and arguments[1] in command.commands:
        words, command = [*words, arguments[1]], command.commands[arguments[1]]
    return " ".join(words), command


class SectionedCommand(click.Command):
    """A command whose help lists examples, pairs of a command line and its effect, and options by section."""

    def __init__(self, *args: Any, examples: Sequence[tuple[str, str]] = (), **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self.examples = examples

    def format_options(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write the examples, then one section after another."""
        if self.examples:
            with formatter.section("Examples"):
                formatter.write_dl(self.examples)
        sections: dict[str, list[tuple[str, str]]] = {}
        for option in self.get_params(ctx):
            record = option.get_help_record(ctx) if isinstance(option, click.Option) else None
            if record:
                rows = sections.setdefault(getattr(option, "section", OTHER), [])
                rows.append((record[0].ljust(NAMES), record[1]))
        for title in sorted(sections, key=SECTIONS.index):
            with formatter.section(title):
                formatter.write_dl(sections[title])


class Commands(Mapping[str, click.Command]):
    """Commands by name, each in a module of its name in this package, which is loaded when the command is asked for."""

    def __init__(self, *names: str) -> None:
        self._names = names

    def __getitem__(self, name: str) -> click.Command:
        """Load a command."""
        if name not in self._names:
            raise KeyError(name)
        command: click.Command = getattr(import_module(f"{__package__}.{name}"), name)
        return command

    def __iter__(self) -> Iterator[str]:
        """Yield the names."""
        return iter(self._names)

    def __len__(self) -> int:
        """Count the commands."""
        return len(self._names)


class DefaultGroup(click.Group):
    """A group that blends when no command is named, and has the help of blending."""

    default = "blend"

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Put the default command in front of arguments that name none."""
        is_first_word = ctx.resilient_parsing and not args  # a shell asks for completions of it
        if not is_first_word and (not args or args[0] not in (*self.commands, "-h", "--help", "--version")):
            self._refuse_misspelt(args)
            args = [self.default, *args]
        ctx.meta[TYPED] = args[1:]
        return super().parse_args(ctx, args)

    def _refuse_misspelt(self, args: Sequence[str]) -> None:
        """Raise UsageError where the first word is no file, and almost a command."""
        word = args[0] if args else ""
        if word == "help" and not os.path.exists(word):
            raise click.UsageError("No such command or file 'help'. Did you mean the option '--help'?")
        if not word.isalpha() or os.path.exists(word):
            return
        from difflib import get_close_matches

        near = get_close_matches(word.lower(), self.commands, 1, 0.7)
        if near:
            raise click.UsageError(f"No such command or file '{word}'. Did you mean the command '{near[0]}'?")
        if {"-h", "--help"} & {*args}:
            raise click.UsageError(f"No such command or file '{word}'")

    def shell_complete(self, ctx: click.Context, incomplete: str) -> list[CompletionItem]:
        """Offer commands, and the beginnings of the default command, such as a file."""
        from click.shell_completion import CompletionItem

        default = self.commands[self.default]
        items = super().shell_complete(ctx, incomplete)
        items += default.shell_complete(click.Context(default, parent=ctx), incomplete)
        if not incomplete.startswith("-"):
            items.append(CompletionItem(incomplete, type="file"))
        return items

    def format_help(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write the default command's help, and the other commands."""
        default = self.commands[self.default]
        formatter.write_usage(ctx.command_path, "A.svg B.svg [C.svg ...] [OPTIONS]")
        default.format_help_text(ctx, formatter)
        default.format_options(ctx, formatter)
        others = [(n, c.get_short_help_str(80)) for n, c in self.commands.items() if n != self.default]
        with formatter.section("Commands"):
            formatter.write_dl(others)
