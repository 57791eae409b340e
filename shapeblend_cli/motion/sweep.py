"""Motion in which outlines are laid bare, as a blind is drawn, and nothing else moves."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.geometry.window import Window
    from shapeblend_cli.model import ComplexArray, ContourBlend


class Sweep(NamedTuple):
    """Each contour that grows is seen through a window that opens, or one that closes if it shrinks."""

    windows: tuple[Window | None, ...]  # None for what stays as it is

    @property
    def name(self) -> str:
        """No motion that can be asked for."""
        return "sweep"

    def segments(self, contours: Sequence[ContourBlend], t: float) -> list[ComplexArray]:
        """Return the control points of each contour at time t."""
        return [
            contour.start.segments
            if window is None
            else window.clip(contour.end.segments, t)
            if contour.grows
            else window.clip(contour.start.segments, 1.0 - t)
            for contour, window in zip(contours, self.windows, strict=True)
        ]
