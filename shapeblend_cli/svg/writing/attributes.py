"""Numbers, path data and paint as SVG writes them."""

from __future__ import annotations

import cmath
import math
from typing import TYPE_CHECKING

from shapeblend_cli.model import LinearGradient

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import Box, CubicPath, Gradient, RadialGradient, Style

ROUNDING = 4e-5
"""How far a coordinate may be off by rounding, as a share of what is shown."""

SHARE_DIGITS = 5
"""Decimals of shares, such as where in a gradient a stop is."""

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


def decimals_for(boxes: Sequence[Box]) -> int:
    """As many decimals as keep points within `ROUNDING` of their places, whichever of the boxes is shown."""
    size = min(box.larger_side for box in boxes)
    return max(0, math.ceil(-math.log10(math.sqrt(2.0) * ROUNDING * size))) if size > 0.0 else 5


def path_data(outlines: Sequence[CubicPath], decimals: int) -> str:
    """Outlines as path data: lines and cubics, the letter of a command left out where SVG repeats it by itself.

    Which commands there are depends on the outlines' `straight` and `closed` alone, so that outlines alike in these
    can be animated into each other.
    """
    return "".join(_subpath(outline, decimals) for outline in outlines)


def _subpath(outline: CubicPath, decimals: int) -> str:
    segments, straight = outline.segments.tolist(), outline.straight.tolist()
    if outline.closed and straight[-1]:
        segments.pop()  # Z draws it
    parts = ["M", _point(outline.segments[0, 0], decimals)]
    last = "L"  # what follows a moveto without a letter
    for (_, p1, p2, p3), is_line in zip(segments, straight, strict=False):
        letter = "L" if is_line else "C"
        parts.append(" " if letter == last else letter)
        parts.append(" ".join(_point(z, decimals) for z in ((p3,) if is_line else (p1, p2, p3))))
        last = letter
    return "".join(parts) + ("Z" if outline.closed else "")


def _point(z: complex, decimals: int) -> str:
    return f"{number(z.real, decimals)},{number(z.imag, decimals)}"


def short_path_data(outlines: Sequence[CubicPath], decimals: int) -> str:
    """The same as `path_data`, about a fifth shorter: every point is given by its way from the one before.

    Each is rounded by itself before, so that no errors add up. A browser that goes evenly from one such list of
    numbers to another goes evenly from point to point as well.
    """
    return "".join(_short_subpath(outline, decimals) for outline in outlines)


def _short_subpath(outline: CubicPath, decimals: int) -> str:
    segments, straight = outline.segments.tolist(), outline.straight.tolist()
    if outline.closed and straight[-1]:
        segments.pop()
    scale = 10**decimals
    here = _on_grid(outline.segments[0, 0], scale)
    parts = [f"M{_way(here, (0, 0), scale)}"]
    last = ""
    for (_, p1, p2, p3), is_line in zip(segments, straight, strict=False):
        letter = "l" if is_line else "c"
        points = [_on_grid(z, scale) for z in ((p3,) if is_line else (p1, p2, p3))]
        for k, point in enumerate(points):
            way = _way(point, here, scale)
            if k or letter == last:
                parts.append(way if way.startswith("-") else f" {way}")
            else:
                parts.append(letter + way)
        here, last = points[-1], letter
    return "".join(parts) + ("z" if outline.closed else "")


def _on_grid(z: complex, scale: int) -> tuple[int, int]:
    if not (math.isfinite(z.real) and math.isfinite(z.imag)):
        raise ValueError(f"{z} cannot be written to an SVG file")
    return round(z.real * scale), round(z.imag * scale)


def _way(point: tuple[int, int], start: tuple[int, int], scale: int) -> str:
    x, y = (_shortest(p - q, scale) for p, q in zip(point, start, strict=True))
    return x + y if y.startswith("-") else f"{x} {y}"


def _shortest(value: int, scale: int) -> str:
    """A number of units of 1 / scale, without needless zeros."""
    whole, rest = divmod(abs(value), scale)
    decimals = str(rest + scale)[1:].rstrip("0") if rest else ""
    digits = (str(whole) if whole or not decimals else "") + (f".{decimals}" if decimals else "")
    return f"-{digits}" if value < 0 else digits


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
            "offset": number(stop.offset, SHARE_DIGITS),
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
        "fx": number(focus.real, SHARE_DIGITS),
        "fy": number(focus.imag, SHARE_DIGITS),
        "fr": number(focal_radius, SHARE_DIGITS),
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
