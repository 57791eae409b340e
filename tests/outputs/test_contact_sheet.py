"""Contact sheets: where cells are, and what colour they have."""

import pytest
from PIL.ImageColor import getrgb as colour

from shapeblend_cli.cli import run
from shapeblend_cli.errors import PictureError
from shapeblend_cli.model import Box
from shapeblend_cli.outputs.contact_sheet import PAGE, columns_for, contact_sheet
from shapeblend_cli.outputs.formats import WHITE
from shapeblend_cli.outputs.pixels import MOST_SIDE, Size, rasterize, read_png, size_for
from tests.support.commands import write
from tests.support.drawings import svg

RED = svg("M0 0H24V24H0Z", attributes='fill="#ff0000"')
WIDE = svg("M0 0H24V12H0Z", attributes='fill="#0000ff"', viewbox="0 0 24 12")


def test_cells_stand_in_rows_with_gaps_around():
    found = contact_sheet([RED] * 5, Size(40, 40), columns=3)
    assert (found.mode, found.size) == ("RGB", (3 * 42 + 2, 2 * 42 + 2))
    for column, row, wanted in ((0, 0, "#ff0000"), (2, 0, "#ff0000"), (1, 1, "#ff0000"), (2, 1, PAGE)):
        assert found.getpixel((2 + 42 * column + 20, 2 + 42 * row + 20)) == colour(wanted)
    for corner in ((0, 0), (127, 85), (42, 20), (20, 42)):
        assert found.getpixel(corner) == colour(PAGE)


def test_a_drawing_keeps_its_proportions_in_its_cell():
    found = contact_sheet([WIDE], Size(40, 40))
    assert found.getpixel((22, 22)) == found.getpixel((3, 22)) == (0, 0, 255)
    assert found.getpixel((22, 5)) == found.getpixel((22, 38)) == colour(WHITE)


def test_colours_of_page_and_cells():
    found = contact_sheet([WIDE], Size(40, 40), ground="#123456", page="#654321")
    assert (found.getpixel((0, 0)), found.getpixel((22, 5))) == (colour("#654321"), colour("#123456"))
    clear = contact_sheet([WIDE], Size(40, 40), ground=None, page=None)
    assert clear.mode == "RGBA"
    assert (clear.getpixel((0, 0))[3], clear.getpixel((22, 5))[3], clear.getpixel((22, 22))[3]) == (0, 0, 255)


def test_columns_leave_little_empty_and_make_rather_wide_sheets():
    assert [columns_for(count) for count in (1, 8, 12, 24, 25)] == [1, 8, 6, 8, 5]
    for count in range(9, 500):
        columns = columns_for(count)
        rows = -(-count // columns)
        assert rows <= columns <= 3 * rows
        assert rows * columns - count <= columns / 2


def test_no_more_columns_than_drawings():
    assert contact_sheet([RED] * 2, Size(20, 20), columns=9).size == (2 * 21 + 1, 22)


def test_a_drawing_is_fitted_centre_on_centre():
    found = read_png(rasterize(WIDE, Size(30, 60)))
    assert found.size == (30, 60)
    assert found.getbbox() == (0, 22, 30, 38) or found.getbbox() == (0, 23, 30, 38)
    assert found.getpixel((15, 30)) == (0, 0, 255, 255)


def test_a_background_leaves_nothing_transparent():
    found = read_png(rasterize(WIDE, Size(30, 60), "#00ff00"))
    assert found.getpixel((0, 0)) == (0, 255, 0, 255)
    assert found.getextrema()[3] == (255, 255)


def test_strokes_too_wide_for_pictures_are_refused(here, capsys):
    # Laid viewBox on viewBox, B's stroke is millions as wide as the view; drawn by pixels that ends the process.
    tiny = svg("M0 0L1e-6 0L1e-6 1e-6Z", attributes='fill="none" stroke="red"', viewbox="0 0 1e-6 1e-6")
    write(a=svg("M2 2H20V20Z"), b=tiny)
    for target in ("x.png", "x.gif"):
        assert run(["a.svg", "b.svg", "-o", target]) == 1
        assert "times as wide as the view" in capsys.readouterr().err
        assert not (here / target).exists()
    assert run(["a.svg", "b.svg", "-o", "x.svg"]) == 0


def test_sizes():
    assert size_for(300, Box(0, 0, 48, 24)) == (300, 150)
    assert size_for(1, Box(0, 0, 24, 24)) == (1, 1)
    assert size_for(10, Box(0, 0, 10, MOST_SIDE)) == (10, MOST_SIDE)


@pytest.mark.parametrize(("shape", "words"), [((10000, 1), "larger"), ((1, 10000), "smaller")])
def test_no_height_and_too_much_of_it_are_refused(shape, words):
    with pytest.raises(PictureError, match=f"a {words} --width"):
        size_for(400, Box(0, 0, *shape))


def test_too_many_pixels_are_refused():
    with pytest.raises(PictureError, match="80 million"):
        contact_sheet([RED] * 5, Size(10_000, 10_000))
