"""Time from opening the studio to its first blend, and from a dragged pin to the new one, as its page gets them.

On a machine with nothing else to do, a dragged pin takes less than 60 ms for plain icons and less than 250 ms for 30
contours, and these are there within a second. Drawing them takes a browser a few milliseconds more.
"""

from itertools import cycle

import pytest

from tests.bench.test_command import islands
from tests.studio.conftest import opened  # noqa: F401

FILES = ["c.svg", "d.svg"]
KINDS = {
    "two plain icons": ("e", "f"),
    "two birds": ("bird-1", "bird-2"),
    "two maps of 30 islands": None,
}


@pytest.fixture(params=KINDS)
def drawings(request, samples, here):
    """Two drawings in the current folder."""
    names = KINDS[request.param]
    for k, file in enumerate(FILES):
        (here / file).write_text((samples / f"{names[k]}.svg").read_text() if names else islands(k + 1, 30))


def test_first_blend(benchmark, drawings, opened):  # noqa: F811
    benchmark.group = "the studio: its first blend"
    answer = benchmark.pedantic(lambda: opened(*FILES).ask("look", project={"files": FILES}), rounds=3)
    assert answer["pairs"]


def test_dragged_pin(benchmark, drawings, opened):  # noqa: F811
    benchmark.group = "the studio: a dragged pin"
    client = opened(*FILES)
    lists = client.ask("look", project={"files": FILES})["pairs"][0]["lists"][0]
    (x, y), places = lists["vertices_a"][0], cycle(lists["vertices_b"][::7])

    def drag():
        place = ",".join(map(str, next(places)))
        return client.ask("look", project={"files": FILES, "pin": [f"{x},{y}:{place}"]})

    answer = benchmark.pedantic(drag, rounds=20, warmup_rounds=1)
    assert answer["pairs"]
