"""Two pictures that are command for command alike, and what is the same for all programs that move between them."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

from shapeblend_cli.model import Box

if TYPE_CHECKING:
    from shapeblend_cli.easing import Ease
    from shapeblend_cli.model import CubicPath, PaintedShape, Style, Waypoint

FIXED = {
    "fill": {"fill_rule": "fill rule"},
    "stroke": {"stroke_linecap": "line cap", "stroke_linejoin": "line join"},
}
"""What of each paint has nothing in between, and what it is called."""


class Leg(NamedTuple):
    """What a shape goes through in one go: every number evenly, but for the ease.

    Attributes
    ----------
    start, end : tuple of CubicPath
    times : (float, float)
        When it begins and ends.
    ease : Ease
    """

    start: tuple[CubicPath, ...]
    end: tuple[CubicPath, ...]
    times: tuple[float, float]
    ease: Ease


class MovedShape(NamedTuple):
    """A shape from one picture to another.

    Attributes
    ----------
    name : str
    start, end : PaintedShape
    ways : tuple of Waypoint
        Where the outlines come by; from one to the next they go straight.
    """

    name: str
    start: PaintedShape
    end: PaintedShape
    ways: tuple[Waypoint, ...]

    def legs(self, length: float, ease: Ease, decimals: int) -> list[Leg]:
        """The way from waypoint to waypoint.

        Parameters
        ----------
        length : float
            Time the whole way takes.
        ease : Ease
            Of the whole way.
        decimals : int
            Of times. A waypoint that comes at the time of another one, or of an end, is left out.
        """
        stops = [(0.0, 0.0, self.start.paths)]
        for waypoint in self.ways:
            time = round(length * ease.time_of(waypoint.t), decimals)
            if stops[-1][1] < time < length:
                stops.append((waypoint.t, time, waypoint.paths))
        stops.append((1.0, length, self.end.paths))
        return [
            Leg(start, end, (begin, until), ease.piece(p, q) if len(stops) > 2 else ease)
            for (p, begin, start), (q, until, end) in pairwise(stops)
        ]


class Move(NamedTuple):
    """From one picture to another.

    Attributes
    ----------
    start, end : tuple of PaintedShape
        With the same outlines, segment for segment.
    views : (Box, Box)
        What part of the plane to show of each.
    ways : tuple of tuple of Waypoint
        For each shape, where its outlines come by; empty where they go straight.
    """

    start: tuple[PaintedShape, ...]
    end: tuple[PaintedShape, ...]
    views: tuple[Box, Box]
    ways: tuple[tuple[Waypoint, ...], ...]

    def shapes(self) -> list[MovedShape]:
        """The shapes in paint order, their paint such that programs can move it.

        Paint that only one side shows has its fill rule, line cap and line join from there. The point that a hole
        grows from would be painted as a dot by round or square line caps, which nothing else of closed outlines
        shows: they are left out there.
        """
        found = []
        for number, (start, end, ways) in enumerate(zip(self.start, self.end, self.ways, strict=True), 1):
            # Where one paint dissolves into another, A's is below B's, and all there is to see at first.
            start_style, end_style = start.below or start.style, end.style
            for paint, names in FIXED.items():
                if not _shows(start_style, paint):
                    start_style = start_style._replace(**{name: getattr(end_style, name) for name in names})
                elif not _shows(end_style, paint):
                    end_style = end_style._replace(**{name: getattr(start_style, name) for name in names})
            outlines = start.paths + end.paths
            if all(outline.closed for outline in outlines) and any(o.is_point for o in outlines):
                start_style = start_style._replace(stroke_linecap="butt")
                end_style = end_style._replace(stroke_linecap="butt")
            start, end = start._replace(style=start_style), end._replace(style=end_style)
            found.append(MovedShape(f"shape-{number}", start, end, ways))
        return found

    def view(self) -> Box:
        """What part of the plane to show all the way."""
        return Box.union(self.views)

    def kept(self, program: str) -> list[str]:
        """What a program cannot show, or cannot change on the way, a phrase for each."""
        plain = [
            f"{name}: its gradient is a plain colour in {program}"
            for name, start, end, _ in self.shapes()
            if any(s.style.fill_gradient or s.style.stroke_gradient for s in (start, end))
        ]
        return plain + [
            f"{name}: {program} cannot change the {words} on the way; that of the first drawing stays"
            for name, start, end, _ in self.shapes()
            for paint, names in FIXED.items()
            for key, words in names.items()
            if _shows(start.style, paint) and getattr(start.style, key) != getattr(end.style, key)
        ]

    def straightened(self) -> list[str]:
        """A phrase for each shape whose way is lost where there are two pictures and no more."""
        return [
            f"{shape.name}: moves on curved paths, which two files cannot show: straight between them"
            for shape in self.shapes()
            if shape.ways
        ]


def _shows(style: Style, paint: str) -> bool:
    """Whether a style's ``fill`` or ``stroke`` is to be seen."""
    is_wide = paint == "fill" or style.stroke_width > 0.0
    return getattr(style, paint) is not None and getattr(style, f"{paint}_opacity") > 0.0 and is_wide
