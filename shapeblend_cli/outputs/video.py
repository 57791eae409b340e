"""Frames one after another in a video, MP4 or WebM, which the program ffmpeg makes of pictures."""

from __future__ import annotations

import shutil
import subprocess
import tempfile
from contextlib import suppress
from fractions import Fraction
from pathlib import Path
from subprocess import PIPE
from typing import TYPE_CHECKING

from shapeblend_cli.errors import OptionError, PictureError
from shapeblend_cli.outputs import pixels
from shapeblend_cli.outputs.composed import draw_all
from shapeblend_cli.outputs.formats import OutputSpec, Rendered
from shapeblend_cli.outputs.pixels import size_of
from shapeblend_cli.outputs.raster_animation import run_of, svgs_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import Pair

EVEN = "pad=ceil(iw/2)*2:ceil(ih/2)*2"
"""Filter that makes both sides even, as codecs require, by a line below and a column on the right."""

CODECS = {
    "mp4": "-c:v libx264 -preset medium -crf 18 -pix_fmt yuv420p -movflags +faststart",
    # What is transparent is a second video, which is larger than the first.
    "webm": "-c:v libvpx-vp9 -b:v 0 -crf 32 -cpu-used 2 -row-mt 1",
    "transparent webm": "-c:v libvpx-vp9 -b:v 0 -crf 44 -cpu-used 3 -row-mt 1",
}

EXACT = ["-map_metadata", "-1", "-fflags", "+bitexact", "-flags:v", "+bitexact"]
"""Options that give the same bytes for the same pictures."""

MOST_RUNS = 100
"""Maximum number of runs. Players can repeat a video that should run more often."""

MOST_FRAMES = 20_000


def encode(spec: OutputSpec, pngs: Sequence[bytes], order: Sequence[int], rate: Fraction) -> bytes:
    """Return a video of pictures in an order, at a rate a second. A WebM without a ground is transparent."""
    kind = spec.format.name
    codec = CODECS[kind if spec.ground is not None else f"transparent {kind}"]
    program = shutil.which("ffmpeg")
    assert program is not None, "that was checked"
    pixels = ["-pix_fmt", "yuva420p" if spec.ground is None else "yuv420p"] if kind == "webm" else []
    with tempfile.TemporaryDirectory(prefix="shapeblend-") as folder:
        file = Path(folder, f"video.{kind}")
        pictures = ["-f", "image2pipe", "-c:v", "png", "-framerate", str(rate), "-i", "-"]
        form = ["-vf", EVEN, *codec.split(), *pixels, *EXACT]
        command = [program, "-v", "error", "-y", *pictures, *form, str(file)]
        try:
            errors = Path(folder, "errors")
            with errors.open("wb") as said, subprocess.Popen(command, stdin=PIPE, stderr=said) as running:
                assert running.stdin is not None, "it was asked for"
                # ffmpeg takes pictures as fast as it encodes them; if it has ended, its errors say why.
                with suppress(BrokenPipeError), running.stdin:
                    for k in spec.counted(order, "encoding"):
                        running.stdin.write(pngs[k])
        except OSError as error:
            raise PictureError(
                f"ffmpeg cannot be run ({error.strerror}); .gif, .webp and .apng would work"
            ) from None
        if running.returncode or not file.exists():
            lines = errors.read_text("utf-8", "replace").strip().splitlines() or ["it gives no reason"]
            raise PictureError(
                f"ffmpeg cannot make the .{kind}: {lines[-1][:200]}; .gif, .webp and .apng would work"
            )
        return file.read_bytes()


def render(spec: OutputSpec, pairs: Sequence[Pair]) -> Rendered:
    """Return the video."""
    run = run_of(spec)
    size = size_of(spec.width, pairs)
    pngs = [*draw_all(spec.counted(svgs_of(spec, pairs, run)), size, spec.ground)]
    runs = spec.timing.repeat if isinstance(spec.timing.repeat, int) else 1
    rate = Fraction(run.pictures) / Fraction(run.seconds).limit_denominator(1000)
    order = [k for k in run.order() for _ in range(1 + round(run.rest_at(k) * rate))]
    return Rendered([encode(spec, pngs, order * runs, rate)])


def check(spec: OutputSpec) -> None:
    """Raise OptionError for a video that its format cannot hold, or that is too long."""
    run, repeat = run_of(spec), spec.timing.repeat
    if spec.format.name == "mp4" and spec.ground is None:
        raise OptionError(
            "--background transparent: an MP4 cannot be transparent; .webm or a colour would work"
        )
    if isinstance(repeat, int) and repeat > MOST_RUNS:
        raise OptionError(
            f"--repeat {repeat}: a video has {MOST_RUNS} runs at most, and players can repeat it"
        )
    if run.pictures > MOST_FRAMES:
        raise OptionError(
            f"{run.pictures} pictures are more than {MOST_FRAMES}; a shorter --duration would work"
        )


def check_ffmpeg() -> None:
    """Raise PictureError where pictures cannot be drawn, or ffmpeg is missing."""
    pixels.check_libraries()
    if shutil.which("ffmpeg") is None:
        raise PictureError(
            "videos need the program ffmpeg, which is not installed (apt-get install ffmpeg, brew install ffmpeg); "
            ".gif, .webp and .apng would work"
        )
