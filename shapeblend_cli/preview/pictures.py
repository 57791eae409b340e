"""Shapes for the page: paths at the times between which they move straight, and paint at even times."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from shapeblend_cli.frames.outlined import letters_at
from shapeblend_cli.interpolate.parametrization import segment_positions
from shapeblend_cli.interpolate.paths import paths_at, waypoints
from shapeblend_cli.model import (
    ClipBlend,
    ContourBlend,
    CubicPath,
    Frame,
    Pair,
    Pattern,
    Picture,
    RadialGradient,
    ShapeBlend,
    Style,
    unroll,
)
from shapeblend_cli.model.words import words_in
from shapeblend_cli.options.easing import Ease
from shapeblend_cli.paint.styles import shape_styles
from shapeblend_cli.svg.writing.paint import gradient_attributes, hyphened, paint_attributes, visible_styles
from shapeblend_cli.svg.writing.path_data import path_data
from shapeblend_cli.svg.writing.rounding import number

if TYPE_CHECKING:
    from shapeblend_cli.geometry.similarity import Similarity
    from shapeblend_cli.model import ComplexArray, FloatArray, IntArray
    from shapeblend_cli.options.easing import Timing
    from shapeblend_cli.options.settings import Settings

PAINT_STEPS = 30
"""Number of even steps in time of paint. Within a step channels and numbers change evenly."""

MOST_OWN_TIMES = 60
"""Maximum number of frames at whose times curved motion is given exactly."""

UNIT_DIGITS = 5
"""Decimals of outlines in a square of side 1."""

GRADIENTS = ("fill", "stroke")


def picture(pair: Pair, ends: tuple[Frame, Frame], times: Sequence[float], decimals: int) -> dict[str, Any]:
    """Return a pair for the page: its `shapes` between the ends, and the `ends` themselves, in paint order.

    The ends are the frames at t = 0 and t = 1, and the times belong to the frames. If there are any, there are the
    `regions` that clip shapes, and the `images`: links by short names.
    """
    numbers: dict[tuple[Any, ...], int] = {}
    regions: list[dict[str, Any]] = []

    def region(shape: ShapeBlend, clip: ClipBlend) -> int:
        """Return the number of a region, which moves with the shape that it clips; shapes may share it."""
        key = id(clip), shape.span, shape.pace
        if key not in numbers:
            numbers[key] = len(regions)
            moving = [each._replace(span=shape.span, pace=shape.pace) for each in clip.shapes]
            regions.append({"rule": clip.rule, "shapes": [_moving(each, times, decimals) for each in moving]})
        return numbers[key]

    shapes = []
    for shape in pair.shapes:
        clips = [region(shape, clip) for clip in shape.clips]
        own = _moving(shape, times, decimals) | {"coats": _coats(shape, decimals)}
        shapes.append(own | ({"clips": clips} if clips else {}))
    found = {"shapes": shapes, "ends": [still_paths(frame, decimals) for frame in ends]}
    styles = [style for shape in pair.shapes for style in (shape.style_a, shape.style_b)]
    images = images_of([*styles, *(shape.style for frame in ends for shape in frame.shapes)])
    return found | ({"regions": regions} if regions else {}) | ({"images": images} if images else {})


def images_of(styles: Iterable[Style]) -> dict[str, str]:
    """Return the links of pictures in styles by short names."""
    pictures = [style.picture for style in styles if style.picture is not None]
    rasters = {picture.raster for picture in pictures if words_in(picture) is None}
    return {raster.digest: raster.uri for raster in sorted(rasters, key=lambda raster: raster.digest)}


def timing(timing: Timing, settings: Settings) -> dict[str, Any]:
    """Return how an animation runs, for the page: its easing as the inner points of a curve, or as knots."""
    ease = settings.common_ease
    return {
        "seconds": timing.seconds,
        "ease": list(ease if isinstance(ease, Ease) else ease.knots),
        "repeat": timing.repeat,
        "hold": timing.hold,
    }


def _moving(shape: ShapeBlend, times: Sequence[float], decimals: int) -> dict[str, Any]:
    """Return the outlines of a shape, and their points at the times between which they move straight."""
    own_times = times if shape.motion is not None and len(times) <= MOST_OWN_TIMES else ()
    keys = sorted({0.0, 1.0, *(waypoint.t for waypoint in waypoints(shape)), *own_times})
    grid = np.array([_on_grid(paths_at(shape, t), decimals) for t in keys])
    # Of the first key the steps from point to point, of the others what changes: small numbers, which pack well.
    points = np.diff(np.diff(grid, axis=1, prepend=0), axis=0, prepend=0)
    return {
        "outlines": [
            {"closed": c.start.closed, "lines": "".join("CL"[s] for s in c.start.straight.tolist())}
            for c in shape.contours
        ],
        "times": keys,
        "points": points.reshape(len(keys), -1).tolist(),
    }


def _on_grid(paths: Sequence[CubicPath], decimals: int) -> IntArray:
    """Return the start of each path and the control points of its segments, of lines only the end, as (p, 2) int."""
    points = []
    for path in paths:
        drawn = np.ones((len(path.segments), 3), np.bool_)
        drawn[path.straight, :2] = False
        points += [path.segments[:1, 0], path.segments[:, 1:][drawn]]
    scaled = np.concatenate(points) * 10.0**decimals
    return np.round(np.stack([scaled.real, scaled.imag], axis=1)).astype(np.intp)


def _coats(shape: ShapeBlend, decimals: int) -> list[dict[str, Any]]:
    """Return the coats of paint, the lowest first: each attribute's, and each gradient's, values at even times."""
    steps = 0 if shape.style_a == shape.style_b and shape.fade is None else PAINT_STEPS
    samples = [shape_styles(shape, k / max(steps, 1)) for k in range(steps + 1)]
    below = [under for _, under in samples if under is not None]
    coats = [below] if len(below) == len(samples) else []
    return [_coat(styles, decimals) for styles in (*coats, [style for style, _ in samples])]


def _coat(styles: Sequence[Style], decimals: int) -> dict[str, Any]:
    pictures = [style.picture for style in styles]
    if pictures[0] is not None:
        drawn = [_placed(style, decimals) for style in styles]
        return drawn[0] | {
            "image": {name: _once([one["image"][name] for one in drawn]) for name in drawn[0]["image"]}
        }
    every = [_paint(style, decimals, as_ellipse=True) for style in styles]
    first = every[0]
    return {
        "path": {name: _once([one["path"].get(name, "none") for one in every]) for name in first["path"]},
        **{name: _once([one[name] for one in every]) for name in GRADIENTS if name in first},
    }


def _placed(style: Style, decimals: int) -> dict[str, Any]:
    """Return a picture as a square of side 1 that a transform places, by its name; or a text, as outlines in that."""
    picture = style.picture
    assert picture is not None
    place = {"transform": _matrix(picture, decimals)}
    words = words_in(picture)
    if words is None:
        smooth = {} if picture.is_smooth else {"image-rendering": "pixelated"}
        square = {"width": "1", "height": "1", "preserveAspectRatio": "none", **smooth}
        opacity = {"opacity": number(style.fill_opacity, 4)}
        return {"source": picture.raster.digest, "image": {**square, **place, **opacity}}
    own = letters_at(words, picture._replace(origin=0j, across=1.0 + 0j, down=1j))
    paint = {"fill": style.fill or "none", "fill-opacity": number(style.fill_opacity, 4)}
    return {"image": {"d": path_data(own, UNIT_DIGITS), **place, **paint}}


def _matrix(picture: Picture, decimals: int) -> str:
    parts = [part for z in (picture.across, picture.down, picture.origin) for part in (z.real, z.imag)]
    return f"matrix({' '.join(number(part, decimals + 2) for part in parts)})"


def _once(values: list[Any]) -> list[Any]:
    """Return one value where all are equal."""
    return values[:1] if all(value == values[0] for value in values) else values


def _paint(style: Style, decimals: int, *, as_ellipse: bool) -> dict[str, Any]:
    attributes = paint_attributes(style._replace(pixel=None), decimals)  # pictures have any size
    attributes.pop("vector_effect", None)
    paint: dict[str, Any] = {"path": hyphened(attributes)}
    for name, gradient in zip(GRADIENTS, (style.fill_gradient, style.stroke_gradient), strict=True):
        # A plain colour stands for a pattern.
        if gradient is not None and not isinstance(gradient, Pattern | Picture):
            is_radial = isinstance(gradient, RadialGradient)
            attributes, stops = gradient_attributes(gradient, decimals, as_ellipse=as_ellipse and is_radial)
            paint[name] = {
                "tag": "radialGradient" if is_radial else "linearGradient",
                "attributes": attributes,
                "stops": [hyphened(stop) for stop in stops],
            }
    return paint


def still_paths(frame: Frame, decimals: int) -> list[dict[str, Any]]:
    """Return the paths of a frame at an end of time, as its file has them."""
    paths = []
    for shape in frame.shapes:
        data = path_data(shape.paths, decimals)
        clips = [{"d": path_data(clip.paths, decimals), "rule": clip.rule} for clip in shape.clips]
        clipped = {"clips": clips} if clips else {}
        for style in visible_styles(shape, frame.t):
            if style.picture is not None:
                paths.append(_placed(style, decimals) | clipped)
                continue
            paint = _paint(style, decimals, as_ellipse=False)
            paths.append(paint | {"path": {"d": data, **paint["path"]}} | clipped)
    return paths


def correspondence_lists(contour: ContourBlend, decimals: int) -> dict[str, Any]:
    """Return which vertices of a contour become which: both lists, the dots, and where these are on the way."""
    return {
        "vertices_a": rounded_points(contour.polygon_a.vertices, decimals + 1),
        "vertices_b": rounded_points(contour.polygon_b.vertices, decimals + 1),
        "dots": contour.correspondence.dots.tolist(),
        "places": rounded(dot_positions(contour), 3),
    }


def scale_and_shift(to_a: Similarity) -> list[float]:
    """Return a map that does not rotate as a factor and a shift, so that the page can undo it."""
    shift = to_a.point(0j)
    return [complex(to_a.factor).real, shift.real, shift.imag]


def rounded_points(points: ComplexArray, decimals: int) -> list[list[float]]:
    """Return points as pairs of numbers that are written with a number of decimals."""
    return rounded(np.stack([points.real, points.imag], axis=1), decimals)


def rounded(values: FloatArray | Sequence[float], decimals: int) -> list[Any]:
    """Return numbers as they are written with a number of decimals, in lists as the array's."""
    found = np.round(np.asarray(values), decimals) + 0.0  # no zero is negative
    if not np.isfinite(found).all():
        raise ValueError(f"{found} cannot be written")
    return found.tolist()


def dot_positions(contour: ContourBlend) -> FloatArray:
    """Return where on the moving outline each dot of the correspondence is: a segment's number plus its parameter.

    Dots are compared with cuts by the sum of their positions on the segments of both outlines, which rises with either.
    """
    found = contour.correspondence
    polygons = contour.polygon_a, contour.polygon_b
    counts = len(polygons[0].vertices), len(polygons[1].vertices)
    dots = unroll(found.dots, counts if found.closed else None)[: len(found.dots)]
    along, cuts, round_ = np.zeros(len(dots)), np.zeros(len(contour.cuts[0])), 0
    for side, outline in enumerate((contour.contour_a, contour.contour_b)):
        if counts[side] > 1:  # a point has no positions
            along += segment_positions(outline, polygons[side], dots[:, side])
            cuts += segment_positions(outline, polygons[side], contour.cuts[side])
            round_ += len(outline.segments)
    if found.closed:
        along = cuts[0] + (along - cuts[0]) % round_
    segment = np.clip(np.searchsorted(cuts, along, "right") - 1, 0, len(cuts) - 2)
    length = cuts[segment + 1] - cuts[segment]
    share = np.divide(along - cuts[segment], length, out=np.zeros_like(along), where=length > 0.0)
    return segment + np.clip(share, 0.0, 1.0)
