"""Pictures drawn in triangles."""

import numpy as np
import pytest

from shapeblend_cli.images import sampling
from shapeblend_cli.images.sampling import draw_triangles
from tests.support.images import checkerboard

BOARD = np.array(checkerboard(4, 8).convert("RGBA"))
HALVES = np.array([[(0, 0), (1, 0), (1, 1)], [(0, 0), (1, 1), (0, 1)]], float)


def drawn(corners, sources, weight=1.0, size=(32, 32), picture=BOARD, draw=draw_triangles):
    target = np.zeros((*size, 4), np.uint8)
    draw(corners, sources, picture, target, weight)
    return target


def test_two_halves_of_a_picture_are_the_picture():
    assert (drawn(32 * HALVES, 32 * HALVES) == BOARD).all()


def test_a_turned_picture_is_the_picture_turned():
    turned = np.stack([32 - HALVES[..., 1] * 32, HALVES[..., 0] * 32], axis=-1)
    assert (drawn(turned, 32 * HALVES) == np.rot90(BOARD, -1)).all()


def test_weights_add_up():
    half = drawn(32 * HALVES, 32 * HALVES, 0.5)
    assert np.abs(half.astype(int) - BOARD // 2).max() <= 1
    draw_triangles(32 * HALVES, 32 * HALVES, BOARD, half, 0.5)
    assert np.abs(half.astype(int) - BOARD).max() <= 1


def test_pixels_next_to_an_edge_are_drawn_for_clips_and_no_others():
    target = drawn(8 + 16 * HALVES, 32 * HALVES)
    seen = np.argwhere(target[..., 3])
    assert (seen.min(), seen.max()) == (7, 24)


def test_beyond_the_edge_of_a_picture_is_nothing():
    target = drawn(32 * HALVES, 96 * HALVES - 32)
    assert target[16, 16, 3] == 255
    assert target[2, 2, 3] == target[29, 29, 3] == 0


def test_triangles_beyond_the_target_draw_nothing():
    assert not drawn(32 * HALVES + 1000, 32 * HALVES).any()
    assert not drawn(32 * HALVES - 1000, 32 * HALVES).any()


def test_uncompiled_it_draws_the_same(load_uncompiled, rng):
    plain = load_uncompiled("shapeblend_cli.images.sampling")
    assert sampling.COMPILED
    assert not plain.COMPILED
    corners = rng.uniform(-4, 20, (6, 3, 2))
    one, other = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    areas = one[:, 0] * other[:, 1] - one[:, 1] * other[:, 0]
    corners[areas < 0] = corners[areas < 0][:, ::-1]
    sources = rng.uniform(-4, 36, (6, 3, 2))
    results = [drawn(corners, sources, 0.7, (16, 18), draw=each.draw_triangles) for each in (sampling, plain)]
    assert (results[0] == results[1]).all()
    assert results[0].any()


@pytest.mark.parametrize("side", [1, 2])
def test_tiny_pictures(side):
    picture = np.full((side, side, 4), 200, np.uint8)
    assert (drawn(32 * HALVES, side * HALVES, picture=picture) == 200).all()
