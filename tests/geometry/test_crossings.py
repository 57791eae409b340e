"""How often outlines cross, on their curves."""

from dataclasses import replace

import numpy as np
import pytest
import shapely
from hypothesis import assume, given
from hypothesis import strategies as st

from shapeblend_cli.geometry import crossings, cubics
from shapeblend_cli.geometry.crossings import path_crossings, polygon_crossings
from shapeblend_cli.geometry.polygons import reverse_contour
from shapeblend_cli.model import Contour, CubicPath
from tests.support.contours import circle_contour as circle
from tests.support.contours import polygon, polyline
from tests.support.contours import polygon_contour as lines
from tests.support.shapes import random_polygon, star_polygon


def chain(nodes, handles, closed=True):
    """Curves from node to node; two handles for each."""
    ends = np.roll(nodes, -1) if closed else nodes[1:]
    segments = np.column_stack([nodes[: len(ends)], handles[: len(ends)], ends])
    return CubicPath(segments, np.zeros(len(ends), bool), closed)


def random_chain(rng, k, closed=True):
    nodes = rng.random(k) + 1j * rng.random(k)
    return chain(nodes, rng.random((k, 2)) + 1j * rng.random((k, 2)), closed)


def from_node(one, k):
    return replace(one, segments=np.roll(one.segments, -k, axis=0), straight=np.roll(one.straight, -k))


def moved(one, by):
    return replace(one, segments=by(one.segments))


def as_curves(one):
    """The same lines, said to be curves."""
    return replace(one, straight=np.zeros(len(one.segments), bool))


def by_subdivision(outlines, pieces=400):
    """Cut every curve finely, and ask shapely for every pair of lines: how many cross, and the least sine there."""
    edges = []
    for one in outlines:
        z = np.append(polyline(one, pieces), one.segments[-1, 3])
        edges.append(np.stack([z[:-1], z[1:]], axis=1))
    ends = np.concatenate(edges)
    found = shapely.linestrings(np.stack([ends.real, ends.imag], axis=-1))
    p, q = shapely.STRtree(found).query(found, predicate="crosses")
    p, q = p[p < q], q[p < q]
    turn = (ends[p, 1] - ends[p, 0]) / (ends[q, 1] - ends[q, 0])
    return len(p), (np.abs(turn.imag) / np.abs(turn)).min(initial=1.0)


def as_polygons(outlines):
    return [
        polygon([*one.segments[:, 0], *one.segments[-1:, 3][one.closed :]], one.closed) for one in outlines
    ]


@given(st.integers(0, 10**6), st.integers(1, 3), st.integers(3, 40), st.booleans())
def test_polygons_agree_with_shapely(seed, count, m, closed):
    rng = np.random.default_rng(seed)
    outlines = [lines(rng.random(m) + 1j * rng.random(m), closed) for _ in range(count)]
    count, _ = by_subdivision(outlines)
    assert path_crossings(outlines) == polygon_crossings(as_polygons(outlines)) == count


@given(st.integers(0, 10**6), st.integers(3, 60))
def test_a_simple_polygon_has_none(seed, m):
    z = star_polygon(np.random.default_rng(seed), m)
    if shapely.Polygon(np.c_[z.real, z.imag]).is_valid:
        assert polygon_crossings([polygon(z)]) == 0


@given(st.integers(0, 10**6), st.integers(1, 3), st.integers(1, 6), st.booleans())
def test_curves_agree_with_shapely(seed, count, k, closed):
    rng = np.random.default_rng(seed)
    curves = [random_chain(rng, k + 1, closed) for _ in range(count)]
    count, least_sine = by_subdivision(curves)
    assume(least_sine > 0.03)  # slivers are touching
    assert path_crossings(curves) == count


SQUARE = [0, 4, 4 + 4j, 4j]

TOUCHING = {
    "a vertex on an edge": [lines([0, 4, 4 + 4j, 2, 4j])],
    "a vertex of another contour on an edge": [lines(SQUARE), lines([4 + 2j, 6, 6 + 4j])],
    "a vertex at a vertex": [lines(SQUARE), lines([4 + 4j, 8 + 4j, 8 + 8j])],
    "an edge along an edge": [lines(SQUARE), lines([4 + 1j, 6 + 1j, 6 + 3j, 4 + 3j])],
    "along an edge and away inside": [lines(SQUARE), lines([4 + 1j, 4 + 3j, 2 + 2j])],
    "along an edge to the other side": [lines([0, 8], False), lines([2 - 2j, 3, 5, 6 + 2j], False)],
    "a contour twice": [lines(SQUARE), lines(SQUARE)],
    "a contour and its reverse": [lines(SQUARE), reverse_contour(lines(SQUARE))],
    "twice round": [lines([*SQUARE, *SQUARE])],
    "twice round in part": [lines([0.1, 0.3, 0.3 + 0.1j, 0.1 + 0.1j, 0.1, 0.3])],
    "there and back": [lines([0, 4, 2, 2 + 3j])],
    "a spike": [lines([0, 2, 2 - 3j, 2, 4, 4 + 4j, 4j])],
    "a spike to a vertex": [lines([0, 2, 4 + 4j, 2, 4, 4 + 4j, 4j])],
    "coincident vertices": [lines([0, 4, 4, 4, 4 + 4j, 4j, 4j])],
    "a contour that is a point on an edge": [lines(SQUARE), lines([2, 2, 2])],
    "a contour that is a point": [lines([2 + 2j] * 3)],
    "a contour shrunk to nearly a point": [circle(), circle(1.0, 1e-9)],
    "an open line that ends on an edge": [lines(SQUARE), lines([2 + 2j, 2], False)],
    "an open line that ends at its start": [lines([0, 4, 4j, 0], False)],
    "lobes that meet in a vertex": [lines([0, 2 + 1j, 2 - 1j, 0, -2 - 1j, -2 + 1j])],
    "circles from outside": [circle(), circle(3.0, 2.0)],
    "circles from inside": [circle(), circle(0.5, 0.5)],
    "circles from inside, away from nodes": [circle(), circle(0.3 * np.exp(0.2j), 0.69995)],
    "a circle and a tangent": [circle(), lines([1 - 2j, 1 + 2j], False)],
    "a circle twice": [circle(), circle()],
    "a circle and one begun elsewhere, the other way": [circle(), reverse_contour(from_node(circle(), 3))],
    "a circle without anything": [circle()],
    "nothing": [],
}

CROSSING = {
    "a bow tie": ([lines([0, 2, 2j, 2 + 2j])], 1),
    "a bow tie with a node of both strands": ([lines([0, 2 + 2j, 4 + 4j, 4, 2 + 2j, 4j])], 1),
    "lobes through each other in a vertex": ([lines([0, 2 + 1j, 2 - 1j, 0, -2 + 1j, -2 - 1j])], 1),
    "a bow tie that begins at that node": ([lines([2 + 2j, 4 + 4j, 4, 2 + 2j, 4j, 0])], 1),
    "a node of one strand on the other's edge": ([lines([0, 2 + 2j, 4 + 4j, 4, 4j])], 1),
    "an eight with a node of both strands": (
        [chain([0, 0], np.array([[4 + 4j, 4 - 4j], [-4 + 4j, -4 - 4j]]))],
        1,
    ),
    "doubled nodes at the crossing": ([lines([0, 2 + 2j, 2 + 2j, 4 + 4j, 4, 2 + 2j, 2 + 2j, 4j])], 1),
    "three strands through one vertex": (
        [lines([-2, 0, 2], False), lines([-2 - 2j, 0, 2 + 2j], False), lines([-2j, 0, 2j], False)],
        3,
    ),
    "corners through each other": ([lines([-2, 0, 2 + 1j], False), lines([-2j, 0, 1 + 2j], False)], 1),
    "a zigzag, every second vertex on the line": (
        [lines([0, 8], False), lines([-1j, 1, 2 + 1j, 3, 4 - 1j, 5, 6 + 1j], False)],
        3,
    ),
    "a spike across an edge": ([lines([0, 2, 2 + 6j, 2, 4, 4 + 4j, 4j])], 2),
    "a pentagram": ([lines(np.exp(4j * np.pi * np.arange(5) / 5))], 5),
    "two squares": ([lines(SQUARE), lines(np.array(SQUARE) + 2 + 2j)], 2),
    "two circles": ([circle(), circle(1.0)], 2),
    "two circles that meet in nodes": ([circle(), circle(1 + 1j)], 2),
    "three circles": ([circle(), circle(1.0), circle(0.5 + 0.8j)], 6),
    "a loop of one curve": ([chain(np.array([0, 1]), np.array([[3 + 2j, -2 + 2j]]), False)], 1),
    "an ellipse over a circle": ([circle(), moved(circle(), lambda z: 2 * z.real + 0.5j * z.imag)], 4),
    "a line that leaves an edge of a circle at a node": ([circle(), lines([0.5, 1, 2], False)], 1),
}


ALL = {**{name: (outlines, 0) for name, outlines in TOUCHING.items()}, **CROSSING}
SOME = [name for name, (outlines, _) in ALL.items() if outlines]


@pytest.mark.parametrize(("outlines", "count"), ALL.values(), ids=ALL)
def test_passing_through_each_other_is_crossing_and_touching_is_not(outlines, count):
    assert path_crossings(outlines) == count


@given(
    st.sampled_from(SOME),
    st.floats(-3, 4),
    st.floats(0, 2 * np.pi),
    st.floats(0.5, 2),
    st.complex_numbers(max_magnitude=1e3),
)
def test_an_affine_map_changes_nothing(name, exponent, turn, stretch, shift):
    def by(z):
        # The shift is as far as a thousand times the size.
        return 10.0**exponent * ((z.real + 1j * stretch * z.imag) * np.exp(1j * turn) + shift)

    outlines, count = ALL[name]
    assert path_crossings([moved(one, by) for one in outlines]) == count


@given(st.sampled_from(SOME), st.integers(0, 7), st.booleans())
def test_neither_direction_nor_start_nor_order_matters(name, k, reverse):
    outlines, count = ALL[name]
    changed = [from_node(one, k) if one.closed else one for one in outlines]
    changed = [reverse_contour(one) for one in changed] if reverse else changed
    assert path_crossings(changed) == path_crossings(changed[::-1]) == count


@pytest.mark.parametrize("name", SOME)
def test_lines_count_as_they_do_among_curves_and_as_polygons(name):
    outlines, count = ALL[name]
    if all(one.straight.all() for one in outlines):
        assert polygon_crossings(as_polygons(outlines)) == count
    curve = circle(20, 0.1)  # has the whole shape taken as one of curves
    assert path_crossings([*map(as_curves, outlines), curve]) == count


@given(st.integers(0, 10**6), st.integers(1, 7), st.booleans())
def test_of_any_curves_neither_direction_nor_start_matters(seed, k, reverse):
    one = random_chain(np.random.default_rng(seed), 8)
    changed = from_node(reverse_contour(one) if reverse else one, k)
    assert path_crossings([changed]) == path_crossings([one])


@given(st.integers(0, 10**6), st.floats(0, 1))
def test_a_node_more_changes_nothing(seed, at):
    one = random_chain(np.random.default_rng(seed), 4)
    parameter = np.full(4, at)
    first = cubics.pieces(one.segments, np.zeros(4), parameter)
    second = cubics.pieces(one.segments, parameter, np.ones(4))
    both = np.stack([first, second], axis=1).reshape(8, 4)
    assert path_crossings([CubicPath(both, np.zeros(8, bool), True)]) == path_crossings([one])


@given(st.integers(0, 10**6))
def test_two_closed_contours_cross_each_other_an_even_number_of_times(seed):
    rng = np.random.default_rng(seed)
    a, b = random_chain(rng, 4), random_chain(rng, 4)
    around = lines([-1 - 1j, 2 - 1j, 2 + 2j, -1 + 2j])  # so that all counts are of one size
    apart = path_crossings([a, around]) + path_crossings([b, around])
    assert (path_crossings([a, b, around]) - apart) % 2 == 0


@given(st.floats(-np.pi, np.pi), st.floats(0.2, 0.8))
def test_circles_in_circles_touch_anywhere(turn, radius):
    # Eight cubics are no exact circle, so both have to be seen from the same place.
    inner = moved(circle(), lambda z: radius * (z - np.exp(0.25j * np.pi)) + np.exp(0.25j * np.pi))
    turned = [moved(one, lambda z: z * np.exp(1j * turn)) for one in (circle(), inner)]
    assert path_crossings(turned) == 0


@given(st.floats(0.01, np.pi - 0.01), st.floats(0.05, 0.95))
def test_lines_cross_at_any_angle_and_at_a_node_of_either(angle, at):
    way = np.exp(1j * angle)
    a, b = [-1, 1], [-way, way]
    for first in (a, [-1, 0, 1]):
        for second in (b, [-way, 0, way], [-way, -1e-7 * at * way, way]):
            for kind in (lines, lambda *args: as_curves(lines(*args))):
                assert path_crossings([kind(first, False), kind(second, False)]) == 1


def test_many_nodes_on_each_other_are_each_counted_once():
    rows = [x + 1j * y for x in range(12) for y in (range(12) if x % 2 else range(11, -1, -1))]
    columns = [y + 1j * x for x in range(12) for y in (range(12) if x % 2 else range(11, -1, -1))]
    one, other = lines(np.array(rows), False), lines(np.array(columns) + 0.0, False)
    # Inside, a straight strand of each passes through every node. At the rim both turn, or run along each other.
    assert path_crossings([one, other]) == 100


@pytest.mark.parametrize("most", [1, 2, 5, 9])
def test_counting_can_stop(most):
    pentagram = CROSSING["a pentagram"][0]
    assert path_crossings(pentagram, most=most) == min(most, 5)
    assert path_crossings([circle()], most=most) == 0


def test_compiled_and_uncompiled_kernels_agree(rng, load_uncompiled):
    assert crossings.COMPILED
    uncompiled = load_uncompiled("shapeblend_cli.geometry.crossings")
    assert not uncompiled.COMPILED
    shapes = [outlines for name, (outlines, _) in [*ALL.items()][::2] if name != "a circle twice"]
    arc = Contour(circle().segments[:1], np.zeros(1, bool), False)  # of which the same is seen in less time
    shapes += [[arc, arc], [random_chain(rng, 2), random_chain(rng, 2)], [lines(random_polygon(rng, 40))]]
    counts = [path_crossings(outlines) for outlines in shapes]
    assert [uncompiled.path_crossings(outlines) for outlines in shapes] == counts
