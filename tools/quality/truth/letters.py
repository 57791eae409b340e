"""Letters of variable fonts as pairs of known truth, made into a folder: python -m tools.quality.truth.letters DIR.

A letter has the same points wherever a font's axes stand, so its designer has said what becomes what, and how it looks
in between. The files give nothing of that away: B begins at another point, goes the other way round every second time,
has its contours in another order, and is scaled and shifted.
"""

from __future__ import annotations

import argparse
import json
import random
from itertools import compress, islice, pairwise
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from fontTools.pens.basePen import BasePen
from fontTools.ttLib import TTFont

from shapeblend_cli.geometry.polygons import signed_area
from shapeblend_cli.model import Box
from tools.quality.data import ROOT
from tools.quality.npm import install
from tools.quality.scores import is_crossed, is_overlapping
from tools.quality.truth.form import SETS
from tools.quality.truth.measures import apart, extent, reached

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from tools.quality.scores import Frame

    Segments = list[np.ndarray]  # of a contour, each its control points
    Outline = list[Segments]  # of a letter

HERE = Path(__file__).parent / "fonts"
INSTALLED = ROOT / "out" / "quality" / "fonts"
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

SEED = 2024
EM = 100.0
TIMES = (0.0, 0.25, 0.5, 0.75, 1.0)

EVEN = 0.005
"""A letter that, moved straight and evenly, is further from the truth than this, does not change evenly itself:
how fast an axis works on either side of its default is nothing that two drawings show."""

DIFFERENT = 0.15
"""Ends whose regions are less far from being the same are too easy."""

STRAY = 2e-4
"""Share of the em by which a true polygon may stray from its curves."""

LEAST_PIECES = 4
"""A curve is cut into no fewer pieces, so that none of its turns looks like a corner."""


class Letter(NamedTuple):
    """A letter of a font between two places of an axis.

    Attributes
    ----------
    family, char, axis : str
    outlines : sequence of outlines
        At `TIMES`, y downwards, `EM` to the em.
    """

    family: str
    char: str
    axis: str
    outlines: Sequence[Outline]

    @property
    def frames(self) -> list[Frame]:
        """The outlines as polygons, vertex for vertex."""
        pieces = [
            [max(_pieces(segment) for segment in same) for same in zip(*contours, strict=True)]
            for contours in zip(self.outlines[0], self.outlines[-1], strict=True)
        ]
        return [
            [_polygon(contour, counts) for contour, counts in zip(outline, pieces, strict=True)]
            for outline in self.outlines
        ]


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


def ready() -> str | None:
    """Install the fonts, or say why that cannot be."""
    return install(HERE, INSTALLED)


def letters(name: str) -> Iterator[Letter]:
    """The letters of a set: of each family as many as there shall be, axis after axis."""
    for family in FAMILIES:
        font = opened(family)
        characters = list(CHARACTERS[name])
        random.Random(f"{SEED} {package(family)} {name}").shuffle(characters)
        found: list[Letter] = []
        for character in characters:
            tried = (letter(font, family, character, *way) for way in _ways(font, len(found)))
            found += islice((one for one in tried if _is_fit(one, name)), 1)
            if len(found) == COUNTS[name]:
                break
        yield from found


def opened(family: str) -> TTFont:
    """The font of a family."""
    name = package(family)
    files = INSTALLED / "node_modules" / "@fontsource-variable" / name / "files"
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


def letter(font: TTFont, family: str, character: str, axis: str, low: float, high: float) -> Letter:
    """A character from one place of an axis to another, evenly as the font counts."""
    glyph = font.getBestCmap()[ord(character)]
    scale = EM / font["head"].unitsPerEm
    outlines = []
    for t in TIMES:
        glyphs = font.getGlyphSet(location={axis: low + t * (high - low)}, normalized=True)
        pen = _Pen(glyphs)
        glyphs[glyph].draw(pen)
        outlines.append([[scale * segment.conj() for segment in contour] for contour in pen.outline])
    return Letter(family, character, axis, _without_points(outlines))


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


def _is_fit(one: Letter, name: str) -> bool:
    """Whether it has as many contours as the set wants, is filled the same by both rules, and changes, and evenly."""
    if (len(one.outlines[0]) == 1) != (name == "single"):
        return False
    frames = one.frames
    first, *between, last = frames
    ends = list(zip(first, last, strict=True))
    straight = [[p + (q - p) * t for p, q in ends] for t in TIMES[1:-1]]
    return (
        all(map(_is_plain, frames))
        and apart(*_centred(first, last)) >= DIFFERENT
        and np.mean([apart(*both) for both in zip(straight, between, strict=True)]) <= EVEN
    )


def _is_plain(frame: Frame) -> bool:
    """Whether nothing crosses, and holes go the other way round than what they are in."""
    if any(is_crossed(contour) for contour in frame) or is_overlapping(frame):
        return False
    around = [
        [ring for ring in frame if ring is not contour and _is_in(contour[0], ring)] for contour in frame
    ]
    ways = [
        [np.sign(signed_area(ring)) for ring in [contour, *rings]]
        for contour, rings in zip(frame, around, strict=True)
    ]
    return all((len(way) % 2 == 1) == (sum(way) != 0) for way in ways)


def _is_in(point: complex, ring: np.ndarray) -> bool:
    angles = np.angle((np.roll(ring, -1) - point) / (ring - point))
    return abs(angles.sum()) > np.pi


def _centred(p: Frame, q: Frame) -> tuple[Frame, Frame]:
    """Both with the middle of their boxes at 0."""
    return tuple([contour - _middle(frame) for contour in frame] for frame in (p, q))


def _middle(frame: Frame) -> complex:
    return Box.around(np.concatenate(frame)).centre


def _pieces(segment: np.ndarray) -> int:
    """Into how many pieces it is cut, at even parameters."""
    if len(segment) == 2:
        return 1
    bend = float(np.abs(np.diff(segment, 2)).max()) * (len(segment) - 1) * (len(segment) - 2) / 8
    return max(LEAST_PIECES, int(np.ceil(np.sqrt(bend / (STRAY * EM)))))


def _polygon(contour: Segments, counts: Sequence[int]) -> np.ndarray:
    points = [_at(segment, np.arange(count) / count) for segment, count in zip(contour, counts, strict=True)]
    return np.round(np.concatenate(points), 3)


def _at(segment: np.ndarray, u: np.ndarray) -> np.ndarray:
    """Points of a segment, by blending its control points again and again."""
    points = segment[:, None] + 0.0 * u
    while len(points) > 1:
        points = np.array([p + (q - p) * u for p, q in pairwise(points)])
    return points[0]


def make(folder: Path) -> None:
    """Write all sets."""
    entries = []
    for name in SETS:
        for number, one in enumerate(letters(name)):
            place = f"{name}/{name}-{number:03}"
            known, a, b = pair(one, f"{name}-{number:03}", name)
            target = folder / place
            target.mkdir(parents=True, exist_ok=True)
            (target / "a.svg").write_text(a, encoding="utf-8")
            (target / "b.svg").write_text(b, encoding="utf-8")
            (target / "truth.json").write_text(f"{json.dumps(known)}\n", encoding="utf-8")
            entries.append(
                {key: known[key] for key in ("id", "set", "family", "char", "axis")} | {"dir": place}
            )
    index = {"seed": SEED, "pairs": entries}
    (folder / "index.json").write_text(f"{json.dumps(index, indent=1)}\n", encoding="utf-8")


def pair(one: Letter, label: str, name: str) -> tuple[dict, str, str]:
    """What is known of a letter, and its two files."""
    chance = random.Random(f"{SEED} {label}")
    scale = round(chance.uniform(0.8, 1.25), 4)
    shift = complex(round(chance.uniform(-30, 30), 2), round(chance.uniform(-30, 30), 2))
    back = chance.random() < 0.5
    frames = one.frames
    order = list(range(len(frames[0])))
    chance.shuffle(order)
    starts = [chance.randrange(len(contour)) for contour in one.outlines[-1]]
    moved = [[scale * segment + shift for segment in contour] for contour in one.outlines[-1]]
    drawn = [_begun(contour, start, back) for contour, start in zip(moved, starts, strict=True)]
    known = {
        "id": label,
        "set": name,
        "family": one.family,
        "char": one.char,
        "axis": one.axis,
        "transform": {"scale": scale, "dx": shift.real, "dy": shift.imag},
        "reversed": back,
        "contour_map": [[k, order.index(k)] for k in range(len(order))],
        "frames": {
            f"{t:g}": [_points(contour) for contour in frame] for t, frame in zip(TIMES, frames, strict=True)
        },
        "pairs": [
            _where(p, q, complex(contour[0][0] - shift) / scale, back)
            for p, q, contour in zip(frames[0], frames[-1], drawn, strict=True)
        ],
    }
    return known, _svg(one.outlines[0]), _svg([drawn[k] for k in order])


def _begun(contour: Segments, start: int, back: bool) -> Segments:
    """A contour from another of its segments on, the other way round if so told."""
    turned = contour[start:] + contour[:start]
    return [segment[::-1] for segment in turned[::-1]] if back else turned


def _where(p: np.ndarray, q: np.ndarray, start: complex, back: bool) -> list[list[float]]:
    """For each vertex how far round it is, in A's file and in B's, each from its own start and in its own direction."""
    u, v = (reached(contour)[:-1] for contour in (p, q))
    v -= v[np.abs(q - start).argmin()]
    v = -v if back else v
    v -= np.round(v[0])
    return [[round(float(s), 5), round(float(r), 5)] for s, r in zip(u, v, strict=True)]


def _points(contour: np.ndarray) -> list[list[float]]:
    return [[z.real, z.imag] for z in contour.tolist()]


def _svg(outline: Outline) -> str:
    """A file that draws an outline with room around it."""
    points = np.concatenate([np.concatenate(contour) for contour in outline])
    box = Box.around(points).expanded(0.05 * extent([points]))
    x, y, width, height = map(round, box)
    data = "".join(_data(contour) for contour in outline)
    return f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{x} {y} {width} {height}"><path d="{data}"/></svg>\n'


def _data(contour: Segments) -> str:
    """Path data; the line that closes a contour is left to Z, and curves that are lines here are written as such."""
    segments = [segment[[0, -1]] if _is_straight(segment) else segment for segment in contour]
    if len(segments[-1]) == 2:
        segments = segments[:-1]
    drawn = ("LQC"[len(segment) - 2] + " ".join(map(_number, segment[1:])) for segment in segments)
    return f"M{_number(contour[0][0])}{''.join(drawn)}Z"


def _is_straight(segment: np.ndarray) -> bool:
    """Whether it is a line by the decimals that are written."""
    chord = segment[-1] - segment[0]
    away = np.abs((np.conj(chord) * (segment[1:-1] - segment[0])).imag)
    return bool((away <= 1e-3 * abs(chord)).all())


def _number(z: complex) -> str:
    return f"{z.real:.3f},{z.imag:.3f}"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path, nargs="?", default=FOLDER)
    folder = parser.parse_args().folder
    if problem := ready():
        raise SystemExit(f"no letters: {problem}")
    make(folder)
    print(folder)


if __name__ == "__main__":
    main()
