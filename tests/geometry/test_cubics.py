"""Bezier arithmetic against the curves themselves."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from shapeblend_cli.geometry import cubics
from tests.support.contours import circle_contour

segments = hnp.arrays(
    np.complex128, (3, 4), elements=st.builds(complex, st.integers(-50, 50), st.integers(-50, 50))
)


@given(segments)
def test_bounds_hold_the_curve_and_touch_it(segments):
    box = cubics.bounds(segments)
    curve = cubics.evaluate(segments[:, None, :], np.linspace(0, 1, 2001))
    for low, extent, values in ((box.x, box.width, curve.real), (box.y, box.height, curve.imag)):
        assert low == pytest.approx(values.min(), abs=1e-4)
        assert low <= values.min() + 1e-9
        assert low + extent == pytest.approx(values.max(), abs=1e-4)
        assert low + extent >= values.max() - 1e-9


@given(segments)
def test_lengths_are_those_of_fine_polygons(segments):
    curve = cubics.evaluate(segments[:, None, :], np.linspace(0, 1, 20001))
    fine = np.abs(np.diff(curve, axis=1)).sum(axis=1)
    np.testing.assert_allclose(cubics.lengths(segments), fine, rtol=1e-3, atol=1e-9)


@given(segments, st.floats(0, 1), st.floats(0, 1))
def test_pieces_are_parts_of_the_curve(segments, s, t):
    part = cubics.pieces(segments, np.full(3, s), np.full(3, t))
    u = np.linspace(0, 1, 7)
    expected = cubics.evaluate(segments[:, None, :], s + (t - s) * u)
    np.testing.assert_allclose(cubics.evaluate(part[:, None, :], u), expected, atol=1e-9)


@given(segments)
def test_chord_deviation_is_a_bound(segments):
    curve = cubics.evaluate(segments[:, None, :], np.linspace(0, 1, 501))
    chord = segments[:, 3] - segments[:, 0]
    for k, bound in enumerate(cubics.chord_deviation(segments)):
        u = ((curve[k] - segments[k, 0]).conj() * chord[k]).real / (abs(chord[k]) ** 2 or 1.0)
        assert np.abs(curve[k] - segments[k, 0] - np.clip(u, 0, 1) * chord[k]).max() <= bound + 1e-9


def test_a_circle_has_its_length_area_and_box():
    circle = circle_contour(2 + 1j, 3.0).segments
    assert cubics.lengths(circle).sum() == pytest.approx(6 * np.pi, rel=1e-5)
    assert cubics.signed_area(circle) == pytest.approx(9 * np.pi, rel=1e-5)
    assert tuple(cubics.bounds(circle)) == pytest.approx((-1, -2, 6, 6), rel=1e-5)


def test_area_closes_an_open_chain():
    assert cubics.signed_area(np.array([cubics.line(0, 4), cubics.line(4, 4 + 2j)])) == pytest.approx(4.0)


@given(segments, st.floats(0.0, 1.0), st.floats(0.0, 1.0))
def test_segments_with_a_parameter_each_are_evaluated_as_those_with_many(segments, first, second):
    t = np.array([first, second, 0.5])
    one_by_one = [
        cubics.evaluate(segment[None, None, :], t[k : k + 1])[0, 0] for k, segment in enumerate(segments)
    ]
    np.testing.assert_allclose(cubics.evaluate(segments, t), one_by_one, atol=1e-12)


def test_compiled_and_uncompiled_kernels_agree_to_the_bit(rng, load_uncompiled):
    segments = rng.normal(size=(30, 4)) + 1j * rng.normal(size=(30, 4))
    segments[3, 1], segments[7, 2], segments[9] = segments[3, 0], segments[7, 3], 1.0
    start, end = np.sort(rng.random((2, 30)), axis=0)
    found = []
    for module in (cubics, load_uncompiled("shapeblend_cli.geometry.cubics")):
        points = module.evaluate(segments, start), module.pieces(segments, start, end)
        sizes = (
            module.chord_deviation(segments),
            np.array([module.signed_area(segments), *module.bounds(segments)]),
        )
        found.append((*points, *module.directions(segments), *sizes))
    for one, other in zip(*found, strict=True):
        assert np.array_equal(one, other)


def test_paths_between_two_others_are_sampled_at_even_parameters(rng, load_uncompiled):
    a, b = rng.normal(size=(2, 3, 4)) + 1j * rng.normal(size=(2, 3, 4))
    counts, times = np.array([2, 1, 4], np.intp), np.array([0.25, 0.5])
    found = []
    for module in (cubics, load_uncompiled("shapeblend_cli.geometry.cubics")):
        points, lengths = module.in_betweens(a, b, counts, times)
        for t, line, along in zip(times, points.view(complex)[:, :, 0], lengths, strict=True):
            halfway = (1.0 - t) * a + t * b
            parts = [
                cubics.evaluate(one, np.arange(count) / count)
                for one, count in zip(halfway, counts, strict=True)
            ]
            np.testing.assert_allclose(line, np.concatenate([*parts, halfway[-1:, 3]]), atol=1e-12)
            np.testing.assert_allclose(np.diff(along), np.abs(np.diff(line)), atol=1e-12)
        found.append((points, lengths))
    for ours, theirs in zip(*found, strict=True):
        np.testing.assert_array_equal(ours, theirs)


def test_pieces_between_positions_end_where_the_next_begin(rng, load_uncompiled):
    nodes = rng.normal(size=4) + 1j * rng.normal(size=4)
    outline = cubics.line(nodes[:, None], np.roll(nodes, -1)[:, None])
    straight = np.array([True, False, True, False])
    edges = np.array([0, 0, 1, 2, 3], np.intp), np.array([0.0, 0.5, 0, 0, 0]), np.array([0.5, 1.0, 1, 1, 1])
    positions = np.array([1.0, 2.0, 2.25, 2.25, 3.0, 4.0, 4.5, 5.0])
    begins = cubics.evaluate(outline[[0, 1, 1, 1, 2, 3, 3]], np.array([0.5, 0.0, 0.25, 0.25, 0.0, 0.0, 0.5]))
    for module in (cubics, load_uncompiled("shapeblend_cli.geometry.cubics")):
        parts, lines, spans = module.pieces_between(outline, straight, edges, True, positions, joined=False)
        np.testing.assert_allclose(parts[:, 0], begins)
        assert lines.tolist() == [True, False, False, False, True, False, False]
        np.testing.assert_allclose(spans, [0.5, 0.25, 0.0, 0.75, 1.0, 0.5, 0.5], atol=1e-12)
        joined, lines, _ = module.pieces_between(outline, straight, edges, True, positions, joined=True)
        assert (joined[:-1, 3] == joined[1:, 0]).all()
        assert joined[-1, 3] == joined[0, 0]
        assert (joined[2] == joined[2, 0]).all()
        assert lines.tolist() == [True, False, True, False, True, False, False]
