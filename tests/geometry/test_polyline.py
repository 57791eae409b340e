"""Distances from polylines and their edges, beside plain ones, and what is needed of a polyline."""

import numpy as np
import pytest
from shapely import Polygon

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


def test_values_between_known_ones_are_those_of_numpy_round_after_round(rng, load_uncompiled):
    for module in (polyline, load_uncompiled("shapeblend_cli.geometry.polyline")):
        for count in (2, 3, 40):
            known = np.append(0.0, rng.random(count - 1).cumsum())
            if count > 3:
                known[2] = known[1]
            results, end = rng.normal(size=count), known[-1]
            values = np.concatenate([known, known + end, known - 3.0 * end, rng.normal(size=60) * end])
            found = module.interpolated(values, known, results)
            np.testing.assert_allclose(found, np.interp(values, known, results), rtol=1e-14, atol=1e-14)
            rounds = np.floor_divide(values, end)
            expected = rounds * results[-1] + np.interp(values - rounds * end, known, results)
            repeated = module.interpolated(values, known, results, True)
            np.testing.assert_allclose(repeated, expected, rtol=1e-14, atol=1e-14)
            if module is not polyline:
                assert np.array_equal(found, polyline.interpolated(values, known, results))
                assert np.array_equal(repeated, polyline.interpolated(values, known, results, True))


def test_convex_polygons_are_clipped_as_shapely_clips_them(rng, load_uncompiled):
    uncompiled = load_uncompiled("shapeblend_cli.geometry.polyline")
    for _ in range(50):
        around = np.sort(rng.uniform(0.0, 2.0 * np.pi, rng.integers(3, 12)))
        polygon = 2.0 * np.exp(1j * around) + 1.0
        corner, edge = complex(*rng.normal(size=2)), complex(*rng.normal(size=2))
        found = polyline.clipped(polygon, corner, edge)
        assert np.array_equal(found, uncompiled.clipped(polygon, corner, edge))
        ends = corner - 100.0 * edge, corner + 100.0 * edge
        half = [*ends, ends[1] + 100j * edge, ends[0] + 100j * edge]
        expected = Polygon(coordinates(polygon)).intersection(Polygon(coordinates(np.array(half))))
        area = Polygon(coordinates(found)).area if len(found) else 0.0
        assert area == pytest.approx(expected.area, abs=1e-9)


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


@pytest.mark.parametrize("count", [1, 15, 16, 17, 100])
def test_nearest_edges_are_the_first_of_those_as_near(rng, load_uncompiled, count):
    points, starts = (rng.normal(size=n) + 1j * rng.normal(size=n) for n in (50, count))
    ends = starts + 0.2 * (rng.normal(size=count) + 1j * rng.normal(size=count))
    starts, ends = np.append(starts, starts), np.append(ends, ends)  # each twice
    ways = ends - starts
    shares = ((points[:, None] - starts) * ways.conj()).real / np.abs(ways) ** 2
    shares = np.clip(shares, 0.0, 1.0)
    away = np.abs(points[:, None] - starts - shares * ways)
    found = distance, edge, share = polyline.nearest_edges(points, starts, ends)
    assert distance == pytest.approx(away.min(axis=1))
    assert (edge < count).all()
    rows = np.arange(len(points))
    assert away[rows, edge] == pytest.approx(distance)
    assert share == pytest.approx(shares[rows, edge])
    uncompiled = load_uncompiled("shapeblend_cli.geometry.polyline").nearest_edges(points, starts, ends)
    assert all(map(np.array_equal, found, uncompiled))


def test_points_that_are_not_needed_are_within_the_tolerance(rng, load_uncompiled):
    points = np.cumsum(rng.normal(size=300) + 1j * rng.normal(size=300))
    uncompiled = load_uncompiled("shapeblend_cli.geometry.polyline")
    for tolerance in (0.1, 1.0, 5.0):
        kept = polyline.needed(points, tolerance)
        assert kept[0]
        assert kept[-1]
        assert polyline.nearest_places(points, points[kept])[0].max() <= tolerance * (1.0 + 1e-9)
        assert np.array_equal(kept, uncompiled.needed(points, tolerance))
    assert kept.sum() < 150
    assert polyline.needed(points, 0.0).all()


def test_lines_on_their_way_deviate_near_their_vertices(load_uncompiled):
    t = np.arange(9.0)
    found = []
    for module in (polyline, load_uncompiled("shapeblend_cli.geometry.polyline")):
        line = t + 0j
        bent = np.where(t == 4.0, t + 0.5j, t)
        sides = [
            (np.stack([coordinates(points)] * 2), np.stack([polyline.cumulative_lengths(points)] * 2))
            for points in (bent, line)
        ]
        far = np.full(len(t), 0.1)
        cuts = np.array([0, 8], np.intp)
        module.add_deviations((*sides[0], cuts), (*sides[1], t), t[cuts], False, far)
        assert far.argmax() == 4
        assert 0.4 < far[4] <= 0.5
        assert far[[0, 1, 7, 8]].tolist() == [0.1] * 4
        found.append(far)
    np.testing.assert_array_equal(*found)
