"""What is inside an outline, as that is bent: no triangle turns over, affine maps are exact."""

import numpy as np
import pytest

from shapeblend_cli.images import bending as bending_module
from shapeblend_cli.images.bending import Bending
from shapeblend_cli.images.triangles import NotSimpleError, doubled_areas, triangulated

SQUARE = np.concatenate(
    [np.linspace(p, q, 12, endpoint=False) for p, q in ((0, 1), (1, 1 + 1j), (1 + 1j, 1j), (1j, 0))]
)
TIMES = np.linspace(0.0, 1.0, 100)


def bumpy(rng, count=96):
    """An outline with deep bays, around 0."""
    angles = 2.0 * np.pi * np.arange(count) / count
    waves = sum(0.09 * rng.normal() * np.cos(k * angles + rng.uniform(0, 7)) for k in range(1, 7))
    return np.maximum(1.0 + waves, 0.15) * np.exp(1j * angles)


SOME_TIMES = np.linspace(0.0, 1.0, 13)


def between(a, b, times=SOME_TIMES):
    return [(t, (1.0 - t) * a + t * b) for t in times]


def test_triangles_fill_a_polygon(rng):
    for _ in range(20):
        outline = bumpy(rng)
        points, triangles = triangulated(outline, 0.15)
        areas = doubled_areas(points, triangles)
        assert (points[: len(outline)] == outline).all()
        assert areas.min() > 0.0
        assert areas.sum() == pytest.approx((outline.conj() * np.roll(outline, -1)).imag.sum())
        edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
        assert len({*map(tuple, edges.tolist())}) == len(edges)
        inner = np.sort(edges, axis=1)[(edges < len(outline)).all(axis=1)]
        assert {(j - i) % len(outline) in (1, len(outline) - 1) for i, j in inner.tolist()} == {True}


@pytest.mark.parametrize(
    "outline", [np.array([0, 1, 1j, 1 + 1j]), SQUARE[::-1]], ids=["crosses itself", "clockwise"]
)
def test_other_polygons_have_none(outline):
    with pytest.raises(NotSimpleError):
        triangulated(outline, 0.1)
    with pytest.raises(NotSimpleError):
        Bending(outline, outline, between(outline, outline))


MAPS = {
    "shifted": lambda z: z + 2 - 1j,
    "turned": lambda z: z * np.exp(1j),
    "sheared": lambda z: z + 0.8 * z.imag,
    "stretched, turned and sheared": lambda z: 0.5j * z + 0.3 * z.conj() + 1,
}


@pytest.mark.parametrize("name", MAPS)
@pytest.mark.parametrize("kind", ["square", "bumpy"])
def test_affine_maps_are_exact(name, kind, rng):
    outline, there = SQUARE if kind == "square" else bumpy(rng), MAPS[name]
    way = between(outline, there(outline), TIMES[::9])
    bending = Bending(outline, there(outline), way)
    for t, bent in way:
        mesh = bending.mesh(bent, t)
        assert mesh.in_b == pytest.approx(there(mesh.in_a))
        assert mesh.points == pytest.approx((1.0 - t) * mesh.in_a + t * there(mesh.in_a))


def test_no_triangle_turns_over_at_any_time(monkeypatch):
    """In sixteen pairs of outlines, at 25 times each; the outline itself stays where it is."""
    monkeypatch.setattr(bending_module, "INNER", 25)
    laid_out = 0
    for seed in range(16):
        rng = np.random.default_rng(seed)
        a, b = bumpy(rng, 36), bumpy(rng, 36) * np.exp(1j * rng.uniform(-1, 1))
        bending = Bending(a, b, between(a, b))
        laid_out += bending.is_laid_out
        for t, outline in between(a, b, TIMES[::4]):
            mesh = bending.mesh(outline, t)
            assert doubled_areas(mesh.points, mesh.triangles).min() > 0.0, (seed, t)
            for ends, end in ((mesh.points, outline), (mesh.in_a, a), (mesh.in_b, b)):
                assert np.abs(ends[: len(outline)] - end).max() < 1e-12
    assert 0 < laid_out < 16  # both ways are tried


def test_a_spiral_is_bent_straight():
    """Far from what means of neighbours can do: it is laid out."""
    middle = np.linspace(0.0, 1.0, 40)
    spine = np.exp(7j * middle) * (0.5 + middle)
    spiral = np.concatenate([1.12 * spine, 0.88 * spine[::-1]])
    bar = np.concatenate([5 * middle + 0.25j * 0, (5 * middle + 0.3j)[::-1]])
    spiral = spiral if (spiral.conj() * np.roll(spiral, -1)).imag.sum() > 0 else spiral[::-1]
    bending = Bending(bar, spiral, [(0.0, bar), (1.0, spiral)])
    for t, outline in ((0.0, bar), (1.0, spiral)):
        mesh = bending.mesh(outline, t)
        assert doubled_areas(mesh.points, mesh.triangles).min() > 0.0
