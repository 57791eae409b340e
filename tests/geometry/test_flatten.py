"""Flattening keeps nodes, spreads the rest evenly, and never strays from the curve."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from shapeblend_cli.geometry import cubics
from shapeblend_cli.geometry.flatten import TOLERANCE, flatten
from shapeblend_cli.geometry.polyline import from_end_to_end
from tests.support.contours import circle_contour, furthest, polygon_contour
from tests.support.strategies import contours


@given(contours(), st.sampled_from([0, 10, 60, 200]))
def test_promises_of_flatten(contour, vertices):
    polygon = flatten(contour, vertices)
    box = cubics.bounds(contour.segments)
    size = max(box.width, box.height)
    # Every vertex lies on the curve where it says it does.
    on_curve = cubics.evaluate(contour.segments[polygon.segment], polygon.parameter)
    np.testing.assert_allclose(on_curve, polygon.vertices, atol=1e-9 * size)
    # No repeated vertices.
    gaps = np.abs(np.diff(polygon.vertices, append=polygon.vertices[:1] if contour.closed else []))
    if len(polygon.vertices) > 1:
        assert gaps.min() > 0.0
    # Every node is a vertex, to the nearness that makes two vertices one.
    for node in contour.segments[:, 0]:
        assert np.abs(polygon.vertices - node).min() <= 2e-9 * size
    # The curve is never further away than the tolerance.
    if len(polygon.vertices) > 2:
        on_curve = cubics.evaluate(contour.segments[:, None, :], np.linspace(0, 1, 301)).ravel()
        far = furthest(on_curve, from_end_to_end(polygon.vertices, contour.closed))
        assert far <= TOLERANCE * size * (1 + 1e-6) + 2e-9 * size


def test_a_circle_gets_the_vertices_asked_for_evenly():
    polygon = flatten(circle_contour(radius=7.0), 200)
    assert len(polygon.vertices) == 200
    edges = np.abs(np.diff(polygon.vertices, append=polygon.vertices[0]))
    assert edges.max() / edges.min() < 1.001


def test_lines_are_cut_evenly_and_nodes_stay():
    polygon = flatten(polygon_contour([0, 10, 10 + 1j, 1j]), 24)
    assert 20 <= len(polygon.vertices) <= 24
    assert {0, 10, 10 + 1j, 1j} <= set(polygon.vertices.tolist())
    edges = np.abs(np.diff(polygon.vertices, append=polygon.vertices[0]))
    assert edges.max() <= 1.01


def test_fewer_vertices_than_nodes_add_none_to_lines_and_few_to_curves():
    square = flatten(polygon_contour([0, 10, 10 + 10j, 10j]), 0)
    assert square.vertices.tolist() == [0, 10, 10 + 10j, 10j]
    assert len(flatten(circle_contour(), 0).vertices) < 100
    nodes = np.exp(2j * np.pi * np.arange(300) / 300)
    assert len(flatten(polygon_contour(nodes), 200).vertices) == 300


def test_open_contours_keep_both_ends():
    polygon = flatten(polygon_contour([0, 4, 4 + 3j], closed=False), 15)
    assert polygon.vertices[[0, -1]].tolist() == [0, 4 + 3j]
    assert (polygon.segment[-1], polygon.parameter[-1]) == (1, 1.0)
    assert len(polygon.vertices) == 15


def test_repeated_nodes_go():
    contour = polygon_contour([0, 10, 10 + 1e-12, 10 + 10j, 0 + 1e-12j])
    assert flatten(contour, 0).vertices.tolist() == [0, 10, 10 + 10j]


@pytest.mark.parametrize("scale", [1e-6, 1.0, 1e6])
def test_nothing_depends_on_the_unit(scale):
    scaled, unit = (flatten(circle_contour(radius=radius), 0) for radius in (scale, 1.0))
    assert len(scaled.vertices) == len(unit.vertices)
