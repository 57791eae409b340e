"""The wires of a matched contour are those that were solved."""

import pytest

import shapeblend_cli as sb
from shapeblend_cli.pairing.contour_blends import solved_wires


@pytest.mark.parametrize(
    ("a", "b", "settings"),
    [
        ("e", "f", sb.Settings()),
        ("step-1", "step-2", sb.Settings()),  # turned by a quarter
        ("cow", "deer", sb.Settings(stiff=((59.0 + 80.0j, 60.0, 5.0),), motion="linear")),
    ],
)
def test_the_path_costs_on_them_what_was_found(a, b, settings):
    blend = sb.blend(f"samples/{a}.svg", f"samples/{b}.svg", settings)
    for contour in blend.pairs[0].contours:
        found = contour.correspondence
        assert solved_wires(contour, settings).path_work(found.dots).total == pytest.approx(
            found.work, rel=1e-9
        )
