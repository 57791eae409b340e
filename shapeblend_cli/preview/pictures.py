"""What the page draws: outlines at the times between which they go straight, and paint at even times."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from shapeblend_cli.interpolate.paths import between, waypoints
from shapeblend_cli.model import LinearGradient, RadialGradient, unroll
from shapeblend_cli.paint.styles import blend_styles
from shapeblend_cli.svg.writing.paint import gradient_attributes, paint_attributes, visible_styles
from shapeblend_cli.svg.writing.path_data import path_data

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import (
        ContourBlend,
        CubicPath,
        FloatArray,
        Frame,
        Gradient,
        IntArray,
        Pair,
        ShapeBlend,
        Style,
    )

PAINT_STEPS = 30
"""Paint is given at so many even times and one; between two of them channels and numbers go evenly."""

MOST_OWN_TIMES = 60
"""Up to so many frames, what does not go straight is given at the time of each."""

GRADIENTS = ("fill", "stroke")


def picture(pair: Pair, ends: tuple[Frame, Frame], times: Sequence[float], decimals: int) -> dict[str, Any]:
    """A pair for the page.

    Parameters
    ----------
    pair : Pair
    ends : (Frame, Frame)
        What is to be seen at t = 0 and t = 1.
    times : sequence of float
        At which frames are made.
    decimals : int
        Of coordinates.

    Returns
    -------
    dict
        For JSON: `shapes` between the ends, and the `ends` themselves, in paint order.
    """
    return {
        "shapes": [_moving(shape, times, decimals) for shape in pair.shapes],
        "ends": [_still(frame, decimals) for frame in ends],
    }


def _moving(shape: ShapeBlend, times: Sequence[float], decimals: int) -> dict[str, Any]:
    known = {0.0, 1.0, *(waypoint.t for waypoint in waypoints(shape))}
    if shape.motion is not None and len(times) <= MOST_OWN_TIMES:
        known |= set(times)
    keys = sorted(known)
    grid = np.array([_on_grid(between(shape, t), decimals) for t in keys])
    # Of the first key the way from point to point, of the others what changes: small numbers, which pack well.
    points = grid.reshape(len(keys), -1, 2)
    points = np.diff(np.diff(points, axis=1, prepend=0), axis=0, prepend=0)
    return {
        "outlines": [
            {"closed": c.start.closed, "lines": "".join("CL"[s] for s in c.start.straight.tolist())}
            for c in shape.contours
        ],
        "times": keys,
        "points": points.reshape(len(keys), -1).tolist(),
        "coats": _coats(shape.style_a, shape.style_b, decimals),
    }


def _on_grid(outlines: Sequence[CubicPath], decimals: int) -> IntArray:
    """Where each outline begins and the control points of its segments, of lines the end alone, as x, y, x, y ..."""
    found = []
    for outline in outlines:
        drawn = np.ones((len(outline.segments), 3), np.bool_)
        drawn[outline.straight, :2] = False
        found += [outline.segments[:1, 0], outline.segments[:, 1:][drawn]]
    points = np.concatenate(found) * 10.0**decimals
    return np.round(np.stack([points.real, points.imag], axis=1)).astype(np.intp).ravel()


def _coats(style_a: Style, style_b: Style, decimals: int) -> list[dict[str, Any]]:
    """The paint of a shape, the lowest coat first: for each attribute, and each gradient, its values at even times."""
    steps = 0 if style_a == style_b else PAINT_STEPS
    samples = [blend_styles(style_a, style_b, k / max(steps, 1)) for k in range(steps + 1)]
    below = [under for _, under in samples if under is not None]
    coats = [below] if len(below) == len(samples) else []
    return [_coat(styles, decimals) for styles in (*coats, [style for style, _ in samples])]


def _coat(styles: Sequence[Style], decimals: int) -> dict[str, Any]:
    every = [_painted(style, decimals, as_ellipse=True) for style in styles]
    names = every[0]["path"]
    return {
        "path": {name: _unrepeated([one["path"].get(name, "none") for one in every]) for name in names},
        **{name: _unrepeated([one[name] for one in every]) for name in GRADIENTS if name in every[0]},
    }


def _unrepeated(values: list[Any]) -> list[Any]:
    """One value, where all are the same."""
    return values[:1] if all(value == values[0] for value in values) else values


def _painted(style: Style, decimals: int, *, as_ellipse: bool) -> dict[str, Any]:
    """Attributes of a path, and of its gradients."""
    found: dict[str, Any] = {"path": _with_hyphens(paint_attributes(style, decimals))}
    for name, gradient in zip(GRADIENTS, (style.fill_gradient, style.stroke_gradient), strict=True):
        if gradient is not None:
            found[name] = _gradient(gradient, decimals, as_ellipse)
    return found


def _with_hyphens(attributes: dict[str, str]) -> dict[str, str]:
    return {name.replace("_", "-"): value for name, value in attributes.items()}


def _gradient(gradient: Gradient, decimals: int, as_ellipse: bool) -> dict[str, Any]:
    is_ellipse = as_ellipse and isinstance(gradient, RadialGradient)
    attributes, stops = gradient_attributes(gradient, decimals, as_ellipse=is_ellipse)
    return {
        "tag": "linearGradient" if isinstance(gradient, LinearGradient) else "radialGradient",
        "attributes": attributes,
        "stops": [_with_hyphens(stop) for stop in stops],
    }


def _still(frame: Frame, decimals: int) -> list[dict[str, Any]]:
    """The paths of a frame at an end of time, as its file has them."""
    found = []
    for shape in frame.shapes:
        data = path_data(shape.paths, decimals)
        for style in visible_styles(shape, frame.t):
            painted = _painted(style, decimals, as_ellipse=False)
            found.append(painted | {"path": {"d": data, **painted["path"]}})
    return found


def places(contour: ContourBlend) -> FloatArray:
    """Where on the moving outline each dot of the correspondence is: the number of a segment, and its parameter.

    A dot counts in vertices of both outlines together, and so do the cuts: where both go on, so does their sum.
    """
    counts = [len(polygon.vertices) for polygon in (contour.polygon_a, contour.polygon_b)]
    closed = contour.correspondence.closed
    # A point does not go on.
    sides = [k for k in (0, 1) if counts[k] > 1]
    dots = unroll(contour.correspondence.dots, (counts[0], counts[1]) if closed else None)
    along = dots[: len(contour.correspondence.dots), sides].sum(axis=1)
    cuts = np.sum([contour.cuts[side] for side in sides], axis=0)
    if closed:
        round_ = sum(counts[side] for side in sides)
        along = cuts[0] + (along - cuts[0]) % round_
    segment = np.clip(np.searchsorted(cuts, along, "right") - 1, 0, len(cuts) - 2)
    length = cuts[segment + 1] - cuts[segment]
    share = np.divide(along - cuts[segment], length, out=np.zeros_like(along), where=length > 0.0)
    return segment + np.clip(share, 0.0, 1.0)
