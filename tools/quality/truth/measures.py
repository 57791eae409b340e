"""How near a blend is to the truth: in its in-betweens, in what goes where, and in its corners."""

from __future__ import annotations

import functools
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
import shapely

from shapeblend_cli.geometry.polyline import cumulative_lengths, from_end_to_end
from shapeblend_cli.model import Box
from tools.quality.scores import inside, is_crossed
from tools.quality.truth.form import TIMES

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapely.geometry.base import BaseGeometry

    from tools.quality.scores import Frame
    from tools.quality.truth.form import Linked, Truth

WRONG = 0.5
"""What a contour counts that goes to another one than it should. A random start gives half of that."""

GROSS, OPEN_GROSS = 0.05, 0.1
"""A correspondence that is off by more than this has missed the shape somewhere; of open lines, where nothing goes
round, by more than the second."""

PLACES, OPEN_PLACES = 720, 201
"""Places of a contour at which the correspondence is compared, and places of an open line at which distances are."""

SHARP, STILL_SHARP = 30.0, 20.0
"""Degrees by which an outline turns at a corner at both ends, and in between."""

NEAR, REACH = 0.01, 0.005
"""Shares of the size: how near a corner is to its true place, and how far around a vertex the outline counts."""


class Nearness(NamedTuple):
    """One blend beside the truth.

    Attributes
    ----------
    corr : float
        How far along B's contours points of A's arrive from where they should, mean, as a share of the contour.
    strict : float or None
        1 - what two regions share of what they cover, mean over `TIMES`; None of open lines.
    dist : float or None
        How far in-betweens of an open line are from the true ones, mean, as a share of the size; None of regions.
    crossed : bool
        Whether a contour of an in-between crosses or touches itself.
    corners : float or None
        The share of true corners that the middle one has; None if there are none.
    segments : int
        With how many the middle one is written.
    """

    corr: float
    strict: float | None = None
    dist: float | None = None
    crossed: bool = False
    corners: float | None = None
    segments: int = 0

    @property
    def gross(self) -> bool:
        """Whether the correspondence has missed the shape somewhere."""
        return self.corr > (OPEN_GROSS if self.strict is None else GROSS)


NO_ANSWER = Nearness(WRONG, strict=1.0, crossed=True, corners=0.0)
NO_LINE = Nearness(WRONG, dist=1.0)


def nearness(truth: Truth, found: Linked | None) -> Nearness:
    """Judge a blend; one that is none is as far off as can be."""
    if truth.open:
        return open_nearness(truth, found)
    if found is None:
        return NO_ANSWER
    return Nearness(
        corr(truth, found.links),
        strict=strict(truth, found.frames),
        crossed=any(is_crossed(contour) for frame in found.frames for contour in frame),
        corners=corners(truth, found.frames[TIMES.index(0.5)]),
        segments=found.segments,
    )


def strict(truth: Truth, frames: Sequence[Frame]) -> float:
    """How little in-betweens cover what they should, mean over the times."""
    each = zip(TIMES, frames, strict=True)
    return float(np.mean([apart(truth.laid_back(frame, t), truth.at(t)) for t, frame in each]))


def apart(p: Frame, q: Frame) -> float:
    """How much of the area that either covers is not covered by both."""
    return regions_apart(region(p), region(q))


def regions_apart(p: BaseGeometry, q: BaseGeometry) -> float:
    both = p.intersection(q).area
    either = p.area + q.area - both
    return 1.0 - both / either if either else 1.0


def region(frame: Frame) -> BaseGeometry:
    """What a frame fills by the even-odd rule."""
    insides = (inside(contour) for contour in frame)
    return functools.reduce(shapely.symmetric_difference, insides, shapely.Polygon())


def corr(truth: Truth, links: Sequence[tuple[np.ndarray, np.ndarray]]) -> float:
    """The mean error of a correspondence, contours weighted by their length in A."""
    true = truth.true_links()
    errors: list[list[float]] = [[] for _ in true]
    for p, q in links:
        here, there = _nearest(p, [a for a, _ in true]), _nearest(q, [b for _, b in true])
        errors[here].append(_error(p, q, true[here], truth.along[here]) if here == there else WRONG)
    means = [np.mean(found) if found else WRONG for found in errors]
    return float(np.average(means, weights=[ring(a).length for a, _ in true]))


def _nearest(points: np.ndarray, contours: Sequence[np.ndarray]) -> int:
    """The contour that points lie on."""
    places = shapely.points(points.real, points.imag)
    return int(np.argmin([shapely.distance(ring(contour), places).mean() for contour in contours]))


def _error(p: np.ndarray, q: np.ndarray, true: tuple[np.ndarray, np.ndarray], along: np.ndarray) -> float:
    """How far along b the points of a arrive from where they should, when p goes to q; as a share of b."""
    u, v = (_along(points, *known) for points, *known in zip((p, q), true, along, strict=True))
    true_u, true_v = map(_once_round, along)
    places = (np.arange(PLACES) + 0.5) / PLACES
    off = _arrival(u, v, places) - _arrival(true_u, true_v, places)
    return float(np.abs(off - np.round(off)).mean())


def _along(points: np.ndarray, contour: np.ndarray, shares: np.ndarray) -> np.ndarray:
    """How far round a contour the places nearest to points are, once round being 1; the first again at the end."""
    located = shapely.line_locate_point(
        ring(contour), shapely.points(points.real, points.imag), normalized=True
    )
    found = np.interp(located, reached(contour), _once_round(shares))
    return np.unwrap(np.append(found, found[0]), period=1.0)


def _once_round(shares: np.ndarray) -> np.ndarray:
    """How far round vertices are, and the first of them again at the end."""
    return np.append(shares, shares[0] + np.sign(shares[-1] - shares[0]))


def reached(contour: np.ndarray) -> np.ndarray:
    """How far round a contour its own vertices are."""
    lengths = np.abs(np.diff(contour, append=contour[0]))
    return np.append(0.0, np.cumsum(lengths)) / lengths.sum()


def _arrival(u: np.ndarray, v: np.ndarray, places: np.ndarray) -> np.ndarray:
    """Where places go when each u goes to its v and what lies between goes evenly."""
    if u[-1] < u[0]:
        u, v = u[::-1], v[::-1]
    u = np.maximum.accumulate(u)
    return np.interp(u[0] + (places - u[0]) % 1.0, u, v)


def ring(contour: np.ndarray) -> shapely.LineString:
    return line(np.append(contour, contour[0]))


def line(points: np.ndarray) -> shapely.LineString:
    return shapely.LineString(np.column_stack([points.real, points.imag]))


def corners(truth: Truth, middle: Frame) -> float | None:
    """The share of the true corners that an in-between half way has near their true places."""
    true = truth.at(0.5)
    size = extent(true)
    reach = REACH * size
    places = np.concatenate(
        [
            m[_is_corner(p, reach) & _is_corner(q, reach) & (turns(m, reach) > STILL_SHARP)]
            for p, m, q in zip(truth.frames[0], true, truth.frames[-1], strict=True)
        ]
    )
    if not len(places):
        return None
    drawn = [_fine(contour, size) for contour in truth.laid_back(middle, 0.5)]
    sharp = [contour[turns(contour, reach) > STILL_SHARP] for contour in drawn]
    kept = np.abs(np.subtract.outer(places, np.concatenate(sharp))) <= NEAR * size
    return float(kept.any(axis=1).mean())


def _is_corner(contour: np.ndarray, reach: float) -> np.ndarray:
    """Whether the outline turns sharply at vertices, and not only in a detail too small to see."""
    return (turns(contour) > SHARP) & (turns(contour, reach) > SHARP)


def extent(frame: Frame) -> float:
    """The diagonal of the box around it."""
    return Box.around(np.concatenate(frame)).diagonal


def turns(contour: np.ndarray, reach: float = 0.0) -> np.ndarray:
    """By how many degrees a contour turns at each vertex: from the point `reach` before it to the one after it.

    Parameters
    ----------
    contour : array
    reach : float
        Way along the contour; 0 takes the vertices before and after.
    """
    before, after = np.roll(contour, 1), np.roll(contour, -1)
    if reach:
        around = from_end_to_end(contour, closed=True)
        lengths = cumulative_lengths(around)
        places = lengths[:-1]
        before, after = (np.interp((places + way) % lengths[-1], lengths, around) for way in (-reach, reach))
    return np.abs(np.degrees(np.angle((after - contour) * (contour - before).conj())))


def _fine(contour: np.ndarray, size: float) -> np.ndarray:
    """A contour without vertices that are one."""
    return contour[np.abs(contour - np.roll(contour, 1)) > 1e-9 * size]


def open_nearness(truth: Truth, found: Linked | None) -> Nearness:
    """Judge a blend of one open line; one that is none, or of several, is as far off as can be."""
    if found is None or any(len(contours) != 1 for contours in (*found.frames, found.links)):
        return NO_LINE
    size = extent([*truth.frames[0], *truth.frames[-1]])
    each = zip(TIMES, found.frames, strict=True)
    apart = [_lines_apart(truth.laid_back(frame, t)[0], truth.at(t)[0]) for t, frame in each]
    off = _open_error(truth, *found.links[0])
    return Nearness(off, dist=float(np.mean(apart)) / size, segments=found.segments)


def _lines_apart(p: np.ndarray, q: np.ndarray) -> float:
    """The mean distance of places on each line to the other."""
    lines, shares = [line(p), line(q)], np.linspace(0.0, 1.0, OPEN_PLACES)
    places = [shapely.line_interpolate_point(one, shares, normalized=True) for one in lines]
    return float(np.mean([shapely.distance(places[k], lines[1 - k]).mean() for k in (0, 1)]))


def _open_error(truth: Truth, p: np.ndarray, q: np.ndarray) -> float:
    """How far along b the points of a arrive from where they should, as a share of b."""
    (ends,) = truth.true_links()
    u, v = (
        shapely.line_locate_point(line(end), shapely.points(z.real, z.imag), normalized=True)
        for end, z in zip(ends, (p, q), strict=True)
    )
    if u[-1] < u[0]:
        u, v = u[::-1], v[::-1]
    places = (np.arange(PLACES) + 0.5) / PLACES
    ((true_u, true_v),) = truth.along
    if true_v[-1] < true_v[0]:
        true_v = 1.0 - true_v  # B's file goes the other way than the true end, along which `v` is counted
    arrived = np.interp(places, np.maximum.accumulate(u), v)
    return float(np.abs(arrived - np.interp(places, true_u, true_v)).mean())
