"""Elements that show pictures."""

import sys
from pathlib import Path

import pytest

from shapeblend_cli.svg.reading.images import element
from shapeblend_cli.svg.reading.read import read
from tests.support.images import checkerboard, encoded, face, image, uri
from tests.svg.reading.drawings import RECT, drawn, refused

FACE = face(80, 40)


def place(attributes, around="{}"):
    """The picture of a document that has one, its corner and its sides."""
    (shape,) = drawn(around.format(image(FACE, attributes))).shapes
    picture = shape.style.picture
    return shape, *(
        complex(round(z.real, 9), round(z.imag, 9)) for z in (picture.origin, picture.across, picture.down)
    )


@pytest.mark.parametrize(
    ("attributes", "origin", "across", "down"),
    [
        ('x="10" y="20" width="40" height="20"', 10 + 20j, 40, 20j),
        ('x="10" y="20" width="40" height="40"', 10 + 30j, 40, 20j),
        ('width="40" height="40" preserveAspectRatio="none"', 0, 40, 40j),
        ('width="80" height="20" preserveAspectRatio="xMaxYMid"', 40, 40, 20j),
        ('x="5"', 5, 80, 40j),
        ('width="20"', 0, 20, 10j),
        ('height="20"', 0, 40, 20j),
        ('style="x:1px;y:2px;width:50%;height:auto"', 1 + 2j, 50, 25j),
        ('width="4em" height="100%" preserveAspectRatio="xMinYMin"', 0, 64, 32j),
        ('width="40" height="20" transform="rotate(90)"', 0, 40j, -20),
        ('width="40" height="20" transform="scale(-1 1)"', 0, -40, 20j),
    ],
)
def test_places(attributes, origin, across, down):
    assert place(attributes)[1:] == (origin, across, down)


def test_transforms_of_groups_and_nested_viewports_apply():
    around = (
        '<g transform="translate(10)"><svg x="5" width="50" height="50" viewBox="0 0 100 100">{}</svg></g>'
    )
    assert place('width="40" height="20"', around)[1:] == (15, 20, 10j)


def test_what_a_slice_cuts_off_is_clipped():
    shape, *found = place('x="10" width="40" height="40" preserveAspectRatio="xMidYMid slice"')
    assert found == [-10, 80, 40j]
    (clip,) = shape.clips
    assert clip.paths[0].segments[:, 0].tolist() == [10, 50, 50 + 40j, 10 + 40j]


def test_opacity_clips_and_names_are_as_of_shapes():
    photo = image(FACE, 'id="photo" width="40" height="20" opacity=".5" clip-path="url(#c)"')
    circle = '<circle cx=".5" cy=".5" r=".5"/>'
    markup = (
        f'<clipPath id="c" clipPathUnits="objectBoundingBox">{circle}</clipPath><g opacity="0.5">{photo}</g>'
    )
    (shape,) = drawn(markup).shapes
    assert (shape.id, shape.element, shape.style.fill_opacity, shape.name.id) == (
        "photo",
        "image",
        0.25,
        "photo",
    )
    (clip,) = shape.clips
    assert [round(v, 6) for v in (clip.paths[0].segments.real.max(), clip.paths[0].segments.imag.max())] == [
        40,
        20,
    ]


@pytest.mark.parametrize(
    ("attributes", "is_smooth"),
    [("", True), ('image-rendering="pixelated"', False), ('style="image-rendering:crisp-edges"', False)],
)
def test_pixels_may_be_squares(attributes, is_smooth):
    assert place(f'width="8" height="4" {attributes}')[0].style.picture.is_smooth is is_smooth


@pytest.mark.parametrize(
    ("markup", "note"),
    [
        ('<image width="9" height="9"/>', "image left out"),
        ('<image width="9" height="9" href="http://a.b/c.png"/>', "image left out: it is not in the file"),
        (
            '<image width="9" height="9" href="c.png"/>',
            "image left out: it is in another file; --images beside would take it if that is beside the drawing",
        ),
        (
            '<image width="9" height="9" href="data:image/png;base64,AAAA"/>',
            "image left out: it is no PNG, JPEG or WebP picture that can be read",
        ),
        (
            image(FACE, 'width="9" height="9"', "GIF"),
            "image left out: it is no PNG, JPEG or WebP picture that can be read",
        ),
    ],
)
def test_what_cannot_be_shown_is_left_out_with_a_note(markup, note):
    drawing = drawn(RECT + markup)
    assert (len(drawing.shapes), drawing.notes) == (1, (note,))


@pytest.mark.parametrize(
    "attributes", ['width="0" height="9"', 'width="9" height="-1"', 'visibility="hidden"']
)
def test_pictures_without_extent_are_not_there(attributes):
    assert len(drawn(RECT + image(FACE, attributes)).shapes) == 1


def test_pictures_can_be_skipped():
    drawing = drawn(RECT + image(FACE, 'width="9" height="9"'), images="skip")
    assert (len(drawing.shapes), drawing.notes) == (1, ("image left out",))
    assert "image left out" in refused(image(FACE, ""), "no painted shape", images="skip")


def test_without_pillow_pictures_are_left_out(monkeypatch):
    markup = RECT + image(FACE, 'width="9" height="9"')
    monkeypatch.setitem(sys.modules, "PIL", None)
    drawing = drawn(markup)
    assert drawing.notes == ("image left out: the extra shapeblend[images] reads pictures",)


def test_pictures_beside_a_drawing_go_along_if_that_is_allowed(here):
    Path("in/below").mkdir(parents=True)
    Path("outside.png").write_bytes(encoded(FACE))
    Path("in/below/a.png").write_bytes(encoded(FACE))
    markup = '<svg xmlns="http://www.w3.org/2000/svg"><rect width="1" height="1"/><image href="{}"/></svg>'
    Path("in/a.svg").write_text(markup.format("below/a.png"), "utf-8")
    Path("in/b.svg").write_text(markup.format("../outside.png"), "utf-8")
    assert [shape.element for shape in read("in/a.svg", images="beside").shapes] == ["rect", "image"]
    assert read("in/b.svg", images="beside").notes == ("image left out: its file is not beside the drawing",)
    assert len(read("in/a.svg").shapes) == 1


def test_a_drawing_has_so_many_pictures_and_pixels(monkeypatch):
    one = image(checkerboard(2, 4), 'id="p" width="9" height="9"')
    many = one + '<use href="#p"/>' * 5
    assert len(drawn(many).shapes) == 6
    monkeypatch.setattr(element, "MOST_IMAGES", 5)
    refused(many, "more than 5 pictures, the limit")
    monkeypatch.setattr(element, "MOST_IMAGES", 6)
    monkeypatch.setattr(element, "MOST_PIXELS", 6 * 64 - 1)
    refused(many, "more than 383 pixels of pictures, the limit")


def test_a_file_with_pictures_alone_is_a_drawing():
    (shape,) = drawn(f'<image width="9" height="9" xlink:href="{uri(encoded(FACE))}"/>').shapes
    assert shape.style.fill == shape.style.picture.raster.colour
