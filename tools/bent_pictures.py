"""Time how fast frames with bent pictures are made, for docs/guide.md: `make bench-bent`.

Two pictures of 512 x 512 pixels, made of noise of all sizes as photos have it, each clipped by an outline: a disc that
becomes a heart. Whole commands are timed, from the start of Python to the last file, without and with shapes around the
pictures. The best of ROUNDS is printed: frames a second, and seconds of processor time for a frame.

`python -m tools.bent_pictures [ROUNDS] [FRAMES]`, by default 3 and 60.
"""

from __future__ import annotations

import base64
import io
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
from PIL import Image

SIDE = 512

OUTLINES = (
    "M496 256A240 240 0 1 1 16 256A240 240 0 1 1 496 256Z",
    "M256 470C110 360 24 250 24 160C24 80 76 40 140 40C190 40 232 72 256 116"
    "C280 72 322 40 372 40C436 40 488 80 488 160C488 250 402 360 256 470Z",
)

GROUND = '<path d="M0 0H512V512H0Z" fill="#eeeeec"/>'

AROUND = {
    "pictures alone": "{}",
    "on a ground, with outlines": GROUND
    + '{}<path d="OUTLINE" fill="none" stroke="#2e3436" stroke-width="6"/>',
    "in a shadow": '<filter id="f"><feDropShadow dx="4" dy="4" stdDeviation="6"/></filter><g filter="url(#f)">{}</g>',
}
"""Drawings, by what is around their picture."""

OUTPUTS = {
    "PNG files": ("--format", "png", "-o", "frames"),
    "GIF": ("-o", "a.gif"),
    "animated PNG": ("-o", "a.apng"),
}


def photo(seed: int) -> bytes:
    """Return a PNG of coloured noise of all sizes."""
    rng = np.random.default_rng(seed)
    pixels = rng.normal(0.0, 3.0, (SIDE, SIDE, 3))
    for k in range(2, 9):
        coarse = Image.fromarray(rng.integers(0, 256, (1 << k, 1 << k, 3)).astype(np.uint8))
        pixels += np.asarray(coarse.resize((SIDE, SIDE), Image.Resampling.BICUBIC), float) / (1 << k - 1)
    pixels -= pixels.min()
    file = io.BytesIO()
    Image.fromarray((255.0 * pixels / pixels.max()).astype(np.uint8)).save(file, "PNG")
    return file.getvalue()


def write_drawings(folder: Path, around: str) -> None:
    """Write both drawings."""
    for k, outline in enumerate(OUTLINES):
        link = f"data:image/png;base64,{base64.b64encode(photo(k)).decode()}"
        picture = f'<image width="{SIDE}" height="{SIDE}" clip-path="url(#c)" href="{link}"/>'
        drawn = around.replace("OUTLINE", outline).format(picture)
        text = f'<clipPath id="c"><path d="{outline}"/></clipPath>{drawn}'
        svg = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {SIDE} {SIDE}">{text}</svg>'
        (folder / f"{k}.svg").write_text(svg, "utf-8")


def timed(folder: Path, frames: int, output: tuple[str, ...]) -> tuple[float, float]:
    """Return how long a command takes, in seconds of the clock and of processors."""
    command = [
        sys.executable,
        "-m",
        "shapeblend_cli",
        "0.svg",
        "1.svg",
        "-q",
        "--force",
        "--width",
        str(SIDE),
    ]
    clock, before = time.perf_counter(), os.times()
    subprocess.run([*command, "-n", str(frames), *output], cwd=folder, check=True)
    seconds, after = time.perf_counter() - clock, os.times()
    spent = after.children_user + after.children_system - before.children_user - before.children_system
    return seconds, spent


def main(rounds: int = 3, frames: int = 60) -> None:
    """Print a line for each drawing and output."""
    print(f"{frames} frames of {SIDE} x {SIDE} pixels, {os.cpu_count()} processors")
    for name, around in AROUND.items():
        with tempfile.TemporaryDirectory() as folder:
            write_drawings(Path(folder), around)
            for output, options in OUTPUTS.items():
                times = [timed(Path(folder), frames, options) for _ in range(rounds)]
                seconds, spent = (min(column) for column in zip(*times, strict=True))
                rate = f"{frames / seconds:6.1f} frames a second, {1000.0 * spent / frames:6.1f} ms of processor time"
                print(f"{name:28} {output:14} {seconds:6.2f} s {rate}", flush=True)


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
