"""Lengths, colours and transforms by themselves."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from shapeblend_cli.svg.styles import css_colours as colours
from shapeblend_cli.svg.xml import transforms, units

UNREADABLE = {
    units.length: "|x|1 px x|1..2|nan|inf|1e999|1e9|1foo|--1|1%|1_0|calc(1px)",
    colours.parse: f"|oops|#12|#ggg|rgb(|rgb(1,2)|url(|red blue|((((|\0|{'#' * 2000}"
    "|light-dark(red)|light-dark(oops, red)",
    transforms.parse: "rotate|rotate(|rotate()|rotate(1 2)|scale(1,,2)|scale(,1)|foo(1)|matrix(1 2 3)|scale(1) x"
    "|translate(1e999)|rotate(1deg)|scale(1),",
    lambda text: transforms.parse(
        text, units.Lengths(1, 1)
    ): "rotate(1)|translate(1)|rotate(1deg 2deg 3deg)|translateX(1px, 2px)|scale(1px)",
}


@pytest.mark.parametrize(
    ("parse", "text"), [(f, t) for f, texts in UNREADABLE.items() for t in texts.split("|")]
)
def test_what_cannot_be_read_is_nothing(parse, text):
    assert parse(text) is None


@pytest.mark.parametrize(
    ("text", "value"), [("1", 1), (" -.5e1PX ", -5), ("1 in", 96), ("1e2", 100), ("2em", 32)]
)
def test_lengths(text, value):
    assert units.length(text) == value


@given(st.floats(-1e8, 1e8), st.sampled_from(["{!r}", "{:.17e}", "{:+.20f}"]))
def test_a_number_round_trips(value, template):
    text = template.format(value)
    assert units.length(text) == float(text)
    assert units.numbers(f" {text},{text} ") == [float(text)] * 2


COLOURS = {
    "red": "#ff0000",
    "RebeccaPurple": "#663399",
    "#F0a": "#ff00aa",
    "#12345678": "#123456",
    "rgb(1, 2, 300)": "#0102ff",
    "rgb(10%,20%,30%)": "#1a334d",
    "rgb(1 2 3 / 50%)": "#010203",
    "rgba(1,2,3,.5)": "#010203",
    "hsl(120, 100%, 50%)": "#00ff00",
    "hwb(0 50% 0%)": "#ff8080",
    "color(srgb-linear 1 0 0)": "#ff0000",
    "color(display-p3 0 0 0)": "#000000",
    "color(rec2020 0 0 0)": "#000000",
    "color(a98-rgb 1 1 1)": "#ffffff",
    "lab(54.29% 80.81 69.89)": "#ff0000",
    "oklch(0.628 0.2577 29.23)": "#ff0000",
    "light-dark(#ffffff, var(--dark, #121212))": "#ffffff",
    "Light-Dark( rgb(1, 2, 3) , hsl(1 2% 3%) )": "#010203",
    "#CD853F icc-color(acmecmyk, 0.1, 0.3)": "#cd853f",
}


@pytest.mark.parametrize(("text", "rgb"), COLOURS.items(), ids=COLOURS)
def test_colours(text, rgb):
    colour = colours.parse_colour(text)
    channels = [[int(value[k : k + 2], 16) for k in (1, 3, 5)] for value in (colour.rgb, rgb)]
    # Conversions from other spaces round differently.
    assert np.abs(np.subtract(*channels)).max() <= (1 if "l" in text else 0)


@pytest.mark.parametrize(
    ("text", "alpha"), [("#0008", 8 / 15), ("#00000033", 0.2), ("transparent", 0), ("rgb(0 0 0/.3)", 0.3)]
)
def test_how_opaque_a_colour_is(text, alpha):
    assert colours.parse_colour(text).alpha == pytest.approx(alpha)


def test_paint_servers():
    assert colours.parse("url(#a)") == colours.Paint("server", link="#a")
    assert colours.parse("url( '#a' ) none").fallback == colours.NONE


small = st.floats(-9, 9)
maps = st.builds(transforms.Affine, small, small, small, small, small, small)
points = st.complex_numbers(max_magnitude=99).map(lambda point: np.array([point]))


@given(maps, maps, points)
def test_a_product_applies_its_second_factor_first(m, n, point):
    assert np.allclose((m @ n).points(point), m.points(n.points(point)))


@given(maps, points)
def test_an_affine_map_is_the_matrix_of_the_specification(m, point):
    (x,), (y,) = point.real, point.imag
    expected = complex(m.a * x + m.c * y + m.e, m.b * x + m.d * y + m.f)
    assert np.allclose(m.points(point), expected)
