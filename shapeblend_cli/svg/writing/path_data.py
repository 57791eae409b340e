"""Cubic paths as SVG path data.

Which commands are written depends on the paths' `straight` and `closed` alone: paths that are alike in these can be
animated into each other.
"""

from __future__ import annotations

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
    parts = ["M", _texts(grid[:1, 0], scale)[0]]
    last = ""
    texts = iter(_texts(offsets.reshape(-1, 2), scale))
    for first, second, end, is_line in zip(texts, texts, texts, path.straight.tolist(), strict=False):
        letter = "l" if is_line else "c"
        own = [end] if is_line else [first, second, end]
        if letter != last:
            parts.append(letter + own[0])
            del own[0]
        parts += [text if text[0] == "-" else f" {text}" for text in own]
        last = letter
    return "".join(parts) + ("z" if path.closed else "")


def _texts(points: IntArray, scale: int) -> list[str]:
    """Return points of a grid, (k, 2), as pairs of numbers."""
    known = short_numbers(scale)
    numbers = [known[value] for value in points.ravel().tolist()]
    return [x + y if y[0] == "-" else f"{x} {y}" for x, y in zip(numbers[::2], numbers[1::2], strict=True)]
