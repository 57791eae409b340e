"""SVG documents as pixels."""

import io
from functools import lru_cache

import numpy as np
import resvg_py
from PIL import Image

SIZE, FINER = 120, 3


@lru_cache(maxsize=32)
def pixels(svg):
    """Red, green and blue of a document on white, as float: drawn larger, which evens out antialiasing."""
    png = bytes(resvg_py.svg_to_bytes(svg_string=svg, width=FINER * SIZE, background="#ffffff"))
    return np.asarray(Image.open(io.BytesIO(png)).convert("RGB").reduce(FINER), float)


def difference(one, other):
    """The share of pixels that are plainly different: by more than antialiasing of the same edge leaves."""
    assert one.shape == other.shape
    return float((np.abs(one - other).max(axis=2) > 24).mean())
