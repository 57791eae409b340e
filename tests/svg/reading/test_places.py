"""Where shapes end up: sizes, units, transforms, viewports, use. The boxes are Chromium's."""

import numpy as np
import pytest

from tests.svg.reading.drawings import RECT, boxes, drawn, length, table

SHAPES = table("""
rect | <rect x="1" y="2" width="3" height="4"/> | 1 2 4 6 | 14
rect with round corners | <rect width="20" height="10" rx="5"/> | 0 0 20 10 | 51.4159265
auto radius is the other one | <rect width="20" height="10" ry="5"/> | 0 0 20 10 | 51.4159265
radii are at most half a side | <rect width="20" height="10" rx="50" ry="5"/> | 0 0 20 10 | 48.4422
one radius of 0 is no radius | <rect width="20" height="10" rx="5" ry="0"/> | 0 0 20 10 | 60
circle | <circle cx="5" cy="5" r="5"/> | 0 0 10 10 | 31.4159265
ellipse | <ellipse cx="5" cy="5" rx="5" ry="2"/> | 0 3 10 7 | 23.0131
ellipse with one radius | <ellipse cx="5" cy="5" ry="5"/> | 0 0 10 10 | 31.4159265
line | <line x1="1" x2="4" y2="4" stroke="red"/> | 1 0 4 4 | 5
polyline | <polyline points="0,0 3-4,6 0"/> | 0 -4 6 0 | 10
polygon | <polygon points="0 0 3 4 0 4"/> | 0 0 3 4 | 12
path | <path d="M1 1h2v2z"/> | 1 1 3 3 | 6.82842712
path as a property | <path style="d: path('M1 1h2v2z')"/> | 1 1 3 3 | 6.82842712
sizes as properties | <rect style="width: 3px; height: 4px"/> | 0 0 3 4 | 14
""")


@pytest.mark.parametrize("name", SHAPES)
def test_shape_has_the_outline_the_specification_gives_it(name):
    markup, box, total = SHAPES[name]
    drawing = drawn(markup)
    assert boxes(drawing) == [[float(value) for value in box.split()]]
    assert length(drawing) == pytest.approx(float(total), rel=1e-5)


PLACES = table("""
inches | <rect width="1in" height="10"/> | 0 0 96 10
millimetres | <rect width="25.4mm" height="2.54cm"/> | 0 0 96 96
points and picas | <rect width="3pt" height="1pc"/> | 0 0 4 16
quarter millimetres | <rect width="101.6Q" height="1"/> | 0 0 96 1
em | <g font-size="10"><rect width="2em" height="1rem" style="font-size:200%"/></g> | 0 0 40 16
percentages of the viewBox | <rect width="50%" height="50%"/> | 0 0 40 20 | viewBox="-9 -9 80 40"
percentages of the size | <rect width="50%" height="50%"/> | 0 0 40 20 | width="80" height="40"
percentage of the diagonal | <circle r="10%"/> | -5 -5 5 5 | viewBox="0 0 70 10"
translate and scale | <rect width="1" height="2" transform="translate(5) scale(2 3)"/> | 5 0 7 6
rotate about a point | <rect width="4" height="2" transform="rotate(90,4,0)"/> | 2 -4 4 0
matrix | <rect width="1" height="1" transform="matrix(1 0 1 1 5 6)"/> | 5 6 7 7
skew | <rect width="1" height="1" transform="skewX(45)skewY(0)"/> | 0 0 2 1
groups around it | <g transform="scale(2)"><a transform="translate(1)"><rect width="1" height="1"/></a></g> | 2 0 4 2
property | <rect width="4" height="2" style="transform: translate(50%, 1px) rotate(0.25turn)"/> | 8 1 10 5 | \
viewBox="0 0 20 20"
property beats attribute | <rect width="1" height="1" transform="scale(9)" style="transform: none"/> | 0 0 1 1
single properties | <rect width="4" height="2" style="translate: 1px 2px; rotate: 90deg; scale: 2"/> | -3 2 1 10
single properties for none | <g transform="translate(5 5)" style="rotate: none; scale: initial"> \
<rect width="4" height="2"/></g> | 5 5 9 7
origin | <rect width="4" height="2" transform="rotate(90)" transform-origin="4 0"/> | 2 -4 4 0
origin in words | <rect width="4" height="2" style="transform: scale(2); transform-origin: right 1px"/> | \
-4 -1 4 3 | viewBox="0 0 4 4"
origin in its box | <rect x="10" y="20" width="4" height="2" style="transform: scale(2); transform-box: fill-box; \
transform-origin: center"/> | 8 19 16 23
corner of its box | <rect x="10" y="20" width="4" height="2" transform="scale(2)" style="transform-box: fill-box"/> | \
10 20 18 24
shares of its box | <circle r="2" style="transform: translate(50%, 25%); transform-box: content-box"/> | 0 -1 4 3
translate in space | <rect width="4" height="2" style="transform: translate3d(1px, 2px, 3px) translateZ(0)"/> | 1 2 5 4
scale in space | <rect width="4" height="2" style="transform: scale3d(2, 3, 4) scaleZ(2)"/> | 0 0 8 6
turned in space | <rect width="4" height="2" style="transform: rotateZ(90deg) rotateY(180deg)"/> | -2 -4 0 0
turned up | <rect width="4" height="2" style="transform: perspective(9px) rotateX(60deg)"/> | 0 0 4 1
turned about an axis | <rect width="4" height="2" style="transform: rotate3d(1, 1, 0, 180deg)"/> | 0 0 2 4
matrix in space | <rect width="4" height="2" style="transform: matrix3d(2,0,0,0, 0,3,0,0, 0,0,1,0, 5,6,7,1)"/> | \
5 6 13 12
space is for properties | <rect width="4" height="2" transform="translate3d(1, 2, 3)"/> | 0 0 4 2
units are no attribute | <rect width="4" height="2" transform="rotate(90deg)"/> | 0 0 4 2
no units are no property | <rect width="4" height="2" style="transform: rotate(90)"/> | 0 0 4 2
root turned about its middle | <rect width="4" height="2"/> | 36 18 40 20 | viewBox="0 0 40 20" transform="rotate(180)"
root moved in pixels | <rect width="4" height="2"/> | 4 2 8 4\
 | viewBox="0 0 40 20" width="80" style="transform:translate(10%,4px)"
nested viewport | <svg x="10%" y="1" width="50%" height="20" viewBox="0 0 10 10"><rect width="10" height="5"/></svg>\
 | 4 1 24 11 | viewBox="0 0 40 40"
viewport without a viewBox | <svg x="1" width="40" height="20"><rect width="50%" height="50%"/></svg> | 1 0 21 10
viewport to the right | <svg width="40" height="20" viewBox="5 5 10 10" preserveAspectRatio="xMaxYMin">\
<rect x="5" y="5" width="10" height="10"/></svg> | 20 0 40 20
viewport sliced | <svg width="40" height="20" viewBox="0 0 10 10" preserveAspectRatio="xMidYMax slice">\
<rect width="10" height="10"/></svg> | 0 -20 40 20
viewport stretched | <svg width="40" height="20" viewBox="0 0 10 10" preserveAspectRatio="none">\
<rect width="10" height="10"/></svg> | 0 0 40 20
use | <defs><rect id="r" width="3" height="4"/></defs><use href="#r" x="1" y="2" transform="scale(2)"/> | 2 4 8 12
use of a symbol | <symbol id="s" viewBox="0 0 10 10"><rect width="10" height="5"/></symbol>\
<use xlink:href="#s" x="10" y="20" width="40" height="20"/> | 20 20 40 30
use of a whole viewport | <symbol id="s" viewBox="0 0 10 10"><rect width="10" height="5"/></symbol><use href="#s"/>\
 | 0 0 40 20 | viewBox="0 0 40 40"
use sizes an svg | <defs><svg id="s" x="3" width="1" height="1" viewBox="0 0 5 5"><rect width="5" height="5"/></svg>\
</defs><use href="#s" x="20" width="30" height="30"/> | 23 0 53 30
""")


@pytest.mark.parametrize("name", PLACES)
def test_shape_lies_where_browsers_put_it(name):
    markup, box, *root = PLACES[name]
    assert boxes(drawn(markup, *root)) == [[float(value) for value in box.split()]]


def test_the_roots_viewport_does_not_move_anything():
    root = 'viewBox="5 5 10 10" width="300mm" height="10%" preserveAspectRatio="none"'
    assert boxes(drawn('<rect width="1" height="1"/>', root)) == [[0, 0, 1, 1]]


@pytest.mark.parametrize(
    ("root", "viewbox"),
    [
        ('viewBox="1,2 3 4" width="9"', (1, 2, 3, 4)),
        ('width="1in" height="50"', (0, 0, 96, 50)),
        ('width="100%" height="50"', None),
        ("", None),
    ],
)
def test_viewbox_is_the_roots_or_its_size(root, viewbox):
    assert drawn('<rect width="1" height="1"/>', root).viewbox == viewbox


@pytest.mark.parametrize("text", ["0 0 10", "0 0 10 0", "0 0 -1 5", "0 0 1 x", "nan 0 1 1", "0 0 1e999 1"])
def test_an_invalid_viewbox_is_ignored_with_a_note(text):
    drawing = drawn('<rect width="50%" height="1"/>', f'viewBox="{text}" width="20" height="20"')
    assert drawing.viewbox == (0, 0, 20, 20)
    assert boxes(drawing) == [[0, 0, 10, 1]]
    assert "an invalid viewBox ignored" in drawing.notes


@pytest.mark.parametrize(
    ("markup", "width"),
    [
        ('<g transform="scale(2 8)"><path d="M0 0h1" stroke="red" stroke-width="3"/></g>', pytest.approx(12)),
        ('<path transform="scale(4)" d="M0 0h1" stroke="red" vector-effect="non-scaling-stroke"/>', 1),
    ],
)
def test_stroke_width_is_in_root_units_unless_it_does_not_scale(markup, width):
    assert drawn(markup).shapes[0].style.stroke_width == width


@pytest.mark.parametrize(
    ("root", "width"),
    [
        ('viewBox="0 0 24 24"', 3),
        ('viewBox="0 0 24 24" width="100%" height="100%"', 3),
        ('width="240" height="240"', 3),
        ('viewBox="0 0 24 24" width="240" height="240"', 0.3),
        ('viewBox="0 0 24 24" height="1in"', 0.75),
        ('viewBox="0 0 24 24" width="48" height="96"', 1.5),
        ('viewBox="0 0 24 24" width="48" height="96" preserveAspectRatio="xMinYMin slice"', 0.75),
    ],
)
def test_a_stroke_that_does_not_scale_is_in_pixels_at_the_drawings_own_size(root, width):
    style = "stroke: red; stroke-width: 3px; stroke-dasharray: 6; vector-effect: NON-SCALING-STROKE"
    (shape,) = drawn(f'<g transform="scale(5)"><path d="M0 0h1" style="{style}"/></g>', root).shapes
    found = shape.style.stroke_width, *shape.style.stroke_dasharray, 3 * shape.style.pixel
    assert found == pytest.approx((width, 2 * width, width))


@pytest.mark.parametrize(
    "markup",
    [
        '<rect width="9" height="9" transform="scale(0 1)"/>',
        '<rect width="9" height="-1"/>',
        '<circle r="0"/>',
        '<path d="M5 5"/>',
        '<path d="M5 5z M6 6L6 6"/>',
        "<path/>",
        '<polyline points="4 4"/>',
        '<svg width="0"><rect width="9" height="9"/></svg>',
    ],
)
def test_what_has_no_extent_is_not_a_shape(markup):
    assert boxes(drawn(markup + RECT)) == [[0, 0, 1, 2]]


def test_joints_are_exact_after_a_transform():
    drawing = drawn('<path transform="rotate(33.3) scale(.7)" d="M1 1q2 3 4 5t1 1a3 2 9 0 1 5 5l.1.1z"/>')
    (contour,) = drawing.shapes[0].contours
    assert contour.closed
    assert np.array_equal(contour.segments[:, 3], np.roll(contour.segments[:, 0], -1))


def test_straight_segments_have_inner_points_at_thirds():
    (contour,) = drawn('<rect width="3" height="6"/>').shapes[0].contours
    assert contour.straight.all()
    assert np.allclose(contour.segments[:, 1], (2 * contour.segments[:, 0] + contour.segments[:, 3]) / 3)
    assert np.allclose(contour.segments[:, 2], (contour.segments[:, 0] + 2 * contour.segments[:, 3]) / 3)


def test_the_box_of_a_group_is_not_known_before_what_is_in_it():
    around = '<g style="transform: scale(2); transform-box: fill-box; transform-origin: 0 0">{}</g>'
    drawing = drawn(around.format(RECT))
    assert boxes(drawing) == [[0, 0, 2, 4]]
    assert drawing.notes == ("transform-box read as view-box",)
    assert drawn(around.replace("scale(2)", "none").format(RECT)).notes == ()
