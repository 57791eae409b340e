"""Stretches that outlines share, closed or open."""

import numpy as np

from shapeblend_cli.geometry.flat_contour import FlatContour
from shapeblend_cli.geometry.flatten import flatten
from shapeblend_cli.wires import stretches
from shapeblend_cli.wires.stretches import mostly_shared, shared_stretches
from tests.support.contours import polygon_contour


def flat(*points, closed=True):
    contour = polygon_contour(points, closed)
    return FlatContour(contour, flatten(contour, 0))


def lengths(shared):
    """Where stretches begin and end on both outlines."""
    return [tuple(np.round([*s.start, *s.end], 3).tolist()) for s in shared.stretches]


SQUARE = flat(0, 10, 10 + 10j, 10j)
NOTCHED = flat(0, 4, 4 + 3j, 6 + 3j, 6, 10, 10 + 10j, 10j)


def test_what_is_between_two_stretches_is_another_piece_on_either_outline():
    shared = mostly_shared([SQUARE], [NOTCHED])
    assert lengths(shared) == [(6.0, 12.0, 44.0, 50.0)]
    assert shared.following(0) == shared.following(1) == {0: 0}
    for side, nodes in ((0, [4, 6]), (1, [4, 4 + 3j, 6 + 3j, 6])):
        segments, straight = shared.between(side, 0, 0)
        np.testing.assert_allclose([*segments[:, 0], segments[-1, 3]], nodes, atol=1e-9)
        assert straight.all()


def test_outlines_that_are_one_share_one_stretch_with_nothing_between():
    shared = mostly_shared([SQUARE], [SQUARE])
    assert lengths(shared) == [(0.0, 0.0, 40.0, 40.0)]
    assert shared.between(0, 0, 0) is None


def test_lines_have_tails_and_share_pieces_with_outlines():
    line = flat(-5j, 0, 10, 10 + 5j, closed=False)
    assert lengths(shared_stretches([line], [SQUARE], 15.0)) == [(5.0, 0.0, 20.0, 15.0)]
    assert lengths(shared_stretches([SQUARE], [line], 15.0)) == [(0.0, 5.0, 15.0, 20.0)]
    broken = flat(-5j, 0, 4, 4 + 3j, 6 + 3j, 6, 10, 10 + 5j, closed=False)
    shared = mostly_shared([line], [broken])
    assert sorted(lengths(shared)) == [(0.0, 0.0, 9.0, 9.0), (11.0, 17.0, 20.0, 26.0)]
    first, second = sorted((0, 1), key=lambda k: shared.stretches[k].start)
    assert shared.following(0) == shared.following(1) == {first: second}


def test_each_stretch_belongs_to_one_outline_of_several():
    beside = flat(20, 30, 30 + 10j, 20 + 10j)
    shared = mostly_shared([beside, SQUARE], [NOTCHED, beside])
    assert [stretch.outlines for stretch in shared.stretches] == [(0, 1), (1, 0)]
    assert mostly_shared([SQUARE], [beside]) is None


def test_drawings_of_too_many_vertices_are_not_searched(monkeypatch):
    monkeypatch.setattr(stretches, "MOST_DISTANCES", 15)
    assert mostly_shared([SQUARE], [SQUARE]) is None
    assert not shared_stretches([SQUARE], [SQUARE], 15.0).stretches
