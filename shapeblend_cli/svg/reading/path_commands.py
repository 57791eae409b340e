"""Path data into contours: the only module that calls svgpathtools' ``parse_path``.

``parse_path`` is fast and right on valid data. On other data it drops letters it does not know, reads ``nan`` and
``1e999``, and fails with an AssertionError on an arc whose ends coincide. So data is first checked against the grammar
(https://www.w3.org/TR/SVG2/paths.html#PathDataBNF) and cut into subpaths, and arcs are handed over as lines:
``parse_path`` finds their ends, `contours.arc` the curve.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from typing import Any

from shapeblend_cli.model import Contour
from shapeblend_cli.svg.libraries import parse_path
from shapeblend_cli.svg.reading import contours
from shapeblend_cli.svg.xml.messages import printable
from shapeblend_cli.svg.xml.units import (
    BLANKS,
    GAP,
    LIMIT,
    NUMBER,
    GrammarError,
    is_end,
    numbers,
    one_blank,
)

MAX_SEGMENTS = 500_000

_ARITY = {"M": 2, "L": 2, "H": 1, "V": 1, "C": 6, "S": 4, "Q": 4, "T": 2, "A": 7}
_COMMAND = re.compile(r"([MmZzLlHhVvCcSsQqTtAa])([^MmZzLlHhVvCcSsQqTtAa]*+)")
# A flag is one digit and needs no gap after it: 'a1 1 0 01.5.5'.
_ARC = GAP + GAP.join([f"({NUMBER})"] * 3 + ["([01])"] * 2 + [f"({NUMBER})"] * 2)
# svgpathtools reads '1.e2' as two numbers.
_POINT_EXPONENT = re.compile(r"\.(?=[eE])")
# A smaller radius is zero in the single precision of browsers, and the arc a line.
_NO_RADIUS = 1e-45

Arc = tuple[tuple[float, float], float, bool, bool]  # radii, rotation, and the two flags


class TooManySegments(ValueError):
    """Path data beyond the limit, whether it keeps to the grammar or not."""

    def __init__(self) -> None:
        super().__init__(f"more than {MAX_SEGMENTS} segments, the limit")


@dataclass(slots=True, eq=False, repr=False)
class Subpath:
    """One subpath as the text of commands that ``parse_path`` reads correctly.

    `move` is the point of its moveto, None if it begins where the one before it closed. In `text` arcs are lines;
    `arcs` has them by the numbers of their segments. `count` is the number of segments without the closing line.
    """

    move: complex | None
    is_relative: bool = False
    text: list[str] = field(default_factory=list)
    arcs: dict[int, Arc] = field(default_factory=dict)
    count: int = 0
    closed: bool = False


def scan(data: str) -> tuple[list[Subpath], GrammarError | None]:
    """Cut path data into subpaths, up to the first error; raise TooManySegments.

    https://www.w3.org/TR/SVG2/paths.html#GrammarErrorHandling: browsers draw all segments before it, even
    segments of the same command.
    """
    subpaths: list[Subpath] = []
    if data.strip() in ("", "none"):
        return subpaths, None
    start = _skip_blanks(data, 0)
    if data[start] not in "Mm":
        return subpaths, GrammarError(start, f"found '{printable(data[start])}' where it must begin with M")
    count = 0
    for match in _COMMAND.finditer(data, start):
        added, error = _append(subpaths, match)
        count += added
        if error is not None:
            return subpaths, error
        if count > MAX_SEGMENTS:
            raise TooManySegments
    return subpaths, None


def _skip_blanks(text: str, start: int) -> int:
    return len(text) - len(text[start:].lstrip(BLANKS))


def _append(subpaths: list[Subpath], match: re.Match[str]) -> tuple[int, GrammarError | None]:
    """Append a command to its subpath; return the number of its segments, and the error that follows them."""
    letter = match[1]
    if letter in "Zz":
        subpaths[-1].closed = True
        return 0, None if is_end(match[2], 0) else _unexpected(match, 0, 8, "a command belongs")
    arcs: list[Arc | None] = []
    values: list[float] = []
    if letter in "Aa":
        text, arcs, error = _read_arcs(match)
        count = len(arcs)
    else:
        text, values, error = _read_numbers(match)
        count = len(values) // _ARITY[letter.upper()]
    if not count:
        return 0, error
    if letter in "Mm":
        subpaths.append(Subpath(complex(values[0], values[1]), letter == "m"))
        count -= 1
    elif subpaths[-1].closed:
        subpaths.append(Subpath(None))
    subpath = subpaths[-1]
    subpath.arcs.update((subpath.count + k, arc) for k, arc in enumerate(arcs) if arc is not None)
    subpath.count += count
    subpath.text.append(text)
    return count, error


def _unexpected(match: re.Match[str], end: int, most: int, expected: str) -> GrammarError:
    """Return the error at `end` in a command's arguments."""
    start = _skip_blanks(match[2], end)
    found = printable(match[2][start : start + most])
    return GrammarError(match.start(2) + start, f"found '{found}' where {expected}")


def _read_numbers(match: re.Match[str]) -> tuple[str, list[float], GrammarError | None]:
    """Return a command's whole segments as text, their numbers, and the error that follows them."""
    letter, arguments = match[1], match[2]
    arity = _ARITY[letter.upper()]
    try:
        values = numbers(arguments, "a number or a command")
    except GrammarError as wrong:
        values = wrong.before
        error = GrammarError(match.start(2) + wrong.offset, str(wrong))
    else:
        if values and len(values) % arity == 0:
            return _POINT_EXPONENT.sub("", letter + one_blank(arguments)), values, None
        found = f"{letter} with {len(values)} number{'' if len(values) == 1 else 's'}"
        error = GrammarError(match.start(), f"found {found} where {arity} or a multiple belong")
    values = values[: len(values) // arity * arity]
    return letter + " ".join(map(repr, values)), values, error


def _read_arcs(match: re.Match[str]) -> tuple[str, list[Arc | None], GrammarError | None]:
    """Return lines to the ends of a command's arcs, the arcs, None for straight ones, and the error that follows."""
    letter = "L" if match[1] == "A" else "l"
    arguments = match[2]
    text: list[str] = []
    arcs: list[Arc | None] = []
    error = None
    end = 0
    pattern = re.compile(_ARC)
    while arc := pattern.match(arguments, end):
        if not end and "," in arc[0][: arc.start(1)]:
            break
        rx, ry, rotation, x, y = (float(arc[k]) for k in (1, 2, 3, 6, 7))
        if not max(map(abs, (rx, ry, rotation, x, y))) < LIMIT:
            error = GrammarError(match.start(), f"{match[1]} has a number beyond {LIMIT:g}")
            break
        is_line = min(abs(rx), abs(ry)) < _NO_RADIUS
        arcs.append(None if is_line else ((rx, ry), rotation, arc[4] == "1", arc[5] == "1"))
        text.append(f"{letter}{x!r} {y!r}")
        end = arc.end()
    if error is None and (not end or not is_end(arguments, end)):
        error = _unexpected(match, end, 20, "the seven numbers of an arc belong, its flags 0 or 1")
    return " ".join(text), arcs, error


def trace(subpaths: list[Subpath]) -> list[Contour]:
    """Return the contours of checked subpaths; one that has no length is a point.

    Raise TooManySegments here too: an arc is several cubics, so their number is known only now.
    """
    traced = []
    position = 0j
    for subpath in subpaths:
        # The text of a relative moveto is relative to where the last subpath ended.
        before = position
        if subpath.move is not None:
            position = subpath.move + (position if subpath.is_relative else 0j)
            before = position - subpath.move if subpath.is_relative else 0j
        start = position
        if subpath.count:
            path = list(parse_path(" ".join(subpath.text), current_pos=before))
            contour = _contour(path, subpath)
            if contour is not None:
                traced.append(contour)
            position = path[-1].end
        elif subpath.closed:
            traced.append(contours.point(start))
        if subpath.closed:
            position = start
    return traced


def _contour(path: list[Any], subpath: Subpath) -> Contour | None:
    cubics: list[contours.Segment] = []
    straight: list[bool] = []
    for index, segment in enumerate(path):
        arc, points = subpath.arcs.get(index), segment.bpoints()
        if arc is not None:  # the segment is a line to its end
            added = contours.arc(segment.start, segment.end, *arc)
        elif len(points) == 2:
            added = [contours.line(*points)]
        else:
            added = [points if len(points) == 4 else contours.quadratic(*points)]
        cubics += added
        straight += [arc is None and len(points) == 2] * len(added)
        if arc is not None and len(cubics) > MAX_SEGMENTS:
            raise TooManySegments
    return contours.chain(cubics, straight, subpath.closed)
