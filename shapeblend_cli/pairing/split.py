"""One outline that becomes several: cut into as many pieces as it has partners."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.geometry import cubics
from shapeblend_cli.geometry.flatten import flatten
from shapeblend_cli.geometry.polygons import signed_area, winding_numbers
from shapeblend_cli.model import Contour
from shapeblend_cli.pairing.decompose import EXTERIOR, PlacedContour

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import ComplexArray, FloatArray, IntArray, Polygon

    Couple = tuple[PlacedContour, PlacedContour]

ENDS = 96
"""Vertices between which a cut may go, at most."""

TRIES = 400
"""The best cuts, by what they cost, that are looked at for lying inside."""

LEAST_SHARE = 0.02
"""No piece is smaller, as a share of what is cut."""

AXES = (1.0 + 0.0j, 1.0j, 1.0 + 1.0j, 1.0 - 1.0j)
"""Directions in which the partners may be told apart."""

# What makes a cut bad, each about 1 at its worst: the wrong share of the area, a length beside the outline's own size,
# and pieces that do not lie to each other as their partners do.
SHARE, LENGTH, DIRECTION = 2.0, 0.5, 0.5


def split_exteriors(
    a: Sequence[PlacedContour], b: Sequence[PlacedContour], couples: Sequence[Couple], vertices: int
) -> list[Couple]:
    """Give outlines without a partner a piece of the nearest outline that has one.

    Parameters
    ----------
    a, b : sequence of PlacedContour
        All contours of the drawings.
    couples : sequence of (PlacedContour, PlacedContour)
        Those that are paired, at least one.
    vertices : int >= 0
        Vertices a contour, about.

    Returns
    -------
    list of (PlacedContour, PlacedContour)
        The couples; where an outline has become several, its pieces, which go by its number. An outline
        that no straight cut divides stays whole, and the others stay without a partner.
    """
    found = list(couples)
    for owner_side, parts in enumerate((b, a)):  # outlines of A are cut for B's, then B's for A's
        paired = {couple[1 - owner_side].number for couple in found}
        wanting: dict[int, list[PlacedContour]] = {}
        owners = [c for c in found if c[0].role == c[1].role == EXTERIOR]
        for part in parts:
            if part.role == EXTERIOR and part.number not in paired and owners:
                wanting.setdefault(_nearest(part, [c[owner_side] for c in owners]), []).append(part)
        for number, partners in wanting.items():
            couple = owners[number]
            owner = couple[owner_side]
            whole = [couple[1 - owner_side], *partners]
            holes = [p.polygon for p in (a, b)[owner_side] if p.exterior == owner.number]
            pieces = _pieces(owner.contour, owner.polygon, holes, whole, vertices)
            if pieces is None:
                continue
            found.remove(couple)
            for contour, partner in pieces:
                piece = _piece(owner, contour, vertices)
                found.append((partner, piece) if owner_side else (piece, partner))
    return found


def _nearest(part: PlacedContour, owners: Sequence[PlacedContour]) -> int:
    """Number in the list of the outline nearest to a contour; of two as near, the larger."""
    watched = part.polygon.vertices[:: -(-len(part.polygon.vertices) // 24)]

    def distance(owner: PlacedContour) -> tuple[float, float]:
        inside = winding_numbers(watched, owner.polygon.vertices) != 0
        away = np.abs(owner.polygon.vertices[:, None] - watched).min(axis=0)
        return float(np.where(inside, 0.0, away).min()), -owner.size

    return min(range(len(owners)), key=lambda k: distance(owners[k]))


def _piece(owner: PlacedContour, contour: Contour, vertices: int) -> PlacedContour:
    polygon = flatten(contour, vertices)
    return owner._replace(contour=contour, polygon=polygon, box=polygon.box, is_piece=True)


class _Cut(NamedTuple):
    """A cut between vertices i and j of a polygon: the first piece goes from i to j, the second from j to i."""

    cost: float
    i: int
    j: int


def _pieces(
    contour: Contour,
    polygon: Polygon,
    holes: Sequence[Polygon],
    partners: Sequence[PlacedContour],
    vertices: int,
) -> list[tuple[Contour, PlacedContour]] | None:
    """Cut a contour into a piece for each partner, by halves; None where no cut lies inside."""
    if len(partners) == 1:
        return [(contour, partners[0])]
    halved = [_halved(partners, axis) for axis in AXES]
    cuts = [
        _best_cut(polygon, holes, _area(first) / _area([*first, *second]), _middle(second) - _middle(first))
        for first, second in halved
    ]
    best, cut = min(enumerate(cuts), key=lambda one: np.inf if one[1] is None else one[1].cost)
    if cut is None:
        return None
    first, second = halved[best]
    found: list[tuple[Contour, PlacedContour]] = []
    for half, i, j in ((first, cut.i, cut.j), (second, cut.j, cut.i)):
        piece = _run(contour, polygon, i, j)
        shape = flatten(piece, vertices)
        inside = [hole for hole in holes if winding_numbers(hole.vertices[:1], shape.vertices)[0]]
        pieces = _pieces(piece, shape, inside, half, vertices)
        if pieces is None:
            return None
        found += pieces
    return found


def _halved(
    partners: Sequence[PlacedContour], axis: complex
) -> tuple[list[PlacedContour], list[PlacedContour]]:
    """The partners that lie first along an axis, and the others."""
    ranked = sorted(partners, key=lambda part: ((part.centre * axis.conjugate()).real, part.number))
    return ranked[: len(ranked) // 2], ranked[len(ranked) // 2 :]


def _middle(parts: Sequence[PlacedContour]) -> complex:
    return sum(part.centre for part in parts) / len(parts)


def _area(parts: Sequence[PlacedContour]) -> float:
    return sum(abs(signed_area(part.polygon.vertices)) for part in parts)


def _best_cut(polygon: Polygon, holes: Sequence[Polygon], share: float, way: complex) -> _Cut | None:
    """The best straight cut that takes off a share of the area, what is left lying in a given direction from it."""
    z = polygon.vertices
    ends = np.round(np.linspace(0, len(z), min(ENDS, len(z)), endpoint=False)).astype(np.intp)
    shares, ways = _halves(z, ends)
    lengths = np.abs(z[ends][:, None] - z[ends]) / np.sqrt(abs(signed_area(z)))
    with np.errstate(divide="ignore", invalid="ignore"):
        turned = (ways * np.conj(way)).real / (np.abs(ways) * abs(way))
    cost = SHARE * np.abs(shares - share) + LENGTH * lengths + DIRECTION * 0.5 * (1.0 - turned)
    cost[~((shares > LEAST_SHARE) & (shares < 1.0 - LEAST_SHARE) & np.isfinite(cost))] = np.inf
    edges = [z, *(hole.vertices for hole in holes)]
    for flat in np.argsort(cost, axis=None, kind="stable")[:TRIES]:
        p, q = np.unravel_index(flat, cost.shape)
        if np.isfinite(cost[p, q]) and _lies_inside(complex(z[ends[p]]), complex(z[ends[q]]), edges):
            return _Cut(float(cost[p, q]), int(ends[p]), int(ends[q]))
    return None


def _halves(z: ComplexArray, ends: IntArray) -> tuple[FloatArray, ComplexArray]:
    """For every two ends i, j: the share of the area from i to j, and the way from its centroid to that of the rest."""
    origin = z[0]
    p, q = z - origin, np.roll(z, -1) - origin
    cross = (p.conj() * q).imag / 2.0
    areas = np.concatenate([[0.0], np.cumsum(cross)])
    moments = np.concatenate([[0.0], np.cumsum(cross * (p + q) / 3.0)])
    total, moment = areas[-1], moments[-1]
    at = p[ends]
    chord = (at.conj()[None, :] * at[:, None]).imag / 2.0  # from j back to i
    ahead = ends[None, :] >= ends[:, None]
    run = areas[ends][None, :] - areas[ends][:, None] + np.where(ahead, 0.0, total) + chord
    run_moment = (
        moments[ends][None, :]
        - moments[ends][:, None]
        + np.where(ahead, 0.0, moment)
        + chord * (at[None, :] + at[:, None]) / 3.0
    )
    with np.errstate(divide="ignore", invalid="ignore"):
        return run / total, (moment - run_moment) / (total - run) - run_moment / run


def _lies_inside(start: complex, end: complex, outlines: Sequence[ComplexArray]) -> bool:
    """Whether a line between two vertices of the first outline lies in it, in no other, and meets none on the way."""
    along = end - start
    inner = start + along * np.array([0.02, 0.25, 0.5, 0.75, 0.98])
    if not winding_numbers(inner, outlines[0]).all():
        return False
    for z in outlines:
        p, q = z, np.roll(z, -1)
        side_p, side_q = ((np.conj(along) * (w - start)).imag for w in (p, q))
        side_start, side_end = ((np.conj(q - p) * (w - p)).imag for w in (start, end))
        if ((side_p * side_q < 0.0) & (side_start * side_end < 0.0)).any():
            return False
    return True


def _run(contour: Contour, polygon: Polygon, i: int, j: int) -> Contour:
    """The contour from vertex i to vertex j of its polygon, closed by a straight line."""
    count = len(contour.segments)
    first, start = int(polygon.segment[i]), float(polygon.parameter[i])
    last, end = int(polygon.segment[j]), float(polygon.parameter[j])
    if end == 0.0:  # a node: the end of the segment before
        last, end = (last - 1) % count, 1.0
    steps = (last - first) % count
    if steps == 0 and end <= start:
        steps = count
    numbers = (first + np.arange(steps + 1)) % count
    begins, stops = np.zeros(steps + 1), np.ones(steps + 1)
    begins[0], stops[-1] = start, end
    segments = cubics.pieces(contour.segments[numbers], begins, stops)
    closing = cubics.line(segments[-1, 3], segments[0, 0])
    return Contour(np.vstack([segments, closing]), np.append(contour.straight[numbers], True), closed=True)
