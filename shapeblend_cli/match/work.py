"""The work it takes to bend and stretch one wire into another.

Section 3 of Sederberg and Greenwood, "A Physically Based Approach to 2-D Shape Blending", Computer
Graphics 26(2), 1992 (SIGGRAPH '92).

Both polygons are normalised to the unit box (section 3.3) before they come here. `i` runs over the
first and is axis 0 of every table, `j` runs over the second and is axis 1; figure 25 draws `i` as columns.
The paper's text calls eq (17) "equation 18".
"""

from __future__ import annotations

from dataclasses import asdict, dataclass
from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.match import angles

if TYPE_CHECKING:
    from shapeblend_cli.model import ComplexArray, FloatArray, IntArray

EE, ED, DE, SS, SD, DS, DD = range(7)
"""The bends of a dot by the step into it and the step out of it: the last axis of `Tables.bends`."""

EAST, SOUTH, SOUTHEAST = range(3)
"""Steps of a path: (1, 0), (0, 1) and (1, 1)."""

BEND_OF_STEPS = {
    (EAST, EAST): EE,
    (EAST, SOUTHEAST): ED,
    (SOUTHEAST, EAST): DE,
    (SOUTH, SOUTH): SS,
    (SOUTH, SOUTHEAST): SD,
    (SOUTHEAST, SOUTH): DS,
    (SOUTHEAST, SOUTHEAST): DD,
}
"""Turns of 90 degrees, East then South and South then East, are not there: section 4 forbids them."""


@dataclass(frozen=True, slots=True)
class WorkConstants:
    """The paper's seven constants; the defaults are measured, not the paper's.

    Attributes
    ----------
    k_s, k_b : float >= 0
        Stiffness against stretching and bending.
    e_s, e_b : float > 0
        Exponents of stretching and bending.
    p_b : float >= 0
        Penalty for an angle that reaches zero.
    m_b : float >= 0
        Penalty for an angle that does not change monotonically.
    c_s : float in (0, 1]
        Penalty for edges that collapse to a point: the smaller, the dearer.
    """

    k_s: float = 1.0
    k_b: float = 1.0
    e_s: float = 2.0
    e_b: float = 1.0
    p_b: float = 1000.0
    m_b: float = 10.0
    c_s: float = 0.5

    def __post_init__(self) -> None:
        for name, value in asdict(self).items():
            if not np.isfinite(value) or value < 0.0:
                raise ValueError(f"{name} must be a number >= 0, not {value}")
        if not 0.0 < self.c_s <= 1.0:
            raise ValueError(f"c_s must lie in (0, 1], not {self.c_s}")
        if self.e_s == 0.0 or self.e_b == 0.0:
            raise ValueError("e_s and e_b must be greater than 0")

    def bending(self) -> tuple[float, float, float, float]:
        """The constants of eq (17) in the order the kernels take them: k_b, m_b, e_b, p_b."""
        return self.k_b, self.m_b, self.e_b, self.p_b


class Tables(NamedTuple):
    """The work of every step and every bend of a graph, over one period of its dots.

    Attributes
    ----------
    east : (m,) float
        Stretching work of the East step that leaves column i.
    south : (n,) float
        Stretching work of the South step that leaves row j.
    southeast : (m, n) float
        Stretching work of the Southeast step that leaves dot [i, j].
    bends : (m, n, 7) float
        Bending work at dot [i, j] by the steps into it and out of it, see `BEND_OF_STEPS`.
    """

    east: FloatArray
    south: FloatArray
    southeast: FloatArray
    bends: FloatArray


class PathWork(NamedTuple):
    """What a path costs, and how many of its angles reach zero."""

    stretching: float
    bending: float
    zero_angles: int

    @property
    def total(self) -> float:
        """Stretching and bending work together."""
        return self.stretching + self.bending


def edge_lengths(vertices: ComplexArray, closed: bool) -> FloatArray:
    """Length of the edge that leaves each vertex; the last of an open polygon leads nowhere: 0."""
    edges = np.roll(vertices, -1) - vertices
    if not closed:
        edges[-1] = 0.0
    return np.abs(edges)


def corners(vertices: ComplexArray, closed: bool) -> FloatArray:
    """What the bends need to know of each vertex of a wire.

    Parameters
    ----------
    vertices : (m,) complex
        No two neighbours are equal. m >= 2 when open, >= 3 when closed.
    closed : bool
        An open wire goes straight on beyond its ends: the missing edge of an end vertex is the other one
        reversed, so a run of coincident vertices on it lies along the wire.

    Returns
    -------
    (m, 10) float
        theta = arg(conj(F) B) in [0, 2 pi); B; F; arg B; arg F; the direction d of the base on which
        coincident vertices lie (section 2.2), B turned by -(90 degrees + theta / 2): arg d, d.
    """
    fwd = np.roll(vertices, -1) - vertices
    back = np.roll(vertices, 1) - vertices
    if not closed:
        fwd[-1] = -back[-1]
        back[0] = -fwd[0]
    theta = np.angle(fwd.conj() * back)
    theta = np.where(theta < 0.0, theta + 2.0 * np.pi, theta)
    base = back / np.abs(back) * np.exp(-1j * (0.5 * np.pi + 0.5 * theta))
    columns = (
        theta, back.real, back.imag, fwd.real, fwd.imag,
        np.angle(back), np.angle(fwd), np.angle(base), base.real, base.imag,
    )  # fmt: skip
    return np.ascontiguousarray(np.stack(columns, axis=1))


def stretching_work(len0: FloatArray, len1: FloatArray, constants: WorkConstants) -> FloatArray:
    """Work to stretch edges of one wire onto edges of the other.

    Equation (16), section 3.1.

    Parameters
    ----------
    len0, len1 : ndarray of float, mutually broadcastable
        Edge lengths L0 and L1 in unit-box lengths (section 3.3), >= 0.
    constants : WorkConstants
        Reads k_s, e_s, c_s.

    Returns
    -------
    ndarray of the broadcast shape, >= 0

    Notes
    -----
    Symmetric in the two lengths. Departure: L0 = L1 = 0 is 0/0 in (16); here it is 0.

    Examples
    --------
    Leg 1-2 of figure 23 (section 3.4):

    >>> w = stretching_work(0.5**0.5, 1.0, WorkConstants(k_s=0.5, c_s=0.5, e_s=1))
    >>> round(float(w), 4)
    0.1716
    """
    k_s, e_s, c_s = constants.k_s, constants.e_s, constants.c_s
    delta = np.abs(np.subtract(len1, len0))
    resistance = (1.0 - c_s) * np.minimum(len0, len1) + c_s * np.maximum(len0, len1)
    return k_s * np.power(delta, e_s) / np.where(resistance > 0.0, resistance, 1.0)


def tables(p0: ComplexArray, p1: ComplexArray, closed: bool, constants: WorkConstants) -> Tables:
    """Price every step and every bend of the graph of two polygons in the unit box.

    O(m n) time and memory, 64 bytes a dot.
    """
    len0, len1 = edge_lengths(p0, closed), edge_lengths(p1, closed)
    bends = np.empty((len(p0), len(p1), 7))
    angles.fill_bends(corners(p0, closed), corners(p1, closed), *constants.bending(), bends)
    return Tables(
        east=stretching_work(len0, np.zeros(1), constants),
        south=stretching_work(np.zeros(1), len1, constants),
        southeast=stretching_work(len0[:, None], len1[None, :], constants),
        bends=bends,
    )


def path_work(
    p0: ComplexArray, p1: ComplexArray, dots: IntArray, closed: bool, constants: WorkConstants
) -> PathWork:
    """Price a given path by the equations, without a graph.

    Parameters
    ----------
    p0, p1 : (m,) and (n,) complex
        Polygons in the unit box.
    dots : (k, 2) int
        The path, from its first dot; a closed path comes back to that dot after the last, which is not
        repeated. Every step goes East, South or Southeast, and none is followed by a turn of 90 degrees.
    closed : bool
        The bend at the first dot is charged when closed; open wires have no angle at their ends.

    Returns
    -------
    PathWork

    Raises
    ------
    ValueError
        A step is none of the three, or a turn of 90 degrees.
    """
    m, n = len(p0), len(p1)
    following = np.roll(dots, -1, axis=0) if closed else dots[1:]
    moves = (following - dots[: len(following)]) % (m, n)
    steps = [{(1, 0): EAST, (0, 1): SOUTH, (1, 1): SOUTHEAST}.get((di, dj)) for di, dj in moves.tolist()]
    turns = list(zip(steps[-1:] + steps[:-1], steps, strict=True)) if closed else list(pairwise(steps))
    if None in steps or not all(turn in BEND_OF_STEPS for turn in turns):
        raise ValueError(
            "a path goes one step East, South or Southeast at a time, without turns of 90 degrees"
        )

    start = dots[: len(moves)]
    len0 = edge_lengths(p0, closed)[start[:, 0]] * moves[:, 0]
    len1 = edge_lengths(p1, closed)[start[:, 1]] * moves[:, 1]
    corners0, corners1 = corners(p0, closed), corners(p1, closed)
    bending, zero_angles = 0.0, 0
    for (i, j), turn in zip((dots if closed else dots[1:-1]).tolist(), turns, strict=True):
        kind = BEND_OF_STEPS[turn]  # type: ignore[index]
        bending += angles.bend_at(corners0, corners1, i, j, kind, *constants.bending())
        zero_angles += angles.bend_at(corners0, corners1, i, j, kind, 0.0, 0.0, 1.0, 1.0) > 0.0
    return PathWork(float(stretching_work(len0, len1, constants).sum()), bending, int(zero_angles))
