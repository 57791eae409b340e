"""What blending takes grows about as drawings do: the work is counted, as calls and as dots that are searched."""

import cProfile
import random

import pytest

from shapeblend_cli.matching import coarse
from shapeblend_cli.options.settings import Settings
from shapeblend_cli.pipeline import match_all
from shapeblend_cli.svg.reading.read import read
from tools.fuzz_limits import clip, gradient, nest, zigzag

MOST = 2.5
"""Maximum growth of the work when both drawings are doubled."""


def drawings_of(kind, count, folder):
    for name in "ab":
        made = kind(random.Random(name), count)
        text = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100">{made}</svg>'
        (folder / name).with_suffix(".svg").write_text(text)
    return [read(folder / f"{name}.svg") for name in "ab"]


def calls_to_blend(kind, count, folder):
    """Return the number of calls of functions, in Python and in C."""
    with cProfile.Profile() as profile:
        match_all(drawings_of(kind, count, folder), Settings(vertices=60))
    return sum(each.callcount for each in profile.getstats())


@pytest.mark.parametrize("kind", [nest, gradient, clip], ids=lambda kind: kind.__name__)
def test_a_drawing_of_twice_as_many_parts_takes_about_twice_the_calls(kind, tmp_path):
    calls_to_blend(kind, 10, tmp_path)  # modules are imported
    few, many = (calls_to_blend(kind, count, tmp_path) for count in (160, 320))
    assert many < MOST * few


def test_a_zigzag_of_twice_as_many_points_takes_about_twice_the_dots(monkeypatch, tmp_path):
    searched = []
    search = coarse._search

    def counted(*given):
        path, graph = search(*given)
        searched.append(graph.region.dots + graph.swept)
        return path, graph

    monkeypatch.setattr(coarse, "_search", counted)
    found = []
    for count in (300, 600):
        searched.clear()
        match_all(drawings_of(zigzag, count, tmp_path), Settings())
        found.append(sum(searched))
    assert 0 < found[1] < MOST * found[0]
