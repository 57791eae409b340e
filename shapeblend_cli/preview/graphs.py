"""The graph of a correspondence for the page: the cost of each dot. Large tables are packed as short text."""

from __future__ import annotations

import base64
import json
import zlib
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from shapeblend_cli.matching.landscape import Landscape, landscape
from shapeblend_cli.model import ContourBlend
from shapeblend_cli.options.settings import Settings
from shapeblend_cli.wires.match import solved_wires

if TYPE_CHECKING:
    from shapeblend_cli.model import IntArray

MOST_DOTS = 300_000
"""Maximum number of dots of all landscapes of a page together. Each takes about two bytes."""

LEVELS = 65_534
"""Number of steps of the scale of works. A further level stands for dots without a path."""

FINEST = 1e-5
"""Minimum extra work that the scale distinguishes from none, as a share of its unit."""

LARGE = "large"
"""Reason for no landscape: the contour alone has more than `MOST_DOTS`."""

FULL = "full"
"""Reason for no landscape: larger contours have taken the room."""


def graphs(contours: Sequence[ContourBlend], settings: Settings) -> list[dict[str, Any] | str | None]:
    """Return for each contour its landscape, `LARGE` or `FULL`, or None where nothing was solved.

    The largest contours come first, as long as there is room.
    """
    written: list[dict[str, Any] | str | None] = [None] * len(contours)
    room = MOST_DOTS
    for k in by_size(contours):
        contour = contours[k]
        if not contour.is_matched:
            continue
        dots = len(contour.polygon_a.vertices) * len(contour.polygon_b.vertices)
        if dots > room:
            written[k] = LARGE if dots > MOST_DOTS else FULL
            continue
        room -= dots
        found = contour.correspondence
        prices = landscape(solved_wires(contour, settings), found.dots, settings.band)
        written[k] = _write(prices, found.work)
    return written


def by_size(contours: Sequence[ContourBlend]) -> list[int]:
    """Return the numbers of contours, the largest first."""
    return sorted(range(len(contours)), key=lambda k: -max(contours[k].scale_a, contours[k].scale_b))


def _write(prices: Landscape, least: float) -> dict[str, Any]:
    """Return a landscape for JSON.

    Level l of its `works` stands for ``unit * FINEST * (exp(l / LEVELS * top) - 1)`` more than the least work; the
    unit is the least work itself, unless that is 0.
    """
    finite = np.isfinite(prices.works)
    extra = np.maximum(np.where(finite, prices.works, least) - least, 0.0)
    unit = least if least > 0.0 else float(extra.max()) or 1.0
    heights = np.log1p(extra / (unit * FINEST))
    top = float(heights.max()) or 1.0
    levels = np.where(finite, np.round(heights / top * LEVELS), LEVELS + 1).astype(np.intp)
    return {
        "columns": prices.works.shape[0],
        "rows": prices.works.shape[1],
        "unit": unit,
        "finest": FINEST,
        "levels": LEVELS,
        "top": top,
        "works": _pack_levels(levels),
        **{
            name: _pack(getattr(prices, name).astype(np.uint8).tobytes())
            for name in ("step", "before", "after")
        },
    }


def pack_json(value: Any) -> str:
    """Return a value as short text, see `_pack`."""
    return _pack(json.dumps(value, separators=(",", ":"), allow_nan=False).encode("utf-8"))


def _pack(data: bytes) -> str:
    """Return bytes as short text, which the page unpacks with the browser's own ``DecompressionStream``."""
    return base64.b64encode(zlib.compress(data, 9)).decode("ascii")


def _pack_levels(levels: IntArray) -> str:
    """Pack numbers below 65,536: differences along each row, modulo 65,536, low bytes before high ones.

    Neighbours are alike, and so are the high bytes of their differences.
    """
    steps = np.diff(levels, axis=1, prepend=0) % 65536
    return _pack((steps & 255).astype(np.uint8).tobytes() + (steps >> 8).astype(np.uint8).tobytes())
