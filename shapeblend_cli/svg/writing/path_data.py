"""Cubic paths as SVG path data.

Which commands are written depends on the paths' `straight` and `closed` alone: paths that are alike in these can be
animated into each other.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from shapeblend_cli.svg.writing.rounding import number, on_grid, short_number

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import CubicPath


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
    here = on_grid(path.segments[0, 0], scale)
    parts = [f"M{_offset((0, 0), here, scale)}"]
    last = ""
    for command in _commands(path):
        letter = "l" if len(command) == 1 else "c"
        points = [on_grid(z, scale) for z in command]
        for k, point in enumerate(points):
            offset = _offset(here, point, scale)
            if k or letter == last:
                parts.append(offset if offset.startswith("-") else f" {offset}")
            else:
                parts.append(letter + offset)
        here, last = points[-1], letter
    return "".join(parts) + ("z" if path.closed else "")


def _offset(start: tuple[int, int], end: tuple[int, int], scale: int) -> str:
    x, y = (short_number(q - p, scale) for p, q in zip(start, end, strict=True))
    return x + y if y.startswith("-") else f"{x} {y}"
