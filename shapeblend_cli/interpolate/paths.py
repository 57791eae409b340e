"""Straight vertex paths, eq (2)."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from shapeblend_cli.model import ComplexArray, IntArray


def blend_vertices(p0: ComplexArray, p1: ComplexArray, dots: IntArray, t: float) -> ComplexArray:
    """The polygon at time t, eq (2): a vertex for every dot.

    Parameters
    ----------
    p0, p1 : (m,) and (n,) complex
        The polygons in common coordinates.
    dots : (k, 2) int
        Vertex numbers that correspond.
    t : float in [0, 1]

    Returns
    -------
    (k,) complex
        At 0 and 1 exactly the vertices of `p0` and `p1`, some of them repeated.
    """
    return (1.0 - t) * p0[dots[:, 0]] + t * p1[dots[:, 1]]
