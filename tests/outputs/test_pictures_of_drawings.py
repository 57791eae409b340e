"""Drawings with pictures in every format: shown, or left out with one note."""

import base64
import io
import json
import re
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from shapeblend_cli.cli import run
from tests.support.commands import write
from tests.support.drawings import svg
from tests.support.images import checkerboard, encoded, face, image

BAR = '<rect width="24" height="3"/>'
PNG, JPEG = encoded(checkerboard()), encoded(face(), "JPEG")


@pytest.fixture
def files(here):
    write(
        a=svg(BAR + image(checkerboard(), 'x="2" y="4" width="10" height="10"')),
        b=svg(BAR + image(face(), 'x="12" y="9" width="12" height="9"', "JPEG")),
    )


def pictures_in(text):
    """The bytes of all pictures in an SVG."""
    return [base64.b64decode(data) for data in re.findall(r"base64,([\w+/=]+)", text)]


@pytest.mark.parametrize(
    ("options", "count"),
    [
        (("-o", "moving.svg"), 2),
        (("-o", "moving.svg", "--animate", "css"), 2),
        (("-o", "moving.svg", "--trigger", "click"), 5),
        (("-o", "moving.svg", "--animate", "frames", "-n", "1"), 4),
        (("-o", "moving.svg", "--emit", "layers", "-n", "1"), 2),
        (("-o", "moving.js"), 2),
        (("-o", "moving.json"), 2),
    ],
)
def test_drawings_that_move_hold_the_files_of_their_pictures(files, options, count, capsys):
    assert run(["a.svg", "b.svg", *options]) == 0
    found = pictures_in(Path(options[1]).read_text("utf-8"))
    assert len(found) == count
    assert {*found} == {PNG, JPEG}
    assert capsys.readouterr().err == ""


@pytest.mark.parametrize(
    ("options", "where"),
    [
        (("--emit", "pair"), "--emit pair"),
        (("--emit", "avd"), "Android"),
        (("-o", "moving.svg", "--trigger", "hover", "--animate", "css"), "CSS transitions"),
    ],
)
def test_other_formats_leave_pictures_out_and_say_so_once(files, options, where, capsys):
    assert run(["a.svg", "b.svg", *options]) == 0
    note = f"shapeblend: pictures are left out of {where}; frames and animated SVGs have them\n"
    assert capsys.readouterr().err == note


def test_lottie_has_each_picture_once_as_all_players_know_it(here, capsys):
    photo = image(face(), 'id="p" x="2" y="4" width="8" height="6"', "WEBP")
    write(a=svg(photo), b=svg(photo + '<use href="#p" x="10" opacity=".5"/>'))
    assert run(["a.svg", "b.svg", "-o", "moving.json"]) == 0
    assert capsys.readouterr().err == ""
    found = json.loads(Path("moving.json").read_text("utf-8"))
    (asset,) = found["assets"]
    assert (asset["w"], asset["h"], asset["e"]) == (160, 120, 1)
    (png,) = pictures_in(asset["p"])
    assert Image.open(io.BytesIO(png)).format == "PNG"
    assert [(layer["ty"], layer["refId"]) for layer in found["layers"]] == [(2, asset["id"])] * 2


def test_lottie_says_that_pixels_are_smooth(here, capsys):
    photo = image(face(), 'width="8" height="6" image-rendering="pixelated"')
    write(a=svg(photo), b=svg(photo))
    assert run(["a.svg", "b.svg", "-o", "moving.json"]) == 0
    assert capsys.readouterr().err == "shapeblend: Lottie smooths pictures; image-rendering is left out\n"


def test_a_format_without_pictures_needs_something_else_to_show(here, capsys):
    write(a=svg(image(checkerboard(), "")), b=svg(image(face(), "")))
    assert run(["a.svg", "b.svg", "--emit", "avd"]) == 1
    assert "cannot have pictures, and the drawings are nothing else" in capsys.readouterr().err
    assert not Path("blend.xml").exists()


def test_what_draws_pixels_never_gets_the_files_of_others(files, monkeypatch):
    from shapeblend_cli.outputs import composed, pixels

    given = []
    monkeypatch.setattr(composed, "rasterize", lambda svg, *_: given.append(svg) or pixels.rasterize(svg, *_))
    assert run(["a.svg", "b.svg", "--format", "png", "--ends", "-n", "3"]) == 0
    found = [data for text in given for data in pictures_in(text)]
    assert len(found) == 8
    assert all(data not in (PNG, JPEG) for data in found)
    assert {Image.open(io.BytesIO(data)).format for data in found} == {"PNG"}


def test_opaque_pictures_dissolve_without_a_hole(files):
    """The mean of both, to the last bit of rounding, where both are plain."""
    for name, colour in {"a": (250, 0, 0), "b": (0, 0, 250)}.items():
        write(**{name: svg(image(Image.new("RGB", (4, 4), colour), 'width="24" height="24"'))})
    assert run(["a.svg", "b.svg", "--format", "png", "-n", "1", "--width", "48"]) == 0
    pixels = np.asarray(Image.open("blend/frame-1.png"), int)
    assert np.abs(pixels - [125, 0, 125, 255]).max() <= 1


def test_the_preview_and_the_report_take_pictures(files):
    line = "a.svg b.svg -o moving.gif --duration 0.2 --preview p.html --report r.json"
    assert run(line.split()) == 0
    assert run(["inspect", "a.svg"]) == 0


def test_states_have_no_pictures(files, capsys):
    assert run(["states", "a.svg", "b.svg"]) == 0
    assert "pictures are left out of mixtures and states" in capsys.readouterr().err
