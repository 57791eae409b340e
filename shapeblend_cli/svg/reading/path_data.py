"""Path data into contours: the only place that speaks to svgpathtools' ``parse_path``.

``parse_path`` is fast and right on valid data. On other data it drops letters it does not know, reads
``nan`` and ``1e999``, and fails with an AssertionError on an arc whose ends coincide. So data is first
checked against the grammar (https://www.w3.org/TR/SVG2/paths.html#PathDataBNF) and cut into
subpaths, and arcs are handed over as lines: ``parse_path`` finds their ends, `contours.arc` the curve.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from shapeblend_cli.svg.libraries import parse_path
from shapeblend_cli.svg.reading import contours
from shapeblend_cli.svg.reading.messages import printable
from shapeblend_cli.svg.reading.units import (
    BLANK,
    GAP,
    LIMIT,
    NUMBER,
    NumberError,
    is_end,
    numbers,
    one_blank,
)

if TYPE_CHECKING:
    from shapeblend_cli.model import Contour

MAX_SEGMENTS = 500_000

_ARITY = {"M": 2, "L": 2, "H": 1, "V": 1, "C": 6, "S": 4, "Q": 4, "T": 2, "A": 7}
_COMMAND = re.compile(r"([MmZzLlHhVvCcSsQqTtAa])([^MmZzLlHhVvCcSsQqTtAa]*+)")
_BLANKS = re.compile(rf"{BLANK}*+")
# A flag is one digit and needs no gap after it: 'a1 1 0 01.5.5'.
_ARC = re.compile(GAP + GAP.join([f"({NUMBER})"] * 3 + ["([01])"] * 2 + [f"({NUMBER})"] * 2))
# svgpathtools reads '1.e2' as two numbers.
_POINT_EXPONENT = re.compile(r"\.(?=[eE])")
# Below this a single-precision radius, which is what browsers have, is zero and the arc a line.
_NO_RADIUS = 1e-45

Arc = tuple[float, float, float, bool, bool]


class PathDataError(ValueError):
    """Path data that breaks the grammar.

    Parameters
    ----------
    offset : int
        Where in the data, counted from 0.
    found : str
        What is there instead of what was expected.
    """

    def __init__(self, offset: int, found: str) -> None:
        super().__init__(f"at character {offset + 1} of its path data: {found}")
        self.offset = offset


class TooManySegments(ValueError):
    """Path data longer than what is read, whether it keeps to the grammar or not."""

    def __init__(self) -> None:
        super().__init__(f"more than {MAX_SEGMENTS} segments, the most that are read")


@dataclass(slots=True)
class Subpath:
    """One subpath as text ``parse_path`` reads right.

    Attributes
    ----------
    text : list of str
        Commands; arcs are written as lines.
    move : complex or None
        The point of its moveto; None for one that begins where the one before it closed.
    is_relative : bool
        Whether the moveto is.
    arcs : dict
        The arcs' parameters by the numbers of their segments.
    count : int
        Of segments, the closing line apart.
    closed : bool
    """

    move: complex | None
    is_relative: bool = False
    text: list[str] = field(default_factory=list)
    arcs: dict[int, Arc] = field(default_factory=dict)
    count: int = 0
    closed: bool = False


def read(data: str) -> list[Contour]:
    """Return the contours of path data.

    Raises
    ------
    PathDataError
        If `data` breaks the grammar.
    TooManySegments
    """
    subpaths, error = scan(data)
    if error is not None:
        raise error
    return trace(subpaths)


def scan(data: str) -> tuple[list[Subpath], PathDataError | None]:
    """Cut path data into subpaths, as far as it keeps to the grammar.

    https://www.w3.org/TR/SVG2/paths.html#PathDataErrorHandling: that far browsers draw it.

    Returns
    -------
    subpaths : list of Subpath
        All segments before the error, those of the command with the error among them.
    error : PathDataError or None

    Raises
    ------
    TooManySegments
    """
    subpaths: list[Subpath] = []
    if data.strip() in ("", "none"):
        return subpaths, None
    start = _end_of_blanks(data, 0)
    if data[start] not in "Mm":
        return subpaths, PathDataError(start, f"found '{printable(data[start])}' where it must begin with M")
    count = 0
    for match in _COMMAND.finditer(data, start):
        added, error = _append(subpaths, match)
        count += added
        if error is not None:
            return subpaths, error
        if count > MAX_SEGMENTS:
            raise TooManySegments
    return subpaths, None


def _end_of_blanks(text: str, start: int) -> int:
    match = _BLANKS.match(text, start)
    return start if match is None else match.end()


def _append(subpaths: list[Subpath], match: re.Match[str]) -> tuple[int, PathDataError | None]:
    """Append one command to the subpath it belongs to.

    Returns
    -------
    count : int
        The number of its segments.
    error : PathDataError or None
        What is wrong with it, behind these segments.
    """
    letter = match[1]
    if letter in "Zz":
        subpaths[-1].closed = True
        return 0, _after_close(match)
    values: list[float] = []
    if letter in "Aa":
        text, arcs, error = _arcs(match)
        count = len(arcs)
    else:
        values, text, error = _arguments(match)
        arcs = []
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


def _after_close(match: re.Match[str]) -> PathDataError | None:
    arguments = match[2]
    if is_end(arguments, 0):
        return None
    start = _end_of_blanks(arguments, 0)
    found = printable(arguments[start : start + 8])
    return PathDataError(match.start(2) + start, f"found '{found}' where a command belongs")


def _arguments(match: re.Match[str]) -> tuple[list[float], str, PathDataError | None]:
    """Return the numbers of a command's whole segments, these segments as text, and what is wrong then."""
    letter, arguments = match[1], match[2]
    arity = _ARITY[letter.upper()]
    error = None
    try:
        values = numbers(arguments, "a number or a command")
    except NumberError as wrong:
        values = wrong.before
        error = PathDataError(match.start(2) + wrong.offset, f"found {wrong.found}")
    if error is None and (not values or len(values) % arity):
        found = f"{letter} with {len(values)} number{'' if len(values) == 1 else 's'}"
        error = PathDataError(match.start(), f"found {found} where {arity} or a multiple belong")
    if error is None:
        return values, _POINT_EXPONENT.sub("", letter + one_blank(arguments)), None
    values = values[: len(values) // arity * arity]
    return values, letter + " ".join(map(repr, values)), error


def _arcs(match: re.Match[str]) -> tuple[str, list[Arc | None], PathDataError | None]:
    """Return lines to the ends of a command's arcs, the arcs, and what is wrong then; None is an arc that is a line."""
    letter = "L" if match[1] == "A" else "l"
    arguments = match[2]
    text: list[str] = []
    arcs: list[Arc | None] = []
    error = None
    end = 0
    while arc := _ARC.match(arguments, end):
        if not end and "," in arc[0][: arc.start(1)]:
            break
        rx, ry, rotation, x, y = (float(arc[k]) for k in (1, 2, 3, 6, 7))
        if not max(map(abs, (rx, ry, rotation, x, y))) < LIMIT:
            error = PathDataError(match.start(), f"{match[1]} has a number beyond {LIMIT:g}")
            break
        is_line = min(abs(rx), abs(ry)) < _NO_RADIUS
        arcs.append(None if is_line else (rx, ry, rotation, arc[4] == "1", arc[5] == "1"))
        text.append(f"{letter}{x!r} {y!r}")
        end = arc.end()
    if error is None and (not end or not is_end(arguments, end)):
        start = _end_of_blanks(arguments, end)
        found = f"found '{printable(arguments[start : start + 20])}'"
        expected = "the seven numbers of an arc belong, its flags 0 or 1"
        error = PathDataError(match.start(2) + start, f"{found} where {expected}")
    return " ".join(text), arcs, error


def trace(subpaths: list[Subpath]) -> list[Contour]:
    """Return the contours of checked subpaths; one that has no length is left out.

    Raises
    ------
    TooManySegments
        An arc is several cubics, so these are known only here.
    """
    found = []
    position = 0j
    for subpath in subpaths:
        if subpath.move is not None:
            position = subpath.move + (position if subpath.is_relative else 0j)
            # The moveto's own text is relative to where the last subpath ended.
            before = position - subpath.move if subpath.is_relative else 0j
        else:
            before = position
        start = position
        if subpath.count:
            path = list(parse_path(" ".join(subpath.text), current_pos=before))
            contour = _contour(path, subpath)
            if contour is not None:
                found.append(contour)
            if not subpath.closed:
                position = path[-1].end
        if subpath.closed:
            position = start
    return found


def _contour(path: list[Any], subpath: Subpath) -> Contour | None:
    """Return the contour of the segments that ``parse_path`` made of `subpath`."""
    segments: list[contours.Segment] = []
    straight: list[bool] = []
    for index, piece in enumerate(path):
        parameters = subpath.arcs.get(index)
        if parameters is not None:
            rx, ry, rotation, large, sweep = parameters
            curves = contours.arc(piece.start, piece.end, (rx, ry), rotation, large, sweep)
            segments.extend(curves)
            straight.extend([False] * len(curves))
            if len(segments) > MAX_SEGMENTS:
                raise TooManySegments
            continue
        points = piece.bpoints()
        if len(points) == 2:
            segments.append(contours.line(*points))
        elif len(points) == 3:
            segments.append(_raised(*points))
        else:
            segments.append(points)
        straight.append(len(points) == 2)
    return contours.chain(segments, straight, subpath.closed)


def _raised(start: complex, control: complex, end: complex) -> contours.Segment:
    """Return a quadratic segment as a cubic."""
    return (start, start + 2 / 3 * (control - start), end + 2 / 3 * (control - end), end)
