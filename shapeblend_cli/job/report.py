"""The JSON report of a run, what is measured for it, and what `inspect` lists of a drawing."""

from __future__ import annotations

from itertools import accumulate
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from shapeblend_cli.anatomy.pieces import with_areas
from shapeblend_cli.geometry import cubics
from shapeblend_cli.geometry.crossings import path_crossings
from shapeblend_cli.interpolate.paths import paths_at
from shapeblend_cli.model import Box, ContourBlend, Drawing, Pair, Shape, ShapeBlend
from shapeblend_cli.pens.drawings import file_lines

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.grading.grade import Grade
    from shapeblend_cli.model import ComplexArray

REPORT_FORMAT = 1


class Measures(NamedTuple):
    """What is measured of an in-between at time t, within [0, 1]."""

    t: float
    pair: int  # the number of its first drawing
    self_crossings: (
        int  # how often outlines painted together cross themselves and each other, on their curves
    )
    area: float  # inside the outlines, in square units of A


def measure(pair: Pair, t: float) -> Measures:
    """Measure the in-between at time t; also at both ends as it moves, not as the drawing has it."""
    shapes = [paths_at(shape, t) for shape in pair.each_shape]
    return Measures(
        t,
        pair.a,
        self_crossings=sum(path_crossings(paths) for paths in shapes),
        area=sum(abs(sum(cubics.signed_area(path.segments) for path in paths)) for paths in shapes),
    )


def report(
    version: str,
    inputs: Sequence[str],
    settings: dict[str, Any],
    pairs: Sequence[Pair],
    grades: Sequence[Grade],
    measures: Sequence[Measures],
    files: Sequence[str | None],
    seconds: dict[str, float],
) -> dict[str, Any]:
    """Return everything about a run, ready for JSON.

    Inputs are as the user named them, settings every option's value in force, and seconds those of each stage. Each
    pair has its grade, and each frame has its measures, and a file or None.
    """
    return {
        "report": REPORT_FORMAT,
        "version": version,
        "inputs": list(inputs),
        "settings": settings,
        "pairs": [
            {
                "a": pair.a,
                "b": pair.b,
                "inside_a": _parents(pair, 0),
                "inside_b": _parents(pair, 1),
                "grade": grade.as_json(),
                "contours": [
                    _contour(contour, shape) for shape in pair.each_shape for contour in shape.contours
                ],
            }
            for pair, grade in zip(pairs, grades, strict=True)
        ],
        "frames": [
            {"t": m.t, "pair": m.pair, "file": file, "self_crossings": m.self_crossings, "area": m.area}
            for m, file in zip(measures, files, strict=True)
        ],
        "seconds": seconds,
    }


def _parents(pair: Pair, side: int) -> dict[str, int]:
    """Return what each contour of A, 0, or B, 1, lies in, by numbers; those that lie in nothing are left out."""
    parents = {contour.numbers[side]: contour.parents[side] for contour in pair.contours}
    return {str(number): parent for number, parent in sorted(parents.items(), key=str) if parent is not None}


def _contour(contour: ContourBlend, shape: ShapeBlend) -> dict[str, Any]:
    correspondence = contour.correspondence
    return {
        "a": contour.a,
        "b": contour.b,
        "closed": correspondence.closed,
        "vertices_a": _points(contour.polygon_a.vertices),
        "vertices_b": _points(contour.polygon_b.vertices),
        "scale_a": contour.scale_a,
        "scale_b": contour.scale_b,
        "dots": correspondence.dots.tolist(),
        "start": correspondence.dots[0].tolist(),
        "work": correspondence.work,
        **correspondence.terms._asdict(),
        "lower_bound": correspondence.lower_bound,
        "gap": correspondence.gap,
        "diagonal_deviation": correspondence.diagonal_deviation,
        "zero_angles": correspondence.zero_angles,
        "sweeps": correspondence.sweeps,
        "seconds": contour.seconds,
        "turned_back": float(np.degrees(contour.rotation)),
        "motion": shape.motion_name,
        "motion_because": shape.reason,
        "candidates": [
            {"name": one.name, "wrong": one.wrong, "terms": dict(one.terms)} for one in shape.candidates
        ],
        "pair_because": contour.reason,
        "lines": [part and part._asdict() for part in contour.lines],
    }


def _points(vertices: ComplexArray) -> list[list[float]]:
    return [[z.real, z.imag] for z in vertices.tolist()]


def inspection(drawing: Drawing) -> dict[str, Any]:
    """Return the shapes of a drawing, ready for JSON; lengths and boxes ignore the width of strokes."""
    blended = with_areas(drawing).shapes
    lines: dict[int, list[dict[str, Any]]] = {}
    for line in file_lines(drawing._replace(shapes=blended)):
        found = {
            "name": line.name,
            "width": line.style.stroke_width,
            "closed": line.closed,
            "cap": line.style.stroke_linecap,
        }
        lines.setdefault(blended[line.shape].index, []).append(found)
    counts = dict.fromkeys((shape.index for shape in drawing.shapes), 0)
    for shape in blended:
        counts[shape.index] += len(shape.contours)
    firsts = accumulate(counts.values(), initial=0)
    return {
        "file": drawing.file,
        "viewbox": list(drawing.viewbox) if drawing.viewbox else None,
        "shapes": [
            _shape(shape)
            | {
                "first_contour": first,
                "blended": counts[shape.index],
                "pen_lines": lines.get(shape.index, []),
            }
            for shape, first in zip(drawing.shapes, firsts, strict=False)
        ],
    }


_SLICE = 2048
"""Curved segments measured at once; each takes 4 kB."""


def _shape(shape: Shape) -> dict[str, Any]:
    segments = np.concatenate([contour.segments for contour in shape.contours])
    straight = np.concatenate([contour.straight for contour in shape.contours])
    curved, ends = segments[~straight], segments[:, ::3]
    box = Box.around(ends)
    length = np.abs(ends[straight, 1] - ends[straight, 0]).sum()
    if len(curved):
        box = Box.union([box, cubics.bounds(curved)])
        slices = (curved[k : k + _SLICE] for k in range(0, len(curved), _SLICE))
        length += sum(cubics.lengths(part).sum() for part in slices)
    return {
        "index": shape.index,
        "id": shape.id,
        "element": shape.element,
        "contours": len(shape.contours),
        "closed": all(contour.closed for contour in shape.contours),
        "length": float(length),
        "bbox": [float(v) for v in box.bounds],
        "fill": shape.style.fill,
        "stroke": shape.style.stroke,
        "fill_rule": shape.style.fill_rule,
    }
