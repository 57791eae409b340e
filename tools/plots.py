"""Draw the plots of docs/plots.md with the command itself: plots.py, no arguments."""

from __future__ import annotations

import tempfile
from pathlib import Path

from shapeblend_cli.cli import run

ROOT = Path(__file__).resolve().parents[1]

PLOTS = {
    "graph": "cow deer --preset fig27",
    "angle": "cow deer --preset fig27",
}
"""The samples of each plot, and what else docs/plots.md says was on the command line."""


def plot(kind: str) -> str:
    """One of the plots."""
    a, b, *options = PLOTS[kind].split()
    files = [str(ROOT / "samples" / f"{sample}.svg") for sample in (a, b)]
    with tempfile.TemporaryDirectory() as folder:
        target = Path(folder, "plot.svg")
        if run(["plot", kind, *files, *options, "--output", str(target)]) != 0:
            raise SystemExit(f"{kind} was not drawn")
        return target.read_text(encoding="utf-8")


def main() -> None:
    for kind in PLOTS:
        (ROOT / "docs" / f"plot-{kind}.svg").write_text(plot(kind), encoding="utf-8")


if __name__ == "__main__":
    main()
