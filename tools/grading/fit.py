"""Grades by people, and what best predicts them: a weighted sum of square roots of features."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.grading.features import Features
from shapeblend_cli.grading.grade import PHRASES
from tools.quality.data import ROOT

if TYPE_CHECKING:
    from shapeblend_cli.model import BoolArray, FloatArray

GRADES = Path(__file__).with_name("grades.tsv")
WEIGHTS = ROOT / "shapeblend_cli" / "grading" / "weights.py"
PAGE = ROOT / "docs" / "judge.md"

RIDGE = 10.0
"""Weight of the squares of the weights, in strips: many features see the same fault, and share it."""

ROUNDS = 400
"""Number of rounds of coordinate descent; the weights stand still long before."""

FOLDS = 10
"""Number of parts of the strips, each of which is predicted from the others."""

HEAD = '''"""The weights of the features of a strip. `make judge-weights` fits them to grades by people."""

from __future__ import annotations

from shapeblend_cli.grading.features import Features
'''


class Graded(NamedTuple):
    """Strips and their grades, a row each."""

    pairs: list[str]  # strips of one pair have one name
    made: list[str]
    by_designers: BoolArray  # (n,)
    grades: FloatArray  # (n,)
    roots: FloatArray  # (n, features), square roots

    def take(self, some: BoolArray) -> Graded:
        """Return some of the strips."""
        at = np.flatnonzero(some).tolist()
        pairs, made = [self.pairs[k] for k in at], [self.made[k] for k in at]
        return Graded(pairs, made, self.by_designers[some], self.grades[some], self.roots[some])


class Fit(NamedTuple):
    """A base and what each square root adds to it."""

    base: float
    weights: FloatArray

    def predict(self, roots: FloatArray) -> FloatArray:
        """Return grades."""
        return self.base + roots @ self.weights


def graded() -> Graded:
    """Read the strips that people graded."""
    head, *rows = (line.split("\t") for line in GRADES.read_text().splitlines())
    assert tuple(head[4:]) == Features._fields
    pairs, made, graders, *numbers = zip(*rows, strict=True)
    values = np.array(numbers, np.float64).T
    return Graded(
        list(pairs), list(made), np.array(graders) == "designers", values[:, 0], np.sqrt(values[:, 1:])
    )


def fit(strips: Graded) -> Fit:
    """Return the weights, none below 0, with the least squares of errors and, times `RIDGE`, of weights."""
    mean, spread = strips.roots.mean(axis=0), strips.roots.std(axis=0) + 1e-9
    z, grades = (strips.roots - mean) / spread, strips.grades - strips.grades.mean()
    products, wanted = z.T @ z + RIDGE * np.eye(len(mean)), z.T @ grades
    weights = np.zeros(len(mean))
    for _ in range(ROUNDS):
        for k in range(len(weights)):
            rest = wanted[k] - products[k] @ weights + products[k, k] * weights[k]
            weights[k] = max(0.0, rest / products[k, k])
    weights /= spread
    return Fit(float(strips.grades.mean() - mean @ weights), weights)


def predicted(strips: Graded) -> FloatArray:
    """Return grades of all strips, each from a fit to strips of other pairs."""
    names = sorted(set(strips.pairs))
    np.random.RandomState(0).shuffle(names)
    part = {name: k % FOLDS for k, name in enumerate(names)}
    parts = np.array([part[pair] for pair in strips.pairs])
    found = np.zeros(len(parts))
    for k in range(FOLDS):
        found[parts == k] = fit(strips.take(parts != k)).predict(strips.roots[parts == k])
    return found


def rank_correlation(a: FloatArray, b: FloatArray) -> float:
    """Return Spearman's rank correlation; equal values share their mean rank."""
    ranks = [_ranks(values) for values in (a, b)]
    return float(np.corrcoef(*ranks)[0, 1])


def right_orders(strips: Graded, grades: FloatArray) -> tuple[int, int]:
    """Return how many pairs of strips of the same drawings are in the right order, and how many people told apart."""
    right = total = 0
    places: dict[str, list[int]] = {}
    for k, pair in enumerate(strips.pairs):
        places.setdefault(pair, []).append(k)
    for group in places.values():
        for i in group:
            for j in group:
                if strips.grades[i] < strips.grades[j]:
                    total += 1
                    right += int(grades[i] < grades[j])
    return right, total


def weights_file(strips: Graded) -> str:
    """Return the module of weights."""
    found = fit(strips)
    good = strips.roots[strips.grades <= 0.5].mean(axis=0)
    return (
        f'{HEAD}\nBASE = {found.base:.3f}\n"""Grade of a strip without faults."""\n'
        + _features("WEIGHTS", found.weights, "Additions to the grade for the square root of each feature.")
        + _features(
            "GOOD", good, "Mean square roots of the features of strips that were graded as drawn by hand."
        )
    )


def _features(name: str, values: FloatArray, says: str) -> str:
    lines = "".join(
        f"    {field}={value:.3f},\n" for field, value in zip(Features._fields, values, strict=True)
    )
    return f'\n{name} = Features(\n{lines})\n"""{says}"""\n'


def page(strips: Graded) -> str:
    """Return docs/judge.md."""
    found, grades = fit(strips), predicted(strips)
    rows = []
    for k, name in sorted(enumerate(Features._fields), key=lambda one: -found.weights[one[0]]):
        alone = rank_correlation(strips.roots[:, k], strips.grades)
        rows.append(f"| `{name}` | {PHRASES[name]} | {found.weights[k]:.2f} | {alone:.2f} |")
    checks = []
    designers = strips.by_designers
    animals = np.array([":" not in pair for pair in strips.pairs])
    for some, what in (
        (designers & animals, "animals, emoji, logos: two designers"),
        (designers & ~animals, "interface icons: one designer"),
        (~designers, "other blends of npm sets: one of the authors, shuffled and without names"),
    ):
        right, total = right_orders(strips.take(some), grades[some])
        order = f"{right} of {total}" if total else "-"
        correlation = rank_correlation(grades[some], strips.grades[some])
        checks.append(f"| {what} | {int(some.sum())} | {correlation:.2f} | {order} |")
    return PAGE_TEXT.format(
        count=len(grades),
        rows="\n".join(rows),
        checks="\n".join(checks),
    )


PAGE_TEXT = """# Grades of frames

```sh
shapeblend judge after                     # the frames in a folder, SVG or PNG, in the order of their names
shapeblend judge before after              # a line for each strip, to compare versions or tools
shapeblend judge after --fail-over 2       # exit status 1 if the grade is worse
```

`shapeblend judge` grades a strip of frames, whoever made them, from 0 to 3. 0 is as drawn by hand, 1 good with a
small flaw, 2 flawed, 3 unusable. A GIF is a strip of its own. The first and the last frame are taken to be right.
Each frame is drawn as a picture of 96 x 96 pixels. Strips of more than seven frames are thinned to seven. Clips,
dashes and gradients are drawn roughly: with their mean colours, without dashes, whole. If the corners of the first
and the last frame have one opaque colour, this is the ground.

The grade is a base and a weighted sum of the square roots of the features below. Each is 0 where nothing is wrong.
Weights are not negative, so that the largest addition is the reason that is printed. `make judge-weights` fits them to
{count} graded strips, `tools/grading/grades.tsv`, and writes this page.

| feature | as people see it | weight | rank correlation with grades, alone |
| --- | --- | --- | --- |
{rows}

Each strip below is graded by weights that were fitted to strips of other drawings. Of two strips of the same drawings
that people graded differently, the last column counts those in the right order.

| strips | number | rank correlation | right order |
| --- | --- | --- | --- |
{checks}

The report of a blend has its grade; `--fail-on poor`, `--try`, `rank` and the studio use it, too. The judge that
chooses motions, [the page on motion](motion.md), looks at outlines, not at pictures. Its number is another one.
"""


def _ranks(values: FloatArray) -> FloatArray:
    """Return the ranks of values; equal values share their mean rank."""
    _, inverse, counts = np.unique(values, return_inverse=True, return_counts=True)
    ends = np.cumsum(counts)
    return np.asarray((ends - 0.5 * (counts - 1))[inverse], np.float64)
