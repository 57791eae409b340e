"""What the command line can say of a blend."""

from __future__ import annotations

from typing import NamedTuple

from shapeblend_cli.easing import LINEAR, Ease
from shapeblend_cli.match.work import WorkConstants


class Settings(NamedTuple):
    """How two drawings are to be blended.

    Attributes
    ----------
    frames : int >= 0
        In-betweens.
    ends : bool
        Frames at t = 0 and t = 1 too.
    vertices : int >= 0
        Vertices a contour, about.
    place : str
        How B is laid over A: viewBox on viewBox, box on box, or file coordinates as they stand.
    start : (int, int) or None
        A vertex of A and the vertex of B it corresponds to, of the largest contours that are paired; None for
        the best of all.
    pins : tuple of pairs
        Vertices that must correspond: two numbers, as in the report, of the largest contours that are paired; or two
        points (complex), one of A and one of B, each in the coordinates of its own file. The nearest vertices of the
        nearest contours are taken, and so these contours are a pair.
    reverse : str
        Whether to go through B's outline backwards: yes, no, or auto.
    stiff : tuple of (complex, float, float)
        Point of A, radius and weight: vertices of A within the radius are so many times as stiff.
    solver, band, effort
        See `match.solve.least_work`.
    pairs : tuple of (str, str)
        Contours that must become one another: numbers, as in the report, or ids of shapes.
    motion : {'auto', 'linear', 'rigid', 'intrinsic', 'safe'}
        How outlines go from A to B, see `motion.choose`.
    curves : bool
        Frames of smooth curves, or of the solver's polygons.
    ease : Ease
        How the in-betweens are spaced in time.
    unmatched : {'point', 'split'}
        Whether an outline without a partner grows from a point, or another outline is cut for it.
    constants : WorkConstants
    style : {'a', 'b', 'blend'}
        Whether all frames are painted as in A, as in B, or in between.
    """

    frames: int = 5
    ends: bool = False
    vertices: int = 200
    place: str = "viewbox"
    start: tuple[int, int] | None = None
    pins: tuple[tuple[complex, complex], ...] = ()
    reverse: str = "auto"
    stiff: tuple[tuple[complex, float, float], ...] = ()
    solver: str = "exact"
    band: float | None = None
    effort: str = "auto"
    constants: WorkConstants = WorkConstants()
    pairs: tuple[tuple[str, str], ...] = ()
    unmatched: str = "point"
    motion: str = "auto"
    curves: bool = True
    ease: Ease = LINEAR
    style: str = "blend"
