"""Measure what becomes of eyes and mouths: python -m tools.quality.faces; with --wrong every pair that is not right."""

from __future__ import annotations

import argparse
import sys

from tools.quality.faces import section


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--wrong", action="store_true", help="print the pairs that are not right")
    options = parser.parse_args()
    if problem := section.ready():
        sys.exit(f"left out: {problem}")
    found = section.measured()
    if options.wrong:
        for line in section.wrong(found):
            print(line)
    print(section.section(found).table.markdown(), end="")


if __name__ == "__main__":
    main()
