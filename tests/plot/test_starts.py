"""Least work by start."""

import re

import numpy as np
import pytest

from shapeblend_cli.errors import MatchError
from shapeblend_cli.plot import starts
from tests.plot.conftest import LINES, pieces, words
from tests.support.shapes import star_polygon, unit_box
from tests.support.solver import find_least


@pytest.mark.parametrize("vertex", [0, 11])
def test_the_least_is_the_work_of_the_best_start(subject_of, vertex):
    subject = subject_of("triangle", "square", vertices=60, dot=(vertex, 0))
    works = starts.works_of(subject)
    assert works.min() == pytest.approx(subject.correspondence.work, rel=1e-12)
    assert [vertex, int(works.argmin())] in subject.correspondence.dots.tolist()


def test_each_is_what_a_given_start_costs(subject_of):
    subject = subject_of("bird-1", "bird-2", vertices=40, band=0.2, dot=(7, 0), motion="linear")
    works = starts.works_of(subject)
    a, b = (unit_box(p.vertices) for p in (subject.contour.polygon_a, subject.contour.polygon_b))
    for j in range(0, len(b), 9):
        assert works[j] == pytest.approx(find_least(a, b, start=(7, j), band=0.2).work, rel=1e-9)


def test_starts_that_no_path_comes_back_to_are_gaps(subject_of, rng):
    subject = subject_of("e", "f", vertices=60)
    scale = starts.scale_for(np.array([2.0, np.inf, 3.0, 4.0]))
    assert (scale.least, scale.low) == (None, 0.0)
    assert scale.high > 4.0
    with pytest.raises(MatchError, match="a wider band would work"):
        starts.works_of(subject._replace(band=0.0))


def test_works_that_differ_much_are_drawn_by_powers_of_ten():
    works = np.array([1e-13, 2.0, 500.0])
    scale = starts.scale_for(works)
    low, two, most = scale.heights(works)
    assert (low, two, most) == (scale.low, np.log10(2.0), np.log10(500.0))
    assert scale.ticks[0] == (scale.low, 0.0)
    assert scale.low < two < most < scale.high


def test_the_best_start_is_marked_and_named(subject_of):
    subject = subject_of("triangle", "square")
    text = starts.draw(subject)
    (best,) = pieces(text, "best")
    assert len(pieces(text, "work")) == 1
    (line,) = (line for line in words(text) if line.startswith("least with"))
    vertex, work = re.fullmatch(
        r"least with vertex 0 of A at vertex (\d+) of B: work ([\d.]+)", line
    ).groups()
    assert [0, int(vertex)] in subject.correspondence.dots.tolist()
    assert float(work) == pytest.approx(subject.correspondence.work, rel=1e-3)
    assert float(best.get("cy")) > 300.0


@pytest.mark.parametrize(
    ("drawings", "settings", "message"),
    [
        (LINES, {}, "closed ones would work"),
        (("e", "f"), {"vertices": 1700}, "a smaller --vertices would work"),
    ],
)
def test_open_contours_and_too_many_vertices_are_refused(subject_of, drawings, settings, message):
    with pytest.raises(MatchError, match=message):
        starts.works_of(subject_of(*drawings, **settings))


def test_wires_that_begin_elsewhere_price_the_same(rng):
    from shapeblend_cli.matching.work import Wires
    from shapeblend_cli.options.constants import WorkConstants

    p, q, weight = star_polygon(rng, 9), star_polygon(rng, 8), 0.5 + rng.random(9)
    wires = Wires(p, q, True, WorkConstants(), weight)
    rolled = wires.beginning_at(4, 0)
    again = Wires(np.roll(p, -4), q, True, WorkConstants(), np.roll(weight, -4))
    dots = np.array([[k % 9, k % 8] for k in range(8)] + [[8, 7]])
    assert rolled.path_work(dots).total == pytest.approx(again.path_work(dots).total, rel=1e-12)
    assert wires.path_work(dots).total != pytest.approx(again.path_work(dots).total, rel=1e-3)
