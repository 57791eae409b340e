"""What mirrors itself in both drawings does so on the way."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from shapeblend_cli.geometry import cubics
from shapeblend_cli.geometry.flat_contour import FlatContour
from shapeblend_cli.geometry.flatten import flatten
from shapeblend_cli.interpolate.paths import paths_at
from shapeblend_cli.svg.reading.read import read
from shapeblend_cli.wires.symmetry import TOLERANCE, Axis, CutsMeet, common_axes, cut_in_parts
from tests.support.contours import polygon_contour
from tests.support.drawings import drawing, svg
from tests.support.motions import pair_of

TIMES = np.linspace(0.0, 1.0, 9)

HEART = (
    "M50 90C20 65 10 50 10 33C10 18 21 10 31 10C40 10 47 15 50 22"
    "C53 15 60 10 69 10C79 10 90 18 90 33C90 50 80 65 50 90Z"
)
STAR = "M50 8L61 38L93 38L67 58L77 90L50 71L23 90L33 58L7 38L39 38Z"
SMILE = "M20 50C30 80 70 80 80 50C70 62 30 62 20 50Z"
FROWN = "M80 75C70 45 30 45 20 75C30 63 70 63 80 75Z"
UP = "M20 60L50 30L80 60L74 66L50 42L26 66Z"
DOWN = "M20 40L26 34L50 58L74 34L80 40L50 70Z"
TRIANGLE, SQUARE = "M50 10L90 80H10Z", "M15 15H85V85H15Z"
BUG = "M50 5C60 5 62 12 60 20L85 10L66 30L90 50L66 55L80 85L50 95L20 85L34 55L10 50L34 30L15 10L40 20C38 12 40 5 50 5Z"
ARROW = "M10 40H60V20L90 50L60 80V60H10Z"
"""It points right: its axis is level."""
DROP = "M90 50L50 30C30 20 10 30 10 50C10 70 30 80 50 70Z"
CROSS = "M40 10H60V40H90V60H60V90H40V60H10V40H40Z"
LENS = "M50 5C70 25 70 75 50 95C30 75 30 25 50 5Z"
FIVE = "M20 10H80V25H38V45C80 40 90 90 40 90H20V75H45C70 75 60 50 20 60Z"


def blended(a, b, tmp_path, **options):
    files = []
    for name, path in (("a", a), ("b", b)):
        file = tmp_path / f"{name}.svg"
        file.write_text(svg(f'<path d="{path}"/>'))
        files.append(read(str(file)))
    (shape,) = pair_of(*files, **options).shapes
    return shape


def off_mirror(path, level=False):
    """How far the mirror image of a path is from it, as a share of its size."""
    fine = np.concatenate(
        [cubics.evaluate(path.segments, np.full(len(path.segments), u)) for u in np.arange(41) / 40]
    )
    if level:
        fine = fine * 1j
    x = fine.real
    image = (x.max() + x.min() - x) + 1j * fine.imag
    away = np.abs(image[:, None] - fine).min(axis=1).max()
    return away / max(np.ptp(x), np.ptp(fine.imag))


@pytest.mark.parametrize(
    ("a", "b"), [(HEART, STAR), (SMILE, FROWN), (UP, DOWN), (TRIANGLE, SQUARE), (STAR, BUG), (BUG, HEART)]
)
def test_what_has_an_upright_axis_at_both_ends_has_it_on_the_way(a, b, tmp_path):
    # What is the other one upside down may also be turned, which is another motion.
    motion = "linear" if a in (SMILE, UP) else "auto"
    for first, second in ((a, b), (b, a)):
        shape = blended(first, second, tmp_path, motion=motion)
        assert max(off_mirror(paths_at(shape, t)[0]) for t in TIMES) < 0.02


LINES = {
    "V": "M20 20L50 80L80 20",
    "U": "M20 20V50A30 30 0 0 0 80 50V20",
    "smile": "M20 50Q50 80 80 50",
    "frown": "M20 70C35 40 65 40 80 70",
    "hat": "M10 70H30V20H70V70H90",
}


@pytest.mark.parametrize(("a", "b"), [("V", "U"), ("smile", "frown"), ("hat", "V"), ("U", "hat")])
@pytest.mark.parametrize("motion", ["auto", "linear"])
def test_a_line_that_mirrors_itself_at_both_ends_does_so_on_the_way(a, b, motion, tmp_path):
    files = []
    for name in (a, b):
        file = tmp_path / f"{name}.svg"
        file.write_text(svg(f'<path d="{LINES[name]}" fill="none" stroke="#000"/>'))
        files.append(read(str(file)))
    for pair in (files, files[::-1]):
        (shape,) = pair_of(*pair, motion=motion).shapes
        assert max(off_mirror(paths_at(shape, t)[0]) for t in TIMES) < 0.02
        contour = shape.contours[0].correspondence
        assert contour.lower_bound <= contour.work * (1 + 1e-9)


@pytest.mark.parametrize("vertices", [50, 400])
def test_it_does_so_with_any_number_of_vertices(vertices, tmp_path):
    shape = blended(HEART, STAR, tmp_path, vertices=vertices, motion="linear")
    assert max(off_mirror(paths_at(shape, t)[0]) for t in TIMES) < 0.02


def test_a_level_axis_is_kept_too(tmp_path):
    shape = blended(ARROW, DROP, tmp_path, motion="linear")
    assert max(off_mirror(paths_at(shape, t)[0], level=True) for t in TIMES) < 0.02


def test_two_axes_are_kept(tmp_path):
    for a, b in ((SQUARE, CROSS), (CROSS, LENS)):
        shape = blended(a, b, tmp_path, motion="linear")
        for t in TIMES:
            path = paths_at(shape, t)[0]
            assert off_mirror(path) < 0.02
            assert off_mirror(path, level=True) < 0.02


def test_the_bound_is_that_of_all_matches_and_not_far(tmp_path):
    for a, b in ((HEART, STAR), (UP, DOWN), (TRIANGLE, SQUARE)):
        found = blended(a, b, tmp_path).contours[0].correspondence
        assert 0.0 < found.lower_bound <= found.work
        assert found.gap < 0.3


def test_no_axis_no_change(tmp_path):
    for a, b in ((HEART, FIVE), (HEART, DROP)):
        assert blended(a, b, tmp_path).contours[0].correspondence.gap == pytest.approx(0.0, abs=1e-9)


def test_a_pin_has_its_way(tmp_path):
    # The tip of the heart is asked to become the right foot of the star.
    shape = blended(HEART, STAR, tmp_path, pins=[(50 + 90j, 77 + 90j)], motion="linear")
    start, end = (path.segments[:, 0] for path in (shape.contours[0].start, shape.contours[0].end))
    assert abs(end[abs(start - (50 + 90j)).argmin()] - (77 + 90j)) < 1e-6


def symmetric(heights, nodes):
    """A closed outline about the upright axis x = 0 whose two halves have further nodes of their own."""
    y = np.linspace(-1.0, 1.0, len(heights))
    right = np.array(heights) + 1j * y
    points = np.concatenate([[-1.3j], right, [1.3j], -right[::-1].conj()])
    cut = []
    for k, point in enumerate(points):
        cut.append(point)
        if nodes[k % len(nodes)]:
            cut.append(point + 0.37 * (points[(k + 1) % len(points)] - point))
    return np.array(cut)


@given(
    st.lists(st.floats(0.4, 1.5), min_size=2, max_size=7),
    st.lists(st.booleans(), min_size=3, max_size=11),
    st.integers(0, 30),
    st.sampled_from([0, 40, 90]),
)
def test_halves_mirror_each_other_and_have_all_nodes(heights, nodes, first, vertices):
    outline = symmetric(heights, nodes)
    contour = polygon_contour(np.roll(outline, first))
    flat = FlatContour(contour, flatten(contour, vertices))
    axis, other = common_axes(flat.polygon, flat.polygon)[0]
    assert axis == other
    assert axis.direction == 1j
    parts = cut_in_parts(flat, [axis])
    cut = parts.flat.polygon
    z, (first, second) = cut.vertices, parts.vertices
    assert len(first) == len(second)
    length = abs(np.diff(z, append=z[:1])).sum()
    assert np.abs(z[first] + z[second].conj()).max() < 2.0 * TOLERANCE * length
    # Each runs along the outline, vertex by vertex, from one end of the axis to the other, and together they are it.
    count = len(z)
    assert set(np.diff(first) % count) == {1}
    assert set(np.diff(second) % count) == {count - 1}
    assert len(first) + len(second) == count + 2
    assert first[[0, -1]].tolist() == second[[0, -1]].tolist()
    for node in outline:
        assert np.abs(z - node).min() < 1e-12
    assert np.abs(cut.vertices - cubics.evaluate(contour.segments[cut.segment], cut.parameter)).max() < 1e-9


def test_where_vertices_of_both_halves_would_be_one_another_way_is_taken(tmp_path, monkeypatch):
    def in_one_place(flat, shares):
        return np.full(len(shares), flat.polygon.vertices[0]), *np.zeros((2, len(shares)), np.intp)

    contour = drawing(f'<path d="{HEART}"/>').shapes[0].contours[0]
    flat = FlatContour(contour, flatten(contour, 40))
    with monkeypatch.context() as patched:
        patched.setattr(FlatContour, "points_at", in_one_place)
        with pytest.raises(CutsMeet):
            cut_in_parts(flat, [Axis(1j, (0.13, 0.63))])

    def cut(flat, axes):
        raise CutsMeet

    monkeypatch.setattr("shapeblend_cli.wires.symmetry.cut_in_parts", cut)
    (found,) = blended(HEART, STAR, tmp_path).contours
    assert found.is_matched
