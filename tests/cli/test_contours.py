"""Drawings of several contours, as users blend them."""

import io
import math
import re

import numpy as np
import pytest
import resvg_py
from PIL import Image, ImageDraw

from shapeblend_cli.cli import run
from tests.support.commands import contours, report, write
from tests.support.drawings import BAR, EIGHT, EYED, I_DOT, J_DOT, LEAF, RING, SQUARES, B, svg

EVENODD = 'fill-rule="evenodd"'
RING_BY_DIRECTION = "M12 2A10 10 0 1 0 12 22A10 10 0 1 0 12 2Z M12 6A6 6 0 1 1 12 18A6 6 0 1 1 12 6Z"
SIZE = 120


def files(a, b, rule_a=EVENODD, rule_b=EVENODD):
    write(a=svg(a, attributes=rule_a), b=svg(b, attributes=rule_b))


def blended(*options):
    """What the report says of the contours of a.svg and b.svg."""
    return contours("a.svg", "b.svg", "-n", "0", *options)


def pixels(file):
    """What a frame paints, from 0 to 1, in user units of about 1/5."""
    png = bytes(resvg_py.svg_to_bytes(svg_string=file.read_text(), width=SIZE, background="#ffffff"))
    with Image.open(io.BytesIO(png)) as picture:
        return 1.0 - np.asarray(picture.convert("L"), float) / 255.0


def filled_areas(here, *options, frames=19):
    assert run(["a.svg", "b.svg", "-n", str(frames), "--ends", "-o", "out", "-f", *options]) == 0
    areas = []
    for file in sorted((here / "out").glob("*.svg")):
        width = float(file.read_text().split('viewBox="')[1].split('"')[0].split()[2])
        areas.append(pixels(file).sum() * (math.ceil(width) / SIZE) ** 2)  # resvg rounds a size up
    return np.array(areas)


@pytest.mark.parametrize("rules", [(EVENODD, EVENODD), (EVENODD, ""), ("", EVENODD), ("", "")])
def test_a_ring_stays_a_ring(here, rules):
    files(*(RING if rule else RING_BY_DIRECTION for rule in rules), *rules)
    np.testing.assert_allclose(filled_areas(here), np.pi * (10**2 - 6**2), rtol=0.01)


DRAWN = {"B": B, "8": EIGHT, "i": I_DOT, "j": J_DOT, "eye": EYED, "leaf": LEAF}
DRAWN |= {"ring": RING, "squares": SQUARES, "bar": BAR}


@pytest.mark.parametrize("pair", "B-8 i-j eye-leaf ring-leaf squares-ring bar-B".split())
@pytest.mark.parametrize("unmatched", ["point", "split"])
@pytest.mark.parametrize(("motion", "most"), [("linear", 0.03), ("auto", 0.06)])
def test_what_is_filled_changes_smoothly(here, pair, unmatched, motion, most):
    files(*map(DRAWN.get, pair.split("-")))
    areas = filled_areas(here, "--unmatched", unmatched, "--motion", motion, "--swap", "never")
    # No step is a jump: none is much larger than those beside it, as a share of the larger area. With auto, what has no
    # partner is a speck for a moment only.
    assert np.abs(np.diff(areas, 2)).max() < most * areas.max(), areas.round(1)


def test_b_to_8_keeps_two_holes(here):
    files(B, EIGHT)
    assert [(c["a"], c["b"]) for c in blended()] == [(0, 0), (1, 1), (2, 2)]
    assert run(["a.svg", "b.svg", "-o", "out"]) == 0
    for file in sorted((here / "out").glob("*.svg")):
        assert _white_islands(pixels(file)) == 2


def _white_islands(paint):
    """Connected white regions that do not reach the edge of the picture."""
    white = Image.fromarray(np.pad(paint < 0.5, 1, constant_values=True)).convert("L")
    ImageDraw.floodfill(white, (0, 0), 0)
    found = 0
    while white.getbbox():
        y, x = np.argwhere(np.asarray(white))[0].tolist()
        ImageDraw.floodfill(white, (x, y), 0)
        found += 1
    return found


def test_an_eye_without_a_partner_shrinks_inside(here):
    files(EYED, LEAF)
    (outline, eye) = blended()
    assert (outline["a"], outline["b"], eye["a"], eye["b"]) == (0, 0, 1, None)
    assert len(eye["vertices_b"]) == 1
    assert {j for _, j in eye["dots"]} == {0}
    assert (eye["work"], eye["gap"], eye["sweeps"]) == (0.0, 0.0, 0)
    assert run(["a.svg", "b.svg", "-n", "9", "-o", "out"]) == 0
    islands = [_white_islands(pixels(file)) for file in sorted((here / "out").glob("*.svg"))[:-1]]
    assert islands[:3] == [1] * 3
    assert islands == sorted(islands, reverse=True), "it comes back"


def test_the_frames_at_the_ends_have_no_contours_of_a_point(here):
    files(EYED, LEAF)
    assert run(["a.svg", "b.svg", "-n", "1", "--ends", "-o", "out"]) == 0
    assert [(here / f"out/frame-{k}.svg").read_text().count("M") for k in (1, 2, 3)] == [2, 2, 1]


def test_an_animation_has_the_point_a_contour_grows_from(here):
    files(LEAF, EYED)
    assert run(["a.svg", "b.svg", "-o", "moving.svg"]) == 0
    (values,) = re.findall(r'values="(M[^"]*)"', (here / "moving.svg").read_text())
    paths = values.split(";")
    assert {path.count("M") for path in paths} == {2}
    assert len({len(re.findall(r"[\d.]+", path)) for path in paths}) == 1


def test_a_stroke_that_grows_grows_in_width(here):
    paint = 'fill="none" stroke="#000" stroke-width="2"'
    lines = [f'<path d="M2 {y}H22" {paint}/>' for y in (4, 12)]
    write(a=svg(lines[0]), b=svg(*lines))
    assert run(["a.svg", "b.svg", "-n", "3", "-o", "out", "--strokes", "keep"]) == 0
    frames = [(here / f"out/frame-{k}.svg").read_text() for k in (1, 2, 3)]
    assert [frame.count('stroke-width="2"') for frame in frames] == [1, 1, 1]
    assert 'stroke-width="0.5"' in frames[0]
    assert 'stroke-width="1.5"' in frames[2]


def test_a_line_becomes_an_outline_where_there_is_no_other_partner(here):
    line = '<path d="M2 12H22" fill="none" stroke="#000"/>'
    circle = '<circle cx="12" cy="12" r="8" fill="none" stroke="#000"/>'
    for a, b in ((line, circle), (circle, line)):
        write(a=svg(a), b=svg(b))
        (contour,) = blended()
        assert (contour["a"], contour["b"], contour["closed"]) == (0, 0, False)
        ring = contour["vertices_b" if b == circle else "vertices_a"]
        assert ring[0] == pytest.approx(ring[-1])
        assert run(["a.svg", "b.svg", "-o", "out", "-f"]) == 0


def test_pairs_by_number_and_by_id(here):
    named = [
        f'<path id="{name}" d="M{part}"/>' for name, part in zip("wxyz", SQUARES.split("M")[1:], strict=True)
    ]
    write(a=svg(*named), b=svg(SQUARES))
    assert [c["b"] for c in blended()] == [0, 1, 2, 3]
    assert dict((c["a"], c["b"]) for c in blended("--match", "0=3"))[0] == 3
    found = {c["a"]: c["b"] for c in blended("--match", "z=0", "--match", "#w=1")}
    assert (found[3], found[0]) == (0, 1)


@pytest.mark.parametrize("hole", [0, 1])
def test_a_hole_by_number_becomes_the_hole_of_a_shape_by_id(here, hole):
    ring = RING if hole else " ".join(f"M{part}" for part in reversed(RING.split("M")[1:]))
    named = f'<path id="ring" d="{ring}" {EVENODD}/>'
    write(a=svg(ring, attributes=EVENODD), b=svg(named, SQUARES))
    for files, match in ((("a.svg", "b.svg"), f"{hole}=ring"), (("b.svg", "a.svg"), f"ring={hole}")):
        # The first number is that of the ring as a pen line, too.
        outlines = ["--strokes", "keep"] if hole == 0 else []
        (pair,) = report(*files, "-n", "0", "--match", match, *outlines)["pairs"]
        asked = [(c["a"], c["b"]) for c in pair["contours"] if c["pair_because"] == "asked for"]
        assert asked == [(hole, hole)]


@pytest.mark.parametrize(
    ("points", "pair"),
    [
        ("6,6:56,100", (0, 2)),  # inside
        ("13,1:90,20", (1, 1)),  # beside: the nearest
        ("20,20:56,56", (3, 0)),
    ],
)
def test_pairs_by_points_in_the_coordinates_of_each_drawing(here, points, pair):
    write(a=svg(SQUARES), b=svg(scaled(SQUARES), viewbox="40 40 96 96"))
    assert pair in [(c["a"], c["b"]) for c in blended("--match", points)]
    assert report("a.svg", "b.svg", "-o", "out", "--match", points)["settings"]["match"] == [
        [[float(v) for v in side.split(",")] for side in points.split(":")]
    ]


def scaled(data):
    """Path data of absolute numbers, four times as large, from 40,40 on."""
    return re.sub(r"\d+", lambda number: str(40 + 4 * int(number.group())), data)


def test_a_point_means_the_innermost_contour_around_it(here):
    wide, narrow = ("M2 2H22V22H2Z", "M8 8H16V16H8Z")
    write(a=svg(wide, narrow), b=svg(narrow, wide))
    assert [(c["a"], c["b"]) for c in blended("--match", "4,4:12,12", "--match", "12,12:4,4")] == [
        (0, 0),
        (1, 1),
    ]


def test_a_pin_between_points_pairs_the_nearest_contours(here):
    files(SQUARES, SQUARES)
    found = {c["a"]: c for c in blended("--pin", "2,2:22,22", "--vertices", "0")}
    assert found[0]["b"] == 3
    i, j = found[0]["dots"][0]
    assert (found[0]["vertices_a"][i], found[0]["vertices_b"][j]) == ([2, 2], [22, 22])


def test_start_and_pins_by_number_are_of_the_largest_pair(here):
    files(EYED, EYED)
    outline, eye = blended("--start", "3,5")
    assert outline["start"] == [3, 5]
    assert eye["start"] != [3, 5]
