"""Distances from a polyline near given places, beside distances from all of it."""

import numpy as np

from shapeblend_cli.geometry import polyline


def coordinates(points):
    return points.view(float).reshape(-1, 2)


def test_near_a_place_the_distance_is_that_from_all_edges_there(rng, load_uncompiled):
    line = np.cumsum(1.0 + 0.3j * rng.normal(size=40))
    points = line[5:30] + 0.2 * (rng.normal(size=25) + 1j * rng.normal(size=25))
    lengths = polyline.cumulative_lengths(line)
    expected, _ = polyline.nearest_places(points, line)
    given = coordinates(points), coordinates(line), lengths[5:30].copy(), lengths, False
    for module in (polyline, load_uncompiled("shapeblend_cli.geometry.polyline")):
        at_points, at_vertices = np.zeros(len(points)), np.zeros(len(line))
        module.add_distances(*given, True, at_points)
        module.add_distances(*given, False, at_vertices)
        np.testing.assert_allclose(at_points, expected, atol=1e-12)
        assert np.array_equal(at_vertices[5:30], at_points)


def test_the_edges_of_a_closed_line_go_round():
    square = np.array([0, 1, 1 + 1j, 1j, 0j])
    lengths = polyline.cumulative_lengths(square)
    point, place, far = coordinates(np.array([-0.25 + 0.5j])), np.array([0.0]), np.zeros(1)
    polyline.add_distances(point, coordinates(square), place, lengths, True, True, far)
    assert far.tolist() == [0.25]


def test_tied_values_solve_their_system_the_same_compiled_and_uncompiled(rng, load_uncompiled):
    beside = rng.uniform(0.1, 2.0, 39)
    diagonal = np.append(beside, 0.0) + np.append(0.0, beside) + rng.uniform(0.01, 1.0, 40)
    right = rng.normal(size=40)
    matrix = np.diag(diagonal) - np.diag(beside, 1) - np.diag(beside, -1)
    given = diagonal.copy(), right.copy()
    values = polyline.tridiagonal(diagonal, beside, right)
    np.testing.assert_allclose(matrix @ values, right, atol=1e-12)
    assert np.array_equal((diagonal, right), given)  # they are as they were
    uncompiled = load_uncompiled("shapeblend_cli.geometry.polyline")
    assert np.array_equal(uncompiled.tridiagonal(diagonal, beside, right), values)
