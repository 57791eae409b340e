"""Signs that are inverted in place as what is around them is filled."""

import pytest

from shapeblend_cli.frames.frames import shapes_at
from shapeblend_cli.model import control_box
from tests.pens.test_line_blends import blend
from tests.support.drawings import drawing

DISC = "M12 1A11 11 0 1 0 12 23A11 11 0 1 0 12 1Z"
HOLE = "M12 3A9 9 0 1 1 12 21A9 9 0 1 1 12 3Z"
SIGN = "M8 7H16V12H13V14H11V10H14V9H10V10H8Z M11 16H13V18H11Z"
RING, PLATE = f"{DISC} {HOLE} {SIGN}", f"{DISC} {SIGN}"


def filled(path):
    """A drawing of one path by the even-odd rule."""
    return drawing(path, attributes='fill-rule="evenodd"')


@pytest.mark.parametrize("backwards", [False, True])
def test_the_sign_stays_while_the_hole_around_it_closes(backwards):
    pair = blend(*[filled(RING), filled(PLATE)][:: -1 if backwards else 1])
    for t in (0.25, 0.5, 0.75):
        (shape,) = shapes_at(pair, 1.0 - t if backwards else t)
        assert shape.style.fill_rule == "evenodd"
        boxes = [control_box([path]) for path in shape.paths]
        assert sorted(box.width for box in boxes) == pytest.approx(sorted([22.0, 18.0 * (1.0 - t), 8.0, 2.0]))
        assert {round(box.centre.imag, 6) for box in boxes} == {12.0, 10.5, 17.0}


def test_a_sign_that_moves_is_not_inverted_in_place():
    pair = blend(filled(RING), filled(f"{DISC} M14 7H18V10H14Z"))
    assert all(shape.reason != "the sign is inverted as what is around it is filled" for shape in pair.shapes)


def test_other_colours_are_not_inverted():
    pair = blend(
        drawing(f'<path fill="#f00" fill-rule="evenodd" d="{DISC} {HOLE}"/>', f'<path d="{SIGN}"/>'),
        filled(PLATE),
    )
    assert len(pair.shapes) > 1
