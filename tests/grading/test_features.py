"""What features find in strips that have one fault each."""

import numpy as np
import pytest

from shapeblend_cli.blending.placing import as_drawn
from shapeblend_cli.grading.features import HALVES, Features, features, shares
from shapeblend_cli.grading.painting import SIDE, picture
from shapeblend_cli.grading.seen import look
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
    found = features(look(strip(EVEN)))
    for name in ("edges_lost", "size_off", "slivers", "lopsided", "pop", "directions"):
        assert getattr(found, name) == pytest.approx(0.0, abs=0.05)
    assert (found.pieces, found.patches, found.lumps, found.spikes, found.notches) == (0.0,) * 5


@pytest.mark.parametrize(
    ("name", "frame"),
    [
        ("edges_lost", "M9 7h1v1h-1Z"),
        ("size_off", "M1 1h22v22h-22Z"),
        ("lumps", "M1 1h22v22h-22Z"),
        ("slivers", "M7 4h8v8h-8Z M2 15h20v.4h-20Z"),
        ("spikes", "M7 4h8v8h-8Z M2 15l20 .9l-20 .9Z M2 17l20 .9l-20 .9Z"),
        ("notches", "M7 4h8v8h-3.6l-.4-8l-.4 8h-3.6Z"),
        ("directions", "M11 2l6 6l-6 6l-6-6Z"),
        ("patches", "M7 4h3v8h-3Z M12 4h3v8h-3Z"),
        ("pieces", "M7 4h3v8h-3Z M12 4h3v8h-3Z"),
        ("lopsided", None),
        ("pop", "M7 14h8v8h-8Z"),
    ],
)
def test_a_fault_is_found_where_it_is(name, frame):
    if frame is None:
        even = ["M4 4h16v16h-16Z"] * 7
        wrong = [*even[:3], "M4 4h12v4h-8v8h-4Z", *even[4:]]
    else:
        even, wrong = EVEN, with_frame(3, frame)
    before, after = (
        shares(np.array(features(look(strip(one)))))[Features._fields.index(name)] for one in (even, wrong)
    )
    assert after > before + 0.05


def test_pictures_of_one_colour_have_the_same_features_in_black():
    frames = with_frame(3, "M7 4h3v8h-3Z M12 4h3v8h-3Z")
    black = features(look([painted(frame) for frame in frames]))
    blue = features(look([painted(frame, attributes='fill="#0000ff"') for frame in frames]))
    for name in (
        "edges_lost",
        "size_off",
        "lumps",
        "spikes",
        "lopsided",
        "patches",
        "pieces",
        "pop",
        "detail",
    ):
        assert getattr(blue, name) == pytest.approx(getattr(black, name), abs=1e-6)


def test_half_of_the_worst_is_added_at_the_half():
    assert shares(np.array(HALVES)) == pytest.approx(0.5)
    assert shares(np.zeros(len(HALVES))) == pytest.approx(0.0)


def test_strokes_and_holes_are_painted():
    outline = 'fill="none" stroke="#000" stroke-width="2"'
    opacity = painted("M12 4A8 8 0 1 0 12 20A8 8 0 1 0 12 4Z", attributes=outline)[3]
    assert opacity.sum() * (24 / SIDE) ** 2 == pytest.approx(np.pi * (9**2 - 7**2), rel=0.03)
    assert opacity[SIDE // 2, SIDE // 2] == 0.0
