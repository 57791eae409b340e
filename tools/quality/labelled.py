"""The command of a measure against what was seen by eye: a table, and with --wrong every pair that is not right."""

from __future__ import annotations

import argparse
import sys
from typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from tools.quality.tables import Section


class Measure(Protocol):
    """A module with these functions."""

    def measured(self) -> dict:
        """Measure every pair."""

    def wrong(self, found: dict) -> Iterable[str]:
        """Yield a line for every pair that is not right."""

    def section(self, found: dict) -> Section:
        """Return the section of the documents."""


def main(measure: Measure, ready: Callable[[], str | None], description: str | None) -> None:
    """Run a measure from the command line; `ready` installs what it needs, or says why that cannot be."""
    parser = argparse.ArgumentParser(
        description=description, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--wrong", action="store_true", help="print the pairs that are not right")
    options = parser.parse_args()
    if problem := ready():
        sys.exit(f"left out: {problem}")
    found = measure.measured()
    if options.wrong:
        for line in measure.wrong(found):
            print(line)
    print(measure.section(found).table.markdown(), end="")
