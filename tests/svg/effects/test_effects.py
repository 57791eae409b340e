"""Filters, opacities and blend modes as they are read, blended and written."""

import io

import numpy as np
import pytest
import resvg_py
from PIL import Image

from shapeblend_cli.frames.frames import frame_at
from shapeblend_cli.interpolate.chains import keyframed_shapes
from shapeblend_cli.model import Box
from shapeblend_cli.options.easing import Timing
from shapeblend_cli.options.settings import Settings
from shapeblend_cli.outputs.move import left_out, moves_of
from shapeblend_cli.pipeline import match_all
from shapeblend_cli.svg.effects import layers, primitives
from shapeblend_cli.svg.reading.read import read
from shapeblend_cli.svg.writing.animation import Views
from shapeblend_cli.svg.writing.css import css_svg
from shapeblend_cli.svg.writing.document import frame_svg
from shapeblend_cli.svg.writing.smil import smil_svg
from tests.svg.reading.drawings import RECT, drawn, refused, svg

BOX = '<rect x="20" y="30" width="40" height="30" fill="#08f"/>'
DISC = '<circle cx="60" cy="60" r="25" fill="#f80"/>'

# As Figma writes the shadow of a layer, and its blur.
SHADOW = (
    '<filter id="{id}" x="0" y="0" width="100" height="100" filterUnits="userSpaceOnUse" '
    'color-interpolation-filters="sRGB"><feFlood flood-opacity="0" result="BackgroundImageFix"/>'
    '<feColorMatrix in="SourceAlpha" type="matrix" values="0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 127 0" '
    'result="hardAlpha"/><feOffset dy="{dy}"/><feGaussianBlur stdDeviation="{blur}"/>'
    '<feComposite in2="hardAlpha" operator="out"/>'
    '<feColorMatrix type="matrix" values="0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 {alpha} 0"/>'
    '<feBlend mode="normal" in2="BackgroundImageFix" result="effect1_dropShadow"/>'
    '<feBlend mode="normal" in="SourceGraphic" in2="effect1_dropShadow" result="shape"/></filter>'
)
BLUR = (
    '<filter id="b" x="-50%" y="-50%" width="200%" height="200%"><feGaussianBlur stdDeviation="{}"/></filter>'
)
DEEP = SHADOW.format(id="s", dy=8, blur=4, alpha=0.8)
FLAT = SHADOW.format(id="s", dy=2, blur=1, alpha=0.4)


def effect(markup, **options):
    """Return the only effect of the last shape of a drawing that needs no notes."""
    drawing = drawn(markup, **options)
    assert drawing.notes == ()
    (found,) = drawing.shapes[-1].effects
    return found


def numbers(step):
    return {name: tuple(round(value, 6) for value in values) for name, values in step.numbers}


def picture(document, size=100):
    data = resvg_py.svg_to_bytes(
        svg_string=document, width=size, background="#ffffff", skip_system_fonts=True
    )
    return np.asarray(Image.open(io.BytesIO(bytes(data))).convert("RGB"), float) / 255.0


def pair_of(a, b, **settings):
    drawings = [read(f"{name}.svg", svg(markup)) for name, markup in (("a", a), ("b", b))]
    (pair,), notes = match_all(drawings, Settings(**settings))
    return pair, notes


def frames(a, b, *times):
    pair, _ = pair_of(a, b)
    return [picture(frame_svg(frame_at(pair, t, as_drawn=True), 3)) for t in times]


def difference(one, other):
    """Return the share of pixels that are not alike."""
    return float((np.abs(one - other).max(axis=2) > 0.06).mean())


def test_a_chain_names_steps_by_their_numbers():
    made = effect(f"{DEEP}<g filter='url(#s)'>{BOX}{DISC}</g>").filter
    assert made.region == Box(0, 0, 100, 100)
    assert [(step.tag, step.inputs) for step in made.steps] == [
        ("feFlood", ()),
        ("feColorMatrix", ("SourceAlpha",)),
        ("feOffset", (1,)),
        ("feGaussianBlur", (2,)),
        ("feComposite", (3, 1)),
        ("feColorMatrix", (4,)),
        ("feBlend", (5, 0)),
        ("feBlend", ("SourceGraphic", 6)),
    ]


@pytest.mark.parametrize("space", ["sRGB", "srgb", " SRGB "])
def test_colours_of_a_filter_are_mixed_as_screens_show_them_where_it_says_so(space):
    markup = f"<filter id='f' style='color-interpolation-filters:{space}'><feGaussianBlur/></filter>"
    (step,) = effect(f"{markup}<g filter='url(#f)'>{BOX}</g>").filter.steps
    assert dict(step.words)["color-interpolation-filters"] == "sRGB"


@pytest.mark.parametrize(
    ("attributes", "deviation", "offset"),
    [
        ("", (2, 3), (4, 1)),
        ('transform="scale(2)"', (4, 6), (8, 2)),
        ('transform="scale(2 1)"', (4, 3), (8, 1)),
        ('transform="rotate(90 50 50)"', (3, 2), (-1, 4)),
        ('transform="translate(9 9) scale(-1 1)"', (2, 3), (-4, 1)),
    ],
)
def test_lengths_of_steps_are_those_of_the_element(attributes, deviation, offset):
    steps = '<feOffset dx="4" dy="1"/><feGaussianBlur stdDeviation="2 3"/>'
    made = effect(f'<filter id="f">{steps}</filter><g {attributes}><g filter="url(#f)">{BOX}</g></g>').filter
    assert numbers(made.steps[0]) == {"dx": (offset[0],), "dy": (offset[1],)}
    assert numbers(made.steps[1]) == {"stdDeviation": deviation}


def test_shares_of_the_box_are_those_of_all_shapes_together():
    blur = '<feGaussianBlur stdDeviation=".1 .2"/>'
    markup = f'<filter id="f" x="0" primitiveUnits="objectBoundingBox">{blur}</filter>'
    made = effect(f'{markup}<g filter="url(#f)">{BOX}{DISC}</g>').filter
    # Both shapes are in a box from 20, 30 to 85, 85.
    assert made.region == pytest.approx((20, 24.5, 78, 66))
    assert numbers(made.steps[0]) == {"stdDeviation": (6.5, 11)}


@pytest.mark.parametrize(
    ("value", "tag", "expected"),
    [
        ("blur(2px)", "feGaussianBlur", {"stdDeviation": (2, 2)}),
        (
            "drop-shadow(1px 2px 3px rgba(255, 0, 0, 0.5))",
            "feDropShadow",
            {"dx": (1,), "dy": (2,), "stdDeviation": (3, 3), "flood-opacity": (0.5,)},
        ),
        ("opacity(50%)", "feColorMatrix", {"values": (1, *[0] * 5, 1, *[0] * 5, 1, *[0] * 5, 0.5, 0)}),
        (
            "invert(1)",
            "feColorMatrix",
            {"values": (-1, 0, 0, 0, 1, 0, -1, 0, 0, 1, 0, 0, -1, 0, 1, 0, 0, 0, 1, 0)},
        ),
    ],
)
def test_functions_of_css_are_steps(value, tag, expected):
    step = effect(f'<g style="filter: {value}">{BOX}</g>').filter.steps[-1]
    assert (step.tag, numbers(step)) == (tag, expected)


def test_functions_are_applied_one_after_the_other():
    made = effect(f'<g style="filter: blur(2px) url(#s) invert(1)">{BOX}</g>{DEEP}').filter
    assert [step.tag for step in made.steps][::9] == ["feGaussianBlur", "feBlend"]
    assert made.steps[-1].inputs == (len(made.steps) - 2,)
    assert all(each < k for k, step in enumerate(made.steps) for each in step.inputs if isinstance(each, int))


def test_opacity_is_that_of_a_group_where_something_overlaps():
    apart = drawn(f'<g opacity=".5">{BOX}<circle cx="90" cy="90" r="5"/></g>')
    assert [(shape.effects, shape.style.fill_opacity) for shape in apart.shapes] == [((), 0.5)] * 2
    above = drawn(f'<g opacity=".5">{BOX}{DISC}</g>')
    assert [(shape.effects[0].opacity, shape.style.fill_opacity) for shape in above.shapes] == [
        (0.5, 1.0)
    ] * 2
    edged = effect('<circle r="9" stroke="red" fill="blue" opacity=".25"/>')
    assert edged.opacity == 0.25


def test_blend_modes_are_read_and_isolation_only_where_it_is_seen():
    assert effect(f'<g style="mix-blend-mode:multiply">{BOX}</g>').mode == "multiply"
    assert drawn(f'<g style="isolation:isolate">{BOX}</g>').shapes[0].effects == ()
    both = (
        drawn(f'<g style="isolation:isolate"><g style="mix-blend-mode:screen">{BOX}</g></g>')
        .shapes[0]
        .effects
    )
    assert [(each.mode, each.isolates) for each in both] == [("normal", True), ("screen", False)]


@pytest.mark.parametrize(
    "markup",
    [
        f'{DEEP}<g filter="url(#s)">{BOX}{DISC}</g>',
        f'{BLUR.format(3)}<g filter="url(#b)" transform="rotate(20)">{BOX}</g>{DISC}',
        f'<g style="filter:drop-shadow(2px 3px 2px #f00)">{BOX}</g>',
        f'<g opacity=".4">{BOX}{DISC}</g>',
        f'{BOX}<g style="mix-blend-mode:multiply">{DISC}</g>',
        f'{BLUR.format(3)}<clipPath id="c">{DISC}</clipPath><g clip-path="url(#c)"><g filter="url(#b)">{BOX}</g></g>',
        f'{BLUR.format(3)}<clipPath id="c">{DISC}</clipPath><g filter="url(#b)"><g clip-path="url(#c)">{BOX}</g></g>',
    ],
)
def test_ends_look_as_the_files(markup):
    for k, shown in enumerate(frames(markup, BOX, 0.0, 1.0)):
        assert difference(shown, picture(svg(markup if k == 0 else BOX).decode())) < 0.004


def test_numbers_of_one_chain_are_half_way_at_half_time():
    pair, notes = pair_of(f'{FLAT}<g filter="url(#s)">{BOX}</g>', f'{DEEP}<g filter="url(#s)">{BOX}</g>')
    (found,) = frame_at(pair, 0.5, as_drawn=True).shapes[0].effects
    assert [numbers(found.filter.steps[k]) for k in (2, 3)] == [
        {"dx": (0,), "dy": (5,)},
        {"stdDeviation": (2.5, 2.5)},
    ]
    assert numbers(found.filter.steps[5])["values"][18] == pytest.approx(0.6)
    assert notes == []


@pytest.mark.parametrize(
    "markup", [f'{DEEP}<g filter="url(#s)">{BOX}</g>', f'{BLUR.format(4)}<g filter="url(#b)">{BOX}</g>']
)
def test_what_only_one_drawing_has_comes_by_its_strength(markup):
    none, little, half, much, whole = frames(BOX, markup, 0.0, 0.02, 0.5, 0.98, 1.0)
    changes = [np.abs(a - b).mean() for a, b in ((none, little), (little, half), (half, much), (much, whole))]
    assert changes[0] < 0.15 * changes[1]
    assert changes[3] < 0.15 * changes[2]


def test_filters_of_two_kinds_go_and_come_at_the_same_time():
    pair, _ = pair_of(f'{DEEP}<g filter="url(#s)">{BOX}</g>', f'<g style="filter:blur(3px)">{BOX}</g>')
    effects = frame_at(pair, 0.25, as_drawn=True).shapes[0].effects
    assert [each.filter.steps[-1].tag for each in effects] == ["feGaussianBlur", "feComposite"]
    assert numbers(effects[0].filter.steps[0]) == {"stdDeviation": (0.75, 0.75)}
    assert numbers(effects[1].filter.steps[-1]) == {"k2": (0.75,), "k3": (0.25,)}


def test_lengths_scale_with_the_placement():
    small = svg(f'<g style="filter:drop-shadow(1px 1px 2px #000)">{BOX}</g>')
    large = small.replace(b"0 0 100 100", b"0 0 50 50")
    (pair,), _ = match_all([read("a.svg", small), read("b.svg", large)], Settings())
    (found,) = pair.drawn[1][0].effects
    assert numbers(found.filter.steps[0])["stdDeviation"] == (4, 4)
    assert numbers(found.filter.steps[0])["dx"] == (2,)


@pytest.mark.parametrize(("attribute", "height"), [('surfaceScale="3"', 3), ("", 1)])
def test_so_do_surfaces_in_a_light(attribute, height):
    steps = f"<feDiffuseLighting {attribute}><feDistantLight/></feDiffuseLighting>"
    light = f'<filter id="f">{steps}</filter>'
    small = svg(f'{light}<g transform="scale(2)"><g filter="url(#f)">{BOX}</g></g>')
    large = small.replace(b"0 0 100 100", b"0 0 50 50")
    (pair,), _ = match_all([read("a.svg", small), read("b.svg", large)], Settings())
    (found,) = pair.drawn[1][0].effects
    assert numbers(found.filter.steps[0])["surfaceScale"] == (4 * height,)


def test_a_group_that_is_cut_is_said():
    a = f'<g opacity=".5">{BOX}{DISC}</g><rect id="r" x="30" y="40" width="20" height="20" fill="lime"/>'
    b = f'<g opacity=".5">{BOX}<rect id="r" x="40" y="45" width="30" height="20" fill="lime"/>{DISC}</g>'
    _, notes = pair_of(a, b, match=(("0", "0"), ("1", "2"), ("2", "1")))
    assert any("cut on the way" in note for note in notes)


def test_animations_have_one_filter_that_changes_and_css_one_in_each_step():
    pair, _ = pair_of(f'{FLAT}<g filter="url(#s)">{BOX}</g>', f'{DEEP}<g filter="url(#s)">{BOX}</g>')
    shapes, view = keyframed_shapes([pair]), Box(0, 0, 100, 100)
    moving = smil_svg(shapes, Views([view, view]), Timing(), 2)
    assert moving.count("<filter") == 1
    assert 'attributeName="stdDeviation"' in moving
    assert css_svg(shapes, view, Timing(), 2).count("<filter") == 25


def test_modes_change_at_half_time():
    modes = [f'<g style="mix-blend-mode:{mode}">{BOX}</g>' for mode in ("multiply", "screen")]
    pair, _ = pair_of(*modes)
    assert [frame_at(pair, t, as_drawn=True).shapes[0].effects[0].mode for t in (0.49, 0.51)] == [
        "multiply",
        "screen",
    ]
    view = Box(0, 0, 100, 100)
    moving = smil_svg(keyframed_shapes([pair]), Views([view, view]), Timing(), 2)
    assert 'values="mode-multiply;mode-screen"' in moving
    assert ".mode-screen{mix-blend-mode:screen}" in moving


def test_blurs_and_regions_are_bounded_by_the_drawing():
    huge = '<filter id="f" x="-1e7" y="-1e7" width="9e7" height="9e7" filterUnits="userSpaceOnUse">{}</filter>'.format
    shape = f'<g filter="url(#f)">{BOX}</g>'
    made = effect(huge('<feGaussianBlur stdDeviation="1e8"/><feMorphology radius="1e8"/>') + shape).filter
    assert made.region == Box(-100, -100, 300, 300)
    assert [numbers(step) for step in made.steps] == [{"stdDeviation": (50, 50)}, {"radius": (5, 5)}]
    for asked, taken in ((9999, 8), (0, 0), (-3, 0)):  # without octaves there is no noise
        steps = f'<feTurbulence numOctaves="{asked}" baseFrequency=".1"/>'
        (noise,) = effect(huge(steps) + shape).filter.steps
        assert numbers(noise)["numOctaves"] == (taken,)


def test_steps_and_effects_are_bounded(monkeypatch):
    many = f'<filter id="f">{"<feOffset/>" * 1000}</filter>'
    drawing = drawn(f'{many}<g filter="url(#f)">{BOX}</g>')
    assert len(drawing.shapes[0].effects[0].filter.steps) == primitives.MOST_STEPS
    refused(many + f'<g filter="url(#f)">{RECT}</g>' * 40, "more than 2000 steps of filters, the limit")
    deep = drawn("<g style='filter:blur(1px)'>" * 40 + BOX + "</g>" * 40)
    assert len(deep.shapes[0].effects) == layers.MOST_EFFECTS
    assert deep.notes == ("more than 16 filters and opacities around each other left out (24 times)",)


@pytest.mark.parametrize(
    "markup",
    [
        '<filter id="f"><feGaussianBlur stdDeviation="x 1 2 3 nan"/></filter>',
        '<filter id="f"><feGaussianBlur in="f" result="f" stdDeviation="-4"/></filter>',
        '<filter id="f" width="0" height="-1"><feFlood/></filter>',
        '<filter id="f"><feColorMatrix values="1 2 3"/><feComposite operator="script" in2="none"/></filter>',
        '<filter id="f"><feFlood flood-color="url(http://example.org/)" flood-opacity="9e99"/></filter>',
        '<filter id="f"><feImage href="http://example.org/a.png"/></filter>',
        '<filter id="f" href="#f"/>',
        '<filter id="f"><feMerge><feMergeNode in="a"/></feMerge><feTile/><feConvolveMatrix order="99"/></filter>',
    ],
)
def test_what_makes_no_sense_is_read_without_harm(markup):
    pair, _ = pair_of(f'{markup}<g filter="url(#f)">{BOX}</g>', BOX)
    for t in (0.0, 0.5):
        text = frame_svg(frame_at(pair, t, as_drawn=True), 2)
        assert not any(word in text for word in ("example.org", "nan", "script"))
        picture(text)


@pytest.mark.parametrize(
    ("value", "expected"),
    [
        ("stroke", "stroke"),
        ("markers stroke", "stroke"),
        ("stroke fill markers", "stroke"),
        ("fill", "normal"),
        ("markers", "normal"),
        ("normal", "normal"),
        ("fill fill", "normal"),
        ("stroke none", "normal"),
    ],
)
def test_strokes_are_below_fills_as_paint_order_says(value, expected):
    drawing = drawn(f'<g paint-order="{value}"><circle r="9" stroke="red"/></g>')
    assert drawing.shapes[0].style.paint_order == expected


def test_the_order_of_paint_changes_half_way_and_is_two_shapes_where_programs_have_none():
    edged = '<circle cx="50" cy="50" r="20" fill="blue" stroke="red" stroke-width="9" {}/>'.format
    below = edged('paint-order="stroke"')
    first, last = frames(below, edged(""), 0.0, 1.0)
    assert difference(first, picture(svg(below).decode())) < 0.015
    assert difference(last, picture(svg(edged("")).decode())) < 0.015
    pair, _ = pair_of(below, edged(""))
    orders = [frame_at(pair, t, as_drawn=True).shapes[0].style.paint_order for t in (0.4, 0.6)]
    assert orders == ["stroke", "normal"]
    (move,) = moves_of([pair])
    shapes = move.with_strokes_below().shapes
    assert [(shape.start.style.fill, shape.start.style.stroke) for shape in shapes] == [
        (None, "#ff0000"),
        ("#0000ff", None),
    ]


def test_other_programs_get_opacities_in_the_paint_and_one_note():
    pair, _ = pair_of(f'{DEEP}<g filter="url(#s)" opacity=".5">{BOX}{DISC}</g>', BOX)
    (move,) = moves_of([pair])
    assert [shape.start.style.fill_opacity for shape in move.shapes] == [0.5, 0.5]
    assert left_out([pair], "Lottie") == [
        "filters and opacities of groups as a whole are left out of Lottie; frames and animated SVGs have them"
    ]


def test_an_effect_lasts_from_its_drawing_to_the_next():
    drawings = [
        read(f"{k}.svg", svg(markup))
        for k, markup in enumerate((BOX, f'{DEEP}<g filter="url(#s)">{BOX}</g>', BOX))
    ]
    pairs, _ = match_all(drawings, Settings())
    shapes = keyframed_shapes(pairs)
    assert [(shape.first, len(shape.effects)) for shape in shapes] == [(0, 1), (1, 1)]
    assert len({each.blend.number for shape in shapes for each in shape.effects}) == 2
