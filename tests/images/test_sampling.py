"""Pictures drawn in triangles."""

import numpy as np
import pytest

from shapeblend_cli.images import sampling
from shapeblend_cli.images.sampling import Layer, draw_triangles, lay_over
from tests.support.images import checkerboard

BOARD = np.array(checkerboard(4, 8).convert("RGBA"))
HALVES = np.array([[(0, 0), (1, 0), (1, 1)], [(0, 0), (1, 1), (0, 1)]], float)


def drawn(corners, sources, weight=1.0, size=(32, 32), picture=BOARD, draw=draw_triangles):
    return draw(corners, [Layer(sources, picture, weight)], *size)


def test_two_halves_of_a_picture_are_the_picture():
    assert (drawn(32 * HALVES, 32 * HALVES) == BOARD).all()


def test_a_turned_picture_is_the_picture_turned():
    turned = np.stack([32 - HALVES[..., 1] * 32, HALVES[..., 0] * 32], axis=-1)
    assert (drawn(turned, 32 * HALVES) == np.rot90(BOARD, -1)).all()


def test_weights_add_up():
    half = drawn(32 * HALVES, 32 * HALVES, 0.5)
    assert np.abs(half.astype(int) - BOARD // 2).max() <= 1
    both = draw_triangles(32 * HALVES, [Layer(32 * HALVES, BOARD, share) for share in (0.3, 0.7)], 32, 32)
    assert (both == BOARD).all()
    others = [Layer(32 * HALVES, BOARD, 0.5), Layer(32 * HALVES, BOARD[::-1], 0.5)]
    mixed = draw_triangles(32 * HALVES, others, 32, 32)
    assert np.abs(mixed - (BOARD.astype(float) + BOARD[::-1]) / 2).max() <= 1


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
    results = [drawn(corners, sources, 0.7, (18, 16), draw=each.draw_triangles) for each in (sampling, plain)]
    assert (results[0] == results[1]).all()
    assert results[0].any()
    mask = rng.integers(0, 256, (12, 10)).astype(np.uint8)
    targets = [np.full((14, 12, 4), 100, np.uint8) for _ in range(2)]
    for target, each in zip(targets, (sampling, plain), strict=True):
        each.lay_over(target, results[0][:12, :10], mask, 2, 1)
    assert (targets[0] == targets[1]).all()
    assert (targets[0] != 100).any()


def test_between_pixels_colours_are_mixed():
    ramp = np.repeat(np.arange(0, 256, 8, dtype=np.uint8)[None, :, None], 4, axis=2)
    moved = drawn(32 * HALVES, 32 * HALVES + [0.25, 0.0], picture=np.repeat(ramp, 32, axis=0))
    assert (moved[5, :-1, 0] == np.arange(2, 250, 8)).all()


def test_drawn_in_several_rounds_it_is_the_same(monkeypatch):
    whole = drawn(8 + 16 * HALVES, 32 * HALVES, 0.6)
    monkeypatch.setattr(sampling, "ROUND", 40)
    assert (drawn(8 + 16 * HALVES, 32 * HALVES, 0.6) == whole).all()


def test_what_is_laid_over_covers_as_much_as_its_mask_says():
    target = np.full((4, 4, 4), 255, np.uint8)
    layer = np.zeros((2, 2, 4), np.uint8)
    layer[..., 3] = [[255, 255], [255, 128]]
    lay_over(target, layer, np.array([[255, 0], [51, 255]], np.uint8), 1, 2)
    assert (target[2:, 1:3, 0] == [[0, 255], [204, 127]]).all()
    assert (target[..., 3] == 255).all()
    assert target[:2].min() == target[:, 3].min() == 255


@pytest.mark.parametrize("side", [1, 2])
def test_tiny_pictures(side):
    picture = np.full((side, side, 4), 200, np.uint8)
    assert (drawn(32 * HALVES, side * HALVES, picture=picture) == 200).all()
