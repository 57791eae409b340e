"""Measure what each constant does, one at a time, and write docs/defaults.json and docs/defaults.md: `make sweep`.

No arguments; with `--again` nothing is measured, and the document is made from what docs/defaults.json has.
"""

from __future__ import annotations

import argparse
import json
from concurrent.futures import ProcessPoolExecutor
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.settings import Settings
from tools.quality.data import ROOT, icon_pairs, subpaths
from tools.quality.peers import shapeblend
from tools.quality.raw import DIGITS, text
from tools.quality.scores import LITTLE, score
from tools.quality.tables import Table, share
from tools.quality.truth import letters
from tools.quality.truth.form import SETS, load
from tools.quality.truth.measures import GROSS, nearness

if TYPE_CHECKING:
    from tools.quality.data import Pair
    from tools.quality.truth.form import Truth

RAW, DOCUMENT = ROOT / "docs" / "defaults.json", ROOT / "docs" / "defaults.md"

HEADER = (
    "option",
    "value",
    "letters: in-between, median",
    "mean",
    "correspondence, mean",
    "gross",
    "icons: crossed",
    "area below 70 %",
)

EVERY = 2
"""Of the icons of one contour each second pair is taken, which keeps a run within minutes."""

OPTIONS = {
    "kb": ("0", "0.1", "0.3", "1", "3", "10"),
    "es": ("1", "1.5", "2", "3"),
    "eb": ("0.5", "1", "1.5", "2"),
    "mb": ("0", "1", "2", "3", "10", "100"),
    "pb": ("0", "10", "1000"),
    "cs": ("0.1", "0.5", "0.9"),
    "vertices": ("50", "100", "200", "400"),
    "motion": ("auto", "linear", "rigid", "intrinsic", "safe"),
}
"""What is tried of each option."""

TEXT = """\
# The defaults, by what they do

Written by `make sweep`, from [defaults.json](defaults.json): each option by itself, all others at their defaults, which
are bold.

The letters are those of [quality.md](quality.md), of one contour and of several, and so are the figures: *in-between*,
how much of what the in-between or the designer's covers is not covered by both; *correspondence*, how far along the
outline its points are off; *gross*, letters in which that is more than 5 %. The icons are every second of the pairs of
one contour; *crossed* and *area below 70 %* are as in quality.md too. But for the rows of `--motion`, icons go straight
(`--motion linear`): else another motion would mend what a bad correspondence crosses. `--ks` is not here: multiplying
all work changes nothing, so only `--kb` beside it counts.

A default is taken from the middle of the values that bring letters near to their designers' without more icons that
cross themselves. With fewer vertices letters come as near, but more icons cross; `--motion auto` goes straight for
letters, and mends what crosses for icons.
"""


class Found(NamedTuple):
    """What one setting makes of all pairs.

    Attributes
    ----------
    strict, corr : list of float
        Of the letters, see `truth.measures`.
    crossed, little : list of int
        Of the icons, whether an in-between crosses itself or has little area.
    """

    strict: list[float]
    corr: list[float]
    crossed: list[int]
    little: list[int]


def measured(option: str, value: str) -> dict:
    """All scores of one setting."""
    truths = [truth for name in SETS for truth in load(letters.FOLDER, name)]
    return scored(option, value, truths, icon_pairs("single")[::EVERY])._asdict()


def scored(option: str, value: str, truths: list[Truth], pairs: list[Pair]) -> Found:
    """What one setting makes of some letters and icons."""
    also = [f"--{option}", value]
    near = [
        nearness(truth, found) for truth, found in zip(truths, shapeblend.linked(truths, also), strict=True)
    ]
    icons = []
    for pair in pairs:
        files = shapeblend.frames(pair, value if option == "motion" else "linear", also=also)
        counts = len(subpaths(pair.a)), len(subpaths(pair.b))
        icons.append(files and score([shapeblend.drawn(file) for file in files], counts))
    return Found(
        strict=[round(one.strict, DIGITS) for one in near],
        corr=[round(one.corr, DIGITS) for one in near],
        crossed=[int(one is None or one.crossed) for one in icons],
        little=[int(one is None or one.area_share < LITTLE) for one in icons],
    )


def document(found: dict[str, dict[str, dict]]) -> str:
    """The text of docs/defaults.md."""
    rows = [
        row(option, value, Found(**scores))
        for option, values in found.items()
        for value, scores in values.items()
    ]
    first = Found(**next(iter(found[next(iter(found))].values())))
    counts = f"{len(first.strict)} pairs of letters, {len(first.crossed)} pairs of icons."
    return f"{TEXT}\n{counts}\n\n{Table(HEADER, rows).markdown()}"


def row(option: str, value: str, found: Found) -> list[str]:
    """A line of the table."""
    return [
        f"`--{option}`",
        f"**{value}**" if value == default_of(option) else value,
        *(f"{100 * take(found.strict):.2f} %" for take in (np.median, np.mean)),
        f"{100 * np.mean(found.corr):.2f} %",
        str(sum(off > GROSS for off in found.corr)),
        share(found.crossed),
        share(found.little),
    ]


def default_of(option: str) -> str:
    """The default as it is written here."""
    return next(field.shown_default for field in Settings.options.values() if field.key == option)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--again", action="store_true", help="make the document anew, without measuring")
    if not parser.parse_args().again:
        if problem := letters.ready():
            raise SystemExit(f"letters cannot be made: {problem}")
        letters.make(letters.FOLDER)
        settings = [(option, value) for option, values in OPTIONS.items() for value in values]
        with ProcessPoolExecutor() as pool:
            scores = list(pool.map(measured, *zip(*settings, strict=True)))
        found: dict[str, dict[str, dict]] = {}
        for (option, value), one in zip(settings, scores, strict=True):
            found.setdefault(option, {})[value] = one
        RAW.write_text(f"{text(found)}\n", encoding="utf-8")
    DOCUMENT.write_text(document(json.loads(RAW.read_text(encoding="utf-8"))), encoding="utf-8")
    print(DOCUMENT.read_text(encoding="utf-8"))


if __name__ == "__main__":
    main()
