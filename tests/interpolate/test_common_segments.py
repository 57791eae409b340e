"""Two outlines as the same cubics and lines: exact at both ends, close to the polygons in between."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from shapeblend_cli.constants import WorkConstants
from shapeblend_cli.geometry import cubics
from shapeblend_cli.geometry.flatten import flatten
from shapeblend_cli.geometry.placement import to_unit_box
from shapeblend_cli.interpolate.common_segments import TOLERANCE, common_segments
from shapeblend_cli.interpolate.continuous_match import match_continuously
from shapeblend_cli.interpolate.parametrization import CORNER, parametrize
from shapeblend_cli.model import Contour, Polygon
from shapeblend_cli.svg.reading.read import read
from tests.support.contours import circle_contour, furthest, polygon_contour
from tests.support.solver import find_least

TIMES = (0.25, 0.5, 0.75)


def four_arcs(radius=1.0, turn=0.0):
    """A circle as drawing programs have it."""
    node = radius * np.exp(1j * (turn + np.pi / 2 * np.arange(4)))
    after, arc = np.roll(node, -1), 0.5522847498
    segments = np.stack([node, node * (1 + 1j * arc), after * (1 - 1j * arc), after], axis=1)
    segments[:-1, 3] = segments[1:, 0]
    segments[-1, 3] = segments[0, 0]
    return Contour(segments, np.zeros(4, bool), True)


def rounded_square(side=2.0, radius=0.4, centre=0j):
    """Four lines and four arcs, smooth all round."""
    segments, straight = [], []
    arc = 0.5522847498 * radius
    for k in range(4):
        turn = 1j**k
        low, high = -side / 2 + radius, side / 2 - radius
        start, end = complex(low, -side / 2) * turn, complex(high, -side / 2) * turn
        to = complex(side / 2, low) * turn
        segments += [cubics.line(start, end), [end, end + arc * turn, to - 1j * arc * turn, to]]
        straight += [True, False]
    return Contour(centre + np.array(segments), np.array(straight), True)


def solved(a, b, vertices=120):
    """What the solver is given and what it says."""
    polygon_a, polygon_b = flatten(a, vertices), flatten(b, vertices)
    found = find_least(to_unit_box(polygon_a), to_unit_box(polygon_b), a.closed, WorkConstants())
    return a, polygon_a, b, polygon_b, found.dots


def largest(path):
    contours = [c for shape in read(path).shapes for c in shape.contours]
    return max(contours, key=lambda c: abs(cubics.signed_area(c.segments)))


def same_way(a, b):
    """The second contour, gone through as the first one is."""
    if cubics.signed_area(a.segments) * cubics.signed_area(b.segments) > 0:
        return b
    return Contour(b.segments[::-1, ::-1], b.straight[::-1], b.closed)


def outline(segments, closed, pieces=64):
    u = np.arange(pieces) / pieces
    points = cubics.evaluate(segments[:, None, :], u).ravel()
    return np.append(points, segments[0, 0] if closed else segments[-1, 3])


def hausdorff(one, other):
    """The largest distance of either outline's vertices from the other outline, both already dense."""
    return max(furthest(one, other), furthest(other, one))


def size(contour):
    box = cubics.bounds(contour.segments)
    return max(box.width, box.height)


def assert_both_ends_are_the_drawings(common, a, b):
    for segments, contour in ((common.start.segments, a), (common.end.segments, b)):
        assert np.isfinite(segments).all()
        # Chained without a gap.
        assert (segments[1:, 0] == segments[:-1, 3]).all()
        if contour.closed:
            assert segments[0, 0] == segments[-1, 3]
        apart = hausdorff(outline(segments, a.closed, 200), outline(contour.segments, a.closed, 200))
        assert apart <= 1e-4 * size(contour)


def assert_all_nodes_stay(common, a, b):
    for segments, contour in ((common.start.segments, a), (common.end.segments, b)):
        for node in contour.segments[:, 0]:
            assert np.abs(segments[:, [0, 3]] - node).min() <= 1e-8 * size(contour)


def distance_to_polygons(common, problem):
    """The largest distance from the polygons' in-betweens, as a share of the larger outline."""
    a, polygon_a, b, polygon_b, dots = problem
    far = 0.0
    for t in TIMES:
        polygon = (1 - t) * polygon_a.vertices[dots[:, 0]] + t * polygon_b.vertices[dots[:, 1]]
        if a.closed:
            polygon = np.append(polygon, polygon[0])
        curve = outline((1 - t) * common.start.segments + t * common.end.segments, a.closed)
        far = max(far, hausdorff(curve, polygon))
    return far / max(size(a), size(b))


def bends(segments, closed):
    """By how many degrees an outline turns where one segment ends and the next begins."""
    begin, end = cubics.directions(segments)
    turns = np.degrees(np.abs(np.angle(np.roll(begin, -1) * end.conj())))
    return turns if closed else turns[:-1]


def bends_where_both_are_smooth(common, closed, t=0.5):
    smooth = np.degrees(CORNER)
    both = (bends(common.start.segments, closed) < smooth) & (bends(common.end.segments, closed) < smooth)
    return bends((1 - t) * common.start.segments + t * common.end.segments, closed)[both]


SAMPLES = (
    ("e", "f"),
    ("bird-1", "bird-2"),
    ("dancer-1", "dancer-2"),
    ("triangle", "square"),
    ("cow", "deer"),
)


@pytest.mark.parametrize("names", SAMPLES, ids="-".join)
def test_promises_on_the_samples(names, samples):
    a, b = (largest(samples / f"{name}.svg") for name in names)
    problem = solved(a, same_way(a, b), 200)
    common = common_segments(*problem)
    assert_both_ends_are_the_drawings(common, a, problem[2])
    assert_all_nodes_stay(common, a, problem[2])
    assert len(common.start.segments) <= 1.2 * (len(a.segments) + len(b.segments))
    # The tolerance is promised beside the polygons without the solver's stairs, which may add half an edge.
    assert distance_to_polygons(common, problem) <= 6.0 * TOLERANCE


@pytest.mark.parametrize("contour", [four_arcs(), rounded_square(), polygon_contour([0, 4, 4 + 3j, 3j])])
def test_an_outline_becomes_itself_unchanged(contour):
    polygon = flatten(contour, 50)
    dots = np.repeat(np.arange(len(polygon.vertices))[:, None], 2, axis=1)
    common = common_segments(contour, polygon, contour, polygon, dots)
    np.testing.assert_allclose(common.start.segments, contour.segments, atol=1e-12)
    np.testing.assert_allclose(common.end.segments, contour.segments, atol=1e-12)
    assert common.start.straight.tolist() == contour.straight.tolist()


@pytest.mark.parametrize("turn", [0.0, 0.1, np.pi / 4])
def test_a_circle_becomes_a_circle_in_few_cubics(turn):
    problem = solved(four_arcs(turn=turn), four_arcs(2.0))
    common = common_segments(*problem)
    assert 4 <= len(common.start.segments) <= 8
    between = outline(0.5 * (common.start.segments + common.end.segments), True)
    assert np.ptp(np.abs(between)) <= 3 * TOLERANCE * 4
    assert bends_where_both_are_smooth(common, True).max() <= 1.0


def test_a_square_becomes_a_rounded_square():
    square = polygon_contour([-1 - 1j, 1 - 1j, 1 + 1j, -1 + 1j])
    problem = solved(square, rounded_square())
    common = common_segments(*problem)
    assert_both_ends_are_the_drawings(common, square, problem[2])
    assert len(common.start.segments) <= 16
    # The sides stay lines; the corners open into curves.
    assert common.start.straight.sum() >= 4
    between = 0.5 * (common.start.segments + common.end.segments)
    for line in between[common.start.straight]:
        np.testing.assert_allclose(line, cubics.line(line[0], line[3]), atol=1e-12)
    assert distance_to_polygons(common, problem) <= 3 * TOLERANCE


def test_a_rounded_square_and_a_circle_stay_smooth():
    problem = solved(rounded_square(radius=0.5), circle_contour(), 200)
    common = common_segments(*problem)
    before = bends_where_both_are_smooth(common, True)
    assert len(before) >= 8
    assert before.max() <= 3.0


def test_smooth_drawings_bend_little_at_half_time(samples):
    a, b = (largest(samples / f"{name}.svg") for name in ("bird-1", "bird-2"))
    common = common_segments(*solved(a, same_way(a, b), 200))
    found = bends_where_both_are_smooth(common, True)
    assert np.median(found) <= 1.0
    assert np.mean(found > 3.0) <= 0.2


def test_corners_go_to_corners():
    """Also where the solver missed them by a vertex."""
    a = polygon_contour([0, 4, 4 + 4j, 4j])
    b = polygon_contour(np.array([0, 4, 4 + 4j, 4j]) * np.exp(0.2j))
    polygon_a, polygon_b = flatten(a, 80), flatten(b, 80)
    steps = np.arange(80)
    dots = np.concatenate([[[0, 0], [0, 1]], np.stack([steps[1:79], steps[2:80]], axis=1), [[79, 79]]])
    common = common_segments(a, polygon_a, b, polygon_b, dots)
    for corner_a, corner_b in zip(a.segments[:, 0], b.segments[:, 0], strict=True):
        assert common.end.segments[common.start.segments[:, 0] == corner_a, 0] == pytest.approx([corner_b])
    assert common.start.straight.all()
    assert (bends(0.5 * (common.start.segments + common.end.segments), True) > 80.0).sum() == 4


def test_a_circle_becomes_a_star():
    star = polygon_contour(np.exp(2j * np.pi * np.arange(10) / 10) * np.tile([1.0, 0.45], 5))
    problem = solved(four_arcs(), same_way(four_arcs(), star))
    common = common_segments(*problem)
    assert_both_ends_are_the_drawings(common, problem[0], problem[2])
    assert_all_nodes_stay(common, problem[0], problem[2])
    # Each of the star's corners is one in between as well.
    assert (bends(0.5 * (common.start.segments + common.end.segments), True) > 20.0).sum() >= 10
    assert not common.start.straight.any()
    assert distance_to_polygons(common, problem) <= 5 * TOLERANCE


def test_a_point_grows_into_the_whole_outline():
    whole = rounded_square()
    polygon = flatten(whole, 40)
    point = Polygon([3 + 4j], [0], [0.0], True)
    contour = Contour(np.full((1, 4), 3 + 4j), [True], True)
    dots = np.stack([np.zeros(len(polygon.vertices), int), np.arange(len(polygon.vertices))], axis=1)
    common = common_segments(contour, point, whole, polygon, dots)
    assert (common.start.segments == 3 + 4j).all()
    assert (common.end.segments == whole.segments).all()
    back = common_segments(whole, polygon, contour, point, dots[:, ::-1])
    assert (back.start.segments == whole.segments).all()
    assert (back.end.segments == 3 + 4j).all()
    assert back.start.straight.tolist() == whole.straight.tolist()


def test_a_loop_of_a_single_segment():
    loop = Contour([[0, 4 + 3j, -4 + 3j, 0]], [False], True)
    other = same_way(loop, four_arcs())
    problem = solved(loop, other)
    common = common_segments(*problem)
    assert_both_ends_are_the_drawings(common, loop, other)
    assert common.start.segments[0, 0] == 0


def test_open_outlines_keep_their_ends():
    a = Contour([[0, 1 + 2j, 3 + 2j, 4], cubics.line(4, 8)], [False, True], False)
    b = Contour([[0, 2 - 2j, 6 - 2j, 8 + 1j]], [False], False)
    problem = solved(a, b, 60)
    common = common_segments(*problem)
    assert_both_ends_are_the_drawings(common, a, b)
    assert_all_nodes_stay(common, a, b)
    assert (common.start.segments[0, 0], common.start.segments[-1, 3]) == (0, 8)
    assert (common.end.segments[0, 0], common.end.segments[-1, 3]) == (0, 8 + 1j)
    assert distance_to_polygons(common, problem) <= 3 * TOLERANCE


def test_a_corner_waits_while_a_whole_side_grows_out_of_it():
    """A point matched with lines and arcs: lines stay straight, and nothing of the other outline is lost."""
    a = polygon_contour([0, 4, 4j])
    b = rounded_square(2.0, 0.5, 2 + 2j)
    polygon_a, polygon_b = flatten(a, 30), flatten(b, 60)
    m, n = len(polygon_a.vertices), len(polygon_b.vertices)
    dots = np.concatenate(
        [
            [[0, j] for j in range(n // 2)],
            [[i, n // 2] for i in range(m)],
            [[m - 1, j] for j in range(n // 2, n)],
        ]
    )
    common = common_segments(a, polygon_a, b, polygon_b, dots)
    assert_both_ends_are_the_drawings(common, a, b)
    assert_all_nodes_stay(common, a, b)
    waits = np.abs(np.diff(common.start.segments, axis=1)).max(axis=1) == 0.0
    assert waits.sum() >= 2
    assert common.start.straight[waits].any()


def test_polygons_stay_polygons():
    """Where all vertices are nodes, the in-between is the polygons', a segment for every step."""
    rng = np.random.default_rng(7)
    nodes = [np.exp(2j * np.pi * np.arange(m) / m) * rng.uniform(1, 1.3, m) for m in (300, 320)]
    problem = solved(*(polygon_contour(z) for z in nodes), 0)
    common = common_segments(*problem)
    assert common.start.straight.all()
    assert len(common.start.segments) == len(problem[4])
    assert distance_to_polygons(common, problem) <= 1e-9


def test_joined_segments_and_dots_that_repeat_are_not_lost():
    """Nodes that coincide are left out of polygons; the segments beside them must stay whole."""
    circle = four_arcs().segments
    still = np.full((1, 4), circle[2, 0])
    a = Contour(np.concatenate([circle[:2], still, circle[2:]]), np.zeros(5, bool), True)
    common = common_segments(*solved(a, rounded_square()))
    assert_both_ends_are_the_drawings(common, a, rounded_square())


coordinate = st.floats(-10.0, 10.0).map(lambda v: round(v, 2))
point = st.builds(complex, coordinate, coordinate)


@st.composite
def closed_contours(draw):
    """Cubics and lines in any order: loops, cusps, handles of no length."""
    count = draw(st.integers(2, 5))
    nodes = draw(st.lists(point, min_size=count, max_size=count, unique=True))
    segments, straight = [], []
    for k in range(count):
        start, end = nodes[k], nodes[(k + 1) % count]
        kind = draw(st.sampled_from(["line", "curve", "curve", "retracted"]))
        straight.append(kind == "line")
        if kind == "line":
            segments.append(cubics.line(start, end))
        else:
            inner = [start, end] if kind == "retracted" else draw(st.tuples(point, point))
            segments.append([start, *inner, end])
    return Contour(np.array(segments), np.array(straight), True)


@given(closed_contours(), closed_contours(), st.data())
def test_any_outlines_and_any_monotone_dots(a, b, data):
    polygon_a, polygon_b = flatten(a, 30), flatten(b, 30)
    m, n = len(polygon_a.vertices), len(polygon_b.vertices)
    # Any order of single steps once round both, some of them taken together.
    order = np.array(data.draw(st.permutations([0] * m + [1] * n)))
    steps = np.stack([order == 0, order == 1], axis=1).astype(int)
    i, j = data.draw(st.integers(0, m - 1)), data.draw(st.integers(0, n - 1))
    dots = (np.cumsum(steps, axis=0) + [i, j]) % [m, n]
    if data.draw(st.booleans()):
        change = np.append(False, order[1:] != order[:-1])
        change[1:] &= ~change[:-1]
        dots = dots[~np.roll(change, -1)]
    common = common_segments(a, polygon_a, b, polygon_b, dots)
    again = common_segments(a, polygon_a, b, polygon_b, dots)
    assert (common.start.segments == again.start.segments).all()
    assert (common.end.segments == again.end.segments).all()
    assert_both_ends_are_the_drawings(common, a, b)
    assert_all_nodes_stay(common, a, b)
    for line_a, line_b in zip(
        common.start.segments[common.start.straight], common.end.segments[common.start.straight], strict=True
    ):
        for line in (line_a, line_b):
            np.testing.assert_allclose(line, cubics.line(line[0], line[3]), atol=1e-9)


@given(st.permutations([0] * 24 + [1] * 24))
def test_the_track_is_monotone_and_keeps_close_to_the_dots(order):
    a, b = rounded_square(), polygon_contour([0, 3, 3 + 3j, 3j])
    polygon_a, polygon_b = flatten(a, 40), flatten(b, 30)
    m, n = len(polygon_a.vertices), len(polygon_b.vertices)
    order = np.concatenate([order, np.zeros(m - 24, int), np.ones(n - 24, int)])
    dots = np.cumsum(np.stack([order == 0, order == 1], axis=1), axis=0) % [m, n]
    track = match_continuously(parametrize(a, polygon_a), parametrize(b, polygon_b), dots)
    steps = np.diff(track.positions, axis=0)
    assert (steps >= 0).all()
    # No curve is cut short: where one side is led elsewhere, by a few edges at most.
    assert steps.max() <= 4.0
    np.testing.assert_allclose(track.positions[-1] - track.positions[0], [m, n])


def test_a_corner_led_to_a_corner_that_stands_still_keeps_what_grows_out_of_it():
    a, b = polygon_contour([0, 3, 1.5 + 2.5j]), polygon_contour([0, 3, 3 + 3j, 3j])
    polygon_a = Polygon(*_even(a, 30), True)
    polygon_b = Polygon(*_even(b, 10), True)
    before = [[i, min(i, 9)] for i in range(31)]
    stand = [[i, 10] for i in range(31, 51)]
    after = [[i, min(i - 40, 39)] for i in range(51, 90)]
    track = match_continuously(
        parametrize(a, polygon_a), parametrize(b, polygon_b), np.array(before + stand + after)
    )
    assert ([30, 10] == track.positions[track.fixed]).all(axis=1).any()
    assert np.diff(track.positions, axis=0).max() <= 1.0


def _even(contour, pieces):
    """Vertices, segments and parameters, so many to a segment."""
    segment = np.repeat(np.arange(len(contour.segments)), pieces)
    parameter = np.tile(np.arange(pieces) / pieces, len(contour.segments))
    return cubics.evaluate(contour.segments[segment], parameter), segment, parameter
