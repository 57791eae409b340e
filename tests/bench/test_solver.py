"""Time to solve: tables and search over all starts, proven, beside one given start."""

import pytest

from tests.support.shapes import wavy
from tests.support.solver import find_least


def blob(m, seed):
    return wavy(m, seed, size=0.15, waves=8)


@pytest.mark.parametrize("m", [100, 300, 1000])
@pytest.mark.parametrize("start", [(0, 0), None], ids=["one start", "all starts"])
def test_closed(benchmark, m, start):
    benchmark.group = f"{m} x {m} vertices, closed"
    found = benchmark.pedantic(
        find_least,
        (blob(m, 0), blob(m, 50), True),
        {"start": start},
        rounds=7 if m > 500 else 25,
        warmup_rounds=1,
    )
    assert (found.gap == 0.0) == (start is None)


@pytest.mark.parametrize("m", [1000, 2000, 5000, 10_000, 20_000])
def test_any_size(benchmark, m):
    benchmark.group = "m x m vertices, effort auto"
    found = benchmark.pedantic(find_least, (blob(m, 0), blob(m, 50), True), rounds=3, warmup_rounds=0)
    benchmark.extra_info["work"] = found.work
