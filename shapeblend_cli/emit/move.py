"""Two pictures that are command for command alike, and what is the same for all programs that move between them."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from shapeblend_cli.geometry.normalise import union

if TYPE_CHECKING:
    from shapeblend_cli.model import Box, Outline, PaintedShape, Style

FIXED = {
    "fill": {"fill_rule": "fill rule"},
    "stroke": {"stroke_linecap": "line cap", "stroke_linejoin": "line join"},
}
"""What of each paint has nothing in between, and what it is called."""


class Move(NamedTuple):
    """From one picture to another.

    Attributes
    ----------
    start, end : tuple of PaintedShape
        With the same outlines, segment for segment.
    views : (Box, Box)
        What part of the plane to show of each.
    """

    start: tuple[PaintedShape, ...]
    end: tuple[PaintedShape, ...]
    views: tuple[Box, Box]

    def shapes(self) -> list[tuple[str, PaintedShape, PaintedShape]]:
        """Name, start and end of each shape, in paint order, their paint such that programs can move it.

        Paint that only one side shows has its fill rule, line cap and line join from there. The point that a hole
        grows from would be painted as a dot by round or square line caps, which nothing else of closed outlines
        shows: they are left out there.
        """
        found = []
        for number, (start, end) in enumerate(zip(self.start, self.end, strict=True), 1):
            # Where one paint dissolves into another, A's is below B's, and all there is to see at first.
            start_style, end_style = start.below or start.style, end.style
            for paint, names in FIXED.items():
                if not _shows(start_style, paint):
                    start_style = start_style._replace(**{name: getattr(end_style, name) for name in names})
                elif not _shows(end_style, paint):
                    end_style = end_style._replace(**{name: getattr(start_style, name) for name in names})
            outlines = start.outlines + end.outlines
            if all(outline.closed for outline in outlines) and any(_is_point(o) for o in outlines):
                start_style = start_style._replace(stroke_linecap="butt")
                end_style = end_style._replace(stroke_linecap="butt")
            found.append(
                (f"shape-{number}", start._replace(style=start_style), end._replace(style=end_style))
            )
        return found

    def view(self) -> Box:
        """What part of the plane to show all the way."""
        return union(list(self.views))

    def kept(self, program: str) -> list[str]:
        """What a program cannot show, or cannot change on the way, a phrase for each."""
        plain = [
            f"{name}: its gradient is a plain colour in {program}"
            for name, start, end in self.shapes()
            if any(s.style.fill_gradient or s.style.stroke_gradient for s in (start, end))
        ]
        return plain + [
            f"{name}: {program} cannot change the {words} on the way; that of the first drawing stays"
            for name, start, end in self.shapes()
            for paint, names in FIXED.items()
            for key, words in names.items()
            if _shows(start.style, paint) and getattr(start.style, key) != getattr(end.style, key)
        ]


def _shows(style: Style, paint: str) -> bool:
    """Whether a style's ``fill`` or ``stroke`` is to be seen."""
    is_wide = paint == "fill" or style.stroke_width > 0.0
    return getattr(style, paint) is not None and getattr(style, f"{paint}_opacity") > 0.0 and is_wide


def _is_point(outline: Outline) -> bool:
    return bool((outline.segments == outline.segments[0, 0]).all())
