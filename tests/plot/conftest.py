"""What plots are made of, and ways to read them."""

import re
from xml.etree import ElementTree

import pytest

from shapeblend_cli.options.settings import Settings
from shapeblend_cli.pipeline import match_all
from shapeblend_cli.plot.options import PlotOptions
from shapeblend_cli.plot.subject import choose_subject
from shapeblend_cli.svg.reading.read import read

SVG = "{http://www.w3.org/2000/svg}"
NUMBER = re.compile(r"-?(?:\d+\.?\d*|\.\d+)")
OPEN = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 10 10"><path fill="none" stroke="red" d="{}"/></svg>'
LINES = "M0 0L5 5L9 1", "M0 9L3 2L8 8L9 0"


def pieces(text, kind):
    """The elements of a class."""
    return [e for e in ElementTree.fromstring(text).iter() if kind in e.get("class", "").split()]


def words(text):
    """All lines of text."""
    return [e.text for e in ElementTree.fromstring(text).iter(f"{SVG}text")]


def points(data):
    """The points of a line that is given by ways."""
    values = [float(v) for v in NUMBER.findall(data)]
    place, found = 0j, []
    for x, y in zip(values[::2], values[1::2], strict=True):
        place += complex(x, y)
        found.append(place)
    return found


@pytest.fixture
def subject_of(samples, tmp_path):
    """Match two drawings, samples by name or open lines by their path data, and give what a plot gets of them."""

    def match(a, b, contour=None, dot=None, **settings):
        files = []
        for name, drawing in (("a", a), ("b", b)):
            file = samples / f"{drawing}.svg"
            if drawing.startswith("M"):
                file = tmp_path / f"{name}.svg"
                file.write_text(OPEN.format(drawing))
            files.append(str(file))
        wanted = Settings(curves=False, **settings)
        (pair,), _ = match_all([read(file) for file in files], wanted)
        options = PlotOptions(contour=contour, dot=dot)
        return choose_subject(tuple(files), pair, wanted, options)

    return match
