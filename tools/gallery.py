"""Draw pairs blended by shapeblend and by flubber, for docs/gallery.md: python -m tools.gallery, no arguments."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from tools.contact_sheet import sheet
from tools.quality.data import NUMBER, ROOT, SETS, Pair, icon_pairs, polygon, subpaths
from tools.quality.peers import flubber, shapeblend
from tools.quality.truth import form, letters

if TYPE_CHECKING:
    from PIL import Image

DOCS = ROOT / "docs"
GALLERY = DOCS / "gallery"
PAGE = DOCS / "gallery.md"

STEPS = 6
"""A row has so many steps: the ends, and the five drawings between."""

CELL = 110
COLOURS = 16

ICONS = {"single": 16, "whole": 10}
LETTERS = {"single": 20, "multi": 24}
"""Of every set the first pair, and one in so many."""

ROOM = 10.0
"""Letters are laid into a square of 100 with so much room around them."""

TEXT = f"""\
# Pairs beside flubber

Written by `make gallery`. The upper row is shapeblend's, as its command writes it, the lower one flubber's, with
about {flubber.VERTICES} vertices a contour. Each row begins with the first drawing, ends with the second, and has
{STEPS - 1} in-betweens, at even times. flubber turns all contours the same way round, so its rows are filled by the
even-odd rule, or holes would be lost; those of shapeblend are filled as the drawings are. Where flubber has no call
for the numbers of contours, it leaves some out.

The pairs are picked by number, not by how they look. Of the sets that [quality.md](quality.md) measures, it is the
first pair and then every {ICONS["single"]}th of the icons of one contour, every {ICONS["whole"]}th of those of two to
five, every {LETTERS["single"]}th of the letters of one contour and every {LETTERS["multi"]}th of those of several.
Both letters of a pair are laid into the same square. The icons are from Font Awesome Free by Fonticons, Inc. (CC BY
4.0), the letters from fonts under the SIL Open Font License.

[A gallery that moves](moving.md) has pairs chosen by eye.
"""


class Shown(NamedTuple):
    """A pair in the gallery, and what it is."""

    name: str
    what: str
    pair: Pair


def icons() -> list[Shown]:
    return [
        Shown(f"icons-{name}-{number}", f"icons of {SETS[name]}", pair)
        for name, every in ICONS.items()
        for number, pair in enumerate(icon_pairs(name)[::every], 1)
    ]


def of_letters() -> list[Shown]:
    """The letters, from the folder that `letters.make` fills."""
    return [
        Shown(f"letters-{name}-{number}", f"letters of {form.SETS[name]}", fitted(truth.pair))
        for name, every in LETTERS.items()
        for number, truth in enumerate(list(form.load(letters.FOLDER, name))[::every], 1)
    ]


def fitted(pair: Pair) -> Pair:
    """Both drawings laid into the same square."""
    return Pair(pair.id, _fitted(pair.a), _fitted(pair.b))


def _fitted(data: str) -> str:
    points = np.concatenate([polygon(subpath) for subpath in subpaths(data)])
    low, high = (complex(take(points.real), take(points.imag)) for take in (np.min, np.max))
    scale = (100.0 - 2.0 * ROOM) / max((high - low).real, (high - low).imag)
    shift = 50.0 + 50.0j - scale * (low + high) / 2.0

    def laid(found: re.Match) -> str:
        z = scale * complex(float(found[1]), float(found[2])) + shift
        return f"{z.real:.3f},{z.imag:.3f}"

    return re.sub(f"({NUMBER.pattern}),({NUMBER.pattern})", laid, data)


def ours(shown: Shown) -> list[str]:
    """The upper row."""
    files = shapeblend.frames(shown.pair, steps=STEPS)
    assert files is not None, f"{shown.pair.id} was not blended"
    return files


def theirs(shown: Shown, viewbox: str) -> list[str]:
    """The lower row, in a viewBox."""
    (frames,) = flubber.FINE.path_data([shown.pair], [k / STEPS for k in range(STEPS + 1)])
    assert frames is not None, f"{shown.pair.id} was not blended by flubber"
    return [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{viewbox}"><path fill-rule="evenodd" d="{data}"/></svg>'
        for data in frames
    ]


def drawn(shown: Shown, with_flubber: bool = True) -> Image.Image:
    """A picture of the gallery, or its upper row alone."""
    upper = ours(shown)
    (viewbox,) = re.findall(r'viewBox="([^"]+)"', upper[0])
    lower = theirs(shown, viewbox) if with_flubber else []
    return sheet([*upper, *lower], STEPS + 1, CELL).quantize(COLOURS)


def page(pairs: list[Shown]) -> str:
    """The text of docs/gallery.md."""
    pictures = [
        f"{shown.pair.id}, {shown.what}:\n\n![{shown.pair.id}](gallery/{shown.name}.png)\n" for shown in pairs
    ]
    return "\n".join([TEXT, *pictures])


def main() -> None:
    for problem in (flubber.FINE.ready(), letters.ready()):
        if problem:
            raise SystemExit(f"no gallery: {problem}")
    letters.make(letters.FOLDER)
    GALLERY.mkdir(exist_ok=True)
    pairs = [*icons(), *of_letters()]
    for shown in pairs:
        target = GALLERY / f"{shown.name}.png"
        drawn(shown).save(target, optimize=True)
        print(target.relative_to(ROOT))
    PAGE.write_text(page(pairs), encoding="utf-8")


if __name__ == "__main__":
    main()
