"""Time of choosing how outlines move: `auto` beside straight paths."""

import pytest

from shapeblend_cli.options.settings import Settings
from shapeblend_cli.pipeline import match_all
from shapeblend_cli.svg.reading.read import read


@pytest.mark.parametrize("motion", ["linear", "auto"])
def test_straight_in_the_end(benchmark, samples, motion):
    benchmark.group = "two sample drawings that move straight either way"
    drawings = [read(str(samples / f"{name}.svg")) for name in ("cow", "deer")]
    (pair,), _ = benchmark.pedantic(
        match_all, (drawings, Settings(motion=motion)), rounds=15, warmup_rounds=1
    )
    assert [shape.motion for shape in pair.shapes] == [None] * len(pair.shapes)
