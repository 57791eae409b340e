import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from shapeblend_cli.geometry.cubics import evaluate, lengths
from shapeblend_cli.svg.reading import path_commands
from tests.svg.reading.drawings import path_contours, refused


def corners(data):
    """Return the ends of the segments of each contour."""
    contours = path_contours(data)
    return [[complex(c.segments[0, 0]), *map(complex, c.segments[:, 3])] for c in contours]


DATA = {
    "lines": ("M1 2L3 4l1 1H9h1V7v1", [[1 + 2j, 3 + 4j, 4 + 5j, 9 + 5j, 10 + 5j, 10 + 7j, 10 + 8j]]),
    "more points after a moveto": ("m1 1 2 0 0 2", [[1 + 1j, 3 + 1j, 3 + 3j]]),
    "closing line": ("M0 0h2v2z", [[0, 2, 2 + 2j, 0]]),
    "closed already": ("M0 0h2v2L0 0z", [[0, 2, 2 + 2j, 0]]),
    "subpaths": ("M0 0h1M5 5h1", [[0, 1], [5 + 5j, 6 + 5j]]),
    "subpath without a moveto": ("M1 1h1v1zh5", [[1 + 1j, 2 + 1j, 2 + 2j, 1 + 1j], [1 + 1j, 6 + 1j]]),
    "moveto after a closed subpath": (
        "m1 1h1v1zm2 2h1",
        [[1 + 1j, 2 + 1j, 2 + 2j, 1 + 1j], [3 + 3j, 4 + 3j]],
    ),
    "moveto relative to an open subpath": ("m1 1h1m2 2h1", [[1 + 1j, 2 + 1j], [4 + 3j, 5 + 3j]]),
    "moveto relative to a moveto": ("m1 1m1 1m1 1h1", [[3 + 3j, 4 + 3j]]),
    "moveto to the same point": ("M0 0h1M1 0h1", [[0, 1], [1, 2]]),
    "quadratics": ("M0 0Q1 1 2 0T4 0q1 1 2 0t2 0", [[0, 2, 4, 6, 8]]),
    "cubics": ("M0 0C1 1 2 1 3 0S5 1 6 0c1 1 2 1 3 0s2 1 3 0", [[0, 3, 6, 9, 12]]),
    "compact numbers": ("M.5.5-1-1+2e0-1E1", [[0.5 + 0.5j, -1 - 1j, 2 - 10j]]),
    "point before the exponent": ("M1.e1 2.L0,0", [[10 + 2j, 0]]),
    "blanks and commas": ("\n\tM 0 , 0\r\nL1,1 , 2 2 ", [[0, 1 + 1j, 2 + 2j]]),
    "comma at the end": ("M0 0,L1 1,", [[0, 1 + 1j]]),
    "no length": ("M5 5M6 6zM1 1h0L1 1h1h0v1M3 3h0", [[6 + 6j] * 2, [1 + 1j, 2 + 1j, 2 + 2j], [3 + 3j] * 2]),
    "zero radius": ("M0 0A0 5 0 0 1 4 4", [[0, 4 + 4j]]),
    "arc with coincident ends": ("M0 0h1A5 5 0 1 1 1 0v1a2 2 0 0 0 0 0", [[0, 1, 1 + 1j]]),
    "nothing": ("", []),
    "blanks": (" \n", []),
    "none": ("none", []),
}


@pytest.mark.parametrize(("data", "expected"), DATA.values(), ids=DATA)
def test_segments_end_where_the_data_says(data, expected):
    assert corners(data) == expected


@pytest.mark.parametrize(
    ("data", "closed"),
    [
        ("M0 0h1v1", False),
        ("M0 0h1v1z", True),
        ("M0 0h1v1L0 0", True),
        ("M0 0h1v1L1e-12 0", True),
        ("M0 0h1v1L1e-6 0", False),
    ],
)
def test_a_contour_is_closed_by_z_or_where_its_ends_coincide(data, closed):
    (contour,) = path_contours(data)
    assert contour.closed is closed
    assert (contour.segments[0, 0] == contour.segments[-1, 3]) == closed


@pytest.mark.parametrize(
    ("data", "smooth"),
    [
        ("M0 0C1 1 2 1 3 0S5 1 6 0", [3, 4 - 1j, 5 + 1j, 6]),
        ("M0 0A2 2 0 0 1 3 0S5 1 6 0", [3, 3, 5 + 1j, 6]),
    ],
)
def test_smooth_segments_reflect_the_control_point_before_if_there_is_one(data, smooth):
    (contour,) = path_contours(data)
    assert contour.segments[-1].tolist() == smooth


def test_a_quadratic_stays_the_same_curve():
    (contour,) = path_contours("M0 0Q5 8 9 1")
    t = np.linspace(0, 1, 9)
    assert np.allclose(evaluate(contour.segments, t), 2 * t * (1 - t) * (5 + 8j) + t * t * (9 + 1j))


@pytest.mark.parametrize(
    ("flags", "total"), [("0 0", 5), ("0 1", 5), ("1 0", 15), ("1 1", 15), ("01", 5), ("1,1,", 15)]
)
def test_an_arc_takes_the_side_its_flags_say(flags, total):
    (contour,) = path_contours(f"M10 0A10 10 0 {flags} 0 10")
    assert lengths(contour.segments).sum() == pytest.approx(total * np.pi, rel=1e-5)
    assert len(contour.segments) == (2 if total == 5 else 6)


def test_packed_arc_flags():
    ((_, *second),) = corners("M.5.5a1 1 0 1 0 1 3")
    assert corners("M0 0a1 1 0 01.5.5 1 1 0 101 3") == [[0, 0.5 + 0.5j, *second]]


@given(st.floats(0.1, 50), st.floats(0.1, 50), st.floats(-400, 400), st.booleans(), st.booleans())
def test_an_arc_lies_on_its_ellipse(rx, ry, rotation, large, sweep):
    end = 7 - 3j
    (contour,) = path_contours(f"M0 0A{rx} {ry} {rotation} {large:d} {sweep:d} {end.real} {end.imag}")
    assert (contour.segments[0, 0], contour.segments[-1, 3]) == (0, end)
    points = evaluate(contour.segments[:, None, :], np.linspace(0, 1, 9)).ravel()
    points = points * np.exp(-1j * np.radians(rotation))
    circle = points.real / rx + 1j * points.imag / ry
    # Three points give the centre, where the radii were large enough the radius is 1.
    a, b, c = circle[0], circle[len(circle) // 2], circle[-1]
    z = (c - a) / (b - a)
    centre = (b - a) * (z - abs(z) ** 2) / (2j * z.imag) + a
    radius = max(1.0, abs(a - c) / 2)
    assert np.abs(np.abs(circle - centre) - radius).max() < 1e-4 * radius


BROKEN = {
    "L1 1": (0, "found 'L' where it must begin with M"),
    "10 10": (0, "found '1' where it must begin with M"),
    "M0 0 X 5 5": (5, "found 'X 5 5' where a number or a command belongs"),
    "M0 0L1 1 junk": (9, "found 'junk'"),
    "M0 0L1": (4, "found L with 1 number where 2 or a multiple belong"),
    "M": (0, "found M with 0 numbers"),
    "M0 0C1 2 3 4 5": (4, "found C with 5 numbers where 6"),
    "M0 0h": (4, "found h with 0 numbers where 1"),
    "M0 0Lnan 1": (5, "found 'n' where a number or a command belongs"),
    "M0 0L1e999 1": (5, "found 1e999, which is beyond 1e+09"),
    "M0 0L-1e9 1": (5, "found -1e9, which is beyond 1e+09"),
    "M0 0L,1 1": (5, "found ',1 1'"),
    "M0,,0": (2, "found ',,0'"),
    "M0 0z5": (5, "found '5' where a command belongs"),
    "M0 0A1 1 0 2 1 5 5": (5, "where the seven numbers of an arc belong, its flags 0 or 1"),
    "M0 0A1 1 0 0 1 5 5 6": (19, "found '6' where the seven numbers"),
    "M0 0A1 1 0 0 1 1e999 5": (4, "A has a number beyond 1e+09"),
    "M0 0\N{NO-BREAK SPACE}L1 1": (4, r"found '\xa0'"),
    "M1_0 0": (2, "found '_0 0'"),
    "M0 0L1\N{ARABIC-INDIC DIGIT ONE} 0": (6, "found"),
}


@pytest.mark.parametrize(("data", "problem"), BROKEN.items(), ids=BROKEN)
def test_broken_data_is_refused_where_it_breaks(data, problem):
    error = path_commands.scan(data)[1]
    offset, found = problem
    assert error.offset == offset
    assert found in str(error)


def test_the_message_names_the_element():
    message = r"test.svg: path 'p' on line 2: at character 5 of its path data: found '#'"
    refused('\n<path id="p" d="M0 0#"/>', message)
    refused('<polygon points="0 0 x"/>', "polygon on line 1: at character 5 of its points: found 'x'")


def test_what_precedes_an_error_is_kept():
    subpaths, error = path_commands.scan("M0 0h5v5L1")
    assert error is not None
    assert [len(contour.segments) for contour in path_commands.trace(subpaths)] == [2]
    assert path_commands.scan("M0 0h5z")[1] is None


@given(st.text(st.sampled_from("MmLlHhVvCcSsQqTtAaZz0123456789.,+-eE \n#"), max_size=40))
def test_any_text_is_read_or_refused(data):
    subpaths, error = path_commands.scan("M0 0" + data)
    assert error is None or 0 <= error.offset <= len(data) + 4
    for contour in path_commands.trace(subpaths):
        assert np.isfinite(contour.segments).all()
        assert (contour.segments[1:, 0] == contour.segments[:-1, 3]).all()


@given(st.text(max_size=30))
def test_any_other_text_is_read_or_refused(data):
    error = path_commands.scan(data)[1]
    assert error is None or str(error).isprintable()


FORMATS = st.sampled_from(["{!r}", "{:+.17e}", "{:.17g}", "{:.30f}", "{:.17E}"])


@given(
    st.lists(st.tuples(st.floats(-1e6, 1e6), FORMATS), min_size=4, max_size=12),
    st.sampled_from([" ", ",", "\n, "]),
)
def test_numbers_round_trip_however_they_are_written(numbers, separator):
    written = [template.format(value) for value, template in numbers[: len(numbers) // 2 * 2]]
    values, text = list(map(float, written)), separator.join(written)
    points = [complex(x, y) for x, y in zip(values[::2], values[1::2], strict=True)]
    subpaths, error = path_commands.scan("M" + text)
    assert error is None
    assert subpaths[0].move == points[0]
    expected = [p for p, q in zip(points[1:], points, strict=False) if abs(p - q) > 1e-3]
    found = [point for line in corners("M" + text) for point in line[1:]]
    # A line that ends this near its start is closed there.
    near = 1e-9 * max(map(abs, values))
    expected, found = (
        {points[0] if abs(p - points[0]) <= near else p for p in ps} for ps in (expected, found)
    )
    assert expected <= found
