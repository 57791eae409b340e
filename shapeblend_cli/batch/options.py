"""Options of a ranking. Nothing heavy is imported here, for the sake of ``--help``."""

from __future__ import annotations

from shapeblend_cli.options import types
from shapeblend_cli.options.fields import Record, option
from shapeblend_cli.options.settings import RANK


class RankOptions(Record, section=RANK):
    """How drawings are ranked, and what is printed and written."""

    by: str = option(
        types.choice("looks", "work"),
        default="looks",
        help="Order of the list. looks: by how wrong blends look to the judge, the least wrong first; work: by their "
        "work, the least first.",
    )
    top: int | None = option(types.whole(1), default=None, help="List only the first N.", default_text="all")
    as_json: bool = option(
        types.FLAG, default=False, key="json", help="Print a line of JSON for each drawing, for programs."
    )
    sheet: str | None = option(
        types.file(".svg"),
        default=None,
        metavar="FILE.svg",
        help="Write a contact sheet: a row of in-betweens for each drawing that is listed.",
    )
    force: bool = option(
        types.FLAG, default=False, flags=("-f", "--force"), help="Replace an existing sheet."
    )
    jobs: int | None = option(
        types.whole(1, 1024),
        default=None,
        flags=("-j", "--jobs"),
        help="Number of blends made at a time.",
        default_text="the number of processors",
    )
