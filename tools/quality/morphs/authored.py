"""Morphs that motion designers drew: paths of Lottie animations from one keyframe to the next.

The format moves a path's nodes and handles straight and all alike, so what lies between is known, whatever the pace.
"""

from __future__ import annotations

import json
import re
from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.geometry.polygons import signed_area
from tools.quality.npm import MODULES
from tools.quality.truth.measures import apart
from tools.quality.truth.write import SIZE, Morph, centred, is_plain

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from tools.quality.truth.write import Outline

ANIMATIONS = ("bacon", "bodymovin")
"""Of those that lottie-web is tested with, some with morphs of many kinds."""

LEAST_CURVES = 4
"""A contour with fewer is a drop or a line, of which there are many."""

DIFFERENT = 0.15
"""Ends whose regions are less far from being the same are too easy."""

CHANGED = 0.12
"""So are those that are less far from it when the true points of A are mapped to those of B by an affine map."""

TIMES = np.linspace(0.0, 1.0, 9)
"""When drawings must not cross themselves."""

NUMBERED = re.compile(r"( Outlines)?[ \d]*$")
"""What copies of a layer have at the end of their names."""


class Step(NamedTuple):
    """What is painted together, at two keyframes that follow each other.

    Attributes
    ----------
    animation, layer, group : str
    number : int
        How many keyframes are before.
    ends : (outline, outline)
    """

    animation: str
    layer: str
    group: str
    number: int
    ends: tuple[Outline, Outline]


def morphs(name: str) -> Iterator[Morph]:
    """The morphs of a set: of a layer and its copies, for each group the step that changes most."""
    best: dict[tuple[str, ...], tuple[float, Morph]] = {}
    for animation in ANIMATIONS:
        for step in steps(animation):
            if (len(step.ends[0]) == 1) != (name == "single") or not has_curves(step.ends[0]):
                continue
            one = morph(step)
            change = changed(one)
            source = (
                animation,
                NUMBERED.sub("", step.layer),
                step.group,
                *[str(step.number)] * (name != "single"),
            )
            if change > best.get(source, (CHANGED,))[0] and is_fit(one):
                best[source] = change, one
    found: list[Morph] = []
    for _, one in best.values():
        if not any(is_same(one, other) for other in found):
            found.append(one)
    return iter(found)


def steps(animation: str) -> Iterator[Step]:
    """All steps of closed paths."""
    file = MODULES / "lottie-web" / "test" / "animations" / f"{animation}.json"
    drawn = json.loads(file.read_text(encoding="utf-8"))
    for holder in (drawn, *drawn["assets"]):
        for layer in holder.get("layers", ()):
            for group in _groups(layer.get("shapes", ())):
                paths = [item["ks"]["k"] for item in group["it"] if item["ty"] == "sh"]
                for number, ends in enumerate(pairwise(_keyframes(paths))):
                    if all(
                        _is_closed(p) and _is_closed(q) and len(p["v"]) == len(q["v"])
                        for p, q in zip(*ends, strict=True)
                    ):
                        first, last = ([_segments(path) for path in end] for end in ends)
                        yield Step(animation, layer["nm"], group["nm"], number, (first, last))


def _groups(items: Sequence[dict]) -> Iterator[dict]:
    for item in items:
        if item["ty"] == "gr":
            yield item
            yield from _groups(item["it"])


def _keyframes(paths: Sequence[dict | list[dict]]) -> list[list[dict]]:
    """At each keyframe all paths that are painted together; none if they have keyframes of their own."""
    moved = [path for path in paths if isinstance(path, list)]
    times = {tuple(key["t"] for key in path) for path in moved}
    if len(times) != 1:
        return []
    count = len(moved[0])
    found = [_states(path) if isinstance(path, list) else [path] * count for path in paths]
    return [list(together) for together in zip(*found, strict=True)]


def _states(keys: list[dict]) -> list[dict]:
    """What a path is at its keyframes. The last of an old file has nothing, but the one before says how it ends."""
    last = keys[-1].get("s") or keys[-2]["e"]
    return [*(key["s"][0] for key in keys[:-1]), last[0]]


def _is_closed(path: dict) -> bool:
    return path["c"]


def has_curves(outline: Outline) -> bool:
    return all(len(contour) >= LEAST_CURVES for contour in outline)


def _segments(path: dict) -> list[np.ndarray]:
    """The cubics of a closed path: nodes, and handles relative to them."""
    nodes, into, out = (np.array(path[part]) @ [1, 1j] for part in "vio")
    ends = np.roll(nodes, -1)
    return list(np.column_stack([nodes, nodes + out, ends + np.roll(into, -1), ends]))


def morph(step: Step) -> Morph:
    """A step, its larger end scaled to `SIZE`."""
    points = [np.concatenate([np.ravel(contour) for contour in end]) for end in step.ends]
    size = max(max(np.ptp(z.real), np.ptp(z.imag)) for z in points) or 1.0
    ends = [
        [[(cubic - points[0][0]) * SIZE / size for cubic in contour] for contour in end] for end in step.ends
    ]
    what = {"family": step.animation, "char": f"{step.layer}/{step.group}/{step.number}", "axis": "authored"}
    return Morph(what, (0.0, 1.0), ends)


def changed(one: Morph) -> float:
    """How far ends are from being the same when an affine map lays A's points on B's as well as it can."""
    p, q = (np.concatenate(frame) for frame in one.frames)
    known = np.column_stack([p, p.conj(), np.ones(len(p))])
    (a, b, c), *_ = np.linalg.lstsq(known, q, rcond=None)
    return apart([a * contour + b * contour.conj() + c for contour in one.frames[0]], one.frames[1])


def is_fit(one: Morph) -> bool:
    """Whether ends differ, and nothing crosses on the way or is turned over."""
    first, last = one.frames
    ends = list(zip(first, last, strict=True))
    return (
        apart(*centred(first, last)) >= DIFFERENT
        and all(signed_area(p) * signed_area(q) > 0.0 for p, q in ends)
        and all(is_plain([p + (q - p) * time for p, q in ends]) for time in TIMES)
    )


def is_same(one: Morph, other: Morph) -> bool:
    """Whether two are drawn alike, wherever they are."""
    return _shape(one).shape == _shape(other).shape and bool(
        np.abs(_shape(one) - _shape(other)).max() < 0.03 * SIZE
    )


def _shape(one: Morph) -> np.ndarray:
    points = np.array([np.concatenate(frame) for frame in one.frames])
    return points - points.mean(axis=1, keepdims=True)
