"""``shapeblend rank``."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from shapeblend_cli.batch.options import RankOptions
from shapeblend_cli.cli.group import SectionedCommand
from shapeblend_cli.cli.inspect import aligned
from shapeblend_cli.cli.parameters import ABOUT_FRAMES, NAME, options_of
from shapeblend_cli.cli.terminal import BatchTerminal, TerminalOptions
from shapeblend_cli.job.options import RunOptions
from shapeblend_cli.options.settings import ABOUT_TWO_DRAWINGS, ReadOptions, Settings

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.batch.ranking import Rated

EXAMPLES = (
    ("shapeblend rank a.svg icons", "the icons that a.svg blends into best"),
    ("shapeblend rank a.svg icons --top 10 --sheet best.svg", "the ten best, with pictures of them"),
    ("shapeblend rank a.svg icons --json | head -n 1", "the best, for a program"),
)

COLUMNS = ("place", "grade", "work", "alone", "file", "what is worst")

HELPS = {
    "timeout": "Leave out a drawing if its blend takes longer than S seconds.  [default: 300]",
    "max_memory": "Leave out a drawing if its blend takes more megabytes of memory.  [default: 2000]",
    "quiet": "Print only the ranking and errors.",
}


@click.command(
    cls=SectionedCommand,
    examples=EXAMPLES,
    params=options_of(
        RankOptions,
        ReadOptions,
        Settings,
        RunOptions,
        TerminalOptions,
        without=(*ABOUT_FRAMES, *ABOUT_TWO_DRAWINGS, "verbose"),
        helps=HELPS,
    ),
)
@click.argument("first", type=NAME, metavar="A.svg")
@click.argument("names", type=NAME, nargs=-1, required=True, metavar="DIR")
def rank(first: str, names: tuple[str, ...], **given: Any) -> int:
    """Find the drawings in a folder that blend best with A.

    For each drawing the table lists the grade of the in-betweens (0 is best, 3 worst), their work, and the
    number of contours without a partner, which grow or shrink. DIR may also be a pattern in quotes, or files.
    """
    from shapeblend_cli.batch.ranking import Ranking
    from shapeblend_cli.batch.supervisor import Stopped

    options, quiet = RankOptions.of(given), TerminalOptions.of(given).quiet
    ranking = Ranking(first, names, given)
    rated: list[Rated] = []
    with BatchTerminal(quiet=quiet, count=len(ranking.others)) as terminal:
        try:
            for one in ranking.rate():
                rated.append(one)
                terminal.ended(one.error is None, None)
        except Stopped as stop:
            terminal.warn("interrupted; nothing was ranked or written")
            return 128 + stop.number
        for text in dict.fromkeys(note for one in rated for note in one.notes):
            terminal.note(text)
        for one in rated:
            if one.error is not None:
                terminal.warn(one.error)
    listed = ranking.in_order(rated)
    ranking.write_sheet(listed)
    _print(listed, as_json=options.as_json)
    return int(any(one.error is not None for one in rated))


def _print(listed: Sequence[Rated], *, as_json: bool) -> None:
    if as_json:
        import json

        for place, one in enumerate(listed, 1):
            found = one.rating.as_json() if one.rating else {"error": one.error}
            click.echo(json.dumps({"place": place, "file": one.file, **found}, allow_nan=False))
        return
    rows = [_cells(place, one) for place, one in enumerate(listed, 1) if one.rating]
    click.echo("\n".join(aligned([COLUMNS, *rows])))


def _cells(place: int, one: Rated) -> tuple[str, ...]:
    """Return the cells of a row; none but the last is empty, so that awk can count on them."""
    found = one.rating
    assert found is not None
    grade = "-" if found.grade is None else f"{found.grade:.2f}"
    work = "-" if found.work is None else f"{found.work:.4g}"
    return str(place), grade, work, str(found.alone), one.file, found.why
