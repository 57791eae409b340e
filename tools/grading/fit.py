"""Grades by people, and what best predicts them: a weighted sum of shares of features."""

from __future__ import annotations

import re
from itertools import combinations
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.grading.features import HALVES, PAIRS, Features, shares, terms
from shapeblend_cli.grading.grade import PHRASES
from tools.quality.data import ROOT

if TYPE_CHECKING:
    from collections.abc import Hashable, Sequence

    from shapeblend_cli.model import BoolArray, FloatArray, IntArray

GRADES = Path(__file__).with_name("grades.tsv")
WEIGHTS = ROOT / "shapeblend_cli" / "grading" / "weights.py"
PAGE = ROOT / "docs" / "judge.md"

RIDGE = 0.01
"""Weight of the squares of the weights beside the mean square error: many features see the same fault, and share it."""

BESIDE = 0.3
"""Weight of errors of differences between two strips of one pair, beside errors of grades: versions are compared."""

ROUNDS = 400
"""Number of rounds of coordinate descent; the weights stand still long before."""

FOLDS = 10
"""Number of parts of the strips, each of which is predicted from the others."""

HEAD = '''"""The weights of the features of a strip. `make judge-weights` fits them to grades by people."""

from __future__ import annotations

from shapeblend_cli.grading.features import Features
'''


KINDS = {
    "designers' drawings": "animals, emoji, logos: two designers or more",
    "designers' icons": "interface icons: one designer or more",
    "fresh eyes": "other interface icons of npm sets: one grader or two",
    "own": "other drawings of npm sets: one of the authors or two graders",
}
"""What was graded by whom. Each kind counts as much as any other when weights are fitted."""


class Graded(NamedTuple):
    """Strips and their grades, a row each."""

    pairs: list[str]  # strips of one pair have one name
    made: list[str]
    kinds: list[str]  # of `KINDS`
    eyes: FloatArray  # (n,), how many people graded it
    grades: FloatArray  # (n,), their mean
    amounts: FloatArray  # (n, features)

    @property
    def shares(self) -> FloatArray:
        """Features as shares of the worst."""
        return shares(self.amounts)

    def are(self, kind: str) -> BoolArray:
        """Return which strips are of a kind."""
        return np.array([one == kind for one in self.kinds])

    @property
    def terms(self) -> FloatArray:
        """These shares, and their products two by two."""
        return terms(self.shares)

    def take(self, some: BoolArray) -> Graded:
        """Return some of the strips."""
        at = np.flatnonzero(some).tolist()
        pairs, made, kinds = ([values[k] for k in at] for values in self[:3])
        return Graded(pairs, made, kinds, *(values[some] for values in self[3:]))


class Fit(NamedTuple):
    """A base and what each feature adds to it at its worst."""

    base: float
    weights: FloatArray

    def predict(self, strips: Graded) -> FloatArray:
        """Return grades."""
        return self.base + strips.terms @ self.weights


def graded() -> Graded:
    """Read the strips that people graded."""
    head, *rows = (line.split("\t") for line in GRADES.read_text().splitlines())
    assert tuple(head[5:]) == Features._fields
    pairs, made, kinds, *numbers = zip(*rows, strict=True)
    values = np.array(numbers, np.float64).T
    return Graded(list(pairs), list(made), list(kinds), values[:, 0], values[:, 1], values[:, 2:])


def fit(strips: Graded) -> Fit:
    """Return the weights, none below 0, with the least squares of errors and, times `RIDGE`, of weights.

    Errors are those of grades and, times `BESIDE`, those of differences between strips of one pair.
    """
    found, count = strips.terms, _counts(strips, np.arange(len(strips.grades)))
    mean, middle = count @ found, float(count @ strips.grades)
    spread = np.sqrt(count @ (found - mean) ** 2) + 1e-9
    z, off = (found - mean) / spread, strips.grades - middle
    products, wanted = (z.T * count) @ z + RIDGE * np.eye(len(mean)), (z.T * count) @ off
    i, j = _beside(strips)
    count = BESIDE * _counts(strips, i)
    products += ((z[i] - z[j]).T * count) @ (z[i] - z[j])
    wanted += ((z[i] - z[j]).T * count) @ (off[i] - off[j])
    weights = np.zeros(len(mean))
    for _ in range(ROUNDS):
        for k in range(len(weights)):
            rest = wanted[k] - products[k] @ weights + products[k, k] * weights[k]
            weights[k] = max(0.0, rest / products[k, k])
    weights /= spread
    return Fit(middle - float(mean @ weights), weights)


def _counts(strips: Graded, which: IntArray) -> FloatArray:
    """Return how much some strips count, 1 in all: by the root of the number of their graders, each kind alike."""
    counts, kinds = np.sqrt(strips.eyes[which]), np.array(strips.kinds)[which]
    for kind in KINDS:
        counts[kinds == kind] /= max(counts[kinds == kind].sum(), 1.0)
    return np.asarray(counts / max(counts.sum(), 1e-9), np.float64)


def _beside(strips: Graded) -> tuple[IntArray, IntArray]:
    """Return the strips of one pair, two by two."""
    return two_by_two(strips.pairs)


def two_by_two(names: Sequence[Hashable]) -> tuple[IntArray, IntArray]:
    """Return the places of equal names, two by two: first and second ones."""
    places: dict[Hashable, list[int]] = {}
    for k, name in enumerate(names):
        places.setdefault(name, []).append(k)
    found = [two for group in places.values() for two in combinations(group, 2)]
    first, second = np.array(found, np.intp).reshape(-1, 2).T
    return first, second


def folds(names: Sequence[str]) -> IntArray:
    """Return the part of the strips, of `FOLDS`, that each belongs to, by lot; those of one name are in one."""
    each = sorted(set(names))
    np.random.RandomState(0).shuffle(each)
    part = {name: k % FOLDS for k, name in enumerate(each)}
    return np.array([part[name] for name in names])


def predicted(strips: Graded) -> FloatArray:
    """Return grades of all strips, each from a fit to strips of other pairs."""
    parts = folds(strips.pairs)
    found = np.zeros(len(parts))
    for k in range(FOLDS):
        found[parts == k] = fit(strips.take(parts != k)).predict(strips.take(parts == k))
    return found


def rank_correlation(a: FloatArray, b: FloatArray) -> float:
    """Return Spearman's rank correlation; equal values share their mean rank."""
    ranks = [_ranks(values) for values in (a, b)]
    return float(np.corrcoef(*ranks)[0, 1])


def right_orders(strips: Graded, grades: FloatArray, least: float = 0.0) -> tuple[int, int]:
    """Return how many pairs of strips of the same drawings are in the right order, and how many people told apart.

    Those count that people graded differently, and by `least` or more.
    """
    i, j = _beside(strips)
    apart = strips.grades[i] - strips.grades[j]
    is_told = (apart != 0.0) & (np.abs(apart) >= least)
    is_right = np.sign(grades[i] - grades[j]) == np.sign(apart)
    return int(np.sum(is_told & is_right)), int(np.sum(is_told))


def weights_file(strips: Graded) -> str:
    """Return the module of weights."""
    found = fit(strips)
    good = strips.shares[strips.grades <= 0.5].mean(axis=0)
    return (
        f'{HEAD}\nBASE = {found.base:.3f}\n"""Grade of a strip without faults."""\n'
        + _features(
            "WEIGHTS", found.weights[: len(HALVES)], "Additions to the grade for each feature at its worst."
        )
        + _together(found)
        + _features("GOOD", good, "Mean shares of the features of strips that were graded as drawn by hand.")
    )


def _pairs(found: Fit) -> list[tuple[float, str, str]]:
    """Return the weights of products that round to more than 0, with the names of both features, largest first."""
    weights = np.round(found.weights[len(HALVES) :], 3).tolist()
    pairs = [
        (weight, *(Features._fields[k] for k in two))
        for weight, two in zip(weights, PAIRS.tolist(), strict=True)
        if weight
    ]
    return sorted(pairs, key=lambda pair: -pair[0])


def _together(found: Fit) -> str:
    lines = "".join(f'    ("{one}", "{other}"): {weight:.3f},\n' for weight, one, other in _pairs(found))
    says = "Additions to the grade for two features that are at their worst at once."
    return f'\nTOGETHER = {{\n{lines}}}\n"""{says}"""\n'


def _features(name: str, values: FloatArray, says: str) -> str:
    lines = "".join(
        f"    {field}={value:.3f},\n" for field, value in zip(Features._fields, values, strict=True)
    )
    return f'\n{name} = Features(\n{lines})\n"""{says}"""\n'


def page(strips: Graded, measured: int, tree_checks: str) -> str:
    """Return docs/judge.md; `checks_in` finds the checks of trees in it."""
    found, grades = fit(strips), predicted(strips)
    rows = []
    for k, name in sorted(enumerate(Features._fields), key=lambda one: -found.weights[one[0]]):
        alone = rank_correlation(strips.amounts[:, k], strips.grades)
        rows.append(f"| `{name}` | {PHRASES[name]} | {found.weights[k]:.2f} | {HALVES[k]:g} | {alone:.2f} |")
    checks = []
    for kind, what in KINDS.items():
        some = strips.are(kind)
        for name, these in _parts(strips, some):
            orders = [right_orders(strips.take(these), grades[these], least) for least in (0.0, 1.0)]
            order = " | ".join(f"{right} of {total}" if total else "-" for right, total in orders)
            correlation = rank_correlation(grades[these], strips.grades[these])
            checks.append(f"| {what}{name} | {int(these.sum())} | {correlation:.2f} | {order} |")
    return PAGE_TEXT.format(
        count=len(grades),
        rows="\n".join(rows),
        pairs="\n".join(f"| `{one}`, `{other}` | {weight:.2f} |" for weight, one, other in _pairs(found)),
        checks="\n".join(checks),
        measured=measured,
        tree_checks=tree_checks,
    )


def checks_in(text: str) -> tuple[int, str]:
    """Return the number of strips that trees were grown from, and the checks of these, as docs/judge.md has them."""
    found = re.search(
        r"trees from (\d+)\s+strips.*?\| --- \| --- \| --- \| --- \|\n(.*?)\n\n", text, re.DOTALL
    )
    assert found is not None
    return int(found[1]), found[2]


def _parts(strips: Graded, some: BoolArray) -> list[tuple[str, BoolArray]]:
    """Return strips of a kind by their versions, if they were made by some, and all of them."""
    versions = sorted(
        {made for made, is_one in zip(strips.made, some, strict=True) if is_one and "version" in made}
    )
    parts = [(f"; {one}", some & np.array([made == one for made in strips.made])) for one in versions]
    return [*parts, ("; all" if versions else "", some)]


PAGE_TEXT = """# Grades of frames

```sh
shapeblend judge after                     # the frames in a folder, SVG or PNG, in the order of their names
shapeblend judge before after              # a line for each strip, to compare versions or tools
shapeblend judge after --fail-over 2       # exit status 1 if the grade is worse
```

`shapeblend judge` grades a strip of frames, whoever made them, from 0 to 3. 0 is as drawn by hand, 1 good with a
small flaw, 2 flawed, 3 unusable. Each folder, and each GIF, is one strip. The first and the last frame are taken to be
right. Each frame is drawn as a picture of 96 x 96 pixels. Strips of more than seven frames are thinned to seven. Clips,
dashes and gradients are drawn roughly: with their mean colours, without dashes, whole. If the corners of the first and
the last frame have one opaque colour, this is the ground.

Regression trees give the grade. What is seen in a frame is measured in many ways: how long its edges are, how much ink
it has and how far this is spread, how thick and how thin it is, its corners, its patches of colour, holes and pieces,
how far it is from its mirror image, in how many directions edges run, how much they bend. Each of these is compared
with an even change from the first frame to the last, and with both of them. So are the steps from frame to frame, and
what the frames have in common. `make judge-weights` grows the trees from {measured}
strips, `tools/grading/strips.tsv.gz`, and writes them, `shapeblend_cli/grading/trees.json`, and this page. Graders saw
most strips beside another way to blend the same drawings, without knowing which was which, and also said which of the
two they preferred.

Each strip below is graded by trees that were grown from strips of other drawings, and of icons also of other
transitions. Of two ways to blend the same drawings of which both graders preferred the same, the last column counts
those in the right order.

| strips | number | rank correlation | right order |
| --- | --- | --- | --- |
{tree_checks}

## Faults

The trees give no reason for a grade. The reason that is printed is the worst of the faults below; their weighted sum is
one of the measures above. It also decides between ways to blend two drawings, with a margin for the usual one: the
trees' grades go in steps, the sum goes up evenly.

The sum is a base and what the features add to it. Each is 0 where nothing is wrong, and adds nothing then. As it
grows, it adds more, but never more than its weight, and half of its weight where it is as large as the column "half
at" says: what is seen first counts most. No weight is negative, so that the feature with the largest addition, alone
and with others, is the reason. `make judge-weights` fits the weights to {count} graded strips,
`tools/grading/grades.tsv`.

| feature | as people see it | weight | half at | rank correlation with grades, alone |
| --- | --- | --- | --- | --- |
{rows}

Two faults at once look worse than both alone. So two features add their product as well, each as its share of the
worst, from 0 to 1, times a weight of both. Only `pop` does not: it is seen between pictures, not in one. What is not
in this table has no weight.

| features | weight of both |
| --- | --- |
{pairs}

The sum for each strip below is by weights that were fitted to strips of other drawings. Of two strips of the same
drawings that people graded differently, the last two columns count those in the right order: all of them, and those
that are at least a grade apart. Several graders count with their mean. Most strips of later versions, and of npm sets,
were graded to compare two ways to blend that were both thought good, so that they differ less than versions do.

| strips | number | rank correlation | right order | a grade apart |
| --- | --- | --- | --- | --- |
{checks}

The report of a blend has its grade; `--fail-on poor`, `--try`, `rank` and the studio use it, too. The judge that
chooses motions, [the page on motion](motion.md), looks at outlines, not at pictures. Its number is not this grade.
"""


def _ranks(values: FloatArray) -> FloatArray:
    """Return the ranks of values; equal values share their mean rank."""
    _, inverse, counts = np.unique(values, return_inverse=True, return_counts=True)
    ends = np.cumsum(counts)
    return np.asarray((ends - 0.5 * (counts - 1))[inverse], np.float64)
