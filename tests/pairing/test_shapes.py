"""Contours that are painted together."""

import numpy as np

from shapeblend_cli.frames.frames import shapes_at
from shapeblend_cli.geometry.polygons import winding_numbers
from tests.support.drawings import drawing
from tests.support.motions import pair_of

DISC = "M12 2A10 10 0 1 1 12 22A10 10 0 1 1 12 2Z"
# A wheel that runs the other way round, in a shape with a bow that crosses itself, so that it keeps its directions.
WHEEL = "M12 2A10 10 0 1 0 12 22A10 10 0 1 0 12 2Z M12 6A6 6 0 1 1 12 18A6 6 0 1 1 12 6Z M64 6L68 10H64L68 6Z"
PLATE = "M30 2H60V22H30Z"


def test_a_hole_grows_in_an_exterior_that_was_reversed_to_be_matched():
    pair = pair_of(drawing(f"{DISC} {PLATE}"), drawing(f"{WHEEL} {PLATE}"))
    for t in (0.3, 0.99):
        shapes = shapes_at(pair, t)
        count = sum(
            int(winding_numbers(np.array([12 + 12j]), path.segments[:, 0])[0])
            for shape in shapes
            for path in shape.paths
        )
        assert count == 0, "in the middle of the wheel nothing is painted"
