"""When the frames of a blend are."""

from __future__ import annotations


def frame_times(frames: int, ends: bool) -> list[float]:
    """The times of `frames` in-betweens, evenly spaced, and of both ends if wanted."""
    times = [k / (frames + 1) for k in range(frames + 2)]
    return times if ends else times[1:-1]
