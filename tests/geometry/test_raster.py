"""Winding numbers on grids."""

import numpy as np

from shapeblend_cli.geometry import raster


def test_points_of_a_grid_are_counted_by_their_winding_numbers(rng, load_uncompiled):
    vertices = rng.normal(size=12) + 1j * rng.normal(size=12)
    side = 20
    for outline in (vertices, vertices[::-1]):
        found = []
        for module in (raster, load_uncompiled("shapeblend_cli.geometry.raster")):
            numbers = module.winding_grid(outline, np.roll(outline, -1), -2.0 - 2.0j, 4.0 / side, side)
            upright = -numbers if numbers.sum() < 0 else numbers
            assert module.count_folds(numbers) == np.count_nonzero((upright < 0) | (upright > 1)) > 0
            inside = numbers != 0
            unlike = np.count_nonzero(inside != inside[:, ::-1])
            assert module.count_unlike(numbers) == (unlike, np.count_nonzero(inside))
            found.append(numbers)
        np.testing.assert_array_equal(*found)


def test_pictures_are_thinned_to_lines(rng, load_uncompiled):
    y, x = np.mgrid[:40, :40]
    discs = np.zeros((40, 40), bool)
    for _ in range(6):
        discs |= (y - rng.integers(5, 35)) ** 2 + (x - rng.integers(5, 35)) ** 2 < rng.integers(4, 60)
    found = [module.thin(discs) for module in (raster, load_uncompiled("shapeblend_cli.geometry.raster"))]
    np.testing.assert_array_equal(*found)
    line = found[0]
    assert 0 < line.sum() < discs.sum() / 4
    assert (discs | ~line).all()
    blocks = line[1:, 1:] & line[:-1, 1:] & line[1:, :-1] & line[:-1, :-1]
    assert not blocks.any()
