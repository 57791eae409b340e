"""Text as it can be written again: characters, places and fonts, of which equal texts agree but for place and size."""

from __future__ import annotations

import hashlib
import json
from dataclasses import replace
from typing import TYPE_CHECKING

from shapeblend_cli.geometry.polygons import rectangle
from shapeblend_cli.model import Picture, control_box
from shapeblend_cli.model.words import TextRun, Words
from shapeblend_cli.svg.reading import contours
from shapeblend_cli.svg.reading.text import Places, style_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.svg.effects.layers import Drawn
    from shapeblend_cli.svg.reading.fonts import Fonts
    from shapeblend_cli.svg.reading.text import Letter, Span, Text
    from shapeblend_cli.svg.xml.transforms import Affine

DIGITS = 3
"""Decimals of places in equal texts, in sizes of their font."""

MOST_BASIC = 0xFFFF
"""Maximum number of a character in a text with lists of places, which programs count in other ways beyond."""

_PLAIN = {
    "alignment-baseline": ("auto", "baseline"),
    "baseline-shift": ("baseline", "0"),
    "writing-mode": ("horizontal-tb", "lr", "lr-tb"),
}
"""Values of properties that a text has which is written again."""


def with_whole(
    drawn: Sequence[Drawn], text: Text, letters: Sequence[Letter], fonts: Fonts, matrix: Affine
) -> list[Drawn]:
    """Return the letters of a text, which know the whole of it if it may stay text: all of it in one colour."""
    if not drawn:
        return []
    style, *others = {each.shape.style for each in drawn}
    is_plain = style.stroke is None and style.fill_gradient is None and style.fill is not None and not others
    if not is_plain or len(drawn) != len(letters):
        return [*drawn]
    words = words_of(text, letters, fonts)
    if words is None:
        return [*drawn]
    whole = placed(words, matrix)
    return [each._replace(shape=replace(each.shape, whole=whole)) for each in drawn]


def words_of(text: Text, letters: Sequence[Letter], fonts: Fonts) -> Words | None:
    """Return a text, given the outlines of its letters; None if it is one that only outlines show."""
    used = [text.spans[number] for number in dict.fromkeys(span for _, span in text.characters)]
    paths = tuple(tuple(letter.contours) for letter in letters)
    if not used or not paths or not all(map(_is_plain, text.spans)):
        return None
    first = used[0]
    common = [_common(span) for span in used]
    size = first.inherited.font_size
    if len({*common}) > 1 or not size > 0.0:
        return None
    runs = _runs(text)
    if runs is None:
        return None
    faces = tuple(dict.fromkeys(rule for span in used for rule in fonts.rules(style_of(span).wanted)))
    box = control_box([path for own in paths for path in own])
    if not (box.width > 0.0 and box.height > 0.0):
        return None
    direction, baseline = common[0]
    fonts_of = [hashlib.sha256(rule.encode()).hexdigest() for rule in faces]
    key = json.dumps([_relative(runs, size), direction, baseline, fonts_of], separators=(",", ":"))
    return Words(
        key.encode("utf-8", "surrogatepass"),
        "text/plain",
        1,
        1,
        "#000000",
        is_opaque=False,
        runs=runs,
        direction=direction,
        baseline=baseline,
        faces=faces,
        box=box,
        letters=paths,
    )


def placed(words: Words, matrix: Affine) -> Picture:
    """Return a text in the place of a picture, in the coordinates to which a matrix maps its own."""
    corner, right, below = contours.transform(rectangle(words.box), matrix).segments[[0, 1, 3], 0].tolist()
    return Picture(words, corner, right - corner, below - corner)


def _is_plain(span: Span) -> bool:
    given = span.inherited.text
    is_alone = span.path is None and span.node.get("textLength") is None
    return is_alone and all(
        given.get(name, "").strip().lower() in ("", *values) for name, values in _PLAIN.items()
    )


def _common(span: Span) -> tuple[str, str]:
    """Return what all spans of a text have to agree on: direction and baseline."""
    given = span.inherited.text
    direction = given.get("direction", "ltr").strip().lower()
    baseline = given.get("dominant-baseline", "auto").strip().lower()
    return ("rtl" if direction == "rtl" else "ltr"), (
        "auto" if not baseline.replace("-", "").isalpha() else baseline
    )


def _runs(text: Text) -> tuple[TextRun, ...] | None:
    """Return the pieces of a text that begin at places of their own, or are of spans of their own."""
    places = Places.of(text)
    found: list[TextRun] = []
    begin = 0
    count = len(text.characters)
    for k in range(1, count + 1):
        is_new = k == count or text.characters[k][1] != text.characters[begin][1]
        if not (is_new or places.x[k] is not None or places.y[k] is not None):
            continue
        letters = "".join(character for character, _ in text.characters[begin:k])
        dx, dy, rotate = (_without_zeros(each[begin:k]) for each in (places.dx, places.dy, places.rotate))
        if (dx or dy or rotate) and max(map(ord, letters)) > MOST_BASIC:
            return None
        span = text.spans[text.characters[begin][1]]
        style, given = style_of(span), span.inherited.text
        anchor = given.get("text-anchor", "start").strip().lower()
        found.append(
            TextRun(
                letters,
                places.x[begin],
                places.y[begin],
                dx,
                dy,
                rotate,
                style.wanted.families,
                style.size,
                style.wanted.weight,
                style.wanted.is_slanted,
                style.between_letters,
                style.between_words,
                anchor if anchor in ("middle", "end") else "start",
            )
        )
        begin = k
    return tuple(found)


def _without_zeros(values: Sequence[float]) -> tuple[float, ...]:
    last = next((k for k in range(len(values), 0, -1) if values[k - 1] != 0.0), 0)
    return tuple(values[:last])


def _relative(runs: Sequence[TextRun], size: float) -> list[object]:
    """Return runs with lengths in sizes of the font, from the place of the first on."""
    x, y = runs[0].x or 0.0, runs[0].y or 0.0

    def short(value: float) -> float:
        return round(value / size, DIGITS) + 0.0

    return [
        [
            run.text,
            None if run.x is None and k else short((run.x or 0.0) - x),
            None if run.y is None and k else short((run.y or 0.0) - y),
            [*map(short, run.dx)],
            [*map(short, run.dy)],
            run.rotate,
            run.families,
            short(run.size),
            run.weight,
            run.is_slanted,
            short(run.between_letters),
            short(run.between_words),
            run.anchor,
        ]
        for k, run in enumerate(runs)
    ]
