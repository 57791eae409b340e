"""The lines of one drawing that become those of several others: the same paths in every pair.

Each pair cuts lines where it needs to. A line of the first drawing is cut wherever some pair cuts it, and its pieces
are paths of their own.
"""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.geometry.polygons import polyline_contour
from shapeblend_cli.geometry.polyline import cumulative_lengths, points_at
from shapeblend_cli.model import Polygon
from shapeblend_cli.pens.line import length, lengths_along

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from shapeblend_cli.model import ComplexArray, CubicPath, FloatArray, Pair, ShapeBlend
    from shapeblend_cli.pens.line import PenLine

    Stretch = tuple[tuple[float, float], list["Track"]]

OVERLAP = 0.1
"""Overlap of neighbouring pieces, in widths, so that no hair of the ground is seen between them."""

SAME = 1e-9
"""Maximum difference of lengths that are one, in units of the drawing."""


class Track(NamedTuple):
    """What a stretch of a line becomes: the points that lengths along it, which never fall, go to."""

    lengths: FloatArray
    points: ComplexArray
    shape: ShapeBlend

    @property
    def span(self) -> float:
        """How long the stretch is."""
        return float(self.lengths[-1] - self.lengths[0])

    def distance(self, place: float) -> float:
        """Return how far a place is from the stretch."""
        return max(float(self.lengths[0]) - place, place - float(self.lengths[-1]), 0.0)

    def holds(self, place: float) -> bool:
        """Return whether a place is in the stretch."""
        return self.distance(place) == 0.0

    def at(self, place: float) -> complex:
        """Return where a place along the line goes to, beyond the stretch to its end."""
        return complex(points_at(np.array([place]), self.points, self.lengths)[0])

    def within(self, low: float, high: float, stops: Iterable[float] = ()) -> Track:
        """Return the part of a track between two lengths, or on beyond its ends, with vertices at stops."""
        # What is drawn on at an end of the line has no length along it, and may be before it by a rounding error.
        inside = (self.lengths >= low - SAME) & (self.lengths <= high + SAME)
        known = self.lengths[inside].clip(low, high)
        new = [
            stop
            for stop in {low, high, *stops}
            if low <= stop <= high and not (np.abs(known - stop) < SAME).any()
        ]
        lengths = np.concatenate([known, new])
        points = np.concatenate([self.points[inside], [self.at(stop) for stop in new]])
        order = np.argsort(lengths, kind="stable")
        return self._replace(lengths=lengths[order], points=points[order])


def with_common_lines(
    pairs: Sequence[Pair], lines: Sequence[PenLine], scale: float, number: int
) -> list[Pair] | None:
    """Give all pairs of one drawing with others the same paths for its lines; None if that cannot be.

    Parameters
    ----------
    pairs : sequence of Pair
        Their lines move straight.
    lines : sequence of PenLine
        Those of the first drawing.
    scale : float
        Units of lines per unit of the drawing.
    number : int
        The first number for contours that is free.
    """
    shapes: list[list[ShapeBlend]] = [[s for s in pair.shapes if not _is_line(s)] for pair in pairs]
    if all(len(own) == len(pair.shapes) for own, pair in zip(shapes, pairs, strict=True)):
        return [*pairs]
    if any(line.style.stroke_opacity < 1.0 or line.style.stroke_dasharray for line in lines):
        return None  # pieces would show where they overlap, or break dashes
    for line in lines:
        every = [_tracks(line, pair, scale) for pair in pairs]
        if not all(every):
            return None
        opened = [own[0] for own in every if not own[0].shape.contours[0].start.closed]
        whole, overlap = line.length / scale, OVERLAP * line.width / scale
        # A piece may begin before the beginning of its line.
        seam = float(opened[0].lengths[0]) % whole if line.closed and opened else 0.0
        if line.closed:
            every = [_from_seam(own, seam, whole, overlap) for own in every]
        outline = (line.part(seam * scale, seam * scale) if seam else line.outline) / scale
        stretches = _stretches(every, length(outline), overlap)
        for ends, tracks in stretches:
            for own, track in zip(shapes, tracks, strict=True):
                own.append(_shape(track, ends, outline, number, closed=line.closed and not opened))
            number += 1
    others = len(pairs) > 1
    for own, pair in zip(shapes, pairs, strict=True):
        new = [s for s in pair.shapes if _is_line(s) and s.contours[0].lines[0] is None]
        # A dot that is hidden in the first drawing may not be so in the others.
        own += [s._replace(style_a=s.style_a._replace(stroke_width=0.0)) if others else s for s in new]
    return [pair._replace(shapes=tuple(own)) for pair, own in zip(pairs, shapes, strict=True)]


def _stretches(every: Sequence[Sequence[Track]], whole: float, overlap: float) -> list[Stretch]:
    """Cut a line wherever some pair cuts it; return the ends of each stretch, and the track that has it in each pair.

    Neighbours overlap a little. Where a pair has a stretch twice, there is another one on top of it.
    """
    layers = [_layers(own) for own in every]
    found = []
    for layer in range(max(map(len, layers))):
        tracks = [own[min(layer, len(own) - 1)] for own in layers]
        new = [track for own in layers if len(own) > layer for track in own[layer]]
        stops = {float(end) for track in new for end in track.lengths[[0, -1]]}
        knots = [0.0]
        for stop in sorted(stops):
            if knots[-1] + overlap < stop < whole - overlap:
                knots.append(stop)
        for low, high in pairwise([*knots, whole]):
            middle = (low + high) / 2.0
            if layer and not any(track.holds(middle) for track in new):
                continue
            ends = max(low - overlap, 0.0), min(high + overlap, whole)
            found.append((ends, [min(own, key=lambda track: track.distance(middle)) for own in tracks]))

    return found


def _layers(tracks: Sequence[Track]) -> list[list[Track]]:
    """Return tracks in layers that do not overlap, the longest tracks in the first."""
    layers: list[list[Track]] = []
    for each in tracks:
        middle = float(each.lengths[[0, -1]].mean())
        for layer in layers:
            if not any(other.holds(middle) for other in layer):
                layer.append(each)
                break
        else:
            layers.append([each])
    return layers


def _is_line(shape: ShapeBlend) -> bool:
    return any(shape.contours[0].lines)


def _polyline(path: CubicPath) -> ComplexArray:
    return np.append(path.segments[:, 0], path.segments[-1, 3])


def _tracks(line: PenLine, pair: Pair, scale: float) -> list[Track]:
    """Return what the pieces of a line become in a pair, the longest first."""
    found = []
    for shape in pair.shapes:
        (contour,) = shape.contours if _is_line(shape) else (None,)
        if contour is None or contour.lines[0] is None or contour.lines[0].name != line.name:
            continue
        lengths = lengths_along(line, _polyline(contour.start) * scale)
        if lengths is None:  # it is a piece of another line of this name
            continue
        way = -1 if lengths[-1] < lengths[0] else 1
        found.append(Track(lengths[::way] / scale, _polyline(contour.end)[::way], shape))
    return sorted(found, key=lambda track: -track.span)


def _from_seam(tracks: Sequence[Track], seam: float, whole: float, overlap: float) -> list[Track]:
    """Return tracks along a closed line that is cut at its seam, those that cross it as two.

    Those that begin a little before it, or end a little after it, are not cut.
    """
    found = []
    for track in tracks:
        low = float(track.lengths[0] - seam) % whole
        low = 0.0 if whole - low < overlap else low
        moved = track._replace(lengths=track.lengths - track.lengths[0] + low)
        high = float(moved.lengths[-1])
        if high <= whole + overlap:
            found.append(moved._replace(lengths=moved.lengths.clip(max=whole)))
            continue
        before, after = moved.within(low, whole), moved.within(whole, high)
        after = after._replace(lengths=after.lengths - whole)
        if track.shape.contours[0].start.closed:  # whole again, from its seam
            both = zip(after[:2], before[:2], strict=True)
            lengths, points = (np.concatenate(each) for each in both)
            found.append(Track(lengths, points, track.shape))
        else:
            found += [before, after]
    return sorted(found, key=lambda track: -track.span)


def _shape(
    track: Track, ends: tuple[float, float], outline: ComplexArray, number: int, *, closed: bool
) -> ShapeBlend:
    """Return the shape of a track: from the outline of its line, or a part of that, to its points."""
    low, high = ends
    along = cumulative_lengths(outline)
    is_long = length(track.points) > 0.0
    track = track.within(low, high, along.tolist())
    inner = (along > low + 1e-9) & (along < high - 1e-9)
    first, last = points_at(np.array([low, high]), outline, along)
    vertices = np.array([first, *outline[inner], last])
    knots = np.concatenate([[low], along[inner], [high]])
    cuts = np.interp(track.lengths.clip(low, high), knots, np.arange(len(knots), dtype=float))
    paths = [
        polyline_contour(points[:-1] if closed else points, closed)
        for points in (vertices, points_at(track.lengths, vertices, knots), track.points)
    ]
    count = len(vertices) - 1
    polygon = Polygon(
        vertices[:-1] if closed else vertices,
        np.arange(count + (not closed)).clip(max=count - 1),
        np.append(np.zeros(count), [] if closed else [1.0]),
        closed,
    )
    (contour,) = track.shape.contours
    if paths[2].is_point and is_long:  # at the end of its line, and no dot
        contour = contour._replace(lines=(contour.lines[0], None))
    contour = contour._replace(
        a=number,
        b=None,
        contour_a=paths[0],
        polygon_a=polygon,
        start=paths[1],
        end=paths[2],
        cuts=(cuts, cuts),
    )
    return track.shape._replace(contours=(contour,))
