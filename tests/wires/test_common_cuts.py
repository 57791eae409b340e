"""Outlines cut at places that correspond: nothing of the drawings is lost, and what grows grows evenly."""

from pathlib import Path

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st

from shapeblend_cli.geometry import cubics
from shapeblend_cli.geometry.flat_contour import FlatContour
from shapeblend_cli.geometry.flatten import flatten
from shapeblend_cli.interpolate.paths import paths_at
from shapeblend_cli.model import Contour, unroll
from shapeblend_cli.svg.reading.read import read
from shapeblend_cli.wires.common_cuts import solve_with_common_cuts
from tests.support.commands import contours as reported
from tests.support.contours import circle_contour, drawing, polygon_contour, polyline
from tests.support.motions import pair_of
from tests.support.solver import match_of
from tests.support.strategies import contours

TIMES = np.linspace(0.0, 1.0, 11)
SQUARE = polygon_contour([-1 - 1j, 1 - 1j, 1 + 1j, -1 + 1j])


def flat(contour, vertices=30):
    return FlatContour(contour, flatten(contour, vertices))


def assert_cut_of(cut, whole):
    """The polygon of a contour with more vertices: on the curves, in order, and nothing is lost."""
    polygon, segments = cut.polygon, whole.contour.segments
    assert cut.contour is whole.contour
    assert polygon.closed == whole.polygon.closed
    assert polygon.vertices[0] == whole.polygon.vertices[0]
    rows = [np.column_stack([p.segment, p.parameter, p.vertices]) for p in (whole.polygon, polygon)]
    assert set(map(tuple, rows[0].tolist())) <= set(map(tuple, rows[1].tolist()))
    on_curve = cubics.evaluate(segments[polygon.segment], polygon.parameter)
    np.testing.assert_allclose(polygon.vertices, on_curve, atol=1e-9 * abs(segments).max())
    assert (np.diff(polygon.segment + polygon.parameter) > 0.0).all()
    assert (np.diff(cut.lengths) > 0.0).all()
    # What the solver needs: no two neighbours are equal.
    edges = np.diff(np.append(polygon.vertices, polygon.vertices[0]) if polygon.closed else polygon.vertices)
    assert abs(edges).min() > 0.0


@given(contours(), st.lists(st.floats(0.0, 1.0), max_size=40))
def test_cuts_lie_on_the_curves_between_the_vertices_there_are(contour, places):
    whole = flat(contour)
    cut = whole.cut_at(np.array(places))
    assert_cut_of(cut, whole)
    assert (
        len(whole.polygon.vertices) <= len(cut.polygon.vertices) <= len(whole.polygon.vertices) + len(places)
    )


def test_a_segment_that_is_a_point_is_passed_over():
    circle = circle_contour(arcs=4).segments
    still = np.full((1, 4), circle[2, 0])
    whole = flat(Contour(np.concatenate([circle[:2], still, circle[2:]]), np.zeros(5, bool), True), 12)
    cut = whole.cut_at(np.linspace(0.0, 1.0, 60))
    assert_cut_of(cut, whole)
    assert abs(cut.polygon.vertices) == pytest.approx(1.0, abs=1e-3)


@given(st.booleans().flatmap(lambda closed: st.tuples(contours(closed), contours(closed))))
def test_both_are_cut_and_the_path_goes_through_all_of_it(pair):
    a, b = (flat(contour) for contour in pair)
    match = match_of(a, b)
    cut_a, cut_b, found = solve_with_common_cuts(match)
    assert_cut_of(cut_a, a)
    assert_cut_of(cut_b, b)
    counts = len(cut_a.polygon.vertices), len(cut_b.polygon.vertices)
    steps = np.diff(unroll(found.dots, counts if a.polygon.closed else None), axis=0)
    assert set(map(tuple, steps.astype(int).tolist())) <= {(1, 0), (0, 1), (1, 1)}
    assert [set(side.tolist()) for side in found.dots.T] == [set(range(count)) for count in counts]
    assert match.wires(cut_a, cut_b).path_work(found.dots).total == pytest.approx(found.work)
    assert 0.0 <= found.gap < 1.0
    assert solve_with_common_cuts(match_of(a, b, effort="exact")).correspondence.gap == 0.0


def test_the_same_outline_cut_unlike_corresponds_vertex_by_vertex():
    """Two polygons of a circle, of other counts and begun elsewhere: a step takes an edge to an edge."""
    a, b = drawing(circle_contour(arcs=4)), drawing(circle_contour(arcs=7, turn=0.3))
    (found,) = pair_of(a, b, motion="linear").contours
    steps = np.diff(found.correspondence.dots, axis=0) % (
        len(found.polygon_a.vertices),
        len(found.polygon_b.vertices),
    )
    assert (steps == 1).all(axis=1).mean() > 0.9
    p, q = (
        polygon.vertices[side]
        for polygon, side in zip((found.polygon_a, found.polygon_b), found.correspondence.dots.T, strict=True)
    )
    assert abs(p - q).max() < 0.05


def in_betweens(a, b, **settings):
    """The outline at several times, as shapely's, curves in 20 pieces."""
    (shape,) = pair_of(a, b, motion="linear", **settings).shapes
    for t in TIMES:
        (path,) = paths_at(shape, t)
        z = polyline(path, 20)
        yield shapely.Polygon(np.column_stack([z.real, z.imag]))


def not_convex(outline):
    """The share of the convex hull that is not in the outline."""
    return 1.0 - outline.area / outline.convex_hull.area


def unlike(outline, other):
    return outline.symmetric_difference(other).area / outline.area


@pytest.mark.parametrize(("vertices", "curves"), [(50, True), (200, False), (400, True)])
def test_a_triangle_grows_one_corner_into_a_square(samples, vertices, curves):
    files = (read(str(samples / f"{name}.svg")) for name in ("triangle", "square"))
    for outline in in_betweens(*files, vertices=vertices, curves=curves):
        assert not_convex(outline) < 0.0015
        # Within a thousandth it has four corners, and no more.
        assert len(outline.simplify(0.01 * outline.length**0.5).exterior.coords) <= 5 + 1


def rounded_square(radius=0.4):
    straight, round_ = [], circle_contour(radius=radius, arcs=4).segments
    segments = []
    for k in range(4):
        centre = (1.0 - radius) * (1 + 1j) * 1j**k
        arc = round_[k] + centre
        segments.append(arc)
        straight.append(False)
        segments.append(
            cubics.line(arc[3], round_[(k + 1) % 4][0] + (1.0 - radius) * (1 + 1j) * 1j ** (k + 1))
        )
        straight.append(True)
    return Contour(np.array(segments), np.array(straight), True)


@pytest.mark.parametrize("vertices", [50, 400])
def test_a_rounded_square_keeps_its_symmetry_on_its_way_to_a_square(vertices):
    for outline in in_betweens(drawing(rounded_square()), drawing(SQUARE), vertices=vertices):
        assert not_convex(outline) < 1e-3
        # About the middle of an arc it costs hardly more or less where the corner opens.
        assert unlike(outline, shapely.affinity.rotate(outline, 90, origin=(0, 0))) < 0.015
        assert unlike(outline, shapely.affinity.scale(outline, -1, 1, origin=(0, 0))) < 0.015


def wrong_turns(path, degrees=3.0):
    """How many corners turn against the way round."""
    segments = path.segments[abs(np.diff(path.segments, axis=1)).max(axis=1) > 1e-6]
    begin, end = cubics.directions(segments)
    turns = np.angle(np.roll(begin, -1) * end.conj()) * np.sign(cubics.signed_area(segments))
    return int((np.degrees(turns) < -degrees).sum())


@pytest.mark.parametrize(("vertices", "smoothing"), [(50, None), (100, 0.005), (200, 0.005), (400, None)])
def test_an_arm_is_drawn_in_without_stairs(samples, vertices, smoothing):
    files = (read(str(samples / f"{name}.svg")) for name in ("e", "f"))
    (shape,) = pair_of(*files, vertices=vertices, smoothing=smoothing, motion="linear").shapes
    counts = [wrong_turns(paths_at(shape, t)[0]) for t in TIMES]
    assert max(counts) <= max(counts[0], counts[-1])


LETTERS = [str(Path(__file__).parents[2] / "samples" / f"{name}.svg") for name in ("e", "f")]


def test_vertex_numbers_are_those_of_the_report_without_them(here):
    (free,) = reported(*LETTERS, "-n", "0")
    i, j = free["dots"][40]
    start, pin = [i, j], [(i + 100) % len(free["vertices_a"]), (j + 100) % len(free["vertices_b"])]
    for options, required in (
        (["--start", "{},{}".format(*start)], [start]),
        (["--pin", "{},{}".format(*pin)], [pin]),
        (["--start", "{},{}".format(*start), "--pin", "{},{}".format(*pin)], [start, pin]),
    ):
        (found,) = reported(*LETTERS, "-n", "0", *options)
        for side in ("vertices_a", "vertices_b"):
            assert found[side] == free[side]
        assert all(dot in found["dots"] for dot in required)
        assert found["start"] == found["dots"][0]
        if "--start" in options:
            assert found["start"] == start
        assert found["work"] >= free["lower_bound"] * (1 - 1e-9)
        assert found["lower_bound"] <= free["work"] * (1 + 1e-9)


def test_points_are_pinned_wherever_outlines_are_cut(here):
    """The nearest vertices to two points correspond, with any number of vertices."""
    for vertices in ("50", "200"):
        (free,) = reported(*LETTERS, "-n", "0", "--vertices", vertices)
        a, b = free["vertices_a"][3], free["vertices_b"][7]
        pin = "{},{}:{},{}".format(*a, *b)
        (found,) = reported(*LETTERS, "-n", "0", "--vertices", vertices, "--pin", pin)
        points = [[found["vertices_a"][i], found["vertices_b"][j]] for i, j in found["dots"]]
        far = [abs(complex(*p) - complex(*a)) + abs(complex(*q) - complex(*b)) for p, q in points]
        assert min(far) < 0.02 * max(free["scale_a"], free["scale_b"])
