"""Letters of variable fonts as pairs of known truth.

A letter has the same points wherever a font's axes stand, so its designer has said what becomes what, and how it looks
in between.
"""

from __future__ import annotations

import random
from itertools import compress, islice
from typing import TYPE_CHECKING

import numpy as np
from fontTools.pens.basePen import BasePen
from fontTools.ttLib import TTFont

from tools.quality.data import ROOT
from tools.quality.npm import MODULES
from tools.quality.truth.form import SETS
from tools.quality.truth.measures import apart
from tools.quality.truth.write import SEED, SIZE, Morph, centred, is_plain, write

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from tools.quality.truth.write import Outline

FOLDER = ROOT / "out" / "truth"

FAMILIES = {
    "Archivo": "latin-standard-normal",
    "Big Shoulders Display": "latin-wght-normal",
    "Bodoni Moda": "latin-standard-normal",
    "Dancing Script": "latin-wght-normal",
    "Fraunces": "latin-full-normal",
    "Hepta Slab": "latin-wght-normal",
    "JetBrains Mono": "latin-wght-normal",
    "Newsreader": "latin-standard-normal",
}
"""A sans, a condensed display face, a didone, a script, a soft serif, a slab, a mono and a text serif: their files."""

CHARACTERS = {
    "single": "CEFGHIJKLMNSTUVWXYZcfhklmnrstuvwxyz123457",
    "multi": "ABDOPQRabdegijopq04689%&?!",
}
COUNTS = {"single": 5, "multi": 3}
"""How many letters of each family a set has."""

TIMES = (0.0, 0.25, 0.5, 0.75, 1.0)

EVEN = 0.005
"""A letter that, moved straight and evenly, is further from the truth than this, does not change evenly itself:
how fast an axis works on either side of its default is nothing that two drawings show."""

DIFFERENT = 0.15
"""Ends whose regions are less far from being the same are too easy."""


class _Pen(BasePen):
    """Takes down outlines as segments."""

    def __init__(self, glyphs: object) -> None:
        super().__init__(glyphs)
        self.outline: Outline = []

    def _moveTo(self, point: tuple) -> None:
        self.outline.append([])
        self.first = self.last = complex(*point)

    def _add(self, *points: tuple) -> None:
        segment = np.array([self.last, *(complex(*point) for point in points)])
        self.outline[-1].append(segment)
        self.last = segment[-1]

    _lineTo = _qCurveToOne = _curveToOne = _add

    def _closePath(self) -> None:
        self.outline[-1].append(np.array([self.last, self.first]))


def letters(name: str) -> Iterator[Morph]:
    """The letters of a set: of each family as many as there shall be, axis after axis."""
    for family in FAMILIES:
        font = opened(family)
        characters = list(CHARACTERS[name])
        random.Random(f"{SEED} {package(family)} {name}").shuffle(characters)
        found: list[Morph] = []
        for character in characters:
            tried = (letter(font, family, character, *way) for way in _ways(font, len(found)))
            found += islice((one for one in tried if _is_fit(one, name)), 1)
            if len(found) == COUNTS[name]:
                break
        yield from found


def opened(family: str) -> TTFont:
    """The font of a family."""
    name = package(family)
    files = MODULES / "@fontsource-variable" / name / "files"
    return TTFont(files / f"{name}-{FAMILIES[family]}.woff2")


def package(family: str) -> str:
    """What npm calls it."""
    return family.lower().replace(" ", "-")


def _ways(font: TTFont, turn: int) -> Iterator[tuple[str, float, float]]:
    """Ways along an axis, from where to where as the font counts, with 0 its default; another axis first each turn."""
    axes = font["fvar"].axes
    for axis in np.roll(axes, -turn):
        low, high = -float(axis.minValue < axis.defaultValue), float(axis.maxValue > axis.defaultValue)
        yield from ((axis.axisTag, *way) for way in dict.fromkeys([(low, high), (low, 0.0), (0.0, high)]))


def letter(font: TTFont, family: str, character: str, axis: str, low: float, high: float) -> Morph:
    """A character from one place of an axis to another, evenly as the font counts."""
    glyph = font.getBestCmap()[ord(character)]
    scale = SIZE / font["head"].unitsPerEm
    outlines = []
    for t in TIMES:
        glyphs = font.getGlyphSet(location={axis: low + t * (high - low)}, normalized=True)
        pen = _Pen(glyphs)
        glyphs[glyph].draw(pen)
        outlines.append([[scale * segment.conj() for segment in contour] for contour in pen.outline])
    return Morph({"family": family, "char": character, "axis": axis}, TIMES, _without_points(outlines))


def _without_points(outlines: list[Outline]) -> list[Outline]:
    """Outlines without the segments that are points at all times."""
    seen = [
        [
            any(np.ptp(segment.real) + np.ptp(segment.imag) for segment in same)
            for same in zip(*contours, strict=True)
        ]
        for contours in zip(*outlines, strict=True)
    ]
    return [
        [list(compress(contour, kept)) for contour, kept in zip(outline, seen, strict=True)]
        for outline in outlines
    ]


def _is_fit(one: Morph, name: str) -> bool:
    """Whether it has as many contours as the set wants, is filled the same by both rules, and changes, and evenly."""
    if (len(one.outlines[0]) == 1) != (name == "single"):
        return False
    frames = one.frames
    first, *between, last = frames
    ends = list(zip(first, last, strict=True))
    straight = [[p + (q - p) * t for p, q in ends] for t in TIMES[1:-1]]
    return (
        all(map(is_plain, frames))
        and apart(*centred(first, last)) >= DIFFERENT
        and np.mean([apart(*both) for both in zip(straight, between, strict=True)]) <= EVEN
    )


def make(folder: Path) -> None:
    """Write all sets."""
    write(folder, {name: letters(name) for name in SETS})
