"""Draw the pictures of the documents: python -m tools.pictures [NAME ...], all of them without names.

`pictures` has all but those of the studio's page, which take a browser (`make studio`).
"""

from __future__ import annotations

import io
import re
import shlex
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import chdir, contextmanager
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory

from PIL import Image

from shapeblend_cli.cli import run
from shapeblend_cli.outputs.contact_sheet import contact_sheet
from shapeblend_cli.outputs.pixels import Size
from tools import icons, judge_examples
from tools.quality.data import ROOT, icon_pairs
from tools.quality.peers import flubber, shapeblend

DOCS = ROOT / "docs"
GROUND, PAGE = "#f6f6f4", "#ffffff"

SHEETS = {
    "letters": ["e f"],
    "triangle-square": ["triangle square"],
    "bird": ["bird-1 bird-2"],
    "animals": ["cow deer"],
    "step": ["step-1 step-2 --motion linear --preset paper", "step-1 step-2"],
    "dancer": ["dancer-1 dancer-2 --motion linear", "dancer-1 dancer-2"],
}
"""The rows of each picture of docs/examples.md: two samples, and the options that the page names."""

CONSTANTS = {
    "bending": {"dancer-1 dancer-2": ("turn", "paper")},
    "kt": {"cow deer --motion linear": (0, 7, 70)},
    "smoothing": {"pan-1 pan-2 --motion linear": (0, 0.01, 0.1)},
    "ks": {"f cow --motion linear": (0, 1.2, 12)},
    "kb": {"f cow --motion linear": (0, 1, 10)},
    "es": {"f cow --motion linear": (1, 2, 4)},
    "eb": {"f cow --motion linear": (0.5, 1, 2)},
    "pb": {"cow step-1 --motion linear": (0, 1), "dancer-1 dancer-2 --motion linear": (1, 1000)},
    "mb": {"cow deer --motion linear --preset paper": (0, 3, 100)},
    "cs": {"cow deer --motion linear": (0.05, 0.5, 1)},
}
"""For each constant of the wire the samples that show it, and its values from above to below."""

README = ("cow deer", "envelope envelope-open")
"""The animations at the top of the README, side by side."""

TALL = (240, 110)
"""Their heights, in units of the picture."""

MOVING = "--duration 1.2 --ease ease-in-out --repeat pingpong"
PAIRS = (
    "fox wolf",
    "raised-fist raised-hand",
    "cow deer",
    "tulip sunflower",
    "egg hatching-chick",
    "grinning-face crying-face",
    "bird-1 bird-2",
    "dancer-1 dancer-2",
    "play pause",
    "sun moon",
    "heart star",
    "envelope envelope-open",
)
"""The animations of docs/moving.md, of drawings in docs/moving/drawings and samples."""

GALLERY = {"single": 16, "whole": 10}
"""docs/gallery.md has the first pair of each set of icons, and one in this many."""

STEPS = 6
"""Steps from the first drawing of a row of the gallery to the last."""

SHOWN = re.compile(r"^!\[[^\]]+\]\(([^)]+)\)\n\n```sh\nshapeblend ([^`]+)\n```$", re.MULTILINE)
"""A picture of docs/paper.md, docs/plots.md or docs/guide.md, and below it the command that draws it."""

CORRECTED = re.compile(r"^!\[[^\]]+\]\(([^)]+)\)\n\n    shapeblend (\S+ \S+) (.*)$", re.MULTILINE)
"""A picture of docs/studio.md, and below it the command of its lower row."""


@contextmanager
def beside(*folders: str) -> Iterator[Path]:
    """Work in an empty folder in which the drawings of some folders lie, and the samples as `samples` too."""
    with TemporaryDirectory() as name, chdir(name):
        for folder in ("samples", *folders):
            for file in (ROOT / folder).glob("*.svg"):
                Path(file.name).unlink(missing_ok=True)
                Path(file.name).symlink_to(file)
        Path("samples").symlink_to(ROOT / "samples")
        yield Path(name)


def line(blend: str) -> list[str]:
    """Return the words of a blend whose drawings are named without their suffix."""
    a, b, *options = blend.split()
    return [f"{a}.svg", f"{b}.svg", *options]


def written(words: Sequence[str], name: str, *folders: str) -> bytes:
    """Return the file that a command writes beside the drawings of some folders."""
    with beside(*folders):
        if run([*words, "--quiet", "--force", "-o", name]) != 0:
            raise SystemExit(f"{' '.join(words)}: nothing was drawn")
        return Path(name).read_bytes()


def frames(words: Sequence[str], *folders: str) -> list[str]:
    """Return the frames of a blend, both ends among them."""
    with beside(*folders):
        if run([*words, "--quiet", "--ends", "-o", "frames"]) != 0:
            raise SystemExit(f"{' '.join(words)}: was not blended")
        return [file.read_text("utf-8") for file in sorted(Path("frames").iterdir())]


def sheet(svgs: Sequence[str], columns: int, cell: int) -> Image.Image:
    """Return drawings in rows, each in a square of `cell` pixels, whatever size its file has."""
    return contact_sheet(
        [icons.without_size(svg) for svg in svgs], Size(cell, cell), columns, ground=GROUND, page=PAGE
    )


def png(image: Image.Image, colours: int) -> bytes:
    """Return a picture of few colours as a file."""
    file = io.BytesIO()
    image.quantize(colours).save(file, "PNG", optimize=True)
    return file.getvalue()


def rows(blends: Sequence[str], cell: int, colours: int, *folders: str, options: str = "") -> bytes:
    """Return a picture with a row for each blend."""
    drawn = [frames([*line(blend), *options.split()], *folders) for blend in blends]
    return png(sheet([svg for row in drawn for svg in row], len(drawn[0]), cell), colours)


def beside_flubber(name: str, number: int) -> bytes:
    """Return a pair of icons, blended by shapeblend in the upper row and by flubber in the lower one."""
    pair = icon_pairs(name)[number]
    ours = shapeblend.frames(pair, steps=STEPS) or []
    (viewbox,) = re.findall(r'viewBox="([^"]+)"', ours[0])
    (theirs,) = flubber.FINE.path_data([pair], [k / STEPS for k in range(STEPS + 1)])
    start = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{viewbox}"><path fill-rule="evenodd" d='
    return png(sheet([*ours, *(f'{start}"{data}"/></svg>' for data in theirs or ())], STEPS + 1, 110), 16)


def side_by_side() -> bytes:
    """Return the animations of the README as one."""
    found, x, tallest = [], 0.0, max(TALL)
    for blend, height in zip(README, TALL, strict=True):
        words = line(f"{blend} --duration 1.6 --ease ease-in-out --repeat pingpong --hold 0.4")
        text = icons.without_size(written(words, "moving.svg", "docs/moving/drawings").decode())
        (box,) = re.findall(r'viewBox="([^"]+)"', text)
        width = height * float(box.split()[2]) / float(box.split()[3])
        place = f'x="{x:g}" y="{(tallest - height) / 2:g}" width="{width:g}" height="{height:g}"'
        found.append(text.replace("<svg ", f"<svg {place} ", 1))
        x += width + 40
    start = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {x - 40:g} {tallest}">'
    return f"{start}{''.join(found)}</svg>".encode()


def shown(page: str) -> dict[str, list[str]]:
    """Return the words of the command below each picture of a page, without what it writes."""
    found = {}
    for link, command in SHOWN.findall((DOCS / page).read_text("utf-8")):
        *words, flag, name = shlex.split(command.replace("\\\n", ""))
        if (flag, name) != ("-o", Path(link).name):
            raise SystemExit(f"{page}: the command below {link} does not end with -o {Path(link).name}")
        found[link] = words
    return found


def pictures() -> dict[str, Callable[[], bytes]]:
    """Return what draws each picture, by its path below docs."""
    found = {f"{name}.png": partial(rows, blends, 140, 64) for name, blends in SHEETS.items()}
    for name, samples in CONSTANTS.items():
        blends = [f"{blend} --{name} {value}" for blend, values in samples.items() for value in values]
        found[f"constant-{name}.png"] = partial(rows, blends, 90, 64)
    found["moving.svg"] = side_by_side
    for pair in PAIRS:
        name = f"moving/{pair.replace(' ', '-')}"
        drawings = "docs/moving/drawings"
        found[f"{name}.svg"] = partial(written, line(f"{pair} {MOVING}"), "moving.svg", drawings)
        found[f"{name}.png"] = partial(rows, [pair], 106, 32, drawings, options="--frames 1")
    for name, every in GALLERY.items():
        for k, number in enumerate(range(0, len(icon_pairs(name)), every), 1):
            found[f"gallery/icons-{name}-{k}.png"] = partial(beside_flubber, name, number)
    for name in icons.SETS:
        found[f"icons/{name}.webp"] = partial(icons.moving_sheet, name)
        found[f"icons/{name}.png"] = partial(icons.still_sheet, name)
    for page, folders in {
        "paper.md": (),
        "plots.md": (),
        "guide.md": ("docs/studio", "docs/moving/drawings"),
    }.items():
        found |= {
            link: partial(written, words, Path(link).name, *folders) for link, words in shown(page).items()
        }
    for link, files, options in CORRECTED.findall((DOCS / "studio.md").read_text("utf-8")):
        pair = files.replace(".svg", "")
        found[link] = partial(rows, [pair, f"{pair} {options}"], 110, 255, "docs/studio", options="-n 5")
    return found | {f"judge-{name}.svg": partial(_judged, name) for name in judge_examples.EXAMPLES}


def _judged(name: str) -> bytes:
    return judge_examples.drawn(name).encode()


def main() -> None:
    every, problem = pictures(), flubber.FINE.ready()
    for name in sys.argv[1:] or every:
        if problem and name.startswith("gallery/"):
            print(f"{name} is left as it is: {problem}", file=sys.stderr)
            continue
        (DOCS / name).write_bytes(every[name]())
        print(name, flush=True)


if __name__ == "__main__":
    main()
