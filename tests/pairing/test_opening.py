"""A ring that becomes an outline without a hole opens, if that is what it looks like."""

import numpy as np
import pytest

from shapeblend_cli.geometry import cubics
from shapeblend_cli.interpolate.paths import paths_at
from shapeblend_cli.options.settings import Settings
from tests.support.drawings import EVENODD, contours_of, drawing
from tests.support.motions import pair_of

RING = "M2 12A10 10 0 1 0 22 12A10 10 0 1 0 2 12ZM6 12A6 6 0 1 0 18 12A6 6 0 1 0 6 12Z"
BOW = "M20 5A10 10 0 1 0 20 19L18 17A7 7 0 1 1 18 7Z"
"""A C, thinner than the ring."""
CUP = "M3 2H7V14A5 5 0 0 0 17 14V2H21V14A9 9 0 0 1 3 14Z"
DISC = "M2 12A10 10 0 1 0 22 12A10 10 0 1 0 2 12Z"
STAR = "M12 2L15 9H22L16 13L18 21L12 16L6 21L8 13L2 9H9Z"
PIERCED = DISC + "M11 12A1 1 0 1 0 13 12A1 1 0 1 0 11 12Z"


def blend(a, b, **options):
    drawings = [drawing(d, attributes=EVENODD) for d in (a, b)]
    return pair_of(*drawings, motion="linear", **options).shapes


@pytest.mark.parametrize("bow", [BOW, CUP])
def test_a_ring_opens(bow):
    for a, b in ((RING, bow), (bow, RING)):
        (shape,) = blend(a, b)
        (contour,) = shape.contours
        assert contour.is_matched
        areas = [abs(cubics.signed_area(paths_at(shape, t)[0].segments)) for t in np.linspace(0, 1, 11)]
        # No blob on the way.
        assert max(areas) < 1.1 * max(areas[0], areas[-1])
        assert min(areas) > 0.8 * min(areas[0], areas[-1])


def test_the_end_is_the_ring():
    (shape,) = blend(BOW, RING)
    hole, edge = (contour.contour.segments for contour in reversed(contours_of(RING, attributes=EVENODD)))
    area = abs(cubics.signed_area(edge)) - abs(cubics.signed_area(hole))
    assert abs(cubics.signed_area(shape.contours[0].end.segments)) == pytest.approx(area, rel=1e-6)


@pytest.mark.parametrize(("a", "b"), [(RING, DISC), (RING, STAR), (PIERCED, BOW), (RING, RING), (DISC, BOW)])
def test_otherwise_it_does_not(a, b):
    for first, second in ((a, b), (b, a)):
        numbers = {(c.a, c.b) for shape in blend(first, second) for c in shape.contours}
        counts = [len(contours_of(d, attributes=EVENODD)) for d in (first, second)]
        assert {i for i, _ in numbers if i is not None} == set(range(counts[0]))
        assert {j for _, j in numbers if j is not None} == set(range(counts[1]))


@pytest.mark.filterwarnings("error")
def test_a_hole_may_touch_the_edge():
    touching = "M2 2H22V22H2ZM2 6V18H18V6Z"
    for a, b in ((touching, CUP), (CUP, touching)):
        assert blend(a, b)


def test_what_is_asked_for_stays_closed():
    (shape,) = blend(RING, CUP, match=(("0", "0"),))
    assert len(shape.contours) == 2


def test_it_can_be_left_closed():
    (shape,) = blend(RING, CUP, unmatched="point")
    assert len(shape.contours) == 2
    assert Settings().unmatched == "auto"


SHACKLE = "M6 10V7A6 6 0 0 1 18 7V10H20V22H4V10Z"
OPENING = "M8 10H16V7A4 4 0 0 0 8 7Z"
KEYHOLE = "M11 15H13V18H11Z"
UNLOCKED = "M5 11V7A6 6 0 0 1 17 6L15 7A4 4 0 0 0 7 7V11H21V21H3V11Z"


@pytest.mark.parametrize("keyhole", ["", KEYHOLE, "M10 14H14V18H10Z"])
def test_one_of_the_holes_opens(keyhole):
    locked, unlocked = SHACKLE + OPENING + KEYHOLE * bool(keyhole), UNLOCKED + keyhole
    for a, b in ((locked, unlocked), (unlocked, locked)):
        (shape,) = blend(a, b)
        assert all(contour.is_matched for contour in shape.contours)
        assert len(shape.contours) == 1 + bool(keyhole)
        areas = [abs(cubics.signed_area(paths_at(shape, t)[0].segments)) for t in np.linspace(0, 1, 11)]
        assert max(areas) < 1.05 * max(areas[0], areas[-1])
