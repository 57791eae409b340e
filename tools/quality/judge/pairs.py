"""Pairs of icons drawn by lot, from packages that npm installs."""

from __future__ import annotations

import functools
import random
from typing import NamedTuple

from tools.quality.npm import icon_set

GAME, CONTRAST = "game-icons", "fluent-emoji-high-contrast"
SETS = (GAME, "ph", GAME, CONTRAST, GAME, "material-symbols", "healthicons", GAME, "twemoji", GAME)
"""The packages of ten pairs; the next ten have the same ones."""

LEFT_OUT = (
    *("skin", "flag", "keycap", "family", "couple", "holding-hands", "kiss-", "-hair"),
    *("letter", "input-", "clock"),
)
"""Names with these are left out: there are hundreds that are nearly the same."""

VARIANTS = {
    "ph": ("-bold", "-duotone", "-light", "-thin"),
    "material-symbols": ("-rounded", "-sharp", "-outline"),
    "healthicons": ("-outline", "-24px"),
}
"""The same drawings again in another style, by how their names end."""

COMMON_WORDS = {"fill", "face", "with", "sign", "button"}
"""Words that do not make two icons alike."""

LONGEST, MOST_TAGS = 1300, 8
"""Characters of a drawing, and tags in it."""


class Pair(NamedTuple):
    """Two icons of a package."""

    icons: str
    a: str
    b: str


@functools.cache
def names(icons: str) -> list[str]:
    """The icons of a package that may be drawn."""
    return sorted(
        name
        for name in icon_set(icons)["icons"]
        if not any(part in name for part in LEFT_OUT) and not name.endswith(VARIANTS.get(icons, ()))
    )


def picked(seed: int, count: int) -> list[Pair]:
    """So many pairs by lot: every other one of two icons with a word in common, the rest of any two."""
    lots = random.Random(seed)
    return [_pick(lots, SETS[k % len(SETS)], related=k % 2 == 0) for k in range(count)]


def _pick(lots: random.Random, icons: str, related: bool) -> Pair:
    every = names(icons)
    while True:
        a = lots.choice(every)
        words = {word for word in a.split("-") if len(word) > 3} - COMMON_WORDS
        if related:
            others = [name for name in every if name != a and words & set(name.split("-"))]
        else:
            others = lots.sample(every, 1)
        if not others:
            continue
        b = lots.choice(others)
        if a != b and _is_simple(icons, a) and _is_simple(icons, b):
            return Pair(icons, a, b)


def _is_simple(icons: str, name: str) -> bool:
    body = icon_set(icons)["icons"][name]["body"]
    return len(body) <= LONGEST and body.count("<") <= MOST_TAGS
