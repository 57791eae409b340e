"""The point from which a contour without a partner grows, carried along by contours with one: its middle, or a contact.

"Here" is the drawing with the contour, "there" the drawing without it. The contour grows from a point there while the
paired contours, `MatchedPoints`, move from there to here on straight paths. A contour that shrinks does so in reverse.
"""

from __future__ import annotations

from itertools import islice
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.anatomy.decompose import HOLE
from shapeblend_cli.geometry.polygons import centroid, mean_value_weights, winding_numbers
from shapeblend_cli.geometry.polyline import are_near, thin
from shapeblend_cli.model import Box, Root
from shapeblend_cli.pairing.riders import riders

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    from shapeblend_cli.anatomy.decompose import PlacedContour
    from shapeblend_cli.model import ComplexArray, FloatArray

TIMES = np.arange(1, 10) / 10
"""Times at which a growing hole is checked for lying inside."""

WATCHED = 24
"""Maximum number of vertices of an outline that are checked."""

GRID = 12
"""Number of rows and columns of the grid of points from which a hole may grow instead of its own."""

TRIES = 40
"""Maximum number of points that are tried."""

FALL = 4
"""Power of the distance with which the weight of a vertex falls for a point outside."""


TOUCHING = 0.02
"""Maximum distance of contours that touch, as a share of the drawing's diagonal."""

GAP = 0.06
"""Maximum gap between contours of one paint that belong together, as a share of the drawing's diagonal."""

BESIDE = 0.2
"""Maximum gap between a contour and one of another paint that it stands beside, as a share of its size."""

EQUALLY_NEAR = 0.1
"""Maximum difference of gaps that are equal, in distances of contours that touch."""

CONTACTS = 48
"""Number of points of a contour that may touch another one."""

MOST_OF_GROUP = 0.25
"""Maximum area of contours that touch and shrink as one, as a share of the drawing's box: more of them would be a small
picture on another drawing."""

WIDEST_GROUP = 0.9
"""Maximum larger side of contours that touch and shrink as one, as a share of that of the drawing's box."""

LEAST_HOST = 0.5
"""Minimum area of a contour that carries another along, as a share of the other one's area."""

NEARLY_ALL = 0.9
"""Minimum share of points inside of a contour that lies in another."""


class MatchedPoints(NamedTuple):
    """Corresponding vertices of a paired contour, (k,) complex each."""

    here: ComplexArray
    there: ComplexArray


class Carrier(NamedTuple):
    """A contour with a partner, and its vertices that correspond."""

    contour: PlacedContour
    points: MatchedPoints


class Spot(NamedTuple):
    """The point from which a contour without a partner grows, and where it is attached, if it is."""

    point: complex
    root: Root | None = None


def nearest_paired(
    contour: ComplexArray, paired: Sequence[MatchedPoints], bounds: FloatArray
) -> tuple[int, float]:
    """Return the index of the paired contour that is nearest here to a contour, (n,) complex, and its distance.

    The bounds of the paired contours here are (paired, 4).
    """
    watched = thin(contour, WATCHED)
    low, high = (Box.around(watched).bounds[k : k + 2] for k in (0, 2))
    apart = np.maximum(np.maximum(bounds[:, :2] - high, low - bounds[:, 2:]), 0.0)
    gaps = (1.0 - 1e-9) * np.hypot(apart[:, 0], apart[:, 1])  # no vertex is nearer than the boxes are
    best = np.inf, 0
    for k in np.argsort(gaps, kind="stable").tolist():
        if gaps[k] > best[0]:
            break
        best = min(best, (float(np.abs(paired[k].here[:, None] - watched).min()), k))
    return best[1], best[0]


def carried(point: complex, by: MatchedPoints, *, inside: bool) -> complex:
    """Return the image there of a point here that a paired contour carries along.

    Inside a closed contour the point keeps its mean value coordinates. Elsewhere, or if these lead out of the contour,
    it moves as far as the vertices on average, of which the nearer weigh far more.
    """
    if inside:
        image = complex(mean_value_weights(point, by.here) @ by.there)
        if winding_numbers(np.array([image]), by.there)[0]:
            return image
    distances = np.abs(by.here - point)
    weights = 1.0 / np.maximum(distances, 1e-3 * max(float(distances.max()), 1e-12)) ** FALL
    return point + complex((weights * (by.there - by.here)).sum() / weights.sum())


def growth_point_inside(
    hole: ComplexArray, exterior: MatchedPoints, siblings: Sequence[MatchedPoints] = ()
) -> complex:
    """Return the point there from which a hole grows without leaving its exterior or meeting its siblings.

    The first choice has the mean value coordinates of the hole's centroid. If that will not do, the nearest point of a
    grid that will is taken, or else the best. Siblings are other holes of the exterior.
    """
    watched = thin(hole, WATCHED)
    best, most = 0j, -1.0
    for point in islice(_candidates(hole, exterior), TRIES):
        share = _share_inside(watched, point, exterior, siblings)
        if share > most:
            best, most = point, share
        if most == 1.0:
            break
    return best


def _candidates(hole: ComplexArray, exterior: MatchedPoints) -> Iterator[complex]:
    first = complex(mean_value_weights(centroid(hole), exterior.here) @ exterior.there)
    yield first
    grid = Box.around(exterior.there).grid(GRID)
    inside = grid[winding_numbers(grid, exterior.there) != 0]
    yield from inside[np.argsort(np.abs(inside - first), kind="stable")].tolist()


def _share_inside(
    watched: ComplexArray, point: complex, exterior: MatchedPoints, siblings: Sequence[MatchedPoints]
) -> float:
    """Return the share of times and vertices of a hole growing from `point` that are inside and in no other hole."""
    count = 0
    for t in TIMES:
        growing = (1.0 - t) * point + t * watched
        inside = winding_numbers(growing, (1.0 - t) * exterior.there + t * exterior.here) != 0
        for other in siblings:
            inside &= winding_numbers(growing, (1.0 - t) * other.there + t * other.here) == 0
        count += int(inside.sum())
    return count / (len(TIMES) * len(watched))


def growth_points(
    loose: Sequence[PlacedContour], contours: Sequence[PlacedContour], carriers: Sequence[Carrier]
) -> dict[int, Spot]:
    """Return the points from which exteriors and lines without a partner grow, by their numbers.

    A contour inside another one without a partner grows from the same point, as a part of it. A contour whose middle
    lies in a paired contour grows from there, carried along; several that touch as one, see `_as_groups`. Others stay
    in touch: see `_points_of_contact`. Strokes on the edge of a fill without a partner go with it.
    """
    paired = {contour.number: points for contour, points in carriers}
    areas = {contour.number: contour.area for contour in contours}
    hosts = [c for c in contours if c.polygon.closed and (c.number in paired or c.role != HOLE)]
    hosts.sort(key=lambda host: areas[host.number])
    drawn = Box.union([contour.box for contour in contours])
    touching = TOUCHING * drawn.diagonal
    bounds = np.array([contour.box.bounds for contour in hosts]).reshape(-1, 4)
    spots: dict[int, Spot] = {}
    beside: dict[int, PlacedContour] = {}
    within: dict[int, int] = {}
    seen: set[int] = set()
    # The largest come first, so that each comes after the contours around it.
    for contour in sorted(loose, key=lambda contour: (-areas[contour.number], contour.number)):
        middle = _middle(contour)
        left, top, right, bottom = bounds.T
        inside = (
            (left <= middle.real) & (middle.real <= right) & (top <= middle.imag) & (middle.imag <= bottom)
        )
        for host in map(hosts.__getitem__, np.flatnonzero(inside)):
            points = paired.get(host.number)
            if points is None:
                if host.number in seen and _lies_in(contour, host, touching):
                    within[contour.number] = host.number
                    break
            elif (
                areas[host.number] > LEAST_HOST * areas[contour.number]
                and winding_numbers(np.array([middle]), host.polygon.vertices).any()
            ):
                spots[contour.number] = Spot(carried(middle, points, inside=True))
                break
        else:
            beside[contour.number] = contour
        seen.add(contour.number)
    inner = [contour for contour in loose if contour.number in spots]
    spots |= _as_groups(inner, spots, drawn, touching)
    spots |= _points_of_contact(list(beside.values()), inner, spots, carriers, touching)
    for number, host_number in within.items():
        spots[number] = spots[host_number]
    fills = {contour.number: contour for contour in loose}
    for number, host_number in riders(loose, fills.keys()).items():
        spots[number] = _going_with(fills[host_number], spots[host_number])
    return spots


def _going_with(contour: PlacedContour, spot: Spot) -> Spot:
    """Return the spot of what goes with a contour, whose own one is given."""
    return Spot(spot.point, spot.root or Root(complex(contour.contour.segments[:, 0].mean()), contour.number))


def _as_groups(
    contours: Sequence[PlacedContour], spots: Mapping[int, Spot], drawn: Box, touching: float
) -> dict[int, Spot]:
    """Return the spots of contours that touch a larger one, themselves or by others, and go with that, as one group.

    A bow on a violin would come apart. Groups that are much of what is drawn do come apart.
    """
    found: dict[int, Spot] = {}
    for first, *others in _groups(contours, touching):
        group = [first, *others]
        box = Box.union([contour.box for contour in group])
        is_small = sum(contour.area for contour in group) <= MOST_OF_GROUP * drawn.area
        if is_small and box.larger_side <= WIDEST_GROUP * drawn.larger_side:
            found |= {other.number: _going_with(first, spots[first.number]) for other in others}
    return found


def _groups(contours: Sequence[PlacedContour], touching: float) -> Iterator[list[PlacedContour]]:
    """Yield the contours that touch each other, themselves or by others, with the largest first."""
    from shapeblend_cli.anatomy.structure import along

    left = sorted(contours, key=lambda contour: (-contour.box.larger_side, contour.number))
    samples = [along(contour.polygon, CONTACTS) for contour in left]
    neighbours = _near(left, left, touching)

    def touch(j: int, k: int) -> bool:
        return any(len(_contacts(samples[m], left[n], touching)) for m, n in ((j, k), (k, j)))

    free = set(range(len(left)))
    while free:
        group = [min(free)]
        free.remove(group[0])
        for k in group:  # which grows meanwhile
            more = [m for m in neighbours[k] if m in free and touch(k, m)]
            group += more
            free.difference_update(more)
        yield [left[k] for k in group]


def _points_of_contact(
    beside: Sequence[PlacedContour],
    inner: Sequence[PlacedContour],
    known: Mapping[int, Spot],
    carriers: Sequence[Carrier],
    touching: float,
) -> dict[int, Spot]:
    """Return the points from which contours without a partner grow that lie in no other, by their numbers.

    The spots of `inner` ones are known.

    A contour that touches paired ones grows from the middle of the places where it does, carried along by the one that
    it touches most, and so stays in touch. A contour that touches such a contour grows with it, from the same point,
    and so on. A closed one beside a paired one of its paint grows out of that, as a plume on a helmet. All others grow
    from their middle.
    """
    from shapeblend_cli.anatomy.structure import along

    outer = [carrier for carrier in carriers if carrier.contour.role != HOLE]
    sides = [carrier.contour for carrier in outer]
    samples = [along(contour.polygon, CONTACTS) for contour in beside]
    spots: dict[int, Spot] = {}
    for contour, points, near in zip(beside, samples, _near(beside, sides, touching), strict=True):
        found = {k: _contacts(points, sides[k], touching) for k in near}
        most = max(found, key=lambda k: len(found[k]), default=None)
        if most is not None and len(found[most]):
            middle = complex(np.concatenate(list(found.values())).mean())
            point = carried(middle, outer[most].points, inside=False)
            spots[contour.number] = Spot(point, Root(middle, contour.number))
    leaders = [contour for contour in beside if contour.number in spots] + [*inner]
    while leaders:
        leader = leaders.pop(0)
        spot = _going_with(leader, spots.get(leader.number) or known[leader.number])
        (near,) = _near([leader], beside, touching)
        for k in near:
            if beside[k].number not in spots and len(_contacts(samples[k], leader, touching)):
                spots[beside[k].number] = spot
                leaders.append(beside[k])
    rest = [k for k, contour in enumerate(beside) if contour.number not in spots]
    gap = GAP / TOUCHING * touching
    for k, near in zip(rest, _near([beside[k] for k in rest], sides, gap), strict=True):
        contour = beside[k]
        alike = [m for m in near if sides[m].style.fill == contour.style.fill]
        widest = gap if alike else min(gap, BESIDE * contour.box.larger_side)
        others = [m for m in near if not contour.box.holds(np.array([sides[m].centre]))[0]]
        hosts = [outer[m].points for m in alike or others]
        place = (
            _place_across(contour, samples[k], hosts, widest, touching) if contour.polygon.closed else None
        )
        spots[contour.number] = Spot(_middle(contour)) if place is None else place
    return spots


def _place_across(
    contour: PlacedContour,
    points: ComplexArray,
    hosts: Sequence[MatchedPoints],
    gap: float,
    touching: float,
) -> Spot | None:
    """Return the place of the nearest host that faces points of a contour across a gap, carried along.

    Of hosts that are equally near it is the mean. The root is the nearest of the points. None if all hosts are far.
    """
    apart = [np.abs(host.here[:, None] - points) for host in hosts]
    nearest = min((float(each.min()) for each in apart), default=gap)
    if nearest >= gap:
        return None
    near = [k for k, each in enumerate(apart) if each.min() <= nearest + EQUALLY_NEAR * touching]
    places = [hosts[k].there[apart[k].min(axis=1) <= nearest + touching].mean() for k in near]
    own = [points[apart[k].min(axis=0) <= nearest + touching].mean() for k in near]
    return Spot(complex(np.mean(places)), Root(complex(np.mean(own)), contour.number))


def _near(some: Sequence[PlacedContour], others: Sequence[PlacedContour], distance: float) -> list[list[int]]:
    """Return for each contour the places of others whose boxes are within a distance of its own."""
    p, q = (np.array([contour.box.bounds for contour in side]).reshape(-1, 4) for side in (some, others))
    apart = np.maximum(q[:, :2] - p[:, None, 2:], p[:, None, :2] - q[:, 2:]).max(axis=2)
    return [np.flatnonzero(row <= distance).tolist() for row in apart]


def _contacts(points: ComplexArray, other: PlacedContour, touching: float) -> ComplexArray:
    """Return the points of a contour that lie in another one, or within a distance of it."""
    near = are_near(points, other.polygon.line, touching)
    if other.polygon.closed and other.style.fill is not None:
        near |= winding_numbers(points, other.polygon.vertices) != 0
    return points[near]


def _lies_in(contour: PlacedContour, host: PlacedContour, distance: float) -> bool:
    """Return whether nearly all of a contour lies in another one, or within a distance of it."""
    points = thin(contour.polygon.vertices, WATCHED)
    inside = winding_numbers(points, host.polygon.vertices) != 0
    near = are_near(points, host.polygon.line, distance)
    return float((inside | near).mean()) >= NEARLY_ALL


def _middle(contour: PlacedContour) -> complex:
    """Return the centroid of a closed contour, or the mean of a line's points."""
    vertices = contour.polygon.vertices
    if contour.polygon.closed:
        return centroid(vertices)
    lengths = np.abs(np.diff(vertices))
    return complex((lengths * (vertices[1:] + vertices[:-1])).sum() / (2.0 * lengths.sum()))
