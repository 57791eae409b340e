"""The in-betweens over time."""

import numpy as np
import pytest

from shapeblend_cli.plot import surface
from tests.plot.conftest import LINES, pieces, points, words


@pytest.mark.parametrize("names", [("e", "f"), ("bird-1", "bird-2")])
def test_polygons_are_those_of_equation_2(subject_of, names):
    subject = subject_of(*names, motion="linear")
    a, b = subject.contour.dot_points()
    rows = surface.vertices_at(subject, np.array([0.0, 0.3, 1.0]))
    assert np.abs(rows - np.array([a, 0.7 * a + 0.3 * b, b])).max() < 1e-9


def test_an_open_line_keeps_its_last_vertex(subject_of):
    subject = subject_of(*LINES, vertices=0)
    rows = surface.vertices_at(subject, np.array([0.0, 1.0]))
    assert rows.tolist() == [vertices.tolist() for vertices in subject.contour.dot_points()]


def test_a_turned_step_keeps_its_size_where_it_turns(subject_of):
    subject = subject_of("step-1", "step-2")
    start, middle = surface.vertices_at(subject, np.array([0.0, 0.5]))
    assert np.abs(np.diff(middle)) == pytest.approx(np.abs(np.diff(start)))
    assert "moving rigid" in words(surface.draw(subject))[2]


def test_what_is_higher_is_higher_on_the_page_and_what_is_north_is_further():
    page, depth = surface.project(np.array([[0, 0, 0], [0, 0, 1], [0, 1, 0.0]]))
    assert page[1].imag < page[0].imag
    assert page[1].real == pytest.approx(page[0].real)
    assert depth[2] > depth[0] > depth[1]


@pytest.mark.parametrize("names", [("triangle", "square"), ("cow", "deer")])
def test_faces_are_painted_from_back_to_front_and_the_file_is_small(subject_of, names):
    subject = subject_of(*names, vertices=400, effort="fast", motion="linear")
    text = surface.draw(subject)
    assert len(text) < 300_000
    heights = [points(e.get("d"))[0].imag for e in pieces(text, "face")]
    assert len(heights) > 20
    third = len(heights) // 3
    assert np.mean(heights[:third]) != pytest.approx(np.mean(heights[-third:]))
    assert points(pieces(text, "b")[0].get("d"))[0].imag < points(pieces(text, "a")[0].get("d"))[0].imag
