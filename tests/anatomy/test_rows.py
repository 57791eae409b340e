from shapeblend_cli.anatomy.rows import rows_of
from tests.support.drawings import SQUARES, contours_of

BARS = "M2 2H22V5H2Z M2 10H22V13H2Z"


def test_outlines_beside_each_other_are_a_row():
    rows = rows_of(contours_of(SQUARES), is_turned=False)
    assert [[contour.number for contour in row.contours] for row in rows] == [[0, 1], [2, 3]]
    columns = rows_of(contours_of(SQUARES), is_turned=True)
    assert [[contour.number for contour in row.contours] for row in columns] == [[0, 2], [1, 3]]


def test_a_row_is_as_wide_as_a_bar_in_its_place_only():
    bar = rows_of(contours_of(BARS), is_turned=False)[0]
    assert all(bar.is_as_wide_as(row) for row in rows_of(contours_of(SQUARES), is_turned=False))
    for other in ("M2 2H12V5H2Z", "M12 2H32V5H12Z"):
        assert not bar.is_as_wide_as(rows_of(contours_of(other), is_turned=False)[0])
