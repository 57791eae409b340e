"""Polygons to test with, as complex vertices."""

from __future__ import annotations

import numpy as np


def unit_box(vertices):
    """Section 3.3 in one line, apart from the package's own."""
    z = np.asarray(vertices, complex)
    z = z - complex(z.real.min(), z.imag.min())
    return z / max(z.real.max(), z.imag.max())


def random_polygon(rng, m):
    """Any m points: sharp, crossing itself, as nasty as they come."""
    return unit_box(rng.random(m) + 1j * rng.random(m))


def star_polygon(rng, m, roughness=0.6):
    """A polygon that does not cross itself: m vertices around a centre, in positive direction."""
    angle = np.sort(rng.random(m)) * 0.2 + np.arange(m)
    radius = 1.0 - roughness * rng.random(m)
    return unit_box(radius * np.exp(2j * np.pi * angle / m))


def regular_polygon(m, turn=0.0):
    """A regular polygon."""
    return unit_box(np.exp(1j * (2.0 * np.pi * np.arange(m) / m + turn)))


def gear(teeth, turn=0.0):
    """A wheel that looks the same from as many starts as it has teeth."""
    k = np.arange(4 * teeth)
    return unit_box(np.where(k % 4 < 2, 1.0, 0.75) * np.exp(1j * (2.0 * np.pi * k / (4 * teeth) + turn)))
