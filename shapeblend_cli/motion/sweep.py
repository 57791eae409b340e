"""Motion in which outlines are laid bare, as a blind is drawn, and nothing else moves."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.geometry import cubics
from shapeblend_cli.geometry.grouping import grouped, overlaps
from shapeblend_cli.geometry.polygons import axis_of
from shapeblend_cli.model import Contour
from shapeblend_cli.model.arrays import numbered

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import ComplexArray, ContourBlend

BAR = 0.4
"""Maximum width of a bar, as a share of its length."""

CLEARLY = 1.2
"""Minimum ratio of the width across the axis of most outlines to the width across the axis of largest spread, for loops
that are no bar to open along the latter."""

UPRIGHT = 0.1
"""Share of the outlines' length that counts as upright, so that loops as wide as high open up and down."""

PARALLEL = np.radians(10.0)
"""Maximum angle between a bar's axis and the outlines along it, in radians."""

AT_END = 0.05
"""Maximum distance of a joint from the end of a window, as a share of the window's length."""

JOINED = 0.8
"""Minimum width of the joint at the end of a window, as a share of the width of all joints."""


class Window(NamedTuple):
    """A band across an axis, a unit vector, that opens from a line; all are lengths along the axis."""

    axis: complex
    start: float
    ends: tuple[float, float]  # of the open window

    def clip(self, z: ComplexArray, t: float) -> ComplexArray:
        """Return points at time t: those outside of the band are moved along the axis to its nearer side."""
        low, high = (self.start + t * (end - self.start) for end in self.ends)
        turned = z * self.axis.conjugate()
        return np.asarray((np.clip(turned.real, low, high) + 1j * turned.imag) * self.axis)

    def cut(self, loop: Contour, step: float) -> Contour:
        """Cut segments that slant through the window into pieces of about a step."""
        turned = loop.segments * self.axis.conjugate()
        slant = np.minimum(np.ptp(turned.real, axis=1), np.ptp(turned.imag, axis=1))
        counts = np.maximum(np.ceil(slant / step), 1).astype(np.intp)
        numbers = np.repeat(np.arange(len(counts)), counts)
        within = numbered(counts)
        starts, ends = within / counts[numbers], (within + 1) / counts[numbers]
        return Contour(
            cubics.pieces(loop.segments[numbers], starts, ends), loop.straight[numbers], closed=True
        )


class Sweep(NamedTuple):
    """Motion of contours that are seen through windows, which open where a contour grows and close where it shrinks."""

    windows: tuple[Window | None, ...]  # of each contour; None for one that stays, or grows as a whole

    @property
    def name(self) -> str:
        """The motion's name in reports; it cannot be asked for."""
        return "sweep"

    def segments(self, contours: Sequence[ContourBlend], t: float) -> list[ComplexArray]:
        """Return the control points of each contour at time t."""
        return [_seen(*each, t) for each in zip(contours, self.windows, strict=True)]


def _seen(contour: ContourBlend, window: Window | None, t: float) -> ComplexArray:
    start, end = contour.start.segments, contour.end.segments
    if window is not None:
        return window.clip(end, t) if contour.grows else window.clip(start, 1.0 - t)
    return start if contour.is_matched else (1.0 - t) * start + t * end


def windows_of(loops: Sequence[Contour], joints: Sequence[ComplexArray]) -> list[Window]:
    """Return the windows of loops: one along all, from its left end, if they are a bar; else one for each group.

    Loops that overlap are a group: where they cancel they must open together. Its window opens from the end at which
    the group is joined to what stays, as the leg of a lock to its shackle, else from the middle. `joints` are the
    segments of each loop, (k, 4) each, that border on what stays.
    """
    window = _window(loops, from_middle=False)
    if window is not None:
        return [window] * len(loops)
    found: dict[int, Window | None] = {}
    for group in grouped(overlaps([cubics.bounds(loop.segments) for loop in loops])):
        window = _window([loops[k] for k in group], from_middle=True)
        found.update(dict.fromkeys(group, window and _from_joint(window, [joints[k] for k in group])))
    return [window for k in range(len(loops)) if (window := found[k])]


def _from_joint(window: Window, joints: Sequence[ComplexArray]) -> Window:
    """Return a window that opens from an end at which its loops are joined to what stays, the first one if at both."""
    turned = np.concatenate(joints) * window.axis.conjugate()
    low, high = window.ends
    for end in window.ends:
        at_end = turned[np.abs(turned.real - end).max(axis=1) <= AT_END * (high - low)]
        if len(at_end) and np.ptp(at_end.imag) >= JOINED * np.ptp(turned.imag):
            return window._replace(start=end)
    return window


def window_along(axis: complex, loops: Sequence[Contour]) -> Window:
    """Return a window along an axis that opens from the first of loops."""
    along = np.concatenate([(loop.segments * axis.conjugate()).real.ravel() for loop in loops])
    low, high = float(along.min()), float(along.max())
    return Window(axis, low, (low, high))


def _window(loops: Sequence[Contour], *, from_middle: bool) -> Window | None:
    """Return a window that opens from the middle of loops, or from the left end of a bar; None if they are no bar.

    Its axis is the direction of most outlines if the loops are narrow across it, else the direction of largest spread.
    """
    points = np.concatenate([loop.segments.ravel() for loop in loops])
    edges = np.concatenate([np.diff(loop.segments, axis=1).ravel() for loop in loops])
    edges = edges[edges != 0.0]
    doubled = edges**2 / np.abs(edges)
    upright = UPRIGHT if from_middle else 0.0
    mostly = axis_of(doubled.sum() - upright * np.abs(edges).sum())
    parallel = np.abs(np.angle(doubled * (mostly.conjugate() ** 2))) <= 2.0 * PARALLEL
    found: list[tuple[float, Window]] = []
    for axis in (axis_of(doubled[parallel].sum()), axis_of(((points - points.mean()) ** 2).sum())):
        turned = points * axis.conjugate()
        low, high = float(turned.real.min()), float(turned.real.max())
        width = float(np.ptp(turned.imag)) / (high - low)
        found.append((width, Window(axis, 0.5 * (low + high) if from_middle else low, (low, high))))
    width, window = found[0] if found[0][0] <= max(BAR, CLEARLY * found[1][0]) else found[1]
    return window if from_middle or width <= BAR else None
