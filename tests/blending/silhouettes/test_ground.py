"""Silhouettes and gaps."""

import numpy as np
import pytest

from shapeblend_cli.anatomy.decompose import decompose
from shapeblend_cli.blending.silhouettes.ground import outline, parted, rim_of
from shapeblend_cli.geometry import cubics
from shapeblend_cli.geometry.polygons import signed_area
from shapeblend_cli.geometry.similarity import Similarity
from shapeblend_cli.pens.recovery.balls import touching_points
from tests.support.drawings import EVENODD, RING, drawing

SIDE = 24.0


def parts(path, width=0.03, closed=(), kept=()):
    """A drawing's rim, and its silhouette and gaps."""
    contours, _ = decompose(drawing(path, attributes=EVENODD), Similarity(), 0)
    rim = rim_of(contours, 0.004 * SIDE)
    flags = [np.array([k in some for k in range(len(contours))]) for some in (closed, kept)]
    return contours, rim, parted(rim, width * SIDE, *flags, 0.1 * SIDE)


def areas(rim, lines):
    """The signed areas within lines, the largest first."""
    return sorted((signed_area(rim.points[line]) for line in lines), key=abs, reverse=True)


TWO = "M2 2H22V11H2Z M2 12H22V22H2Z"
SLOTTED = "M2 2H22V22H12.5V8H11.5V22H2Z"


@pytest.mark.parametrize("path", [TWO, SLOTTED])
def test_what_is_left_without_gaps_is_whole(path):
    _, rim, found = parts(path)
    assert areas(rim, found.outlines) == pytest.approx([400.0], rel=0.01)
    assert len(found.gaps) == 1


@pytest.mark.parametrize("path", [TWO, SLOTTED, f"{TWO} M5 5V8H9V5Z", RING, "M2 2H9L12 4 15 2H22V22H2Z"])
def test_silhouette_and_gaps_are_the_drawing(path):
    contours, rim, found = parts(path)
    assert sum(areas(rim, [*found.outlines, *found.gaps])) == pytest.approx(
        sum(signed_area(contour.polygon.vertices) for contour in contours), rel=0.02
    )


def test_a_wide_gap_is_none():
    _, rim, found = parts("M2 2H22V9H2Z M2 14H22V22H2Z")
    assert not found.gaps
    assert len(areas(rim, found.outlines)) == 2


def test_a_shallow_notch_is_no_gap():
    _, _, found = parts("M2 2H9L12 4 15 2H22V22H2Z")
    assert not found.gaps


def test_what_gaps_enclose_is_one_with_them():
    crossed = "M2 2H11.5V11L11 11.5H2Z M12.5 2H22V11.5H13L12.5 11Z M2 12.5H11L11.5 13V22H2Z M12.5 22V13L13 12.5H22V22Z"
    _, rim, found = parts(crossed)
    assert areas(rim, found.outlines) == pytest.approx([400.0], rel=0.01)


def test_holes_close_or_are_kept():
    _, rim, found = parts(RING, closed=[1])
    assert len(found.outlines) == len(found.gaps) == 1
    _, rim, found = parts(RING, kept=[1])
    assert not found.gaps
    outer, inner = areas(rim, found.outlines)
    assert outer * inner < 0.0


def test_an_island_in_a_gap_is_an_edge_of_it():
    _, rim, found = parts(f"{TWO} M11 11.4H13V11.6H11Z")
    assert areas(rim, found.outlines) == pytest.approx([400.0], rel=0.01)
    assert len(found.gaps) == 2


def test_outlines_keep_their_curves():
    contours, rim, found = parts(RING, closed=[1])
    segments, straight = outline(rim, contours, found.outlines[0])
    assert not straight.any()
    assert len(segments) <= len(contours[0].contour.segments) + 1
    assert abs(cubics.signed_area(segments)) == pytest.approx(np.pi * 100.0, rel=1e-3)


def test_the_largest_balls_are_bounded_as_when_every_point_is_tried(rng):
    points, normals = rng.normal(size=(2, 80, 2)) @ (1.0, 1j)
    normals /= np.abs(normals)
    ways = points - points[:, None]
    inward = (normals[:, None].conj() * ways).real
    is_ahead = inward > 0.15 * np.abs(ways)
    tried = np.where(is_ahead, np.abs(ways) ** 2 / np.where(is_ahead, inward, 1.0), np.inf)
    assert (touching_points(points, normals, 0.15) == tried.argmin(axis=1)).all()
    assert touching_points(points[:2], np.array([points[0] - points[1]] * 2), 0.15)[0] == -1
