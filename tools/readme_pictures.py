"""Draw the contact sheets of the README with the tool itself: readme_pictures.py, no arguments."""

from __future__ import annotations

import tempfile
from pathlib import Path

from contact_sheet import sheet

from shapeblend_cli.cli import run

ROOT = Path(__file__).resolve().parents[1]

# Picture, the two drawings, and what else the README says was on the command line.
SHEETS = [
    ("letters", "e", "f", []),
    ("triangle-square", "triangle", "square", []),
    ("step", "step-1", "step-2", []),
    ("bird", "bird-1", "bird-2", []),
    ("animals", "cow", "deer", ["--preset", "fig27"]),
    ("dancer", "dancer-1", "dancer-2", ["--preset", "fig27"]),
]


def main() -> None:
    for name, a, b, options in SHEETS:
        with tempfile.TemporaryDirectory() as folder:
            files = [str(ROOT / "samples" / f"{sample}.svg") for sample in (a, b)]
            if run([*files, "--ends", "--output", f"{folder}/frames", *options]) != 0:
                raise SystemExit(f"{name} was not blended")
            frames = [path.read_text(encoding="utf-8") for path in sorted(Path(folder, "frames").iterdir())]
        target = ROOT / "docs" / f"{name}.png"
        sheet(frames, len(frames), 140).quantize(64).save(target, optimize=True)
        print(target.relative_to(ROOT))


if __name__ == "__main__":
    main()
