"""Paint between two paints."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

from shapeblend_cli.paint.colours import blend_colours

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import Gradient, Style

MOST_DASHES = 64
"""Entries of a list of dashes that two lists are repeated to, at most."""

if TYPE_CHECKING:
    from collections.abc import Sequence


class _Paint(NamedTuple):
    """What a fill or a stroke is painted with; no colour is no paint."""

    colour: str | None
    opacity: float
    gradient: Gradient | None = None


_NO_PAINT = _Paint(None, 1.0)


def painted_as(a: Style, b: Style, style: str) -> tuple[Style, Style]:
    """The styles of a pair under `--style`: A's for both, B's for both, or each its own.

    The fill rule belongs to the contours rather than to the paint, and stays.

    Parameters
    ----------
    a, b : Style
    style : {'a', 'b', 'blend'}
    """
    if style == "a":
        return a, a._replace(fill_rule=b.fill_rule)
    if style == "b":
        return b._replace(fill_rule=a.fill_rule), b
    return a, b


def blend_styles(a: Style, b: Style, t: float) -> tuple[Style, Style | None]:
    """Paint at time t.

    Colours blend in OKLab, gradients of one kind and plain colours like gradients; paint that only one side has fades
    in or out as it is. Widths, dashes and opacities go straight; joins, caps and the fill rule, which have nothing in
    between, change at half time.

    Returns
    -------
    style : Style
    below : Style or None
        What is painted under it. A linear and a radial gradient have nothing in between, so B's dissolves into view
        over A's: that weighs 1 - t in every point, and where both are opaque A's stays opaque until it is covered
        altogether, for two half-transparent coats would let the ground shine through.
    """
    a, b = _with_stroke_of(a, b), _with_stroke_of(b, a)
    fill, fill_below = _blend_paint(_fill(a), _fill(b), t)
    stroke, stroke_below = _blend_paint(_stroke(a), _stroke(b), t)
    dashes, offset = _blend_dashes(a, b, t)
    plain = (a if t < 0.5 else b)._replace(
        stroke_width=(1.0 - t) * a.stroke_width + t * b.stroke_width,
        stroke_miterlimit=(1.0 - t) * a.stroke_miterlimit + t * b.stroke_miterlimit,
        stroke_dasharray=dashes,
        stroke_dashoffset=offset,
    )
    if fill_below is None and stroke_below is None:
        return _painted(plain, fill, stroke), None
    # What need not dissolve is painted once: a stroke above, a fill below.
    if stroke_below is None:
        return _painted(plain, fill, stroke), _painted(plain, fill_below or _NO_PAINT, _NO_PAINT)
    if fill_below is None:
        return _painted(plain, _NO_PAINT, stroke), _painted(plain, fill, stroke_below)
    return _painted(plain, fill, stroke), _painted(plain, fill_below, stroke_below)


def _fill(style: Style) -> _Paint:
    return _Paint(style.fill, style.fill_opacity, style.fill_gradient)


def _stroke(style: Style) -> _Paint:
    return _Paint(style.stroke, style.stroke_opacity, style.stroke_gradient)


def _painted(style: Style, fill: _Paint, stroke: _Paint) -> Style:
    return style._replace(
        fill=fill.colour,
        fill_opacity=fill.opacity,
        fill_gradient=fill.gradient,
        stroke=stroke.colour,
        stroke_opacity=stroke.opacity,
        stroke_gradient=stroke.gradient,
    )


def _with_stroke_of(style: Style, other: Style) -> Style:
    """A style without a stroke has the other's all along, so that it fades in or out as it is."""
    if style.stroke is not None:
        return style
    return style._replace(
        stroke_width=other.stroke_width,
        stroke_linecap=other.stroke_linecap,
        stroke_linejoin=other.stroke_linejoin,
        stroke_miterlimit=other.stroke_miterlimit,
        stroke_dasharray=other.stroke_dasharray,
        stroke_dashoffset=other.stroke_dashoffset,
    )


def _blend_paint(a: _Paint, b: _Paint, t: float) -> tuple[_Paint, _Paint | None]:
    """The paint at time t, and what goes below it where two gradients are of different kinds."""
    if a.colour is None:
        return b._replace(opacity=t * b.opacity), None
    if b.colour is None:
        return a._replace(opacity=(1.0 - t) * a.opacity), None
    opacity = (1.0 - t) * a.opacity + t * b.opacity
    colour = blend_colours(a.colour, b.colour, t, a.opacity, b.opacity)
    if a.gradient == b.gradient:
        return _Paint(colour, opacity, a.gradient), None

    from shapeblend_cli.paint.gradients import all_of, blend_gradients  # few drawings have any

    if a.gradient is None:
        assert b.gradient is not None
        gradient = blend_gradients(all_of(b.gradient, a.colour), b.gradient, t)
    else:
        gradient = blend_gradients(a.gradient, b.gradient or all_of(a.gradient, b.colour), t)
    if gradient is not None:
        return _Paint(colour, opacity, gradient), None
    return b._replace(opacity=t * b.opacity), a._replace(opacity=_opacity_below(a, b, t))


def _opacity_below(a: _Paint, b: _Paint, t: float) -> float:
    """How opaque A's paint is when B's is painted over it with t times its opacity.

    Of what is below, 1 - t * (B's opacity) is seen, and that is to be (1 - t) * (A's opacity).
    """
    stops = b.gradient.stops if b.gradient else ()
    cover = b.opacity * min((stop.opacity for stop in stops), default=1.0)
    return a.opacity if cover == 1.0 else (1.0 - t) * a.opacity / (1.0 - t * cover)


def _blend_dashes(a: Style, b: Style, t: float) -> tuple[tuple[float, ...], float]:
    """The dashes at time t and where they begin; lists too long to be repeated to one length change at half time."""
    first, second = common_dashes(a.stroke_dasharray, b.stroke_dasharray)
    # A solid line looks the same wherever its dashes begin.
    start = a.stroke_dashoffset if a.stroke_dasharray else b.stroke_dashoffset
    end = b.stroke_dashoffset if b.stroke_dasharray else a.stroke_dashoffset
    if len(first) != len(second):
        return (first if t < 0.5 else second), (start if t < 0.5 else end)
    dashes = tuple((1.0 - t) * p + t * q for p, q in zip(first, second, strict=True))
    return dashes, (1.0 - t) * start + t * end


def common_dashes(a: tuple[float, ...], b: tuple[float, ...]) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """Two lists of dashes repeated until they are equally long.

    A solid line against a dashed one has dashes of the other's periods, with gaps of length 0 between them.

    Returns
    -------
    pair of tuple of float
        Both empty where both lines are solid; of different lengths where that would take more than `MOST_DASHES`.

    Examples
    --------
    >>> common_dashes((1, 2), (3,))
    ((1, 2), (3, 3))
    >>> common_dashes((), (4, 1))
    ((5, 0), (4, 1))
    """
    # Of an odd number, the second time round dashes and gaps have changed places.
    a, b = (dashes * (1 + len(dashes) % 2) for dashes in (a, b))
    if not a:
        return _without_gaps(b), b
    if not b:
        return a, _without_gaps(a)
    length = math.lcm(len(a), len(b))
    if length > MOST_DASHES:
        return a, b
    return a * (length // len(a)), b * (length // len(b))


def _without_gaps(dashes: tuple[float, ...]) -> tuple[float, ...]:
    return tuple(
        length
        for dash, gap in zip(dashes[::2], dashes[1::2], strict=True)
        for length in (dash + gap, 0 * gap)
    )


def keyed_styles(styles: Sequence[Style]) -> list[list[Style]] | None:
    """The paint of a shape at each of its keys, such that a browser can go from one to the next by itself.

    Parameters
    ----------
    styles : sequence of Style
        Two or more.

    Returns
    -------
    list of list of Style, or None
        A list of as many styles for every coat of paint, the lowest first: two, where one paint has to dissolve into
        another. None where more than two keys have no common form: with gradients, and with different dashes.
    """
    if len(styles) == 2:
        ends = [blend_styles(styles[0], styles[1], t) for t in (0.0, 1.0)]
        coats = [[above for above, _ in ends]]
        below = [under for _, under in ends if under is not None]
        return [below, *coats] if len(below) == 2 else coats
    if any(style.fill_gradient or style.stroke_gradient for style in styles):
        return None
    filled = [k for k, style in enumerate(styles) if style.fill is not None]
    stroked = [k for k, style in enumerate(styles) if style.stroke is not None]
    found = list(styles)
    for k in range(len(styles)):
        if filled and k not in filled:
            near = styles[min(filled, key=lambda other: abs(other - k))]
            found[k] = found[k]._replace(fill=near.fill, fill_opacity=0.0)
        if stroked and k not in stroked:
            near = styles[min(stroked, key=lambda other: abs(other - k))]
            found[k] = _with_stroke_of(found[k], near)._replace(stroke=near.stroke, stroke_opacity=0.0)
    return [found] if len({len(style.stroke_dasharray) for style in found}) == 1 else None
