"""Measure shapeblend beside other tools: python -m tools.quality [SECTION ...], everything without sections.

The scores go into docs/quality.json, where those of sections that are not named stay; docs/quality.md and the README's
figures are made from that file. With `--again` nothing is measured, and the documents are made anew. With `--print`
the tables are printed and nothing is written; `--wrong` adds each pair of faces that is not right.
"""

from __future__ import annotations

import argparse
import json
import sys
from typing import TYPE_CHECKING, Any

from tools.quality import crossings, raw, tables, times
from tools.quality.data import ROOT
from tools.quality.faces import section as faces
from tools.quality.peers import ALL, ready
from tools.quality.truth import section as truth

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

README, QUALITY, RAW = "README.md", "docs/quality.md", "docs/quality.json"

MEASURES: dict[str, Any] = {
    "truth": truth,
    "faces": faces,
    "icons": crossings,
    "times": times,
}
"""The sections, by their names in docs/quality.json."""


def measured(names: Iterable[str]) -> dict[str, Any]:
    """Return the scores of sections, by their names."""
    if problem := ready():
        sys.exit(f"nothing was measured: {problem}")
    return {name: MEASURES[name].measured(ALL) for name in names}


def sections(found: Mapping[str, Any]) -> list[tables.Section]:
    """Return the sections that were measured, in their order."""
    return [measure.section(found[name]) for name, measure in MEASURES.items() if name in found]


def documents(found: Mapping[str, Any], readme: str) -> dict[str, str]:
    """Return what the scores make of the README, and docs/quality.md."""
    every = sections(found)
    figures = tables.with_figures(readme, tables.front(every, [tool.name for tool in ALL if tool.front]))
    return {README: figures, QUALITY: tables.document(every, [tool.name for tool in ALL])}


def main(arguments: list[str] | None = None) -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("sections", nargs="*", metavar="|".join(MEASURES))
    for flag in ("--again", "--print", "--wrong"):
        parser.add_argument(flag, action="store_true")
    options = parser.parse_args(arguments)
    if unknown := {*options.sections} - {*MEASURES}:
        parser.error(f"no section is called {min(unknown)}")
    if options.print or options.wrong:
        found = measured(options.sections or MEASURES)
        for name in options.sections if options.wrong else ():
            print(*MEASURES[name].wrong(found[name]), sep="\n")
        print(*(section.table.markdown() for section in sections(found)), sep="\n")
        return
    if not options.again:
        known = json.loads((ROOT / RAW).read_text("utf-8")) if options.sections else {}
        known |= measured(options.sections or MEASURES)
        (ROOT / RAW).write_text(f"{raw.text({name: known[name] for name in MEASURES})}\n", "utf-8")
    found = json.loads((ROOT / RAW).read_text("utf-8"))
    for name, text in documents(found, (ROOT / README).read_text("utf-8")).items():
        (ROOT / name).write_text(text, "utf-8")


if __name__ == "__main__":
    main()
