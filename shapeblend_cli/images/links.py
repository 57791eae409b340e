"""Where the bytes of a picture are: in a link itself, or in a file beside the drawing. Nothing else is opened."""

from __future__ import annotations

import binascii
import os
import re
import stat
from urllib.parse import unquote, unquote_to_bytes

MOST_BYTES = 32 * 2**20
"""Maximum size of a picture's file, in bytes."""

_DATA = re.compile(r"data:([^,]{0,200}),", re.IGNORECASE)
_SCHEME = re.compile(r"[a-z][a-z0-9+.-]*:", re.IGNORECASE)


class NotThereError(Exception):
    """A phrase on why a picture has no bytes."""


def bytes_of(link: str, folder: str | None) -> bytes:
    """Return the bytes that a link names.

    Parameters
    ----------
    link : str
        A ``data:`` URI, or the path of a file relative to the drawing.
    folder : str or None
        That of the drawing, where files in it and below it may be opened, links of the file system followed.

    Raises
    ------
    NotThereError
    """
    link = link.strip()
    if not link:
        raise NotThereError("")
    match = _DATA.match(link)
    if match:
        return _inside(match[1], link[match.end() :])
    if _SCHEME.match(link) or link.startswith(("/", "\\", "#")):
        raise NotThereError("it is not in the file")
    if folder is None:
        raise NotThereError(
            "it is in another file; --images beside would take it if that is beside the drawing"
        )
    return _beside(unquote(link.partition("#")[0].partition("?")[0]), folder)


def _inside(head: str, text: str) -> bytes:
    if len(text) > 2 * MOST_BYTES:
        raise NotThereError(_too_large())
    data = unquote_to_bytes(text)
    if head.rpartition(";")[2].strip().lower() == "base64":
        try:
            data = binascii.a2b_base64(data)
        except binascii.Error:
            raise NotThereError("its base64 is damaged") from None
    if len(data) > MOST_BYTES:
        raise NotThereError(_too_large())
    return data


def _beside(path: str, folder: str) -> bytes:
    """Return the bytes of a file in a folder or below it."""
    around = os.path.realpath(folder)
    try:
        found = os.path.realpath(os.path.join(around, path))
        if os.path.commonpath([around, found]) != around:
            raise NotThereError("its file is not beside the drawing")
        if not stat.S_ISREG(os.stat(found).st_mode):
            raise NotThereError("it is no file")
        with open(found, "rb") as stream:
            data = stream.read(MOST_BYTES + 1)
    except (OSError, ValueError):
        raise NotThereError("its file cannot be read") from None
    if len(data) > MOST_BYTES:
        raise NotThereError(_too_large())
    return data


def _too_large() -> str:
    return f"it is larger than {MOST_BYTES // 2**20} MB, the limit"
