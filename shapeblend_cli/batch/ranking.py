"""From a drawing and a folder to a ranking."""

from __future__ import annotations

import math
import os
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

from shapeblend_cli.batch.rate import Rating
from shapeblend_cli.batch.run import processors
from shapeblend_cli.batch.sources import drawings
from shapeblend_cli.batch.supervisor import run_all
from shapeblend_cli.batch.worker import DONE, Order
from shapeblend_cli.errors import InputError, OptionError
from shapeblend_cli.options.settings import RankOptions, ReadOptions, Settings
from shapeblend_cli.svg.reading.read import STANDARD_INPUT, contents_of, read
from shapeblend_cli.svg.writing.sheet import Row, sheet
from shapeblend_cli.system.write import check_targets, write_files

WORKERS = "shapeblend_cli.batch.rate"


class Rated(NamedTuple):
    """A drawing and what was found of its blend; without a rating, why there is none."""

    file: str
    rating: Rating | None
    error: str | None = None
    notes: tuple[str, ...] = ()


class Ranking:
    """Drawings to be ranked by the blends that they make with a first one, which is read at once.

    Raises
    ------
    ShapeblendError
        If the first drawing cannot be read, if there are no others, or if a sheet would replace a file.
    """

    def __init__(self, first: str, names: Sequence[str], given: Mapping[str, Any]) -> None:
        self._options = RankOptions.of(given)
        self._given = {name: value for name, value in given.items() if value not in (None, ())}
        Settings.of(given)  # checks them
        self.others = _others(first, names)
        inputs = [Path(name) for name in (first, *self.others) if name != STANDARD_INPUT]
        if self._options.sheet is not None:
            check_targets([Path(self._options.sheet)], inputs, self._options.force)
        content = contents_of(first)
        self._first, self._data = first, (content,) if first == STANDARD_INPUT else None
        options = ReadOptions.of(given)
        read(first, content, lenient=options.lenient, select=options.select_a, is_to_blend=True)

    def rate(self) -> Iterator[Rated]:
        """Blend each drawing with the first, in processes, and yield what was found, as it is."""
        orders = [
            (k, Order((self._first, other), self._given, False, data=self._data))
            for k, other in enumerate(self.others)
        ]
        for ended in run_all(orders, self._options.jobs or processors(), module=WORKERS):
            answer = ended.answer
            found = answer.contents if answer.status == DONE else None
            yield Rated(self.others[ended.number], found, answer.error, answer.notes)

    def in_order(self, rated: Sequence[Rated]) -> list[Rated]:
        """Return what is listed: the best first, and those that could not be blended last."""
        place = {file: k for k, file in enumerate(self.others)}
        found = sorted(rated, key=lambda one: (*self._key(one), place[one.file]))
        return found[: self._options.top]

    def write_sheet(self, listed: Sequence[Rated]) -> None:
        """Write the contact sheet, if one is asked for and there is a blend to be shown."""
        rated = [(k, one.file, one.rating) for k, one in enumerate(listed, 1) if one.rating]
        if self._options.sheet is None or not rated:
            return
        rows = [Row(_words(k, file, found), found.moments) for k, file, found in rated]
        text = sheet(rows, *rated[0][2].size)
        write_files({Path(self._options.sheet): text}, self._options.force)

    def _key(self, one: Rated) -> tuple[float, float]:
        if one.rating is None:
            return math.inf, math.inf
        wrong, work = one.rating.wrong, one.rating.work
        if wrong is None or work is None:
            return math.inf, 0.0
        return (work, wrong) if self._options.by == "work" else (wrong, work)


def _words(place: int, file: str, found: Rating) -> str:
    """Return what a sheet says of a blend."""
    number = "-" if found.wrong is None else f"{found.wrong:.3f}"
    fault = f": {found.fault}" if found.fault else ""
    return f"{place}  {file}  {number}{fault}"


def _others(first: str, names: Sequence[str]) -> list[str]:
    """Return the drawings that folders, patterns and names stand for, without the first one, each once."""
    found: list[str] = []
    for name in names:
        files = [name] if os.path.isfile(name) else drawings(name)
        if not files and not os.path.isdir(name) and not any(sign in name for sign in "*?["):
            raise InputError(name, "no such file or folder")
        found += files
    place = os.path.realpath(first)
    others = [file for file in dict.fromkeys(found) if os.path.realpath(file) != place]
    if not others:
        raise OptionError(
            f"{' '.join(names)}: no drawings except {first}; a folder with .svg files would work"
        )
    return others
