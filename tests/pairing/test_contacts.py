"""Shapes without a partner stay in touch with what they touch, while they grow and shrink."""

import numpy as np
import pytest

from shapeblend_cli.geometry.polyline import nearest_places
from shapeblend_cli.interpolate.paths import paths_at
from tests.support.drawings import drawing
from tests.support.motions import pair_of

BODY, NARROW = "M10 30H60V80H10Z", "M20 40H50V80H20Z"
LEAF = "M50 30L75 5L80 25Z"
DROP = "M78 20L96 12L94 24Z"
TIMES = np.arange(1, 20) / 20


def outlines_at(pair, numbers, t):
    """Return the outline at a time of each contour of A with one of the numbers."""
    found = {}
    for shape in pair.shapes:
        for contour, path in zip(shape.contours, paths_at(shape, t), strict=True):
            found[contour.a] = path.segments.ravel()
    return [found[number] for number in numbers]


def gap(one, other):
    return min(nearest_places(p, np.append(q, q[0]))[0].min() for p, q in ((one, other), (other, one)))


@pytest.fixture(scope="module")
def pair():
    return pair_of(drawing(BODY, LEAF, DROP), drawing(NARROW), motion="linear")


def test_a_shape_that_shrinks_beside_a_paired_one_keeps_touching_it(pair):
    for t in TIMES:
        body, leaf = outlines_at(pair, (0, 1), t)
        assert gap(body, leaf) < 2.0


def test_a_shape_that_touches_it_goes_with_it(pair):
    for t in TIMES:
        leaf, drop = outlines_at(pair, (1, 2), t)
        assert gap(leaf, drop) < 2.0 * (1.0 - t)


def test_a_shape_that_touches_nothing_shrinks_in_its_place():
    far = "M80 2H96V10H80Z"
    pair = pair_of(drawing(BODY, far), drawing(NARROW), motion="linear")
    for t in TIMES:
        (outline,) = outlines_at(pair, (1,), t)
        assert outline.mean() == pytest.approx(88 + 6j)


def test_a_shape_across_a_small_gap_shrinks_towards_what_it_belongs_to():
    plume = "M30 10H40V27H30Z"
    pair = pair_of(drawing(BODY, plume), drawing(NARROW), motion="linear")
    first, late = (outlines_at(pair, (0, 1), t) for t in (0.0, 0.99))
    assert gap(*late) < gap(*first) / 3


@pytest.mark.parametrize(("top", "goes_along"), [(10, True), (17, False)])
def test_a_shape_of_another_paint_goes_with_what_it_stands_beside_if_the_gap_is_small_for_it(top, goes_along):
    a, b = (f'<path d="{body}" fill="red"/>' for body in (BODY, NARROW))
    pair = pair_of(drawing(a, f"M30 {top}H40V27H30Z"), drawing(b), motion="linear")
    body, late = outlines_at(pair, (0, 1), 0.99)
    assert (gap(body, late) < 1.0) == goes_along
    if not goes_along:
        assert late.mean() == pytest.approx(35 + 22j, abs=0.1)


def test_wings_that_touch_a_body_differently_shrink_to_places_that_mirror_each_other():
    left, right = "M40 40L10 50L12 70L40 60Z", "M62.3 40L90 50L88 70L60 60Z"
    pair = pair_of(drawing("M40 20H60V80H40Z", left, right), drawing("M42 10H58V90H42Z"), motion="linear")
    (one, other) = (
        contour.end.segments[0, 0] for shape in pair.shapes for contour in shape.contours if contour.a
    )
    assert one == pytest.approx(100.0 - other.conjugate(), abs=1e-9)


@pytest.mark.parametrize(
    ("parts", "are_one"),
    [
        (
            ("M24 50H92V53H24Z", "M24 53H88V54H24Z", "M88 53H94V60H88Z"),
            True,
        ),  # a bow: the stick, the hair, the frog
        (("M12 32H58V55H12Z", "M12 55H58V78H12Z"), False),  # most of what is drawn
    ],
)
def test_small_shapes_that_touch_each_other_on_a_paired_one_shrink_as_one(parts, are_one):
    pair = pair_of(drawing(BODY, *parts), drawing(NARROW), motion="linear", swap="never")
    ends = [contour.end.segments[0, 0] for shape in pair.shapes for contour in shape.contours if contour.a]
    assert len(ends) == len(parts)
    assert (np.ptp(ends) == pytest.approx(0.0)) == are_one
