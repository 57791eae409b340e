"""The documents: their pages, the code they show, and the commands among it."""

from __future__ import annotations

import re
import shlex
import shutil
from functools import cache
from pathlib import Path
from typing import NamedTuple

from shapeblend_cli.cli import shapeblend
from tests.support.drawings import svg

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


STAND_INS = {
    "samples/triangle": "a light hen off/wifi walk-1 icons/1 icons/arrow-1 1 menu coast-1900",
    "samples/square": "b bold pecking on/wifi walk-2 icons/2 icons/arrow-2 2 cross close stop coast-2000",
    "samples/step-1": "c oblique icons/3 3",
    "samples/e": "e",
    "samples/f": "f",
    "samples/play": "play",
    "samples/pause": "pause",
    **{
        f"docs/moving/drawings/{name}": name
        for name in "fox wolf cat-face dog-face egg hatching-chick tulip sunflower checked-disc ringed-heart".split()
    },
    **{f"docs/studio/{path.stem}": path.stem for path in (ROOT / "docs" / "studio").glob("*.svg")},
}
"""Drawings of the repository, and what pages call drawings for which they are taken."""

BLOT = "M{0} 20h40v40h-40z"
SEVERAL = {
    "A": svg(
        BLOT.format(10), f'<path id="left" d="{BLOT.format(100)}"/>', BLOT.format(55), viewbox="0 0 200 100"
    ),
    "B": svg(
        f'<path id="right" d="{BLOT.format(10)}"/>',
        f'<g class="birds"><path d="{BLOT.format(90)}"/></g>',
        BLOT.format(140),
        viewbox="0 0 200 100",
    ),
    "drawing": svg('<path id="low" d="M0 0h9v9z"/>', '<path id="high" d="M9 9h9v9z"/>'),
}
"""Drawings of several shapes, as commands name places, numbers, classes and ids in them."""
SEVERAL |= {"C": SEVERAL["B"], "on": SEVERAL["A"], "off": SEVERAL["B"]}


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


def without_code(text: str) -> str:
    """Return a page without its blocks of code."""
    return FENCE.sub("", text)


@cache
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
        text = without_code(page.read_text("utf-8"))
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


def furnish() -> None:
    """Put all that commands name into the working folder."""
    for source, targets in STAND_INS.items():
        for target in targets.split():
            Path(target).parent.mkdir(exist_ok=True)
            shutil.copy(ROOT / f"{source}.svg", f"{target}.svg")
    for name, text in SEVERAL.items():
        Path(f"{name}.svg").write_text(text, "utf-8")
    Path("samples").symlink_to(ROOT / "samples")
    for folder in ("before", "after"):
        Path(folder).mkdir()
        for number, sample in enumerate(("e", "f", "f")):
            shutil.copy(ROOT / "samples" / f"{sample}.svg", f"{folder}/frame-{number}.svg")
    for name, words in (("jobs.csv", "a,b,o,"), ("jobs.jsonl", '"frames": 9')):
        Path(name).write_text(block("docs/batch.md", words), "utf-8")
    Path("blend.json").write_text(block("docs/studio.md", '"files"'), "utf-8")
