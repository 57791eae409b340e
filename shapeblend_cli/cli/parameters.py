"""Options of the command line, made from the fields of records."""

from __future__ import annotations

from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import click

from shapeblend_cli.errors import InputError
from shapeblend_cli.options.types import FLAG, FieldType

if TYPE_CHECKING:
    from collections.abc import Container, Mapping

    from click.shell_completion import CompletionItem

    from shapeblend_cli.options.fields import Option, Record


NAME = click.Path(readable=False)
"""Name of a file to read. It is checked when it is read, so that every error has the same form."""

ABOUT_FRAMES = ("frames", "ends", "times", "mix", "curves", "ease", "stagger", "stagger_by", "timing")
"""Settings that change no correspondence, for commands that draw no frames."""


class FieldText(click.ParamType):  # type: ignore[type-arg]  # generic only in newer releases
    """Text that stands for the value of a field."""

    name = "text"

    def __init__(self, kind: FieldType) -> None:
        self.kind = kind

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """Read a value; an error names the option and says what would work."""
        try:
            return self.kind.parse(value)
        except InputError:
            raise
        except ValueError as error:
            name = documented(param) if param else ""
            if ctx is not None and any(value in other.opts for other in ctx.command.params):
                takes = param.metavar if param else ""
                raise click.UsageError(f"{name} takes a value, {takes}, before {value}", ctx) from None
            raise click.UsageError(f"{name} {error}", ctx) from None

    def shell_complete(
        self, ctx: click.Context, param: click.Parameter, incomplete: str
    ) -> list[CompletionItem]:
        """Offer the words that a value may be, or files."""
        from click.shell_completion import CompletionItem

        if self.kind.is_file or self.kind.is_read:
            return [CompletionItem(incomplete, type="file")]
        return [CompletionItem(word) for word in self.kind.choices if word.startswith(incomplete)]


def documented(param: click.Parameter) -> str:
    """Return the name of an option that documents have: the last of several long ones."""
    return max(reversed(param.opts), key=lambda name: name.startswith("--"))


class FieldOption(click.Option):
    """An option made from a field. Its value is None, or for a repeatable one empty, where it is not given.

    A file to write can be named once: of two, only one would be written.
    """

    def __init__(self, field: Option) -> None:
        value: dict[str, Any] = {"is_flag": True}
        if field.kind is not FLAG:
            # Where several words make a value, the record alone checks it.
            kind = FieldText(field.kind) if field.kind.words == 1 else NAME
            value = {
                "type": kind,
                "metavar": field.metavar,
                "multiple": field.many or field.kind.is_file,
                "nargs": field.kind.words,
            }
            if field.kind.is_file and not field.many:
                value["callback"] = _only
        super().__init__([*field.flags, field.name], help=field.full_help, default=None, **value)
        self.section = field.section


def _only(_: click.Context, param: click.Parameter, values: tuple[str, ...]) -> str | None:
    """Return the one value of an option that may be given several times, but not with several values."""
    named = list(dict.fromkeys(values))
    if len(named) > 1:
        given = f"{documented(param)} is given twice, {named[0]} and {named[1]}"
        raise click.UsageError(f"{given}; a run for each of them would work")
    return named[0] if named else None


def options_of(
    *records: type[Record], without: Container[str] = (), helps: Mapping[str, str] = MappingProxyType({})
) -> list[FieldOption]:
    """Make the options of records, but for some fields; some have another help, with their default."""
    options = [FieldOption(field) for record in records for field in record.options.values()]
    for option in options:
        option.help = helps.get(str(option.name), option.help)
    return [option for option in options if option.name not in without]
