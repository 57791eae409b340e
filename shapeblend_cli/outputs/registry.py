"""All formats, and the choice of one by ``--emit``, ``--output`` and ``--format``."""

from __future__ import annotations

import os
import re
from pathlib import Path
from typing import TYPE_CHECKING

from shapeblend_cli.errors import OptionError
from shapeblend_cli.outputs.formats import STANDARD_OUTPUT, TRANSPARENT, WHITE, Format
from shapeblend_cli.system.write import is_stream

if TYPE_CHECKING:
    from collections.abc import Sequence


_PICTURES = Format(
    "png",
    "one file for each frame",
    "frame_files.render_png",
    takes_times=True,
    takes_stagger=True,
    mixtures="several",
    defaults={"width": 512, "background": TRANSPARENT},
    libraries="pixels.check_libraries",
)

_FRAMES = _PICTURES._replace(
    name="svg",
    renderer="frame_files.render_svg",
    defaults={},
    libraries="",
    takes_page_colour=True,
    takes_text=True,
)

_GIF = Format(
    "gif",
    "a raster animation",
    "raster_animation.render",
    suffix=".gif",
    plays=True,
    takes_stagger=True,
    defaults={"width": 400, "background": WHITE, "fps": 25},
    checker="raster_animation.check",
    libraries="pixels.check_libraries",
)

_MP4 = _GIF._replace(
    name="mp4",
    help="a video, made with ffmpeg",
    renderer="video.render",
    suffix=".mp4",
    defaults={**_GIF.defaults, "width": 640},
    checker="video.check",
    libraries="video.check_ffmpeg",
)

_CLEAR = {**_GIF.defaults, "background": TRANSPARENT}

FORMATS: tuple[Format, ...] = (
    _FRAMES,
    _PICTURES,
    Format(
        "animated svg",
        "one animated SVG",
        "animated_svg.render",
        suffix=".svg",
        to_standard_output=True,
        takes_stagger=True,
        plays=True,
        takes_triggers=True,
        mixtures="one",
        takes_page_colour=True,
        takes_text=True,
    ),
    Format(
        "contact sheet",
        "a contact sheet of all frames",
        "contact_sheet.render",
        suffix=".png",
        takes_times=True,
        takes_stagger=True,
        mixtures="several",
        defaults={"width": 200, "columns": None, "background": WHITE},
        checker="contact_sheet.check",
        libraries="pixels.check_libraries",
    ),
    _GIF,
    _GIF._replace(name="webp", suffix=".webp", defaults=_CLEAR, libraries="raster_animation.check_webp"),
    _GIF._replace(name="apng", suffix=".apng", defaults=_CLEAR),
    _MP4,
    _MP4._replace(name="webm", suffix=".webm", defaults={**_MP4.defaults, "background": TRANSPARENT}),
    Format(
        "pair",
        "A and B as SVG files with the same path commands, for other programs to morph",
        "svg_pair.render",
        emit="pair",
        files=("a.svg", "b.svg"),
        takes_sequences=False,
        motion="linear",  # as programs move between two files
        takes_page_colour=True,
    ),
    Format(
        "layers",
        "one SVG with all frames as layers of Inkscape",
        "frame_files.render_layers",
        emit="layers",
        suffix=".svg",
        to_standard_output=True,
        takes_times=True,
        takes_stagger=True,
        checker="frame_files.check_layers",
        takes_page_colour=True,
        takes_text=True,
    ),
    Format(
        "lottie",
        "a Lottie animation (JSON)",
        "lottie.lottie.render",
        emit="lottie",
        takes_stagger=True,
        plays=True,
        suffix=".json",
        to_standard_output=True,
    ),
    Format(
        "dotlottie",
        "a Lottie animation in a zip file",
        "lottie.lottie.render_archive",
        emit="lottie",
        takes_stagger=True,
        plays=True,
        suffix=".lottie",
    ),
    Format(
        "js",
        "a JavaScript module that plays the blend in web pages, without other libraries",
        "animated_svg.render_module",
        emit="js",
        plays=True,
        suffix=".js",
        to_standard_output=True,
        takes_stagger=True,
        checker="animated_svg.check_module",
        takes_page_colour=True,
    ),
    Format(
        "avd",
        "an animated vector drawable for Android",
        "avd.render",
        emit="avd",
        takes_stagger=True,
        plays=True,
        suffix=".xml",
        to_standard_output=True,
        takes_sequences=False,
    ),
)

EMITS = tuple(dict.fromkeys(format.emit for format in FORMATS))
"""Values of ``--emit``, the default first."""

FRAME_FORMATS = tuple(format.name for format in FORMATS if format.has_frame_files)
"""Values of ``--format``, the default first."""

DEFAULT = "blend"
"""Default folder of outputs, and the default name of a file without its suffix."""

PAGES = (".htm", ".html")
"""Suffixes of web pages, the files of ``--preview``."""

LIKE = dict.fromkeys((".jsx", ".tsx", ".ts", ".mjs", ".vue", ".svelte"), ".js") | {
    ".mov": ".mp4",
    ".avi": ".mp4",
}
"""Suffixes that are not written, and those of formats for the same purpose."""

ENDING = r"(?i)\.[a-z][a-z0-9]{0,5}$"
"""End of a name that is taken for the suffix of a file."""


def choose(emit: str, path: str | None, frame_format: str | None, drawings: int) -> tuple[Format, str]:
    """Return the format that is asked for, and the path that is written to.

    The path is a folder, the name of a file, a device or pipe, or ``-``; of `FRAME_FORMATS`, folders alone have one.
    Two or more drawings are blended. Raises OptionError if no format is written so.
    """
    formats = [format for format in FORMATS if format.emit == emit]
    if path and emit == EMITS[0]:  # the suffix chooses
        taken = {format.suffix for format in formats}
        formats += [format for format in FORMATS if format.suffix and format.suffix not in taken]
    path = path or DEFAULT + formats[0].suffix
    suffix = _suffix(path)
    goes_out = path == STANDARD_OUTPUT or (not suffix and is_stream(Path(path)))
    for format in formats:
        fits = format.to_standard_output if goes_out else format.suffix == suffix
        if fits and (not format.has_frame_files or format.name == (frame_format or FRAME_FORMATS[0])):
            if drawings > 2 and not format.takes_sequences:
                raise OptionError(f"{_asked(emit, path)} takes two files; {drawings} given")
            return format, path
    if emit != EMITS[0]:
        names, endings = " and ".join(formats[0].files), " or ".join(f.suffix for f in formats if f.suffix)
        what = f"{names}, so --output takes a folder"
        if endings:
            what = f"one file, so --output takes a name ending in {endings}, or -"
        raise OptionError(f"--emit {emit} writes {what}; {path} given")
    if suffix in PAGES:
        raise OptionError(f"--output {path}: --preview {path} writes a page of this kind")
    if suffix in LIKE:
        would = f"{path[: -len(suffix)]}{LIKE[suffix]}"
        kind = next(format.help for format in FORMATS if format.suffix == LIKE[suffix])
        raise OptionError(f"--output {path}: {suffix} cannot be written; {would} would work, {kind}")
    others = ", ".join(dict.fromkeys(format.suffix for format in formats if format.suffix))
    raise OptionError(
        f"--output {path}: {suffix} cannot be written; {others} would work, or {path}/ for a folder of frames"
    )


def _asked(emit: str, path: str) -> str:
    return f"--output {path}" if emit == EMITS[0] else f"--emit {emit}"


def alternatives(words: Sequence[str]) -> str:
    """Return words as in "a, b or c"."""
    return " or ".join([", ".join(words[:-1]), words[-1]]) if len(words) > 1 else words[0]


def _suffix(path: str) -> str:
    """Return the suffix of a file's name, in lower case; empty for a folder and for standard output."""
    known = [format.suffix for format in FORMATS if format.suffix and path.lower().endswith(format.suffix)]
    if known:
        return max(known, key=len)
    found = re.search(ENDING, path)
    return found[0].lower() if found and not os.path.isdir(path) else ""
