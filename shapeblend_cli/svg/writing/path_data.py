"""Cubic paths as SVG path data.

Which commands are written depends on the paths' `straight` and `closed` alone: paths that are alike in these can be
animated into each other.
"""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.svg.writing.rounding import number, on_grid, short_numbers

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import CubicPath, IntArray


def path_data(paths: Sequence[CubicPath], decimals: int) -> str:
    """Return path data in absolute coordinates: lines and cubics, repeated command letters left out."""
    return "".join(_subpath(path, decimals) for path in paths)


def short_path_data(paths: Sequence[CubicPath], decimals: int) -> str:
    """Return path data about a fifth shorter: each point relative to the point written before it.

    Points are rounded before they are subtracted, so errors do not add up. Differences are linear: a browser that
    interpolates them evenly moves each point evenly as well.
    """
    return "".join(_short_subpath(path, decimals) for path in paths)


def _commands(path: CubicPath) -> list[list[complex]]:
    """Return the points of each command: one of a line, three of a cubic. The closing line is left to ``Z``."""
    segments, straight = path.segments.tolist(), path.straight.tolist()
    if path.closed and straight[-1]:
        segments.pop()
    return [points[3:] if line else points[1:] for points, line in zip(segments, straight, strict=False)]


def _subpath(path: CubicPath, decimals: int) -> str:
    parts = ["M", _point(path.segments[0, 0], decimals)]
    last = "L"  # what follows a moveto without a letter
    for points in _commands(path):
        letter = "L" if len(points) == 1 else "C"
        parts.append(" " if letter == last else letter)
        parts.append(" ".join(_point(z, decimals) for z in points))
        last = letter
    return "".join(parts) + ("Z" if path.closed else "")


def _point(z: complex, decimals: int) -> str:
    return f"{number(z.real, decimals)},{number(z.imag, decimals)}"


def _short_subpath(path: CubicPath, decimals: int) -> str:
    scale = 10**decimals
    count = len(path.segments) - (
        path.closed and bool(path.straight[-1])
    )  # the closing line is left to ``z``
    grid = on_grid(path.segments[: max(count, 1)], scale)
    points = grid[:count, 1:]
    # All points of a command are relative to the end of the one before it.
    starts = np.concatenate([grid[:1, 0], points[:, 2]])
    offsets = points - starts[:-1, None]
    used, letters = _layout(path.straight[:count].tobytes())
    known = short_numbers(scale)
    texts = [known[value] for value in offsets.reshape(-1, 2)[used].ravel().tolist()]
    for k, letter in letters:
        texts[k] = letter + texts[k].lstrip()
    x, y = grid[0, 0].tolist()
    return f"M{known[x].lstrip()}{known[y]}{''.join(texts)}{'z' if path.closed else ''}"


@lru_cache(maxsize=64)
def _layout(straight: bytes) -> tuple[IntArray, list[tuple[int, str]]]:
    """Return which points of segments are written, and before which of their numbers a letter, by which are lines.

    All waypoints of a path have the same.
    """
    is_line = np.frombuffer(straight, np.bool_)
    is_used = np.ones((len(is_line), 3), np.bool_)
    is_used[is_line, :2] = False
    first = np.cumsum(np.where(is_line, 2, 6)) - np.where(is_line, 2, 6)
    begins = np.append(True, is_line[1:] != is_line[:-1])[: len(is_line)]
    letters = ["l" if line else "c" for line in is_line[begins].tolist()]
    return np.flatnonzero(is_used), list(zip(first[begins].tolist(), letters, strict=True))
