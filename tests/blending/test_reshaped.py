"""Drawings whose silhouettes are alike, which change places half way."""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

import shapeblend_cli as sb
from shapeblend_cli.blending.graded import SWAP_GRADE, grade_of
from shapeblend_cli.blending.swaps import traced
from shapeblend_cli.blending.swaps.reshaped import APPEARS, FARTHEST, MOST_TURNED, MOVING, VANISHES, are_alike
from shapeblend_cli.blending.swaps.swapped import is_reshaped, is_swapped
from shapeblend_cli.blending.swaps.traced import HOLES, LOOSE, outlines, silhouette
from shapeblend_cli.cli import run
from shapeblend_cli.frames.frames import shapes_at
from shapeblend_cli.geometry.polygons import mean_value_table, signed_area
from shapeblend_cli.model import control_box

DRAWINGS = Path("docs/moving/drawings")
FIST, PALM = DRAWINGS / "raised-fist.svg", DRAWINGS / "raised-hand.svg"
CIRCLE = np.exp(2j * np.pi * np.arange(64) / 64)


def disc(radius, side=96, at=(48, 48)):
    rows, columns = np.mgrid[:side, :side] + 0.5
    return (np.hypot(rows - at[1], columns - at[0]) <= radius).astype(np.float32)


@given(arrays(np.bool_, (9, 9)))
def test_outlines_enclose_the_pixels_that_are_set(mask):
    loops = outlines(np.pad(mask, 1))
    assert sum(map(signed_area, loops)) == pytest.approx(mask.sum())
    assert all((np.abs(np.roll(loop, -1) - loop) == 1.0).all() for loop in loops)
    assert all(len(set(loop.tolist())) == len(loop) for loop in loops if signed_area(loop) > 0.0)


def test_the_silhouette_of_a_disc_is_a_circle_from_x_towards_y():
    line = silhouette(disc(30))
    np.testing.assert_allclose(np.abs(line - (48 + 48j)), 30.0, atol=0.5)
    assert signed_area(line) == pytest.approx(np.pi * 30**2, rel=0.02)
    steps = np.abs(np.roll(line, -1) - line)
    assert steps.max() < 1.5 * steps.min()


def test_ink_at_the_edge_of_a_picture_has_a_silhouette():
    line = silhouette(np.ones((96, 96), np.float32))
    assert signed_area(line) == pytest.approx(96.0**2, rel=0.02)


def test_narrow_gaps_close():
    picture = disc(30)
    picture[:, 46:49] = 0.0
    assert signed_area(silhouette(picture)) == pytest.approx(np.pi * 30**2, rel=0.03)


@pytest.mark.parametrize(
    ("picture", "is_one"),
    [
        (disc(30) - disc(30 * (0.8 * HOLES) ** 0.5), True),
        (disc(30) - disc(30 * (1.3 * HOLES) ** 0.5), False),
        (disc(20, at=(25, 25)) + disc(20 * (0.8 * LOOSE) ** 0.5, at=(75, 75)), True),
        (disc(20, at=(25, 25)) + disc(20 * (1.3 * LOOSE) ** 0.5, at=(75, 75)), False),
        (np.zeros((96, 96), np.float32), False),
    ],
)
def test_a_silhouette_is_nearly_all_that_is_painted(picture, is_one):
    assert (silhouette(picture) is not None) == is_one


def test_vertices_divide_the_points_that_are_smoothed():
    assert traced.EVEN % traced.VERTICES == 0


@pytest.mark.parametrize("share", [0.9, 1.1])
def test_outlines_that_are_far_apart_are_unlike(share):
    assert are_alike(CIRCLE, CIRCLE + share * FARTHEST) == (share < 1.0)


@pytest.mark.parametrize("share", [0.9, 1.1])
def test_outlines_whose_edges_turn_are_unlike(share, monkeypatch):
    monkeypatch.setattr("shapeblend_cli.blending.swaps.reshaped.FARTHEST", 9.0)
    assert are_alike(CIRCLE, CIRCLE * np.exp(1j * share * MOST_TURNED)) == (share < 1.0)


@pytest.mark.parametrize("scale", [0.7, 0.9, 1.2, 1.6])
def test_likeness_is_mutual(scale):
    assert are_alike(CIRCLE, scale * CIRCLE) == are_alike(scale * CIRCLE, CIRCLE)


@given(arrays(np.float64, (5, 2), elements=st.floats(-0.7, 0.7)))
def test_mean_value_tables_give_back_every_point_inside(points):
    points = np.append(points[:, 0] + 1j * points[:, 1], CIRCLE[:2])
    table = mean_value_table(points, CIRCLE)
    np.testing.assert_allclose(table.sum(axis=1), 1.0)
    np.testing.assert_allclose(table @ CIRCLE, points, atol=1e-9)


@pytest.fixture(scope="module")
def hands():
    (pair,) = sb.blend(FIST, PALM).pairs
    return pair


def test_a_fist_opens_to_a_hand(hands):
    assert is_reshaped(hands.shapes)
    assert is_swapped(hands.shapes)
    assert grade_of(hands).number == SWAP_GRADE


@pytest.mark.parametrize("t", [0.0, 0.2, 0.4, 0.5, 0.7, 1.0])
def test_one_drawing_is_seen_at_a_time(hands, t):
    seen = {shape.sources[0] is None for shape, share in visible(hands, t) if share > 0.0}
    assert seen == {t >= MOVING[0][1]}


def visible(pair, t):
    return [(shape, shape.fade.share(shape.own_time(t))) for shape in pair.shapes]


def test_there_is_always_one(hands):
    for t in np.linspace(0.0, 1.0, 201):
        assert max(share for _, share in visible(hands, t)) == 1.0, t
    assert APPEARS.until == VANISHES.begin


@pytest.mark.parametrize("end", [0, 1])
def test_both_ends_are_the_drawings(hands, end):
    shown = [
        path for shape in shapes_at(hands, float(end)) if shape.style.fill_opacity for path in shape.paths
    ]
    own = [path for shape in hands.drawn[end] for path in shape.paths]
    np.testing.assert_allclose(control_box(shown).bounds, control_box(own).bounds, atol=1e-9)


def test_silhouettes_meet_where_the_drawings_change_places(hands):
    before, after = (
        control_box([p for shape in shapes_at(hands, t) if shape.style.fill_opacity for p in shape.paths])
        for t in (MOVING[1][0], MOVING[0][1])
    )
    np.testing.assert_allclose(before.bounds, after.bounds, atol=0.05 * before.larger_side)


def test_what_is_clipped_shrinks_and_grows(tmp_path):
    text = FIST.read_text().replace("<path", '<path clip-path="url(#c)"')
    clip = '<clipPath id="c"><path d="M0 0H30V36H0Z"/></clipPath>'
    clipped = tmp_path / "clipped.svg"
    clipped.write_text(text.replace("</svg>", f"{clip}</svg>"))
    (pair,) = sb.blend(clipped, PALM).pairs
    assert is_swapped(pair.shapes)
    assert not is_reshaped(pair.shapes)


def test_polygons_stay_polygons():
    (pair,) = sb.blend(FIST, PALM, curves=False).pairs
    assert is_reshaped(pair.shapes)
    (first, *_), (end, *_) = pair.shapes[0].contours, [c.start for c in pair.shapes[0].contours]
    assert len(end.segments) == len(first.polygon_a.vertices)


def test_a_note_says_so(tmp_path, capsys):
    assert run([str(FIST), str(PALM), "-o", str(tmp_path / "out.svg")]) == 0
    assert "change over half way, where their silhouettes meet; see --swap" in " ".join(
        capsys.readouterr().err.split()
    )


@pytest.mark.parametrize("suffix", ["svg", "json", "js", "xml"])
def test_animations_have_it(tmp_path, suffix):
    out = tmp_path / f"out.{suffix}"
    assert run([str(FIST), str(PALM), "-o", str(out)]) == 0
    assert "NaN" not in out.read_text()
    assert out.stat().st_size > FIST.stat().st_size
