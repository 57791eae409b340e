"""How well it is told which drawings rather take each other's place: `python -m tools.grading.exchanges`.

Two graders or more graded each of many blends of drawings of npm sets, by lot or two of one kind, without knowing what
made them. Beside the mean of their grades stands what `blending/swaps/unlike.py` asks of each. Least squares give what
a radian of bending and what the drawings have in common should count beside the grade that trees tell.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from shapeblend_cli.blending.swaps.unlike import FAULTY, HOPELESS, IN_COMMON, PER_BENT
from tools.grading.fit import rank_correlation

BLENDS = Path(__file__).with_name("exchanges.tsv")

LIMITS = tuple(HOPELESS + k * 0.15 for k in range(-2, 3))
"""Limits that are compared, in grades."""

GOOD = 1.0
"""Maximum grade of a blend that graders would not send back."""


def main() -> None:
    head, *rows = (line.split("\t") for line in BLENDS.read_text("utf-8").splitlines())
    assert head == ["pair", "grade", "told", "faults", "bent", "covered", "contours"]
    grades, told, faults, bent, covered, contours = np.array([row[1:] for row in rows], np.float64).T
    terms = np.column_stack([np.ones(len(rows)), told, bent, covered])
    weights, *_ = np.linalg.lstsq(terms, grades, rcond=None)
    per_bent, in_common = weights[2:] / weights[1]
    print(
        f"{len(rows)} blends; beside a grade that trees tell, a radian should count {per_bent:.2f}, and all"
    )
    print(f"in common {in_common:.2f}; in use are {PER_BENT} and {-IN_COMMON}")
    number = told + PER_BENT * bent - IN_COMMON * covered
    print(f"rank correlation with grades: {rank_correlation(number, grades):.2f}, of trees alone ", end="")
    print(f"{rank_correlation(told, grades):.2f}")
    print("| limit | share | mean grade of theirs | of them good | mean grade of the rest |")
    print("| --- | --- | --- | --- | --- |")
    may = (faults >= FAULTY) & (contours > 1)
    for limit in LIMITS:
        some = may & (number >= limit)
        good = (grades[some] <= GOOD).mean()
        means = f"{grades[some].mean():.2f} | {good:.2f} | {grades[~some].mean():.2f}"
        print(f"| {limit:.2f} | {some.mean():.2f} | {means} |")


if __name__ == "__main__":
    main()
