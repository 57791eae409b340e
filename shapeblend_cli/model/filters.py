"""Filters: what is made of a shape or a group once it is painted."""

from __future__ import annotations

from typing import NamedTuple

from shapeblend_cli.model.box import Box
from shapeblend_cli.model.picture import Raster
from shapeblend_cli.model.style import Content

SOURCE = "SourceGraphic"
"""Name of what a filter is applied to, an input of its steps."""

ALPHA = "SourceAlpha"
"""Name of the opacity alone of what a filter is applied to, an input of its steps."""


class View(NamedTuple):
    """Shapes of a drawing, as far as a box shows them."""

    content: Content
    box: Box  # in the coordinates of the content


class Step(NamedTuple):
    """A step of a filter, a primitive of SVG, by the names that SVG gives its attributes."""

    tag: str
    inputs: tuple[str | int, ...] = ()  # numbers of earlier steps, counted from 0, or `SOURCE` or `ALPHA`
    words: tuple[tuple[str, str], ...] = ()  # values that have nothing in between
    numbers: tuple[tuple[str, tuple[float, ...]], ...] = ()  # lengths and places in the drawing's coordinates
    colours: tuple[tuple[str, str], ...] = ()  # #rrggbb
    region: Box | None = None  # outside of which it is transparent; None for that of the filter
    parts: tuple[Step, ...] = ()  # elements in it, such as feFuncR
    image: Raster | View | None = None  # that it shows in its region

    def __repr__(self) -> str:
        # Ids in documents are made of this: those of steps without an image are as before there were any.
        fields = [f"{name}={value!r}" for name, value in zip(self._fields, self, strict=True)]
        return f"Step({', '.join(fields if self.image is not None else fields[:-1])})"

    @property
    def kind(self) -> tuple[object, ...]:
        """What two steps have in common whose numbers and colours can be blended."""
        numbers = tuple((name, len(values)) for name, values in self.numbers)
        colours = tuple(name for name, _ in self.colours)
        parts = tuple(part.kind for part in self.parts)
        return self.tag, self.inputs, self.words, numbers, colours, self.region is None, parts, self.image


class Filter(NamedTuple):
    """A filter, in the coordinates of the drawing: the last of its steps is what is seen."""

    region: Box
    steps: tuple[Step, ...]

    @property
    def has_pictures(self) -> bool:
        """Whether it shows pictures of pixels."""
        return any(isinstance(step.image, Raster) for step in self.steps)

    @property
    def kind(self) -> tuple[object, ...]:
        """What two filters have in common that can be blended number by number."""
        return tuple(step.kind for step in self.steps)
