"""Drawings of many contours."""

import pytest

from shapeblend_cli.frames.frames import shapes_at
from shapeblend_cli.options.settings import Settings
from shapeblend_cli.pairing.pair import pair_contours
from shapeblend_cli.wires.match import match_contours
from shapeblend_cli.wires.rough import work_of_few
from tests.support.drawings import contours_of, drawing
from tests.support.motions import pair_of

DISC = "M2 72A20 20 0 1 0 42 72A20 20 0 1 0 2 72Z"


@pytest.mark.parametrize("count", [2, 41, 270, 600])
def test_small_contours_get_fewer_vertices_in_a_crowd_fewer_still_and_the_largest_all(count):
    dots = (f"M{x} {y}h1v1h-1Z" for x in range(0, 90, 3) for y in range(0, 60, 3))
    contours = contours_of(DISC, *(d for _, d in zip(range(count - 1), dots, strict=False)))
    vertices = [len(contour.polygon.vertices) for contour in contours]
    assert len(vertices) == count
    assert 190 <= vertices[0] <= 210
    assert min(vertices) >= 25
    assert max(vertices[1:]) < (50 if count > 100 else 70)


def axes(path):
    return path.segments.real, path.segments.imag


def squares(count, side, step=0.0):
    row = 30
    return "".join(
        f"M{step * (k % row):g} {step * (k // row):g}h{side}v{side}h-{side}z" for k in range(count)
    )


def test_of_copies_in_a_crowd_one_is_matched(monkeypatch):
    count, matched = 91, []
    monkeypatch.setattr("shapeblend_cli.blending.matched.MATCHED_ONE_BY_ONE", count - 1)
    monkeypatch.setattr(
        "shapeblend_cli.blending.matched.match_contours",
        lambda *given: matched.append(1) or match_contours(*given),
    )
    pair = pair_of(drawing(squares(count, 2, 3)), drawing(squares(count, 2, 4)))
    assert len(matched) < 10  # those in one place, and one of all others
    for end, step in ((0, 3), (1, 4)):
        corners = {(step * (k % 30), step * (k // 30)) for k in range(count)}
        paths = shapes_at(pair, end)[0].paths
        assert {(round(float(x.min()), 5), round(float(y.min()), 5)) for x, y in map(axes, paths)} >= corners


def nest(count):
    side = 80 / count
    return "".join(
        f"M{-side * k / 2:g} {-side * k / 2:g}h{side * k:g}v{side * k:g}h-{side * k:g}z"
        for k in range(count, 0, -1)
    )


@pytest.mark.parametrize("counts", [(47, 82), (300, 420)], ids=["few", "many"])
def test_nests_of_unlike_depths_are_paired(counts):
    nests = (contours_of(nest(count)) for count in counts)
    pairs = pair_contours(*nests, Settings())
    assert len(pairs) == counts[0]
    assert all(a.role == b.role for a, b in pairs)


def test_the_works_of_copies_in_a_crowd_are_found_once(monkeypatch):
    solved = []
    monkeypatch.setattr(
        "shapeblend_cli.pairing.costs.work_of_few",
        lambda *given: solved.append(1) or work_of_few(*given),
    )
    pairs = pair_contours(*(contours_of(squares(120, side, 3)) for side in (2, 2.3)), Settings())
    assert len(pairs) == 120
    assert len(solved) == 1


def test_large_contours_of_a_crowd_share_their_vertices():
    few, many = (contours_of(squares(count, 40)) for count in (100, 800))
    assert min(len(contour.polygon.vertices) for contour in few) >= 190
    assert sum(len(contour.polygon.vertices) for contour in many) < 60_000
