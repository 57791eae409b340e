"""Parts without a partner that leave early, or come late."""

import numpy as np
import pytest

from shapeblend_cli.blending.parts.alone import alone_in_the_way
from shapeblend_cli.frames.frames import shapes_at
from shapeblend_cli.interpolate.paths import paths_at, waypoints
from shapeblend_cli.motion.early import Early
from shapeblend_cli.options.settings import Settings
from shapeblend_cli.pipeline import match_all
from tests.support.drawings import drawing

BIN = '<path d="M5 3H19L18 22H6ZM9 8V18H10V8ZM14 8V18H15V8Z"/>'
CHECK = '<path d="M4 12L10 18L21 6" fill="none" stroke="#000" stroke-width="2"/>'


def sizes(a, b, t):
    """The sizes of the contours without a partner at a time, and of those with one."""
    (pair,), _ = match_all([a, b], Settings(swap="never"))
    found = {True: [], False: []}
    for shape in pair.shapes:
        for contour, path in zip(shape.contours, paths_at(shape, t), strict=True):
            found[contour.is_matched].append(np.ptp(path.segments.real) + np.ptp(path.segments.imag))
    return found[False], found[True]


def test_holes_of_a_solid_shape_are_gone_before_it_is_a_check_mark():
    solid, sign = drawing(BIN), drawing(CHECK)
    for pair, early, late in (((solid, sign), 0.2, 0.6), ((sign, solid), 0.8, 0.15)):
        assert all(size > 1.0 for size in sizes(*pair, early)[0])
        holes, others = sizes(*pair, late)
        assert len(holes) == 2
        assert max(holes) < 0.01 < min(others)


def test_what_is_filled_is_so_all_of_the_time():
    frame, box = drawing('<path d="M3 3H21V21H3ZM5 5V19H19V5Z"/>'), drawing('<path d="M3 3H21V21H3Z"/>')
    (pair,), _ = match_all([frame, box], Settings())
    assert not any(isinstance(shape.motion, Early) for shape in pair.shapes)
    assert min(sizes(frame, box, 0.8)[0]) > 1.0


RAYS = "".join(
    f'<path d="M{x} {y}h1v1h-1z"/>' for x, y in ((11.5, 2.5), (11.5, 20.5), (2.5, 11.5), (20.5, 11.5))
)


def disc(x, radius):
    return f'<circle cx="{x}" cy="12" r="{radius}"/>'


def test_parts_that_what_moves_would_touch_are_gone_before_and_others_like_them_too():
    sun, moon = drawing(disc(12, 5), RAYS), drawing(disc(15, 7))
    for pair, late in (((sun, moon), 0.6), ((moon, sun), 0.15)):
        rays, others = sizes(*pair, late)
        assert len(rays) == 4
        assert max(rays) < 0.01 < min(others)
    assert min(sizes(moon, sun, 0.4)[0]) > 0.1  # what hardly changes is not waited for


def test_parts_come_late_into_what_changes_much_and_holes_soon_if_none_go():
    bar, cross = '<path d="M2 2H4V22H2Z"/>', "M10 2H14V10H22V14H14V22H10V14H2V10H10Z"
    chip, hole = '<path d="M3 16h4v4h-4z"/>', "M11 11V13H13V11Z"
    late, _ = sizes(drawing(bar), drawing(f'<path d="{cross}"/>', chip), 0.45)
    soon, _ = sizes(drawing(bar), drawing(f'<path d="{cross}{hole}"/>'), 0.45)
    assert len(late) == len(soon) == 1
    assert late[0] < 0.01 < soon[0]


def test_parts_take_all_of_the_time_if_what_is_beside_them_hardly_changes():
    rays, _ = sizes(drawing(disc(12, 5), RAYS), drawing(disc(12, 5.3)), 0.6)
    assert len(rays) == 4
    assert min(rays) > 0.5


def test_parts_of_another_size_do_not_go_with_those_that_are_touched():
    sun = drawing(disc(12, 5), RAYS, '<path d="M1 1h3v3h-3z"/>')
    (pair,), _ = match_all([sun, drawing(disc(15, 7))], Settings())
    shapes = [shape._replace(motion=None) for shape in pair.shapes]
    contours = [contour for shape in shapes for contour in shape.contours]
    rays = {(contour.a, None) for contour in contours if contour.b is None and contour.scale_a < 2.0}
    assert len(rays) == 4
    assert alone_in_the_way(shapes, 24.0) == rays


@pytest.mark.parametrize("arc", ["M12 20A8 8 0 1 0 4 12", "M4 12A8 8 0 1 1 12 20"])
def test_what_sticks_out_of_a_line_and_has_no_partner_goes_with_the_line(arc):
    arrow = drawing(
        f'<path d="{arc}" fill="none" stroke="#000" stroke-width="2"/>', '<path d="M1 12H7L4 16Z"/>'
    )
    for k, pair in enumerate(((arrow, drawing(CHECK)), (drawing(CHECK), arrow))):
        (match,), _ = match_all([*pair], Settings())
        (head,) = (shape for shape in match.shapes if not shape.is_matched)
        (line,) = (shape for shape in match.shapes if shape.is_matched)
        for t in (0.1, 0.3, 0.45):
            own, stroke = (paths_at(shape, 1.0 - t if k else t)[0].segments for shape in (head, line))
            ends = stroke[0, 0], stroke[-1, 3]
            assert min(abs(own[:, 0].mean() - place) for place in ends) < 1.4  # as where it is whole


@pytest.mark.parametrize("colour", ["#000", "#c00"])
def test_parts_are_gone_early_and_come_late_where_much_changes_the_small_ones_most(colour):
    mug, glass = "M3 4H15V20H3Z", "M2 3H22L13 14V20H11V14Z"
    speck, door = (f'<path fill="{colour}" d="{path}"/>' for path in ("M1 21H3V23H1Z", "M17 5H22V21H17Z"))
    for plain, other in ((mug, glass), (glass, mug)):
        ends = drawing(plain, speck), drawing(other)
        assert sizes(*ends, 0.2)[0][0] > 2.0
        assert sizes(*ends, 0.35)[0][0] < 0.01
        assert sizes(*ends[::-1], 0.45)[0][0] < 0.01
        assert sizes(*ends[::-1], 0.65)[0][0] > 1.5, "it is a speck for a moment only"
    leaving, coming = (drawing(mug, door), drawing(glass)), (drawing(mug), drawing(glass, door))
    assert sizes(*leaving, 0.3)[0][0] > 5.0
    assert sizes(*leaving, 0.42)[0][0] < 0.01, "it would be a small door on a glass"
    assert sizes(*coming, 0.24)[0][0] < 0.01, "it would be a small door on a mug"
    assert sizes(*coming, 0.45)[0][0] > 5.0


@pytest.mark.parametrize(("size", "goes_along"), [(4, True), (1, False)])
def test_what_nearly_fills_a_part_without_a_partner_goes_with_it_and_what_is_smaller_before(size, goes_along):
    mug, glass = "M3 4H15V20H3Z", "M2 3H22L13 14V20H11V14Z"
    eye = f'<path fill="#c00" d="M17 8H23V14H17Z"/><path fill="#fff" d="M18 9h{size}v{size}h-{size}z"/>'
    outer, inner = sizes(drawing(mug, eye), drawing(glass), 0.3)[0]
    assert outer > inner
    assert (inner > 0.9 * outer * size / 6) == goes_along


def test_a_stroke_without_a_partner_leaves_no_dot():
    mug, glass = "M3 4H15V20H3Z", "M2 3H22L13 14V20H11V14Z"
    ring = '<path fill="none" stroke="#c00" stroke-width="2" d="M18 8H22V12H18Z"/>'
    for k, ends in enumerate(((drawing(mug, ring), drawing(glass)), (drawing(glass), drawing(mug, ring)))):
        (pair,), _ = match_all([*ends], Settings(swap="never"))
        widths = [s.style.stroke_width for s in shapes_at(pair, 0.6 - 0.2 * k) if s.style.stroke]
        assert widths == []


def test_details_leave_early_even_if_most_of_a_drawing_has_no_partner_and_the_rest_by_half_time():
    crown, cap = "M2 20L12 12L22 20Z", "M2 16H22V22H2Z"
    head, horn = '<path fill="#c00" d="M4 2H20V11H4Z"/>', '<path fill="#00c" d="M1 1H3V3H1Z"/>'
    ends = drawing(crown, head, head.replace("c00", "a00"), horn), drawing(cap)
    heads, small = sorted(sizes(*ends, 0.4)[0])[1:], min(sizes(*ends, 0.4)[0])
    assert small < 0.01
    assert min(heads) == pytest.approx(0.43 * 25.0, rel=0.2)
    assert max(sizes(*ends, 0.52)[0]) < 0.01
    assert min(sizes(*ends[::-1], 0.2)[0][:2]) > 9.0


@pytest.mark.parametrize(("foot", "colour"), [(10, "#000"), (10, "#c00"), (9, "#c00")])
def test_what_stands_on_a_shape_stays_on_it_while_it_sinks_in_or_comes_out(foot, colour):
    hull, raft = '<path d="M2 10H22L18 20H6Z"/>', '<path d="M2 18H22V23H2Z"/>'
    sail = f'<path fill="{colour}" d="M9 1H16V{foot}H9Z"/>'
    for ends, times in (((hull + sail, raft), (0.1, 0.3)), ((raft, hull + sail), (0.8, 0.6))):
        (pair,), _ = match_all([drawing(end) for end in ends], Settings())
        for t in times:
            boxes = {True: [], False: []}
            for shape in pair.shapes:
                for contour, path in zip(shape.contours, paths_at(shape, t), strict=True):
                    boxes[contour.is_matched].append(path.segments.imag)
            (sails,), (boat,) = boxes[False], boxes[True]
            assert np.ptp(sails) > 2.0
            assert abs(boat.min() - sails.max()) < 10.2 - foot


def test_parts_of_about_one_size_go_together_in_few_steps():
    mug, glass = "M3 4H15V20H3Z", "M2 3H22L13 14V20H11V14Z"
    specks = [f"M{x} 1h{size}v{size}h-{size}z" for x, size in ((17, 1.5), (19.5, 1.7), (22, 1.6))]
    (pair,), _ = match_all([drawing(mug + "".join(specks)), drawing(glass)], Settings())
    (shape,) = pair.shapes
    assert [contour.b for contour in shape.contours].count(None) == 3
    assert shape.motion is not None
    assert len(waypoints(shape._replace(motion=shape.motion._replace(motion=None)))) <= 2
