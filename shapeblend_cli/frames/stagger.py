"""Shapes that start one after the other."""

from __future__ import annotations

from typing import TYPE_CHECKING

from shapeblend_cli.model import Pair, ShapeBlend, control_box

if TYPE_CHECKING:
    from collections.abc import Callable


def staggered(pair: Pair, stagger: float, by: str) -> Pair:
    """Return a pair whose shapes start in turn, the last after a share of the time, and take equally long.

    They start in paint order, by size, or from one side of the drawing. Copies of a shape start together.
    """
    key = _key(by)
    parts: dict[tuple[tuple[int | None, int | None], ...], list[int]] = {}
    for k, shape in enumerate(pair.shapes):
        parts.setdefault(tuple((c.a, c.b) for c in shape.contours), []).append(k)
    if len(parts) < 2:
        return pair
    ranked = sorted(parts.values(), key=lambda numbers: key(pair.shapes[numbers[0]]))
    shapes = list(pair.shapes)
    for rank, numbers in enumerate(ranked):
        begin = stagger * rank / (len(ranked) - 1)
        for k in numbers:
            shapes[k] = shapes[k]._replace(span=(begin, begin + 1.0 - stagger))
    return pair._replace(shapes=tuple(shapes))


def _key(by: str) -> Callable[[ShapeBlend], float]:
    if by == "order":
        return lambda shape: 0.0  # sorting keeps the order
    if by == "size":
        return lambda shape: -shape.size
    sign = -1.0 if by in ("right", "bottom") else 1.0
    if by in ("left", "right"):
        return lambda shape: sign * _centre(shape).real
    return lambda shape: sign * _centre(shape).imag


def _centre(shape: ShapeBlend) -> complex:
    """Return the middle of a shape in the first drawing; in the second if it is not in the first."""
    matched = [c for c in shape.contours if not c.grows] or list(shape.contours)
    outlines = [c.end if c.grows else c.start for c in matched]
    return control_box(outlines).centre
