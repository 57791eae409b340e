"""Styles between two styles."""

from __future__ import annotations

import math
from functools import lru_cache
from typing import TYPE_CHECKING, Any

from shapeblend_cli.model import Paint, Pattern, Picture
from shapeblend_cli.paint.oklab import blend_colours

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import Gradient, ShapeBlend, Style

MOST_DASHES = 64
"""Maximum number of entries to which two lists of dashes are repeated."""


INSTANT = 1e-4
"""Share of the time from key to key in which a value changes at once."""

MOST_KNOWN = 512
"""Maximum number of blended styles that are kept: many shapes have the same ones, and the judge asks several times."""

NO_PAINT = Paint(None, 1.0)


def painted_as(a: Style, b: Style, style: str) -> tuple[Style, Style]:
    """Return the styles of a pair under `--style`: A's for both, B's for both, or each its own.

    The fill rule, which belongs to the contours rather than to the paint, stays.
    """
    if style == "a":
        return a, a._replace(fill_rule=b.fill_rule)
    if style == "b":
        return b._replace(fill_rule=a.fill_rule), b
    return a, b


def blend_styles(a: Style, b: Style, t: float) -> tuple[Style, Style | None]:
    """Return the paint at time t.

    Colours blend in OKLab, and so do gradients of one kind, and a plain colour with a gradient. Paint that only one
    side has fades in or out as it is, but for a stroke that only makes its fill larger, which gets thin. Widths, dashes
    and opacities change evenly; joins, caps and the fill rule, which have nothing in between, change at half time. So
    do widths and dashes if one stroke scales with its drawing and the other does not; if neither does, they change
    evenly on the screen.

    The second style, if any, is painted below. A linear and a radial gradient have nothing in between, so B's dissolves
    into view over A's, which weighs 1 - t everywhere. So does a picture over another, both on their way from the place
    of A's to B's. If both are opaque, A's stays opaque until it is covered: the ground would shine through two
    half-transparent coats.
    """
    a, b = _with_stroke_of(a, b), _with_stroke_of(b, a)
    (fill, fill_below), (stroke, stroke_below) = (
        _blend_paint(p, q, t) for p, q in zip(a.paints, b.paints, strict=True)
    )
    plain = (a if t < 0.5 else b)._replace(
        stroke_miterlimit=(1.0 - t) * a.stroke_miterlimit + t * b.stroke_miterlimit,
        **_blend_stroke_lengths(a, b, t),
    )
    if fill_below is None and stroke_below is None:
        return plain.painted(fill, stroke), None
    if fill_below is None:  # only paint that dissolves is painted twice; a fill that does not is below
        fill, fill_below = NO_PAINT, fill
    return plain.painted(fill, stroke), plain.painted(fill_below, stroke_below or NO_PAINT)


_known_styles = lru_cache(MOST_KNOWN)(blend_styles)


def shape_styles(shape: ShapeBlend, t: float) -> tuple[Style, Style | None]:
    """Return the paint of a shape at time t, as `blend_styles` does, with its fade."""
    t, styles = min(max(shape.own_time(t), 0.0), 1.0), (shape.style_a, shape.style_b)
    # What is painted with pictures would be kept for longer than its drawing.
    blend = blend_styles if any(style.has_pictures for style in styles) else _known_styles
    above, below = blend(*styles, t)
    if shape.fade is None:
        return above, below
    share = shape.fade.share(t)
    return above.faded(share), below and below.faded(share)


def faded_coats(shape: ShapeBlend) -> tuple[tuple[float, ...], list[list[Style]]]:
    """Return the times of a fade, in the shape's own time, and for every coat of paint its styles at 0, then and at 1.

    The times of a shape with a pace are those of the blend.

    A browser can interpolate from each style to the next. The lowest coat comes first.
    """
    times = shape.fade.times if shape.fade is not None else ()
    if shape.pace:
        times = paint_times(shape, times)
        return times, _coats([shape_styles(shape, t) for t in (0.0, *times, 1.0)])
    return times, _coats([shape_styles(shape, shape.time_of(t)) for t in (0.0, *times, 1.0)])


def paint_times(shape: ShapeBlend, changes: Sequence[float]) -> tuple[float, ...]:
    """Return the times between which paint changes evenly, given those of its changes in the shape's own time."""
    if shape.pace:
        # What has nothing in between changes at half time.
        jumps = (0.5 - INSTANT, 0.5 + INSTANT) if shape.style_a != shape.style_b else ()
        changes = (0.0, *changes, *jumps, 1.0)
    return tuple(shape.times_of(changes))


def _coats(samples: Sequence[tuple[Style, Style | None]]) -> list[list[Style]]:
    """Return the styles of each coat of paint, the lowest first, given styles above and below."""
    above = [style for style, _ in samples]
    below = [style for _, style in samples if style is not None]
    return [below, above] if len(below) == len(samples) else [above]


def _with_stroke_of(style: Style, other: Style) -> Style:
    """Give a style without a stroke the width, dashes and so on of another, whose stroke then fades unchanged.

    A stroke that only makes its fill larger does not fade, as a grey edge would be seen: it gets thin.
    """
    if style.stroke is not None:
        return style
    fill, stroke = style.paints
    if style.fill is None or not _enlarges(other):
        return other.painted(fill, stroke)._replace(fill_rule=style.fill_rule)
    return other.painted(fill, fill)._replace(fill_rule=style.fill_rule, stroke_width=0.0)


def _enlarges(style: Style) -> bool:
    """Return whether a stroke cannot be told from the fill that it surrounds."""
    fill, stroke = style.paints
    return fill == stroke == Paint(fill.colour, 1.0) and not style.stroke_dasharray and style.pixel is None


def _blend_paint(a: Paint, b: Paint, t: float) -> tuple[Paint, Paint | None]:
    """Return the paint at time t, and the paint below it if two gradients or patterns are of different kinds."""
    if a.colour is None:
        return b._replace(opacity=t * b.opacity), None
    if b.colour is None:
        return a._replace(opacity=(1.0 - t) * a.opacity), None
    opacity = (1.0 - t) * a.opacity + t * b.opacity
    colour = blend_colours(a.colour, b.colour, t, a.opacity, b.opacity)
    if a.gradient == b.gradient:
        return Paint(colour, opacity, a.gradient), None
    if isinstance(a.gradient, Picture) and isinstance(b.gradient, Picture):
        pose = a.gradient.pose.towards(b.gradient.pose, t)
        pictures = a.gradient.posed(pose), b.gradient.posed(pose)
        if a.gradient.raster == b.gradient.raster:
            return Paint(colour, opacity, pictures[0]), None
        below = a._replace(opacity=_opacity_below(a, b, t), gradient=pictures[0])
        return b._replace(opacity=t * b.opacity, gradient=pictures[1]), below

    from shapeblend_cli.paint.gradients import blend_gradients, plain_gradient  # few drawings have any

    either = a.gradient or b.gradient
    assert either is not None
    assert not isinstance(a.gradient, Picture), "pictures become pictures"
    assert not isinstance(b.gradient, Picture), "pictures become pictures"
    assert not isinstance(either, Picture)
    gradient: Gradient | None = None
    if not isinstance(either, Pattern) or (a.gradient and b.gradient):
        gradient_a = a.gradient or plain_gradient(either, a.colour)
        gradient = blend_gradients(gradient_a, b.gradient or plain_gradient(either, b.colour), t)
    if gradient is not None:
        return Paint(colour, opacity, gradient), None
    return b._replace(opacity=t * b.opacity), a._replace(opacity=_opacity_below(a, b, t))


def _opacity_below(a: Paint, b: Paint, t: float) -> float:
    """Return the opacity of A's paint below B's, which is painted with t times its opacity.

    Of the paint below, a share of 1 - t * (B's opacity) is seen, which has to be (1 - t) * (A's opacity) in all.
    """
    cover = b.least_opacity
    return a.opacity if cover == 1.0 else (1.0 - t) * a.opacity / (1.0 - t * cover)


def _blend_stroke_lengths(a: Style, b: Style, t: float) -> dict[str, Any]:
    """Return the fields of a style with the lengths of its stroke at time t."""
    pixel = None
    if a.pixel and b.pixel:
        pixel = (1.0 - t) * a.pixel + t * b.pixel
        a, b = a.stretched(pixel / a.pixel), b.stretched(pixel / b.pixel)
    elif a.pixel or b.pixel:
        pixel, t = (a.pixel, 0.0) if t < 0.5 else (b.pixel, 1.0)
    dashes, offset = _blend_dashes(a, b, t)
    return {
        "stroke_width": (1.0 - t) * a.stroke_width + t * b.stroke_width,
        "stroke_dasharray": dashes,
        "stroke_dashoffset": offset,
        "pixel": pixel,
    }


def _blend_dashes(a: Style, b: Style, t: float) -> tuple[tuple[float, ...], float]:
    """Return the dashes at time t and their offset; lists too long for `common_dashes` change at half time."""
    first, second = common_dashes(a.stroke_dasharray, b.stroke_dasharray)
    # A solid line looks the same wherever its dashes begin.
    start = a.stroke_dashoffset if a.stroke_dasharray else b.stroke_dashoffset
    end = b.stroke_dashoffset if b.stroke_dasharray else a.stroke_dashoffset
    if len(first) != len(second):
        return (first if t < 0.5 else second), (start if t < 0.5 else end)
    dashes = tuple((1.0 - t) * p + t * q for p, q in zip(first, second, strict=True))
    return dashes, (1.0 - t) * start + t * end


def common_dashes(a: tuple[float, ...], b: tuple[float, ...]) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """Repeat two lists of dashes until they are equally long.

    A solid line gets dashes of the other's periods, with gaps of length 0. Both lists are empty if both lines are
    solid, and stay different in length if their common length would be more than `MOST_DASHES`.

    Examples
    --------
    >>> common_dashes((1, 2), (3,))
    ((1, 2), (3, 3))
    >>> common_dashes((), (4, 1))
    ((5, 0), (4, 1))
    """
    # In an odd list, dashes and gaps change roles the second time.
    a, b = (dashes * (1 + len(dashes) % 2) for dashes in (a, b))
    a, b = a or _without_gaps(b), b or _without_gaps(a)
    length = math.lcm(len(a), len(b))
    if not a or length > MOST_DASHES:
        return a, b
    return a * (length // len(a)), b * (length // len(b))


def _without_gaps(dashes: tuple[float, ...]) -> tuple[float, ...]:
    pairs = zip(dashes[::2], dashes[1::2], strict=True)
    return tuple(length for dash, gap in pairs for length in (dash + gap, 0 * gap))


def keyed_styles(styles: Sequence[Style]) -> list[list[Style]] | None:
    """Return the styles of a shape at two or more keys so that a browser can interpolate from one to the next.

    There is a list of styles for every coat of paint, the lowest first: two coats if one paint dissolves into another.
    None if more than two keys have no common form, because of gradients or different dashes.
    """
    if len(styles) == 2:
        return _coats([blend_styles(styles[0], styles[1], t) for t in (0.0, 1.0)])
    if any(style.fill_gradient or style.stroke_gradient for style in styles):
        return None
    filled = [k for k, style in enumerate(styles) if style.fill is not None]
    stroked = [k for k, style in enumerate(styles) if style.stroke is not None]
    keyed = []
    for k, style in enumerate(styles):
        if style.fill is None and filled:
            near = styles[min(filled, key=lambda other: abs(other - k))]
            style = style._replace(fill=near.fill, fill_opacity=0.0)
        if style.stroke is None and stroked:
            near = styles[min(stroked, key=lambda other: abs(other - k))]
            style = _with_stroke_of(style, near)
            if style.stroke is None:
                style = style._replace(stroke=near.stroke, stroke_opacity=0.0)
        keyed.append(style)
    return [keyed] if len({len(style.stroke_dasharray) for style in keyed}) == 1 else None
