"""Measure: whether the judge of in-betweens finds those best that were graded best by eye."""

from __future__ import annotations

import csv
from itertools import combinations
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from tools.quality import raw
from tools.quality.judge.blends import ALIKE, OPTIONS, blend_of, look, number, unlikeness
from tools.quality.judge.pairs import Pair
from tools.quality.tables import NONE, Section, Table

if TYPE_CHECKING:
    from collections.abc import Sequence

    from tools.quality.peers import Tool

HERE = Path(__file__).parent

SEEDS = {17: 130, 18: 40}
"""For each set of pairs its seed, and how many were drawn by lot."""

BEST = 3
"""The best grade; the worst is 0."""

CHOICES = ("linear", "rigid", "intrinsic")
"""What `--motion auto` chooses from."""

HEADER = ("seed", "pairs", "auto takes the best", *(f"always {name}" for name in CHOICES), "couples in order")

TEXT = f"""\
Does the judge that chooses motions see what an eye sees? Icons of six packages, which npm installs from a lock file,
in pairs drawn by lot: {SEEDS[17]} with the seed 17, {SEEDS[18]} with 18. Every other one has a word in common, as `bat`
and `bat-wing`. Of each pair several blends were drawn (straight, intrinsic and rigid motion; straight and intrinsic
motion of the paper's correspondence), in shuffled rows without names, and graded from 0 to {BEST} by eye. The judge's
weights were chosen with earlier blends of the pairs of seed 17 in view, which had been graded before there was a judge;
when motions had changed, these pairs were graded again in the same way. Its numbers for those of seed 18 were looked at
only when they had been graded. Pairs drawn twice, and those of which all blends were graded alike, are left out. The
grades are in `tools/quality/judge`.

*auto takes the best*: of how many pairs the one that `auto` takes, of straight, rigid and intrinsic motion, has the
best grade of the three, where these differ and it takes the same for all shapes; beside it the same for always taking
one of them. Icons drawn by lot have little in common, and then straight paths are hard to beat; limbs that swing are
another measure's. *Couples in order*: of how many couples of blends of a pair with unlike grades the judge's numbers
have the order of the grades. A blend counts only if it still looks as it did when it was graded; others are drawn
otherwise today. `make bench-judge` measures this alone."""


class Graded(NamedTuple):
    """A pair with a grade for each of its blends, and how that looked then."""

    pair: Pair
    grades: dict[str, int]
    looks: dict[str, str]
    note: str


def graded(seed: int) -> list[Graded]:
    """The pairs of a set."""
    return [
        Graded(
            Pair(row["icons"], row["a"], row["b"]),
            {name: int(row[name]) for name in OPTIONS if row[name]},
            {name: looked[name] for name in OPTIONS},
            row["note"],
        )
        for row, looked in zip(_table(f"grades-{seed}"), _table(f"looks-{seed}"), strict=True)
    ]


def _table(name: str) -> csv.DictReader[str]:
    lines = (HERE / f"{name}.tsv").read_text(encoding="utf-8").splitlines()
    return csv.DictReader(lines, delimiter="\t", quoting=csv.QUOTE_NONE)


class Measured(NamedTuple):
    """The judge's number of each blend of a pair that still looks as it did, and which of them `auto` takes."""

    numbers: dict[str, float | None]
    taken: str | None


def measured(tools: Sequence[Tool] = ()) -> dict[str, Any]:
    """Every pair of all sets."""
    found = {}
    for seed in SEEDS:
        every = graded(seed)
        rows = [measure(one) for one in every]
        found[str(seed)] = {
            "pairs": [" ".join(one.pair) for one in every],
            "numbers": {name: [row.numbers[name] for row in rows] for name in OPTIONS},
            "taken": [row.taken for row in rows],
        }
    return found


def measure(one: Graded) -> Measured:
    """Draw the blends of a pair, and the one of `auto`."""
    numbers: dict[str, float | None] = dict.fromkeys(OPTIONS)
    looks = {}
    for name in one.grades:
        blend = blend_of(one.pair, OPTIONS[name])
        looks[name] = look(blend)
        if unlikeness(looks[name], one.looks[name]) <= ALIKE:
            numbers[name] = round(number(blend), raw.DIGITS)
    auto = look(blend_of(one.pair, {}))
    return Measured(numbers, next((name for name in CHOICES if looks.get(name) == auto), None))


class Judged(NamedTuple):
    """A pair's grades and numbers, of the blends that have both, and which of them `auto` takes."""

    name: str
    note: str
    grades: dict[str, int]
    numbers: dict[str, float]
    taken: str | None

    @property
    def differs(self) -> bool:
        """Whether it matters which is taken."""
        return len(set(self.grades.values())) > 1

    def best(self, name: str | None) -> bool:
        """Whether no other has a better grade."""
        return name in self.grades and self.grades[name] == max(self.grades.values())


def judged(found: dict[str, Any], seed: int) -> list[Judged]:
    """The pairs of a set, with their grades and numbers."""
    kept = found[str(seed)]
    rows = []
    for k, one in enumerate(graded(seed)):
        numbers = {name: kept["numbers"][name][k] for name in one.grades}
        known = {name: value for name, value in numbers.items() if value is not None}
        grades = {name: one.grades[name] for name in known}
        rows.append(Judged(kept["pairs"][k], one.note, grades, known, kept["taken"][k]))
    return rows


def couples(one: Judged) -> list[bool]:
    """For each couple of blends of unlike grades whether the numbers order them as the grades do."""
    return [
        (one.grades[p] > one.grades[q]) == (one.numbers[p] < one.numbers[q])
        for p, q in combinations(one.numbers, 2)
        if one.grades[p] != one.grades[q]
    ]


def wrong(found: dict[str, Any]) -> list[str]:
    """The pairs of which `auto` does not take the best."""
    lines = []
    for seed in SEEDS:
        for one in choices(judged(found, seed)):
            if not one.best(one.taken):
                told = ", ".join(
                    f"{name} {x:.3f} (grade {one.grades[name]})" for name, x in one.numbers.items()
                )
                lines.append(f"{seed} {one.name}: takes {one.taken} of {told}; {one.note}")
    return lines


def choices(every: Sequence[Judged]) -> list[Judged]:
    """The pairs for which it matters what `auto` takes, with what it chooses from alone."""
    few = []
    for one in every:
        if one.taken in one.grades and all(name in one.grades for name in CHOICES):
            grades, numbers = (
                {name: of_all[name] for name in CHOICES} for of_all in (one.grades, one.numbers)
            )
            few.append(one._replace(grades=grades, numbers=numbers))
    return [one for one in few if one.differs]


def of(conditions: Sequence[bool]) -> str:
    """How many of them hold."""
    count = len(conditions)
    return f"{sum(conditions)} of {count}, {100 * sum(conditions) / count:.0f} %" if count else NONE


def section(found: dict[str, Any]) -> Section:
    rows = []
    for seed in SEEDS:
        every = judged(found, seed)
        few = choices(every)
        rows.append(
            [
                str(seed),
                str(len(every)),
                of([one.best(one.taken) for one in few]),
                *(of([one.best(name) for one in few]) for name in CHOICES),
                of([right for one in every for right in couples(one)]),
            ]
        )
    return Section("The judge", TEXT, Table(HEADER, rows), [])
