"""Measure what each constant does, and write docs/defaults.json and docs/defaults.md: `make sweep`.

Each by itself, and a few jointly. No arguments; with `--again` nothing is measured, and the document is made from what
docs/defaults.json has.
"""

from __future__ import annotations

import argparse
import json
from concurrent.futures import ProcessPoolExecutor
from itertools import product
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.options.constants import WorkConstants
from shapeblend_cli.options.settings import Settings
from tools.quality.data import ROOT, icon_pairs, subpaths
from tools.quality.morphs import make as morphs
from tools.quality.morphs import packages
from tools.quality.peers import shapeblend
from tools.quality.raw import DIGITS, text
from tools.quality.scores import LITTLE, score
from tools.quality.tables import NONE, Table
from tools.quality.truth import letters
from tools.quality.truth.form import SETS, load
from tools.quality.truth.measures import GROSS, WRONG, corr, strict

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from shapeblend_cli.options.fields import Option
    from tools.quality.data import Pair
    from tools.quality.truth.form import Truth

    Setting = dict[str, str]  # values by option

RAW, DOCUMENT = ROOT / "docs" / "defaults.json", ROOT / "docs" / "defaults.md"

FOLDERS = {
    "letters": letters.FOLDER,
    "articulated": morphs.FOLDER / "articulated",
    "authored": morphs.FOLDER / "authored",
}
"""Where the pairs of known truth are."""

EVERY = {"letters": 2, "articulated": 2, "authored": 2, "icons": 4}
"""One pair in so many is taken, which keeps a run within minutes."""

TRIED: dict[str, Sequence[float | str]] = {
    "kb": (0, 0.3, 3),
    "es": (1, 1.5, 3),
    "eb": (0.5, 1.5, 2),
    "pb": (0, 3, 10, 1000),
    "mb": (0, 1, 10),
    "cs": (0.1, 0.9),
    "vertices": (100, 400),
    "motion": ("auto", "linear", "rigid", "intrinsic", "safe"),
}
"""What is tried beside the default. Of other constants, all words, or the default times `TIMES`."""

TIMES = (0, 1 / 3, 3)

LEFT_OUT = "ks"
"""Multiplying all work changes nothing, so only the other constants beside it count."""

BESIDE = {"mb": {"bending": "paper"}}
"""What has to be set for an option to matter."""

JOINTLY = {"kt": (0.5, 1, 2), "smoothing": (0.5, 1, 2), "pb": (0, 1, 3)}
"""Constants that are measured in all combinations: their defaults, multiplied."""

CLEAR = 0.05
"""A figure is told to be better or worse if it changes by this share, and by more than one where it counts pairs."""

TEXT = f"""\
# The defaults, by what they do

Written by `make sweep`, from [defaults.json](defaults.json): each option by itself, all others at their defaults, which
are bold; and at the end some constants jointly.

The pairs are those of [quality.md](quality.md): letters, limbs that are turned, morphs that motion designers authored,
and icons of one contour. So are the figures: *in-between*, how much of what the in-between or the true one covers is
not covered by both, mean; *off*, how far along the outline its points are off, mean; *gross*, pairs in which that is
more than {100 * GROSS:g} %; *crossed* and *area below {100 * LITTLE:g} %*, icons with such an in-between. But for the
rows of `--motion`, icons go straight (`--motion linear`): else another motion would mend what a bad correspondence
crosses. `--{LEFT_OUT}` is not here: multiplying all work changes nothing, so only the other constants beside it count.

Most letters and authored morphs have the same lines and curves at both ends. These become each other whatever the
constants are, unless that takes far more than the least work; so the limbs and the icons tell the most here.
"""

TRADES = f"""\
## Which trade each of them is

What gets better and what gets worse with the next value on each side of the default: figures that change by more than
{100 * CLEAR:g} % of themselves, and by more than one where they count pairs.
"""

JOINT = "## Jointly\n"


class Measure(NamedTuple):
    """A column of the table.

    Attributes
    ----------
    name : str
    of, kind : str
        The pairs and the scores that it is made of.
    take : callable
        What is said of the scores.
    show : callable
        How it is written.
    counted : bool
        Whether pairs are counted.
    """

    name: str
    of: str
    kind: str
    take: Callable[[list[float]], float]
    show: Callable[[float], str]
    counted: bool = False


def _gross(scores: list[float]) -> float:
    return sum(off > GROSS for off in scores)


def _percent(part: float) -> str:
    return f"{100 * part:.2f} %"


def _finely(part: float) -> str:
    return f"{100 * part:.3f} %"


MEASURES = (
    *(
        measure
        for of in FOLDERS
        for measure in (
            Measure(f"{of}: in-between", of, "strict", np.mean, _percent),
            Measure(f"{of}: off", of, "corr", np.mean, _finely),
            Measure(f"{of}: gross", of, "corr", _gross, str, counted=True),
        )
    ),
    Measure("icons: crossed", "icons", "crossed", sum, str, counted=True),
    Measure(f"icons: area below {100 * LITTLE:g} %", "icons", "little", sum, str, counted=True),
)

Found = dict[str, dict[str, list[float]]]
"""Scores by the pairs and the kind of score."""


def options() -> dict[str, Option]:
    """The options that are measured, by key: the constants of the wire and some more."""
    known = {field.key: field for field in Settings.options.values()}
    keys = [field.key for field in WorkConstants.options.values() if field.key != LEFT_OUT]
    return {key: known[key] for key in dict.fromkeys([*keys, *TRIED])}


def beside(key: str) -> Setting:
    """What is set beside an option."""
    return {other: value for other, value in BESIDE.get(key, {}).items() if other in options()}


def default_of(key: str) -> str:
    """The default as it is typed."""
    known = options()
    chosen = Settings(**{known[other].name: value for other, value in beside(key).items()})
    return written(getattr(chosen, known[key].name))


def written(value: float | str) -> str:
    return value if isinstance(value, str) else f"{value:.3g}" if value < 1000 else str(int(value))


def values(key: str) -> list[str]:
    """What is tried of an option, its default included; numbers in order."""
    default, words = default_of(key), options()[key].kind.choices
    if words:
        return list(words)
    tried = TRIED.get(key) or [float(default) * times for times in TIMES]
    return sorted({default, *map(written, tried)}, key=float)


def by_itself(key: str, value: str) -> Setting:
    return {**beside(key), key: value}


def combinations() -> list[Setting]:
    """Settings of the constants that are measured jointly."""
    keys = [key for key in JOINTLY if key in options()]
    each = [[written(float(default_of(key)) * times) for times in JOINTLY[key]] for key in keys]
    return [dict(zip(keys, chosen, strict=True)) for chosen in product(*each)]


def settings() -> dict[str, Setting]:
    """All that are measured, as they are typed; the first is the defaults."""
    found: dict[str, Setting] = {"": {}}
    for setting in [*(by_itself(key, value) for key in options() for value in values(key)), *combinations()]:
        found.setdefault(label(setting), setting)
    return found


def label(setting: Setting) -> str:
    """How a setting is typed, without what is the default; but a motion that is typed holds for icons too."""
    told = {key: value for key, value in setting.items() if key == "motion" or value != default_of(key)}
    return " ".join(f"--{key} {value}" for key, value in told.items())


def measured(setting: Setting) -> Found:
    """All scores of one setting."""
    truths = {
        of: [truth for name in SETS for truth in load(folder, name)][:: EVERY[of]]
        for of, folder in FOLDERS.items()
    }
    return scored(setting, truths, icon_pairs("single")[:: EVERY["icons"]])


def scored(setting: Setting, truths: dict[str, list[Truth]], pairs: list[Pair]) -> Found:
    """What one setting makes of pairs of known truth and of icons."""
    also = label(setting).split()
    found = {of: _near(some, also) for of, some in truths.items()}
    judged = []
    for pair in pairs:
        files = shapeblend.frames(pair, setting.get("motion", "linear"), also=also)
        counts = len(subpaths(pair.a)), len(subpaths(pair.b))
        judged.append(files and score([shapeblend.drawn(file) for file in files], counts))
    found["icons"] = {
        "crossed": [int(one is None or one.crossed) for one in judged],
        "little": [int(one is None or one.area_share < LITTLE) for one in judged],
    }
    return found


def _near(truths: list[Truth], also: list[str]) -> dict[str, list[float]]:
    each = list(zip(truths, shapeblend.linked(truths, also), strict=True))
    return {
        "strict": [round(strict(truth, one.frames), DIGITS) if one else 1.0 for truth, one in each],
        "corr": [round(corr(truth, one.links), DIGITS) if one else WRONG for truth, one in each],
    }


def document(found: dict[str, Found]) -> str:
    """The text of docs/defaults.md."""
    names = [measure.name for measure in MEASURES]
    alone = [row(found, key, value) for key in options() for value in values(key)]
    counts = ", ".join(f"{of} {len(next(iter(kinds.values())))}" for of, kinds in found[""].items())
    neighbours = [trade(found, key, value) for key in options() for value in beside_default(key)]
    grid = combinations()
    jointly = [[*_bold(setting), *cells(found[label(setting)])] for setting in grid]
    return "\n".join(
        (
            TEXT,
            f"Pairs: {counts}.\n",
            Table(("option", "value", *names), alone).markdown(),
            TRADES,
            Table(("setting", "better", "worse"), neighbours).markdown(),
            JOINT,
            Table((*(f"`--{key}`" for key in grid[0]), *names), jointly).markdown(),
        )
    )


def row(found: dict[str, Found], key: str, value: str) -> list[str]:
    """A line of the first table."""
    setting = by_itself(key, value)
    shown = " ".join(f"--{other} {set_to}" for other, set_to in beside(key).items())
    return [f"`{shown} --{key}`".replace("` ", "`"), *_bold({key: value}), *cells(found[label(setting)])]


def _bold(setting: Setting) -> list[str]:
    """Values, with the default in bold."""
    return [f"**{value}**" if value == default_of(key) else value for key, value in setting.items()]


def cells(found: Found) -> list[str]:
    return [measure.show(measure.take(found[measure.of][measure.kind])) for measure in MEASURES]


def beside_default(key: str) -> list[str]:
    """The values next to the default; of words, all others."""
    every, default = values(key), default_of(key)
    k = every.index(default)
    if options()[key].kind.choices:
        return every[:k] + every[k + 1 :]
    return [*every[max(k - 1, 0) : k], *every[k + 1 : k + 2]]


def trade(found: dict[str, Found], key: str, value: str) -> list[str]:
    """A line of the second table."""
    one, default = (found[label(by_itself(key, chosen))] for chosen in (value, default_of(key)))
    better, worse = [], []
    for measure in MEASURES:
        before, after = (measure.take(scores[measure.of][measure.kind]) for scores in (default, one))
        if abs(after - before) > max(CLEAR * before, 1.0 if measure.counted else 0.0):
            told = f"{measure.name} {measure.show(before)} → {measure.show(after)}"
            (better if after < before else worse).append(told)
    typed = " ".join(f"--{other} {set_to}" for other, set_to in by_itself(key, value).items())
    return [f"`{typed}`", *("; ".join(told) or NONE for told in (better, worse))]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--again", action="store_true", help="make the document anew, without measuring")
    if not parser.parse_args().again:
        if problem := letters.ready() or packages.ready():
            raise SystemExit(f"letters, limbs and morphs cannot be made: {problem}")
        letters.make(letters.FOLDER)
        morphs.make(morphs.FOLDER)
        every = settings()
        with ProcessPoolExecutor() as pool:
            found = dict(zip(every, pool.map(measured, every.values()), strict=True))
        RAW.write_text(f"{text(found)}\n", encoding="utf-8")
    DOCUMENT.write_text(document(json.loads(RAW.read_text(encoding="utf-8"))), encoding="utf-8")
    print(DOCUMENT.read_text(encoding="utf-8"))


if __name__ == "__main__":
    main()
