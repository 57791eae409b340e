"""Paint as SVG attributes."""

from shapeblend_cli.model import Style
from shapeblend_cli.svg.writing.paint import paint_attributes


def test_dashes_have_more_decimals_than_coordinates():
    line = Style(
        None,
        stroke="#000000",
        stroke_width=0.3251,
        stroke_dasharray=(0.325, 1.12345),
        stroke_dashoffset=0.005,
    )
    written = paint_attributes(line, 2)
    names = ("stroke_width", "stroke_dasharray", "stroke_dashoffset")
    assert [written[name] for name in names] == ["0.33", "0.325 1.1235", "0.005"]


def test_what_has_no_dashes_has_no_offset():
    written = paint_attributes(Style(None, stroke="#000000", stroke_dashoffset=3.0), 2)
    assert (written["stroke_dasharray"], written["stroke_dashoffset"]) == ("none", "0")
