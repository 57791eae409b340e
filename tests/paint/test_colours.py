"""Colours in OKLab, checked with coloraide."""

import re

import numpy as np
import pytest
from coloraide import Color
from hypothesis import given
from hypothesis import strategies as st

from shapeblend_cli.paint.oklab import (
    PALE,
    STEPS,
    TOLERANCE,
    VIVIDNESS,
    blend_colours,
    blend_in_srgb,
    colour_stops,
)

colours = st.integers(0, 0xFFFFFF).map("#{:06x}".format)
greys = st.integers(0, 0xFF).map(lambda v: f"#{v:02x}{v:02x}{v:02x}")
times = st.floats(0, 1)
opacities = st.floats(0, 1)


def channels(colour):
    return list(bytes.fromhex(colour[1:]))


def less_dull(a, b, t):
    """What coloraide mixes in OKLab, and a part of the way from there to what it mixes in OKLCh."""
    chroma = sorted(Color(colour).convert("oklch")["chroma"] for colour in (a, b))
    most = np.interp(chroma[0], PALE, VIVIDNESS)
    share = min(1.0, 2.0 * chroma[0] / chroma[1]) * most if chroma[0] > 1e-4 else 0.0
    dull, vivid = (Color(a).mix(b, t, space=space).convert("oklab") for space in ("oklab", "oklch"))
    return dull.mix(vivid, share, space="oklab").convert("srgb").clip()


def test_halfway_between_red_and_blue():
    # CSS's color-mix(in oklab, red, blue) is #8c53a2: https://facelessuser.github.io/coloraide/interpolation/
    assert blend_colours("#ff0000", "#0000ff", 0.5) == "#ac1eb7"
    assert blend_in_srgb("#ff0000", "#0000ff", 0.5) == "#800080"


@given(colours, colours, times)
def test_it_is_between_what_coloraide_mixes_in_oklab_and_in_oklch(a, b, t):
    expected = [255 * value for value in less_dull(a, b, t).coords()]
    hues = [Color(colour).convert("oklch")["hue"] for colour in (a, b)]
    if abs(abs(hues[0] - hues[1]) - 180) > 0.1:  # else the hue may turn either way
        assert channels(blend_colours(a, b, t)) == pytest.approx(expected, abs=0.6)
    assert (blend_colours(a, b, 0.0), blend_colours(a, b, 1.0)) == (a, b)


@given(greys, greys, times)
def test_grey_stays_grey(a, b, t):
    red, green, blue = channels(blend_colours(a, b, t))
    assert red == green == blue


@given(colours, colours, times, opacities, opacities)
def test_it_is_a_colour_of_srgb(a, b, t, opacity_a, opacity_b):
    assert re.fullmatch("#[0-9a-f]{6}", blend_colours(a, b, t, opacity_a, opacity_b))


def test_what_is_less_opaque_has_less_say():
    # Premultiplied: half of 1 and half of 0.25 are in the ratio of 4 to 1.
    assert blend_colours("#ff0000", "#0000ff", 0.5, 1.0, 0.25) == blend_colours("#ff0000", "#0000ff", 0.2)
    for t in (0.0, 0.5, 1.0):
        assert blend_colours("#ff0000", "#0000ff", t, 0.0, 1.0) == "#0000ff"
        assert blend_colours("#ff0000", "#0000ff", t, 0.3, 0.0) == "#ff0000"
    assert blend_colours("#ff0000", "#0000ff", 0.5, 0.0, 0.0) == blend_colours("#ff0000", "#0000ff", 0.5)


@given(colours, colours)
def test_straight_from_stop_to_stop_nobody_sees_the_difference(a, b):
    stops = colour_stops(a, b)
    gaps = len(stops) - 1
    assert gaps < 16  # as many as there may be
    for k in range(8 * gaps + 1):
        t = k / 8 / gaps
        gap = min(int(t * gaps), gaps - 1)
        shown = blend_in_srgb(stops[gap], stops[gap + 1], t * gaps - gap)
        meant = blend_colours(a, b, t)
        steps = max(abs(p - q) for p, q in zip(channels(shown), channels(meant), strict=True))
        assert Color(shown).delta_e(meant, method="ok") <= TOLERANCE + 1e-9 or steps <= STEPS


@pytest.mark.parametrize(
    ("a", "b", "number"),
    [
        ("#123456", "#123456", 2),
        ("#102030", "#405060", 2),
        ("#ff0000", "#0000ff", 7),
        ("#000000", "#ffffff", 9),
    ],
)
def test_there_are_no_more_stops_than_it_takes(a, b, number):
    stops = colour_stops(a, b)
    assert (stops[0], stops[-1], len(stops)) == (a, b, number)
