"""Measures of a strip of pictures, from which its grade is told: many, small, and of no meaning alone.

What is seen in each picture is a curve over time. Curves are compared with an even change from one end to the other,
and with both ends. A strip has the same measures backwards.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.grading.seen import even, largest, steps, strange

if TYPE_CHECKING:
    from shapeblend_cli.grading.seen import Seen
    from shapeblend_cli.model import BoolArray, FloatArray, PictureArray

CURVES = {
    "edges": 0.1,
    "area": 0.02,
    "spread": 0.01,
    "deep": 0.01,
    "thin": 0.003,
    "spikes": 0.05,
    "notches": 0.05,
    "patches": 1.0,
    "holes": 0.5,
    "pieces": 0.5,
    "asymmetry": 0.01,
    "border": 0.2,
    "width": 0.1,
    "height": 0.1,
    "variety": 0.5,
    "bends": 0.002,
}
"""Small amounts, by curve: changes are told relative to a curve and this much more."""

OF_CURVES = ("ends", "apart", "above", "below", "most", "least", "rough")
"""Measures of each curve."""

OTHERS = (
    *(f"{name} {what}" for name in ("strange", "outside", "lost", "astray") for what in ("mean", "most")),
    *(f"{name} {what}" for name in ("like", "unlike") for what in ("ends", "less", "more")),
    *(f"step {what}" for what in ("least", "most", "slower end", "faster end", "sum", "detour")),
)
"""Measures that are not of one curve alone."""

NAMES = (*(f"{curve} {what}" for curve in CURVES for what in OF_CURVES), *OTHERS)
"""Names of all measures, in order."""


def measures(seen: Seen) -> FloatArray:
    """Return the measures of a strip of which is known what is seen, (len(`NAMES`),)."""
    curves, ink = _curves(seen), seen.ink
    found = [value for name, little in CURVES.items() for value in _of_curve(curves[name], little)]
    others, known = strange(seen.lengths)
    outside = np.maximum(ink - np.maximum(ink[0], ink[-1]), 0.0).mean(axis=(1, 2))
    lost = np.maximum(np.minimum(ink[0], ink[-1]) - ink, 0.0).mean(axis=(1, 2))
    for curve in (others / (known + 2.0), outside, lost, _astray(ink)):
        found += [float(curve[1:-1].mean()), float(curve[1:-1].max())]
    return np.array([*found, *_likeness(ink), *_difference(seen.on_white), *_of_steps(seen)])


def _curves(seen: Seen) -> dict[str, FloatArray]:
    """Return what is seen in each picture, by the names of `CURVES`."""
    shares = seen.lengths / (seen.lengths.sum(axis=1, keepdims=True) + 1e-9)
    dark = seen.dark
    around = dark[:, 1:-1, 2:] + dark[:, 1:-1, :-2] + dark[:, 2:, 1:-1] + dark[:, :-2, 1:-1]
    more = {
        "area": seen.area,
        "width": _extent(seen.ink.max(axis=1) > 0.5),
        "height": _extent(seen.ink.max(axis=2) > 0.5),
        "variety": -(shares * np.log(shares + 1e-9)).sum(axis=1),  # entropy of the directions of edges
        "bends": np.abs(around - 4.0 * dark[:, 1:-1, 1:-1]).mean(axis=(1, 2)),
    }
    return {name: more[name] if name in more else getattr(seen, name) for name in CURVES}


def _extent(is_inked: BoolArray) -> FloatArray:
    """Return how far the first and the last inked row of each picture are apart, in sides."""
    first, last = is_inked.argmax(axis=1), is_inked[:, ::-1].argmax(axis=1)
    return np.where(is_inked.any(axis=1), is_inked.shape[1] - 1 - last - first, 0) / is_inked.shape[1]


def _of_curve(values: FloatArray, little: float) -> list[float]:
    """Return the measures `OF_CURVES` of a curve."""
    low, top = sorted((float(values[0]), float(values[-1])))
    within = values[1:-1]
    ratios = np.log((within + little) / (even(values)[1:-1] + little))
    way = float(np.abs(np.diff(values)).sum())
    return [
        0.5 * (low + top),
        top - low,
        float(np.maximum(ratios, 0.0).mean()),
        float(np.maximum(-ratios, 0.0).mean()),
        max(float(within.max()) - top, 0.0) / (top + little),
        max(low - float(within.min()), 0.0) / (low + little),
        (way - (top - low)) / (top + little),
    ]


def _astray(ink: PictureArray) -> FloatArray:
    """Return how far the centre of the ink of each picture is from an even way between both ends, in sides."""
    places = (np.arange(ink.shape[-1]) + 0.5) / ink.shape[-1]
    total = ink.sum(axis=(1, 2)) + 1e-9
    across, down = (ink.sum(axis=axis) @ places / total for axis in (1, 2))
    return np.asarray(np.hypot(across - even(across), down - even(down)), np.float64)


def _likeness(ink: PictureArray) -> list[float]:
    """Return the shares of ink that both ends have in common, and the middle with each end, the smaller one first."""

    def common(one: PictureArray, other: PictureArray) -> float:
        return float(np.minimum(one, other).sum() / max(float(np.maximum(one, other).sum()), 1e-9))

    middle = ink[len(ink) // 2]
    return [common(ink[0], ink[-1]), *sorted(common(middle, end) for end in (ink[0], ink[-1]))]


def _difference(on_white: PictureArray) -> list[float]:
    """Return the mean differences between both ends, and of the middle from each end, the smaller one first."""
    first, middle, last = on_white[0], on_white[len(on_white) // 2], on_white[-1]
    ends, *halves = (
        largest(np.stack([last - first, middle - first, last - middle])).mean(axis=(1, 2)).tolist()
    )
    return [ends, *sorted(halves)]


def _of_steps(seen: Seen) -> list[float]:
    """Return measures of the changes from each picture to the next."""
    changes = seen.steps + 1e-3
    total, direct = float(changes.sum()), float(steps(seen.pictures[[0, -1]])[0])
    slower, faster = sorted((float(changes[0]), float(changes[-1])))
    logs = np.log(np.array([changes.min(), changes.max(), slower, faster]) / changes.mean()).tolist()
    return [*logs, total, float(np.log((total + 0.01) / (direct + 0.01)))]
