"""The graph: its path, its shades, and figures 23 to 25 as one can read them."""

from pathlib import Path

import numpy as np
import pytest

from shapeblend_cli.cli import run
from shapeblend_cli.plot import graph
from shapeblend_cli.plot.axes import LEFT, TOP
from tests.plot.conftest import LINES, pieces, points, words

GOLDEN = Path(__file__).parent / "golden" / "triangle-to-square.svg"


def drawn_dots(text, columns, rows):
    """The columns and rows of the path as it is drawn; the legend has another, of two points."""
    line = max((points(e.get("d")) for e in pieces(text, "path")), key=len)
    corners = np.array(points(pieces(text, "frame")[0].get("d")))
    places = (np.array(line) - complex(LEFT, TOP)) / 1.0
    width, height = np.ptp(corners.real), np.ptp(corners.imag)
    cells = np.stack([places.real * columns / width, places.imag * rows / height], axis=1) - 0.5
    assert np.abs(cells - cells.round()).max() < 0.25
    return cells.round().astype(int)


@pytest.mark.parametrize("drawings", [("triangle", "square"), ("e", "f"), ("cow", "deer"), LINES])
def test_the_path_that_is_drawn_is_the_correspondence(subject_of, drawings):
    subject = subject_of(*drawings, vertices=0 if drawings == LINES else 200)
    found, (columns, rows) = subject.correspondence.dots, graph.shape_of(subject)
    dots = drawn_dots(graph.draw(subject), columns, rows)
    assert dots[[0, -1]].tolist() == [[0, 0], [columns - 1, rows - 1]]
    vertices = (dots + found[0]) % (subject.wires.m, subject.wires.n)
    assert vertices[: len(found)].tolist() == found.tolist()
    assert len(dots) == len(found) + subject.correspondence.closed


@pytest.mark.parametrize(
    "settings", [{}, {"band": 0.1}, {"solver": "simplified"}, {"start": (3, 40)}, {"preset": "paper"}]
)
def test_no_dot_costs_less_than_the_path_and_its_own_cost_nothing_more(subject_of, settings):
    subject = subject_of("bird-1", "bird-2", **settings)
    more = graph.shade_of(subject).more
    path = graph.unrolled(subject)
    assert (more >= 0.0).all()
    assert (more[path[:, 0], path[:, 1]] == 0.0).all()
    assert np.isinf(more).any()
    assert more[np.isfinite(more)].max() > subject.correspondence.work


def test_shades_come_in_levels_that_rise(subject_of):
    levels = graph.shade_of(subject_of("cow", "deer")).levels
    assert len(levels) == len(graph.SHADES) - 1
    assert (np.diff(levels) > 0.0).all()
    assert graph.levels_of(np.zeros((3, 3)), 8) == (1.0,)


def test_rectangles_cover_a_mask_once(rng):
    for share in (0.0, 0.3, 0.9, 1.0):
        mask = rng.random((13, 17)) < share
        covered = np.zeros(mask.shape, int)
        for column, row, columns, rows in graph.rectangles(mask):
            covered[column : column + columns, row : row + rows] += 1
        assert (covered == mask).all()
    assert graph.rectangles(np.ones((5, 4), bool)) == [(0, 0, 5, 4)]


def test_a_cell_of_several_dots_is_the_cheapest_of_them(rng):
    more = rng.random((500, 3))
    least, (across, down) = graph.cells(more)
    assert least.shape == (graph.MOST_CELLS, 3)
    assert (across[-1], down.tolist()) == (500, [0, 1, 2, 3])
    assert least[7, 2] == more[across[7] : across[8], 2].min()


def test_what_is_said_of_the_work(subject_of):
    subject = subject_of("e", "f", band=0.1)
    found = subject.correspondence
    text = graph.draw(subject)
    line = next(line for line in words(text) if line.startswith("work"))
    numbers = [float(w) for w in line.replace("in a band of", "").split() if w[0].isdigit() and ";" not in w]
    expected = [found.work, found.stretching, found.bending, found.diagonal_deviation, 0.1]
    assert numbers == pytest.approx(expected, rel=1e-3)
    assert {"no path", "band", "least-work path", "vertex of A", "vertex of B"} <= set(words(text))
    assert len(text) < 300_000


def test_golden_triangle_to_square(samples, tmp_path, request):
    # Section 3.4 with k_s = 0.4 and k_b = 0.6: figure 24's blend, 1.88, is the cheaper one.
    files = [str(samples / f"{name}.svg") for name in ("triangle", "square")]
    constants = "--preset paper --ks 0.4 --kb 0.6 --es 1 --eb 1 --mb 0 --vertices 0".split()
    assert run(["plot", "graph", *files, *constants, "-o", str(tmp_path / "graph.svg")]) == 0
    text = (tmp_path / "graph.svg").read_text(encoding="utf-8")
    if request.config.getoption("--update-golden"):
        GOLDEN.parent.mkdir(exist_ok=True)
        GOLDEN.write_text(text, encoding="utf-8")
    assert text == GOLDEN.read_text(encoding="utf-8")
    assert any(line.startswith("work 1.88") for line in words(text))
