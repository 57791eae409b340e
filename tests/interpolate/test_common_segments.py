"""Two outlines as the same cubics and lines: exact at both ends, close to the polygons in between."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from shapeblend_cli.geometry import cubics
from shapeblend_cli.geometry.flatten import flatten
from shapeblend_cli.interpolate.common_segments import TOLERANCE, common_segments
from shapeblend_cli.interpolate.continuous_match import match_continuously
from shapeblend_cli.interpolate.parametrization import CORNER, parametrize
from shapeblend_cli.model import Contour, Polygon, Style
from shapeblend_cli.svg.reading.read import read
from tests.support.contours import circle_contour, drawing, furthest, polygon_contour
from tests.support.motions import pair_of
from tests.support.strategies import contours

FOUR_ARCS = circle_contour(arcs=4)


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


def largest(path):
    contours = [c for shape in read(path).shapes for c in shape.contours]
    return max(contours, key=lambda c: abs(cubics.signed_area(c.segments)))


def outline(segments, closed, pieces=64):
    u = np.arange(pieces) / pieces
    points = cubics.evaluate(segments[:, None, :], u).ravel()
    return np.append(points, segments[0, 0] if closed else segments[-1, 3])


def hausdorff(one, other):
    """The largest distance of either outline's vertices from the other outline, both already dense."""
    return max(furthest(one, other), furthest(other, one))


def bends(segments, closed=True):
    """By how many degrees an outline turns where one segment ends and the next begins."""
    begin, end = cubics.directions(segments)
    turns = np.degrees(np.abs(np.angle(np.roll(begin, -1) * end.conj())))
    return turns if closed else turns[:-1]


class Cut:
    """Two contours cut alike; both ends must be the drawings, with all their nodes."""

    def __init__(self, contour_a, polygon_a, contour_b, polygon_b, dots):
        common = common_segments(contour_a, polygon_a, contour_b, polygon_b, dots)
        self.a, self.b, self.straight = common.start.segments, common.end.segments, common.start.straight
        self.half = 0.5 * (self.a + self.b)
        self.contours = contour_a, contour_b
        self.closed, self.dots = contour_a.closed, dots
        self.vertices = [p.vertices[dots[:, k]] for k, p in enumerate((polygon_a, polygon_b))]
        boxes = [cubics.bounds(contour.segments) for contour in self.contours]
        self.sizes = [max(box.width, box.height) for box in boxes]
        for segments, contour, size in zip((self.a, self.b), self.contours, self.sizes, strict=True):
            assert np.isfinite(segments).all()
            # Chained without a gap.
            assert (segments[1:, 0] == segments[:-1, 3]).all()
            if contour.closed:
                assert segments[0, 0] == segments[-1, 3]
            lines = (outline(z, self.closed, 200) for z in (segments, contour.segments))
            assert hausdorff(*lines) <= 1e-4 * size
            apart = np.abs(segments[:, [0, 3], None] - contour.segments[:, 0])
            assert apart.min(axis=(0, 1)).max() <= 1e-8 * size

    def distance_to_polygons(self):
        """The largest distance from the polygons' in-betweens, as a share of the larger outline."""
        far = []
        for t in (0.25, 0.5, 0.75):
            polygon = (1 - t) * self.vertices[0] + t * self.vertices[1]
            if self.closed:
                polygon = np.append(polygon, polygon[0])
            far.append(hausdorff(outline((1 - t) * self.a + t * self.b, self.closed), polygon))
        return max(far) / max(self.sizes)

    def smooth_bends(self):
        """Those at half time where both drawings are smooth."""
        smooth = [bends(segments, self.closed) < np.degrees(CORNER) for segments in (self.a, self.b)]
        return bends(self.half, self.closed)[smooth[0] & smooth[1]]


def cut(a, b, vertices=120, **settings):
    """Two contours cut by what is matched; B is reversed if A runs the other way."""
    style = Style() if a.closed else Style(fill=None, stroke="#000000")
    drawings = [drawing(contour, style=style) for contour in (a, b)]
    (found,) = pair_of(*drawings, vertices=vertices, motion="linear", **settings).contours
    return Cut(found.contour_a, found.polygon_a, found.contour_b, found.polygon_b, found.correspondence.dots)


SAMPLES = (
    ("e", "f"),
    ("bird-1", "bird-2"),
    ("dancer-1", "dancer-2"),
    ("triangle", "square"),
    ("cow", "deer"),
)


@pytest.mark.parametrize("names", SAMPLES, ids="-".join)
def test_promises_on_the_samples(names, samples):
    common = cut(*(largest(samples / f"{name}.svg") for name in names), 200)
    assert len(common.a) <= 1.2 * sum(len(contour.segments) for contour in common.contours)
    # The tolerance is promised beside the polygons without the solver's stairs, which may add half an edge.
    assert common.distance_to_polygons() <= 6.0 * TOLERANCE


@pytest.mark.parametrize("contour", [FOUR_ARCS, rounded_square(), polygon_contour([0, 4, 4 + 3j, 3j])])
def test_an_outline_becomes_itself_unchanged(contour):
    polygon = flatten(contour, 50)
    dots = np.repeat(np.arange(len(polygon.vertices))[:, None], 2, axis=1)
    common = Cut(contour, polygon, contour, polygon, dots)
    np.testing.assert_allclose(common.a, contour.segments, atol=1e-12)
    np.testing.assert_allclose(common.b, contour.segments, atol=1e-12)
    assert common.straight.tolist() == contour.straight.tolist()


@pytest.mark.parametrize("turn", [0.0, 0.1, np.pi / 4])
def test_a_circle_becomes_a_circle_in_few_cubics(turn):
    common = cut(circle_contour(arcs=4, turn=turn), circle_contour(radius=2.0, arcs=4))
    assert 4 <= len(common.a) <= 8
    assert np.ptp(np.abs(outline(common.half, True))) <= 3 * TOLERANCE * 4
    assert common.smooth_bends().max() <= 1.0


@pytest.mark.parametrize(("preset", "most"), [("paper", 16), (None, 24)])
def test_a_square_becomes_a_rounded_square(preset, most):
    common = cut(polygon_contour([-1 - 1j, 1 - 1j, 1 + 1j, -1 + 1j]), rounded_square(), preset=preset)
    assert len(common.a) <= most
    # The sides stay lines; the corners open into curves.
    assert common.straight.sum() >= 4
    for line in common.half[common.straight]:
        np.testing.assert_allclose(line, cubics.line(line[0], line[3]), atol=1e-12)
    assert common.distance_to_polygons() <= 3 * TOLERANCE


def test_a_rounded_square_and_a_circle_stay_smooth():
    found = cut(rounded_square(radius=0.5), circle_contour(), 200).smooth_bends()
    assert len(found) >= 8
    assert found.max() <= 3.0


@pytest.mark.parametrize(
    ("names", "preset"),
    [
        (("bird-1", "bird-2"), "paper"),
        (("dancer-1", "dancer-2"), None),
        (("cow", "deer"), None),
        (("bird-1", "bird-2"), None),
    ],
)
def test_smooth_drawings_bend_little_at_half_time(samples, names, preset):
    found = cut(*(largest(samples / f"{name}.svg") for name in names), 200, preset=preset).smooth_bends()
    assert np.median(found) <= 1.0
    assert np.mean(found > 3.0) <= 0.2


def test_corners_go_to_corners():
    """Also where the solver missed them by a vertex."""
    a = polygon_contour([0, 4, 4 + 4j, 4j])
    b = polygon_contour(np.array([0, 4, 4 + 4j, 4j]) * np.exp(0.2j))
    steps = np.arange(80)
    dots = np.concatenate([[[0, 0], [0, 1]], np.stack([steps[1:79], steps[2:80]], axis=1), [[79, 79]]])
    common = Cut(a, flatten(a, 80), b, flatten(b, 80), dots)
    for corner_a, corner_b in zip(a.segments[:, 0], b.segments[:, 0], strict=True):
        assert common.b[common.a[:, 0] == corner_a, 0] == pytest.approx([corner_b])
    assert common.straight.all()
    assert (bends(common.half) > 80.0).sum() == 4


def test_a_circle_becomes_a_star():
    star = polygon_contour(np.exp(2j * np.pi * np.arange(10) / 10) * np.tile([1.0, 0.45], 5))
    common = cut(FOUR_ARCS, star)
    # Each of the star's corners is one in between as well.
    assert (bends(common.half) > 20.0).sum() >= 10
    assert not common.straight.any()
    assert common.distance_to_polygons() <= 5 * TOLERANCE


def test_a_point_grows_into_the_whole_outline():
    whole = rounded_square()
    polygon = flatten(whole, 40)
    point = Polygon([3 + 4j], [0], [0.0], True)
    contour = Contour(np.full((1, 4), 3 + 4j), [True], True)
    dots = np.stack([np.zeros(len(polygon.vertices), int), np.arange(len(polygon.vertices))], axis=1)
    common = Cut(contour, point, whole, polygon, dots)
    back = Cut(whole, polygon, contour, point, dots[:, ::-1])
    for still, grown in ((common.a, common.b), (back.b, back.a)):
        assert (still == 3 + 4j).all()
        assert (grown == whole.segments).all()
    assert back.straight.tolist() == whole.straight.tolist()


def test_a_loop_of_a_single_segment():
    loop = Contour([[0, 4 + 3j, -4 + 3j, 0]], [False], True)
    assert cut(loop, FOUR_ARCS).a[0, 0] == 0


def test_open_outlines_keep_their_ends():
    a = Contour([[0, 1 + 2j, 3 + 2j, 4], cubics.line(4, 8)], [False, True], False)
    b = Contour([[0, 2 - 2j, 6 - 2j, 8 + 1j]], [False], False)
    common = cut(a, b, 60)
    assert (common.a[0, 0], common.a[-1, 3]) == (0, 8)
    assert (common.b[0, 0], common.b[-1, 3]) == (0, 8 + 1j)
    assert common.distance_to_polygons() <= 3 * TOLERANCE


def test_a_corner_waits_while_a_whole_side_grows_out_of_it():
    """A point matched with lines and arcs: lines stay straight, and nothing of the other outline is lost."""
    a, b = polygon_contour([0, 4, 4j]), rounded_square(2.0, 0.5, 2 + 2j)
    polygon_a, polygon_b = flatten(a, 30), flatten(b, 60)
    m, n = len(polygon_a.vertices), len(polygon_b.vertices)
    before = [[0, j] for j in range(n // 2)]
    after = [[m - 1, j] for j in range(n // 2, n)]
    dots = np.array([*before, *([i, n // 2] for i in range(m)), *after])
    common = Cut(a, polygon_a, b, polygon_b, dots)
    waits = np.abs(np.diff(common.a, axis=1)).max(axis=1) == 0.0
    assert waits.sum() >= 2
    assert common.straight[waits].any()


def test_polygons_stay_polygons():
    """Where all vertices are nodes, the in-between is the polygons', a segment for every step."""
    rng = np.random.default_rng(7)
    nodes = [np.exp(2j * np.pi * np.arange(m) / m) * rng.uniform(1, 1.3, m) for m in (90, 100)]
    common = cut(*(polygon_contour(z) for z in nodes), 0)
    assert common.straight.all()
    assert len(common.a) == len(common.dots)
    assert common.distance_to_polygons() <= 1e-9


def test_joined_segments_and_dots_that_repeat_are_not_lost():
    """Nodes that coincide are left out of polygons; the segments beside them must stay whole."""
    circle = FOUR_ARCS.segments
    still = np.full((1, 4), circle[2, 0])
    cut(Contour(np.concatenate([circle[:2], still, circle[2:]]), np.zeros(5, bool), True), rounded_square())


@settings(max_examples=12)  # each has many choices
@given(contours(closed=True), contours(closed=True), st.data())
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
    common = Cut(a, polygon_a, b, polygon_b, dots)
    again = common_segments(a, polygon_a, b, polygon_b, dots)
    assert (common.a == again.start.segments).all()
    assert (common.b == again.end.segments).all()
    for line in [*common.a[common.straight], *common.b[common.straight]]:
        np.testing.assert_allclose(line, cubics.line(line[0], line[3]), atol=1e-9)


@given(st.permutations([0] * 24 + [1] * 24))
def test_the_match_is_monotone_and_keeps_close_to_the_dots(order):
    a, b = rounded_square(), polygon_contour([0, 3, 3 + 3j, 3j])
    polygon_a, polygon_b = flatten(a, 40), flatten(b, 30)
    m, n = len(polygon_a.vertices), len(polygon_b.vertices)
    order = np.concatenate([order, np.zeros(m - 24, int), np.ones(n - 24, int)])
    dots = np.cumsum(np.stack([order == 0, order == 1], axis=1), axis=0) % [m, n]
    match = match_continuously(parametrize(a, polygon_a), parametrize(b, polygon_b), dots)
    steps = np.diff(match.positions, axis=0)
    assert (steps >= 0).all()
    # No curve is cut short: where one side is led elsewhere, by a few edges at most.
    assert steps.max() <= 4.0
    np.testing.assert_allclose(match.positions[-1] - match.positions[0], [m, n])


def evenly_flattened(contour, pieces):
    """A polygon of so many edges to a segment."""
    segment = np.repeat(np.arange(len(contour.segments)), pieces)
    parameter = np.tile(np.arange(pieces) / pieces, len(contour.segments))
    return Polygon(cubics.evaluate(contour.segments[segment], parameter), segment, parameter, True)


def test_a_corner_matched_with_a_held_corner_keeps_what_grows_out_of_it():
    a, b = polygon_contour([0, 3, 1.5 + 2.5j]), polygon_contour([0, 3, 3 + 3j, 3j])
    parameters = parametrize(a, evenly_flattened(a, 30)), parametrize(b, evenly_flattened(b, 10))
    before = [[i, min(i, 9)] for i in range(31)]
    hold = [[i, 10] for i in range(31, 51)]
    after = [[i, min(i - 40, 39)] for i in range(51, 90)]
    match = match_continuously(*parameters, np.array(before + hold + after))
    assert ([30, 10] == match.positions[match.fixed]).all(axis=1).any()
    assert np.diff(match.positions, axis=0).max() <= 1.0


def test_of_two_corners_beside_one_only_the_nearer_is_matched_with_it():
    a, b = (polygon_contour(z, closed=False) for z in ([0, 4, 6 + 1j, 6 + 6j], [0, 5, 5 + 5j]))
    parameters = (parametrize(line, flatten(line, 11)) for line in (a, b))
    match = match_continuously(*parameters, np.arange(11)[:, None].repeat(2, axis=1))
    assert match.positions[match.fixed].tolist() == [[0, 0], [4, 5], [10, 10]]
