"""Pictures of two drawings: which becomes which, how they move, and where they come in the order of paint.

A picture moves as a whole, by its place, size and angle, and dissolves into the picture that it becomes. One without a
partner fades at its place.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.blending.blended import blend_shapes
from shapeblend_cli.errors import InputError, MatchError
from shapeblend_cli.interpolate.paths import with_curves
from shapeblend_cli.model import Box, Fade, ShapeBlend
from shapeblend_cli.model.words import words_in
from shapeblend_cli.motion.rigid import Posed
from shapeblend_cli.paint.styles import painted_as
from shapeblend_cli.wires.contour_blends import keep_still, vertex_by_vertex

if TYPE_CHECKING:
    from collections.abc import Collection, Sequence

    from shapeblend_cli.anatomy.decompose import PlacedContour, PlacedDrawing
    from shapeblend_cli.blending.matched import Progress
    from shapeblend_cli.model import ContourBlend, Drawing, Picture, Pose, Shapes, Style
    from shapeblend_cli.options.settings import Settings

FADE = (0.4, 0.6)
"""Times between which a picture changes its place in the order of paint."""

OTHER_PICTURE = 0.2
"""Cost of a pair of two different pictures, beside distances in sizes of the view."""

SIZES = 0.1
"""Cost of a pair of which one side is e times as long as the other."""


class PicturePair(NamedTuple):
    """A picture of A and the picture of B that it becomes; None for a missing one."""

    a: PlacedContour | None
    b: PlacedContour | None
    reason: str


def without_pictures(drawing: Drawing) -> Drawing:
    """Return a drawing without its pictures; raise InputError if nothing is left."""
    left = tuple(shape for shape in drawing.shapes if not shape.style.picture)
    if not left:
        raise InputError(
            drawing.file, "mixtures and states have no pictures; a drawing with shapes would work"
        )
    return drawing._replace(shapes=left)


def blend_with_pictures(
    a: PlacedDrawing, b: PlacedDrawing, settings: Settings, view: Box, progress: Progress
) -> Shapes:
    """Blend two drawings as `blend_shapes` does, and their pictures."""
    pictures = [[c for c in side.contours if c.style.picture] for side in (a, b)]
    solid = [side._replace(contours=[c for c in side.contours if not c.style.picture]) for side in (a, b)]
    pairs, settings = _pairs(pictures, (a, b), settings, view)
    if all(side.contours for side in solid):
        shapes = list(blend_shapes(solid[0], solid[1], settings, view, progress))
    else:
        shapes = [shape for k, side in enumerate(solid) for shape in _fading(side, k, settings)]
    for pair in pairs:
        shapes = _inserted(shapes, _picture_blend(pair, settings))
    return tuple(shapes)


def _pairs(
    pictures: Sequence[Sequence[PlacedContour]],
    drawings: tuple[PlacedDrawing, PlacedDrawing],
    settings: Settings,
    view: Box,
) -> tuple[list[PicturePair], Settings]:
    """Return which pictures become which, in the order of paint, and the settings for all else."""
    left = [list(side) for side in pictures]
    pairs = []

    def take(i: int, j: int, reason: str) -> None:
        pairs.append(PicturePair(left[0].pop(i), left[1].pop(j), reason))

    wanted = []
    for match in settings.match:
        found = [
            [k for k, c in enumerate(side) if isinstance(name, str) and _is_called(name, c, drawing)]
            for name, side, drawing in zip(match, left, drawings, strict=True)
        ]
        if all(found):
            i, j = found[0][0], found[1][0]
            if not _may_pair(left[0][i], left[1][j]):
                raise MatchError(f"--match {match[0]},{match[1]}: text that stays text becomes the same text")
            take(i, j, "as --match says")
        elif any(found):
            raise MatchError(
                f"--match {match[0]},{match[1]}: a picture becomes a picture, and only one of these is one"
            )
        else:
            wanted.append(match)
    for reason, name in (("same id", _id), ("same label", _label)):
        i = 0
        while i < len(left[0]):
            own = name(left[0][i], drawings[0])
            partners = [
                j
                for j, c in enumerate(left[1])
                if own is not None and own == name(c, drawings[1]) and _may_pair(left[0][i], c)
            ]
            if partners:
                take(i, partners[0], reason)
            else:
                i += 1
    if all(left):
        costs = _costs(left[0], left[1], view)
        sides = [list(side) for side in left]
        for place in np.argsort(costs, axis=None, kind="stable").tolist():
            one, other = sides[0][place // costs.shape[1]], sides[1][place % costs.shape[1]]
            if one in left[0] and other in left[1] and _may_pair(one, other):
                take(left[0].index(one), left[1].index(other), "nearest in place and size")
    pairs += [PicturePair(c, None, "no picture is left in B") for c in left[0]]
    pairs += [PicturePair(None, c, "no picture is left in A") for c in left[1]]
    order = sorted(pairs, key=lambda pair: max(c.shape for c in (pair.a, pair.b) if c is not None))
    return order, settings.replace(match=tuple(wanted)) if len(wanted) < len(settings.match) else settings


def _may_pair(a: PlacedContour, b: PlacedContour) -> bool:
    """Return whether a picture may become another one: text becomes the same text."""
    words = [words_in(c.style.picture) for c in (a, b)]
    return words[0] == words[1]


def _is_called(name: str, contour: PlacedContour, drawing: PlacedDrawing) -> bool:
    return name == str(contour.number) or name.removeprefix("#") == _id(contour, drawing)


def _id(contour: PlacedContour, drawing: PlacedDrawing) -> str | None:
    return drawing.drawing.shapes[contour.shape].id


def _label(contour: PlacedContour, drawing: PlacedDrawing) -> str | None:
    return drawing.drawing.shapes[contour.shape].name.label


def _costs(a: Sequence[PlacedContour], b: Sequence[PlacedContour], view: Box) -> np.ndarray:
    """Return the cost of each pair, (len(a), len(b)) float: distance, difference in size, and another picture."""
    poses = [[_picture(c.style).pose for c in side] for side in (a, b)]
    centres = [np.array([pose.centre for pose in side]) for side in poses]
    sizes = [np.log([abs(pose.width * pose.height) for pose in side]) / 2.0 for side in poses]
    costs = np.abs(np.subtract.outer(*centres)) / view.larger_side
    costs += SIZES * np.abs(np.subtract.outer(*sizes))
    names = [[_picture(c.style).raster.digest for c in side] for side in (a, b)]
    return costs + OTHER_PICTURE * (np.array(names[0])[:, None] != np.array(names[1]))


def _picture(style: Style) -> Picture:
    assert style.picture is not None, "it is a picture's"
    return style.picture


def _picture_blend(pair: PicturePair, settings: Settings) -> ShapeBlend:
    """Return a picture that becomes another one, or that fades."""
    contours = pair.a, pair.b
    styles = [c.style if c is not None else None for c in contours]
    style_a = styles[0] or styles[1]
    style_b = styles[1] or styles[0]
    assert style_a is not None
    assert style_b is not None
    if pair.a is None or pair.b is None:
        style_a, style_b = (style_a.faded(0.0), style_b) if pair.a is None else (style_a, style_b.faded(0.0))
    start, end = _picture(style_a), _picture(style_b)
    style_a, style_b = painted_as(style_a, style_b, settings.style)
    # Of a picture that is painted as another one only the place stays.
    style_a = style_a._replace(fill_gradient=_picture(style_a).posed(start.pose))
    style_b = style_b._replace(fill_gradient=_picture(style_b).posed(end.pose))
    motion = Posed(start.pose, end.pose)
    contour = _contour_blend(pair, motion.start, end.pose.near(start.pose))
    sources = tuple(None if c is None else c.shape for c in contours)
    return ShapeBlend(
        (contour,),
        style_a,
        style_b,
        motion,
        "pictures move by place, size and angle",
        sources=(sources[0], sources[1]),
    )


def _contour_blend(pair: PicturePair, start: Pose, end: Pose) -> ContourBlend:
    """Return the blend of the outlines of two pictures, corner by corner."""
    a, b = (np.array(pose.corners) for pose in (start, end))
    numbers = tuple(None if c is None else c.number for c in (pair.a, pair.b))
    sizes = Box.around(a).larger_side, Box.around(b).larger_side
    return vertex_by_vertex((numbers[0], numbers[1]), a, b, sizes)._replace(reason=pair.reason)


def _fading(drawing: PlacedDrawing, end: int, settings: Settings) -> list[ShapeBlend]:
    """Return the shapes of a drawing beside one that has only pictures: they fade where they are."""
    found = []
    for index in sorted({contour.shape for contour in drawing.contours}):
        own = [contour for contour in drawing.contours if contour.shape == index]
        blends = [
            keep_still(c, (None, c.number) if end else (c.number, None))._replace(
                reason="the other drawing has only pictures"
            )
            for c in own
        ]
        if settings.curves:
            blends = [with_curves(blend) for blend in blends]
        style = own[0].style
        styles = (style.faded(0.0), style) if end else (style, style.faded(0.0))
        sources = (None, index) if end else (index, None)
        found.append(ShapeBlend(tuple(blends), *styles, sources=sources))
    return found


def _touched(shapes: Sequence[ShapeBlend], picture: ShapeBlend, end: int) -> set[int]:
    """Return the numbers of shapes whose boxes a picture touches at one of its ends."""
    own = picture.box(end)
    return {k for k, shape in enumerate(shapes) if shape.box(end).overlaps(own)}


def _inserted(shapes: Sequence[ShapeBlend], picture: ShapeBlend) -> list[ShapeBlend]:
    """Return shapes with a picture at its place in the order of paint; twice if the drawings disagree."""
    places = range(len(shapes) + 1)
    # A text covers little: only what it touches counts, and the order of the files where that leaves a choice.
    touched = [
        _touched(shapes, picture, end) if words_in(picture.style_a.picture) else None for end in (0, 1)
    ]

    def wrong(place: int, end: int, among: Collection[int] | None = None) -> int:
        """Return how many shapes, or some of them, would be painted on the wrong side of it in one of the drawings."""
        own = picture.sources[end]
        numbers = [shape.sources[end] for shape in shapes]
        if own is None:
            return 0
        return sum(
            n is not None and (among is None or k in among) and ((n > own) if k < place else (n < own))
            for k, n in enumerate(numbers)
        )

    def cost(place: int) -> tuple[int, int]:
        return sum(wrong(place, end, touched[end]) for end in (0, 1)), wrong(place, 0) + wrong(place, 1)

    best = min(places, key=cost)
    if cost(best)[0] == 0 or None in picture.sources:
        return [*shapes[:best], picture, *shapes[best:]]
    goes, comes = (min(places, key=lambda place, end=end: wrong(place, end)) for end in (0, 1))  # type: ignore[misc]
    copies = (
        (goes, picture._replace(fade=Fade(*FADE, comes=False))),
        (comes, picture._replace(fade=Fade(*FADE, comes=True), is_twin=True)),
    )
    found = list(shapes)
    for place, copy in sorted(copies, key=lambda one: -one[0]):
        found.insert(place, copy)
    return found
