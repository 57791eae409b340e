"""Scores as they lie in docs/quality.json: columns of numbers, a row a pair; null all over where there is no score."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Sequence

DIGITS = 5
"""Decimals that are kept."""


def columns(kind: type[NamedTuple], records: Sequence[NamedTuple | None]) -> dict[str, list[Any]]:
    """A list for each field."""
    return {
        name: [None if record is None else _plain(getattr(record, name)) for record in records]
        for name in kind._fields
    }


def records(kind: type[NamedTuple], found: dict[str, list[Any]]) -> list[Any]:
    """The records again; one that begins with nothing is none."""
    rows = zip(*(found[name] for name in kind._fields), strict=True)
    return [None if row[0] is None else kind(*row) for row in rows]


def _plain(value: Any) -> Any:
    """A value as JSON has it, where yes is 1 and no is 0."""
    if isinstance(value, bool):
        return int(value)
    return round(float(value), DIGITS) if isinstance(value, float) else value


def text(found: Any, indent: str = "") -> str:
    """JSON with a line for each list."""
    if not isinstance(found, dict):
        return json.dumps(found, separators=(",", ":"), ensure_ascii=False)
    deeper = f"{indent} "
    lines = [f"\n{deeper}{json.dumps(name)}: {text(found[name], deeper)}" for name in found]
    return f"{{{','.join(lines)}\n{indent}}}"
