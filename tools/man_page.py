"""Write the manual page, share/man/man1/shapeblend.1, from the commands and their options: part of `make options`."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

import click

from shapeblend_cli.cli import shapeblend
from shapeblend_cli.cli.group import SectionedCommand
from shapeblend_cli.options.settings import OTHER, SECTIONS
from shapeblend_cli.version import __version__
from tools.quality.data import ROOT

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

PAGE = ROOT / "share" / "man" / "man1" / "shapeblend.1"

NAME = "blend one SVG drawing into another"

STATUS = (
    ("0", "Done."),
    (
        "1",
        "The input or the run failed, or took more time or memory than it may. Nothing was written.",
    ),
    ("2", "The command line is wrong."),
)


def page() -> str:
    """Return the page, in the language of man."""
    context = click.Context(shapeblend, info_name="shapeblend")
    blend = shapeblend.commands[shapeblend.default]
    lines = [
        f'.TH SHAPEBLEND 1 "" "shapeblend {__version__}" "User Commands"',
        ".SH NAME",
        rf"shapeblend \- {NAME}",
        ".SH SYNOPSIS",
        r".B shapeblend",
        r".I A.svg B.svg",
        r"[\fIC.svg\fR ...] [\fIoptions\fR]",
    ]
    others = {name: command for name, command in shapeblend.commands.items() if command is not blend}
    for name in others:
        lines += [".br", rf"\fBshapeblend {name}\fR ..."]
    lines += [
        ".SH DESCRIPTION",
        *_prose(blend),
        *_examples(blend),
        ".SH OPTIONS",
        *_options(blend, context, ()),
    ]
    known = [param.name or "" for param in blend.params]
    lines += [
        ".SH COMMANDS",
        "Each command has its own",
        r".BR \-\-help .",
        "Options that it shares with a blend are above.",
    ]
    for name, command in others.items():
        lines += _command(f"shapeblend {name}", command, context, known)
    lines += [".SH EXIT STATUS"]
    for status, words in STATUS:
        lines += [".TP", rf"\fB{status}\fR", words]
    lines += [".SH SEE ALSO", r".BR inkscape (1),", r".BR rsvg\-convert (1),", r".BR ffmpeg (1)"]
    return "\n".join(lines) + "\n"


def _command(name: str, command: click.Command, parent: click.Context, known: Sequence[str]) -> Iterator[str]:
    """Yield what a command does, and those of its options that a blend does not have."""
    context = click.Context(command, info_name=name.rpartition(" ")[2], parent=parent)
    usage = " ".join(piece for piece in command.collect_usage_pieces(context) if piece != "[OPTIONS]")
    yield f".SS {_escaped(f'{name} {usage}')}"
    yield from _prose(command)
    yield from _examples(command)
    yield from _options(command, context, known)
    if isinstance(command, click.Group):
        for each, found in command.commands.items():
            yield from _command(f"{name} {each}", found, context, known)


def _prose(command: click.Command) -> Iterator[str]:
    text = re.sub(r"\n?\f.*", "", command.help or "", flags=re.DOTALL)
    for k, paragraph in enumerate(re.split(r"\n\s*\n", text.strip())):
        if k:
            yield ".PP"
        yield _escaped(" ".join(paragraph.replace("\b", "").split()))


def _examples(command: click.Command) -> Iterator[str]:
    if isinstance(command, SectionedCommand) and command.examples:
        yield ".PP"
        for line, words in command.examples:
            yield from (".TP", rf"\fB{_escaped(line)}\fR", _escaped(f"{words[:1].upper()}{words[1:]}."))


def _options(command: click.Command, context: click.Context, known: Sequence[str]) -> Iterator[str]:
    """Yield options, section after section in the order of help, but for those that are known already."""
    sections: dict[str, list[tuple[str, str]]] = {}
    for param in command.get_params(context):
        record = param.get_help_record(context) if isinstance(param, click.Option) else None
        if record and param.name not in known:
            # click keeps the option of the first context that asked for it, perhaps one that knows no -h.
            names = "-h, --help" if "--help" in param.opts else record[0]
            sections.setdefault(getattr(param, "section", OTHER), []).append((names, record[1]))
    for title in sorted(sections, key=SECTIONS.index):
        if not known:
            yield f".SS {_escaped(title)}"
        for names, words in sections[title]:
            yield from (".TP", rf"\fB{_escaped(names)}\fR", _escaped(words))


def _escaped(text: str) -> str:
    """Return text that man shows as it is."""
    text = text.replace("\\", r"\e").replace("-", r"\-")
    return re.sub(r"^(?=[.'])", r"\\&", " ".join(text.split()))


def main() -> None:
    PAGE.parent.mkdir(parents=True, exist_ok=True)
    PAGE.write_text(page(), encoding="utf-8")


if __name__ == "__main__":
    main()
