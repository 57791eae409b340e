"""The page: one file, no network.

`page.html`, `page.css` and the scripts beside this file are the same in every page; the run goes into it as JSON.
"""

from __future__ import annotations

import base64
import hashlib
import html
import json
import re
import shlex
from collections.abc import Iterator, Sequence
from importlib.resources import files
from string import Template
from typing import TYPE_CHECKING, Any

from shapeblend_cli.model import Frame, Pair
from shapeblend_cli.options.easing import Timing
from shapeblend_cli.options.settings import Settings
from shapeblend_cli.preview.graphs import by_size, graphs, pack_json
from shapeblend_cli.preview.pictures import (
    correspondence_lists,
    picture,
    rounded,
    scale_and_shift,
)
from shapeblend_cli.preview.pictures import timing as how_it_runs
from shapeblend_cli.svg.reading.read import title_of
from shapeblend_cli.svg.writing.rounding import decimals_for

if TYPE_CHECKING:
    from shapeblend_cli.geometry.similarity import Similarity

POLICY = (
    "default-src 'none'; script-src {script}; style-src {style}; img-src data:; "
    "base-uri 'none'; form-action 'none'"
)
"""Content Security Policy: the page fetches nothing, and runs only its own script."""

SCRIPTS = ("values.js", "picture.js", "player.js", "parts.js", "graph.js", "report.js", "page.js")
"""Modules that make the page's script, each after the modules that it imports."""

STYLES = ("base.css", "page.css")

LINKS = re.compile(r"^import .*\n|^export (?=const |class |function |async )", re.MULTILINE)
"""Imports and exports of modules, which a single script does without."""

FOLDERS = re.compile(r"(?:[A-Za-z]:)?[^\s:;,'\"]*[/\\\\](?=[^/\\\\\s]+\.\w{2,7}\b)")
"""The folders before the name of a file, in a text."""

PATH = re.compile(r"(?!-)[^\s{}<>#,=]*[/\\][^/\\\s{}<>#,=]+")
"""A word of a command line that names a file or a folder within folders."""

NOT_OF_STUDIO = ("-f", "--force", "-q", "--quiet", "-v", "--verbose")
"""Options that the studio does not have."""

OF_THIS_PAGE = re.compile(r"--preview[ =].*|(-n|--frames)[ =]?0", re.DOTALL)
"""Options with their values that are about this page alone: its name, and that nothing else was wanted."""

LISTS = ("vertices_a", "vertices_b", "dots")
"""Long lists in the report of a contour, which are packed."""


def preview(
    report: dict[str, Any],
    pairs: Sequence[Pair],
    ends: Sequence[Frame],
    settings: Settings,
    timing: Timing,
    command: Sequence[str],
    notes: Sequence[str],
    maps: Sequence[Similarity],
) -> str:
    """Return a page that shows a run.

    The `ends` are the drawings, as frames show them; the `command` is in words; the `notes` were printed by the run;
    the `maps` lay each drawing over the first. Files are named without their folders: the page is shown to others.
    """
    if any(shape.effects for pair in pairs for shape in pair.shapes):
        from shapeblend_cli.paint.effects import kinds_in, pair_without_effects, without_effects

        notes = [*notes, f"{kinds_in(pairs)} left out of this page; frames and animated SVGs have them"]
        pairs = [pair_without_effects(pair) for pair in pairs]
        ends = [frame._replace(shapes=without_effects(frame.shapes)) for frame in ends]
    decimals = decimals_for([frame.view for frame in ends])
    landscapes = iter(graphs([contour for pair in pairs for contour in pair.contours], settings))
    written = []
    for pair, reported in zip(pairs, report["pairs"], strict=True):
        times = [frame["t"] for frame in report["frames"] if frame["pair"] == pair.a]
        scene = picture(pair, (ends[pair.a], ends[pair.b]), times, decimals)
        written.append(
            _pair(pair, reported["contours"], landscapes, scene, decimals)
            | {"to_a": scale_and_shift(maps[pair.b])}
        )
    data = {
        **{name: report[name] for name in ("version", "settings", "frames", "seconds")},
        "names": [title_of(file) for file in report["inputs"]],
        "command": [shlex.quote(_without_folder(word)) for word in command],
        "studio": [shlex.quote(word) for word in _in_studio(command)],
        "notes": [FOLDERS.sub("", note) for note in notes],
        "timing": how_it_runs(timing, settings),
        "decimals": decimals,
        "pairs": written,
    }
    script = LINKS.sub("", "\n".join(map(_read, SCRIPTS)))
    style = "\n".join(map(_read, STYLES))
    text = json.dumps(data, ensure_ascii=False, allow_nan=False, separators=(",", ":"))
    return Template(_read("page.html")).substitute(
        policy=POLICY.format(script=_hash(script), style=_hash(style)),
        title=html.escape(" → ".join(data["names"])),
        style=style,
        script=script,
        # Of all characters of JSON this one alone can end a script element, or begin another.
        data=text.replace("<", "\\u003c"),
    )


def _without_folder(word: str) -> str:
    """Return a word of a command line without the folders of the file or the folder that it names, if it names one."""
    return re.split(r"[/\\]", word)[-1] if PATH.fullmatch(word) else word


def _in_studio(command: Sequence[str]) -> list[str]:
    """Return the words that open the same blend in the studio; none if no command line has made it."""
    if list(command[:1]) != ["shapeblend"]:
        return []
    kept, words = ["shapeblend", "studio"], list(command[1:])
    while words:
        word = words.pop(0)
        if words and OF_THIS_PAGE.fullmatch(f"{word} {words[0]}"):
            del words[0]
        elif word not in NOT_OF_STUDIO and not OF_THIS_PAGE.fullmatch(word):
            kept.append(_without_folder(word))
    return kept


def _pair(
    pair: Pair,
    reported: Sequence[dict[str, Any]],
    landscapes: Iterator[dict[str, Any] | str | None],
    scene: dict[str, Any],
    decimals: int,
) -> dict[str, Any]:
    numbers = [
        (k, n) for k, shape in enumerate(pair.shapes) if not shape.is_twin for n in range(len(shape.contours))
    ]
    contours, lists = [], []
    for contour, blend, (shape, outline) in zip(reported, pair.contours, numbers, strict=True):
        contours.append(
            {name: value for name, value in contour.items() if name not in LISTS}
            | {
                "counts": [len(contour["vertices_a"]), len(contour["vertices_b"])],
                "steps": len(contour["dots"]),
                "shape": shape,
                "outline": outline,
                "graph": next(landscapes),
            }
        )
        lists.append(correspondence_lists(blend, decimals))
    return {
        "a": pair.a,
        "b": pair.b,
        "views": [rounded(view, decimals) for view in pair.views],
        "contours": contours,
        "order": by_size(pair.contours),
        "packed": pack_json({**scene, "lists": lists}),
    }


def _read(name: str) -> str:
    return files(__package__).joinpath(name).read_text(encoding="utf-8")


def _hash(text: str) -> str:
    digest = base64.b64encode(hashlib.sha256(text.encode("utf-8")).digest()).decode("ascii")
    return f"'sha256-{digest}'"
