"""Numbers, path data and paint as SVG writes them."""

from __future__ import annotations

import cmath
import math
from typing import TYPE_CHECKING

from shapeblend_cli.model import LinearGradient

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import Box, Gradient, Outline, RadialGradient, Style

DIGITS = 5
"""Coordinates are written to about this share, 10 ** -DIGITS, of the drawing's size."""

DEFAULTS = {
    "fill_opacity": "1",
    "fill_rule": "nonzero",
    "stroke_opacity": "1",
    "stroke_width": "1",
    "stroke_linecap": "butt",
    "stroke_linejoin": "miter",
    "stroke_miterlimit": "4",
    "stroke_dasharray": "none",
    "stroke_dashoffset": "0",
}
"""What SVG takes for attributes that are not there."""


def decimals_for(box: Box) -> int:
    """Decimals that keep coordinates within half of 10 ** -DIGITS of a drawing's size."""
    size = max(box.width, box.height)
    return max(0, DIGITS - math.floor(math.log10(size))) if size > 0.0 else DIGITS


def path_data(outlines: Sequence[Outline], decimals: int) -> str:
    """Polygons as path data: pairs after the first are lines without saying so."""
    parts = []
    for outline in outlines:
        points = " ".join(
            f"{number(z.real, decimals)},{number(z.imag, decimals)}" for z in outline.vertices.tolist()
        )
        parts.append(f"M{points}{'Z' if outline.closed else ''}")
    return "".join(parts)


def without_defaults(attributes: dict[str, str]) -> dict[str, str]:
    """The attributes that say something else than SVG does by itself."""
    return {name: value for name, value in attributes.items() if DEFAULTS.get(name) != value}


def plainest(style: Style) -> Style:
    """A style that paints the same without dashes that touch each other, or gradients of a single colour.

    Both are there at the ends of time where the other end has dashes or a gradient. A keyframe needs them; in a picture
    that stands still, dashes that touch show seams.
    """
    dashes = style.stroke_dasharray
    # Of an odd number, dashes are gaps the second time round.
    if dashes and len(dashes) % 2 == 0 and not any(dashes[1::2]):
        style = style._replace(stroke_dasharray=(), stroke_dashoffset=0.0)
    for name, gradient in (("fill", style.fill_gradient), ("stroke", style.stroke_gradient)):
        if gradient is not None and len({(stop.colour, stop.opacity) for stop in gradient.stops}) == 1:
            style = style.with_plain(name, gradient.stops[0])
    return style


def paint_attributes(style: Style, decimals: int) -> dict[str, str]:
    """Presentation attributes of a style; gradients apart, for which `gradient_attributes` is there."""
    paint = {"fill": style.fill or "none"}
    if style.fill is not None:
        paint["fill_opacity"] = number(style.fill_opacity, 4)
        paint["fill_rule"] = style.fill_rule
    if style.stroke is not None:
        paint["stroke"] = style.stroke
        paint["stroke_opacity"] = number(style.stroke_opacity, 4)
        paint["stroke_width"] = number(style.stroke_width, decimals)
        paint["stroke_linecap"] = style.stroke_linecap
        paint["stroke_linejoin"] = style.stroke_linejoin
        paint["stroke_miterlimit"] = number(style.stroke_miterlimit, 4)
        dashes = " ".join(number(length, decimals) for length in style.stroke_dasharray)
        paint["stroke_dasharray"] = dashes or "none"
        paint["stroke_dashoffset"] = number(style.stroke_dashoffset, decimals) if dashes else "0"
    return paint


def gradient_attributes(
    gradient: Gradient, decimals: int, *, as_ellipse: bool = False
) -> tuple[dict[str, str], list[dict[str, str]]]:
    """Attributes of a gradient and of each of its stops.

    Parameters
    ----------
    gradient : LinearGradient or RadialGradient
    decimals : int
    as_ellipse : bool
        Write a circle as an ellipse too, so that it has the attributes of one: a unit circle under
        ``translate(x y) rotate(angle) scale(rx ry)``.
    """
    found = {"gradientUnits": "userSpaceOnUse"}
    if isinstance(gradient, LinearGradient):
        for end, point in (("1", gradient.start), ("2", gradient.end)):
            found[f"x{end}"] = number(point.real, decimals)
            found[f"y{end}"] = number(point.imag, decimals)
    else:
        found |= _radial_attributes(gradient, decimals, as_ellipse)
    if gradient.spread != "pad":
        found["spreadMethod"] = gradient.spread
    stops = [
        {
            "offset": number(stop.offset, DIGITS),
            "stop_color": stop.colour,
            "stop_opacity": number(stop.opacity, 4),
        }
        for stop in gradient.stops
    ]
    return found, stops


def _radial_attributes(gradient: RadialGradient, decimals: int, as_ellipse: bool) -> dict[str, str]:
    centre, focus, focal_radius = gradient.centre, gradient.focus, gradient.focal_radius
    first, second = gradient.radii
    if first == second and not as_ellipse:
        spot = centre + first * focus * cmath.rect(1.0, math.radians(gradient.angle))
        return {
            "cx": number(centre.real, decimals),
            "cy": number(centre.imag, decimals),
            "r": number(first, decimals),
            "fx": number(spot.real, decimals),
            "fy": number(spot.imag, decimals),
            "fr": number(first * focal_radius, decimals),
        }
    place = f"{number(centre.real, decimals)} {number(centre.imag, decimals)}"
    stretch = f"{number(first, decimals)} {number(second, decimals)}"
    return {
        "cx": "0",
        "cy": "0",
        "r": "1",
        "fx": number(focus.real, DIGITS),
        "fy": number(focus.imag, DIGITS),
        "fr": number(focal_radius, DIGITS),
        "gradientTransform": f"translate({place}) rotate({number(gradient.angle, 4)}) scale({stretch})",
    }


def number(value: float, decimals: int) -> str:
    """A finite number in its shortest form with at most so many decimals."""
    if not math.isfinite(value):
        raise ValueError(f"{value} cannot be written to an SVG file")
    text = f"{value:.{decimals}f}"
    if "." in text:
        text = text.rstrip("0").rstrip(".")
    return "0" if text == "-0" else text
