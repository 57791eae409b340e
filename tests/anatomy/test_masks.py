"""What is seen through masks and clip paths, as shapes of its own."""

import sys

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from shapeblend_cli.anatomy import masks
from shapeblend_cli.anatomy.pieces import with_areas
from shapeblend_cli.blending.swaps.swapped import is_swapped
from shapeblend_cli.frames.frames import frame_at
from shapeblend_cli.geometry.polygons import signed_area
from shapeblend_cli.job.report import inspection
from shapeblend_cli.options.settings import Settings
from shapeblend_cli.pens.drawings import file_lines
from shapeblend_cli.pipeline import match_all
from shapeblend_cli.svg.reading.read import read
from shapeblend_cli.svg.writing.document import frame_svg
from tests.support.drawings import drawing, svg
from tests.support.pictures import difference, pixels

PAPER = '<path id="paper" fill="#222" d="M0 0H24V24H0Z" mask="url(#m)"/>'
HEART = "M12 20L4 12A5 5 0 0 1 12 6A5 5 0 0 1 20 12Z"


def masked(*content, behind=PAPER, attributes=""):
    return svg(f'<mask id="m" {attributes}>{"".join(content)}</mask>', behind)


def stroke(path, colour="#fff", more=""):
    return f'<path fill="none" stroke="{colour}" stroke-width="2" d="{path}" {more}/>'


def fill(path, colour="#fff", more=""):
    return f'<path fill="{colour}" d="{path}" {more}/>'


def seen(document, *, unlike=2e-3):
    """The shapes of a document as they are blended, which must paint what a browser does."""
    given = read("a.svg", document.encode())
    found = with_areas(given)
    (pair,), _ = match_all([given, given], Settings(place="asis"))
    painted = frame_svg(frame_at(pair, 0.0, as_drawn=True), 4)
    assert difference(pixels(painted), pixels(document)) < unlike
    return found.shapes


def is_bare(shapes):
    return not any(shape.clips or shape.effects for shape in shapes)


def test_what_a_mask_draws_without_black_is_drawn_in_the_colour_behind_it():
    shapes = seen(masked(stroke("M4 12H20", more='stroke-linecap="round"'), stroke("M4 16H20", "#c0c0c0")))
    assert is_bare(shapes)
    assert [shape.style.stroke for shape in shapes] == ["#222222"] * 2
    assert [shape.style.stroke_opacity for shape in shapes] == pytest.approx([1.0, 192 / 255], abs=1e-3)
    assert [shape.style.stroke_linecap for shape in shapes] == ["round", "butt"]
    assert [shape.id for shape in shapes] == ["paper"] * 2
    dashed = seen(masked(stroke("M4 12H20", more='stroke-dasharray="2"')))
    assert dashed[0].style.stroke_dasharray == (2.0,)


def test_the_colour_of_the_page_goes_along_to_strokes_and_from_them():
    page = PAPER.replace("#222", "currentColor")
    (line,) = seen(masked(stroke("M4 12H20"), behind=page))
    assert line.page_coloured == ("stroke",)
    clip = '<clipPath id="c"><circle cx="12" cy="12" r="8"/></clipPath>'
    (cut,) = seen(svg(clip, stroke("M2 12H22", "currentColor", 'clip-path="url(#c)"')))
    assert (cut.style.stroke, cut.page_coloured) == (None, ("fill",))


def test_readers_are_told_once_what_is_seen():
    titled = PAPER.replace("/>", "><title>A plus</title></path>")
    shapes = seen(masked(stroke("M4 12H20"), stroke("M12 4V20"), behind=titled))
    assert [shape.name.title for shape in shapes] == ["A plus", None]


def test_a_fill_with_a_line_of_its_own_in_a_mask_stays_one_shape():
    (shape,) = seen(masked(f'<path fill="#fff" fill-opacity=".25" stroke="#fff" d="{HEART}"/>'))
    assert (shape.style.fill, shape.style.fill_opacity) == ("#222222", pytest.approx(0.25))
    assert (shape.style.stroke, shape.style.stroke_opacity) == ("#222222", 1.0)


def test_what_is_black_in_a_mask_is_cut_out_and_white_above_it_is_seen():
    check = stroke("M8 12L11 15L16 9", "#000", 'stroke-linejoin="round"')
    (shape,) = seen(
        masked(fill("M2 2H22V22H2Z"), check, fill("M10 3H14V8H10Z", "#000"), fill("M11 4H13V6H11Z"))
    )
    assert is_bare([shape])
    assert len(shape.contours) == 4
    areas = [signed_area(contour.segments[:, 0]) for contour in shape.contours]
    assert sum(each > 0.0 for each in areas) == 2


def test_thin_cuts_and_thin_lines_that_are_cut_are_seen():
    cuts = [stroke(f"M2 {y}H22", "#000").replace('width="2"', 'width=".1"') for y in (5, 9, 13, 17)]
    (shape,) = seen(masked(fill("M2 2H22V22H2Z"), *cuts))
    assert len(shape.contours) == 5
    clip = '<clipPath id="c"><circle cx="250" cy="250" r="100"/></clipPath>'
    line = stroke("M10 250H490", "#222", 'clip-path="url(#c)"')
    seen(svg(clip, line, viewbox="0 0 500 500"))


def test_what_reaches_out_of_the_rectangle_is_cut_off():
    behind = PAPER.replace("M0 0H24V24H0Z", "M4 4H20V20H4Z")
    line = stroke("M8 8L17 17", more='stroke-linecap="square"').replace('width="2"', 'width="6"')
    (shape,) = seen(masked(line, behind=behind))
    assert shape.style.stroke is None


def test_a_large_rectangle_hides_no_difference():
    behind = '<path d="M-5000 -5000H5000V5000H-5000Z" mask="url(#m)"/>'
    content = fill("M2 2H16V16H2Z", "#888"), fill("M8 8H22V22H8Z", "#888")
    region = 'maskUnits="userSpaceOnUse" x="0" y="0" width="24" height="24"'
    given = read("a.svg", masked(*content, behind=behind, attributes=region).encode())
    assert with_areas(given) is given


@pytest.mark.parametrize(("behind", "squares"), [(3, 300), (12, 14)], ids=["much work", "too many contours"])
def test_where_masks_would_take_long_or_leave_too_much_they_stay(behind, squares, monkeypatch):
    monkeypatch.setattr(masks, "MOST_CONTOURS", 10)
    content = [fill(f"M{x} {y}h.5v.5h-.5z") for x in range(1, 22) for y in range(1, 22)][:squares]
    bars = "".join(fill(f"M0 {2 * k}H24v2H0Z", "#222") for k in range(behind))
    document = masked(*content, fill("M1 1h.2v.2h-.2z", "#000"), behind=f'<g mask="url(#m)">{bars}</g>')
    given = read("a.svg", document.encode())
    assert with_areas(given) is given


def test_dashes_in_black_are_cut_out_as_they_are_painted():
    dashes = 'stroke-dasharray="4 2 1" stroke-dashoffset="1.5" stroke-linecap="round"'
    shapes = seen(masked(fill("M2 2H22V22H2Z"), stroke("M4 4H20V20H4Z", "#000", dashes)))
    assert is_bare(shapes)
    countless = stroke("M4 4H20V20H4Z", "#000", 'stroke-dasharray="0.01"')
    given = read("a.svg", masked(fill("M2 2H22V22H2Z"), countless).encode())
    assert with_areas(given) is given


def test_a_mask_of_the_shape_itself_leaves_the_inner_half_of_its_stroke():
    """Which is how Figma exports strokes inside."""
    circle = '<circle cx="12" cy="12" r="9" stroke="#000" stroke-width="4" fill="none" mask="url(#m)"/>'
    document = masked('<circle cx="12" cy="12" r="9"/>', behind=circle, attributes='fill="white"')
    (shape,) = seen(document)
    assert is_bare([shape])
    (line,) = file_lines(with_areas(read("a.svg", document.encode())))
    assert line.closed
    assert line.width == pytest.approx(2.0, abs=0.05)
    assert np.abs(line.points - (12 + 12j)) == pytest.approx(8.0, abs=0.05)


def test_masks_in_a_mask_are_seen_through_too():
    inner = '<mask id="n" fill="#fff"><path d="M2 2H22V12H2Z"/></mask>'
    shapes = seen(masked(inner, stroke("M12 4V20"), fill("M4 8H9V16H4Z", more='mask="url(#n)"')))
    assert is_bare(shapes)
    assert len(shapes) == 2


@pytest.mark.parametrize(
    "content",
    [
        '<defs><linearGradient id="g"><stop stop-color="#fff"/><stop offset="1"/></linearGradient></defs>'
        + fill("M2 2H22V22H2Z", "url(#g)"),
        fill("M2 2H22V22H2Z") + fill("M8 8H16V16H8Z", "#777"),
        fill("M2 2H22V22H2Z") + fill("M8 8H16V16H8Z", "#000", 'opacity=".5"'),
    ],
    ids=["a gradient", "grey on white", "half transparent black"],
)
def test_a_mask_that_shows_a_part_of_what_is_behind_it_stays(content):
    given = read("a.svg", masked(content).encode())
    assert with_areas(given) is given


def test_shapes_behind_one_mask_are_each_seen_through_it_if_it_only_shows_and_hides():
    behind = f'<g mask="url(#m)">{fill("M0 0H24V24H0Z", "#39f")}{fill("M0 24L12 8L24 24Z", "#063")}</g>'
    sky, hill = seen(
        masked('<circle cx="12" cy="12" r="9" fill="#fff" stroke="#fff"/>', behind=behind), unlike=4e-3
    )
    assert is_bare([sky, hill])
    assert (sky.style.fill, hill.style.fill) == ("#3399ff", "#006633")
    pale = masked(fill(HEART, "#888"), behind=behind)
    (given,) = [read("a.svg", pale.encode())]
    assert with_areas(given) is given


@pytest.mark.parametrize(("colour", "is_cut"), [("#222", True), ("#e33", False)])
def test_clip_paths_cut_the_shapes_of_drawings_in_one_colour(colour, is_cut):
    clip = '<clipPath id="c"><circle cx="12" cy="12" r="8"/></clipPath>'
    shapes = seen(
        svg(clip, fill("M2 2H22V12H2Z", "#222", 'clip-path="url(#c)"'), fill("M11 20H13V23H11Z", colour))
    )
    assert is_bare(shapes) == is_cut
    assert is_bare(shapes[1:])


def test_a_clip_path_that_cuts_nothing_off_leaves_a_stroke_a_stroke():
    clip = '<clipPath id="c"><circle cx="12" cy="12" r="11"/></clipPath>'
    (shape,) = seen(svg(clip, stroke("M6 12H18", "#222", 'id="bar" clip-path="url(#c)"')))
    assert is_bare([shape])
    assert shape.name.id == "bar"
    assert shape.style.stroke == "#222222"


def test_what_is_hidden_altogether_stays_as_it_is():
    given = read("a.svg", masked(fill("M2 2H22V22H2Z", "#000")).encode())
    assert with_areas(given) is given


def test_without_the_library_masks_stay(monkeypatch):
    monkeypatch.setitem(sys.modules, "pathops", None)
    given = read("a.svg", masked(fill("M2 2H22V22H2Z"), stroke("M8 12H16", "#000")).encode())
    assert with_areas(given) is given


def test_inspect_says_what_the_file_has_and_which_numbers_its_shapes_have():
    document = masked(stroke("M4 12H20"), stroke("M12 4V20")).replace(
        "</svg>", fill("M1 1H3V3H1Z", "#222") + "</svg>"
    )
    first, second = inspection(read("a.svg", document.encode()))["shapes"]
    assert (first["contours"], first["blended"], first["first_contour"]) == (1, 2, 0)
    assert [line["name"] for line in first["pen_lines"]] == ["0", "1"]
    assert (second["contours"], second["blended"], second["first_contour"]) == (1, 1, 2)


def test_masked_icons_blend_by_the_lines_in_their_masks():
    documents = (masked(stroke(path)).encode() for path in ("M4 12H20", "M4 12L10 18L20 6"))
    (pair,), _ = match_all([read(file, data) for file, data in zip("ab", documents, strict=True)], Settings())
    (shape,) = pair.shapes
    assert is_bare([shape])
    assert shape.style_a.stroke == shape.style_b.stroke == "#222222"


def test_a_mask_that_stays_shrinks_with_a_drawing_that_is_swapped():
    stops = '<stop offset=".5" stop-color="#fff"/><stop offset=".6" stop-color="#888"/>'
    gradient = f'<linearGradient id="g">{stops}</linearGradient>'
    soft = read("a.svg", masked(gradient, '<circle cx="12" cy="12" r="9" fill="url(#g)"/>').encode())
    (pair,), _ = match_all([soft, drawing("M3 3H21V21H3Z")], Settings(swap="always"))
    assert is_swapped(pair.shapes)
    (blend,) = pair.shapes[0].effects
    assert [len(mask.layers) for mask in (blend.start.mask, blend.end.mask)] == [1, 1]
    whole, half = (pixels(frame_svg(frame_at(pair, t, as_drawn=False), 4)) for t in (0.0, 0.4))
    dark = [(255.0 - picture.mean(axis=2)) > 64 for picture in (whole, half)]
    rows = [
        np.ptp(np.flatnonzero(each.any(axis=1))) / np.ptp(np.flatnonzero(each.any(axis=0))) for each in dark
    ]
    assert 0.0 < dark[1].sum() < 0.6 * dark[0].sum()
    assert rows[1] == pytest.approx(rows[0], abs=0.1)  # as round as it was


def test_masks_that_cross_each_other_blend():
    """Around what only one drawing has there are then masks of both."""
    stops = '<stop stop-color="#fff"/><stop offset="1" stop-color="#888"/>'
    made = "".join(
        f'<mask id="{name}"><rect width="24" height="24" fill="url(#g)"/></mask>' for name in ("m", "n")
    )
    made += f'<linearGradient id="g">{stops}</linearGradient>'
    made += '<filter id="f"><feGaussianBlur stdDeviation="1"/></filter>'
    one, other = fill("M2 2H12V12H2Z", "#c00"), fill("M12 12H22V22H12Z", "#00c")
    a = drawing(made, f'<g filter="url(#f)" mask="url(#m)"><g mask="url(#n)">{one}{other}</g></g>')
    b = drawing(made, f'<g mask="url(#m)"><g filter="url(#f)" mask="url(#n)">{one}</g></g>')
    for pair in ([a, b], [b, a]):
        match_all(pair, Settings())


@st.composite
def layers(draw):
    points = st.tuples(st.integers(1, 23), st.integers(1, 23))
    found = []
    for _ in range(draw(st.integers(1, 4))):
        path = "M" + "L".join(f"{x} {y}" for x, y in draw(st.lists(points, min_size=3, max_size=6)))
        colour = draw(st.sampled_from(["#fff", "#fff", "#000"]))
        is_stroke = draw(st.booleans())
        join = draw(st.sampled_from(["round", "bevel", "miter"]))
        found.append(
            stroke(path, colour, f'stroke-linejoin="{join}"') if is_stroke else fill(path + "Z", colour)
        )
    return found


@settings(max_examples=60, deadline=None)
@given(layers())
def test_any_mask_shows_what_a_browser_shows(content):
    document = masked(*content)
    given = read("a.svg", document.encode())
    if with_areas(given) is not given:
        seen(document)
