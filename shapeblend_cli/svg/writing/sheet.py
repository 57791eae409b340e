"""A contact sheet as one SVG document: rows of documents with a line of words above each."""

from __future__ import annotations

import base64
from collections.abc import Sequence
from typing import NamedTuple

from shapeblend_cli.svg.writing.figure import Figure

GAP = 6.0
"""Distance between pictures, in pixels."""

WORDS = 22.0
"""Height of the line of words above a row, in pixels."""

MARGIN = 12.0
"""Margin around all rows, in pixels."""

STYLE = """\
.ground { fill: #fff }
.words { font: 13px system-ui, sans-serif; fill: #333 }
"""


class Row(NamedTuple):
    """SVG documents in a row, and the line of words above them."""

    words: str
    pictures: Sequence[str]


def sheet(rows: Sequence[Row], width: float, height: float) -> str:
    """Return rows of documents, each of the same width and height, as one document that needs no other file.

    Each document is an image in it, so that their ids and gradients do not meet.
    """
    longest = max(len(row.pictures) for row in rows)
    figure = Figure(
        2 * MARGIN + longest * (width + GAP) - GAP,
        2 * MARGIN + len(rows) * (WORDS + height + GAP) - GAP,
        STYLE,
    )
    for number, row in enumerate(rows):
        top = MARGIN + number * (WORDS + height + GAP)
        figure.words(row.words, (MARGIN, top + 15.0), "words")
        for k, picture in enumerate(row.pictures):
            data = base64.b64encode(picture.encode("utf-8")).decode("ascii")
            place = (MARGIN + k * (width + GAP), top + WORDS)
            figure.image(f"data:image/svg+xml;base64,{data}", place, (width, height))
    return figure.text()
