"""Text that stays text: what is written again, and the outlines of its letters for what draws no text."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import NamedTuple

from shapeblend_cli.model.box import Box
from shapeblend_cli.model.drawing import CubicPath
from shapeblend_cli.model.picture import Picture, Raster


class TextRun(NamedTuple):
    """Characters of a text that follow one another in one font; lengths are in the text's own coordinates."""

    text: str
    x: float | None  # of the first character; None after the character before
    y: float | None
    dx: tuple[float, ...]
    dy: tuple[float, ...]
    rotate: tuple[float, ...]
    families: tuple[str, ...]
    size: float
    weight: int
    is_slanted: bool
    between_letters: float
    between_words: float
    anchor: str


@dataclass(frozen=True)
class Words(Raster):
    """Text that is shown as text, in the place of a picture; equal texts have the same data."""

    runs: tuple[TextRun, ...] = field(compare=False, default=())
    direction: str = field(compare=False, default="ltr")
    baseline: str = field(compare=False, default="auto")
    faces: tuple[str, ...] = field(compare=False, default=())  # rules for fonts
    box: Box = field(
        compare=False, default=Box(0.0, 0.0, 1.0, 1.0)
    )  # around its letters, in its own coordinates
    letters: tuple[tuple[CubicPath, ...], ...] = field(compare=False, default=())

    def axes_in(self, picture: Picture) -> tuple[complex, complex, complex]:
        """Return where its own coordinates are in the place of a picture: the origin, and the units along x and y."""
        across, down = picture.across / self.box.width, picture.down / self.box.height
        return picture.origin - self.box.x * across - self.box.y * down, across, down

    def __repr__(self) -> str:
        return f"Words({self.digest})"


def words_in(picture: Picture | None) -> Words | None:
    """Return the text that is shown in the place of a picture, if it is one."""
    return picture.raster if picture is not None and isinstance(picture.raster, Words) else None
