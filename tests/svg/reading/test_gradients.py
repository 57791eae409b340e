"""Gradients as they are read, and frames that paint them, rendered by resvg."""

import io

import numpy as np
import pytest
import resvg_py
from PIL import Image

from shapeblend_cli.model import Box, LinearGradient, RadialGradient, Stop
from shapeblend_cli.options.settings import Settings
from shapeblend_cli.paint.oklab import blend_colours
from shapeblend_cli.svg.reading import painter
from shapeblend_cli.svg.reading.read import read
from shapeblend_cli.svg.writing.document import frame_svg
from tests.support.motions import blend
from tests.svg.reading.drawings import drawn, refused, svg

STOPS = '<stop stop-color="red"/><stop offset="1" stop-color="blue"/>'
USER_SPACE = 'gradientUnits="userSpaceOnUse"'
FADE = (Stop(0.0, "#ff0000"), Stop(1.0, "#0000ff"))
LINEAR = '<linearGradient id="g" {}>{}</linearGradient>'.format
RADIAL = '<radialGradient id="g" {}>{}</radialGradient>'.format
BOX = '<rect x="10" y="20" width="40" height="60" fill="url(#g)"/>'


def gradient(definition, shape=BOX, **options):
    drawing = drawn(f"<defs>{definition}</defs>{shape}", **options)
    assert drawing.notes == ()
    return drawing.shapes[-1].style.fill_gradient


def linear(attributes, stops=STOPS, **options):
    return gradient(LINEAR(attributes, stops), **options)


@pytest.mark.parametrize(
    ("attributes", "start", "end"),
    [
        ("", 10 + 20j, 50 + 20j),
        ('x2="0" y2="1"', 10 + 20j, 10 + 80j),
        ('x1="25%" x2=".5"', 20 + 20j, 30 + 20j),
        (f'{USER_SPACE} x1="1" y1="2" x2="3" y2="4"', 1 + 2j, 3 + 4j),
        (f'{USER_SPACE} x1="10%" x2="1in" y2="10%"', 20, 96 + 10j),
        (f'{USER_SPACE} x2="8" gradientTransform="translate(5 6) scale(2)"', 5 + 6j, 21 + 6j),
        # Lines of one colour run along the skewed y axis, the line (1, 1); the nearest of the last to the start.
        (f'{USER_SPACE} x2="8" gradientTransform="matrix(1 0 1 1 0 0)"', 0, 4 - 4j),
    ],
)
def test_a_linear_gradient_is_in_the_coordinates_of_the_drawing(attributes, start, end):
    found = linear(attributes, root='viewBox="0 0 200 100"')
    assert isinstance(found, LinearGradient)
    assert (found.start, found.end) == (pytest.approx(start), pytest.approx(end))
    assert found.stops == FADE


def test_transforms_of_the_shape_move_its_gradient():
    found = linear("", shape=f'<g transform="translate(5) scale(2)">{BOX}</g>')
    assert (found.start, found.end) == (25 + 40j, 105 + 40j)


def test_a_gradient_that_links_to_itself_is_read():
    assert linear('href="#g"').stops == FADE


def radial(attributes, shape=BOX):
    return gradient(RADIAL(attributes, STOPS), shape)


def test_a_radial_gradient_in_a_box_is_an_ellipse_with_the_longer_radius_first():
    found = radial('fx="0.75" spreadMethod="reflect"')
    assert isinstance(found, RadialGradient)
    assert (found.centre, found.spread) == (30 + 50j, "reflect")
    assert found.radii == pytest.approx((30, 20))
    assert (abs(found.angle), abs(found.focus)) == pytest.approx((90, 0.5))


def test_a_radial_gradient_that_is_a_circle_is_not_turned():
    found = radial(f'{USER_SPACE} cx="5" cy="6" r="2" fx="6" fr=".5" gradientTransform="rotate(90)"')
    assert (found.centre, found.focus) == (pytest.approx(-6 + 5j), pytest.approx(0.5j))
    assert (found.radii, found.angle, found.focal_radius) == (pytest.approx((2, 2)), 0.0, 0.25)


def test_attributes_and_stops_are_inherited_through_links():
    found = gradient(
        '<linearGradient id="g" href="#h" x2="0.5"/>'
        '<linearGradient id="h" xlink:href="#i" x1="0.25" x2="0.75" spreadMethod="repeat"/>'
        f'<radialGradient id="i" gradientTransform="scale(2)" cx="0">{STOPS}</radialGradient>'
    )
    assert (found.start, found.end, found.spread, found.stops) == (30 + 20j, 50 + 20j, "repeat", FADE)


def test_stops_are_read_with_all_css_says_of_them():
    stops = (
        '<stop offset="20%" style="stop-color:#0f0;stop-opacity:.5"/><stop offset="10%" stop-color="currentColor"/>'
        '<stop class="c" offset="2"/>'
    )
    shape = f'<style>.c {{ stop-color: #00f8 }}</style><g color="blue">{BOX}</g>'
    assert linear('color="red"', stops, shape=shape).stops == (
        Stop(0.2, "#00ff00", 0.5),
        Stop(0.2, "#ff0000", 1.0),
        Stop(1.0, "#0000ff", pytest.approx(0x88 / 255)),
    )


@pytest.mark.parametrize(
    ("definition", "colour", "opacity"),
    [
        (LINEAR("", '<stop stop-color="red" stop-opacity=".5"/>'), "#ff0000", 0.5),
        (LINEAR('x2="0"', STOPS), "#0000ff", 1.0),
        (RADIAL('r="0"', STOPS), "#0000ff", 1.0),
    ],
)
def test_a_gradient_of_one_colour_is_that_colour(definition, colour, opacity):
    drawing = drawn(definition + BOX)
    style = drawing.shapes[0].style
    assert (style.fill, style.fill_opacity, style.fill_gradient) == (colour, opacity, None)
    assert drawing.notes == ()


@pytest.mark.parametrize(
    ("definition", "shape"),
    [
        (LINEAR("", ""), BOX),
        (LINEAR("", STOPS), '<path d="M0 0H9" stroke="url(#g)" fill="none"/>'),
        (LINEAR('gradientTransform="scale(0)"', STOPS), BOX),
        (LINEAR('x2="1e-300" gradientTransform="scale(1e-100)"', STOPS), BOX),
        (LINEAR('x2="9e8" gradientTransform="scale(9e8)"', STOPS), BOX),
        (RADIAL('r="1e-300" fx="9e8"', STOPS), BOX),
        ('<linearGradient id="g" href="#h"/><linearGradient id="h" href="#g"/>', BOX),
    ],
)
def test_a_gradient_that_paints_nothing_is_read_as_a_plain_colour(definition, shape):
    drawing = drawn(definition + shape)
    style = drawing.shapes[0].style
    assert style.fill or style.stroke
    assert style.fill_gradient is style.stroke_gradient is None
    assert drawing.notes == ("a gradient or pattern read as a plain colour",)


def test_gradients_of_very_many_stops_are_refused(monkeypatch):
    monkeypatch.setattr(painter, "MAX_STOPS", 2000)
    stops = (
        '<linearGradient id="{0}">{1}</linearGradient><rect width="1" height="1" fill="url(#{0})"/>'.format
    )
    refused(stops("g", "<stop/>" * 1001) + stops("h", "<stop/>" * 1000), "more than 2000 stops of gradients")
    assert len(drawn(stops("g", "<stop/>" * 1000) * 3).shapes) == 3  # the first alone counts


def pixels(text):
    png = resvg_py.svg_to_bytes(svg_string=text, width=100, height=100, background="white")
    return np.asarray(Image.open(io.BytesIO(bytes(png))).convert("RGB")).astype(int)


def frames(a, b, *, at_least=3):
    drawings = [read(name, svg(markup)) for name, markup in (("a.svg", a), ("b.svg", b))]
    _, found = blend(*drawings, Settings(frames=at_least, ends=True, place="asis"))
    return [pixels(frame_svg(frame._replace(view=Box(0, 0, 100, 100)), 3)) for frame in found]


RECT = '<rect x="10" y="10" width="80" height="80" fill="url(#g)"/>'
DEFINITIONS = {
    "linear": LINEAR('y2="1"', STOPS),
    "linear, three stops": LINEAR(
        'x1="1" x2="0"',
        '<stop stop-color="lime"/><stop offset=".3" stop-color="navy"/><stop offset=".8" stop-color="gold"/>',
    ),
    "hard": LINEAR("", '<stop offset=".4" stop-color="red"/><stop offset=".4"/>'),
    "transparent": LINEAR("", '<stop stop-opacity="0"/><stop offset=".9" stop-color="#fc0"/>'),
    "repeated": LINEAR('x2=".25" y2=".1" spreadMethod="repeat"', STOPS),
    "skewed": LINEAR(f'{USER_SPACE} x1="10" x2="70" gradientTransform="skewX(30) rotate(20)"', STOPS),
    "radial": RADIAL("", STOPS),
    "radial, off centre": RADIAL('cx=".4" r=".6" fx=".2" fy=".3" fr=".1"', STOPS),
    "ellipse": RADIAL(
        f'{USER_SPACE} spreadMethod="reflect" cx="30" cy="40" r="20" fx="38" '
        'gradientTransform="rotate(-20) scale(1.6 1)"',
        STOPS,
    ),
    "mirrored ellipse": RADIAL(
        f'{USER_SPACE} cx="-30" cy="30" r="30" fx="-40" fy="45" gradientTransform="matrix(-1.5 .4 .3 1.1 0 0)"',
        STOPS,
    ),
    "plain": LINEAR("", '<stop stop-color="teal" stop-opacity=".8"/>'),
}
PAINTED = {name: f"<defs>{definition}</defs>{RECT}" for name, definition in DEFINITIONS.items()}


@pytest.mark.parametrize("name", PAINTED)
@pytest.mark.parametrize("other", ["linear", "ellipse", "plain"])
def test_first_and_last_frame_look_like_the_files(name, other):
    for first, last in ((name, other), (other, name)):
        found = frames(PAINTED[first], PAINTED[last], at_least=1)
        for frame, file in ((found[0], first), (found[-1], last)):
            difference = np.abs(frame - pixels(svg(PAINTED[file]).decode()))
            # Where a colour changes abruptly, a pixel may go to the other side.
            assert np.mean(difference > 4) < 0.002, file


def test_linear_gradients_halfway_look_halfway():
    a = f"<defs>{LINEAR('', STOPS)}</defs>{RECT}"
    b = a.replace("red", "lime").replace("blue", "lime")
    middle = frames(a, b)[2]
    for colour, x in (("#ff0000", 10), ("#0000ff", 89)):
        expected = bytes.fromhex(blend_colours(colour, "#00ff00", 0.5)[1:])
        assert middle[50, x] == pytest.approx(list(expected), abs=4)


def test_between_a_linear_and_a_radial_gradient_nothing_shines_through():
    on_green = '<rect width="100" height="100" fill="lime"/>'
    found = frames(on_green + PAINTED["linear"], on_green + PAINTED["radial"])
    for k, frame in enumerate(found):
        expected = (1 - k / 4) * found[0] + k / 4 * found[-1]
        # Red and blue alone: no green from below.
        assert frame[20:80, 20:80, 1].max() <= 2
        assert np.abs(frame - expected).max() <= 4


def test_documents_define_each_gradient_once_under_names_that_do_not_change():
    drawing = read("a.svg", svg(PAINTED["linear"] + PAINTED["linear"].replace('x="10"', 'x="40"')))
    _, found = blend(drawing, drawing, Settings(frames=1))
    texts = [frame_svg(found[0]._replace(view=Box(0, 0, 100, 100)), 3) for _ in range(2)]
    assert texts[0] == texts[1]
    assert texts[0].count("<linearGradient") == 2
    assert 'fill="url(#gradient-1)"' in texts[0]
    assert "gradient-3" not in texts[0]
