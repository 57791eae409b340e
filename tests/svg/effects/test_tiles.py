"""Patterns and soft masks as they are read, blended and written."""

from itertools import pairwise

import numpy as np
import pytest

from shapeblend_cli.frames.frames import frame_at
from shapeblend_cli.interpolate.chains import keyframed_shapes
from shapeblend_cli.model import Box, Pattern
from shapeblend_cli.options.easing import Timing
from shapeblend_cli.outputs.move import left_out, moves_of
from shapeblend_cli.svg.reading import walk
from shapeblend_cli.svg.writing.animation import Views
from shapeblend_cli.svg.writing.css import css_svg
from shapeblend_cli.svg.writing.document import frame_svg
from shapeblend_cli.svg.writing.smil import smil_svg
from tests.svg.effects.test_effects import BOX, DISC, difference, frames, pair_of, picture
from tests.svg.reading.drawings import drawn, refused, svg

DOT = '<rect width="10" height="10" fill="#fe8"/><circle cx="5" cy="5" r="3" fill="#06c"/>'
DOTS = f'<pattern id="p" width="10" height="10" patternUnits="userSpaceOnUse" {{}}>{DOT}</pattern>'
FILLED = '<rect x="10" y="20" width="60" height="40" fill="url(#p)"/>'
RAMP = '<linearGradient id="g"><stop stop-color="#fff"/><stop offset="1" stop-color="#000"/></linearGradient>'
SOFT = f'{RAMP}<mask id="m">{{}}<rect x="10" y="20" width="60" height="60" fill="url(#g)"/></mask>'
MASKED = f'<g mask="url(#m)">{BOX}{DISC}</g>'


def pattern(markup, shape=FILLED):
    drawing = drawn(markup + shape)
    assert drawing.notes == ()
    found = drawing.shapes[-1].style.fill_gradient
    assert isinstance(found, Pattern)
    return found


@pytest.mark.parametrize(
    ("attributes", "shape", "expected"),
    [
        ('patternUnits="userSpaceOnUse" width="10" height="10"', FILLED, (0j, (10, 10), (1, 1), 0)),
        (
            'patternUnits="userSpaceOnUse" x="3" y="4" width="10" height="10"',
            FILLED,
            (3 + 4j, (10, 10), (1, 1), 0),
        ),
        ('width=".5" height=".25"', FILLED, (10 + 20j, (30, 10), (1, 1), 0)),
        (
            'patternUnits="userSpaceOnUse" width="10" height="5" patternTransform="rotate(90) scale(2 3)"',
            FILLED,
            (0j, (10, 5), (2, 3), 90),
        ),
        (
            'patternUnits="userSpaceOnUse" width="10" height="5"',
            f'<g transform="translate(5 6) scale(2)">{FILLED}</g>',
            (5 + 6j, (10, 5), (2, 2), 0),
        ),
    ],
)
def test_a_tile_is_where_the_file_has_it(attributes, shape, expected):
    found = pattern(f'<pattern id="p" {attributes}>{DOT}</pattern>', shape)
    assert found.origin == pytest.approx(expected[0])
    assert (found.size, found.scale, found.angle) == (
        expected[1],
        pytest.approx(expected[2]),
        pytest.approx(expected[3]),
    )


def test_a_large_tile_may_be_scaled_down():
    dots = DOTS.replace('width="10"', 'width="1000"').format('patternTransform="scale(.01 1)"')
    assert pattern(dots).scale == pytest.approx((0.01, 1))


@pytest.mark.parametrize(
    "definitions",
    [
        '<pattern id="p" href="#p"/>',
        '<pattern id="p" href="#q"/>',
        '<pattern id="p" href="#q"/><pattern id="q" href="#p"/>',
        f'<pattern id="p">{DOT}</pattern>',
        f'<pattern id="p" width="-1" height="nan">{DOT}</pattern>',
        f'<pattern id="p" width="10" height="0">{DOT}</pattern>',
        f'<pattern id="p" href="#q" width="-1"/><pattern id="q" width="1" height="1">{DOT}</pattern>',
    ],
)
def test_a_pattern_without_a_tile_paints_nothing(definitions):
    drawing = drawn(definitions + FILLED + FILLED.replace("url(#p)", "url(#p) red") + BOX)
    assert [shape.style.fill for shape in drawing.shapes] == ["#ff0000", drawn(BOX).shapes[0].style.fill]
    assert drawing.notes == ()


def test_patterns_refer_to_each_other_and_have_viewboxes():
    found = pattern(f'{DOTS.format("")}<pattern id="q" href="#p" width="20"/>', FILLED.replace("#p", "#q"))
    assert found.size == (20, 10)
    box = pattern(f'<pattern id="p" width=".5" height=".5" viewBox="0 0 10 10">{DOT}</pattern>')
    circle = box.content.shapes[1].contours[0].segments
    assert Box.around(circle) == pytest.approx((9, 4, 12, 12))  # in a tile of 30 by 20


def test_a_plain_colour_stands_for_a_pattern_where_there_is_none():
    assert drawn(DOTS.format("") + FILLED).shapes[0].style.fill == "#ffee88"


PAINTED = {
    "dots": DOTS.format("") + FILLED,
    "turned": DOTS.format('patternTransform="rotate(20) skewX(10) scale(.7 1.4)"') + FILLED,
    "stroke": DOTS.format("") + '<path d="M10 10h60v60" fill="none" stroke="url(#p)" stroke-width="15"/>',
    "patterns in patterns": DOTS.format("")
    + '<pattern id="q" width="40" height="40" patternUnits="userSpaceOnUse"><circle cx="20" cy="20" r="18" '
    'fill="url(#p)"/></pattern><rect width="90" height="90" fill="url(#q)"/>',
    "a soft mask": SOFT.format("") + MASKED,
    "of half": f'<mask id="m"><circle cx="50" cy="50" r="20" fill="#fff" opacity=".5"/></mask>{MASKED}',
    "of alpha": f'<mask id="m" mask-type="alpha"><circle cx="50" cy="50" r="20" fill-opacity=".7"/></mask>{MASKED}',
    "of the box": f'{RAMP}<mask id="m" maskContentUnits="objectBoundingBox"><rect width="1" height="1" '
    f'fill="url(#g)"/></mask>{MASKED}',
    "turned mask": SOFT.format("") + f'<g transform="rotate(10)">{MASKED}</g>',
    "a mask with a blur": '<filter id="f"><feGaussianBlur stdDeviation="5"/></filter><mask id="m">'
    f'<circle cx="50" cy="50" r="20" fill="#fff" filter="url(#f)"/></mask>{MASKED}',
    "a mask in a mask": f'<mask id="n"><rect width="60" height="60" fill="#888"/></mask>{SOFT.format("")}'
    f'<g mask="url(#n)">{MASKED}</g>',
}


@pytest.mark.parametrize("markup", PAINTED.values(), ids=PAINTED)
def test_ends_look_as_the_files(markup):
    for k, shown in enumerate(frames(markup, BOX, 0.0, 1.0)):
        assert difference(shown, picture(svg(markup if k == 0 else BOX).decode())) < 0.04


def test_a_mask_hides_all_that_it_does_not_draw():
    empty = frames(f'<mask id="m"/>{MASKED}<path d="M0 0h9v9z"/>', BOX, 0.0)[0]
    assert empty[50, 50].tolist() == [1.0, 1.0, 1.0]


def test_equal_tiles_move_turn_and_are_scaled():
    a = DOTS.format('patternTransform="translate(4 2) rotate(10)"') + FILLED
    b = DOTS.format('patternTransform="rotate(50) scale(2)"') + FILLED
    pair, _ = pair_of(a, b)
    (shape,) = frame_at(pair, 0.5, as_drawn=True).shapes
    found = shape.style.fill_gradient
    assert (found.origin, found.angle, found.scale) == (
        pytest.approx(2 + 1j),
        pytest.approx(30),
        pytest.approx((1.5, 1.5)),
    )
    assert shape.below is None


def test_other_paint_dissolves_into_a_pattern():
    plain = FILLED.replace("url(#p)", "#fff")
    none, little, half, much, whole = frames(plain, DOTS.format("") + FILLED, 0.0, 0.02, 0.5, 0.98, 1.0)
    assert np.abs(half - (none + whole) / 2).max() < 0.02
    for one, other in ((none, little), (much, whole)):
        assert np.abs(one - other).max() < 0.04


def test_a_gradient_and_a_pattern_dissolve_into_each_other():
    shaded, dotted = RAMP + FILLED.replace("url(#p)", "url(#g)"), DOTS.format("") + FILLED
    for a, b in ((shaded, dotted), (dotted, shaded)):
        none, little, much, whole = frames(a, b, 0.0, 0.02, 0.98, 1.0)
        assert max(np.abs(none - little).max(), np.abs(much - whole).max()) < 0.05


def test_masks_dissolve_into_each_other_and_move_with_what_they_mask():
    other = SOFT.format("").replace('"#fff"', '"#000"', 1) + MASKED
    none, half, whole = frames(SOFT.format("") + MASKED, other, 0.0, 0.5, 1.0)
    assert np.abs(half - (none + whole) / 2).mean() < 0.01
    away = MASKED.replace("<g ", '<g transform="translate(20 0)" ')
    first, last = frames(SOFT.format("") + MASKED, SOFT.format("") + away, 0.0, 1.0)
    (middle,) = frames(SOFT.format("") + MASKED, SOFT.format("") + away, 0.5)
    assert np.abs(middle[:, 10:80] - first[:, :70]).mean() < 0.01
    assert np.abs(last[:, 20:80] - first[:, :60]).mean() < 0.01


def test_a_mask_that_only_one_drawing_has_comes_by_its_strength():
    shown = frames(BOX + DISC, SOFT.format("") + MASKED, 0.0, 0.02, 0.5, 0.98, 1.0)
    changes = [np.abs(a - b).mean() for a, b in pairwise(shown)]
    assert changes[0] < 0.15 * changes[1]
    assert changes[3] < 0.15 * changes[2]


def test_animations_have_patterns_and_masks_that_change():
    a = DOTS.format("") + FILLED + SOFT.format("") + MASKED
    b = DOTS.format('patternTransform="rotate(50)"') + FILLED + BOX + DISC
    pair, _ = pair_of(a, b)
    shapes, view = keyframed_shapes([pair]), Box(0, 0, 100, 100)
    moving = smil_svg(shapes, Views([view, view]), Timing(), 2)
    assert moving.count("<pattern") == moving.count("<mask") == 1
    assert 'attributeName="patternTransform"' in moving
    styled = css_svg(shapes, view, Timing(), 2)
    assert styled.count("<pattern") == 25
    assert styled.count("<mask") == 1
    for text in (moving, styled):
        assert picture(text).min() < 0.5


def test_other_programs_get_plain_colours_and_notes():
    pair, _ = pair_of(DOTS.format("") + FILLED + SOFT.format("") + MASKED, BOX)
    (move,) = moves_of([pair])
    assert "its pattern is a plain colour in Lottie" in move.unsupported_in("Lottie")[0]
    assert left_out([pair], "Lottie") == ["masks are left out of Lottie; frames and animated SVGs have them"]


# Each pattern draws ten of the next one, each in another size.
NESTED = "".join(
    f'<pattern id="p{k}" width="9" height="9" patternUnits="userSpaceOnUse">'
    + "".join(
        f'<g transform="scale(1.{n})"><rect width="9" height="9" fill="url(#p{k + 1})"/></g>'
        for n in range(10)
    )
    + "</pattern>"
    for k in range(10)
)


def cell(name, paint, more=""):
    """A pattern that is red on the left and painted otherwise on the right."""
    return (
        f'<pattern id="{name}" width="8" height="8" patternUnits="userSpaceOnUse" {more}>'
        f'<rect width="4" height="8" fill="red"/><rect x="4" width="4" height="8" fill="{paint}"/></pattern>'
    )


def fills(drawing, *path):
    """The fills in the pattern of the first shape, or in one within it: where its shapes are filled."""
    content = drawing.shapes[0].style.fill_gradient.content
    for k in path:
        content = content.shapes[k].style.fill_gradient.content
    return [shape.style.fill for shape in content.shapes]


def used(name):
    return f'<rect width="60" height="40" fill="url(#{name})"/>'


# As Chromium draws them.
@pytest.mark.parametrize(
    ("markup", "path", "wanted"),
    [
        (cell("p", "url(#p)") + used("p"), (), ["#ff0000"]),
        (cell("p", "url(#p) lime") + used("p"), (), ["#ff0000", "#00ff00"]),
        (cell("p", "blue", 'fill="url(#p)"').replace('fill="blue"', "") + used("p"), (), ["#ff0000"]),
        # Of references in a circle the last one in the file does not count, wherever it is drawn.
        (cell("p", "url(#q)") + cell("q", "url(#p)") + used("p"), (1,), ["#ff0000"]),
        (cell("p", "url(#q)") + cell("q", "url(#p)") + used("q"), (), ["#ff0000"]),
        (cell("p", "url(#q)") + cell("q", "url(#p) lime") + used("q"), (), ["#ff0000", "#00ff00"]),
        (cell("p", "url(#q)") + cell("q", "url(#r)") + cell("r", "url(#p)") + used("r"), (), ["#ff0000"]),
        (cell("p", "url(#q)") + cell("q", "url(#r)") + cell("r", "url(#p)") + used("p"), (1, 1), ["#ff0000"]),
        (f'<pattern id="a" href="#p" width="4"/>{cell("p", "url(#a)")}{used("p")}', (), ["#ff0000"]),
        # Those that only share another one are in no circle.
        (
            cell("p", "url(#r)") + cell("q", "url(#p)") + cell("r", "lime") + used("q"),
            (1, 1),
            ["#ff0000", "#00ff00"],
        ),
    ],
)
def test_patterns_are_not_drawn_in_themselves(markup, path, wanted):
    drawing = drawn(markup)
    assert fills(drawing, *path) == wanted
    assert drawing.notes == ()


def test_a_shape_that_is_in_its_own_pattern_is_drawn_without_itself():
    circle = '<circle id="c" cx="4" cy="4" r="4" fill="url(#p)"/>'
    pattern = f'<pattern id="p" width="8" height="8" patternUnits="userSpaceOnUse">{circle}{BOX}</pattern>'
    drawing = drawn(f'{pattern}<use href="#c"/>')
    assert len(drawing.shapes) == len(fills(drawing)) == 1
    assert drawing.notes == ()


@pytest.mark.parametrize(
    "inner", ['<rect width="9" height="9" fill="none"/>', '<rect width="9" height="9" fill="url(#p)"/>']
)
def test_a_pattern_in_which_nothing_is_drawn_paints_nothing(inner):
    pattern = f'<pattern id="p" width="9" height="9" patternUnits="userSpaceOnUse">{inner}</pattern>'
    lined = used("p").replace("/>", ' stroke="red"/>')
    drawing = drawn(pattern + used("p") + lined + BOX)
    assert [(shape.style.fill is None, shape.style.stroke) for shape in drawing.shapes] == [
        (True, "#ff0000"),
        (False, drawing.shapes[1].style.stroke),
    ]
    refused(pattern + used("p"), "no painted shape")


def test_patterns_and_masks_in_each_other_are_bounded(monkeypatch):
    drawing = drawn(f'<mask id="m"><g mask="url(#m)">{BOX}</g></mask>{MASKED}')
    assert "deeper than 4 left out" in drawing.notes[0]
    drawing = drawn(f'{NESTED}<rect width="9" height="9" fill="url(#p0)"/>')
    assert "deeper than 4 left out" in drawing.notes[0]
    monkeypatch.setattr(walk, "MAX_CONTENTS", 2)
    boxed = f'<pattern id="p" width=".5" height=".5" patternContentUnits="objectBoundingBox">{DOT}</pattern>'
    shapes = "".join(f'<rect width="{k}" height="9" fill="url(#p)"/>' for k in (1, 2, 3))
    refused(boxed + shapes, "more than 2 patterns and masks, the limit")


@pytest.mark.parametrize(
    "markup",
    [
        f'<pattern id="p" width="1e8" height="1e8" patternUnits="userSpaceOnUse">{DOT}</pattern>{FILLED}',
        f'<pattern id="p" width="1" height="1"><image href="http://example.org/a.png"/></pattern>{FILLED}',
        f'<pattern id="p" width="1" height="1"><script>alert(1)</script>{DOT}</pattern>{FILLED}',
        f'<pattern id="p" width="1" height="1" patternTransform="scale(0)">{DOT}</pattern>{FILLED}',
        f'<mask id="m"><image href="http://example.org/a.png"/></mask>{MASKED}',
        f'<mask id="m" width="-1">{DOT}<rect fill-opacity=".5" width="5" height="5"/></mask>{MASKED}',
        f'<mask id="m" x="-1e8" width="2e8" maskUnits="userSpaceOnUse">{DOT}</mask>{MASKED}',
    ],
)
def test_what_makes_no_sense_is_read_without_harm(markup):
    pair, _ = pair_of(markup, BOX)
    for t in (0.0, 0.5):
        text = frame_svg(frame_at(pair, t, as_drawn=True), 2)
        assert not any(word in text for word in ("example.org", "nan", "script", "image"))
        picture(text)


def test_nested_viewports_clip_what_overflows_unless_it_may_be_seen():
    nested = '<svg x="10" y="20" width="30" height="40" viewBox="0 0 3 4" {}><circle r="9"/></svg>'.format
    (clip,) = drawn(nested("")).shapes[0].clips
    assert Box.around(clip.paths[0].segments) == (10, 20, 30, 40)
    assert drawn(nested('overflow="visible"')).shapes[0].clips == ()
    symbol = (
        '<symbol id="s" viewBox="0 0 1 1"><circle r="9"/></symbol><use href="#s" width="20" height="20"/>'
    )
    assert len(drawn(symbol).shapes[0].clips) == 1


def test_paint_that_is_not_there_is_none_as_in_browsers():
    drawing = drawn(f'<rect width="9" height="9" fill="url(#no)" stroke="red"/>{BOX}')
    assert (drawing.shapes[0].style.fill, drawing.shapes[0].style.stroke) == (None, "#ff0000")


def test_colours_of_stops_are_those_of_their_gradient():
    stops = '<stop stop-color="currentColor"/><stop offset="1" stop-color="blue"/>'
    markup = f'<linearGradient id="g" color="red">{stops}</linearGradient><rect width="9" height="9" fill="url(#g)"/>'
    assert drawn(markup).shapes[0].style.fill_gradient.stops[0].colour == "#ff0000"
    bare = markup.replace('color="red"', "", 1)
    around = f'<g color="lime" style="--c: red">{bare}</g>'
    assert drawn(around).shapes[0].style.fill_gradient.stops[0].colour == "#00ff00"
    by_name = around.replace('"currentColor"', '"var(--c)"')
    assert drawn(by_name).shapes[0].style.fill_gradient.stops[0].colour == "#ff0000"
