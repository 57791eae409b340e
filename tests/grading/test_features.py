"""What features find in strips that have one fault each."""

import numpy as np
import pytest

from shapeblend_cli.blending.placing import as_drawn
from shapeblend_cli.grading.features import features
from shapeblend_cli.grading.painting import SIDE, picture
from shapeblend_cli.model import Box
from tests.support.drawings import drawing

VIEW = Box(0, 0, 24, 24)
EVEN = [f"M{x} 4h8v8h-8Z" for x in np.linspace(2, 12, 7).tolist()]


def painted(*paths, attributes=""):
    return picture(as_drawn(drawing(*paths, attributes=attributes)), VIEW)


def strip(paths):
    return [painted(path) for path in paths]


def with_frame(at, *frames):
    """The even strip with other frames in place of those from the fourth on."""
    return [*EVEN[:at], *frames, *EVEN[at + len(frames) :]]


def test_nothing_is_wrong_with_a_square_that_slides():
    found = features(strip(EVEN))
    assert found.edges_off == pytest.approx(0.0, abs=0.05)
    assert found.detour < 0.3
    assert (found.pieces, found.holes, found.patches, found.grey) == (0.0, 0.0, 0.0, 0.0)


@pytest.mark.parametrize(
    ("name", "frame"),
    [
        ("edges_lost", "M9 7h1v1h-1Z"),
        ("ink_lost", "M9 7h1v1h-1Z"),
        ("swollen", "M1 1h22v22h-22Z"),
        ("pieces", "M7 4h3v8h-3Z M12 4h3v8h-3Z"),
        ("holes", "M7 4h8v8h-8Z M9 6v4h4v-4Z"),
        ("outside", "M7 14h8v8h-8Z"),
        ("lopsided", None),
        ("pop", "M7 14h8v8h-8Z"),
    ],
)
def test_a_fault_is_found_where_it_is(name, frame):
    if frame is None:
        even = ["M4 4h16v16h-16Z"] * 7
        wrong = [*even[:3], "M4 4h8v16h-8Z", *even[4:]]
    else:
        even, wrong = EVEN, with_frame(3, frame)
    before, after = (getattr(features(strip(one)), name) for one in (even, wrong))
    assert after > before + 0.02


def test_colours_on_the_way_may_turn_grey():
    red, grey, ochre, green = (
        painted("M4 4h16v16h-16Z", attributes=f'fill="{colour}"')
        for colour in ("#ff0000", "#808080", "#d0a000", "#00ff00")
    )
    assert features([red, grey, green]).grey > features([red, ochre, green]).grey + 0.3


def test_strokes_and_holes_are_painted():
    outline = 'fill="none" stroke="#000" stroke-width="2"'
    opacity = painted("M12 4A8 8 0 1 0 12 20A8 8 0 1 0 12 4Z", attributes=outline)[3]
    assert opacity.sum() * (24 / SIDE) ** 2 == pytest.approx(np.pi * (9**2 - 7**2), rel=0.03)
    assert opacity[SIDE // 2, SIDE // 2] == 0.0
