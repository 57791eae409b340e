"""The work of any two outlines, by whichever bending: what costs nothing, what nothing falls below, and what stays."""

import json
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from shapeblend_cli.geometry import cubics
from shapeblend_cli.matching.work import Wires
from shapeblend_cli.model import Contour
from shapeblend_cli.options.constants import PAPER, WorkConstants
from shapeblend_cli.svg.reading.read import read
from tests.support.contours import drawing, polygon_contour
from tests.support.drawings import svg
from tests.support.motions import pair_of
from tests.support.shapes import random_polygon, star_polygon, star_with, unit_box
from tests.support.solver import find_least
from tests.support.strategies import rngs

counts = st.integers(3, 25)
constants = st.sampled_from(
    [
        WorkConstants(),
        WorkConstants(**PAPER),
        WorkConstants(bending="paper"),
        WorkConstants(k_t=0.0),
        WorkConstants(smoothing=0.0, p_b=50.0),
        WorkConstants(smoothing=0.03, e_b=2.0, e_s=1.0),
    ]
)


def random_path(rng, m, n, closed):
    """Any legal path: after each step Southeast a run of steps East, or of steps South, which may be empty."""
    columns, rows = (m, n) if closed else (m - 1, n - 1)
    least = min(columns, rows)
    southeast = int(rng.integers(min(2, least), least + 1))
    runs = np.zeros((southeast, 2), int)
    goes_south = rng.permutation(np.arange(southeast) % 2)
    for side, missing in enumerate((columns - southeast, rows - southeast)):
        here = np.flatnonzero(goes_south == side) if southeast > 1 else [0]
        runs[:, side] = np.bincount(rng.choice(here, missing), minlength=southeast) if missing else 0
    steps = [step for east, south in runs for step in [(1, 1)] + [(1, 0)] * east + [(0, 1)] * south]
    dots = np.concatenate([[[0, 0]], np.cumsum(steps, axis=0)])
    return (dots[:-1] + (rng.integers(m), rng.integers(n))) % (m, n) if closed else dots


@given(rngs, counts, counts, st.booleans(), constants, st.booleans())
def test_no_path_costs_less_than_the_least_nor_than_the_bound(rng, m, n, closed, constants, stiff):
    p, q = random_polygon(rng, m), star_polygon(rng, n)
    weight = rng.choice([0.5, 1.0, 3.0], m) if stiff else None
    found = find_least(p, q, closed, constants, weight)
    wires = Wires(p, q, closed, constants, weight)
    assert 0.0 <= found.lower_bound <= found.work
    parts = wires.path_work(found.dots)
    assert parts.total == pytest.approx(parts.stretching + parts.bending + parts.travel)
    assert min(parts[:3]) >= 0.0
    start = (int(rng.integers(m)), int(rng.integers(n))) if closed else (0, 0)
    pinned = find_least(p, q, closed, constants, weight, start=start)
    for _ in range(5):
        other = wires.path_work(random_path(rng, m, n, closed)).total
        assert found.work <= other * (1 + 1e-9) + 1e-9
        assert pinned.lower_bound <= other * (1 + 1e-9) + 1e-9


@given(rngs, st.integers(5, 25), constants.filter(lambda c: c.k_t > 0.0 and c.bending == "turn"))
def test_rotated_half_a_turn_it_costs_its_travel_alone(rng, m, constants):
    p = unit_box(star_with(rng, 5 * m))
    q = 1 + 1j * np.ptp(p.imag) - p if np.ptp(p.real) == 1.0 else np.ptp(p.real) + 1j - p
    wires, dots = Wires(p, q, True, constants), np.arange(5 * m)[:, None].repeat(2, axis=1)
    work, zeros = wires.path_work(dots), wires.zero_angles(dots)
    assert work.stretching == pytest.approx(0.0, abs=1e-9)
    straight = np.zeros(len(p)) if constants.p_b == 0.0 else constants.p_b * zeros
    assert work.bending == pytest.approx(straight, abs=1e-7)
    # The integral of the squared way along the outline, in the box made the unit square.
    square = (p.real - p.real.min()) / np.ptp(p.real) + 1j * (p.imag - p.imag.min()) / np.ptp(p.imag)
    lengths = abs(np.roll(p, -1) - p)
    at_vertex = 0.5 * (lengths + np.roll(lengths, 1))
    assert work.travel == pytest.approx(constants.k_t * (at_vertex * abs(2 * square - 1 - 1j) ** 2).sum())
    least = find_least(p, q, True, constants)
    assert least.work <= work.total * (1 + 1e-9)


@pytest.mark.parametrize("degrees", [90.0, 180.0])
def test_b_that_is_a_rotated_is_found_as_that(rng, degrees):
    z = 40.0 * star_with(rng, 60)
    a, b = (polygon_contour(points) for points in (z, np.roll(z * np.exp(1j * np.radians(degrees)), 17) + 3))
    pair = pair_of(drawing(a), drawing(b, file="b.svg"))
    found = pair.contours[0]
    # By what angle B is turned back is found before it is known what corresponds: to half a degree.
    assert found.correspondence.work == pytest.approx(0.0, abs=1e-3)
    assert abs(found.rotation) == pytest.approx(np.radians(degrees), abs=0.01)
    steps = np.diff(found.correspondence.dots, axis=0) % len(found.polygon_b.vertices)
    assert (steps == 1).all()
    assert [shape.motion is not None for shape in pair.shapes] == [True]


ICONS = json.loads((Path(__file__).parents[1] / "bench" / "data" / "pairs.json").read_text("utf-8"))["single"]


def icon(data):
    """The largest contour of an icon."""
    found = [
        c
        for shape in read("icon.svg", svg(data, viewbox="0 0 100 100").encode()).shapes
        for c in shape.contours
    ]
    return max(found, key=lambda contour: abs(cubics.signed_area(contour.segments)))


def begun_at(contour, node):
    return Contour(np.roll(contour.segments, -node, axis=0), np.roll(contour.straight, -node), True)


def with_more_nodes(contour, rng):
    """The same curves, some of their segments in two or three pieces."""
    pieces, straight = [], []
    for segment, is_line in zip(contour.segments, contour.straight, strict=True):
        ends = np.concatenate([[0.0], np.sort(rng.uniform(0.1, 0.9, rng.integers(0, 3))), [1.0]])
        pieces += list(cubics.pieces(np.repeat(segment[None], len(ends) - 1, axis=0), ends[:-1], ends[1:]))
        straight += [is_line] * (len(ends) - 1)
    segments = np.array(pieces)
    segments[:, 0] = np.roll(segments[:, 3], 1)
    return Contour(segments, np.array(straight), True)


def matched(a, b, **settings):
    (found,) = pair_of(drawing(a), drawing(b, file="b.svg"), motion="linear", **settings).contours
    return found


def places(contour, pieces):
    """Places that correspond, as points of both outlines in units of their boxes: between dots too, (k, 2)."""
    i, j = contour.correspondence.dots.T
    dots = np.stack(
        [contour.polygon_a.vertices[i] / contour.scale_a, contour.polygon_b.vertices[j] / contour.scale_b],
        axis=1,
    )
    share = np.arange(pieces)[:, None] / pieces
    return np.concatenate([p + share * (q - p) for p, q in zip(dots, np.roll(dots, -1, axis=0), strict=True)])


def apart(contour, other):
    """How far places of one match are from those of another, in the outline where they are further, on average."""
    known = places(other, 8)
    return np.mean([abs(known - place).max(axis=1).min() for place in places(contour, 2)])


@pytest.fixture(scope="module")
def icon_matches():
    """Outlines of unlike icons, how they correspond, and how far from vertex to vertex it is, in units of A's box."""
    found = []
    for k in (0, 16, 32, 48, 64):
        a, b = (icon(ICONS[k][side]) for side in "ab")
        match = matched(a, b)
        length = abs(match.polygon_a.vertices - np.roll(match.polygon_a.vertices, 1)).sum() / match.scale_a
        found.append((a, b, match, length / 200))
    return found


def test_icons_begun_elsewhere_correspond_alike(icon_matches):
    for a, b, match, spacing in icon_matches:
        other = matched(begun_at(a, len(a.segments) // 2), begun_at(b, len(b.segments) // 3))
        assert other.correspondence.work == pytest.approx(match.correspondence.work, rel=0.005)
        assert apart(other, match) < 0.1 * spacing


def test_icons_with_more_nodes_correspond_alike(icon_matches, rng):
    for a, b, match, spacing in icon_matches:
        other = matched(with_more_nodes(a, rng), with_more_nodes(b, rng))
        assert other.correspondence.work == pytest.approx(match.correspondence.work, rel=0.03)
        assert apart(other, match) < spacing


@pytest.mark.parametrize("vertices", [100, 400])
def test_icons_correspond_alike_at_any_number_of_vertices(icon_matches, vertices):
    """Unlike drawings may have two ways that cost about the same: one of five may go another."""
    near = []
    for a, b, match, spacing in icon_matches:
        other = matched(a, b, vertices=vertices)
        assert other.correspondence.work == pytest.approx(match.correspondence.work, rel=0.07)
        near.append(apart(other, match) < spacing)
    assert sum(near) >= 4
