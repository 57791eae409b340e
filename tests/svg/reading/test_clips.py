"""Clip paths: which region a shape is painted in."""

import numpy as np
import pytest

from shapeblend_cli.geometry import cubics
from shapeblend_cli.geometry.polygons import winding_numbers
from tests.support.drawings import drawing

RECT = '<rect x="2" y="2" width="20" height="20"/>'
LARGE = '<rect width="24" height="24"/>'


def clips(*elements):
    """The boxes of the clips of each shape, outermost first: left, top, right, bottom."""
    found = drawing(*elements)
    return [
        [
            tuple(np.round(cubics.bounds(np.concatenate([p.segments for p in clip.paths])).bounds, 6))
            for clip in s.clips
        ]
        for s in found.shapes
    ]


@pytest.mark.parametrize(
    ("region", "clipped", "box"),
    [
        ('<circle cx="8" cy="8" r="4"/>', "", (4, 4, 12, 12)),
        ('<circle cx="8" cy="8" r="4" transform="translate(2 0)"/>', "", (6, 4, 14, 12)),
        ('<circle cx="8" cy="8" r="4" style="transform: translate(2px)"/>', "", (6, 4, 14, 12)),
        ('<use href="#dot" transform="scale(2 1)" transform-origin="1 0"/>', "", (-1, 0, 3, 2)),
        ('<path d="M4 4H8V8"/>', "", (4, 4, 8, 8)),  # closed as filling closes it
        ('<use href="#dot" x="5"/>', "", (5, 0, 7, 2)),
        (
            '<rect x="3" y="3" width="2" height="2"/><rect x="9" y="9" width="2" height="2"/>',
            "",
            (3, 3, 11, 11),
        ),
        ('<circle cx="8" cy="8" r="4"/>', 'transform="scale(2)"', (8, 8, 24, 24)),
    ],
)
def test_a_region_is_that_of_the_shapes_in_it(region, clipped, box):
    known = f'<defs><rect id="dot" width="2" height="2"/><clipPath id="c">{region}</clipPath></defs>'
    assert clips(known, f'<g clip-path="url(#c)" {clipped}>{RECT}</g>') == [[box]]


def test_clips_of_groups_and_shapes_add_up_and_are_shared():
    known = '<clipPath id="a"><circle cx="8" cy="8" r="7"/></clipPath>'
    known += '<clipPath id="b"><circle cx="9" cy="9" r="5"/></clipPath>'
    inner = f'<path clip-path="url(#b)" d="M0 0H20V20"/>{RECT}'
    found = drawing(known, f'<g clip-path="url(#a)">{inner}</g>')
    first, second = found.shapes
    assert len(first.clips) == 2
    assert second.clips == first.clips[:1]
    assert second.clips[0] is first.clips[0]


def test_a_region_may_be_in_units_of_the_shape():
    region = '<rect x=".25" y=".5" width=".5" height=".25"/>'
    known = f'<clipPath id="c" clipPathUnits="objectBoundingBox">{region}</clipPath>'
    assert clips(known, RECT.replace("<rect", '<rect clip-path="url(#c)"')) == [[(7, 12, 17, 17)]]


def test_a_rectangle_around_all_clips_nothing():
    """As design programs write one around every drawing."""
    for region, count in (('<rect width="24" height="24"/>', 0), ('<rect width="21" height="24"/>', 1)):
        known = f'<clipPath id="c">{region}</clipPath>'
        assert [len(each) for each in clips(known, f'<g clip-path="url(#c)">{RECT}</g>')] == [count]


def test_the_rule_of_a_region_is_its_own():
    ring = '<path clip-rule="evenodd" d="M2 2H22V22H2Z M6 6H18V18H6Z"/>'
    found = drawing(
        f'<clipPath id="c">{ring}</clipPath>', '<g clip-path="url(#c)"><circle cx="12" cy="12" r="12"/></g>'
    )
    assert found.shapes[0].clips[0].rule == "evenodd"


@pytest.mark.parametrize("around", ['<g style="clip-rule:evenodd">', '<g fill="none" fill-rule="evenodd">'])
def test_the_rule_of_a_region_may_be_that_of_what_is_around_it(around):
    """As Affinity and Sketch write it."""
    name = "clip-path" if "clip" in around else "mask"
    region = f'<{name.replace("-p", "P")} id="m" fill="#fff"><use href="#ring"/></{name.replace("-p", "P")}>'
    known = f'<defs><path id="ring" d="M2 2H22V22H2Z M6 6H18V18H6Z"/></defs>{around}{region}</g>'
    (shape,) = drawing(known, f'<g {name}="url(#m)"><circle cx="12" cy="12" r="12"/></g>').shapes
    assert shape.clips[0].rule == "evenodd"


@pytest.mark.parametrize(
    "value",
    ["url(#none)", "circle(5px)", "url(#g)", "url(other.svg#c)"],
)
def test_what_cannot_be_read_clips_nothing_and_is_noted(value):
    known = '<g id="g"/><clipPath id="c"><rect width="3" height="3"/></clipPath>'
    found = drawing(known, f'<g clip-path="{value}">{RECT}</g>')
    assert found.shapes[0].clips == ()
    assert "clip-path not applied" in found.notes


@pytest.mark.parametrize(
    "region", ["", f"<g>{RECT}</g>", '<path d=""/>', f'<g id="x">{RECT}</g><title>t</title>']
)
def test_a_clip_path_without_an_inside_leaves_nothing_to_see(region):
    known = f'<clipPath id="c">{region}</clipPath>'
    known += f'<clipPath id="d" clip-path="url(#c)">{RECT}</clipPath>'
    hidden = "".join(f'<g clip-path="url(#{name})">{RECT}</g>' for name in "cd")
    assert len(drawing(known, hidden + RECT).shapes) == 1


def test_a_clip_path_may_be_clipped_itself():
    known = '<clipPath id="c"><rect x="4" width="9" height="24"/></clipPath>'
    known += '<clipPath id="d" clip-path="url(#c)"><rect y="4" width="24" height="9"/></clipPath>'
    known += f'<clipPath id="round" clip-path="url(#round)">{RECT}</clipPath>'
    (found,) = clips(known, f'<g clip-path="url(#d)">{RECT}</g>')
    assert len(found) == 2
    assert len(drawing(known, f'<g clip-path="url(#round)">{RECT}</g>').shapes) == 1


def test_a_shape_in_a_clip_path_may_be_clipped_itself_if_it_is_the_only_one():
    known = '<clipPath id="c"><rect x="4" width="9" height="24"/></clipPath><clipPath id="none"/>'
    inner = RECT.replace("<rect", '<rect clip-path="url(#c)"')
    known += f'<clipPath id="d">{inner}</clipPath><clipPath id="e">{inner}{RECT}</clipPath>'
    known += f'<clipPath id="f">{inner.replace("#c", "#none")}</clipPath>'
    found = drawing(known, *(f'<g clip-path="url(#{name})">{LARGE}</g>' for name in "def"))
    assert [len(shape.clips) for shape in found.shapes] == [2, 1]
    assert found.notes == ("clip-path not applied",)


def mask(shapes, attributes='style="mask-type:alpha"'):
    """The clips of a square from 2 to 22 behind a mask of shapes."""
    return clips(f'<mask id="m" {attributes}>{shapes}</mask>', f'<g mask="url(#m)">{RECT}</g>')


ALPHA = 'style="mask-type:alpha" maskUnits="userSpaceOnUse" x="0" y="0" width="9" height="24"'
WHITE_DOT = '<circle cx="8" cy="8" r="4" fill="white"/>'


@pytest.mark.parametrize(
    ("shapes", "attributes", "boxes"),
    [
        ('<circle cx="8" cy="8" r="4" fill="#d9d9d9"/>', 'style="mask-type:alpha"', [(4, 4, 12, 12)]),
        (WHITE_DOT, "", [(4, 4, 12, 12)]),
        ('<circle cx="8" cy="8" r="4"/>', 'fill="#fff"', [(4, 4, 12, 12)]),
        (f'<g transform="translate(2 0)">{WHITE_DOT}</g>', "", [(6, 4, 14, 12)]),
        ('<defs><path id="p" d="M4 4H8V8"/></defs><use href="#p" fill="white"/>', "", [(4, 4, 8, 8)]),
        (WHITE_DOT, ALPHA, [(4, 4, 12, 12), (0, 0, 9, 24)]),
        # What is painted black is hidden: it is a hole in a rectangle around all.
        ('<path fill="#fff" d="M0 0H24V24H0Z"/><path d="M8 8H16V16H8Z"/>', "", [(-24, -24, 48, 48)]),
    ],
)
def test_a_mask_of_opaque_shapes_is_a_region(shapes, attributes, boxes):
    assert mask(shapes, attributes) == [boxes]


def seen(region, points):
    """Which points are in all clips of a square behind a clip path or a mask, with its notes."""
    found = drawing(region, f'<g clip-path="url(#c)" mask="url(#m)">{LARGE}</g>')
    inside = np.ones(len(points), bool)
    for clip in found.shapes[0].clips:
        around = sum(winding_numbers(points, cubics.polyline(path.segments, 1)) for path in clip.paths)
        inside &= around % 2 != 0 if clip.rule == "evenodd" else around != 0
    return inside.tolist(), [
        note for note in found.notes if "clip-path not" not in note and "mask not" not in note
    ]


RING = "M2 2H18V18H2Z M6 6H14V14H6Z"
ACROSS = "M12 12V22H22V12Z"


@pytest.mark.parametrize(
    ("region", "inside"),
    [
        ('<clipPath id="c"><path d="M2 2H18V18H2Z"/><path d="{across}"/></clipPath>', [1, 1, 1, 1]),
        (
            '<clipPath id="c" clip-rule="evenodd"><path d="{ring}"/><path d="{across}"/></clipPath>',
            [1, 0, 1, 1],
        ),
        (
            '<clipPath id="c"><path clip-rule="evenodd" d="{ring}"/><path d="M20 20h2v2"/></clipPath>',
            [1, 0, 0, 1],
        ),
        (
            '<clipPath id="c"><path d="M20 20h2v2"/><path clip-rule="evenodd" d="{ring}"/></clipPath>',
            [1, 0, 0, 1],
        ),
        ('<clipPath id="c"><path d="{ring}"/><path d="{across}"/></clipPath>', [1, 1, 1, 1]),
        (
            '<mask id="m" fill="#fff"><path fill-rule="evenodd" d="{ring}"/><path d="{across}"/></mask>',
            [1, 0, 1, 1],
        ),
        # What is painted black is hidden.
        ('<mask id="m"><path fill="#fff" d="M0 0H24V24H0Z"/><path d="M8 8H16V16H8Z"/></mask>', [1, 0, 0, 1]),
        ('<mask id="m"><path fill="#fff" d="M0 0H24V24H0Z"/><path d="{ring}"/></mask>', [0, 0, 0, 0]),
    ],
)
def test_what_a_region_shows_is_what_browsers_show(region, inside):
    points = np.array([4 + 4j, 10 + 10j, 13 + 13j, 17 + 17j])
    found = seen(region.format(ring=RING, across=ACROSS), points)
    assert found == ([bool(each) for each in inside], [])


def test_the_rule_of_one_of_several_shapes_is_not_applied_if_it_crosses_itself():
    star = '<path clip-rule="evenodd" d="M12 2L18 20L2 9H22L6 20Z"/>'
    inside, notes = seen(f'<clipPath id="c">{star}{RECT}</clipPath>', np.array([12 + 12j]))
    assert inside == [True]
    assert notes == [
        "rule of a shape that crosses itself, one of several in a clip-path or a mask, not applied"
    ]


@pytest.mark.parametrize(
    "shapes",
    [
        "",
        '<path d="" fill="white"/>',
        '<circle r="9" fill="grey"/>',
        '<circle r="9" fill="white" opacity=".5"/>',
        '<circle r="9" fill="none" stroke="white"/>',
        '<path d="M8 8H16V16H8Z"/><circle r="9" fill="white"/>',
        '<use href="#none"/>',
    ],
)
def test_a_mask_that_is_no_region_stays_a_mask(shapes):
    found = drawing(f'<mask id="m">{shapes}</mask>', f'<g mask="url(#m)">{RECT}</g>')
    assert found.shapes[0].clips == ()
    assert found.shapes[0].effects[0].mask is not None


def test_a_mask_of_pictures_is_not_applied_and_noted():
    found = drawing('<mask id="m"><image href="x.png"/></mask>', f'<g mask="url(#m)">{RECT}</g>')
    assert (found.shapes[0].clips, found.shapes[0].effects) == ((), ())
    assert "mask not applied" in found.notes


def test_a_mask_that_is_not_applied_counts_towards_no_limit(monkeypatch):
    monkeypatch.setattr("shapeblend_cli.svg.reading.clips.MAX_SEGMENTS", 20)
    known = f'<mask id="m">{WHITE_DOT}<circle r="9" fill="grey"/></mask>'
    found = drawing(known, *(f'<g mask="url(#m)" transform="scale({k})">{RECT}</g>' for k in range(1, 20)))
    assert len(found.shapes) == 19
