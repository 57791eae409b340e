"""Drawings that were made from each other: what was moved node by node is blended segment by segment."""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from shapeblend_cli.geometry import cubics
from shapeblend_cli.geometry.polygons import reverse_contour
from shapeblend_cli.interpolate.paths import paths_at
from shapeblend_cli.model import Contour, Style
from shapeblend_cli.svg.reading.read import read
from shapeblend_cli.wires.same_segments import MOST_OF_MANY, SURE
from tests.support.contours import drawing, furthest, polygon_contour, polyline
from tests.support.drawings import svg
from tests.support.motions import pair_of
from tests.support.shapes import comb, star_polygon
from tests.support.strategies import rngs, seeds


def blended(a, b, style=None, **options):
    """The blend of two contours that stay in place and move straight."""
    (shape,) = pair_of(*(drawing(one, style=style) for one in (a, b)), motion="linear", **options).shapes
    return shape


def leaf(rng, count):
    """A closed contour of curves and some lines, around a middle."""
    node = star_polygon(rng, count, 0.4)
    after = np.roll(node, -1)
    straight = rng.random(count) < 0.3
    chord = after - node
    inner = [
        node + chord * (1 + 1j * rng.uniform(-0.6, 0.6, count)) / 3,
        after - chord * (1 + 1j * rng.uniform(-0.6, 0.6, count)) / 3,
    ]
    lines = [node + chord / 3, after - chord / 3]
    first, second = (np.where(straight, line, curve) for line, curve in zip(lines, inner, strict=True))
    return Contour(np.stack([node, first, second, after], axis=1), straight, True)


def edited(rng, contour, moved=0.12):
    """The contour with its control points moved; lines stay lines."""
    points = contour.segments[:, :3].copy()
    points += moved * (rng.normal(size=points.shape) + 1j * rng.normal(size=points.shape))
    segments = np.column_stack([points, np.roll(points[:, 0], -1)])
    lines = cubics.lines(segments[:, 0], closed=True)
    return Contour(np.where(contour.straight[:, None], lines, segments), contour.straight, True)


def cut(rng, contour, share=0.4):
    """The contour with nodes in the middle of some segments."""
    segments, straight = [], []
    for segment, line in zip(contour.segments, contour.straight, strict=True):
        ends = [0.0, *([rng.uniform(0.2, 0.8)] if rng.random() < share else []), 1.0]
        begin, end = np.array(ends[:-1]), np.array(ends[1:])
        segments.append(cubics.pieces(np.repeat(segment[None], len(begin), axis=0), begin, end))
        straight += [line] * len(begin)
    return Contour(np.concatenate(segments), np.array(straight), True)


def disguised(rng, contour):
    """The contour begun elsewhere, and perhaps gone through the other way."""
    by = int(rng.integers(len(contour.segments)))
    rolled = Contour(np.roll(contour.segments, by, axis=0), np.roll(contour.straight, by), True)
    return reverse_contour(rolled) if rng.random() < 0.5 else rolled


def mean(a, b):
    """What lies half way between contours of the same segments."""
    return Contour(0.5 * (a.segments + b.segments), a.straight & b.straight, a.closed)


def off(path, contour, pieces=200):
    """How far a path and a contour are from each other."""
    drawn, true = (np.append(polyline(one, pieces), one.segments[-1, 3]) for one in (path, contour))
    return max(furthest(drawn, true), furthest(true, drawn))


@settings(max_examples=15)  # each is a whole blend
@given(rngs, st.integers(4, 14))
def test_what_lies_half_way_has_the_means_of_the_control_points(rng, count):
    a = leaf(rng, count)
    b = edited(rng, a, 0.03)
    shape = blended(a, disguised(rng, b))
    half_way = paths_at(shape, 0.5)[0]
    assert len(half_way.segments) == count
    assert off(half_way, mean(a, b)) < 1e-4
    found = shape.contours[0].correspondence
    assert found.lower_bound <= found.work * (1 + 1e-9)


@settings(max_examples=15)  # each is a whole blend
@given(rngs, st.integers(4, 14))
def test_nodes_within_a_curve_do_not_count(rng, count):
    a = leaf(rng, count)
    b = edited(rng, a, 0.03)
    ends = cut(rng, a), disguised(rng, cut(rng, b))
    shape = blended(*ends)
    # Another node may be so near to one that need not be there.
    assert off(paths_at(shape, 0.5)[0], mean(a, b)) < SURE * 2.0
    # They are kept all the same, and all vertices are on the curves.
    (contour,) = shape.contours
    for polygon, drawn in ((contour.polygon_a, contour.contour_a), (contour.polygon_b, contour.contour_b)):
        assert (polygon.segment[polygon.parameter == 0.0] == np.arange(len(drawn.segments))).all()
        on_curve = cubics.evaluate(drawn.segments[polygon.segment], polygon.parameter)
        np.testing.assert_allclose(polygon.vertices, on_curve, atol=1e-9)
        assert (np.diff(polygon.segment + polygon.parameter) > 0.0).all()


@pytest.mark.parametrize("nearest", [1e-9, 1e-4, 0.1])
def test_no_node_is_lost_however_near_to_another(nearest):
    """One side has nodes that are nearer and nearer to its beginning."""
    lengths = np.array([1e-9, 1e-6, 1e-4, 0.1, 0.5, 2.0, 10.0])
    corners = [0, *lengths[lengths >= nearest], 10 + 10j, 10j]
    a, b = polygon_contour(corners), polygon_contour([0, 10, 12 + 11j, 10j])
    for ends in ((a, b), (b, a)):
        shape = blended(*ends)
        for polygon, drawn in (
            (shape.contours[0].polygon_a, ends[0]),
            (shape.contours[0].polygon_b, ends[1]),
        ):
            away = np.abs(polygon.vertices[:, None] - drawn.segments[:, 0]).min(axis=0)
            assert away.max() <= 1e-8
        for t, drawn in enumerate(ends):
            assert off(paths_at(shape, float(t))[0], drawn) < 1e-8


def test_an_outline_of_curves_that_all_might_be_one_is_blended():
    """Each of a thousand curves and the next one might be parts of a curve; all of them together are not."""

    def uneven(radius, wider):
        node = radius * np.exp(2j * np.pi * np.arange(1100) / 1100)
        node = node + wider * node.real**2 / radius
        after = np.roll(node, -1)
        segments = np.stack([node, node + 0.4 * (after - node), after - 0.2 * (after - node), after], axis=1)
        return Contour(segments, np.zeros(len(node), np.bool_), True)

    a, b = uneven(50.0, 0.0), uneven(60.0, 0.1)
    shape = blended(a, b)
    assert off(paths_at(shape, 0.0)[0], a, 4) < 1e-6
    assert off(paths_at(shape, 1.0)[0], b, 4) < 1e-6


@pytest.mark.parametrize("decimals", [2, 3])
def test_nodes_within_a_curve_are_found_in_files_with_few_decimals(decimals):
    rng = np.random.default_rng(7)
    a = leaf(rng, 9)
    b = edited(rng, a, 0.03)
    size = 24.0 / max(np.ptp(a.segments.real), np.ptp(a.segments.imag))

    def written(contour):
        points = contour.segments * size
        rounded = np.round(points.real, decimals) + 1j * np.round(points.imag, decimals)
        return Contour(rounded, contour.straight, True)

    shape = blended(written(a), written(disguised(rng, cut(rng, b, 0.5))))
    true = Contour(mean(a, b).segments * size, a.straight, True)
    assert off(paths_at(shape, 0.5)[0], true) < 3 * 10.0**-decimals


def test_a_segment_grows_from_a_node_that_lies_on_another():
    square = [0, 10, 10 + 10j, 10j]
    a, b = (
        polygon_contour([*square[:3], square[2], square[3]]),
        polygon_contour([*square[:2], 12 + 8j, 8 + 12j, 10j]),
    )
    for ends in ((a, b), (b, a)):
        half_way = paths_at(blended(*ends), 0.5)[0]
        assert off(half_way, mean(a, b)) < 1e-9


def test_lines_are_blended_segment_by_segment_too():
    a = Contour(
        [[0, 2 + 5j, 6 + 6j, 10], [10, 12 - 4j, 18 - 2j, 20], cubics.line(20, 30 + 2j)],
        [False, False, True],
        False,
    )
    b = Contour(
        [[0, 1 + 5j, 4 + 6j, 6], [6, 9 - 5j, 19 - 4j, 22], cubics.line(22, 30 - 2j)],
        [False, False, True],
        False,
    )
    half_way = paths_at(blended(a, b, Style(fill=None, stroke="#000000")), 0.5)[0]
    assert len(half_way.segments) == 3
    assert off(half_way, mean(a, b)) < 1e-4


def test_as_many_segments_by_accident_mean_nothing():
    """A comb has as many corners as this wheel, and nobody made one from the other."""
    teeth = polygon_contour(comb(3))
    count = len(teeth.segments)
    wheel = polygon_contour(
        3.0 * np.exp(2j * np.pi * np.arange(count) / count) * np.where(np.arange(count) % 2, 1.0, 0.7)
    )
    assert len(paths_at(blended(teeth, wheel), 0.5)[0].segments) > count


@settings(max_examples=15)  # each is a whole blend
@given(seeds, st.integers(4, 16))
def test_it_takes_little_more_than_the_least_work(seed, count):
    a, b = (polygon_contour(star_polygon(np.random.default_rng(seed + k), count)) for k in (0, 1))
    found = blended(a, b, effort="exact").contours[0].correspondence
    assert found.work <= MOST_OF_MANY * found.lower_bound * (1 + 1e-9)


def test_what_mirrors_itself_goes_before_what_has_as_many_segments(here):
    """A U is no V, though both have seven segments."""
    files = {
        "u": "M20 20V50C20 90 80 90 80 50V20H60V50C60 60 40 60 40 50V20Z",
        "v": "M10 20L50 90L90 20H70L55 50H45L30 20Z",
    }
    for name, data in files.items():
        Path(f"{name}.svg").write_text(svg(f'<path d="{data}"/>'))
    (shape,) = pair_of(*(read(f"{name}.svg") for name in files), motion="linear").shapes
    points = polyline(paths_at(shape, 0.5)[0], 64)
    image = 100.0 - points.real + 1j * points.imag
    assert furthest(image, points) < 1.0
