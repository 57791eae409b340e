"""The errors shapeblend raises on purpose. Imports nothing of ours."""

from __future__ import annotations

import os
import re
import sys


class ShapeblendError(Exception):
    """Something a user can understand and put right: one line, no traceback.

    The message says what was found and what would work.
    """


class FileError(ShapeblendError):
    """What is wrong with a file, named as the user did: what was found, where, and what would work."""

    def __init__(self, file: str, problem: str) -> None:
        super().__init__(f"{file}: {problem}")
        self.file = file
        self.problem = problem


class InputError(FileError, ValueError):
    """A file that cannot be read, or that holds nothing to blend."""


def unreadable(file: str, error: OSError | ValueError, what: str) -> InputError:
    """Return the error for a file of some kind, such as "SVG file", that cannot be opened."""
    if isinstance(error, FileNotFoundError):
        near = _namesake(file)
        would = f"{near} is there" if near else f"a readable {what} would work"
        if re.match("(?i)https?://", file):
            would = f"curl prints it, and {os.path.basename(file) or 'a file'} saved from there would work"
        return InputError(file or "''", f"cannot be read ({error.strerror}); {would}")
    if isinstance(error, OSError):
        return InputError(file, f"cannot be read ({error.strerror}); a readable {what} would work")
    return InputError(file, "not the name of a file")  # names with a null character


MOST_NAMES = 2000
"""Maximum number of names in a folder that are looked at for one that was meant."""


def _namesake(file: str) -> str:
    """Return the name of a file beside the one that is not there, which was probably meant; empty if there is none."""
    import difflib  # only errors need it

    folder, name = os.path.split(file)
    try:
        with os.scandir(folder or os.curdir) as entries:
            names = [
                entry.name for entry, _ in zip(entries, range(MOST_NAMES), strict=False) if entry.is_file()
            ]
    except (OSError, ValueError):
        return ""
    # Of numbered files, another number is another drawing.
    numbers = re.findall("[0-9]+", name)
    alike = [each for each in names if re.findall("[0-9]+", each) == numbers]
    folded = {each.lower(): each for each in sorted(alike, reverse=True)}
    near = difflib.get_close_matches(name.lower(), folded, 1, 0.8)
    return os.path.join(folder, folded[near[0]]) if near else ""


class OutputError(FileError, OSError):
    """A target that cannot be written, or that exists and was not to be replaced."""


class OptionError(ShapeblendError, ValueError):
    """Options that contradict each other or the requested output."""


class MatchError(ShapeblendError, ValueError):
    """Two shapes, or a request about them, for which no correspondence exists."""


class PictureError(ShapeblendError, ValueError):
    """Pictures that cannot be drawn, or not at this size."""


def with_extra(name: str) -> str:
    """Return the command that adds an extra to the installation that runs."""
    marks = {"uv-receipt.toml": "uv tool install", "pipx_metadata.json": "pipx install --force"}
    found = [command for mark, command in marks.items() if os.path.exists(os.path.join(sys.prefix, mark))]
    return f"{found[0] if found else 'pip install'} 'shapeblend[{name}]'"


def _is_somewhere() -> bool:
    try:
        os.getcwd()
    except OSError:
        return False
    return True


def in_words(error: BaseException) -> str:
    """Return the message for users about any error."""
    if isinstance(error, ShapeblendError):
        return str(error)
    if isinstance(error, OSError):
        if error.filename is None and not _is_somewhere():
            folder = os.environ.get("PWD", os.curdir)
            return f"{folder}: the current folder is not there any more; changing to another one would work"
        return f"{error.filename or 'standard output'}: cannot be written ({error.strerror or error})"
    if isinstance(error, MemoryError):
        return "not enough memory for contours of so many vertices; a smaller --vertices would help"
    import traceback

    place = traceback.extract_tb(error.__traceback__)[-1]
    where = f"{os.path.basename(place.filename)}, line {place.lineno}"
    return f"this is a bug of shapeblend, {type(error).__name__}: {error} ({where}); please report it"
