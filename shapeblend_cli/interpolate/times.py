"""When the frames of a blend are."""

from __future__ import annotations

from shapeblend_cli.easing import LINEAR, Ease


def frame_times(frames: int, ends: bool, ease: Ease = LINEAR) -> list[float]:
    """The times of `frames` in-betweens, evenly spaced before easing, and of both ends if wanted."""
    times = [ease.at(k / (frames + 1)) for k in range(frames + 2)]
    return times if ends else times[1:-1]
