"""Markdown: the sections of docs/quality.md, its short table, and the shorter one of the README."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

BEGIN = "<!-- figures: written by make bench-quality -->"
END = "<!-- end of figures -->"

NONE = "–"
"""Stands where there is nothing to measure."""


class Table(NamedTuple):
    """Cells as text."""

    header: Sequence[str]
    rows: Sequence[Sequence[str]]

    def markdown(self) -> str:
        lines = [self.header, ["---"] * len(self.header), *self.rows]
        return "".join(f"| {' | '.join(line)} |\n" for line in lines)


class Brief(NamedTuple):
    """A row of the short table.

    Attributes
    ----------
    name : str
    cells : mapping
        A cell for each tool, by name.
    front : str
        What the README calls it, in plainer words; nothing if it is not in the README.
    """

    name: str
    cells: Mapping[str, str]
    front: str = ""


class Section(NamedTuple):
    """One measure, and what the short table says of it."""

    title: str
    text: str
    table: Table
    brief: Sequence[Brief] = ()

    def markdown(self) -> str:
        return f"## {self.title}\n\n{self.text}\n\n{self.table.markdown()}"


def share(conditions: Iterable[bool]) -> str:
    """Return how many of them hold, to three digits."""
    return f"{100 * np.mean(list(conditions)):.3g} %"


def short(sections: Sequence[Section], tools: Sequence[str]) -> str:
    """Return what docs/quality.md begins with; further lines in which no tool does wrong are left out."""
    rows = [_row(brief.name, brief, tools) for section in sections for brief in section.brief]
    return _marked(
        [row for row in rows if not row[0].startswith("...") or set(row[1:]) - {"0 %", NONE}], tools
    )


def front(sections: Sequence[Section], tools: Sequence[str]) -> str:
    """Return the table of the README."""
    briefs = [brief for section in sections for brief in section.brief]
    return _marked([_row(brief.front, brief, tools) for brief in briefs if brief.front], tools)


def _row(name: str, brief: Brief, tools: Sequence[str]) -> list[str]:
    return [name, *(brief.cells.get(tool, NONE) for tool in tools)]


def _marked(rows: list[list[str]], tools: Sequence[str]) -> str:
    return f"{BEGIN}\n\n{Table(['', *tools], rows).markdown()}\n{END}"


def document(sections: Sequence[Section], tools: Sequence[str]) -> str:
    """Return the text of docs/quality.md."""
    written = (
        "Written by `make bench-quality`, from the scores of all pairs in [quality.json](quality.json).\n"
    )
    parts = ["# shapeblend beside other tools\n", written, f"{short(sections, tools)}\n"]
    return "\n".join([*parts, *(section.markdown() for section in sections)])


def with_figures(text: str, figures: str, first: str = BEGIN, last: str = END) -> str:
    """Return a text with what is between two marks replaced."""
    before, begin, rest = text.partition(first)
    _, end, after = rest.partition(last)
    if not (begin and end):
        raise ValueError(f"no place for figures: it begins with {first} and ends with {last}")
    return before + figures + after
