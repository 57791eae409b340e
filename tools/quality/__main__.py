"""Measure shapeblend beside other tools, write docs/quality.json, and docs/quality.md and the README's figures from it.

Without arguments everything is measured. With `--only SECTION`, which may be repeated, the scores of the other sections
stay as docs/quality.json has them; with `--again` nothing is measured, and the documents are made from what it has.
"""

from __future__ import annotations

import argparse
import json
import sys
from typing import TYPE_CHECKING

from tools.quality import crossings, letters, motions, raw, sizes, tables, times
from tools.quality.data import ROOT
from tools.quality.faces import section as faces
from tools.quality.judge import pairs as judge_icons
from tools.quality.judge import section as judge
from tools.quality.morphs import make, packages
from tools.quality.morphs import section as morphs
from tools.quality.peers import ALL, LIBRARIES, flubber
from tools.quality.truth import letters as fonts

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from tools.quality.peers import Tool

README, QUALITY, RAW = "README.md", "docs/quality.md", "docs/quality.json"


MEASURES = {
    "letters": letters,
    "morphs": morphs,
    "faces": faces,
    "judge": judge,
    "icons": crossings,
    "motions": motions,
    "sizes": sizes,
    "times": times,
}
"""The sections, by their names in docs/quality.json."""


def measured(only: Sequence[str] = (), known: dict | None = None) -> dict:
    """All scores, and what could not be measured.

    Parameters
    ----------
    only : sequence of str
        The sections that are measured; all if it is empty.
    known : dict, optional
        What was measured before, which stays in the other sections.
    """
    problems = {tool.name: tool.ready() for tool in ALL}
    tools = [tool for tool in ALL if problems[tool.name] is None]
    libraries = [library for library in LIBRARIES if problems[library.name] is None]
    problems["letters"] = fonts.ready()
    problems["limbs and morphs"] = packages.ready()
    problems["faces"] = faces.ready()
    problems["judge"] = judge_icons.ready()
    missing = [f"{what} ({problem})" for what, problem in problems.items() if problem is not None]
    for line in missing:
        print(f"left out: {line}", file=sys.stderr)

    found = dict(known or {})
    scores: dict[str, Callable[[], dict]] = {
        "letters": lambda: {} if problems["letters"] else _of_letters(tools),
        "morphs": lambda: {} if problems["limbs and morphs"] else _of_morphs(tools),
        "faces": lambda: {} if problems["faces"] else faces.measured(),
        "judge": lambda: {} if problems["judge"] else judge.measured(),
        "icons": lambda: crossings.measured(tools),
        "motions": motions.measured,
        "sizes": lambda: sizes.measured(found["icons"], libraries),
        "times": lambda: {} if problems[flubber.NAME] else times.measured(),
    }
    for name in MEASURES:
        if not only or name in only:
            found[name] = scores[name]()
    return {
        "tools": [tool.name for tool in tools if tool.brief],
        "front": [tool.name for tool in tools if tool.front],
        "missing": missing,
        **{name: found[name] for name in MEASURES},
    }


def _of_letters(tools: Sequence[Tool]) -> dict:
    fonts.make(fonts.FOLDER)
    return letters.measured(tools)


def _of_morphs(tools: Sequence[Tool]) -> dict:
    make.make(make.FOLDER)
    return morphs.measured(tools)


def documents(found: dict, readme: str) -> dict[str, str]:
    """What the scores make of the README, and docs/quality.md."""
    sections = [measure.section(found[name]) for name, measure in MEASURES.items() if found.get(name)]
    figures = tables.short(sections, found["tools"], found["missing"])
    front = tables.front(sections, found["front"], found["missing"])
    return {README: tables.with_figures(readme, front), QUALITY: tables.document(figures, sections)}


def main(arguments: list[str] | None = None) -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--only", action="append", choices=MEASURES, default=[], help="measure this section")
    parser.add_argument("--again", action="store_true", help="make the documents anew, without measuring")
    options = parser.parse_args(arguments)
    if not options.again:
        known = json.loads((ROOT / RAW).read_text(encoding="utf-8")) if options.only else None
        (ROOT / RAW).write_text(f"{raw.text(measured(options.only, known))}\n", encoding="utf-8")
    found = json.loads((ROOT / RAW).read_text(encoding="utf-8"))
    for name, text in documents(found, (ROOT / README).read_text(encoding="utf-8")).items():
        (ROOT / name).write_text(text, encoding="utf-8")
    print((ROOT / QUALITY).read_text(encoding="utf-8"))


if __name__ == "__main__":
    main()
