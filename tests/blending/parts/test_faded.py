"""Large parts without a partner that lie on a body fade there; others shrink."""

import numpy as np
import pytest

from shapeblend_cli.blending.parts import faded
from shapeblend_cli.frames.frames import shapes_at
from shapeblend_cli.model import Box
from shapeblend_cli.motion.choose import FADES
from tests.support.drawings import drawing
from tests.support.motions import pair_of

ROUND = '<path fill="#ee8822" d="M4 32A28 28 0 0 1 60 32A28 28 0 0 1 4 32Z"/>'
TALL = '<path fill="#ee8822" d="M14 8H50V56H14Z"/>'
PLATE = '<path fill="#224488" d="M18 22H46V42H18Z"/>'


def blend(a, b, **settings):
    return pair_of(*(drawing(side, viewbox="0 0 64 64") for side in (a, b)), **settings)


def part(pair, t, colour="#224488"):
    """The box and the opacity of what has a colour at a time."""
    found = [shape for shape in shapes_at(pair, t) if shape.style.fill == colour]
    points = np.concatenate([path.segments.ravel() for shape in found for path in shape.paths])
    return Box.around(points), found[0].style.fill_opacity


def test_a_large_part_that_leaves_keeps_its_size_and_fades():
    pair = blend(ROUND + PLATE, TALL)
    (first, opaque), (later, faint) = part(pair, 0.0), part(pair, 0.275)
    assert (opaque, first.width) == (1.0, 28.0)
    assert faint == pytest.approx(0.5)
    assert later.width > 0.8 * first.width
    assert part(pair, 0.15)[1] == pytest.approx(1.0)
    assert part(pair, 0.4)[1] == pytest.approx(0.0)
    assert pair.shapes[1].reason == FADES


def test_a_large_part_that_comes_begins_when_others_are_gone():
    pair = blend(TALL, ROUND + PLATE)
    assert part(pair, 0.4)[1] == 0.0
    assert part(pair, 0.525)[1] == pytest.approx(0.5)
    assert part(pair, 0.65)[1] == pytest.approx(1.0)
    assert part(pair, 1.0)[1] == 1.0


def test_it_goes_along_with_its_body():
    moved = TALL.replace("M14", "M28").replace("H50", "H64").replace("H14", "H28")
    box, _ = part(blend(ROUND + PLATE, moved), 0.39)
    assert box.centre.real > 35.0


def test_what_lies_on_such_a_part_fades_with_it():
    dot = '<path fill="#ffffff" d="M30 30H34V34H30Z"/>'
    box, opacity = part(blend(ROUND + PLATE + dot, TALL), 0.275, "#ffffff")
    assert opacity == pytest.approx(0.5)
    assert box.width > 3.0


def test_parts_that_are_painted_alike_go_alike():
    dot = '<path fill="#224488" d="M30 48H34V52H30Z"/>'
    pair = blend(ROUND + PLATE + dot, TALL)
    assert [shape.fade is not None for shape in pair.shapes] == [False, True, True]


@pytest.mark.parametrize(
    "plate",
    [
        '<path fill="#224488" d="M28 28H36V36H28Z"/>',  # small
        '<path fill="#224488" d="M18 22H46V64H18Z"/>',  # stands out
        '<path fill="#224488" d="M24 26H44V38H38V54H30V38H24Z"/>',  # hangs out of another one
    ],
)
def test_others_shrink(plate):
    mouth = '<path fill="#660022" d="M22 24H46V40H22Z"/>'
    pair = blend(ROUND + mouth + plate, TALL + mouth)
    assert all(shape.fade is None for shape in pair.shapes)


def test_a_part_that_meets_one_that_shrinks_does_so_too():
    beside = '<path fill="#225522" d="M40 20H64V44H40Z"/>'
    assert all(shape.fade is None for shape in blend(ROUND + beside + PLATE, TALL).shapes)


def test_it_grows_where_nothing_else_changes():
    pair = blend(ROUND, ROUND + PLATE)
    assert all(shape.fade is None for shape in pair.shapes)


def test_one_comes_for_another_where_the_rest_stays():
    ring = '<path fill="#ffffff" d="M32 12A20 20 0 0 1 32 52V50A18 18 0 0 0 32 14Z"/>'
    pair = blend(ROUND + '<path fill="#224488" d="M8 31H56V33H8Z"/>', ROUND + ring)
    assert [shape.fade is not None for shape in pair.shapes] == [False, True, True]


def test_motions_that_are_asked_for_are_left_as_they_are():
    assert all(shape.fade is None for shape in blend(ROUND + PLATE, TALL, motion="linear").shapes)


def test_crowds_are_left_as_they_are(monkeypatch):
    monkeypatch.setattr(faded, "AFFORDABLE", 1)
    assert all(shape.fade is None for shape in blend(ROUND + PLATE, TALL).shapes)
