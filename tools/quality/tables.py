"""Markdown: sections of docs/quality.md, its short table, and the shorter one of the README."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

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


class Section(NamedTuple):
    """One measure.

    Attributes
    ----------
    title, text : str
    table : Table
    brief : sequence of (str, dict)
        What the short table says of it: a row's name, and a cell for each tool, by name.
    """

    title: str
    text: str
    table: Table
    brief: Sequence[tuple[str, dict[str, str]]]

    def markdown(self) -> str:
        return f"## {self.title}\n\n{self.text}\n\n{self.table.markdown()}"


def share(conditions: Iterable[bool]) -> str:
    """How many of them hold, to three digits."""
    return f"{100 * np.mean(list(conditions)):.3g} %"


def short(sections: Sequence[Section], tools: Sequence[str], missing: Sequence[str]) -> str:
    """What docs/quality.md begins with; further lines in which no tool does wrong are left out."""
    rows = [
        [name, *(cells.get(tool, NONE) for tool in tools)]
        for section in sections
        for name, cells in section.brief
    ]
    told = [row for row in rows if not row[0].startswith("...") or set(row[1:]) - {"0 %", NONE}]
    lines = "".join(f"\nNot measured: {line}.\n" for line in missing)
    return f"{BEGIN}\n\n{Table(['', *tools], told).markdown()}{lines}\n{END}"


FRONT = (
    (
        "Letters",
        "misses of the designer's",
        0,
        "Letters half way: area that differs from what the designer drew",
    ),
    ("Letters", "cut in two", 0, "... if one letter has extra points on its outline"),
    ("Letters", "corners kept", 0, "Letters half way: corners kept"),
    ("Limbs and morphs", "limbs turned", 0, "Limbs that swing: how far points are off along the outline"),
    ("Crossings and area", "crosses itself", 0, "Icons that cross themselves on the way"),
    ("Crossings and area", "left out", -1, "Icons with several outlines that lose some"),
    ("Segments and bytes", "segments", 0, "Lines and curves in an icon half way"),
    ("Time", "time of a whole command", 0, "Processor time of one blend, compared with flubber"),
    ("Time", "many in one run", 0, "... of each blend in a run of many"),
)
"""What the README says of tools: of the lines of a section that the short table has, those that have some words in
their names, which of these, and plainer words."""


def front(sections: Sequence[Section], tools: Sequence[str], missing: Sequence[str]) -> str:
    """Return the table of the README."""
    briefs = {section.title: section.brief for section in sections}
    rows = []
    for title, meant, which, words in FRONT:
        if lines := [cells for name, cells in briefs.get(title, ()) if meant in name]:
            rows.append([words, *(lines[which].get(tool, NONE) for tool in tools)])
    lines = "".join(f"\nNot measured: {line}.\n" for line in missing)
    return f"{BEGIN}\n\n{Table(['', *tools], rows).markdown()}{lines}\n{END}"


def document(short_table: str, sections: Sequence[Section]) -> str:
    """The text of docs/quality.md."""
    written = (
        "Written by `make bench-quality`, from the scores of all pairs in [quality.json](quality.json).\n"
    )
    parts = ["# shapeblend beside other tools\n", written, f"{short_table}\n"]
    return "\n".join([*parts, *(section.markdown() for section in sections)])


def with_figures(text: str, short_table: str, first: str = BEGIN, last: str = END) -> str:
    """A text with the figures between two marks replaced."""
    before, begin, rest = text.partition(first)
    _, end, after = rest.partition(last)
    if not (begin and end):
        raise ValueError(f"no place for figures: it begins with {first} and ends with {last}")
    return before + short_table + after
