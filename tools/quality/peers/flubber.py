"""flubber, the library most used to morph paths in web pages.

For several contours its calls are `interpolateAll` (as many on both sides), `separate` (one to several) and `combine`
(several to one). The first takes contours as they come, so they are given in order of size. There is no call for, say,
two to four: the largest are taken, and the rest is left out.
"""

from __future__ import annotations

from typing import Any

from tools.quality.data import Pair, subpaths
from tools.quality.peers.node import Library, largest, longest_side, version

NAME = f"flubber {version('flubber')}"


def job(pair: Pair) -> dict[str, Any]:
    """Return what the script is told of a pair."""
    a, b = subpaths(pair.a), subpaths(pair.b)
    if min(len(a), len(b)) > 1:
        a, b = largest(pair)
    return {"a": a, "b": b, "side": longest_side(pair)}


FINE = Library(NAME, "flubber", job)
