"""Time of choosing how outlines move: `auto` beside straight paths."""

import pytest

from shapeblend_cli.options.settings import Settings
from shapeblend_cli.pipeline import match_all
from shapeblend_cli.svg.reading.read import read


@pytest.mark.parametrize("motion", ["linear", "auto"])
def test_without_a_fault(benchmark, samples, motion):
    benchmark.group = "two sample drawings without a fault"
    drawings = [read(str(samples / f"bird-{k}.svg")) for k in (1, 2)]
    (pair,), _ = benchmark.pedantic(
        match_all, (drawings, Settings(motion=motion)), rounds=15, warmup_rounds=1
    )
    assert [shape.motion for shape in pair.shapes] == [None] * len(pair.shapes)
