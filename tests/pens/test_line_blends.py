"""Drawings that move as their pen lines."""

import json
from pathlib import Path

import numpy as np
import pytest

from shapeblend_cli.cli import run
from shapeblend_cli.frames.frames import frame_at, shapes_at
from shapeblend_cli.geometry.crossings import path_crossings
from shapeblend_cli.interpolate.chains import keyframed_shapes
from shapeblend_cli.interpolate.paths import paths_at
from shapeblend_cli.model import Box, control_box
from shapeblend_cli.options.settings import Settings
from shapeblend_cli.pens.around import DOORS, SLIDES
from shapeblend_cli.pens.drawings import file_lines
from shapeblend_cli.pens.moves import BECOMES, DRAWN_BACK, DRAWN_ON, STAYS
from shapeblend_cli.pens.splits import COPY
from shapeblend_cli.pens.turned import FLIPPED, SIGN_TURNED, TURNED
from shapeblend_cli.pipeline import match_all
from shapeblend_cli.svg.reading.read import read
from tests.support.drawings import drawing, svg

ICONS = Path(__file__).parent / "icons"
ROUND = '<path d="{}" fill="none" stroke="#000" stroke-width="2" stroke-linecap="round"/>'
TIMES = [k / 10 for k in range(11)]

PAIRS = [
    ("lucide-menu", "lucide-x"),
    ("lucide-eye", "lucide-eye-off"),
    ("ph-plus", "ph-check"),
    ("ph-magnifying-glass", "ph-x"),
    ("lucide-menu", "ph-x"),
]


def blend(a, b, **settings):
    drawings = [each if not isinstance(each, str) else read(str(ICONS / f"{each}.svg")) for each in (a, b)]
    (pair,), _ = match_all(drawings, Settings(**settings))
    return pair


def strokes(path, viewbox="0 0 24 24"):
    return drawing(f'<path d="{path}" fill="none" stroke="#000" stroke-width="2"/>', viewbox=viewbox)


def reasons(pair):
    return sorted(shape.reason for shape in pair.shapes)


@pytest.mark.parametrize("names", PAIRS, ids="-to-".join)
def test_line_weight_is_that_of_both_ends_at_every_moment(names):
    pair = blend(*names)
    unit = pair.views[0].larger_side / 24.0
    for t in TIMES:
        for shape, painted in zip(pair.shapes, shapes_at(pair, t), strict=True):
            assert painted.style.fill is None
            ends = shape.style_a.stroke_width, shape.style_b.stroke_width
            own = shape.own_time(t)
            assert painted.style.stroke_width == pytest.approx((1 - own) * ends[0] + own * ends[1])
            if shape.contours[0].is_matched:
                assert 1.4 * unit < painted.style.stroke_width < 2.1 * unit


@pytest.mark.parametrize("names", PAIRS, ids="-to-".join)
def test_both_ends_are_the_drawings_and_nothing_jumps_beside_them(names):
    pair = blend(*names)
    for t, drawn in ((0.0, pair.drawn[0]), (1.0, pair.drawn[1])):
        assert frame_at(pair, t, as_drawn=True).shapes == drawn
    for shape in pair.shapes:
        for end, near in ((0.0, 1e-3), (1.0, 1.0 - 1e-3)):
            one, other = (paths_at(shape, t)[0].segments for t in (end, near))
            assert one.shape == other.shape
            assert np.abs(one - other).max() < 0.003 * pair.views[0].larger_side


def test_the_outer_bars_of_a_menu_become_both_strokes_of_the_close_sign():
    pair = blend("lucide-menu", "lucide-x")
    assert reasons(pair) == [BECOMES, BECOMES, DRAWN_BACK]
    (alone,) = [shape for shape in pair.shapes if shape.reason == DRAWN_BACK]
    assert alone.contours[0].a == 1
    assert alone.span[1] < 1.0


@pytest.mark.parametrize("names", [("lucide-eye", "lucide-eye-off"), ("ph-eye", "ph-eye-slash")])
def test_what_is_crossed_out_stays_and_the_slash_is_drawn_on(names):
    pair = blend(*names, strokes="recover")
    assert set(reasons(pair)) == {STAYS, DRAWN_ON}
    (slash,) = [shape for shape in pair.shapes if shape.reason == DRAWN_ON]
    tips = [paths_at(slash, t)[0].segments[-1, 3] for t in TIMES]
    lengths = np.abs(np.array(tips) - paths_at(slash, 0.0)[0].segments[0, 0])
    assert (np.diff(lengths) > 0.0).all()


def test_a_tail_is_drawn_back_along_its_own_curve():
    long = "M2 12H12C18 12 18 6 18 2"
    pair = blend(strokes(long), strokes("M2 12H12"))
    (shape,) = pair.shapes
    half = paths_at(shape, 0.5)[0].segments
    curve = paths_at(shape, 0.0)[0].segments[:, 0]
    assert min(abs(half[-1, 3] - point) for point in curve) < 0.5
    assert abs(half[0, 0] - (2 + 12j)) < 1e-6


def test_a_drawing_that_is_turned_or_flipped_is_so_as_a_whole():
    hook = "M4 20V4H16"
    turned, flipped = "M20 20H4V8", "M20 20V4H8"
    assert reasons(blend(strokes(hook), strokes(turned), motion="auto"))[0].startswith(
        ("B is A turned", TURNED)
    )
    assert reasons(blend(strokes(f"{hook} M9 12H12"), strokes(f"{flipped} M15 12H12"))) == [FLIPPED, FLIPPED]
    one_more = strokes(f"{flipped} M15 12H12 M8 12V13.5")
    assert FLIPPED not in reasons(blend(strokes(f"{hook} M9 12H12"), one_more))


def test_a_sign_that_is_nearly_the_other_one_upside_down_turns_within_what_stays():
    ring, i, mark = (
        "M12 2A10 10 0 1 1 12 22A10 10 0 1 1 12 2Z",
        "M12 8h.01 M11 12H12V16H13",
        "M12 8V12 M12 16h.01",
    )
    pair = blend(*(drawing(ROUND.format(f"{ring} {sign}")) for sign in (i, mark)))
    assert reasons(pair) == [STAYS, SIGN_TURNED, SIGN_TURNED]
    boxes = [control_box(paths_at(shape, 0.5)).centre for shape in pair.shapes if shape.reason == SIGN_TURNED]
    assert abs(boxes[0].real - boxes[1].real) > 3.0
    assert abs(boxes[0].imag - boxes[1].imag) < 1.0


def test_arrows_that_point_the_other_way_turn_each_about_itself():
    out, into = (
        "M14 10L20 4 M15 4H20V9 M10 14L4 20 M9 20H4V15",
        "M20 4L14 10 M14 5V10H19 M4 20L10 14 M10 19V14H5",
    )
    pair = blend(strokes(out), strokes(into))
    assert reasons(pair) == [SIGN_TURNED] * 4
    for t in TIMES:  # they keep their angles
        spans = [
            abs(np.subtract(*path.segments[[0, -1], [0, 3]]))
            for shape in pair.shapes
            for path in paths_at(shape, t)
        ]
        assert sorted(spans) == pytest.approx([50**0.5, 50**0.5, 72**0.5, 72**0.5], abs=0.05)
    assert reasons(blend(strokes(out), strokes(f"{into} M4 4H8"))).count(SIGN_TURNED) == 4


def test_an_arrow_among_other_lines_turns_unless_it_would_run_into_one():
    up, down = "M12 12V4 M9 7L12 4L15 7", "M12 4V12 M9 9L12 12L15 9"
    for tray, turned in (("M4 14V20H20V14", 2), ("M10 2V14", 0)):
        found = reasons(blend(strokes(f"{up} {tray}"), strokes(f"{down} {tray}")))
        assert found.count(SIGN_TURNED) == turned


def test_a_bracket_slides_around_an_arrow():
    arrow = "M{0} 12H{1} M{2} 8L{1} 12L{2} 16"
    pair = blend(
        strokes(f"{arrow.format(3, 15, 11)} M15 3H21V21H15"),
        strokes(f"{arrow.format(9, 21, 17)} M9 3H3V21H9"),
    )
    (bracket,) = (shape for shape in pair.shapes if shape.reason == SLIDES)
    for t in TIMES:
        (path,) = paths_at(bracket, t)
        points = np.append(path.segments[:, 0], path.segments[-1, 3])
        assert np.abs(np.diff(points)).sum() == pytest.approx(30.0, abs=0.01)
        assert np.abs(np.diff(points)).min() > 1e-6, "edges without length have no caps"
        assert Box(3, 3, 18, 18).contains(Box.around(points), slack=1e-6)
    (path,) = paths_at(bracket, 0.5)
    assert control_box([path]).height == pytest.approx(6.0), "it is above the arrow"


def test_a_box_with_a_gap_opens_on_the_other_side():
    arrow = "M{0} 12H{1} M{2} 9L{1} 12L{2} 15"
    pair = blend(
        strokes(f"{arrow.format(2, 14, 11)} M8 9V4H20V20H8V15"),
        strokes(f"{arrow.format(10, 22, 19)} M16 9V4H4V20H16V15"),
    )
    assert reasons(pair).count(DOORS) == 2
    for t, box in ((0.0, Box(8, 4, 12, 16)), (0.5, Box(6, 4, 12, 16)), (1.0, Box(4, 4, 12, 16))):
        halves = [paths_at(shape, t)[0] for shape in pair.shapes if shape.reason == DOORS]
        assert control_box(halves).bounds == pytest.approx(box.bounds, abs=0.01)


def test_what_turns_stays_in_the_picture():
    bar = "M3 4V20 M21 12H8 M13 7L8 12L13 17"
    pair = blend(strokes(bar), strokes("M21 4V20 M3 12H16 M11 7L16 12L11 17"))
    for t in TIMES:
        box = Box.union([control_box(paths_at(shape, t)) for shape in pair.shapes])
        assert Box(0, 0, 24, 24).contains(box.expanded(0.85))


def test_a_sign_that_stays_upright_does_not_turn():
    pair = blend(*(drawing(ROUND.format(d)) for d in ("M12 8h.01 M12 12V16", "M12 5h.01 M10 10H12V17")))
    assert SIGN_TURNED not in reasons(pair)


@pytest.mark.parametrize("backwards", [False, True])
def test_a_drawing_of_lines_alone_and_one_with_a_solid_shape_too(backwards):
    bar, disc = "M2 3H22V5H2Z M2 8H22V10H2Z", "M12 14A3 3 0 1 0 12 20A3 3 0 1 0 12 14Z"
    pair = blend(*[drawing(bar), drawing(bar, disc)][:: -1 if backwards else 1])
    assert STAYS in reasons(pair)
    for t in TIMES:
        assert all(np.isfinite(path.segments).all() for shape in pair.shapes for path in paths_at(shape, t))


def test_letters_of_one_family_are_matched_segment_by_segment():
    thin, bold = "M11 2H13V4H11Z M11 7H13V22H11Z", "M10 2H14V5H10Z M10 7H14V22H10Z"
    assert not {STAYS, BECOMES} & set(reasons(blend(drawing(thin), drawing(bold))))
    moved = "M3 2H5V4H3Z M8 7H10V22H8Z"
    assert {STAYS, BECOMES} & set(reasons(blend(drawing(thin), drawing(moved))))


def test_what_rests_in_both_is_not_turned():
    given = reasons(blend("ph-toggle-left", "ph-toggle-right", strokes="recover"))
    assert set(given) <= {STAYS, BECOMES}


def test_a_ring_without_a_partner_comes_out_of_one_like_it():
    one, two = "M12 8A4 4 0 1 0 12 16A4 4 0 1 0 12 8Z", "M6 8A4 4 0 1 0 6 16A4 4 0 1 0 6 8Z"
    both = f"{two} M18 8A4 4 0 1 0 18 16A4 4 0 1 0 18 8Z"
    assert COPY in reasons(blend(strokes(one), strokes(both), strokes="recover"))


def test_a_ring_around_what_stays_is_drawn_back():
    cross, ring = "M8 8L16 16 M16 8L8 16", "M12 2A10 10 0 1 0 12 22A10 10 0 1 0 12 2Z"
    pair = blend(strokes(f"{ring} {cross}"), strokes(cross))
    (gone,) = [shape for shape in pair.shapes if shape.reason == DRAWN_BACK]
    seen = paths_at(gone, 0.5)[0].segments[:, 0]
    assert np.abs(np.abs(seen - (12 + 12j)) - 10).max() < 0.1
    assert seen[0].imag < 2.1  # from its top


def test_a_bow_without_a_partner_parts_in_its_middle():
    body, bow = "M4 11H20V21H4Z", "M7 11V7A5 5 0 0 1 17 7V11"
    pair = blend(strokes(f"{body} {bow}"), strokes(body))
    halves = [shape for shape in pair.shapes if shape.reason == DRAWN_BACK]
    ends = sorted((paths_at(half, 0.5)[0].segments[[0, -1], [0, 3]].tolist() for half in halves), key=str)
    assert [end[0] for end in ends] == pytest.approx([17 + 11j, 7 + 11j])
    assert [end[1].imag for end in ends] == pytest.approx([ends[0][1].imag] * 2, abs=0.1)


def test_corners_of_a_ring_go_to_corners():
    triangle, square = "M5 3L20 12L5 21Z", "M4 4H20V20H4Z"
    (shape,) = blend(strokes(triangle), strokes(square)).shapes
    starts, ends = (paths_at(shape, t)[0].segments[:, 0] for t in (0.0, 1.0))
    for corner, partner in ((5 + 3j, 4 + 4j), (5 + 21j, 4 + 20j)):
        assert abs(ends[np.abs(starts - corner).argmin()] - partner) < 0.1


LEANING = (  # not quite even: its upper corner is rounder than the lower one
    "M5.644 5.025V18.97a1.533 1.533 0 0 0 2.467 1.21l9.656-7.509a1.532 1.532 0 0 0-.092-2.483L8.019 3.753"
    "a1.533 1.533 0 0 0-2.375 1.272z"
)
BARS = (
    "M8.5 4.5h-3a1 1 0 0 0-1 1v13a1 1 0 0 0 1 1h3a1 1 0 0 0 1-1v-13a1 1 0 0 0-1-1z"
    "m10 0h-3a1 1 0 0 0-1 1v13a1 1 0 0 0 1 1h3a1 1 0 0 0 1-1v-13a1 1 0 0 0-1-1z"
)


@pytest.mark.parametrize("joins", [False, True])
def test_halves_of_a_ring_are_soon_shut_along_the_cut(joins):
    sides = strokes(LEANING), strokes(BARS)
    pair = blend(*(sides[::-1] if joins else sides), swap="never")
    assert reasons(pair) == [COPY, COPY]
    for shape in pair.shapes:
        away = []
        for t in (0.0, 0.3, 0.5, 0.7, 0.9):
            (path,) = paths_at(shape, 1.0 - t if joins else t)
            ahead = complex(path.segments[-1, 3] - path.segments[0, 0])
            assert abs(ahead.real) < 0.1, "both ends are on the upright side along the cut"
            away.append(ahead.imag)
        assert max(each / away[0] for each in away[1:]) < 0.1, "they meet, or lie on each other"


def test_halves_of_a_triangle_have_no_waist():
    triangle, bars = "M5 3L20 12L5 21Z", "M4 3H10V21H4Z M14 3H20V21H14Z"
    pair = blend(strokes(triangle), strokes(bars))
    assert reasons(pair) == [COPY, COPY]
    left = paths_at(min(pair.shapes, key=lambda shape: paths_at(shape, 1.0)[0].segments.real.mean()), 0.3)
    points = left[0].segments[:, 0]
    top, inner = points[points.imag < 12], points.real.max()
    corner = top[top.real > inner - 0.3]
    assert corner.imag.min() < 7.0


def test_solid_shapes_and_strokes_with_fills_are_outlines():
    solid = drawing("M2 2H22V22H2Z"), drawing("M12 2L22 22H2Z")
    assert not {BECOMES, STAYS, DRAWN_BACK} & set(reasons(blend(*solid)))


@pytest.mark.parametrize(
    "settings",
    [
        {"strokes": "keep"},
        {"motion": "rigid"},
        {"preset": "paper"},
        {"unmatched": "point"},
        {"pins": ((0, 0),)},
    ],
    ids=str,
)
def test_files_are_taken_as_they_are_where_users_say_how(settings):
    assert not {BECOMES, STAYS} & set(reasons(blend("lucide-menu", "lucide-x", **settings)))


def test_lines_go_on_through_several_drawings(here):
    icons = [str(ICONS / f"ph-{name}.svg") for name in ("list", "x", "check")]
    pairs, _ = match_all([read(icon) for icon in icons], Settings())
    assert {reason for pair in pairs for reason in reasons(pair)} <= {BECOMES, STAYS, DRAWN_BACK, DRAWN_ON}
    assert run([*icons, "-o", "moving.svg"]) == 0
    moving = Path("moving.svg").read_text("utf-8")
    assert moving.count("<path") == sum(len(pair.shapes) for pair in pairs)
    assert 'fill="none"' in moving


def test_between_two_files_lines_move_straight_and_leave_no_dots():
    hidden = blend("ph-list", "ph-x", motion="linear")
    assert all(shape.motion is None and shape.fade is None for shape in hidden.shapes)
    (middle,) = [shape for shape in hidden.shapes if shape.reason == DRAWN_BACK]
    assert middle.style_b.stroke_width > 0.0  # the close sign is drawn over it


@pytest.mark.parametrize(
    "sign", ["M12 12h.01", "M7 12H17 M12 7V17", "M13 10L11 12L13 14"], ids=["dot", "plus", "chevron"]
)
def test_dots_and_small_signs_grow_in_width_too(sign):
    pen = 'fill="none" stroke="#000" stroke-width="2" stroke-linecap="round"'
    ends = [drawing(f'<path d="{path}" {pen}/>') for path in ("M4 4H20V20H4Z", f"M4 4H20V20H4Z {sign}")]
    for pair, ends_thin in ((blend(*ends), 0.0), (blend(*ends[::-1]), 1.0)):
        alone = [shape for shape in pair.shapes if shape.reason in (DRAWN_ON, DRAWN_BACK)]
        assert len(alone) == sign.count("M")
        for t in (0.0, 0.5, 1.0):
            widths = [frame.style.stroke_width for frame in shapes_at(pair, t)][-len(alone) :]
            assert widths == pytest.approx([2.0 * abs(t - ends_thin)] * len(alone))


def test_a_line_that_ends_where_no_other_is_fades_there():
    round_ends = [
        drawing(f'<path d="{path}" fill="none" stroke="#000" stroke-width="2" stroke-linecap="round"/>')
        for path in ("M4 12H20", "M4 12H20 M9 4V8")
    ]
    (new,) = [shape for shape in blend(*round_ends).shapes if shape.reason == DRAWN_ON]
    assert new.fade is not None
    (thin,) = [shape for shape in blend(*round_ends, motion="linear").shapes if shape.reason == DRAWN_ON]
    assert thin.style_a.stroke_width == 0.0 < thin.style_b.stroke_width


def test_a_ring_has_its_partners_caps():
    ring, arc = "M12 4A8 8 0 1 0 12 20A8 8 0 1 0 12 4Z", "M12 4A8 8 0 1 0 20 12"
    round_arc = drawing(
        f'<path d="{arc}" fill="none" stroke="#000" stroke-width="2" stroke-linecap="round"/>'
    )
    pair = blend(strokes(ring), round_arc, strokes="recover")
    assert {shape.style_a.stroke_linecap for shape in pair.shapes} == {"round"}


@pytest.mark.parametrize(
    "output", ["x.svg", "x.svg --animate css", "x.json --emit lottie", "x.xml --emit avd"]
)
def test_every_output_has_strokes(here, output):
    files = [str(ICONS / f"ph-{name}.svg") for name in ("magnifying-glass", "x")]
    assert run([*files, "-o", *output.split()]) == 0
    written = "".join(path.read_text("utf-8") for path in sorted(here.rglob("*")) if path.is_file())
    assert any(word in written for word in ("stroke-width", "strokeWidth", '"ty":"st"', '"ty": "st"'))


def test_an_open_line_of_several_segments_is_inspected(here, capsys):
    Path("a.svg").write_text(svg('<path d="M4 20L8 8L12 16L20 4" fill="none" stroke="#000"/>'))
    assert run("inspect a.svg --json".split()) == 0
    (shape,) = json.loads(capsys.readouterr().out)["shapes"]
    assert [line["closed"] for line in shape["pen_lines"]] == [False]


def test_dots_go_on_through_several_drawings():
    dots = "M6 10.5A1.5 1.5 0 1 0 6 13.5A1.5 1.5 0 1 0 6 10.5Z M18 10.5A1.5 1.5 0 1 0 18 13.5A1.5 1.5 0 1 0 18 10.5Z"
    bars = "M2 4H22V7H2Z M2 17H22V20H2Z"
    drawings = [drawing(bars), drawing(dots), drawing(bars)]
    pairs, _ = match_all(drawings, Settings(strokes="recover"))
    assert any(len(contour.polygon_b.vertices) == 1 and contour.is_matched for contour in pairs[0].contours)
    for shape in keyframed_shapes(pairs):
        assert all(len(path.segments) for key in shape.keys for path in key.paths)


DOTS = (
    [(86, 63, 3), (44, 6, 1), (63, 38, 2)],
    [(80, 10, 3), (20, 70, 2), (50, 50, 1), (30, 20, 3), (60, 90, 2)],
)


CLIPPED = '<clipPath id="c">{}</clipPath><path d="M5 5h90v90h-90z" clip-path="url(#c)"/>'


@pytest.mark.parametrize("form", ["{}", CLIPPED + '<path fill="#e33" d="M1 1h2v2h-2z"/>'])
def test_dots_are_animated_and_dots_of_a_clip_path_stay_regions(here, form):
    for name, dots in zip("ab", DOTS, strict=True):
        circles = "".join(f'<circle cx="{x}" cy="{y}" r="{r}"/>' for x, y, r in dots)
        document = (
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100">{form.format(circles)}</svg>'
        )
        Path(f"{name}.svg").write_text(document, "utf-8")
    assert run(["a.svg", "b.svg", "-o", "x.svg", "-q"]) == 0
    if "clip" in form:
        assert "stroke" not in Path("x.svg").read_text("utf-8")


def test_lines_above_a_translucent_tint_move_as_lines(tmp_path):
    tinted = []
    for name in ("ph-plus", "ph-check"):
        plain = (ICONS / f"{name}.svg").read_text()
        start = plain.index(">") + 1
        path = tmp_path / f"{name}.svg"
        path.write_text(f'{plain[:start]}<path d="M8 8H248V248H8Z" opacity=".2"/>{plain[start:]}')
        tinted.append(read(str(path)))
    pair = blend(*tinted)
    assert [shape.style_a.stroke is None for shape in pair.shapes] == [True, False, False]


def test_a_stroke_whose_ends_meet_but_for_rounding_is_closed():
    stroke = strokes("M4 12A8 8 0 1 1 12 20A8 8 0 0 1 4.004 12.005")
    assert file_lines(stroke)[0].closed
    pair = blend(stroke, drawing('<circle cx="12" cy="12" r="9"/>', viewbox="0 0 24 24"))
    assert len(shapes_at(pair, 0.5)[0].paths) == 2  # an outline and its hole


def test_a_middle_bar_does_not_become_boxes_on_either_side_of_it():
    pair = blend("ph-list-bullets", "ph-squares-four", swap="never")
    middle = [each for shape in pair.shapes for each in shape.contours if each.reason == DRAWN_BACK]
    assert len(middle) == 2
    assert all(np.allclose(each.start.segments.imag, 128.0) for each in middle)


def test_pieces_of_a_line_paint_its_mitre_where_they_meet():
    plus = '<path d="M12 4V20 M4 12H20" fill="none" stroke="#000" stroke-width="2"/>'
    check = '<path d="M4 12L9 17L20 6" fill="none" stroke="#000" stroke-width="2"/>'
    pair = blend(drawing(plus), drawing(check))
    ends = [
        path.segments[k, m]
        for shape in shapes_at(pair, 1.0 - 1e-9)
        for path in shape.paths
        for k, m in ((0, 0), (-1, 3))
    ]
    corner = 9 + 17j
    # Each leg ends half a width beyond the corner, in its own direction.
    beyond = sorted((end - corner for end in ends), key=abs)[:2]
    assert sorted(beyond, key=lambda z: z.real) == pytest.approx(
        [(-1 + 1j) / 2**0.5, (1 + 1j) / 2**0.5], abs=1e-3
    )


def test_the_head_of_an_arrow_turns_over_to_a_check_mark_and_nothing_crosses():
    icons = "docs/icons/lucide"
    (pair,), _ = match_all([read(f"{icons}/{name}.svg") for name in ("arrow-up", "check")], Settings())
    assert reasons(pair) == [BECOMES, DRAWN_BACK]
    for t in TIMES:
        assert path_crossings([path for shape in shapes_at(pair, t) for path in shape.paths]) == 0


def test_a_drawing_turns_whose_parts_only_lie_where_others_were():
    back, forward = ("M5 5V19", "M19 5V19L9 12Z"), ("M19 5V19", "M5 5V19L15 12Z")
    pair = blend(*(drawing(*map(ROUND.format, paths)) for paths in (back, forward)))
    assert reasons(pair) == [TURNED] * 2


@pytest.mark.parametrize("head", ["M5 12L12 5L19 12", "M5 12L12 19L19 12"], ids=["up", "down"])
def test_a_menu_turns_while_its_bars_become_an_arrow_upwards_or_downwards(head):
    bars, arrow = ("M3 6H21", "M3 12H21", "M3 18H21"), ("M12 5V19", head)
    pair = blend(*(drawing(*map(ROUND.format, paths)) for paths in (bars, arrow)))
    assert all(contour.is_matched for shape in pair.shapes for contour in shape.contours)
    ways = [path.segments[-1, 3] - path.segments[0, 0] for s in pair.shapes for path in paths_at(s, 0.5)]
    assert all(abs(way) > 9.0 for way in ways)
    assert sum(abs(abs(way.real) - abs(way.imag)) < 0.1 for way in ways) == 1  # the shaft, half way round
    for end, paths in ((0.0, bars), (1.0, arrow)):
        drawn = [path for shape in pair.shapes for path in paths_at(shape, end)]
        points = np.array([point for path in drawn for point in path.segments[[0, -1], [0, 3]]])
        wanted = [p for line in file_lines(drawing(*map(ROUND.format, paths))) for p in line.points]
        assert max(np.abs(points - want).min() for want in wanted) < 0.02
