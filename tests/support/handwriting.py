"""Handwriting: brush strokes of varying width, as outlines."""

import numpy as np


def stroke(points, widths):
    """The outline of a stroke along points, with round ends."""
    points = np.asarray(points, complex)
    ways = np.gradient(points)
    ways = ways / np.abs(ways)
    radii = np.broadcast_to(widths, points.shape) / 2.0
    turn = np.exp(-1j * np.pi * np.arange(1, 12) / 12.0)
    return np.concatenate(
        [
            points + 1j * radii * ways,
            points[-1] + 1j * radii[-1] * ways[-1] * turn,
            (points - 1j * radii * ways)[::-1],
            points[0] - 1j * radii[0] * ways[0] * turn,
        ]
    )


def path(*rings):
    """The data of a path of rings."""
    return "".join("M" + " ".join(f"{z.real:.3f} {z.imag:.3f}" for z in ring) + "Z" for ring in rings)


def letter_s():
    """An S, thick in the middle."""
    t = np.linspace(0.0, 1.0, 60)
    points = 12.0 - 6.0 * np.sin(2.0 * np.pi * t) + 1j * (3.0 + 18.0 * t)
    return stroke(points, 0.8 + 1.2 * np.sin(np.pi * t))


def letter_o():
    """An O, thick at its sides: both of its edges."""
    angle = np.linspace(0.0, 2.0 * np.pi, 80, endpoint=False)
    middle, radius = np.exp(1j * angle), 0.4 + 0.6 * np.cos(angle) ** 2
    return [12.0 + 12.0j + (7.0 + radius) * middle, (12.0 + 12.0j + (7.0 - radius) * middle)[::-1]]
