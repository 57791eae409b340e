"""Fonts: those that a file embeds, and those installed. HarfBuzz reads them, and fontTools unpacks WOFF2.

Both libraries come with the extra ``text``, and are imported only for a drawing with text.
"""

from __future__ import annotations

import base64
import binascii
import os
import re
import struct
import subprocess
import sys
import zlib
from collections.abc import Iterable, Iterator
from functools import cache, lru_cache
from typing import Any, NamedTuple
from urllib.parse import unquote_to_bytes

from shapeblend_cli.svg.xml.messages import Notes, printable

INSTALL = "pip install 'shapeblend[text]'"

MOST_BYTES = 64 * 2**20
"""Maximum size of a font when it is unpacked, in bytes: large Chinese ones have 20 MB."""

MOST_FACES = 64
"""Maximum number of fonts that a file embeds."""

MOST_TABLES = 256
"""Maximum number of tables of a font; real ones have up to 40."""

MOST_FAMILIES = 20
"""Maximum number of families in a list of fonts that are tried."""

MOST_FILES = 3_000
"""Maximum number of font files that are looked at."""

SLANT = 0.25
"""Slope of letters that are slanted for want of an italic font, as in browsers."""

BOLDER = 1 / 32
"""Growth of letters that are emboldened for want of a bold font, as a share of the font's size."""

_GENERIC = frozenset(
    "serif sans-serif monospace cursive fantasy system-ui ui-serif ui-sans-serif math".split()
)
# Fonts of the same widths, which browsers take for each other without a word.
_SAME_WIDTHS = {
    "arial": ("liberation sans", "arimo"),
    "helvetica": ("liberation sans", "arimo", "nimbus sans"),
    "times": ("liberation serif", "tinos"),
    "times new roman": ("liberation serif", "tinos"),
    "courier": ("liberation mono", "cousine"),
    "courier new": ("liberation mono", "cousine"),
}
_FOLDERS = {
    "win32": (r"%WINDIR%\Fonts", r"%LOCALAPPDATA%\Microsoft\Windows\Fonts"),
    "darwin": ("~/Library/Fonts", "/Library/Fonts", "/System/Library/Fonts"),
}
_ELSEWHERE = ("~/.fonts", "~/.local/share/fonts", "/usr/local/share/fonts", "/usr/share/fonts")
_STAND_INS = {
    "serif": ("times new roman", "times", "dejavu serif"),
    "monospace": ("courier new", "menlo", "dejavu sans mono"),
}
_SANS = ("arial", "helvetica", "dejavu sans")
_FONT_FACE = re.compile(r"@font-face\s*+\{([^}]*+)\}", re.IGNORECASE)
_PROPERTY = re.compile(r"""([-\w]++)\s*+:\s*+((?:"[^"]*+"|'[^']*+'|url\([^)]*+\)|[^;"'])++)""")
_DATA = re.compile(r"""url\(\s*+["']?data:([^,"')]*+),([^"')]*+)["']?\s*+\)""", re.IGNORECASE)
_FAMILY = re.compile(r""""([^"]*+)"|'([^']*+)'|([^,"']++)""")
_WEIGHTS = {"normal": 400, "bold": 700}


class FontError(ValueError):
    """A font that cannot be read; the message says why."""


class Wanted(NamedTuple):
    """What a text asks of a font."""

    families: tuple[str, ...]
    weight: int = 400
    is_slanted: bool = False


class Face(NamedTuple):
    """A font as HarfBuzz has it; lengths are in units of which `unit` make the font's size."""

    font: Any
    name: str
    unit: int

    def has(self, character: str) -> bool:
        """Return whether the font draws a character."""
        return bool(self.font.get_nominal_glyph(ord(character)))


class _Embedded(NamedTuple):
    family: str
    weights: tuple[int, int]
    is_slanted: bool
    source: str


class Fonts:
    """The fonts for one drawing, whose style sheets are `sheets`; notes are made of those that are missing."""

    def __init__(self, sheets: Iterable[str], notes: Notes) -> None:
        self._notes = notes
        self._embedded = [face for sheet in sheets for face in _embedded(sheet)][:MOST_FACES]
        self._known: dict[tuple[Wanted, int | _Embedded], Face | None] = {}
        self._lists: dict[Wanted, list[Face]] = {}

    def faces(self, wanted: Wanted) -> list[Face]:
        """Return the fonts for a text, the preferred first; note a missing first choice once."""
        if wanted not in self._lists:
            found = []
            for family in wanted.families[:MOST_FAMILIES]:
                face = self._face(family, wanted)
                found += [face] if face else []
                if face and len(found) == 1:
                    self._tell(wanted, face)
            if not found:
                # As Chromium: what is as wide as its standard font, or else any without serifs.
                face = self._installed(wanted, "Times New Roman")
                face = face or self._installed(wanted, "sans-serif", is_any=True)
                found = [face] if face else []
                if face:
                    self._tell(wanted, face)
            self._lists[wanted] = found
        return self._lists[wanted]

    def rules(self, wanted: Wanted) -> list[str]:
        """Return rules of CSS for the fonts of a text that the drawing embeds and that can be read."""
        names = [family.lower() for family in wanted.families[:MOST_FAMILIES]]
        return [
            _rule(face)
            for face in self._embedded
            if face.family.lower() in names and self._known.get((wanted, face)) is not None
        ]

    def fallback(self, wanted: Wanted, character: str) -> Face | None:
        """Return an installed font that draws a character, or None."""
        family = wanted.families[0] if wanted.families else "serif"
        face = self._installed(wanted, f"{family}:charset={ord(character):x}", is_any=True)
        return face if face and face.has(character) else None

    def _tell(self, wanted: Wanted, face: Face) -> None:
        first = wanted.families[0] if wanted.families else ""
        if first and first.lower() not in _GENERIC and first.lower() != face.name.lower():
            self._notes.add(f"font '{printable(first)}' is not there: {face.name} taken")

    def _face(self, family: str, wanted: Wanted) -> Face | None:
        here = [face for face in self._embedded if face.family.lower() == family.lower()]
        for face in sorted(here, key=lambda face: _distance(face, wanted)):
            key = wanted, face
            if key not in self._known:
                self._known[key] = self._unpacked(face, wanted)
            if self._known[key]:
                return self._known[key]
        return self._installed(wanted, family)

    def _unpacked(self, face: _Embedded, wanted: Wanted) -> Face | None:
        try:
            return _opened(
                _sfnt(_decoded(face.source)), 0, face.family, wanted, face.weights[1], face.is_slanted
            )
        except (FontError, ValueError, struct.error, zlib.error) as error:
            why = str(error) if isinstance(error, FontError) else "it is damaged"
            self._notes.add(f"embedded font '{printable(face.family)}' not used: {why}")
            return None

    def _installed(self, wanted: Wanted, family: str, is_any: bool = False) -> Face | None:
        found = _installed(family, wanted.weight, wanted.is_slanted)
        if found is None:
            return None
        file, index, names, weight, is_slanted = found
        asked = family.lower()
        is_same = asked in _GENERIC or any(
            name in (asked, *_SAME_WIDTHS.get(asked, ())) for name in map(str.lower, names)
        )
        if not (is_any or is_same):
            return None
        try:
            return _opened(_bytes_of(file), index, names[0], wanted, weight, is_slanted)
        except (OSError, FontError, ValueError, struct.error):
            return None


def families(text: str) -> tuple[str, ...]:
    """Return the names in a list of font families."""
    found = (next(filter(None, match), "").strip() for match in _FAMILY.findall(text[:10_000]))
    return tuple(" ".join(name.split()) for name in found if name)[:MOST_FAMILIES]


def weight_of(text: str) -> int:
    """Return a font's weight from 1 to 1000."""
    text = text.strip().lower()
    value = _WEIGHTS.get(text)
    if value is None:
        value = int(float(text)) if re.fullmatch(r"[0-9]{1,4}(\.[0-9]{1,9})?", text) else 400
    return min(max(value, 1), 1000)


def _embedded(sheet: str) -> Iterable[_Embedded]:
    for rule in _FONT_FACE.findall(sheet):
        declared = {name.lower(): value.strip() for name, value in _PROPERTY.findall(rule)}
        names = families(declared.get("font-family", ""))
        if names and "src" in declared:
            weights = [weight_of(part) for part in declared.get("font-weight", "400").split()[:2]] or [400]
            style = declared.get("font-style", "normal").lower()
            yield _Embedded(
                names[0],
                (min(weights), max(weights)),
                style.startswith(("italic", "oblique")),
                declared["src"],
            )


def _distance(face: _Embedded, wanted: Wanted) -> tuple[bool, int]:
    """Order faces of a family by how far they are from what is wanted: the style first, then the weight."""
    low, high = face.weights
    apart = max(low - wanted.weight, wanted.weight - high, 0)
    # Of two as far away, light text rather takes the lighter and bold text the bolder one.
    is_other_way = (high < wanted.weight) == (wanted.weight > 500)
    return face.is_slanted != wanted.is_slanted, 2 * apart + (not is_other_way)


def _decoded(source: str) -> bytes:
    match = _DATA.search(source)
    if match is None:
        raise FontError("it is not in the file, and nothing is fetched")
    kind, data = match.groups()
    if len(data) > 2 * MOST_BYTES:
        raise FontError(f"larger than {MOST_BYTES // 2**20} MB, the limit")
    octets = unquote_to_bytes(data)
    if not kind.lower().strip().endswith("base64"):
        return octets
    try:
        return base64.b64decode(b"".join(octets.split()) + b"==")
    except binascii.Error:
        raise FontError("its data is damaged") from None


def _rule(face: _Embedded) -> str:
    data = base64.b64encode(_decoded(face.source)).decode("ascii")
    weights = " ".join(map(str, dict.fromkeys(face.weights)))
    style = "italic" if face.is_slanted else "normal"
    return (
        f"@font-face{{font-family:{quoted(face.family)};font-weight:{weights};font-style:{style};"
        f"src:url(data:font/sfnt;base64,{data})}}"
    )


def quoted(family: str) -> str:
    """Return the name of a font as a string of CSS."""
    return '"' + "".join(c for c in family if c.isprintable() and c not in '"\\<>') + '"'


def _sfnt(data: bytes) -> bytes:
    """Return a font unpacked, as TrueType or OpenType."""
    if data[:4] == b"wOFF":
        return _from_woff(data)
    return _from_woff2(data) if data[:4] == b"wOF2" else data


def _check(tables: int, size: int) -> None:
    if tables > MOST_TABLES or size > MOST_BYTES:
        raise FontError(
            f"it unpacks to more than {MOST_BYTES // 2**20} MB or {MOST_TABLES} tables, the limits"
        )


def _from_woff(data: bytes) -> bytes:
    flavor, count = data[4:8], struct.unpack(">H", data[12:14])[0]
    _check(count, 0)
    entries = [struct.unpack(">4s4L", data[44 + 20 * k : 64 + 20 * k]) for k in range(count)]
    _check(count, sum(entry[3] for entry in entries))
    directory, body, offset = b"", b"", 12 + 16 * count
    for tag, start, packed, size, checksum in entries:
        table = data[start : start + packed]
        if packed < size:
            table = zlib.decompressobj().decompress(table, size)
        directory += struct.pack(">4s3L", tag, checksum, offset + len(body), len(table))
        body += table + b"\0" * (-len(table) % 4)
    return flavor + struct.pack(">4H", count, 0, 0, 0) + directory + body


def _from_woff2(data: bytes) -> bytes:
    import io

    import brotli
    from fontTools.ttLib import TTLibError, woff2

    count, packed = struct.unpack(">H", data[12:14])[0], struct.unpack(">L", data[20:24])[0]
    _check(count, 0)
    rest, size = data[48:], 0
    try:
        for _ in range(count):
            entry = woff2.WOFF2DirectoryEntry()
            rest = entry.fromString(rest)
            size += max(entry.length, entry.origLength)
        _check(count, size)
        # A stream that unpacks to more than it says is a bomb; fontTools would unpack all of it.
        unpacked = brotli.Decompressor().process(rest[:packed], output_buffer_limit=size + 1)
        if len(unpacked) > size:
            raise FontError("its data is longer than it says")
        stream = io.BytesIO()
        woff2.decompress(io.BytesIO(data), stream)
    except FontError:
        raise
    except (TTLibError, brotli.error, Exception) as error:
        # fontTools raises whatever damaged data leads to: assertions, indices, struct.error.
        if isinstance(error, MemoryError):
            raise
        raise FontError("it is damaged") from None
    return stream.getvalue()


@lru_cache(maxsize=32)
def _bytes_of(file: str) -> bytes:
    with open(file, "rb") as stream:
        data = stream.read(MOST_BYTES + 1)
    _check(0, len(data))
    return data


def _opened(data: bytes, index: int, name: str, wanted: Wanted, weight: int, is_slanted: bool) -> Face:
    """Return a font with its axes set; one that is not bold or slanted as wanted is made so, as in browsers."""
    import uharfbuzz as hb

    _check(0, len(data))
    face = hb.Face(data, index)
    if not face.glyph_count or not face.upem or not face.unicodes:
        raise FontError("it is no font with letters")
    font = hb.Font(face)
    axes = {axis.tag for axis in face.axis_infos}
    if "wght" in axes:
        font.set_variations({"wght": float(wanted.weight)})
    elif wanted.weight >= 600 and weight < 600:
        font.synthetic_bold = (BOLDER, BOLDER, True)
    if wanted.is_slanted and not is_slanted:
        font.synthetic_slant = SLANT
    return Face(font, name, face.upem)


_FontFile = tuple[str, int, list[str], int, bool]


@lru_cache(maxsize=256)
def _installed(family: str, weight: int, is_slanted: bool) -> _FontFile | None:
    """Return the file that fontconfig, or else a look into the system's folders, has for a font."""
    name, _, charset = family.partition(":")
    pattern = re.sub(r"([\\\-:,=])", r"\\\1", name) + (f":{charset}" if charset else "")
    pattern += f":weight={_fontconfig_weight(weight)}:slant={100 if is_slanted else 0}"
    what = "%{file}\t%{index}\t%{family}\t%{weight}\t%{slant}"
    try:
        answer = subprocess.run(
            ["fc-match", "-f", what, pattern], capture_output=True, timeout=20, check=True
        ).stdout.decode("utf-8", "replace")
        file, index, names, heavy, slant = answer.split("\t")
    except (OSError, ValueError, subprocess.SubprocessError):
        return _look_for(name, weight, is_slanted, chr(int(charset[8:], 16)) if charset else "")
    is_bold = heavy.isdecimal() and int(heavy) >= 180
    return file, int(index) & 0xFFFF, names.split(","), 700 if is_bold else 400, slant != "0"


def _fontconfig_weight(weight: int) -> int:
    """Return a weight of CSS on fontconfig's scale."""
    scale = {100: 0, 200: 40, 300: 50, 400: 80, 500: 100, 600: 180, 700: 200, 800: 205, 900: 210}
    return scale[min(max(round(weight / 100) * 100, 100), 900)]


def _look_for(family: str, weight: int, is_slanted: bool, character: str = "") -> _FontFile | None:
    """Return the file of the font nearest to what is wanted, of any family if it has to draw a character."""
    names = (family.lower(), *_STAND_INS.get(family.lower(), _SANS))
    known = [font for font in _known() if character or font[2][0].lower() in names]

    def distance(font: _FontFile) -> tuple[int, bool, int]:
        name = font[2][0].lower()
        place = names.index(name) if name in names else len(names)
        return place, font[4] != is_slanted, abs(font[3] - weight)

    ordered = sorted(known, key=distance)
    return next((font for font in ordered if not character or _draws(font[0], font[1], character)), None)


def _files() -> Iterator[str]:
    for folder in _FOLDERS.get(sys.platform, _ELSEWHERE):
        for around, _, names in os.walk(os.path.expanduser(os.path.expandvars(folder))):
            yield from (
                os.path.join(around, name)
                for name in sorted(names)
                if name.lower().endswith((".ttf", ".otf", ".ttc"))
            )


@cache
def _known() -> tuple[_FontFile, ...]:
    import itertools

    import uharfbuzz as hb

    found = []
    for file in itertools.islice(_files(), MOST_FILES):
        try:
            blob = hb.Blob.from_file_path(file)
            for index in range(hb.Face(blob).count if file.lower().endswith(".ttc") else 1):
                face = hb.Face(blob, index)
                # 16 and 17 are the family and the style with more than four faces, 1 and 2 those of before.
                name, style = (
                    face.get_name(new, "en") or face.get_name(old, "en") or ""
                    for new, old in ((16, 1), (17, 2))
                )
                font = hb.Font(face)
                weight = int(font.get_style_value(hb.StyleTag.WEIGHT))
                found.append(
                    (file, index, [name], weight, "ital" in style.lower() or "obli" in style.lower())
                )
        except (OSError, ValueError, hb.HarfBuzzError):
            continue
    return tuple(found)


def _draws(file: str, index: int, character: str) -> bool:
    import uharfbuzz as hb

    font = hb.Font(hb.Face(hb.Blob.from_file_path(file), index))
    return bool(font.get_nominal_glyph(ord(character)))
