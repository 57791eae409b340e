"""Motion by lengths and angles: limbs swing and keep their lengths, where straight paths shorten them.

After T. W. Sederberg, P. Gao, G. Wang and H. Mu, "2-D Shape Blending: An Intrinsic Solution to the Vertex Path
Problem", Computer Graphics (Proceedings of SIGGRAPH 93), 1993, pages 15-18.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.motion.alignment import Rigid
from shapeblend_cli.motion.turning import ROUND, directions

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import BoolArray, ComplexArray, ContourBlend, CubicPath, FloatArray, IntArray
    from shapeblend_cli.motion.alignment import Alignment

WAITS = 1e-9
"""A leg of less length, with the whole chain's as 1, is a point."""

FIRMNESS = 0.2
"""The floor under the relative change of length which says how readily a leg gives way, the paper's ``L_tol``."""

LARGEST = 4.0
"""About where the multipliers are held back; a leg as ready as the mean then changes by a factor of 50."""

ROUNDS = 40
"""Newton steps at most; four to six are usual."""

CLOSED = 1e-13
"""What may be open after Newton's method, with the whole chain's length as 1; it is closed exactly then."""


class Legs(NamedTuple):
    """A contour by lengths and directions of its control polygon, both with the similarity taken back.

    Attributes
    ----------
    moves : (n,) bool
        Which of the control polygon's legs are ever more than a point, m of them.
    start, end : (m,) float
        Lengths, ``L_A`` and ``L_B``.
    direction, swing : (m,) float
        The directions at the start, and by how much they change: radians.
    softness : (m,) float
        How readily a length gives way; 1 in the mean.
    weight : (n + 1,) float
        How much each control point says about where the contour is; together 1.
    places : (complex, complex)
        Where the contour is, so weighted, at the start and the end.
    corners : (s, 4) int
        Which control point each of a segment's is.
    straight : (s,) bool
    closed : bool
    """

    moves: BoolArray
    start: FloatArray
    end: FloatArray
    direction: FloatArray
    swing: FloatArray
    softness: FloatArray
    weight: FloatArray
    places: tuple[complex, complex]
    corners: IntArray
    straight: BoolArray
    closed: bool

    def at(self, t: float) -> ComplexArray:
        """Control points at time t, (n + 1,) complex, with the similarity taken back."""
        length = (1.0 - t) * self.start + t * self.end
        u = np.exp(1j * (self.direction + t * self.swing))
        if self.closed:
            length = closing(length, u, self.softness)
            u = u - (length * u).sum() / length.sum()
        points = np.zeros(len(self.moves) + 1, np.complex128)
        points[1:][self.moves] = length * u
        points = points.cumsum()
        place = (1.0 - t) * self.places[0] + t * self.places[1]
        return points + (place - (self.weight * points).sum())


class Intrinsic(NamedTuple):
    """Lengths of legs and the angles between them go evenly from start to end; see `intrinsic`, which makes this.

    Attributes
    ----------
    alignment : Alignment
        Its turn is that of most of the contours' length.
    contours : tuple of Legs or None
        For each contour, in order; None where it moves as `Rigid` has it.
    """

    alignment: Alignment
    contours: tuple[Legs | None, ...]

    @property
    def name(self) -> str:
        """As `--motion` has it."""
        return "intrinsic"

    def segments(self, contours: Sequence[ContourBlend], t: float) -> list[ComplexArray]:
        """Control points of each contour at time t; the contours are those this was made of."""
        found = []
        for contour, legs in zip(contours, self.contours, strict=True):
            if legs is None:
                found += Rigid(self.alignment).segments([contour], t)
                continue
            segments = self.alignment.apply(legs.at(t), t)[legs.corners]
            lines = segments[legs.straight]
            chord = lines[:, 3] - lines[:, 0]
            lines[:, 1], lines[:, 2] = lines[:, 0] + chord / 3.0, lines[:, 0] + chord * (2.0 / 3.0)
            segments[legs.straight] = lines
            found.append(segments)
        return found


def intrinsic(contours: Sequence[ContourBlend], alignment: Alignment) -> Intrinsic:
    """The intrinsic motion of contours that are painted together.

    Parameters
    ----------
    contours : sequence of ContourBlend
    alignment : Alignment
        The best similarity between them.

    Notes
    -----
    The paper describes a polygon as a turtle would walk it: lengths of edges ``L_i``, turns ``θ_i`` at the vertices,
    the first direction ``α_0``. In between,

        θ_i = (1 - t) θ_Ai + t θ_Bi,    α_i = α_(i-1) + θ_i,    L_i = (1 - t) L_Ai + t L_Bi + S_i,

    with the least ``S_i`` that close the polygon, ``Σ L_i (cos α_i, sin α_i) = 0``: of all, those which minimise
    ``Σ S_i² / w_i²``, where ``w_i = max(|L_Ai - L_Bi|, L_tol)`` so that edges alike in both stay as they are. With a
    Lagrange multiplier ``λ`` for each coordinate that is ``S_i = w_i² (λ_1 cos α_i + λ_2 sin α_i)`` and two linear
    equations for ``λ``.

    This is the paper's way but for the following.

    * It is the control polygons that move, a leg for a straight segment and three for a curve. Where the outlines are
      smooth at a join in both drawings, the turn there is zero at the start and at the end, and so always.
    * The similarity is taken back from B first, and comes in again as in `Rigid`. A shape and the same shape turned,
      scaled and moved have that shape between them, scaled geometrically, and several contours keep together.
    * ``w_i²`` is ``σ_i L_i`` with ``σ_i = ((L_Ai - L_Bi) / (L_Ai + L_Bi))² + FIRMNESS²``. A leg cut into two then gives
      way as much as before, while the paper's, twice as firm, would depend on where curves happen to be cut.
    * Lengths change by a factor, ``L_i exp(σ_i (λ_1 cos α_i + λ_2 sin α_i))``, which differs from the paper's in the
      second order and never makes a length negative, which would turn its leg round. See `closing`.
    * Legs that are a point in one of the drawings, tips and sums of turns: see `turns.directions`.
    * Directions of B are those of A plus a swing, and a whole number of rounds is free. The swings' mean, weighted by
      length, is the nearest possible to the similarity's turn.
    * A limb that swings takes the best similarity with it. So the similarity's turn is replaced by the median of all
      legs' turns, weighted by length: that of the body, if a limb is less than half the outline.
    * The paper puts the first vertex on a straight path. Here it is a weighted mean of the control points that is
      where the rigid motion, with that turn, has it. A leg counts by its length and ``cos²`` of half its swing, which
      is the share of its length that it has half way on a straight path, squared; so a limb that swings hardly pushes
      the body away.

    Contours that grow from a point or shrink to one move as `Rigid` has it; also those that go round a different
    number of times in both drawings, such as an outline that becomes a figure of eight, for then there is no turning
    evenly from one to the other.
    """
    paths = [_path(contour) for contour in contours]
    moving = [path for path in paths if path is not None]
    if moving:
        alignment = alignment._replace(rotation=_median_turn(moving, alignment.rotation))
    return Intrinsic(alignment, tuple(path and _legs(path, alignment) for path in paths))


class _Path(NamedTuple):
    """A contour's control polygon; as in `Legs` but for the similarity, which is not yet taken back.

    Attributes
    ----------
    points : pair of (n + 1,) complex
        Control points at the start and the end; those of closed contours begin again.
    share : (m,) float
        How much of the contour each leg is, of both lengths; together 1.
    """

    outline: CubicPath
    points: tuple[ComplexArray, ComplexArray]
    corners: IntArray
    moves: BoolArray
    start: FloatArray
    end: FloatArray
    direction: FloatArray
    swing: FloatArray
    share: FloatArray

    def near(self, turn: float) -> FloatArray:
        """The swings, with that multiple of a round which brings their mean nearest to a turn."""
        return self.swing - ROUND * round((float((self.share * self.swing).sum()) - turn) / ROUND)


def _path(contour: ContourBlend) -> _Path | None:
    """The control polygon of a contour, or None where it has no directions to move by."""
    if contour.grows or contour.shrinks:
        return None
    straight, closed = contour.start.straight, contour.start.closed
    counts = np.where(straight, 1, 3)
    segment = np.repeat(np.arange(len(straight)), counts)
    first = np.cumsum(counts) - counts
    number = np.arange(len(segment)) - first[segment]
    corners = first[:, None] + np.where(straight[:, None], [0, 0, 1, 1], [0, 1, 2, 3])
    a, b = (
        np.append(
            outline.segments[segment, number], outline.segments[0, 0] if closed else outline.segments[-1, 3]
        )
        for outline in (contour.start, contour.end)
    )
    if closed:
        corners[-1, 3] = 0  # to the bit the same point
    legs_a, legs_b = np.diff(a), np.diff(b)
    for legs in (legs_a, legs_b):
        legs[np.abs(legs) <= WAITS * np.abs(legs).sum()] = 0.0
    moves = (legs_a != 0.0) | (legs_b != 0.0)
    legs_a, legs_b = legs_a[moves], legs_b[moves]
    found = directions(legs_a, legs_b, segment[moves], closed)
    if found is None:
        return None
    start, end = np.abs(legs_a), np.abs(legs_b)
    share = start / start.sum() + end / end.sum()
    share /= share.sum()
    return _Path(contour.start, (a, b), corners, moves, start, end, found[0], found[1] - found[0], share)


def _median_turn(paths: Sequence[_Path], turn: float) -> float:
    """The swing that as much of the contours' length is below as above; rounds are counted from a turn."""
    swing = np.concatenate([path.near(turn) for path in paths])
    start = np.concatenate([path.start for path in paths])
    end = np.concatenate([path.end for path in paths])
    order = swing.argsort()
    swing = swing[order]
    below = (start / start.sum() + end / end.sum())[order].cumsum()
    # Where exactly half is below, time backwards finds the next one.
    low, high = np.searchsorted(below, below[-1] * np.array([0.5 - 1e-9, 0.5 + 1e-9]))
    return 0.5 * float(swing[low] + swing[min(high, len(swing) - 1)])


def _legs(path: _Path, alignment: Alignment) -> Legs:
    """How a control polygon moves, once a similarity is taken back."""
    start, end = path.start, path.end / alignment.scale
    swing = path.near(alignment.rotation) - alignment.rotation
    softness = ((start - end) / (start + end)) ** 2 + FIRMNESS**2
    weight = np.zeros(len(path.moves))
    weight[path.moves] = path.share * (np.cos(0.5 * np.clip(swing, -np.pi, np.pi)) ** 2 + 1e-6)
    around = np.append(weight, 0.0) + np.append(0.0, weight)
    around /= around.sum()
    a, b = path.points[0] - alignment.centre_a, alignment.undo(path.points[1])
    return Legs(
        path.moves,
        start,
        end,
        path.direction,
        swing,
        softness / (path.share * softness).sum(),
        around,
        (complex((around * a).sum()), complex((around * b).sum())),
        path.corners,
        path.outline.straight,
        path.outline.closed,
    )


def closing(length: FloatArray, u: ComplexArray, softness: FloatArray) -> FloatArray:
    """Lengths that close a polygon of given directions, each by its softness as near as possible to what it was.

    Parameters
    ----------
    length : (m,) float >= 0
    u : (m,) complex
        Directions, of length 1.
    softness : (m,) float > 0

    Returns
    -------
    (m,) float >= 0
        ``L_i exp(σ_i u_i·λ)``, with ``u_i·λ`` the inner product. Zero stays zero.

    Notes
    -----
    ``λ`` minimises ``Σ (L_i / σ_i) exp(σ_i u_i·λ)``, a convex function whose gradient is what is open. Newton's first
    step from zero solves the paper's two linear equations.

    A minimum exists if directions do not all lie in one half of the circle, which is so for turns that make one round
    and each of which is less than half a round. For others ``λ`` would go to infinity. So
    ``|λ|⁸ / (8 LARGEST⁸)``, times the length of all, is added: for the ``|λ|`` of common shapes, less than 1, it is
    less than rounding in a drawing, 1e-5 of the length; otherwise it leaves the polygon open in a way that is
    continuous in time. What is open then the caller has to spread.
    """
    total = float(length.sum())
    x = y = 0.0
    cos, sin = u.real, u.imag
    furthest = 2.0 / float(softness.max())
    found = length
    for _ in range(ROUNDS):
        found = length * np.exp(softness * (cos * x + sin * y))
        square = x * x + y * y
        hold = total * square**3 / LARGEST**8
        open_x, open_y = float(found @ cos) + hold * x, float(found @ sin) + hold * y
        if abs(open_x) + abs(open_y) <= CLOSED * total:
            break
        firm = softness * found
        growth = 6.0 * total * square * square / LARGEST**8
        every = float(firm.sum())
        along = float(firm @ (cos * cos))
        # The added share keeps directions that are all alike, or opposite, from dividing by zero.
        xx = along + hold + growth * x * x + 1e-12 * every
        yy = every - along + hold + growth * y * y + 1e-12 * every
        xy = float(firm @ (cos * sin)) + growth * x * y
        determinant = xx * yy - xy * xy
        step_x = (xy * open_y - yy * open_x) / determinant
        step_y = (xy * open_x - xx * open_y) / determinant
        size = float(np.hypot(step_x, step_y))
        shorter = min(1.0, furthest / size) if size > 0.0 else 1.0
        x, y = x + shorter * step_x, y + shorter * step_y
    return found
