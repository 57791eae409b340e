"""Scripts and directions of characters, by the tables of Unicode."""

from __future__ import annotations

import unicodedata
from itertools import groupby
from typing import TYPE_CHECKING, TypeVar

if TYPE_CHECKING:
    from collections.abc import Sequence

T = TypeVar("T")


def scripts_of(characters: str) -> list[str]:
    """Return the script of each character; those of all scripts have that of the one before, or else after."""
    from fontTools import unicodedata as scripts

    found = [scripts.script(character) for character in characters]
    known = next((script for script in found if script not in ("Zyyy", "Zinh", "Zzzz")), "Latn")
    for k, script in enumerate(found):
        known = found[k] = known if script in ("Zyyy", "Zinh", "Zzzz") else script
    return found


def levels_of(characters: str, is_rtl: bool) -> list[int]:
    """Return the embedding levels of Unicode's bidirectional algorithm, without explicit embeddings."""
    base = int(is_rtl)
    kinds: list[str | None] = []
    strong = "R" if is_rtl else "L"
    for character in characters:
        kind: str | None = unicodedata.bidirectional(character)
        if kind in ("L", "R", "AL"):
            kind = strong = "L" if kind == "L" else "R"
        elif kind == "EN":
            kind = "L" if strong == "L" else "N"
        elif kind == "AN":
            kind = "N"
        elif kind == "NSM":
            kind = kinds[-1] if kinds else None
        else:
            kind = None
        kinds.append(kind)
    levels = {"L": 2 * base, "R": 1, "N": 2}
    found = [base if kind is None else levels[kind] for kind in kinds]
    for is_neutral, group in groupby(range(len(kinds)), lambda k: kinds[k] is None):
        members = list(group)
        if is_neutral:
            around = [
                kinds[k] if 0 <= k < len(kinds) else "R" if is_rtl else "L"
                for k in (members[0] - 1, members[-1] + 1)
            ]
            sides = {"L" if kind == "L" else "R" for kind in around}
            # A separator within a number is part of it.
            is_inside = len(members) == 1 and around == ["N", "N"] and characters[members[0]] in ",.:/+-"
            if is_inside:
                found[members[0]] = 2
            elif len(sides) == 1:
                found[members[0] : members[-1] + 1] = [levels[sides.pop()]] * len(members)
    return found


def in_visual_order(parts: Sequence[T], levels: Sequence[int]) -> list[T]:
    """Return parts of a line from left to right: those of a level or a higher one are reversed together."""
    order = list(range(len(parts)))
    for level in range(max(levels, default=0), 0, -1):
        start = 0
        while start < len(order):
            end = start
            while end < len(order) and levels[order[end]] >= level:
                end += 1
            order[start:end] = order[start:end][::-1]
            start = end + 1
    return [parts[k] for k in order]
