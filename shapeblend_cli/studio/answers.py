"""What a process of the studio does: blends to look at, other blends to choose from, and what the command would write.

All of it is a function from a project and the contents of its drawings to values for JSON.
"""

from __future__ import annotations

import gzip
import hashlib
import os
import re
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from shapeblend_cli.blending.graded import grade_of
from shapeblend_cli.blending.placing import as_drawn, place
from shapeblend_cli.errors import OptionError
from shapeblend_cli.frames.frames import end_frames, frame_at
from shapeblend_cli.frames.stagger import parts_of
from shapeblend_cli.frames.views import view_of
from shapeblend_cli.job.job import Job, all_targets, job_of
from shapeblend_cli.job.make import kept_of, make, match_drawings, read_files
from shapeblend_cli.job.targets import check_files_of, check_libraries, write
from shapeblend_cli.model import Frame
from shapeblend_cli.outputs.formats import STANDARD_OUTPUT
from shapeblend_cli.preview.pictures import (
    correspondence_lists,
    images_of,
    picture,
    rounded,
    rounded_points,
    scale_and_shift,
    still_paths,
    timing,
)
from shapeblend_cli.studio.order import Order
from shapeblend_cli.svg.reading.read import title_of
from shapeblend_cli.svg.writing.document import frame_svg
from shapeblend_cli.svg.writing.path_data import path_data
from shapeblend_cli.svg.writing.rounding import decimals_for
from shapeblend_cli.system.clock import Clock
from shapeblend_cli.system.kept import Kept

if TYPE_CHECKING:
    from shapeblend_cli.model import ContourBlend, Drawing, Pair
    from shapeblend_cli.options.settings import Settings
    from shapeblend_cli.outputs.formats import OutputSpec

KEPT = Kept(most=64, largest=1_000_000, steps=2000)
"""Drawings as they were read and flattened, and the parts of blends that a correction leaves unchanged."""

THUMBNAIL_TIMES = (0.25, 0.5, 0.75)
"""Moments of a blend in a thumbnail."""


PLAIN = re.compile(r"[\w .:-]{1,40}")
"""Ids that the page shows."""


def do(order: Order) -> Any:
    """Do an order; errors are the command's."""
    return ORDERS[order.what](order)


def _blend(order: Order) -> dict[str, Any]:
    """Return a blend to look at: the drawings, what moves, what becomes what, and what the judge says."""
    job, clock = _shown_job(order), Clock()
    notes: list[str] = []
    note = notes.append
    settings = job.output.settings
    drawings = kept_of(read_files(job.files, job.read, clock, note, order.sources, KEPT), settings, note)
    pairs = match_drawings(drawings, settings, clock, note, lambda stage, share: None, KEPT)
    ends = end_frames(pairs, settings)
    decimals = decimals_for([frame.view for frame in ends])
    maps = place(drawings, settings.place)
    worst = max((grade_of(pair) for pair in pairs), key=lambda grade: grade.number)
    return {
        "drawings": [_kept_drawing(drawing, k) for k, drawing in enumerate(drawings)],
        "pairs": [
            _pair(pair, drawings, ends, maps, decimals) | {"parts": _parts(pair, drawings, settings)}
            for pair in pairs
        ],
        "decimals": decimals,
        "timing": timing(job.output.timing, settings),
        "frames": _frames(job.output),
        "settings": {
            name: value for name, value in job.reported().items() if isinstance(value, int | float | str)
        },
        "grade": worst.as_json(),
        "notes": notes,
        "seconds": sum(clock.seconds.values()),
    }


def _frames(spec: OutputSpec) -> int:
    """Return the number of in-betweens from one drawing to the next."""
    if "fps" not in spec.format.defaults:
        return spec.settings.frames
    from shapeblend_cli.outputs.raster_animation import run_of

    return run_of(spec).steps - 1


def _pair(
    pair: Pair, drawings: Sequence[Drawing], ends: Sequence[Frame], maps: Sequence[Any], decimals: int
) -> dict[str, Any]:
    counts = [sum(len(shape.contours) for shape in drawings[k].shapes) for k in (pair.a, pair.b)]
    numbers = [
        (k, n) for k, shape in enumerate(pair.shapes) if not shape.is_twin for n in range(len(shape.contours))
    ]
    owners = [shape for shape in pair.each_shape for _ in shape.contours]
    contours, lists = [], []
    for contour, shape, (k, n) in zip(pair.contours, owners, numbers, strict=True):
        contours.append(
            {
                "a": _shown_number(contour.a, contour.parents[0], counts[0]),
                "b": _shown_number(contour.b, contour.parents[1], counts[1]),
                "closed": contour.correspondence.closed,
                "shape": k,
                "outline": n,
                "motion": shape.motion_name,
                "motion_because": shape.reason,
                "pair_because": contour.reason,
                "wrong": shape.taken.wrong if shape.taken else 0.0,
            }
        )
        lists.append(_kept_lists(contour, decimals))
    return {
        "a": pair.a,
        "b": pair.b,
        "maps": [scale_and_shift(maps[k]) for k in (pair.a, pair.b)],
        "views": [rounded(view, decimals) for view in pair.views],
        "contours": contours,
        **picture(pair, (ends[pair.a], ends[pair.b]), (), decimals),
        "lists": lists,
    }


def _shown_number(number: int | None, parent: int | None, count: int) -> int | None:
    """Return the number of a contour as the page shows it: the inner edge of an expanded stroke has the stroke's."""
    of_drawing = (one for one in (number, parent) if one is not None and one < count)
    return None if number is None else next(of_drawing, None)


def _parts(pair: Pair, drawings: Sequence[Drawing], settings: Settings) -> list[dict[str, Any]]:
    """Return what the timeline of a pair shows: parts by name, with the times of their start and their end."""
    if settings.mix:
        return []
    return [
        {"name": part.name, "shapes": part.shapes, "span": part.span, "is_grouped": part.is_grouped}
        for part in parts_of(pair, drawings, settings, PLAIN.fullmatch)
    ]


def _kept(
    step: str, objects: Sequence[object], given: int, make: Callable[[], dict[str, Any]]
) -> dict[str, Any]:
    """Return what is made of objects and a number: as it was kept, else as it is made now."""
    key = step, *map(id, objects), given
    found: tuple[object, dict[str, Any]] | None = KEPT.steps.find(key)
    if found is None:
        found = objects, make()  # as long as the objects are kept, no others have their ids
        KEPT.steps.keep(key, found, size=0)
    return found[1]


def _kept_drawing(drawing: Drawing, number: int) -> dict[str, Any]:
    """Return a drawing as the page shows it."""
    return _kept("shown", (drawing,), number, lambda: _drawing(drawing, number))


def _kept_lists(contour: ContourBlend, decimals: int) -> dict[str, Any]:
    """Return `correspondence_lists`, of which a correction leaves most unchanged."""
    sides = contour.polygon_a, contour.polygon_b, contour.contour_a, contour.contour_b
    objects = *sides, contour.correspondence, *contour.cuts
    return _kept("lists", objects, decimals, lambda: correspondence_lists(contour, decimals))


def _drawing(drawing: Drawing, number: int) -> dict[str, Any]:
    """Return a drawing as the page shows it, in its own coordinates: what it paints, and its contours by number."""
    shapes = as_drawn(drawing)
    view = view_of(shapes, drawing.viewbox)
    decimals = decimals_for([view])
    contours = [
        {
            "d": path_data([path], decimals),
            "id": own.id if PLAIN.fullmatch(own.id or "") else None,
            "filled": path.closed or shape.style.fill is not None,
            "nodes": rounded_points(
                np.append(path.segments[:, 0], [] if path.closed else path.segments[-1, 3]), decimals
            ),
        }
        for own, shape in zip(drawing.shapes, shapes, strict=True)
        for path in shape.paths
    ]
    found = {
        "name": title_of(drawing.file),
        "view": rounded(view, decimals),
        "decimals": decimals,
        "paths": still_paths(Frame(0.0, 0, shapes, view), decimals),
        "contours": contours,
    }
    images = images_of(shape.style for shape in shapes)
    found |= {"images": images} if images else {}
    return found | {"key": hashlib.sha256(repr((number, found)).encode()).hexdigest()[:16]}


def _others(order: Order) -> list[dict[str, Any]]:
    """Return other blends of two drawings: the options that give each, its grade, and pictures of moments."""
    from shapeblend_cli.job.tries import tries  # blends to look at do without it, and without svgwrite

    job, clock = _shown_job(order), Clock()
    settings = job.output.settings
    drawings = read_files(job.files, job.read, clock, _ignore, order.sources)
    (pair,) = match_drawings(drawings, settings, clock, _ignore, lambda stage, share: None)
    return [
        {
            "name": one.name,
            "options": one.options,
            "changes": {
                settings.options[name].flags[-1].lstrip("-"): value for name, value in one.changed.items()
            },
            "grade": one.grade,
            "pictures": [
                frame_svg(frame.picture, decimals_for([frame.view]))
                for frame in (frame_at(one.pair, t, as_drawn=settings.draws_ends) for t in THUMBNAIL_TIMES)
            ],
        }
        for one in tries(drawings, settings, pair)
    ]


def _contents(order: Order) -> dict[str, Any]:
    job = _job(order)
    notes: list[str] = []
    check_libraries(job)
    made = make(job, Clock(), notes.append, sources=order.sources)
    files: dict[str, bytes] = {}
    for target, content in made.contents.items():
        inside = content if isinstance(content, Mapping) else {"": content}
        for name, one in inside.items():
            files[str(target / name) if name else str(target)] = _bytes(one)
    if made.standard_output:
        files["blend.svg"] = _bytes(made.standard_output)
    return {"files": files, "notes": notes}


def _size(order: Order) -> dict[str, int]:
    files = _contents(order)["files"].values()
    return {
        "files": len(files),
        "bytes": sum(map(len, files)),
        "gzipped": sum(len(gzip.compress(content)) for content in files),
    }


def _write(order: Order) -> dict[str, Any]:
    """Write what the command would write, where it would, or return what to ask before that."""
    job = _job(order)
    notes: list[str] = []
    if STANDARD_OUTPUT in (job.output.path, job.write.report):
        raise OptionError(
            f"the studio cannot write to standard output, {STANDARD_OUTPUT}; the name of a file would work"
        )
    targets = all_targets(job)
    job = job._replace(write=job.write.replace(force=any(map(os.path.lexists, targets))))
    check_libraries(job)
    asks = order.consent.asks(targets)
    if not asks["outside"]:
        check_files_of(job)
    if any(asks.values()):
        return {"asks": asks}
    made = make(job, Clock(), notes.append, sources=order.sources)
    asks = order.consent.asks(targets)  # others may have written meanwhile
    if any(asks.values()):
        return {"asks": asks}
    write(job, made.contents, notes.append)
    return {"written": [str(target) for target in made.contents], "notes": notes}


def _job(order: Order) -> Job:
    project = order.project
    return job_of(project.files, project.given, project.command)


def _shown_job(order: Order) -> Job:
    """Return a job whose blend goes from drawing to drawing; raise OptionError for a mixture, which is none."""
    job = _job(order)
    if job.output.settings.mix:
        raise OptionError("--mix makes mixtures, which the studio does not show; Write writes them")
    return job


def _bytes(content: str | bytes) -> bytes:
    return content.encode("utf-8", "replace") if isinstance(content, str) else content


def _ignore(_: str) -> None:
    pass


ORDERS: dict[str, Callable[[Order], Any]] = {
    "blend": _blend,
    "others": _others,
    "contents": _contents,
    "size": _size,
    "write": _write,
}
