"""Objects of a document of Inkscape that are blended: in-betweens in the document, or an animation of their own."""

from __future__ import annotations

import re
import tempfile
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.errors import InputError, unreadable
from shapeblend_cli.frames.frames import make_frames
from shapeblend_cli.geometry import cubics
from shapeblend_cli.inkscape.source import Document
from shapeblend_cli.model import Box, CubicPath, Drawing, Frame, Name, Page, PaintedShape, Pair
from shapeblend_cli.outputs.formats import views
from shapeblend_cli.paint.page_colour import with_page_colour
from shapeblend_cli.pipeline import match_all
from shapeblend_cli.svg.reading.read import read
from shapeblend_cli.svg.writing.document import frame_svg, frames_in_groups
from shapeblend_cli.svg.writing.ids import Ids
from shapeblend_cli.svg.writing.rounding import decimals_for
from shapeblend_cli.system.write import check_targets, write_files

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from shapeblend_cli.model import ComplexArray, Shape
    from shapeblend_cli.options.settings import Settings
    from shapeblend_cli.outputs.formats import OutputSpec
    from shapeblend_cli.svg.xml.transforms import Affine

_PIN = re.compile(r"\s*pin\s*(\w*)\s*", re.IGNORECASE)
_PAIR = re.compile(r"\s*pair\s*(\w*)\s*", re.IGNORECASE)

MARGIN = 0.02
"""Margin around the shapes of an animation, as a share of their larger side."""

Pin = tuple[complex, complex]


class Selected(NamedTuple):
    """The objects that are blended, the lowest first, as drawings of one document, and what becomes what."""

    document: Document
    numbers: list[int]  # of the elements
    drawings: list[Drawing]
    pins: tuple[Pin, ...]  # points
    match: tuple[tuple[str, str], ...]  # ids of parts


def blend_objects(
    file: str, ids: Sequence[str], settings: Settings, *, as_layers: bool, note: Callable[[str], None]
) -> bytes:
    """Return a document of Inkscape with in-betweens of two of its objects, above the lower one.

    They begin at that, and are in a group, or each in a layer. All else in the document stays as it is.
    """
    selected = _selected(file, ids, note)
    if len(selected.numbers) != 2:
        raise InputError(
            file,
            f"{_objects(len(selected.numbers))} selected; two, or two groups, and dots for pins, would work",
        )
    pairs = _matched(selected, settings, note)
    shown, notes = with_page_colour(pairs, settings.style)
    for text in notes:
        note(text)
    frames = [_inside(frame) for frame in make_frames(shown, settings)]
    document, (lower, upper) = selected.document, selected.numbers
    around = document.ancestors(lower)
    after = lower
    if as_layers:
        # Layers are in layers alone: they come after the group that the lower object is in.
        while len(around) > 1 and not document.elements[around[-1]].is_layer:
            after = around.pop()
    names = [document.elements[number].id or "" for number in (lower, upper)]
    text = frames_in_groups(
        frames,
        decimals_for(views(pairs)),
        Ids(taken=[element.id for element in document.elements if element.id]),
        (" to ".join(names), _transform(document.matrix_in(around), file)),
        as_layers=as_layers,
    )
    return document.with_text_after(after, text)


def animate_objects(
    file: str,
    ids: Sequence[str],
    output: OutputSpec,
    *,
    force: bool,
    note: Callable[[str], None],
) -> bytes:
    """Write an animation that goes from object to object, from the lowest up, and return the document as it is."""
    selected = _selected(file, ids, note)
    if len(selected.numbers) < 2:
        raise InputError(file, f"{_objects(len(selected.numbers))} selected; two or more would work")
    output.format.check_libraries()
    check_targets([Path(name) for name in output.files()], [Path(file)], force)
    drawings, _ = _in_one_view(selected)
    pairs = _matched(selected._replace(drawings=drawings), output.settings, note)
    rendered = output.format.render(output, pairs)
    for text in rendered.notes:
        note(text)
    write_files(output.by_target(rendered), force)
    return selected.document.data


def open_objects(file: str, ids: Sequence[str], note: Callable[[str], None]) -> tuple[list[str], bytes]:
    """Write objects as drawings into a folder of their own, for the studio.

    Returns
    -------
    words : list of str
        The names of the drawings, and the options that say what becomes what.
    document : bytes
        The document as it is.
    """
    selected = _selected(file, ids, note)
    if len(selected.numbers) < 2:
        raise InputError(file, f"{_objects(len(selected.numbers))} selected; two or more would work")
    folder = Path(tempfile.mkdtemp(prefix="shapeblend-"))
    names = []
    drawings, shown = _in_one_view(selected)
    for k, drawing in enumerate(drawings):
        frame = Frame(0.0, 0, tuple(map(_painted_shape, drawing.shapes)), shown)
        called = selected.document.elements[selected.numbers[k]].id or ""
        name = f"{k + 1}-{re.sub(r'[^A-Za-z0-9-]', '-', called)}.svg"
        (folder / name).write_text(frame_svg(frame, decimals_for([frame.view])), encoding="utf-8")
        names.append(str(folder / name))
    pins = [f"{p.real:g},{p.imag:g}:{q.real:g},{q.imag:g}" for p, q in selected.pins]
    words = [*names, *(word for pin in pins for word in ("--pin", pin))]
    return [
        *words,
        *(word for a, b in selected.match for word in ("--match", f"{a}={b}")),
    ], selected.document.data


def _in_one_view(selected: Selected) -> tuple[list[Drawing], Box]:
    """Return objects as drawings that show the box around them all, and this."""
    every = [shape for drawing in selected.drawings for shape in drawing.shapes]
    shown = Box.union([_painted(shape) for shape in every])
    shown = shown.expanded(MARGIN * shown.larger_side)
    return [drawing._replace(viewbox=shown, page=Page()) for drawing in selected.drawings], shown


def _selected(file: str, ids: Sequence[str], note: Callable[[str], None]) -> Selected:
    try:
        data = Path(file).read_bytes()
    except OSError as error:
        raise unreadable(file, error, "SVG file") from None
    every = read(file, data)
    pins = [shape for shape in every.shapes if shape.name.label and _PIN.fullmatch(shape.name.label)]
    document = Document.of(data)
    numbers = []
    for name in dict.fromkeys(ids):
        number = document.number_of(name)
        if number is None:
            raise InputError(file, f"no object has the id {name}; one that is in the document would work")
        if not any(name in (shape.id, *(group.name.id for group in shape.groups)) for shape in pins):
            numbers.append(number)
    numbers.sort()
    for lower, upper in pairwise(numbers):
        if lower in document.ancestors(upper):
            inner, outer = (document.elements[number].id for number in (upper, lower))
            raise InputError(file, f"{inner} is in {outer}; objects beside each other would work")
    drawings = []
    for number in numbers:
        # The groups that the object itself is in are those of the document.
        depth = len(document.ancestors(number)) - 1
        drawing = read(file, data, select=f"#{document.elements[number].id}", is_to_blend=True)
        shapes = tuple(_without(shape, depth) for shape in drawing.shapes)
        drawings.append(drawing._replace(shapes=shapes, page=Page()))
    for text in every.notes:
        note(text)
    if len(drawings) != 2:
        return Selected(document, numbers, drawings, (), ())
    return Selected(document, numbers, drawings, _pins(pins, drawings, file), _pairs(drawings, file))


def _without(shape: Shape, depth: int) -> Shape:
    from dataclasses import replace

    return replace(shape, groups=shape.groups[depth:])


def _matched(selected: Selected, settings: Settings, note: Callable[[str], None]) -> list[Pair]:
    settings = settings.replace(
        place="asis", pins=(*settings.pins, *selected.pins), match=(*settings.match, *selected.match)
    )
    pairs, notes = match_all(selected.drawings, settings)
    for text in notes:
        note(text)
    return pairs


def _pairs(drawings: Sequence[Drawing], file: str) -> tuple[tuple[str, str], ...]:
    """Return the ids of parts of two objects that have the same label."""
    marked: dict[str, tuple[list[str], list[str]]] = {}
    for side, drawing in enumerate(drawings):
        for shape in drawing.shapes:
            match = _PAIR.fullmatch(shape.name.label or "")
            if match and shape.id is not None:
                marked.setdefault(match[1], ([], []))[side].append(shape.id)
    for label, (first, second) in marked.items():
        if not (len(first) == len(second) == 1):
            raise InputError(
                file,
                f"'pair {label}' marks {_parts(first)} of the lower object and {_parts(second)} of the upper one; "
                "one of each with that label would work",
            )
    return tuple((first[0], second[0]) for first, second in marked.values())


def _parts(ids: Sequence[str]) -> str:
    return "one part" if len(ids) == 1 else f"{len(ids) or 'no'} parts"


def _pins(shapes: Sequence[Shape], drawings: Sequence[Drawing], file: str) -> tuple[Pin, ...]:
    """Return the points that shapes mark: two dots of one label, or the ends of a line."""
    marked: dict[str, list[complex]] = {}
    for shape in shapes:
        match = _PIN.fullmatch(shape.name.label or "")
        assert match is not None, "it is a pin"
        segments = shape.contours[0].segments
        ends = [complex(segments[0, 0]), complex(segments[-1, 3])]
        is_line = not shape.contours[0].closed
        marked.setdefault(match[1], []).extend(ends if is_line else [cubics.bounds(segments).centre])
    outlines = [_points(drawing) for drawing in drawings]
    pins = []
    for label, points in marked.items():
        if len(points) != 2:
            raise InputError(
                file,
                f"'pin {label}' marks {len(points)} points; two dots or one line with that label would work",
            )
        ways = [(p, q) for p, q in (points, points[::-1])]
        pins.append(min(ways, key=lambda way: sum(_away(p, o) for p, o in zip(way, outlines, strict=True))))
    return tuple(pins)


def _points(drawing: Drawing) -> ComplexArray:
    t = np.arange(8) / 8
    return np.concatenate(
        [
            cubics.evaluate(contour.segments[:, None, :], t).ravel()
            for shape in drawing.shapes
            for contour in shape.contours
        ]
    )


def _away(point: complex, outline: ComplexArray) -> float:
    return float(np.abs(outline - point).min())


def _painted_shape(shape: Shape) -> PaintedShape:
    paths = tuple(CubicPath(path.segments, path.straight, path.closed) for path in shape.contours)
    return PaintedShape(paths, shape.style, name=shape.name, groups=shape.groups, clips=shape.clips)


def _painted(shape: Shape) -> Box:
    reach = shape.style.stroke_width / 2.0 if shape.style.stroke else 0.0
    return Box.union([cubics.bounds(contour.segments).expanded(reach) for contour in shape.contours])


def _inside(frame: Frame) -> Frame:
    """Return a frame whose shapes have their ids as labels, as the objects in the document have them as ids."""
    return frame._replace(
        shapes=tuple(
            shape._replace(name=Name(None, shape.name.label or shape.name.id, *shape.name[2:]))
            for shape in frame.shapes
        )
    )


def _transform(matrix: Affine, file: str) -> str:
    """Return the map from the root's coordinates into elements as an attribute; empty for the identity."""
    if abs(matrix.determinant) < 1e-12:
        raise InputError(file, "the lower object is in a group without extent; another one would work")
    a, b, c, d, e, f = matrix
    size = matrix.determinant
    inverse = (d / size, -b / size, -c / size, a / size, (c * f - d * e) / size, (b * e - a * f) / size)
    if inverse == (1.0, 0.0, 0.0, 1.0, 0.0, 0.0):
        return ""
    return f"matrix({' '.join(f'{entry + 0.0:.12g}' for entry in inverse)})"


def _objects(count: int) -> str:
    return "one object is" if count == 1 else f"{count or 'no'} objects are"
