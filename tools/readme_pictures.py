"""Draw the pictures of the README and docs/examples.md with the tool itself: python -m tools.readme_pictures."""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import TYPE_CHECKING

from shapeblend_cli.cli import run
from tools.contact_sheet import sheet

if TYPE_CHECKING:
    from PIL import Image

ROOT = Path(__file__).resolve().parents[1]
DOCS = ROOT / "docs"

MOVING = "cow deer --duration 1.6 --ease ease-in-out --repeat pingpong"
"""What the README begins with, an animated SVG."""

CELL, SMALL = 140, 90
"""Pixels of a drawing, and of one in the pictures of constants."""

SHEETS = {
    "letters": ["e f"],
    "triangle-square": ["triangle square"],
    "bird": ["bird-1 bird-2"],
    "animals": ["cow deer"],
    "step": ["step-1 step-2 --motion linear --preset paper", "step-1 step-2"],
    "dancer": ["dancer-1 dancer-2 --motion linear", "dancer-1 dancer-2"],
}
"""For each picture its rows: the two drawings, and what else the page says was on the command line."""

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
"""For each constant of the wire drawings, and its values from above to below."""

SHEETS |= {
    f"constant-{name}": [f"{blend} --{name} {value}" for blend, values in shown.items() for value in values]
    for name, shown in CONSTANTS.items()
}


def row(blend: str) -> list[str]:
    """The frames of a blend, both ends among them."""
    return frames(*_line(blend))


def moving() -> str:
    """Return the animation."""
    return animation(*_line(MOVING))


def _line(blend: str) -> list[str]:
    """Return the command line of a blend of two samples."""
    a, b, *options = blend.split()
    return [*(str(ROOT / "samples" / f"{sample}.svg") for sample in (a, b)), *options]


def frames(*line: str) -> list[str]:
    """Return the frames that the command makes, both ends among them."""
    with tempfile.TemporaryDirectory() as folder:
        _run(*line, "--ends", "--output", f"{folder}/frames")
        return [path.read_text(encoding="utf-8") for path in sorted(Path(folder, "frames").iterdir())]


def animation(*line: str) -> str:
    """Return the animated SVG that the command makes."""
    with tempfile.TemporaryDirectory() as folder:
        target = Path(folder, "moving.svg")
        _run(*line, "--output", str(target))
        return target.read_text(encoding="utf-8")


def _run(*line: str) -> None:
    if run([*line]) != 0:
        raise SystemExit(f"{' '.join(line)}: was not blended")


def drawn(name: str) -> Image.Image:
    """One of the pictures."""
    rows = [row(blend) for blend in SHEETS[name]]
    return sheet(
        [frame for each in rows for frame in each],
        len(rows[0]),
        SMALL if name.startswith("constant-") else CELL,
    ).quantize(64)


def main() -> None:
    (DOCS / "moving.svg").write_text(moving(), encoding="utf-8")
    for name in SHEETS:
        target = DOCS / f"{name}.png"
        drawn(name).save(target, optimize=True)
        print(target.relative_to(ROOT))


if __name__ == "__main__":
    main()
