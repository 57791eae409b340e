"""Drawings that take each other's place, as they would not blend well."""

from pathlib import Path

import numpy as np
import pytest

import shapeblend_cli as sb
from shapeblend_cli.blending.graded import SWAP_GRADE, grade_of
from shapeblend_cli.blending.swaps import unlike
from shapeblend_cli.blending.swaps.swapped import ASKED, GONE, SHRINKS, SWAPPED, is_swapped
from shapeblend_cli.blending.swaps.unlike import (
    ANY,
    BADGED,
    COLOURED,
    FAULTY,
    SIGNS,
    TOLD,
    TOLD_IF_BARS,
    TOLD_IF_BENT,
    TOLD_IF_SIMPLE,
    TOLD_IF_SPLIT,
    WHOLLY,
    is_hopeless,
    loose_ends,
)
from shapeblend_cli.blending.turned_drawings import POINTS_ELSEWHERE
from shapeblend_cli.cli import run
from shapeblend_cli.frames.frames import shapes_at
from shapeblend_cli.frames.stagger import eased
from shapeblend_cli.interpolate.paths import paths_at
from shapeblend_cli.model import control_box
from shapeblend_cli.options.settings import Settings
from shapeblend_cli.paint.styles import shape_styles
from shapeblend_cli.pipeline import match_all
from tests.support.drawings import drawing, svg

ICONS = Path("docs/icons")
COPY, CHECK = "copy.svg", "check.svg"
RELATED = [
    ("lucide/menu.svg", "lucide/x.svg"),
    ("lucide/play.svg", "lucide/pause.svg"),
    ("phosphor/play.svg", "phosphor/pause.svg"),
    ("lucide/plus.svg", "lucide/check.svg"),
    ("lucide/log-in.svg", "lucide/log-out.svg"),
    ("lucide/sun.svg", "lucide/moon.svg"),
    ("bootstrap/bell.svg", "bootstrap/bell-slash.svg"),
    ("lucide/search.svg", "lucide/x.svg"),
    ("lucide/arrow-up.svg", "lucide/check.svg"),
]
CIRCLED = "M12 2A10 10 0 1 0 12 22A10 10 0 1 0 12 2Z"


def blended(a, b, **settings):
    return sb.blend(ICONS / a, ICONS / b, **settings)


@pytest.mark.parametrize("icons", ["lucide", "phosphor", "bootstrap"])
def test_sheets_that_would_fold_to_a_check_mark_make_room_for_it(icons):
    blend = blended(f"{icons}/{COPY}", f"{icons}/{CHECK}")
    (pair,) = blend.pairs
    assert {shape.reason for shape in pair.shapes} == {SWAPPED}
    (other,) = blended(f"{icons}/{COPY}", f"{icons}/{CHECK}", swap="never").pairs
    assert grade_of(pair).number == SWAP_GRADE < grade_of(other).number


def test_dots_that_would_curl_up_to_become_a_cross_make_room_for_it(tmp_path):
    stroke = '<path d="{}" fill="none" stroke="#000" stroke-width="2" stroke-linecap="round"/>'
    dots = "".join(
        f'<circle cx="{x}" cy="12" r="1" fill="none" stroke="#000" stroke-width="2"/>' for x in (5, 12, 19)
    )
    files = tmp_path / "dots.svg", tmp_path / "cross.svg"
    for file, drawn in zip(files, (dots, stroke.format("M18 6 6 18M6 6l12 12")), strict=True):
        file.write_text(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 24 24">{drawn}</svg>')
    (pair,) = sb.blend(*files).pairs
    assert is_swapped(pair.shapes)


def test_lines_that_would_tangle_make_room_though_rings_may_bend(tmp_path):
    stroke = '<path d="{}" fill="none" stroke="#000" stroke-width="2" stroke-linejoin="round"/>'
    bars = "M3 21H7V14H3ZM10 21H14V8H10ZM17 21H21V3H17Z"
    pie = "M12 3A9 9 0 1 0 12 21A9 9 0 1 0 12 3ZM12 3V12H21M12 12L5.6 18.4"
    files = tmp_path / "bars.svg", tmp_path / "pie.svg"
    for file, drawn in zip(files, (bars, pie), strict=True):
        file.write_text(
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 24 24">{stroke.format(drawn)}</svg>'
        )
    (pair,) = sb.blend(*files).pairs
    assert is_swapped(pair.shapes)
    (other,) = sb.blend(*files, swap="never").pairs
    assert grade_of(other).number >= TOLD


HAIRLINE = "M17.5-.5H30.4V0H4.1V-.5H17V-78.5H4.1V-79H17.5Z"
BOLD = "M12 21H2V-41H-10V-39H0V21H-10V23H12Z"


def test_a_hairline_becomes_bold_however_much_thicker_it_gets(tmp_path):
    files = tmp_path / "hairline.svg", tmp_path / "bold.svg"
    files[0].write_text(svg(HAIRLINE, viewbox="0 -83 35 87"))
    files[1].write_text(svg(BOLD, viewbox="-13 -44 29 70"))
    (pair,) = sb.blend(*files, place="asis").pairs
    assert not is_swapped(pair.shapes)


SHEETS = "M11.25 4.25v-2.5h-9.5v9.5h2.5m.5-6.5v9.5h9.5v-9.5z"
CLIPBOARD = "M5.75 1.75h4.5v3.5h-4.5z M5.25 2.75h-2.5v11.5h10.5v-11.5h-2.5"


def sheets_to_clipboard(tmp_path, **settings):
    files = tmp_path / "sheets.svg", tmp_path / "clipboard.svg"
    stroke = 'fill="none" stroke="#000" stroke-width="1.5" stroke-linecap="round" stroke-linejoin="round"'
    for file, d in zip(files, (SHEETS, CLIPBOARD), strict=True):
        file.write_text(
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 16 16"><path d="{d}" {stroke}/></svg>'
        )
    (pair,) = sb.blend(*files, **settings).pairs
    return pair


def test_lines_whose_ends_would_come_loose_make_room(tmp_path):
    assert loose_ends(sheets_to_clipboard(tmp_path, swap="never").shapes) >= 2
    assert is_swapped(sheets_to_clipboard(tmp_path).shapes)


@pytest.mark.parametrize(
    ("a", "b"),
    [
        ("sun.svg", "moon.svg"),
        ("plus.svg", "x.svg"),
        ("play.svg", "pause.svg"),
        ("lock.svg", "lock-open.svg"),
    ],
)
def test_ends_are_not_loose_that_turn_or_are_free_in_a_drawing(a, b):
    (pair,) = blended(f"lucide/{a}", f"lucide/{b}").pairs
    assert loose_ends(pair.shapes) == 0


LINK = (
    "M10 13a5 5 0 0 0 7.54.54l3-3a5 5 0 0 0-7.07-7.07l-1.72 1.71",
    "M14 11a5 5 0 0 0-7.54-.54l-3 3a5 5 0 0 0 7.07 7.07l1.71-1.71",
)
MENU = "M3 6H21", "M3 12H21", "M3 18H21"
ARROW = "M12 5V19", "M5 12L12 5L19 12"


@pytest.mark.parametrize(
    ("lines", "others", "makes_room"),
    [(LINK, ("M20 6L9 17L4 12",), True), (MENU, ARROW, False)],
    ids=["dabs", "bars"],
)
def test_lines_that_are_bent_all_along_make_room_though_bars_and_chevrons_do_not(
    tmp_path, lines, others, makes_room
):
    stroke = 'fill="none" stroke="#000" stroke-width="2" stroke-linecap="round" stroke-linejoin="round"'
    files = tmp_path / "a.svg", tmp_path / "b.svg"
    for file, side in zip(files, (lines, others), strict=True):
        drawn = "".join(f'<path d="{d}" {stroke}/>' for d in side)
        file.write_text(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 24 24">{drawn}</svg>')
    (pair,) = sb.blend(*files).pairs
    assert is_swapped(pair.shapes) is makes_room


@pytest.mark.parametrize(("a", "b"), RELATED)
def test_icons_that_have_something_in_common_blend(a, b):
    (pair,) = blended(a, b).pairs
    assert not any(shape.reason == SWAPPED for shape in pair.shapes)


def test_each_drawing_keeps_its_form_and_the_weight_of_its_lines_in_proportion():
    (pair,) = blended(f"lucide/{COPY}", f"lucide/{CHECK}").pairs
    centre = pair.views[0].centre
    for t in (0.1, 0.3, 0.5, 0.7, 0.9):
        for shape in pair.shapes:
            is_new = shape.sources[0] is None
            own = shape.own_time(t)
            scale = own if is_new else 1.0 - own
            (there,) = paths_at(shape, float(is_new))
            (here,) = paths_at(shape, t)
            expected = centre + scale * (there.segments - centre)
            assert here.segments == pytest.approx(expected, abs=1e-9)
            drawn = shape_styles(shape, t)[0].stroke_width
            assert drawn == pytest.approx(scale * max(shape.style_a.stroke_width, shape.style_b.stroke_width))


IN_RED = '<path fill="#e33" d="M20 20h2v2h-2z"/>'
"""What lets a drawing have clips: in one colour, they are applied."""


def test_clips_shrink_and_grow_with_what_they_clip():
    clipped = '<clipPath id="c"><path d="M2 2h{0}v{0}h-{0}z"/></clipPath><path clip-path="url(#c)" d="M1 1h21v9h-21z"/>'
    ends = [drawing(clipped.format(size), IN_RED) for size in (10, 14)]
    (pair,), _ = match_all(ends, Settings(swap="always"))
    centre = pair.views[0].centre
    for t in (0.2, 0.4, 0.5, 0.7):
        both = zip(pair.shapes[::2], shapes_at(pair, t)[::2], (10.0, 14.0), strict=True)
        for blend, shape, size in both:
            own = blend.own_time(t)
            scale = own if blend.sources[0] is None else 1.0 - own
            box = control_box(shape.clips[0].paths)
            assert (box.width, box.height) == pytest.approx((scale * size, scale * size), abs=1e-6)
            assert complex(box.x, box.y) == pytest.approx(centre + scale * (2 + 2j - centre), abs=1e-6)


STOPS = '<stop stop-color="#f00"/><stop offset="1" stop-color="#00f"/>'
UNITS = 'id="g" gradientUnits="userSpaceOnUse"'


@pytest.mark.parametrize(
    ("paint", "changing"),
    [
        (f'<radialGradient {UNITS} cx="8" cy="9" r="7">{STOPS}</radialGradient>', ("centre", "radii")),
        (f'<linearGradient {UNITS} x1="3" y1="4" x2="20" y2="18">{STOPS}</linearGradient>', ("start", "end")),
    ],
)
@pytest.mark.parametrize("where", ["fill", "stroke"])
def test_gradients_shrink_and_grow_with_what_they_paint(paint, changing, where):
    paths = (
        f'<path style="fill:none;{where}:url(#g)" d="{d}"/>' for d in ("M1 1h21v9h-21z", "M4 2h9v20h-9z")
    )
    (pair,), _ = match_all([drawing(paint + path) for path in paths], Settings(swap="always"))
    centre = pair.views[0].centre
    for scale, whole, here in painted_at(pair, (0.2, 0.4, 0.5)):
        for name in changing:
            now, then = (getattr(getattr(style, f"{where}_gradient"), name) for style in (here, whole))
            if isinstance(then, complex):
                now, then = now - centre, then - centre
            assert np.array(now) == pytest.approx(scale * np.array(then), abs=1e-2)


def test_patterns_stay_which_css_would_move_in_steps():
    tile = (
        '<pattern id="g" patternUnits="userSpaceOnUse" width="4" height="4"><path d="M0 0H2V2z"/></pattern>'
    )
    paths = (f'<path fill="url(#g)" stroke="url(#g)" d="{d}"/>' for d in ("M1 1h21v9h-21z", "M4 2h9v20h-9z"))
    (pair,), _ = match_all([drawing(tile + path) for path in paths], Settings(swap="always"))
    for _, whole, here in painted_at(pair, (0.2, 0.4, 0.5)):
        assert here.fill_gradient == whole.fill_gradient
        assert here.stroke_gradient == whole.stroke_gradient


@pytest.mark.parametrize("effect", ["none", "non-scaling-stroke"])
def test_dashes_and_widths_of_strokes_shrink_and_grow_with_what_they_paint(effect):
    stroke = f'fill="none" stroke="#000" stroke-width="2" stroke-dasharray="4 2" vector-effect="{effect}"'
    ends = [drawing(f'<path {stroke} d="{d}"/>') for d in ("M1 1L20 22", "M3 20L22 3")]
    (pair,), _ = match_all(ends, Settings(swap="always"))
    for scale, whole, here in painted_at(pair, (0.2, 0.4, 0.5)):
        assert here.stroke_width == pytest.approx(scale * whole.stroke_width)
        assert here.stroke_dasharray == pytest.approx(scale * np.array(whole.stroke_dasharray), abs=1e-3)


def painted_at(pair, times):
    """Yield the size of each shape at times, as a share of its own, with its own style and that at the time."""
    for t in times:
        for blend in pair.shapes:
            is_new = blend.sources[0] is None
            scale = blend.own_time(t) if is_new else 1.0 - blend.own_time(t)
            if scale > 0.0:
                yield scale, blend.style(int(is_new)), shape_styles(blend, t)[0]


def sizes_at(pair, t):
    """Return the sizes of what leaves and of what comes, as shares of their own."""
    own = {shape.sources[0] is None: shape.own_time(t) for shape in pair.shapes}
    return 1.0 - own[False], own[True]


def test_one_of_both_is_large_nearly_all_the_time_and_never_both():
    (pair,) = blended(f"lucide/{COPY}", f"lucide/{CHECK}").pairs
    sizes = [sizes_at(pair, t) for t in np.linspace(0.0, 1.0, 101)]
    assert sizes[0] == (1.0, 0.0)
    assert sizes[-1] == (0.0, 1.0)
    assert sum(max(both) < 0.3 for both in sizes) <= 10, "in a tenth of the time"
    assert max(map(min, sizes)) < 0.15, "both together would be a lump"
    assert max(sizes[50]) > 0.75, "half way one is nearly as large as it will be"
    assert 0.6 < sizes[33][0] < 0.8, "it is seen to shrink, else the change would be a cut"


@pytest.mark.parametrize(
    ("outline", "options"),
    [
        ("M2 8L6 12L10 8L6 4Z", {}),
        ("M2 8L40 12L10 8L6 4Z", {"viewbox": "grow"}),
        ("M2 8L6 12L10 8L6 4Z", {"place": "bbox", "viewbox": "grow"}),
    ],
)
@pytest.mark.parametrize("backwards", [False, True])
def test_what_leaves_or_grows_stays_in_a_view_that_changes(tmp_path, outline, options, backwards):
    narrow = tmp_path / "narrow.svg"
    narrow.write_text(
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 12 24"><path d="{outline}"/></svg>'
    )
    ends = [narrow, ICONS / "lucide" / "sun.svg"]
    (pair,) = sb.blend(*ends[:: -1 if backwards else 1], swap="always", **options).pairs
    for t in np.linspace(0.0, 1.0, 33):
        view = pair.views[0].interpolate(pair.views[1], t)
        for shape in pair.shapes:
            box = control_box(paths_at(shape, t))
            assert view.expanded(1e-6).contains(box)


@pytest.mark.parametrize("width", [19, 21, 24])
def test_a_view_that_changes_makes_a_drawing_no_smaller_than_it_has_to_be(tmp_path, width):
    wide, narrow = (drawing(f'<path d="M1 4H{x - 1}V20H1z"/>', viewbox=f"0 0 {x} 24") for x in (24, width))
    for ends, leaves in ((wide, narrow), True), ((narrow, wide), False):
        (pair,) = sb.blend(*ends, swap="always").pairs
        needed = [(1.0 - t) + t * (width - 2) / 22 for t in (0.1, 0.2, 0.3)]
        if leaves:  # it shrinks by itself, too
            needed = [
                min(size, 1.0 - (t / GONE) ** SHRINKS)
                for size, t in zip(needed, (0.1, 0.2, 0.3), strict=True)
            ]
        sizes = [sizes_at(pair, t if leaves else 1.0 - t)[not leaves] for t in (0.1, 0.2, 0.3)]
        assert all(size >= 0.95 * least for size, least in zip(sizes, needed, strict=True))


@pytest.mark.parametrize("each", [False, True])
def test_an_easing_comes_on_top_of_the_pace(each):
    (pair,) = blended(f"lucide/{COPY}", f"lucide/{CHECK}").pairs
    knots = (0.0, 0.0), (0.5, 0.2), (1.0, 1.0)
    changed = eased(pair, knots, each=each)
    for shape, plain in zip(changed.shapes, pair.shapes, strict=True):
        for t in np.linspace(0.0, 1.0, 41):
            there = np.interp(t, *zip(*knots, strict=True))
            assert shape.own_time(t) == pytest.approx(plain.own_time(there))


def test_it_is_told_once_with_the_way_out_and_not_if_asked_for(tmp_path, monkeypatch, capsys):
    files = [str((ICONS / "lucide" / name).resolve()) for name in (COPY, CHECK)]
    monkeypatch.chdir(tmp_path)
    assert run([*files, "-n", "1"]) == 0
    said = capsys.readouterr().err
    assert said.count("would not blend well") == 1
    assert "--swap" in said
    for choice in ("always", "never"):
        assert run([*files, "-n", "1", "-f", "--swap", choice]) == 0
        assert capsys.readouterr().err == ""


def test_solid_drawings_with_much_detail_make_room_for_a_single_stroke(tmp_path):
    cart = (
        '<path d="M17 18a2 2 0 1 1 0 4 2 2 0 0 1 0-4M1 2h3.27l.94 2H20a1 1 0 0 1 1 1c0 .17-.05.34-.12.5l-3.58 6.47c'
        "-.34.61-1 1.03-1.75 1.03H8.1l-.9 1.63-.03.12a.25.25 0 0 0 .25.25H19v2H7a2 2 0 0 1-2-2c0-.35.09-.68.24-.96"
        'l1.36-2.45L3 4H1zm6 16a2 2 0 1 1 0 4 2 2 0 0 1 0-4"/>'
    )
    (tmp_path / "cart.svg").write_text(
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 24 24">{cart}</svg>'
    )
    check = ICONS / "lucide" / CHECK
    (pair,) = sb.blend(tmp_path / "cart.svg", check).pairs
    assert is_swapped(pair.shapes)
    (tmp_path / "disc.svg").write_text(
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 24 24"><path d="{CIRCLED}"/></svg>'
    )
    (pair,) = sb.blend(tmp_path / "disc.svg", check).pairs
    assert not is_swapped(pair.shapes), "a plain disc may bend to a stroke"


DRAWINGS = Path("docs/moving/drawings")


@pytest.mark.parametrize(("a", "b"), [("envelope", "snail"), ("pause", "tulip")])
def test_drawings_of_several_colours_that_would_be_shreds_make_room(a, b):
    files = DRAWINGS / f"{a}.svg", DRAWINGS / f"{b}.svg"
    (pair,) = sb.blend(*files).pairs
    assert is_swapped(pair.shapes)
    (other,) = sb.blend(*files, swap="never").pairs
    assert grade_of(other).number > SWAP_GRADE


@pytest.mark.parametrize(("a", "b"), [("wolf", "fox"), ("grinning-face", "crying-face"), ("sun", "moon")])
def test_drawings_that_blend_well_are_not_swapped(a, b):
    (pair,) = sb.blend(DRAWINGS / f"{a}.svg", DRAWINGS / f"{b}.svg").pairs
    assert not is_swapped(pair.shapes)


SIGN = ICONS / "bootstrap/bell.svg", ICONS / "bootstrap/bookmark-check.svg"
PICTURE = DRAWINGS / "envelope.svg", DRAWINGS / "snail.svg"


@pytest.mark.parametrize(("files", "limits"), [(SIGN, (ANY, SIGNS)), (PICTURE, (ANY, COLOURED))])
@pytest.mark.parametrize(("bent", "covered"), [(0.0, 0.0), (1.0, 0.0), (0.0, 0.5), (1.0, 0.5), (0.7, 0.5)])
def test_a_bad_grade_bending_and_little_in_common_add_up(monkeypatch, files, limits, bent, covered):
    class Seen:
        ink = np.array([[0.0, covered, 1.0 - covered], [1.0] * 3, [0.0, covered, 0.0]])

    (pair,) = sb.blend(*files, swap="never").pairs
    monkeypatch.setattr(unlike, "faults_of", lambda shapes, view: FAULTY)
    monkeypatch.setattr(unlike, "seen_of", lambda shapes, view: Seen)
    monkeypatch.setattr(unlike, "_main_bending", lambda shapes: bent)
    least = min(
        max(limit.least - limit.per_bent * bent + limit.in_common * covered, limit.told) for limit in limits
    )
    monkeypatch.setattr(unlike, "grade_of_shapes", lambda shapes, view: least - 0.01)
    assert not is_hopeless(pair.shapes, pair.views[0])
    monkeypatch.setattr(unlike, "grade_of_shapes", lambda shapes, view: least + 0.01)
    assert is_hopeless(pair.shapes, pair.views[0])
    monkeypatch.setattr(unlike, "faults_of", lambda shapes, view: FAULTY - 0.01)
    assert not is_hopeless(pair.shapes, pair.views[0]), "what has no faults is not asked about"


@pytest.mark.parametrize(("a", "b"), [("cat-face", "dog-face"), ("egg", "hatching-chick")])
def test_details_that_would_melt_make_room(a, b):
    (pair,) = sb.blend(DRAWINGS / f"{a}.svg", DRAWINGS / f"{b}.svg").pairs
    assert is_swapped(pair.shapes)


@pytest.mark.parametrize("colour", ["#000", "#c00"])
def test_a_sign_that_changes_its_colour_is_a_sign(colour):
    house = '<path fill="#000" d="M12 3L21 11H18V21H6V11H3Z"/>'
    cart = [
        f'<path fill="{colour}" d="{path}"/>'
        for path in ("M3 4H6L8 14H18L20 7H7Z", "M8 17H10V20H8Z", "M16 17H18V20H16Z")
    ]
    (pair,), _ = match_all([drawing(house), drawing(*cart)], Settings(swap="never"))
    assert unlike._are_signs(pair.shapes)


@pytest.mark.parametrize(("beyond", "is_worse"), [(0.0, True), (0.01, False)])
def test_colours_whose_shapes_nearly_all_have_partners_blend_longer(monkeypatch, beyond, is_worse):
    class Seen:
        ink = np.array([[0.0, 1.0], [1.0, 1.0], [1.0, 0.0]])

    (pair,) = sb.blend(*PICTURE, swap="never").pairs
    monkeypatch.setattr(unlike, "faults_of", lambda shapes, view: FAULTY)
    monkeypatch.setattr(unlike, "seen_of", lambda shapes, view: Seen)
    monkeypatch.setattr(unlike, "_main_bending", lambda shapes: 0.0)
    monkeypatch.setattr(unlike, "grade_of_shapes", lambda shapes, view: 0.5 * (COLOURED.least + ANY.least))
    alone = sum(not shape.is_matched for shape in pair.shapes) / len(pair.shapes)
    monkeypatch.setattr(unlike, "ALONE", alone + beyond)
    assert is_hopeless(pair.shapes, pair.views[0]) == is_worse


@pytest.mark.parametrize(("covered", "is_worse"), [(BADGED - 0.01, True), (BADGED, False)])
def test_a_sign_with_a_badge_is_blended_however_much_its_outline_is_bent_by_that(
    monkeypatch, covered, is_worse
):
    class Seen:
        ink = np.array([[covered, 0.0], [1.0, 1.0], [1.0, 0.0]])

    (pair,) = sb.blend(*SIGN, swap="never").pairs
    monkeypatch.setattr(unlike, "faults_of", lambda shapes, view: FAULTY)
    monkeypatch.setattr(unlike, "seen_of", lambda shapes, view: Seen)
    monkeypatch.setattr(unlike, "_main_bending", lambda shapes: WHOLLY)
    monkeypatch.setattr(unlike, "grade_of_shapes", lambda shapes, view: 1.6)
    assert is_hopeless(pair.shapes, pair.views[0]) == is_worse


@pytest.fixture
def always_bad(monkeypatch):
    """Let any blend be graded as unusable."""
    monkeypatch.setattr(unlike, "faults_of", lambda shapes, view: 3.0)
    monkeypatch.setattr(unlike, "grade_of_shapes", lambda shapes, view: 3.0)


def is_given_up(pair):
    return is_hopeless(pair.shapes, pair.views[0])


def drawn(*paths):
    stroke = 'fill="none" stroke="#000" stroke-width="2" stroke-linecap="round" stroke-linejoin="round"'
    return drawing("".join(f'<path d="{path}" {stroke}/>' for path in paths))


PENCIL = drawn("M4 20V16L16 4L20 8L8 20Z", "M13 7L17 11", "M8 16L17 7", "M4 16L8 20")


def test_lines_that_stay_decide_nothing_if_they_are_a_small_part_of_the_other_drawing():
    (pair,), _ = match_all([PENCIL, drawn("M4 15L8 20L20 8")], Settings())
    assert is_swapped(pair.shapes), "the long arm of the check mark lies on the edge of the pencil"


@pytest.mark.usefixtures("always_bad")
def test_drawings_of_which_much_stays_blend_however_bad_that_looks():
    (pair,) = sb.blend(ICONS / "lucide/plus.svg", ICONS / "lucide/minus.svg").pairs
    assert not is_swapped(pair.shapes)


@pytest.mark.usefixtures("always_bad")
def test_a_single_outline_becomes_another_however_bad_that_looks():
    (pair,) = sb.blend("samples/bird-1.svg", "samples/bird-2.svg").pairs
    assert not is_given_up(pair)
    (pair,) = sb.blend(DRAWINGS / "wolf.svg", DRAWINGS / "fox.svg", swap="never").pairs
    assert is_given_up(pair)


@pytest.mark.usefixtures("always_bad")
def test_what_turns_as_a_whole_is_not_given_up():
    key = "M4 4H10V10H8V12H20V16H18V14H16V18H14V14H4Z M4 18H8V20H4Z"
    mirrored = "M20 4H14V10H16V12H4V16H6V14H8V18H10V14H20Z M20 18H16V20H20Z"
    (pair,), _ = match_all([drawing(f'<path d="{d}"/>') for d in (key, mirrored)], Settings())
    assert {shape.motion_name for shape in pair.shapes} == {"flip"}
    assert not is_given_up(pair)


def test_long_drawings_that_turn_to_each_other_are_given_up_as_others_are(monkeypatch):
    pencil = "M2 5L5 2L17 14L20 20L14 17Z M5 5L6 5L6 6Z"
    brush = "M22 3L20 1L9 11C6 10 6 15 2 20C7 19 12 17 11 14Z M19 3L20 3L20 4Z"
    ends = [drawing(f'<path fill-rule="evenodd" d="{d}"/>') for d in (pencil, brush)]
    (pair,), _ = match_all(ends, Settings(swap="never"))
    assert {shape.reason for shape in pair.shapes} == {POINTS_ELSEWHERE}
    monkeypatch.setattr(unlike, "faults_of", lambda shapes, view: 3.0)
    for told, is_bad in ((3.0, True), (0.5, False)):
        monkeypatch.setattr(unlike, "grade_of_shapes", lambda shapes, view, told=told: told)
        assert is_given_up(pair) == is_bad


@pytest.mark.usefixtures("always_bad")
def test_lines_that_are_cut_out_of_a_plate_become_each_other():
    bars, plus = "M6 7H18V9H6Z M6 11H18V13H6Z M6 15H18V17H6Z", "M11 6H13V11H18V13H13V18H11V13H6V11H11Z"
    paths = (f'<path fill-rule="evenodd" d="{CIRCLED} {d}"/>' for d in (bars, plus))
    (pair,), _ = match_all([drawing(path) for path in paths], Settings())
    assert [shape.motion_name for shape in pair.shapes] == ["pen"]
    assert not is_given_up(pair)


@pytest.mark.usefixtures("always_bad")
def test_letters_become_letters():
    letters = "".join(f"M{x} 20h12v24h-12zm3 3v8h6v-8z" for x in (2, 18, 34, 50))
    others = "".join(f"M{x} 44l6-24 6 24h-3l-3-9-3 9z" for x in (2, 18, 34, 50))
    house = "M32 4L60 30V60H4V30Z M28 40V56H36V40Z"
    for end, is_exchanged in ((others, False), (house, True)):
        ends = [drawing(f'<path d="{d}"/>', viewbox="0 0 64 64") for d in (letters, end)]
        (pair,), _ = match_all(ends, Settings())
        assert is_swapped(pair.shapes) == is_exchanged


def test_the_largest_outline_says_how_much_is_bent():
    files = DRAWINGS / "envelope.svg", DRAWINGS / "snail.svg"
    (pair,) = sb.blend(*files, swap="never").pairs
    assert 0.0 < unlike._main_bending(pair.shapes) <= WHOLLY
    (other,) = sb.blend(*files, swap="always").pairs
    assert unlike._main_bending(other.shapes) == WHOLLY, "none has a partner"


@pytest.mark.parametrize(
    ("a", "b", "least"),
    [
        ("play", "pause", TOLD_IF_SPLIT),
        ("menu", "x", TOLD_IF_BARS),
        ("menu", "check", TOLD_IF_SIMPLE),
        ("copy", "check", TOLD_IF_BENT),
        ("sun", "moon", TOLD),
    ],
)
def test_lines_that_can_be_read_may_have_a_worse_grade(monkeypatch, a, b, least):
    found = []
    usual = unlike._least_told
    monkeypatch.setattr(unlike, "faults_of", lambda shapes, view: 3.0)
    monkeypatch.setattr(unlike, "_least_told", lambda *given: found.append(usual(*given)) or found[-1])
    blended(f"lucide/{a}.svg", f"lucide/{b}.svg")
    assert found == [least]


def test_drawings_that_stay_where_they_lie_go_to_each_other():
    files = DRAWINGS / "envelope.svg", DRAWINGS / "snail.svg"
    (pair,) = sb.blend(*files, place="asis").pairs
    assert not is_swapped(pair.shapes)


def test_what_is_named_becomes_what_it_is_to_become():
    (pair,) = blended(f"lucide/{COPY}", f"lucide/{CHECK}", match=(("0", "0"),)).pairs
    assert not is_swapped(pair.shapes)


def test_anything_can_be_swapped_but_not_mixed_or_staggered():
    files = "samples/bird-1.svg", "samples/bird-2.svg"
    (pair,) = sb.blend(*files, swap="always").pairs
    assert {shape.reason for shape in pair.shapes} == {ASKED}
    for others in ({"mix": ((0.5, 0.5),)}, {"stagger": 0.5}):
        (pair,) = sb.blend(*files, swap="always", **others).pairs
        assert not is_swapped(pair.shapes)


DISC = "M12 2A10 10 0 1 0 12 22A10 10 0 1 0 12 2Z"
TICK_OUT = "M7 12L11 16L18 8L16.6 6.6L11 13L8.4 10.6Z"
BOLD_D = '<path fill-rule="evenodd" d="M3 2H13A10 10 0 0 1 13 22H3ZM8 8H12A4 4 0 0 1 12 16H8Z"/>'
THIN_D = "M4 2H12A9 10 0 0 1 12 22H4ZM5.5 3.5V20.5H12A7.5 8.5 0 0 0 12 3.5Z"
TICK = "M3 13L9 19L22 6L20.6 4.6L9 16.2L4.4 11.6Z"


@pytest.mark.parametrize(
    ("plate", "sign", "is_given_up"),
    [
        (f'<path fill-rule="evenodd" d="{DISC}{TICK_OUT}"/>', TICK, True),
        (f'<path fill-rule="evenodd" d="{DISC}M11 11H13V13H11Z"/>', TICK, False),
        (f'<path d="{DISC}"/>', TICK, False),
        (f'<path fill-rule="evenodd" d="{DISC}M8 8H16V16H8Z"/>', "M5 5H19V19H5Z", False),
        (BOLD_D, THIN_D, False),
    ],
    ids=["a tick in a disc", "a hole", "a disc", "a square in a disc", "a letter in two weights"],
)
def test_a_plate_with_a_sign_cut_out_makes_room_for_the_sign_alone(plate, sign, is_given_up):
    for sides in ((plate, sign), (sign, plate)):
        (pair,), _ = match_all([drawing(side) for side in sides], Settings())
        assert is_swapped(pair.shapes) == is_given_up
