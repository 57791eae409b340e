"""flubber, the library most used to morph paths in web pages.

For several contours its calls are `interpolateAll` (as many on both sides), `separate` (one to several) and `combine`
(several to one). The first takes contours as they come, so they are given in order of size. There is no call for, say,
two to four: the largest are taken, and the rest is left out.
"""

from __future__ import annotations

import functools
from typing import Any

from tools.quality.data import Pair, subpaths
from tools.quality.peers.node import VERTICES, Library, largest, longest_side, version

__all__ = ["COARSE", "LIBRARIES", "NAME", "OWN", "VERTICES"]

NAME = f"flubber {version('flubber')}"

COARSE = f"{NAME}, sides of 10"
"""What it is called where it is left its default, a longest side of 10 units whatever the drawing's size."""


def job(pair: Pair, own_sides: bool) -> dict[str, Any]:
    """Return what the script is told of a pair."""
    a, b = subpaths(pair.a), subpaths(pair.b)
    if min(len(a), len(b)) > 1:
        a, b = largest(pair)
    return {"a": a, "b": b, "side": None if own_sides else longest_side(pair)}


FINE = Library(NAME, "flubber", functools.partial(job, own_sides=False))
OWN = Library(COARSE, "flubber", functools.partial(job, own_sides=True))
LIBRARIES = (FINE, OWN)
