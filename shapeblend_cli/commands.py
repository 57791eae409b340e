"""How commands are found, and how their help is laid out."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from click.shell_completion import CompletionItem

TYPED = "shapeblend_cli.typed"
"""Where a context has the arguments as they were typed, the name of the default command put in front."""

NAMES = 30
"""Characters for the names of options, the same in every section."""


class SectionedCommand(click.Command):
    """A command that lists its options by what they are about.

    Parameters
    ----------
    sections : mapping of str to sequence of str
        Titles, and the names of the parameters under each. What is in none comes last.
    examples : sequence of (str, str)
        Command lines, and what they do.
    """

    def __init__(
        self,
        *args: Any,
        sections: Mapping[str, Sequence[str]],
        examples: Sequence[tuple[str, str]] = (),
        **kwargs: Any,
    ) -> None:
        super().__init__(*args, **kwargs)
        self.sections = sections
        self.examples = examples

    def format_options(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write examples, then a section after the other."""
        if self.examples:
            with formatter.section("Examples"):
                formatter.write_dl(self.examples)
        options = [param for param in self.get_params(ctx) if isinstance(param, click.Option)]
        records = {option.name: option.get_help_record(ctx) for option in options}
        named = {name for names in self.sections.values() for name in names}
        others = [name for name, record in records.items() if record and name not in named]
        for title, names in {**self.sections, "Other": others}.items():
            rows = [record for record in (records.get(name) for name in names) if record]
            if rows:
                with formatter.section(title):
                    formatter.write_dl([(name.ljust(NAMES), text) for name, text in rows])


class DefaultGroup(click.Group):
    """A group that blends when no command is named, and whose help is that of blending."""

    default = "blend"

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Put the default command in front of arguments that name none."""
        first_word = ctx.resilient_parsing and not args  # a shell asks how it may go on
        if not first_word and (not args or args[0] not in (*self.commands, "-h", "--help", "--version")):
            args = [self.default, *args]
        ctx.meta[TYPED] = args
        return super().parse_args(ctx, args)

    def shell_complete(self, ctx: click.Context, incomplete: str) -> list[CompletionItem]:
        """Offer what the first word may be: a command, or what the default one begins with, a file among it."""
        from click.shell_completion import CompletionItem

        default = self.commands[self.default]
        found = super().shell_complete(ctx, incomplete)
        found += default.shell_complete(click.Context(default, parent=ctx), incomplete)
        if not incomplete.startswith("-"):
            found.append(CompletionItem(incomplete, type="file"))
        return found

    def format_help(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write the default command's help, and what else there is."""
        default = self.commands[self.default]
        formatter.write_usage(ctx.command_path, "A.svg B.svg [C.svg ...] [OPTIONS]")
        default.format_help_text(ctx, formatter)
        default.format_options(ctx, formatter)
        others = [(n, c.get_short_help_str(80)) for n, c in self.commands.items() if n != self.default]
        with formatter.section("Commands"):
            formatter.write_dl(others)
