"""``shapeblend inspect``: a table on a terminal, and elsewhere one line for each shape, for grep, cut and awk."""

from __future__ import annotations

import io
import sys
from collections.abc import Sequence
from typing import Any, Literal

import click

from shapeblend_cli.cli.parameters import NAME, FieldOption
from shapeblend_cli.cli.terminal import Terminal
from shapeblend_cli.job.options import RunOptions
from shapeblend_cli.options import types
from shapeblend_cli.options.fields import Record, option
from shapeblend_cli.options.settings import OUTPUT, ReadOptions
from shapeblend_cli.system.interrupts import limit

COLUMNS = ("shape", "element", "id", "contours", "ends", "length", "box", "fill", "stroke", "rule")
NUMBERS = "numbers"  # of contours, as --match takes them; on a terminal they stand in place of their count
LINES = "lines"  # names of recovered lines; those of strokes are the numbers of contours

_NUMBERS = frozenset(("shape", "contours", "length"))
_PAINTS = frozenset(("fill", "stroke"))
_FOLDED = frozenset(("id", "box", LINES))

_MAX_PRETTY = 1000  # rich takes more than half a second for so many rows
_MAX_ALIGNED = 60  # a longer cell pushes the rest of its own line on, and no other line


SELECT = ReadOptions.options["select_a"]._replace(
    name="select",
    flags=("--select",),
    help="List only these shapes: #id, a CSS selector, or their numbers, such as 0,2.",
)


TEXT = ReadOptions.options["text"]._replace(
    help="outline or keep: each letter is a shape, drawn with the font that the file embeds or that is installed; "
    "skip: text is left out.",
)


class InspectOptions(Record, section=OUTPUT):
    """Files that `inspect` writes."""

    picture: str | None = option(
        types.file(".svg"),
        default=None,
        metavar="FILE.svg",
        help="Draw the shapes with the numbers of their contours and pen lines, which --match takes.",
    )
    force: bool = option(types.FLAG, default=False, flags=("-f", "--force"), help="Replace an existing file.")


PARAMS = [
    FieldOption(each)
    for each in (
        SELECT,
        ReadOptions.options["lenient"],
        TEXT,
        *InspectOptions.options.values(),
        *RunOptions.options.values(),
    )
]


@click.command(params=PARAMS)
@click.option("--json", "as_json", is_flag=True, help="Print JSON, for programs.")
@click.argument("file", type=NAME, metavar="FILE")
def inspect(
    file: str, select: str | None, lenient: bool | None, text: str | None, as_json: bool, **given: Any
) -> None:
    """List the shapes that a file draws; - is standard input."""
    from shapeblend_cli.job.report import inspection
    from shapeblend_cli.svg.reading.read import read

    limit(*RunOptions.of(given).values)
    drawing = read(file, lenient=bool(lenient), select=select, text=text or "outline")
    options = InspectOptions.of(given)
    if options.picture is not None:
        from shapeblend_cli.plot.numbered import write_picture

        write_picture(drawing, file, options.picture, force=options.force)
    found = inspection(drawing) | {"file": file}
    if as_json:
        import json

        click.echo(json.dumps(found, indent=1, allow_nan=False))
        return
    for note in drawing.notes:
        Terminal().note(f"{drawing.file}: {note}")
    _show(found)


def _show(found: dict[str, Any]) -> None:
    if isinstance(sys.stdout, io.TextIOWrapper):
        sys.stdout.reconfigure(errors="backslashreplace")  # any id on any terminal
    viewbox = " ".join(f"{v:g}" for v in found["viewbox"]) if found["viewbox"] else "none"
    count = sum(len(shape["pen_lines"]) for shape in found["shapes"])
    lines = f", {count} pen line{'s' * (count != 1)}" if count else ""
    title = f"{found['file']}: viewBox {viewbox}{lines}"
    columns: tuple[str, ...] = (*COLUMNS, NUMBERS)
    rows = [_cells(shape) for shape in found["shapes"]]
    if any(shape["pen_lines"] and shape["fill"] for shape in found["shapes"]):
        columns = (*columns, LINES)
        rows = [(*row, _lines(shape)) for row, shape in zip(rows, found["shapes"], strict=True)]
    if sys.stdout.isatty() and len(rows) <= _MAX_PRETTY:
        _print_table(title, columns, rows)
    else:
        print("\n".join([title, *aligned([columns, *rows])]))


def _lines(shape: dict[str, Any]) -> str:
    return ",".join(line["name"] for line in shape["pen_lines"]) or "-"


def _cells(shape: dict[str, Any]) -> tuple[str, ...]:
    """Return a shape's cells; none of them is empty, so that awk can count on them."""
    return (
        str(shape["index"]),
        shape["element"],
        shape["id"] or "-",
        str(shape["contours"]),
        "closed" if shape["closed"] else "open",
        f"{shape['length']:.6g}",
        ",".join(f"{v:.6g}" for v in shape["bbox"]),
        shape["fill"] or "none",
        shape["stroke"] or "none",
        shape["fill_rule"],
        _numbers(shape),
    )


def _numbers(shape: dict[str, Any]) -> str:
    first, last = shape["first_contour"], shape["first_contour"] + shape["blended"] - 1
    return f"{first}-{last}" if last > first else f"{first}"


def aligned(rows: Sequence[Sequence[str]]) -> list[str]:
    """Return lines with their columns two blanks apart."""
    widths = [max(min(_width(cell), _MAX_ALIGNED) for cell in column) for column in zip(*rows, strict=True)]
    padded = ([c + " " * (w - _width(c)) for c, w in zip(row, widths, strict=True)] for row in rows)
    return ["  ".join(cells).rstrip() for cells in padded]


def _width(text: str) -> int:
    if text.isascii():
        return len(text)
    import unicodedata

    return sum(0 if unicodedata.combining(c) else 1 + (unicodedata.east_asian_width(c) in "WF") for c in text)


def _print_table(title: str, columns: Sequence[str], rows: Sequence[Sequence[str]]) -> None:
    from rich.console import Console
    from rich.table import Table
    from rich.text import Text

    # Narrow, so that most drawings fit into 80 columns; ids and boxes are folded where they do not.
    table = Table(box=None, pad_edge=False, padding=(0, 1, 0, 0), header_style="bold")
    for name in columns:
        if name == NUMBERS:
            continue
        justify: Literal["right", "left"] = "right" if name in _NUMBERS else "left"
        table.add_column(name, justify=justify, overflow="fold", no_wrap=name not in _FOLDED)
    for row in rows:
        cells = dict(zip(columns, row, strict=True))
        x0, y0, x1, y1 = cells["box"].split(",")
        cells["box"] = f"{x0},{y0} {x1},{y1}"
        cells["contours"] = cells.pop(NUMBERS)
        table.add_row(*(Text(cell, _style(name, cell)) for name, cell in cells.items()))
    console = Console(highlight=False)
    console.print(Text(title))
    console.print(table)


def _style(column: str, cell: str) -> str:
    """Return how a cell looks: a colour is shown in itself."""
    if column not in _PAINTS or cell == "none":
        return ""
    red, green, blue = (int(cell[k : k + 2], 16) for k in (1, 3, 5))
    is_light = 3 * red + 6 * green + blue > 1275
    return f"{'black' if is_light else 'white'} on {cell}"
