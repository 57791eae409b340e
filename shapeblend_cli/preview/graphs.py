"""The graph of a correspondence for the page: what each dot would cost. Large tables are packed as short text."""

from __future__ import annotations

import base64
import json
import zlib
from typing import TYPE_CHECKING, Any

import numpy as np

from shapeblend_cli.match.landscape import landscape
from shapeblend_cli.pairing.matching import solved_wires

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.match.landscape import Landscape
    from shapeblend_cli.model import ContourBlend, IntArray, UIntArray
    from shapeblend_cli.settings import Settings

MOST_DOTS = 160_000
"""Dots of the landscapes in a page, all of them together: about two bytes each."""

LEVELS = 65_534
"""Steps of the scale on which works are stored; one more stands for no path at all."""

FINEST = 1e-5
"""The least extra work that the scale tells from none, as a share of its unit."""

LARGE = "large"
FULL = "full"


def graphs(contours: Sequence[ContourBlend], settings: Settings) -> list[dict[str, Any] | str | None]:
    """For each contour its landscape, a word for why it has none, or None where nothing was solved.

    The largest contours come first, as long as there is room.
    """
    found: list[dict[str, Any] | str | None] = [None] * len(contours)
    left = MOST_DOTS
    for k in by_size(contours):
        contour = contours[k]
        if not contour.is_matched:
            continue
        dots = len(contour.polygon_a.vertices) * len(contour.polygon_b.vertices)
        if dots > left:
            found[k] = LARGE if dots > MOST_DOTS else FULL
            continue
        left -= dots
        wires = solved_wires(contour, settings)
        found[k] = _written(
            landscape(wires, contour.correspondence.dots, settings.band), contour.correspondence.work
        )
    return found


def by_size(contours: Sequence[ContourBlend]) -> list[int]:
    """Numbers of contours, the largest first."""
    return sorted(range(len(contours)), key=lambda k: -max(contours[k].scale_a, contours[k].scale_b))


def _written(found: Landscape, least: float) -> dict[str, Any]:
    """A landscape for JSON.

    Level l of its `works` stands for ``unit * FINEST * (exp(l / LEVELS * top) - 1)`` more than the least work; the
    unit is the least work itself, unless that is nothing.
    """
    there = np.isfinite(found.works)
    extra = np.maximum(np.where(there, found.works, least) - least, 0.0)
    unit = least if least > 0.0 else float(extra.max()) or 1.0
    heights = np.log1p(extra / (unit * FINEST))
    top = float(heights.max()) or 1.0
    levels = np.where(there, np.round(heights / top * LEVELS), LEVELS + 1).astype(np.intp)
    return {
        "columns": found.works.shape[0],
        "rows": found.works.shape[1],
        "unit": unit,
        "finest": FINEST,
        "levels": LEVELS,
        "top": top,
        "works": pack_levels(levels),
        "step": pack_table(found.step),
        "before": pack_table(found.before),
        "after": pack_table(found.after),
    }


def pack(data: bytes) -> str:
    """Return bytes as short text, which the page unpacks with the browser's own ``DecompressionStream``."""
    return base64.b64encode(zlib.compress(data, 9)).decode("ascii")


def pack_json(value: Any) -> str:
    """Pack a value as JSON."""
    return pack(json.dumps(value, separators=(",", ":"), allow_nan=False).encode("utf-8"))


def pack_table(table: UIntArray) -> str:
    """Pack a table of bytes, row by row."""
    return pack(table.astype(np.uint8).tobytes())


def pack_levels(levels: IntArray) -> str:
    """Pack a table of numbers below 65,536: differences along each row, modulo 65,536, low bytes before high ones.

    Neighbours are alike, and so are the high bytes of their differences.
    """
    steps = np.diff(levels, axis=1, prepend=0) % 65536
    return pack((steps & 255).astype(np.uint8).tobytes() + (steps >> 8).astype(np.uint8).tobytes())
