"""Time of choosing how outlines move: `auto` beside straight paths, and a way without crossings beside matching."""

import numpy as np
import pytest

from shapeblend_cli.model import Contour, Drawing, Shape, Style
from shapeblend_cli.options.settings import Settings
from shapeblend_cli.pipeline import match_all
from shapeblend_cli.svg.reading.read import read
from tests.support.shapes import bar, spiral


def polygon(vertices):
    z = np.asarray(vertices, complex)
    thirds = np.array([0, 1 / 3, 2 / 3, 1])
    segments = z[:, None] + (np.roll(z, -1) - z)[:, None] * thirds
    contour = Contour(segments, np.ones(len(z), bool), True)
    return Drawing("a.svg", None, (Shape(0, None, "path", (contour,), Style()),))


@pytest.mark.parametrize("motion", ["linear", "auto"])
def test_without_a_fault(benchmark, samples, motion):
    benchmark.group = "two sample drawings without a fault"
    drawings = [read(str(samples / f"bird-{k}.svg")) for k in (1, 2)]
    (pair,), _ = benchmark.pedantic(
        match_all, (drawings, Settings(motion=motion)), rounds=15, warmup_rounds=1
    )
    assert [shape.motion for shape in pair.shapes] == [None] * len(pair.shapes)


@pytest.mark.parametrize("motion", ["linear", "safe"])
def test_a_spiral_unrolled(benchmark, motion):
    benchmark.group = "200 vertices that cross on straight paths"
    drawings = [polygon(spiral(2.0, 100)), polygon(bar(100))]
    settings = Settings(motion=motion, place="bbox")
    (pair,), _ = benchmark.pedantic(match_all, (drawings, settings), rounds=5, warmup_rounds=1)
    assert [shape.motion is None for shape in pair.shapes] == [motion == "linear"]
