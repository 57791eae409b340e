"""Draw the pairs of icons that straight paths do worst, beside what shapeblend chooses: `make worst`."""

from __future__ import annotations

from typing import NamedTuple

from tools.pictures import sheet
from tools.quality.data import ROOT, SETS, Pair, icon_pairs, subpaths
from tools.quality.motions import choice
from tools.quality.peers import shapeblend
from tools.quality.scores import STEPS, Score, score

PAIRS = 20
SHEET = ROOT / "out" / "worst.png"
CELL = 96


class Judged(NamedTuple):
    """A pair with its frames on straight paths, as files, and what is said of them."""

    pair: Pair
    frames: list[str]
    score: Score

    @property
    def rank(self) -> tuple[bool, bool, float]:
        """What is worst comes first: contours crossed by themselves, by each other, then least area."""
        return not self.score.crossed, not self.score.overlapping, self.score.area_share


def judged(pair: Pair, motion: str) -> Judged | None:
    """A pair with one motion, or None if there is no blend."""
    frames = shapeblend.frames(pair, motion)
    if frames is None:
        return None
    contours = len(subpaths(pair.a)), len(subpaths(pair.b))
    return Judged(pair, frames, score([shapeblend.drawn(text) for text in frames], contours))


def main() -> None:
    linear = [one for name in SETS for pair in icon_pairs(name) if (one := judged(pair, "linear"))]
    svgs = []
    for number, worst in enumerate(sorted(linear, key=lambda one: one.rank)[:PAIRS], 1):
        found = judged(worst.pair, shapeblend.DEFAULT)
        report = shapeblend.report(worst.pair)
        if found is None or report is None:
            continue
        svgs += [*worst.frames, *found.frames]
        print(f"{number:2} {worst.pair.id:24} linear: {_said(worst.score)}; ", end="")
        print(f"{choice(report).motion}: {_said(found.score)}", flush=True)
    SHEET.parent.mkdir(exist_ok=True)
    sheet(svgs, STEPS + 1, CELL).save(SHEET, optimize=True)
    print(SHEET.relative_to(ROOT))


def _said(found: Score) -> str:
    crossed = (found.crossed, "crossed, "), (found.overlapping, "contours cross, ")
    return "".join(word for holds, word in crossed if holds) + f"{100 * found.area_share:.0f} % of the area"


if __name__ == "__main__":
    main()
