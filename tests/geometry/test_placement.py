"""How one drawing is laid over another."""

import pytest

from shapeblend_cli.geometry.placement import place_over
from tests.support.drawings import drawing

PATH = "M1 1H9V9H1Z"


@pytest.mark.parametrize(
    ("viewbox", "scale", "middle"),
    [
        ("0 0 20 10", 1.0, 10 + 5j),  # as high
        ("0 0 10 40", 1.0, 5 + 20j),  # as wide
        ("10 0 10 10", 1.0, 15 + 5j),
        ("0 0 20 20", 0.5, 10 + 10j),
        ("0 0 40 20", 0.25, 20 + 10j),
    ],
)
def test_viewboxes_that_share_a_side_keep_their_scale(viewbox, scale, middle):
    to_a = place_over(drawing(PATH, viewbox="0 0 10 10"), drawing(PATH, viewbox=viewbox), "viewbox")
    assert abs(to_a.points(middle + 1.0) - to_a.points(middle)) == pytest.approx(scale)
    assert to_a.points(middle) == pytest.approx(5 + 5j)
