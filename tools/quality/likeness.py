"""Is the work a measure of likeness? Letters look for themselves in another font: `make bench-rank`. No arguments.

Writes docs/rank.json, and the table in docs/rank.md from that. `--again` does only the second.
"""

from __future__ import annotations

import json
import sys
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from tools.quality.data import ROOT
from tools.quality.raw import text
from tools.quality.tables import Table, with_figures
from tools.quality.truth.letters import letter, opened, ready
from tools.quality.truth.measures import apart
from tools.quality.truth.write import centred, svg

if TYPE_CHECKING:
    from collections.abc import Sequence

    from tools.quality.scores import Frame

DOCUMENT, SCORES = ROOT / "docs" / "rank.md", ROOT / "docs" / "rank.json"
BEGIN, END = "<!-- figures: written by make bench-rank -->", "<!-- end of figures -->"

FONTS = (("Archivo", "Newsreader"), ("JetBrains Mono", "Bodoni Moda"), ("Fraunces", "Hepta Slab"))
"""The font of the letter that looks, and that of those among which it does."""

CHARACTERS = "ABCEGHKMRSTX"

WAYS = {"looks": "`wrong`, the judge's number", "work": "`work`", "overlap": "overlap alone"}


def places(fonts: tuple[str, str], characters: Sequence[str] = CHARACTERS) -> dict[str, list[int]]:
    """Return at which place each character finds itself in the other font, in each way."""
    one, other = ({c: _letter(font, c) for c in CHARACTERS} for font in fonts)
    found: dict[str, list[int]] = {way: [] for way in WAYS}
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "others").mkdir()
        for k, (_, drawing) in enumerate(other.values()):
            (folder / "others" / f"{k}.svg").write_text(drawing, "utf-8")
        for character in characters:
            frame, drawing = one[character]
            (folder / "a.svg").write_text(drawing, "utf-8")
            own = f"{CHARACTERS.index(character)}.svg"
            ranked = _ranked(folder)
            for way, key in (("looks", "wrong"), ("work", "work")):
                values = {name: values[key] for name, values in ranked.items()}
                found[way].append(_place(values, own))
            overlap = {f"{k}.svg": apart(*centred(frame, q)) for k, (q, _) in enumerate(other.values())}
            found["overlap"].append(_place(overlap, own))
    return found


def _letter(family: str, character: str) -> tuple[Frame, str]:
    """Return a letter as a font has it by default, as polygons and as a file."""
    font = opened(family)
    drawn = letter(font, family, character, font["fvar"].axes[0].axisTag, 0.0, 0.0)
    return drawn.frames[0], svg(drawn.outlines[0])


def _ranked(folder: Path) -> dict[str, dict[str, float]]:
    """Return what `shapeblend rank` says of each drawing."""
    from shapeblend_cli.batch.ranking import Ranking

    ranking = Ranking(str(folder / "a.svg"), [str(folder / "others")], {"place": "bbox"})
    return {Path(one.file).name: one.rating.as_json() for one in ranking.rate()}


def _place(values: dict[str, float], own: str) -> int:
    """Return how many are as good as one or better, itself included."""
    return sum(value <= values[own] for value in values.values())


def table(found: dict[str, dict[str, list[int]]]) -> str:
    """Return the table of places, with what it is and the lines around it."""
    rows = []
    for way, name in WAYS.items():
        every = np.concatenate([fonts[way] for fonts in found.values()])
        rows.append([name, f"{np.count_nonzero(every == 1)} of {len(every)}", f"{np.mean(every):.3g}"])
    pairs = "; ".join(found)
    words = (
        f"Each of {len(CHARACTERS)} capital letters of one font is ranked against the same letters of "
        f"another: {pairs}. Boxes are laid on boxes. A letter finds itself if it comes first."
    )
    head = ("by", "letters that find themselves", "mean place")
    return f"{BEGIN}\n\n{words}\n\n{Table(head, rows).markdown()}\n{END}"


def main() -> None:
    if "--again" not in sys.argv[1:]:
        if problem := ready():
            sys.exit(f"left out: {problem}")
        found = {" into ".join(fonts): places(fonts) for fonts in FONTS}
        SCORES.write_text(f"{text(found)}\n", encoding="utf-8")
    found = json.loads(SCORES.read_text(encoding="utf-8"))
    DOCUMENT.write_text(
        with_figures(DOCUMENT.read_text(encoding="utf-8"), table(found), BEGIN, END), encoding="utf-8"
    )


if __name__ == "__main__":
    main()
