"""Measure shapeblend beside other tools, write docs/quality.md and the README's figures: no arguments."""

from __future__ import annotations

import sys

from tools.quality import crossings, motions, sizes, tables
from tools.quality.data import ROOT
from tools.quality.peers import ALL


def main() -> None:
    problems = {tool: tool.ready() for tool in ALL}
    tools = [tool for tool in ALL if problems[tool] is None]
    missing = [f"{tool.name} ({problem})" for tool, problem in problems.items() if problem is not None]
    for line in missing:
        print(f"left out: {line}", file=sys.stderr)

    scores = crossings.scored(tools)
    sections = [crossings.section(scores), motions.section(), sizes.section(scores)]

    figures = tables.short(sections, [tool.name for tool in tools if tool.brief], missing)
    readme, quality = ROOT / "README.md", ROOT / "docs" / "quality.md"
    text = tables.with_figures(readme.read_text(encoding="utf-8"), figures)
    quality.write_text(tables.document(figures, sections), encoding="utf-8")
    readme.write_text(text, encoding="utf-8")
    print(quality.read_text(encoding="utf-8"))


if __name__ == "__main__":
    main()
