"""Fit the weights of `shapeblend judge` to the grades in grades.tsv, and write them and docs/judge.md."""

from __future__ import annotations

from tools.grading.fit import PAGE, WEIGHTS, graded, page, weights_file

if __name__ == "__main__":
    rows = graded()
    WEIGHTS.write_text(weights_file(rows))
    PAGE.write_text(page(rows))
    print(f"written: {WEIGHTS}, {PAGE}")
