"""Colours between two colours, in OKLab and premultiplied, as in CSS Color 4, but less dull.

https://www.w3.org/TR/css-color-4/#interpolation

Half way between colours of different hues OKLab has a grey, brown or olive, and people see mud. OKLCh keeps the chroma,
but passes through all hues between: a rainbow. A third of the way from the former to the latter is neither.
"""

from __future__ import annotations

import cmath
import importlib.util
import math
import sys
from contextlib import contextmanager
from functools import cache
from itertools import pairwise
from types import ModuleType
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coloraide.spaces.oklab import Oklab
    from coloraide.spaces.srgb import sRGB
    from coloraide.spaces.srgb_linear import sRGBLinear

TOLERANCE = 0.02
"""Maximum difference of colours that look alike, in delta E OK."""

STEPS = 3
"""Maximum difference of colours that look alike all the same, in 255ths of each channel: near black these are up to a
delta E OK of 0.07."""

VIVIDNESS = 1.0 / 3.0
"""Share of the way from colours in OKLab to colours in OKLCh."""

_MOST_GAPS = 16
_PROBES = 8


def blend_colours(a: str, b: str, t: float, opacity_a: float = 1.0, opacity_b: float = 1.0) -> str:
    """Return the colour ``#rrggbb`` at time t, clipped to sRGB; between two greys a grey.

    Colours weigh by their opacities: an invisible colour has no weight, not even at its own end.
    """
    share = _share_of_b(t, opacity_a, opacity_b)
    if a == b or share == 0.0:
        return a
    if share == 1.0:
        return b
    srgb, linear, oklab = _spaces()
    channels = srgb.from_base(linear.from_base(oklab.to_base(_mixed(_oklab(a), _oklab(b), share))))
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
        # The hue of a colour that is nearly grey means little.
        mixed += VIVIDNESS * min(1.0, 2.0 * low / high) * (turned - mixed)
    return [lightness, mixed.real, mixed.imag]


def blend_in_srgb(a: str, b: str, t: float) -> str:
    """Return the colour at time t as SVG interpolates between two stops: each channel by itself."""
    pairs = zip(bytes.fromhex(a[1:]), bytes.fromhex(b[1:]), strict=True)
    return "#" + bytes(round((1.0 - t) * p + t * q) for p, q in pairs).hex()


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
    return steps <= STEPS or math.dist(_oklab(a), _oklab(b)) <= TOLERANCE


def _is_grey(colour: str) -> bool:
    return colour[1:3] == colour[3:5] == colour[5:7]


@cache
def _oklab(colour: str) -> tuple[float, ...]:
    srgb, linear, oklab = _spaces()
    channels = [v / 255.0 for v in bytes.fromhex(colour[1:])]
    return tuple(oklab.from_base(linear.to_base(srgb.to_base(channels))))


@cache
def _spaces() -> tuple[sRGB, sRGBLinear, Oklab]:
    with _without_package():
        from coloraide.spaces.oklab import Oklab
        from coloraide.spaces.srgb import sRGB
        from coloraide.spaces.srgb_linear import sRGBLinear
    return sRGB(), sRGBLinear(), Oklab()


@contextmanager
def _without_package() -> Iterator[None]:
    """Import modules of coloraide without its own ``__init__``.

    That imports every colour space, which takes 70 ms; the three needed here take 8. Meanwhile an empty package
    stands in for it, so that a later import of coloraide gets the real one.
    """
    name = "coloraide"
    spec = None if name in sys.modules else importlib.util.find_spec(name)
    if spec is None or spec.submodule_search_locations is None:
        yield
        return
    package = ModuleType(name)
    package.__path__ = list(spec.submodule_search_locations)
    sys.modules[name] = package
    try:
        yield
    finally:
        for module in [m for m in sys.modules if m == name or m.startswith(f"{name}.")]:
            del sys.modules[module]
