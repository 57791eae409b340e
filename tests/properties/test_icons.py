"""What must hold of real icons: exact ends, few segments, and nothing that polygons would not cross."""

import json
from pathlib import Path

import numpy as np
import pytest

from shapeblend_cli.cli import run
from shapeblend_cli.svg.reading.read import read
from tests.support.contours import furthest, polyline

DATA = Path(__file__).parents[1] / "bench" / "data" / "pairs.json"
PAIRS = json.loads(DATA.read_text(encoding="utf-8"))
CHOSEN = [("single", k) for k in range(0, 80, 10)] + [("whole", k) for k in range(0, 40, 10)]


def points(drawing, pieces):
    return np.concatenate([polyline(c, pieces) for shape in drawing.shapes for c in shape.contours])


def distance(drawing, other):
    """How far any point of one drawing lies from the other."""
    contours = [c for shape in other.shapes for c in shape.contours]
    return furthest(points(drawing, 20), *(np.append(polyline(c, 300), c.segments[-1, 3]) for c in contours))


def segments(drawing):
    return sum(len(c.segments) for shape in drawing.shapes for c in shape.contours)


@pytest.fixture(scope="module")
def blended(tmp_path_factory):
    """Both drawings and the frames at t = 0, 1/2 and 1 of every chosen pair."""
    folder = tmp_path_factory.mktemp("icons")
    found = []
    for number, (kind, k) in enumerate(CHOSEN):
        files = []
        for side in "ab":
            file = folder / f"{number}{side}.svg"
            file.write_text(
                '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100">'
                f'<path fill-rule="evenodd" d="{PAIRS[kind][k][side]}"/></svg>'
            )
            files.append(str(file))
        out = folder / str(number)
        assert run([*files, "-n", "1", "--ends", "--motion", "linear", "-q", "-o", str(out)]) == 0
        found.append([read(str(file)) for file in (*files, *sorted(out.glob("*.svg")))])
    return found


def test_the_ends_are_the_drawings(blended):
    for a, b, start, _, end in blended:
        for drawing, frame in ((a, start), (b, end)):
            z = points(drawing, 1)
            size = max(np.ptp(z.real), np.ptp(z.imag))
            assert distance(drawing, frame) < 1e-4 * size
            assert distance(frame, drawing) < 1e-4 * size


def test_an_in_between_has_about_as_many_segments_as_both_drawings(blended):
    shares = [segments(middle) / (segments(a) + segments(b)) for a, b, _, middle, _ in blended]
    assert np.median(shares) <= 1.2
    assert max(shares) < 2.0
