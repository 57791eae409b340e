"""Fit the weights and grow the trees of `shapeblend judge` to grades by people, and write them and docs/judge.md."""

from __future__ import annotations

from tools.grading.fit import PAGE, WEIGHTS, graded, page, weights_file
from tools.grading.grow import TREES, checks, grown, trees_file
from tools.grading.strips import strips

if __name__ == "__main__":
    rows, measured = graded(), strips()
    WEIGHTS.write_text(weights_file(rows))
    TREES.write_text(trees_file(grown(measured)))
    PAGE.write_text(page(rows, len(measured.grades), checks(measured)))
    print(f"written: {WEIGHTS}, {TREES}, {PAGE}")
