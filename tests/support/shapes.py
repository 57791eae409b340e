"""Polygons to test with, as complex vertices."""

import numpy as np


def unit(degrees):
    """The unit vector in a direction."""
    return np.exp(1j * np.radians(degrees))


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


def wavy(m, seed, size=0.2, waves=6):
    """A smooth outline, unlike that of any other seed."""
    rng = np.random.default_rng(seed)
    angle = 2.0 * np.pi * np.arange(m) / m
    radius = 1.0 + sum(
        size / k * rng.normal() * np.cos(k * angle + rng.uniform(0, 7)) for k in range(1, waves + 1)
    )
    return unit_box(radius * np.exp(1j * angle))


def regular_polygon(m, turn=0.0):
    """A regular polygon."""
    return unit_box(np.exp(1j * (2.0 * np.pi * np.arange(m) / m + turn)))


def gear(teeth, turn=0.0):
    """A wheel that looks the same from as many starts as it has teeth."""
    k = np.arange(4 * teeth)
    return unit_box(np.where(k % 4 < 2, 1.0, 0.75) * np.exp(1j * (2.0 * np.pi * k / (4 * teeth) + turn)))


def star_with(rng, m, teeth=5):
    """A star that looks like itself from one start only, around the origin."""
    k = np.arange(m)
    radius = 1.0 + 0.35 * np.cos(2.0 * np.pi * teeth * k / m) + 0.25 * rng.random(m)
    return radius * np.exp(2j * np.pi * k / m)


def spiral(rounds, steps=60, width=0.3, inner=0.8):
    """A strip rolled up, its inner end first: one long side, then back along the other; 2 steps vertices."""
    angle = np.linspace(0.0, 2.0 * np.pi * rounds, steps)
    radius, way = inner + angle / (2.0 * np.pi), np.exp(1j * angle)
    return np.concatenate([(radius + width) * way, ((radius - width) * way)[::-1]])


def bar(steps=60, length=6.0, width=1.0):
    """A straight strip, its vertices those of `spiral`."""
    x = np.linspace(0.0, length, steps)
    return np.concatenate([x, (x + 1j * width)[::-1]])


def comb(teeth, length=3.0):
    """A beam with teeth on one side."""
    points = [2.0 * k + z for k in range(teeth) for z in (0.0, -1j * length, 1.0 - 1j * length, 1.0)]
    return np.array([*points, 2.0 * teeth - 1.0 + 1j, 1j])


def arm(*angles, length=2.0, width=0.4):
    """A body with an arm of several links at the given angles, in degrees."""
    way = np.exp(1j * np.radians(angles))
    bends = 3.0 + 1.5j + np.concatenate([[0.0], np.cumsum(length * way)])
    around = np.concatenate([way[:1], way]) + np.concatenate([way, way[-1:]])
    across = 0.5j * width * around / abs(around)
    return np.concatenate([[0.0, 3.0], bends - across, (bends + across)[::-1], [3.0 + 3j, 3j]])


def with_repeats(rng, z, more):
    """Vertices of which some are there several times, one after the other."""
    again = np.sort(rng.integers(0, len(z), more))
    return np.insert(z, again, z[again])
