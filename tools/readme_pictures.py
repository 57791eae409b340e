"""Draw the contact sheets of the README with the tool itself: readme_pictures.py, no arguments."""

from __future__ import annotations

import tempfile
from pathlib import Path

from contact_sheet import sheet

from shapeblend_cli.cli import run

ROOT = Path(__file__).resolve().parents[1]

# For each picture its rows: the two drawings, and what else the README says was on the command line.
SHEETS = {
    "letters": ["e f"],
    "triangle-square": ["triangle square"],
    "bird": ["bird-1 bird-2"],
    "animals": ["cow deer --preset fig27"],
    "step": ["step-1 step-2 --motion linear", "step-1 step-2"],
    "dancer": ["dancer-1 dancer-2 --preset fig28 --motion linear", "dancer-1 dancer-2 --preset fig28"],
}


def row(blend: str) -> list[str]:
    """The frames of a blend, both ends among them."""
    a, b, *options = blend.split()
    files = [str(ROOT / "samples" / f"{sample}.svg") for sample in (a, b)]
    with tempfile.TemporaryDirectory() as folder:
        if run([*files, "--ends", "--output", f"{folder}/frames", *options]) != 0:
            raise SystemExit(f"{blend} was not blended")
        return [path.read_text(encoding="utf-8") for path in sorted(Path(folder, "frames").iterdir())]


def main() -> None:
    for name, blends in SHEETS.items():
        rows = [row(blend) for blend in blends]
        target = ROOT / "docs" / f"{name}.png"
        sheet([frame for frames in rows for frame in frames], len(rows[0]), 140).quantize(64).save(
            target, optimize=True
        )
        print(target.relative_to(ROOT))


if __name__ == "__main__":
    main()
