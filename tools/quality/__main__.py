"""Measure shapeblend beside other tools, write docs/quality.json, and docs/quality.md and the README's figures from it.

No arguments; with `--again` nothing is measured, and the documents are made from what docs/quality.json has.
"""

from __future__ import annotations

import argparse
import json
import sys

from tools.quality import crossings, letters, motions, raw, sizes, tables, times
from tools.quality.data import ROOT
from tools.quality.faces import section as faces
from tools.quality.judge import pairs as judge_icons
from tools.quality.judge import section as judge
from tools.quality.morphs import make, packages
from tools.quality.morphs import section as morphs
from tools.quality.peers import ALL, flubber
from tools.quality.truth import letters as fonts

README, QUALITY, RAW = "README.md", "docs/quality.md", "docs/quality.json"


def measured() -> dict:
    """All scores, and what could not be measured."""
    problems = {tool.name: tool.ready() for tool in ALL}
    tools = [tool for tool in ALL if problems[tool.name] is None]
    with_flubber = problems[flubber.NAME] is None
    problems["letters"] = fonts.ready()
    problems["limbs and morphs"] = packages.ready()
    problems["faces"] = faces.ready()
    problems["judge"] = judge_icons.ready()
    missing = [f"{what} ({problem})" for what, problem in problems.items() if problem is not None]
    for line in missing:
        print(f"left out: {line}", file=sys.stderr)

    if problems["letters"] is None:
        fonts.make(fonts.FOLDER)
    if problems["limbs and morphs"] is None:
        make.make(make.FOLDER)
    icons = crossings.measured(tools)
    return {
        "tools": [tool.name for tool in tools if tool.brief],
        "missing": missing,
        "letters": {} if problems["letters"] else letters.measured(tools),
        "morphs": {} if problems["limbs and morphs"] else morphs.measured(tools),
        "faces": {} if problems["faces"] else faces.measured(),
        "judge": {} if problems["judge"] else judge.measured(),
        "icons": icons,
        "motions": motions.measured(),
        "sizes": sizes.measured(icons, with_flubber),
        "times": times.measured() if with_flubber else {},
    }


def documents(found: dict, readme: str) -> dict[str, str]:
    """What the scores make of the README, and docs/quality.md."""
    measures = {
        "letters": letters,
        "morphs": morphs,
        "faces": faces,
        "judge": judge,
        "icons": crossings,
        "motions": motions,
        "sizes": sizes,
        "times": times,
    }
    sections = [measure.section(found[name]) for name, measure in measures.items() if found.get(name)]
    figures = tables.short(sections, found["tools"], found["missing"])
    front = tables.front(sections, found["tools"], found["missing"])
    return {README: tables.with_figures(readme, front), QUALITY: tables.document(figures, sections)}


def main(arguments: list[str] | None = None) -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--again", action="store_true", help="make the documents anew, without measuring")
    if not parser.parse_args(arguments).again:
        (ROOT / RAW).write_text(f"{raw.text(measured())}\n", encoding="utf-8")
    found = json.loads((ROOT / RAW).read_text(encoding="utf-8"))
    for name, text in documents(found, (ROOT / README).read_text(encoding="utf-8")).items():
        (ROOT / name).write_text(text, encoding="utf-8")
    print((ROOT / QUALITY).read_text(encoding="utf-8"))


if __name__ == "__main__":
    main()
