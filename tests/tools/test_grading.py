import numpy as np

from shapeblend_cli.grading.measures import NAMES
from shapeblend_cli.grading.trees import forest
from tools.grading.fit import (
    PAGE,
    WEIGHTS,
    checks_in,
    graded,
    page,
    predicted,
    rank_correlation,
    right_orders,
    weights_file,
)
from tools.grading.strips import strips


def test_weights_and_their_page_are_those_that_the_grades_give():
    rows = graded()
    written = WEIGHTS.read_text()
    assert [line.strip() for line in weights_file(rows).splitlines() if "=" in line] == [
        line.strip() for line in written.splitlines() if "=" in line
    ]
    measured, checks = checks_in(PAGE.read_text())
    assert measured == len(strips().grades)
    assert PAGE.read_text() == page(rows, measured, checks)


def test_trees_are_those_of_the_strips():
    rows = strips()
    assert forest().places.max() <= len(NAMES)  # the last value is the sum of faults
    told = np.array([forest().tell(values) for values in rows.values])
    assert rank_correlation(told, rows.grades) > 0.85


def test_grades_of_other_drawings_are_predicted():
    rows = graded()
    grades = predicted(rows)
    for made in ("version 0.1.0", "version 1.0.0"):
        some = rows.are("designers' drawings") & np.array([one == made for one in rows.made])
        assert rank_correlation(grades[some], rows.grades[some]) > 0.75
    some = rows.are("designers' icons") & np.array([one == "version 1.0.0" for one in rows.made])
    assert rank_correlation(grades[some], rows.grades[some]) > 0.8
    right, total = right_orders(rows, grades)
    assert right > 0.7 * total > 500
    right, total = right_orders(rows, grades, least=1.0)
    assert right > 0.77 * total > 600


def test_equal_values_share_their_rank():
    assert rank_correlation([1, 2, 2, 3], [10, 20, 20, 30]) > 0.999
    assert rank_correlation([1, 2, 3], [3, 2, 1]) < -0.999
