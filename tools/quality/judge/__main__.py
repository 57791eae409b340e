"""Measure how the judge agrees with grades by eye: python -m tools.quality.judge.

With --wrong it prints every pair of which `auto` does not take the best.
"""

from __future__ import annotations

import argparse
import sys

from tools.quality.judge import pairs, section


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument(
        "--wrong", action="store_true", help="print the pairs of which auto does not take the best"
    )
    options = parser.parse_args()
    if problem := pairs.ready():
        sys.exit(f"left out: {problem}")
    found = section.measured()
    if options.wrong:
        for line in section.wrong(found):
            print(line)
    print(section.section(found).table.markdown(), end="")


if __name__ == "__main__":
    main()
