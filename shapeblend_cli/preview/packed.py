"""Large values as short text, which the page unpacks with the browser's own ``DecompressionStream``."""

from __future__ import annotations

import base64
import json
import zlib
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from shapeblend_cli.model import IntArray, UIntArray


def packed(data: bytes) -> str:
    """Bytes by zlib and base64."""
    return base64.b64encode(zlib.compress(data, 9)).decode("ascii")


def packed_json(value: Any) -> str:
    """A value for JSON."""
    return packed(json.dumps(value, separators=(",", ":"), allow_nan=False).encode("utf-8"))


def packed_table(table: UIntArray) -> str:
    """A table of bytes, row after row."""
    return packed(table.astype(np.uint8).tobytes())


def packed_levels(levels: IntArray) -> str:
    """A table of numbers below 65,536: their differences along each row, modulo 65,536, low bytes before high ones.

    Neighbours are alike, and so are the high bytes of their differences.
    """
    steps = np.diff(levels, axis=1, prepend=0) % 65536
    return packed((steps & 255).astype(np.uint8).tobytes() + (steps >> 8).astype(np.uint8).tobytes())
