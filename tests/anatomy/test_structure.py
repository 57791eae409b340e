import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from shapeblend_cli.anatomy.structure import structure_of
from shapeblend_cli.anatomy.twins import mirror_of
from tests.support.drawings import EVENODD, RING, contours_of


def rect(x, y, width, height, paint='fill="#000"'):
    return f'<rect x="{x}" y="{y}" width="{width}" height="{height}" {paint}/>'


def line(d):
    return f'<path d="{d}" fill="none" stroke="#000"/>'


@pytest.mark.parametrize(
    ("paths", "parents"),
    [
        # Whatever the shape, the paint and the order in the file.
        ((rect(0, 0, 20, 20), rect(2, 2, 10, 10), rect(4, 4, 2, 2)), [None, 0, 1]),
        (
            (rect(4, 4, 2, 2), rect(2, 2, 10, 10, 'fill="none" stroke="#000"'), rect(0, 0, 20, 20)),
            [1, 2, None],
        ),
        # Most of it decides, and what is beside is in nothing.
        (
            (rect(0, 0, 20, 20), rect(17, 5, 8, 3), rect(12, 5, 10, 3), rect(30, 5, 3, 3)),
            [None, None, 0, None],
        ),
        # Lines lie in outlines, and nothing in lines.
        ((rect(0, 0, 20, 20), line("M2 10H18V18")), [None, 0]),
        ((line("M0 0H20V20H0V1"), rect(5, 5, 4, 4)), [None, None]),
        # A fill and its stroke are beside each other, and what lies in both lies in the first.
        (
            (rect(0, 0, 20, 20), rect(0, 0, 20, 20, 'fill="none" stroke="#000"'), rect(5, 5, 4, 4)),
            [None, None, 0],
        ),
        # A hole lies in its outline, an island in the hole.
        ((f"{RING} M12 9L15 15H9Z",), [None, 0, 1]),
    ],
)
def test_each_contour_lies_in_the_smallest_one_around_most_of_it(paths, parents):
    assert structure_of(contours_of(*paths, attributes=EVENODD)).parent == parents


def square(size):
    return f"M{-size} {-size}H{size}V{size}H{-size}Z"


def disc(size):
    return f"M{size} 0A{size} {size} 0 1 1 {-size} 0A{size} {size} 0 1 1 {size} 0Z"


@pytest.mark.parametrize(
    ("paths", "parents"),
    [
        # 3.05 % more area: enough to be around, and little enough to be the same.
        ((square(50), square(50.7575)), [None, None]),
        # A frame of one hair, its hole drawn first, and what is around it.
        ((square(50) + square(50.5),), [None, None]),
        ((square(50) + square(50.5), square(60)), [2, 2, None]),
    ],
)
def test_no_contour_lies_in_itself(paths, parents):
    assert structure_of(contours_of(*paths, attributes=EVENODD)).parent == parents


outlines = st.builds(
    lambda draw, step: draw(50 * 1.005**step), st.sampled_from([square, disc]), st.integers(0, 12)
)


@given(st.lists(st.lists(outlines, min_size=1, max_size=3).map("".join), min_size=1, max_size=8))
def test_what_a_contour_lies_in_ends(paths):
    contours = contours_of(*paths, vertices=16, attributes=EVENODD)
    found = structure_of(contours)
    for k in range(len(contours)):
        # What stands for contours that coincide is decided before them.
        outer = found.ancestors(found.same[k])
        assert len({found.same[k], *outer}) == len(outer) + 1


def mirror(*paths):
    contours = contours_of(*paths)
    return mirror_of(contours, structure_of(contours))


FACE = rect(0, 0, 40, 40), rect(6, 8, 6, 6), rect(28, 8, 6, 6), rect(12, 26, 16, 5)


def test_twins_mirror_each_other_and_the_rest_is_on_the_axis():
    found = mirror(*FACE)
    assert found is not None
    assert found.x == pytest.approx(20.0, abs=0.1)
    assert found.twin == [0, 2, 1, 3]


def test_a_face_has_an_axis_in_spite_of_a_tear_and_the_tear_has_no_twin():
    found = mirror(*FACE, rect(7, 15, 3, 12))
    assert found is not None
    assert found.twin == [0, 2, 1, 3, None]


def test_lights_on_one_side_of_each_eye_are_twins():
    found = mirror(*FACE, rect(6.5, 8.5, 2, 2), rect(28.5, 8.5, 2, 2))
    assert found is not None
    assert found.twin == [0, 2, 1, 3, 5, 4]


def test_what_is_scattered_has_no_axis():
    rng = np.random.default_rng(1)
    scattered = [rect(x, y, 3 + x % 7, 3 + y % 5) for x, y in rng.integers(0, 90, (12, 2)).tolist()]
    assert mirror(*scattered) is None


def test_boxes_alone_make_no_twins():
    assert mirror('<path d="M0 0H10L0 20Z"/>', '<path d="M30 0H40L30 20Z"/>') is None
