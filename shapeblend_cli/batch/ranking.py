"""From a drawing and a folder to a ranking, with the processes that rate one blend after another."""

from __future__ import annotations

import math
import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from shapeblend_cli.batch.options import RankOptions
from shapeblend_cli.batch.run import processors
from shapeblend_cli.batch.supervisor import run_all
from shapeblend_cli.batch.worker import DONE, Answer, Order, limit_to
from shapeblend_cli.batch.worker import main as answer_orders
from shapeblend_cli.errors import InputError, OptionError
from shapeblend_cli.options.settings import ReadOptions, Settings
from shapeblend_cli.rows.sources import drawings
from shapeblend_cli.svg.reading.read import STANDARD_INPUT, contents_of, read
from shapeblend_cli.svg.writing.figure import Row, sheet
from shapeblend_cli.system.kept import Kept
from shapeblend_cli.system.write import check_targets, write_files

if TYPE_CHECKING:
    from shapeblend_cli.model import Pair


NOTHING = "nothing becomes anything"


class Rating(NamedTuple):
    """What is found of a blend."""

    grade: float | None  # from 0 to 3; None if no contour has a partner
    why: str  # what is worst, a phrase; empty if nothing is
    work: float | None  # of all contours that have a partner, as in the report
    alone: int  # contours of both drawings without a partner
    motions: tuple[str, ...]  # of the shapes that are matched, those that there are
    moments: tuple[str, ...] = ()  # SVG documents, for a sheet
    size: tuple[float, float] = (0.0, 0.0)  # of each on a sheet

    def as_json(self) -> dict[str, Any]:
        """Return what a line of JSON has of it."""
        return {
            "grade": self.grade,
            "why": self.why,
            "work": self.work,
            "alone": self.alone,
            "motions": list(self.motions),
        }


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
        for ended in run_all(orders, self._options.jobs or processors(), module=__name__):
            answer = ended.answer
            found = answer.contents if answer.status == DONE else None
            yield Rated(self.others[ended.number], found, answer.error, answer.notes)

    def in_order(self, rated: Sequence[Rated]) -> list[Rated]:
        """Return the drawings to list: the best first, and drawings that could not be blended last."""
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
        grade, work = one.rating.grade, one.rating.work
        if grade is None or work is None:
            return math.inf, 0.0
        return (work, grade) if self._options.by == "work" else (grade, work)


def _words(place: int, file: str, found: Rating) -> str:
    number = "-" if found.grade is None else f"{found.grade:.2f}"
    why = f": {found.why}" if found.why else ""
    return f"{place}  {file}  {number}{why}"


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


def rating(pair: Pair) -> Rating:
    """Return how good a blend looks, and what work it takes."""
    from shapeblend_cli.blending.graded import grade_of

    matched = [contour for contour in pair.contours if contour.is_matched]
    alone = sum(not contour.is_matched for contour in pair.contours)
    if not matched:
        return Rating(None, NOTHING, None, alone, ())
    grade = grade_of(pair)
    motions = dict.fromkeys(shape.motion_name for shape in pair.each_shape if shape.is_matched)
    work = sum(contour.correspondence.work for contour in matched)
    return Rating(round(grade.number, 3), grade.why or "", round(work, 6), alone, tuple(motions))


def rate(order: Order, note: Callable[[str], None]) -> Answer:
    """Blend the two files of an order, and answer with its rating; pictures are drawn if a sheet is asked for.

    Data of an order are the first file's, where that was standard input.
    """
    from shapeblend_cli.job.make import match_drawings, read_files
    from shapeblend_cli.job.tries import moments, size_on_sheet
    from shapeblend_cli.system.clock import Clock

    limit_to(order)
    read, settings = ReadOptions.of(order.given), Settings.of(order.given)
    sources = dict(zip(order.files, order.data or (), strict=False))
    clock, kept = Clock(), _kept()
    drawings = read_files(order.files, read, clock, note, sources, kept)
    (pair,) = match_drawings(drawings, settings, clock, note, lambda stage, share: None, kept)
    found = rating(pair)
    if order.given.get("sheet") is None:
        return Answer(DONE, contents=found)
    pictures = tuple(moments(pair, as_drawn=settings.draws_ends))
    found = found._replace(moments=pictures, size=size_on_sheet(pair.views[0]))
    return Answer(DONE, contents=found)


@cache
def _kept() -> Kept:
    """Return what this process keeps of drawings: the first is the same every time."""
    return Kept()


def main() -> None:
    """Rate until standard input ends."""
    answer_orders(rate)
