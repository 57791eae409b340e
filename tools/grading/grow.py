"""Trees that predict grades by people from what is measured in strips: gradient boosting, of grades and of differences.

Of two strips of the same drawings people know better which is better than how good each is. So trees are grown on the
errors of grades and, as much, on those of differences between two such strips.
"""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

import numpy as np
from sklearn.tree import DecisionTreeRegressor

from shapeblend_cli.grading.trees import DEPTH, Forest
from tools.grading.fit import FOLDS, folds, rank_correlation, two_by_two
from tools.grading.strips import WEIGHTS, Strips
from tools.quality.data import ROOT

if TYPE_CHECKING:
    from shapeblend_cli.model import FloatArray, IntArray

TREES = ROOT / "shapeblend_cli" / "grading" / "trees.json"

TREES_GROWN = 400
"""Number of trees."""

RATE = 0.05
"""Share of the errors that a tree is to mend."""

SEEN = 0.6
"""Share of the strips that each tree is grown from, by lot."""

ASKED = 0.25
"""Share of the measures that each question is chosen from, by lot."""

LEAST = 8
"""Minimum number of strips in a leaf."""

CLEAR = 0.5
"""Minimum difference between two strips of which both graders preferred the same, in grades."""


def beside(rows: Strips) -> tuple[IntArray, IntArray, FloatArray]:
    """Return the strips of the same drawings, two by two, and by how much the first should be graded worse."""
    first, second = two_by_two([*zip(rows.kinds, rows.pairs, strict=True)])
    apart = rows.grades[first] - rows.grades[second]
    apart = np.where(rows.is_better[first], np.minimum(apart, -CLEAR), apart)
    return first, second, np.where(rows.is_better[second], np.maximum(apart, CLEAR), apart)


def grown(rows: Strips) -> Forest:
    """Grow trees, each from what is left of the errors after those before it."""
    chance = np.random.RandomState(0)
    weights = np.array([WEIGHTS[kind] for kind in rows.kinds])
    base = float(np.average(rows.grades, weights=weights))
    found = np.full(len(weights), base)
    first, second, apart = beside(rows)
    both = weights[first]
    counts = weights + np.bincount(first, both, len(weights)) + np.bincount(second, both, len(weights))
    trees = []
    for _ in range(TREES_GROWN):
        wanted = weights * (rows.grades - found)
        errors = both * (apart - (found[first] - found[second]))
        wanted += np.bincount(first, errors, len(weights)) - np.bincount(second, errors, len(weights))
        some = chance.rand(len(weights)) < SEEN
        tree = DecisionTreeRegressor(
            max_depth=DEPTH, min_samples_leaf=LEAST, max_features=ASKED, random_state=chance.randint(1 << 30)
        ).fit(rows.values[some], (wanted / counts)[some], sample_weight=counts[some])
        found += RATE * tree.predict(rows.values)
        trees.append(_as_arrays(tree.tree_))
    places, limits, leaves = (np.array(values) for values in zip(*trees, strict=True))
    return Forest(base, places, limits, RATE * leaves)


def _as_arrays(tree: object) -> tuple[list[int], list[float], list[float]]:
    """Return the questions and the leaves of a tree in the order of `Forest`; a leaf that comes early is repeated."""
    nodes, size = [0], 2**DEPTH - 1
    places, limits = [0] * size, [0.0] * size
    for k in range(size):
        node = nodes[k]
        if tree.children_left[node] < 0:
            nodes += [node, node]
            continue
        places[k], limits[k] = int(tree.feature[node]), float(f"{tree.threshold[node]:.5g}")
        nodes += [tree.children_left[node], tree.children_right[node]]
    return places, limits, [float(tree.value[node][0][0]) for node in nodes[size:]]


def trees_file(forest: Forest) -> str:
    """Return the file of trees, a line for each tree in each table."""
    tables = {
        "places": forest.places.tolist(),
        "limits": forest.limits.tolist(),
        "leaves": np.round(forest.leaves, 4).tolist(),
    }
    texts = [f'"base": {forest.base:.4f}']
    for name, rows in tables.items():
        lines = ",\n".join(json.dumps(row, separators=(",", ":")) for row in rows)
        texts.append(f'"{name}": [\n{lines}\n]')
    return "{\n" + ",\n".join(texts) + "\n}\n"


def predicted(rows: Strips) -> FloatArray:
    """Return grades of all strips, each by trees that were grown from strips of other groups."""
    parts = folds(rows.groups)
    found = np.zeros(len(parts))
    for k in range(FOLDS):
        forest = grown(rows.take(parts != k))
        found[parts == k] = [forest.tell(values) for values in rows.values[parts == k]]
    return found


def checks(rows: Strips) -> str:
    """Return the rows of the table of checks, of grades by trees that were grown from strips of other groups."""
    grades, lines = predicted(rows), []
    first, second, _ = beside(rows)
    is_told = rows.is_better[first] != rows.is_better[second]
    is_right = is_told & ((grades[first] < grades[second]) == rows.is_better[first])
    kinds, made = np.array(rows.kinds), np.array(rows.made)
    for kind in WEIGHTS:
        for version in sorted(set(made[kinds == kind])):
            some = (kinds == kind) & (made == version)
            correlation = rank_correlation(grades[some], rows.grades[some])
            lines.append(f"| {kind}; {version} | {int(some.sum())} | {correlation:.2f} | |")
        told, right = (int((which & (kinds[first] == kind)).sum()) for which in (is_told, is_right))
        if told:
            lines.append(f"| {kind}; one beside another | | | {right} of {told} |")
    return "\n".join(lines)
