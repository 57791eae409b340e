"""The page, put together: one file, no network.

`page.html`, `page.css` and the scripts beside this file are what is the same in every page; what is found goes into it
as JSON.
"""

from __future__ import annotations

import base64
import hashlib
import html
import json
import shlex
from importlib.resources import files
from string import Template
from typing import TYPE_CHECKING, Any

from shapeblend_cli.preview.graphs import by_size, graphs, pack_json
from shapeblend_cli.preview.pictures import picture, places
from shapeblend_cli.svg.reading.read import title_of
from shapeblend_cli.svg.writing.rounding import decimals_for, number

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.easing import Timing
    from shapeblend_cli.model import Frame, Pair
    from shapeblend_cli.settings import Settings

POLICY = (
    "default-src 'none'; script-src {script}; style-src {style}; img-src data:; "
    "base-uri 'none'; form-action 'none'"
)
"""Nothing is fetched, and nothing runs but the page's own script."""

SCRIPTS = ("values.js", "picture.js", "graph.js", "report.js", "page.js")
"""One after the other they are the page's script."""

LISTS = ("vertices_a", "vertices_b", "dots")
"""What of a contour's report is long; the page has it packed."""


def preview(
    found: dict[str, Any],
    pairs: Sequence[Pair],
    ends: Sequence[Frame],
    settings: Settings,
    timing: Timing,
    command: Sequence[str],
    notes: Sequence[str],
) -> str:
    """A page that shows a run.

    Parameters
    ----------
    found : dict
        The run's report.
    pairs : sequence of Pair
    ends : sequence of Frame
        The drawings, as frames show them.
    settings : Settings
    timing : Timing
    command : sequence of str
        What was typed, word by word.
    notes : sequence of str
        What the run said.
    """
    decimals = decimals_for([frame.view for frame in ends])
    data = {
        **{name: found[name] for name in ("version", "settings", "frames", "seconds")},
        "names": [title_of(file) for file in found["inputs"]],
        "command": [shlex.quote(word) for word in command],
        "notes": list(notes),
        "timing": {"seconds": timing.seconds, "ease": list(timing.ease), "repeat": timing.repeat},
        "decimals": decimals,
        "pairs": _pairs(found, pairs, ends, settings, decimals),
    }
    title = " → ".join(data["names"])
    script, style = "\n".join(map(_part, SCRIPTS)), _part("page.css")
    text = json.dumps(data, ensure_ascii=False, allow_nan=False, separators=(",", ":"))
    return Template(_part("page.html")).substitute(
        policy=POLICY.format(script=_hash(script), style=_hash(style)),
        title=html.escape(title),
        style=style,
        script=script,
        # Of all characters of JSON this one alone can end a script element, or begin another.
        data=text.replace("<", "\\u003c"),
    )


def _pairs(
    found: dict[str, Any],
    pairs: Sequence[Pair],
    ends: Sequence[Frame],
    settings: Settings,
    decimals: int,
) -> list[dict[str, Any]]:
    """The pairs of the report, with what is drawn of them."""
    landscapes = iter(graphs([contour for pair in pairs for contour in pair.contours], settings))
    written = []
    for pair, told in zip(pairs, found["pairs"], strict=True):
        times = [frame["t"] for frame in found["frames"] if frame["pair"] == pair.a]
        lists = [_lists(contour, decimals + 1) for contour in told["contours"]]
        spots = [places(contour) for contour in pair.contours]
        written.append(
            {
                "a": pair.a,
                "b": pair.b,
                "views": [[float(number(v, decimals)) for v in view] for view in pair.views],
                "contours": [
                    {name: value for name, value in contour.items() if name not in LISTS}
                    | {
                        "counts": [len(contour["vertices_a"]), len(contour["vertices_b"])],
                        "steps": len(contour["dots"]),
                        "shape": shape,
                        "outline": outline,
                        "graph": next(landscapes),
                    }
                    for contour, (shape, outline) in zip(told["contours"], _where(pair), strict=True)
                ],
                "order": by_size(pair.contours),
                "packed": pack_json(
                    {
                        **picture(pair, (ends[pair.a], ends[pair.b]), times, decimals),
                        "lists": [
                            one | {"places": [float(number(p, 3)) for p in spot.tolist()]}
                            for one, spot in zip(lists, spots, strict=True)
                        ],
                    }
                ),
            }
        )
    return written


def _where(pair: Pair) -> list[tuple[int, int]]:
    """For each contour of a pair the number of its shape, and its own number in that."""
    return [(k, n) for k, shape in enumerate(pair.shapes) for n in range(len(shape.contours))]


def _lists(contour: dict[str, Any], decimals: int) -> dict[str, Any]:
    """The long lists of a contour's report, coordinates with so many decimals."""
    vertices = {
        name: [[float(number(v, decimals)) for v in point] for point in contour[name]]
        for name in ("vertices_a", "vertices_b")
    }
    return {**vertices, "dots": contour["dots"]}


def _part(name: str) -> str:
    return files(__package__).joinpath(name).read_text(encoding="utf-8")


def _hash(text: str) -> str:
    digest = base64.b64encode(hashlib.sha256(text.encode("utf-8")).digest()).decode("ascii")
    return f"'sha256-{digest}'"
