"""Colours between two colours, in OKLab and premultiplied, as in CSS Color 4, but less dull.

https://www.w3.org/TR/css-color-4/#interpolation

Half way between colours of different hues OKLab has a grey, brown or olive, and people see mud. OKLCh keeps the chroma,
but passes through all hues between: a rainbow. A part of the way from the former to the latter is neither.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Sequence
from functools import cache
from itertools import pairwise

from shapeblend_cli.model import PAGE_COLOUR

TOLERANCE = 0.02
"""Maximum difference of colours that look alike, in delta E OK."""

STEPS = 3
"""Maximum difference of colours that look alike all the same, in 255ths of each channel: near black these are up to a
delta E OK of 0.07."""

VIVIDNESS = (1.0 / 3.0, 2.0 / 3.0)
"""Shares of the way from colours in OKLab to colours in OKLCh, where one of both ends is pale, and where none is."""

PALE = (0.05, 0.11)
"""Chromas of a pale colour, and of one that is not: between pale colours another hue is seen as foreign."""

_MOST_GAPS = 16
_PROBES = 8

# The matrices of CSS Color 4. Importing coloraide for them would take longer than many a blend.
_RGB_TO_XYZ = (
    (0.4123907992659593, 0.357584339383878, 0.1804807884018343),
    (0.21263900587151024, 0.715168678767756, 0.07219231536073371),
    (0.01933081871559182, 0.11919477979462598, 0.9505321522496607),
)
_XYZ_TO_LMS = (
    (0.819022437996703, 0.3619062600528904, -0.1288737815209879),
    (0.03298365393238847, 0.9292868615863434, 0.03614466635064236),
    (0.04817718935962421, 0.2642395317527308, 0.6335478284694309),
)
_ROOTS_TO_LAB = (
    (0.21045426830931396, 0.7936177747023053, -0.0040720430116192585),
    (1.9779985324311686, -2.42859224204858, 0.450593709617411),
    (0.025904042465547734, 0.7827717124575297, -0.8086757549230774),
)
_LAB_TO_ROOTS = (
    (1.0, 0.3963377773761749, 0.21580375730991364),
    (1.0, -0.10556134581565857, -0.0638541728258133),
    (1.0, -0.08948417752981186, -1.2914855480194092),
)
_LMS_TO_XYZ = (
    (1.226879875845924, -0.5578149944602171, 0.2813910456659647),
    (-0.04057574521480083, 1.112286803280317, -0.07171105806551635),
    (-0.07637293667466008, -0.42149333240224324, 1.5869240198367818),
)
_XYZ_TO_RGB = (
    (3.240969941904523, -1.5373831775700941, -0.4986107602930035),
    (-0.9692436362808797, 1.8759675015077204, 0.04155505740717562),
    (0.05563007969699365, -0.20397695888897652, 1.0569715142428784),
)


def blend_colours(a: str, b: str, t: float, opacity_a: float = 1.0, opacity_b: float = 1.0) -> str:
    """Return the colour ``#rrggbb`` at time t, clipped to sRGB; between two greys a grey. `PAGE_COLOUR` stays alone.

    Colours weigh by their opacities: an invisible colour has no weight, not even at its own end.
    """
    share = _share_of_b(t, opacity_a, opacity_b)
    if a == b or share == 0.0:
        return a
    if share == 1.0:
        return b
    a, b = _seen(a), _seen(b)
    roots = _product(_LAB_TO_ROOTS, _mixed(_oklab(a), _oklab(b), share))
    xyz = _product(_LMS_TO_XYZ, [root**3 for root in roots])
    channels = [_encoded(value) for value in _product(_XYZ_TO_RGB, xyz)]
    if _is_grey(a) and _is_grey(b):
        # The matrices leave a trace of colour, which rounding could make visible.
        channels = [channels[1]] * 3
    return "#" + bytes(round(255.0 * min(max(channel, 0.0), 1.0)) for channel in channels).hex()


def _mixed(a: tuple[float, ...], b: tuple[float, ...], share: float) -> list[float]:
    """Return a mixture of two colours in OKLab, with a share of b, whose hue turns a little."""
    lightness = (1.0 - share) * a[0] + share * b[0]
    p, q = complex(*a[1:]), complex(*b[1:])
    mixed = (1.0 - share) * p + share * q
    low, high = sorted((abs(p), abs(q)))
    if low > 0.0:
        chroma = (1.0 - share) * abs(p) + share * abs(q)
        turned = cmath.rect(chroma, cmath.phase(p) + share * cmath.phase(q / p))
        strength = min(max((low - PALE[0]) / (PALE[1] - PALE[0]), 0.0), 1.0)
        vividness = VIVIDNESS[0] + strength * (VIVIDNESS[1] - VIVIDNESS[0])
        # The hue of a colour that is nearly grey means little.
        mixed += vividness * min(1.0, 2.0 * low / high) * (turned - mixed)
    return [lightness, mixed.real, mixed.imag]


def blend_in_srgb(a: str, b: str, t: float) -> str:
    """Return the colour at time t as SVG interpolates between two stops: each channel by itself."""
    if a == b:
        return a
    pairs = zip(bytes.fromhex(_seen(a)[1:]), bytes.fromhex(_seen(b)[1:]), strict=True)
    return "#" + bytes(round((1.0 - t) * p + t * q) for p, q in pairs).hex()


def _seen(colour: str) -> str:
    """Return what is seen of a colour where there is no page."""
    return "#000000" if colour == PAGE_COLOUR else colour


def colour_stops(a: str, b: str) -> list[str]:
    """Return two colours or more at even times, between which each channel may be interpolated by itself.

    SMIL and CSS do that, and so deviate from OKLab; the number of colours is the least that keeps to `TOLERANCE`.

    Examples
    --------
    >>> colour_stops("#336699", "#336699")
    ['#336699', '#336699']
    """
    for gaps in range(1, _MOST_GAPS + 1):
        stops = [blend_colours(a, b, k / gaps) for k in range(gaps + 1)]
        if gaps == _MOST_GAPS or len(set(stops)) == 1:
            break
        if all(
            _is_near(blend_in_srgb(p, q, k / _PROBES), blend_colours(a, b, (gap + k / _PROBES) / gaps))
            for gap, (p, q) in enumerate(pairwise(stops))
            for k in range(1, _PROBES)
        ):
            break
    return stops


def _share_of_b(t: float, opacity_a: float, opacity_b: float) -> float:
    """Return the weight of B's colour; A's has the rest."""
    if opacity_a == opacity_b:
        return t
    if opacity_a == 0.0 or opacity_b == 0.0:
        return float(opacity_a == 0.0)
    return t * opacity_b / ((1.0 - t) * opacity_a + t * opacity_b)


def _is_near(a: str, b: str) -> bool:
    steps = max(abs(p - q) for p, q in zip(bytes.fromhex(a[1:]), bytes.fromhex(b[1:]), strict=True))
    return steps <= STEPS or difference(a, b) <= TOLERANCE


def difference(a: str, b: str, lightness: float = 1.0) -> float:
    """Return the difference of two colours in OKLab, with a weight of lightness: delta E OK if that is 1."""
    p, q = _oklab(_seen(a)), _oklab(_seen(b))
    return math.dist((lightness * p[0], *p[1:]), (lightness * q[0], *q[1:]))


def lightness(colour: str) -> float:
    """Return the lightness of a colour in OKLab, from 0 to 1."""
    return _oklab(_seen(colour))[0]


def _is_grey(colour: str) -> bool:
    return colour[1:3] == colour[3:5] == colour[5:7]


@cache
def _oklab(colour: str) -> tuple[float, ...]:
    light = [_decoded(value / 255.0) for value in bytes.fromhex(colour[1:])]
    lms = _product(_XYZ_TO_LMS, _product(_RGB_TO_XYZ, light))
    return tuple(_product(_ROOTS_TO_LAB, [value ** (1.0 / 3.0) for value in lms]))


def _product(matrix: Sequence[Sequence[float]], vector: Sequence[float]) -> list[float]:
    x, y, z = vector
    return [p * x + q * y + r * z for p, q, r in matrix]


def _decoded(channel: float) -> float:
    """Return the light of a channel of sRGB."""
    return ((channel + 0.055) / 1.055) ** 2.4 if channel > 0.04045 else channel / 12.92


def _encoded(light: float) -> float:
    """Return the channel of sRGB for light; less than 0 for less than none."""
    return 1.055 * light ** (1.0 / 2.4) - 0.055 if light > 0.0031308 else 12.92 * light
