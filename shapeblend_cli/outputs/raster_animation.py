"""Frames one after another in a GIF, a WebP or an animated PNG.

GIF: https://www.w3.org/Graphics/GIF/spec-gif89a.txt, WebP: https://developers.google.com/speed/webp/docs/riff_container,
animated PNG: https://www.w3.org/TR/png-3/
"""

from __future__ import annotations

import io
import math
import zlib
from itertools import accumulate, pairwise
from typing import TYPE_CHECKING, Any, NamedTuple

from shapeblend_cli.errors import OptionError, PictureError
from shapeblend_cli.options.easing import Timing
from shapeblend_cli.outputs.composed import Composed, at_once, draw_all
from shapeblend_cli.outputs.formats import FASTEST, Documents, OutputSpec, Rendered, frame_svgs
from shapeblend_cli.outputs.pixels import Size, check_libraries, read_png, size_of

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from PIL import Image

    from shapeblend_cli.model import Pair

MOST_RUNS = 65_535
"""Maximum number of runs in the file formats."""

COLOURS = 256
"""Number of colours of a picture in a GIF."""

MOST_COLOURS = 1 << 16
"""Maximum number of colours of a picture that is no photo."""

NEAR_COLOURS = 64
"""Number of values of red, green and blue among which those of a photo are told apart, to choose its colours."""


class Run(NamedTuple):
    """One run of an animation: its pairs of drawings, and the steps from each drawing to the next.

    All its pictures are shown for the same time, and all drawings are among them. If it runs backwards after forwards,
    neither end is shown twice.
    """

    pairs: int
    steps: int
    timing: Timing

    @property
    def pictures(self) -> int:
        """Number of pictures that are shown."""
        forwards = self.pairs * self.steps
        return 2 * forwards if self.timing.is_pingpong else forwards + 1

    @property
    def seconds(self) -> float:
        """Duration of the run, without rests."""
        return self.timing.seconds * self.pairs * (2 if self.timing.is_pingpong else 1)

    def order(self) -> list[int]:
        """Return the numbers of the pictures, from the first drawing to the last, in the order they are shown."""
        forwards = list(range(self.pairs * self.steps + 1))
        return forwards + forwards[-2:0:-1] if self.timing.is_pingpong else forwards

    def delays(self, units: int) -> list[int]:
        """Return the time of each picture, in `units` of a second, rounded without drift."""
        rests = [0.0, *accumulate(self.rest_at(number) for number in self.order())]
        ends = [
            round(k * self.seconds * units / self.pictures + rest * units) for k, rest in enumerate(rests)
        ]
        return [end - start for start, end in pairwise(ends)]

    def rest_at(self, number: int) -> float:
        """Return for how many seconds more the picture with a number is shown, as the drawing that it is."""
        return self.timing.rest_at(number, self.steps)


def run_for(fps: int | None, frames: int, pairs: int, timing: Timing) -> Run:
    """Return the run with the most pictures, no more than `fps` a second, or without that with `frames` in-betweens.

    Examples
    --------
    >>> [run_for(25, 5, 1, Timing(2.0, repeat=repeat)).pictures for repeat in (1, "pingpong")]
    [50, 100]
    """
    if fps is None:
        return Run(pairs, frames + 1, timing)
    # Forwards one picture more is shown than there are steps.
    steps = fps * timing.seconds - (0.0 if timing.is_pingpong else 1.0 / pairs)
    return Run(pairs, max(1, math.floor(steps + 1e-9)), timing)


def encode(spec: OutputSpec, svgs: Iterable[str | Composed], size: Size, run: Run) -> bytes:
    """Return a GIF, a WebP or an animated PNG of documents from the first drawing to the last; see `rasterize`.

    A GIF needs a background.
    """
    kind = spec.format.name
    pngs = [*draw_all(svgs, size, spec.ground)]
    runs = run.timing.repeat if isinstance(run.timing.repeat, int) else 0  # 0 is forever
    if kind == "gif":
        # The file has the number of repetitions, and nothing for one run.
        loop = {} if runs == 1 else {"loop": max(0, runs - 1)}
        delays = [10 * delay for delay in run.delays(100)]
        pictures = at_once(_reduced, [pngs[k] for k in run.order()])
        counted = (next(pictures) for _ in spec.counted(run.order(), "encoding"))
        return _save("GIF", counted, duration=delays, **loop)
    decoded = (read_png(pngs[k]) for k in spec.counted(run.order(), "encoding"))
    timing = {"duration": run.delays(1000), "loop": runs}
    if kind == "webp":
        # Without loss quality is effort; more than this takes twice as long for a hundredth. With loss, each picture
        # is written in the way that is smaller: gradients take a sixth, flat colours two thirds.
        how = (
            {"lossless": True, "quality": 40}
            if spec.lossless
            else {"quality": 80, "method": 4, "allow_mixed": True}
        )
        return _save("WEBP", decoded, **timing, **how)
    # Of photos, runs are found in a sixth of the time of repetitions, and take less.
    middle = read_png(pngs[len(pngs) // 2])
    how = {"compress_level": 1, "compress_type": zlib.Z_RLE} if _is_photo(middle) else {}
    return _save("PNG", decoded, **timing, **how)


def _is_photo(picture: Image.Image) -> bool:
    """Return whether a picture has more colours than drawings do."""
    return picture.getcolors(MOST_COLOURS) is None


def _reduced(png: bytes) -> Image.Image:
    """Return a picture with a palette of its own, since colours change; dithering would flicker."""
    from PIL import Image

    picture = read_png(png).convert("RGB")
    if _is_photo(picture):  # a fifth of the time
        step = 255.0 / (NEAR_COLOURS - 1)
        picture = picture.point([round(round(value / step) * step) for value in range(256)] * 3)
    method, dither = Image.Quantize.MEDIANCUT, Image.Dither.NONE
    return picture.quantize(COLOURS, method=method, dither=dither)


def _save(form: str, pictures: Iterable[Image.Image], **options: Any) -> bytes:
    file = io.BytesIO()
    first, *others = pictures
    first.save(file, form, save_all=True, append_images=others, **options)
    return file.getvalue()


def run_of(spec: OutputSpec) -> Run:
    """Return the run that an output asks for."""
    return run_for(spec.fps, spec.settings.frames, spec.drawings - 1, spec.timing)


def svgs_of(spec: OutputSpec, pairs: Sequence[Pair], run: Run) -> Documents:
    """Return the documents that a run shows, from the first drawing to the last."""
    return frame_svgs(spec, pairs, spec.settings.replace(frames=run.steps - 1, ends=True))


def render(spec: OutputSpec, pairs: Sequence[Pair]) -> Rendered:
    """Return the animation."""
    run = run_of(spec)
    size = size_of(spec.width, pairs, run.pictures)
    svgs = svgs_of(spec, pairs, run)
    return Rendered([encode(spec, spec.counted(svgs), size, run)])


def check(spec: OutputSpec) -> None:
    """Raise OptionError for an animation that its format, or browsers, cannot play."""
    run, repeat = run_of(spec), spec.timing.repeat
    if spec.format.name == "gif" and spec.ground is None:
        raise OptionError(
            "--background transparent: edges in a GIF cannot be half transparent; .webp, .apng or a colour would work"
        )
    if run.pictures > FASTEST * run.seconds * (1.0 + 1e-9):
        raise OptionError(
            f"{run.pictures} pictures in {run.seconds:g} seconds: browsers slow down animations of "
            f"more than {FASTEST} a second; a longer --duration, or fewer pictures, would work"
        )
    if isinstance(repeat, int) and repeat > MOST_RUNS:
        raise OptionError(f"--repeat {repeat}: raster animations run {MOST_RUNS} times at most, or forever")


def check_webp() -> None:
    """Raise PictureError where WebP cannot be written."""
    check_libraries()
    from PIL import features

    if not features.check("webp"):
        raise PictureError("the installed Pillow cannot write WebP; .apng would work")
