"""When parts of a drawing move: a start and a length for each, in JSON."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

from shapeblend_cli.errors import unreadable

FORM = '{"#sun": {"start": 0.2, "length": 0.5}}'

MAX_BYTES = 2**20
"""Maximum size of a file, in bytes. Whatever is larger is another file."""

SLACK = 1e-9
"""Maximum excess of a start and a length over 1, as a share of the time: they may be rounded."""


class Timetable(NamedTuple):
    """The names of parts, each with the times of its start and its end, as shares of the time."""

    parts: tuple[tuple[str, float, float], ...] = ()
    file: str = ""  # that it was read from, if it was

    def __str__(self) -> str:
        """As it is typed, without a file."""
        if not self.parts:
            return ""
        import json

        rows = {name: {"start": start, "length": round(end - start, 12)} for name, start, end in self.parts}
        return json.dumps(rows, ensure_ascii=False)


def parse(text: str) -> Timetable:
    """Read a timetable that is typed as JSON, or the file with a name.

    Raises
    ------
    InputError
        If the file cannot be read.
    ValueError
        If it is no timetable; the error says what it must be.
    """
    if text.lstrip().startswith("{"):
        return timetable(_json(text))
    try:
        with open(text, "rb") as stream:
            data = stream.read(MAX_BYTES)
    except (OSError, ValueError) as error:
        raise unreadable(text, error, "JSON file") from None
    return timetable(_json(data.decode("utf-8-sig", "replace")))._replace(file=text)


def timetable(value: Any) -> Timetable:
    """Return a timetable in its one form; raise ValueError, with what it must be, for anything else."""
    if isinstance(value, Timetable):
        return value
    if not isinstance(value, Mapping) or not value:
        raise ValueError(f"an object of JSON with a key for each part, such as {FORM}")
    return Timetable(tuple((_name(name), *_span(name, row)) for name, row in value.items()))


def _json(text: str) -> Any:
    import json

    def once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
        found = dict(pairs)
        if len(found) < len(pairs):
            twice = next(name for k, (name, _) in enumerate(pairs) if name in dict(pairs[:k]))
            raise ValueError(f"an object of JSON; it has {twice!r} twice")
        return found

    try:
        return json.loads(text, object_pairs_hook=once)
    except json.JSONDecodeError as error:
        raise ValueError(f"JSON such as {FORM}; line {error.lineno}: {error.msg}") from None
    except RecursionError:
        raise ValueError(f"JSON such as {FORM}; it is nested too deeply") from None


def _name(name: Any) -> str:
    if not isinstance(name, str) or not name:
        raise ValueError(f"an object of JSON whose keys are the names of parts, such as {FORM}")
    return name


def _span(name: str, row: Any) -> tuple[float, float]:
    if not isinstance(row, Mapping) or not row or row.keys() - {"start", "length"}:
        raise ValueError(f"of the form {FORM}; {name!r} has {row!r:.60}")
    for key, value in row.items():
        if isinstance(value, bool) or not isinstance(value, int | float) or not 0.0 <= value <= 1.0:
            raise ValueError(f"in shares of the time, from 0 to 1; {key} of {name!r} is {value!r:.60}")
    start = float(row.get("start", 0.0))
    end = start + float(row.get("length", 1.0 - start))
    if end > 1.0 + SLACK or end <= start:
        what = "nothing is left for its length" if end <= start else f"it ends at {end:g}, after 1"
        raise ValueError(f"in shares of the time, from 0 to 1; {name!r} starts at {start:g}, and {what}")
    return start, min(end, 1.0)
