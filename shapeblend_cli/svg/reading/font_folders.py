"""Installed fonts where there is no fontconfig: those in the system's folders, by the names in their files."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from functools import cache

MOST_FILES = 3_000
"""Maximum number of font files that are looked at."""

_FOLDERS = {
    "win32": (r"%WINDIR%\Fonts", r"%LOCALAPPDATA%\Microsoft\Windows\Fonts"),
    "darwin": ("~/Library/Fonts", "/Library/Fonts", "/System/Library/Fonts"),
}
_ELSEWHERE = ("~/.fonts", "~/.local/share/fonts", "/usr/local/share/fonts", "/usr/share/fonts")
_GENERIC = {
    "serif": ("times new roman", "times", "dejavu serif"),
    "monospace": ("courier new", "menlo", "dejavu sans mono"),
}
_SANS = ("arial", "helvetica", "dejavu sans")

_FontFile = tuple[str, int, list[str], int, bool]


def look_for(family: str, weight: int, is_slanted: bool, character: str = "") -> _FontFile | None:
    """Return the file of the font nearest to what is wanted, of any family if it has to draw a character."""
    names = (family.lower(), *_GENERIC.get(family.lower(), _SANS))
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
