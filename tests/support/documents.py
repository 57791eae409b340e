"""The documents: their pages, the code they show, and the commands among it."""

from __future__ import annotations

import re
import shlex
from pathlib import Path
from typing import NamedTuple

from shapeblend_cli.cli import shapeblend

ROOT = Path(__file__).parents[2]
PAGES = [
    *(ROOT / name for name in ("README.md", "CONTRIBUTING.md", "SECURITY.md", "samples/README.md")),
    *sorted((ROOT / "docs").rglob("*.md")),
]
"""All but the changelog, which has what earlier versions did."""

FENCE = re.compile(r"^```(\w*)\n(.*?)^```", re.MULTILINE | re.DOTALL)
PROGRAMS = (
    "shapeblend make python pip pipx uv uvx gh man eval curl inkscape dask parallel npm apt-get".split()
)
"""What begins a command among the words in the text of a page."""


class Block(NamedTuple):
    """A block of code, and the language that it is marked as."""

    page: str
    language: str
    text: str


class Command(NamedTuple):
    """A line for a shell, and the page that shows it."""

    page: str
    line: str

    @property
    def stages(self) -> list[list[str]]:
        """The words of each command of a pipe, without comments."""
        lexer = shlex.shlex(self.line, posix=True, punctuation_chars="|&")
        lexer.whitespace_split = True
        found: list[list[str]] = [[]]
        for word in lexer:
            if word in ("|", "&&"):
                found.append([])
            else:
                found[-1].append(word)
        return found


def page_name(page: Path) -> str:
    return page.relative_to(ROOT).as_posix()


def blocks() -> list[Block]:
    """Every fenced block of code of the documents."""
    return [
        Block(page_name(page), *found) for page in PAGES for found in FENCE.findall(page.read_text("utf-8"))
    ]


def block(page: str, words: str) -> str:
    """The one block of a page that has some words."""
    (found,) = [block.text for block in blocks() if block.page == page and words in block.text]
    return found


def commands() -> list[Command]:
    """Every command of the documents and of the examples in the help, each line once."""
    found = [
        Command(block.page, line)
        for block in blocks()
        if block.language == "sh"
        for line in _lines(block.text)
    ]
    for page in PAGES:
        text = FENCE.sub("", page.read_text("utf-8"))
        lines = re.findall(r"^    (shapeblend .*)$", text, re.MULTILINE)
        lines += [code for code in re.findall(r"`([^`\n]+)`", text) if _is_command(code)]
        found += [Command(page_name(page), line) for line in lines]
    for name, command in shapeblend.commands.items():
        found += [Command(f"{name} --help", line) for line, _ in getattr(command, "examples", ())]
    once: dict[tuple[str, ...], Command] = {}
    for command in found:
        once.setdefault(tuple(word for stage in command.stages for word in stage), command)
    return list(once.values())


def _is_command(code: str) -> bool:
    """Return whether code in a text is a command, and no mere name: `shapeblend batch`, `shapeblend --output`."""
    program, *words = code.split()
    options = {name for p in shapeblend.commands[shapeblend.default].params for name in p.opts}
    is_name = program == "shapeblend" and len(words) == 1 and words[0] in {*shapeblend.commands, *options}
    return program in PROGRAMS and bool(words) and not is_name


def _lines(text: str) -> list[str]:
    """The commands of a block: a line each, or several that a backslash joins."""
    lines = text.replace("\\\n", " ").splitlines()
    return [line for line in lines if line.strip() and not line.startswith("#")]
