"""How well it is told which drawings rather take each other's place: `python -m tools.grading.exchanges`.

Two graders or more graded each of many blends of drawings of npm sets, by lot or two of one kind, without knowing what
made them. Beside the mean of their grades stands what `blending/swaps/unlike.py` asks of each. Least squares give what
a radian of bending and what the drawings have in common should count beside the grade that trees tell.

Of signs of one colour, and of drawings of several, two graders or more saw the blend beside the exchange, and said
which they prefer. A logistic regression gives the same for these, and the limit at which half of them prefer the
exchange.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from shapeblend_cli.blending.swaps.unlike import ALONE, ANY, COLOURED, FAULTY, SIGNS, Hopeless
from tools.grading.fit import rank_correlation

BLENDS = Path(__file__).with_name("exchanges.tsv")
OF_SIGNS = Path(__file__).with_name("signs.tsv")
OF_COLOURS = Path(__file__).with_name("colours.tsv")

STEPS = tuple(k * 0.1 for k in range(-1, 4))
"""What limits that are compared are above those in use, in grades."""

ROUNDS = 20
"""Number of Newton's steps of the logistic regression, which stands still long before."""

GOOD = 1.0
"""Maximum grade of a blend that graders would not send back."""


def main() -> None:
    """Print what the graded blends, and then the preferred ones, say of the limits in use."""
    graded()
    columns = ["graders", "preferred", "told", "bent", "covered"]
    preferred("signs", SIGNS, *_columns(OF_SIGNS, columns))
    *values, alone = _columns(OF_COLOURS, [*columns, "alone"])
    preferred("coloured drawings", COLOURED, *(column[alone >= ALONE] for column in values))
    rest = [column[alone < ALONE] for column in values[:2]]
    share = np.average(rest[1], weights=rest[0])
    print(
        f"where less than {ALONE} of the shapes come or go, {share:.2f} of {len(rest[1])} prefer the exchange"
    )


def graded() -> None:
    """Print what the grades of blends say of the limit for any drawings."""
    grades, told, faults, bent, covered, contours = _columns(
        BLENDS, ["grade", "told", "faults", "bent", "covered", "contours"]
    )
    terms = np.column_stack([np.ones(len(told)), told, bent, covered])
    weights, *_ = np.linalg.lstsq(terms, grades, rcond=None)
    number = _told_of("blends", weights, ANY, told, bent, covered)
    print(f"rank correlation with grades: {rank_correlation(number, grades):.2f}, of trees alone ", end="")
    print(f"{rank_correlation(told, grades):.2f}")
    print("| limit | share | mean grade of theirs | of them good | mean grade of the rest |")
    print("| --- | --- | --- | --- | --- |")
    may = (faults >= FAULTY) & (contours > 1)
    for limit in (ANY.least + step for step in STEPS):
        some = may & (number >= limit)
        good = (grades[some] <= GOOD).mean()
        means = f"{grades[some].mean():.2f} | {good:.2f} | {grades[~some].mean():.2f}"
        print(f"| {limit:.2f} | {some.mean():.2f} | {means} |")


def preferred(
    what: str,
    limit: Hopeless,
    graders: np.ndarray,
    shares: np.ndarray,
    told: np.ndarray,
    bent: np.ndarray,
    covered: np.ndarray,
) -> None:
    """Print what the preferences of graders say of a limit, for one kind of drawings."""
    terms = np.column_stack([np.ones(len(told)), told, bent, covered])
    weights = np.zeros(terms.shape[1])
    for _ in range(ROUNDS):
        chance = 1.0 / (1.0 + np.exp(-terms @ weights))
        slopes = (terms * (graders * chance * (1.0 - chance))[:, None]).T @ terms
        weights += np.linalg.solve(slopes, terms.T @ (graders * (shares - chance)))
    number = _told_of(what, weights, limit, told, bent, covered)
    print(
        f"half of the graders prefer the exchange from {-weights[0] / weights[1]:.2f} on, with the first weights"
    )
    others = told + ANY.per_bent * bent - ANY.in_common * covered >= ANY.least
    print("| limit | share | prefer the exchange, of theirs | of the rest |")
    print("| --- | --- | --- | --- |")
    for least in (limit.least + step for step in STEPS):
        some = ((number >= least) & (told >= limit.told)) | others
        means = (np.average(shares[part], weights=graders[part]) for part in (some, ~some))
        print(f"| {least:.2f} | {some.mean():.2f} | " + " | ".join(f"{mean:.2f}" for mean in means) + " |")


def _columns(path: Path, names: list[str]) -> np.ndarray:
    """Return the columns of numbers in a file, after that of the pairs."""
    head, *rows = (line.split("\t") for line in path.read_text("utf-8").splitlines())
    assert head == ["pair", *names]
    return np.array([row[1:] for row in rows], np.float64).T


def _told_of(
    what: str, weights: np.ndarray, used: Hopeless, told: np.ndarray, bent: np.ndarray, covered: np.ndarray
) -> np.ndarray:
    """Print what fitted weights say of those in use, and return what these make of each blend."""
    per_bent, in_common = weights[2:] / weights[1]
    print(
        f"{len(told)} {what}; beside a grade that trees tell, a radian should count {per_bent:.2f}, and all"
    )
    print(f"in common {in_common:.2f}; in use are {used.per_bent} and {-used.in_common}")
    return told + used.per_bent * bent - used.in_common * covered


if __name__ == "__main__":
    main()
