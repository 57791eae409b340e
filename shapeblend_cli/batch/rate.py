"""How good a blend of two files looks, and how much work it takes; and a process that says so of one after another."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import TYPE_CHECKING, Any, NamedTuple

from shapeblend_cli.batch.worker import main as answer_orders
from shapeblend_cli.batch.worker import watch_time
from shapeblend_cli.system.kept import Kept

if TYPE_CHECKING:
    from shapeblend_cli.batch.worker import Order
    from shapeblend_cli.model import Pair

RESTS = "it rests, or turns as a whole"
NOTHING = "nothing becomes anything"


class Rating(NamedTuple):
    """What is found of a blend."""

    wrong: float | None  # by the judge; None if no contour has a partner
    fault: str  # what is worst, a phrase; empty if nothing is wrong
    work: float | None  # of all contours that have a partner, as in the report
    alone: int  # contours of both drawings without a partner
    motions: tuple[str, ...]  # of the shapes that are matched, those that there are
    moments: tuple[str, ...] = ()  # SVG documents, for a sheet
    size: tuple[float, float] = (0.0, 0.0)  # of each on a sheet

    def as_json(self) -> dict[str, Any]:
        """Return what a line of JSON has of it."""
        return {
            "wrong": self.wrong,
            "fault": self.fault,
            "work": self.work,
            "alone": self.alone,
            "motions": list(self.motions),
        }


def rating(pair: Pair) -> Rating:
    """Return how wrong a blend looks to the judge, and what work it takes."""
    from shapeblend_cli.motion.verdict import verdict

    matched = [contour for contour in pair.contours if contour.is_matched]
    alone = sum(not contour.is_matched for contour in pair.contours)
    if not matched:
        return Rating(None, NOTHING, None, alone, ())
    found = verdict([pair], asked_too=True)
    motions = dict.fromkeys(shape.motion_name for shape in pair.each_shape if shape.is_matched)
    work = sum(contour.correspondence.work for contour in matched)
    if found is None:
        return Rating(0.0, RESTS, round(work, 6), alone, tuple(motions))
    fault = found.fault if found.wrong > 0.0 else ""
    return Rating(found.wrong, fault, round(work, 6), alone, tuple(motions))


def rate(order: Order, note: Callable[[str], None], _warn: Callable[[str], None]) -> Rating:
    """Blend the two files of an order, and rate that; pictures are drawn if a sheet is asked for.

    Data of an order are the first file's, where that was standard input.
    """
    from shapeblend_cli.job.make import match_drawings, read_files
    from shapeblend_cli.job.tries import moments, size_on_sheet
    from shapeblend_cli.options.settings import ReadOptions, Settings
    from shapeblend_cli.system.clock import Clock

    watch_time(order)
    read, settings = ReadOptions.of(order.given), Settings.of(order.given)
    sources = dict(zip(order.files, order.data or (), strict=False))
    clock, kept = Clock(), _kept()
    drawings = read_files(order.files, read, clock, note, sources, kept)
    (pair,) = match_drawings(drawings, settings, clock, note, lambda share: None, kept)
    found = rating(pair)
    if order.given.get("sheet") is None:
        return found
    pictures = tuple(moments(pair, as_drawn=settings.draws_ends))
    return found._replace(moments=pictures, size=size_on_sheet(pair.views[0]))


@cache
def _kept() -> Kept:
    """Return what this process keeps of drawings: the first is the same every time."""
    return Kept()


def main() -> None:
    """Rate until standard input ends."""
    answer_orders(rate)
