"""``shapeblend judge``."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from shapeblend_cli.cli.group import SectionedCommand
from shapeblend_cli.cli.inspect import aligned
from shapeblend_cli.cli.parameters import NAME, options_of
from shapeblend_cli.job.options import RunOptions
from shapeblend_cli.options import types
from shapeblend_cli.options.fields import Record, option
from shapeblend_cli.options.settings import OUTPUT
from shapeblend_cli.system.interrupts import limit

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.job.judged import Judged

EXAMPLES = (
    ("shapeblend judge after", "grade the frames in a folder, in the order of their names"),
    ("shapeblend judge before after", "compare strips, such as those of two versions or tools"),
    ("shapeblend judge after --fail-over 2", "stop a build that made something worse"),
)

COLUMNS = ("grade", "frames", "strip", "why")


class JudgeOptions(Record, section=OUTPUT):
    """What becomes of grades."""

    fail_over: float | None = option(
        types.number(0.0, 3.0),
        default=None,
        metavar="G",
        help="Exit with 1 if a grade is above G, from 0 to 3.",
    )
    as_json: bool = option(
        types.FLAG, default=False, flags=("--json",), help="Print a line of JSON for each strip."
    )


@click.command(
    cls=SectionedCommand, examples=EXAMPLES, params=[*options_of(JudgeOptions, RunOptions, without=())]
)
@click.argument("names", type=NAME, nargs=-1, required=True, metavar="FOLDER|FILE...")
def judge(names: tuple[str, ...], **given: Any) -> int:
    """Grade frames that any program made, from 0, as drawn by hand, to 3, unusable.

    Frames are SVG or PNG files: those in a folder, or three files or more in the order given. Each folder, and each
    GIF, is one strip of frames. The first and the last frame are taken to be right. PNG and GIF need the extra
    shapeblend[pictures].
    """
    from shapeblend_cli.job.judged import judge_files, strips_of

    limit(*RunOptions.of(given).values)
    options = JudgeOptions.of(given)
    judged = [judge_files(name, files) for name, files in strips_of(names)]
    _print(judged, as_json=options.as_json)
    return int(options.fail_over is not None and any(one.grade.number > options.fail_over for one in judged))


def _print(judged: Sequence[Judged], *, as_json: bool) -> None:
    if as_json:
        import json

        for one in judged:
            found = {"grade": round(one.grade.number, 2), "name": one.grade.name, "why": one.grade.why}
            click.echo(json.dumps({"strip": one.name, "frames": one.frames, **found}, allow_nan=False))
        return
    rows = [
        (f"{one.grade.number:.1f}", str(one.frames), one.name, one.grade.why or one.grade.name)
        for one in judged
    ]
    click.echo("\n".join(aligned([COLUMNS, *rows])))
