"""Text that all drawings have, as one shape in each, which moves as pictures do; other text is letters."""

from __future__ import annotations

from collections import Counter
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.geometry.polygons import polyline_contour
from shapeblend_cli.model import UNNAMED
from shapeblend_cli.model.words import words_in

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import Contour, Drawing, Picture, Shape
    from shapeblend_cli.model.words import Words


def with_common_texts(drawings: Sequence[Drawing]) -> list[Drawing]:
    """Return drawings in which each text that all of them have is one shape; where one has more of it, the first."""
    counts = [Counter(words for _, words in _texts(drawing)) for drawing in drawings]
    common = counts[0]
    for count in counts[1:]:
        common = common & count
    return [_merged(drawing, Counter(common)) for drawing in drawings] if common else [*drawings]


def _texts(drawing: Drawing) -> list[tuple[list[Shape], Words]]:
    """Return the letters of each text that may stay text, if all of them are there."""
    found: dict[int, list[Shape]] = {}
    for shape in drawing.shapes:
        if shape.whole is not None:
            found.setdefault(id(shape.whole), []).append(shape)
    texts = [(letters, words_in(letters[0].whole)) for letters in found.values()]
    return [(letters, words) for letters, words in texts if words and len(letters) == len(words.letters)]


def _merged(drawing: Drawing, left: Counter[Words]) -> Drawing:
    """Return a drawing in which so many of its texts are one shape each."""
    instead: dict[int, Shape | None] = {}
    for letters, words in _texts(drawing):
        if left[words] > 0:
            left[words] -= 1
            instead |= {id(letter): None for letter in letters}
            instead[id(letters[0])] = _one(letters)
    shapes = (instead.get(id(shape), shape) for shape in drawing.shapes)
    return drawing._replace(shapes=tuple(shape for shape in shapes if shape is not None))


def _one(letters: Sequence[Shape]) -> Shape:
    """Return a text as a shape that fills a box with it; the group of its letters is the text itself."""
    first = letters[0]
    assert first.whole is not None, "its letters know it"
    *groups, own = first.groups
    clips = max((letter.clips for letter in letters), key=len)
    effects = tuple(effect._replace(place=min(effect.place, len(groups))) for effect in first.effects)
    return replace(
        first,
        contours=(_outline(first.whole),),
        style=first.style._replace(fill_gradient=first.whole),
        name=own.name if first.groups else UNNAMED,
        groups=tuple(groups),
        clips=clips,
        effects=effects,
        whole=None,
    )


def _outline(picture: Picture) -> Contour:
    sides = np.array([0.0, picture.across, picture.across + picture.down, picture.down])
    return polyline_contour(picture.origin + sides)
