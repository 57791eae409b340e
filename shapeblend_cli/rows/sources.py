"""Rows made of folders and patterns of names, without a manifest."""

from __future__ import annotations

import glob
import os
import re
from collections.abc import Iterable, Iterator, Sequence
from fnmatch import fnmatch
from itertools import combinations, pairwise
from typing import NamedTuple

from shapeblend_cli.errors import InputError, OptionError
from shapeblend_cli.rows.row import Row

DRAWINGS = "*.[sS][vV][gG]"


class Found(NamedTuple):
    """Rows, notes on drawings left out, and the pattern of names that was searched for."""

    rows: list[Row]
    notes: list[str]
    pattern: str

    def first_found(self, files: Iterable[str]) -> str | None:
        """Return the first of some files that would be found as well, if it were there."""
        pattern = os.path.abspath(self.pattern)
        return next((file for file in files if self.pattern and _fits(os.path.abspath(file), pattern)), None)


def chain(pattern: str, more: Sequence[str] = ()) -> Found:
    """Return a row for each drawing and the next, in natural order; `more` is what a shell made of the pattern."""
    files = drawings(pattern, more)
    return _found("--chain", pattern, [(a, b) for a, b in pairwise(files)], len(files))


def every_two(pattern: str, more: Sequence[str] = ()) -> Found:
    """Return a row for every two drawings; see `chain`."""
    files = drawings(pattern, more)
    return _found("--all", pattern, list(combinations(files, 2)), len(files))


def same_names(one: str, other: str) -> Found:
    """Return a row for each drawing in a folder, or in a folder inside it, that has a namesake in the other one."""
    for folder in (one, other):
        if not os.path.isdir(folder):
            raise OptionError(f"--pairs: {folder} is no folder")
    pattern = _inside(one)
    names = [os.path.relpath(file, one) for file in drawings(pattern)]
    rows = [
        Row(f"--pairs, {name}", (os.path.join(one, name), os.path.join(other, name)), name, {})
        for name in names
        if os.path.isfile(os.path.join(other, name))
    ]
    if not rows:
        raise OptionError(f"--pairs: no drawing in {one} has a namesake in {other}")
    others = [os.path.relpath(file, other) for file in drawings(_inside(other))]
    return Found(rows, [*_alone(names, one, other), *_alone(others, other, one)], pattern)


def _inside(folder: str) -> str:
    """Return the pattern of the drawings in a folder, and in folders inside it."""
    return os.path.join(glob.escape(folder), "**", DRAWINGS)


def _alone(names: Sequence[str], folder: str, other: str) -> Iterator[str]:
    """Yield a note if drawings in a folder have no namesake in the other one."""
    alone = [name for name in names if not os.path.isfile(os.path.join(other, name))]
    if alone:
        yield f"{len(alone)} of {len(names)} drawings in {folder} have no namesake in {other}, {alone[0]} for one"


def natural(file: str) -> tuple[list[str | int], str]:
    """Return a key that sorts 9.svg before 10.svg.

    >>> sorted(["10.svg", "B9.svg", "9.svg", "b10.svg"], key=natural)
    ['9.svg', '10.svg', 'B9.svg', 'b10.svg']
    """
    parts = re.split("([0-9]+)", file.casefold())
    return [int(part) if k % 2 else part for k, part in enumerate(parts)], file


def _found(option: str, pattern: str, pairs: Sequence[tuple[str, str]], count: int) -> Found:
    if not (count or glob.has_magic(pattern) or os.path.exists(pattern)):
        raise OptionError(f"{option}: {pattern} is no folder")
    if not pairs:
        raise OptionError(
            f"{option} {pattern}: {count or 'no'} {'drawing' if count == 1 else 'drawings'} found; it takes two"
        )
    root = root_of(pattern)
    rows = [Row(f"{option}, {a} and {b}", (a, b), _below(a, root), {}) for a, b in pairs]
    return Found(rows, [], _pattern(pattern))


def _below(file: str, root: str) -> str:
    name = os.path.relpath(file, root or os.curdir)
    return os.path.basename(file) if name.startswith(os.pardir) else name


def _pattern(text: str) -> str:
    """Return the pattern of the drawings in a folder, or a pattern as it is."""
    return os.path.join(glob.escape(text), DRAWINGS) if os.path.isdir(text) else text


def drawings(text: str, more: Sequence[str] = ()) -> list[str]:
    """Return the files that fit a pattern, or the drawings in a folder, and more of them, in natural order."""
    if os.path.isdir(text):
        try:
            os.listdir(text)
        except OSError as error:
            problem = f"is a folder that cannot be read ({error.strerror})"
            raise InputError(text, problem) from None
    found = {*glob.glob(_pattern(text), recursive=True), *more}
    return sorted((file for file in found if os.path.isfile(file)), key=natural)


def root_of(pattern: str) -> str:
    """Return the folder that the fixed part of a pattern names."""
    if os.path.isdir(pattern):
        return pattern
    root = os.path.dirname(pattern)
    while glob.has_magic(root):
        root = os.path.dirname(root)
    return root


def _fits(path: str, pattern: str) -> bool:
    """Return whether a path fits a pattern; `**` are any folders, and nothing else goes over a slash."""
    if "**" in pattern:
        return fnmatch(path, pattern.replace(f"**{os.sep}", "*"))
    parts, wanted = path.split(os.sep), pattern.split(os.sep)
    return len(parts) == len(wanted) and all(map(fnmatch, parts, wanted))
