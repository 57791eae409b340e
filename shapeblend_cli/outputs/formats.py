"""The forms a blend is written in: what is asked for, and the files that come of it.

The command line looks here before anything else is imported, so this imports nothing heavy.
"""

from __future__ import annotations

from os.path import join
from typing import NamedTuple

STANDARD_OUTPUT = "-"

PAIR_FILES = ("a.svg", "b.svg")
"""The names of a pair in its folder."""


class Form(NamedTuple):
    """A form a blend is written in.

    Attributes
    ----------
    output : str
        Where it goes unless something is said.
    suffix : str
        What the name of its one file ends in; empty where it goes into a folder.
    sequence : bool
        Whether it takes more than two drawings.
    """

    output: str
    suffix: str
    sequence: bool


FORMS = {
    "frames": Form("blend", "", True),
    "pair": Form("blend", "", False),
    "lottie": Form("blend.json", ".json", True),
    "avd": Form("blend.xml", ".xml", False),
}
"""By their names on the command line."""


FRAME_KINDS = ("svg", "png")
"""What is written as a file a frame; the names of the files end in it."""

SUFFIXES = {".svg": "animation", ".png": "sheet", ".gif": "gif", ".webp": "webp", ".apng": "apng"}
"""What a file is that frames go into, by what its name ends in."""

PAGES = (".htm", ".html")
"""What names of pages end in."""

NOT_WRITTEN = (
    *(
        ".avi",
        ".avif",
        ".bmp",
        ".eps",
        ".heic",
        ".ico",
        ".jpeg",
        ".jpg",
        ".jxl",
        ".m4v",
        ".mkv",
    ),
    *(".mov", ".mp4", ".mpeg", ".mpg", ".ogv", ".pdf", ".ps", ".svgz", ".tif", ".tiff", ".webm", ".zip"),
)
"""What names end in that nobody gives a folder."""


def kind_of(emit: str, output: str, frame_format: str | None) -> str:
    """Say what is made.

    Parameters
    ----------
    emit : str
        A name of `FORMS`.
    output : str
        A folder, the name of a file, or ``-``.
    frame_format : str or None
        Of the files in a folder.

    Returns
    -------
    str
        ``pair``, ``lottie`` or ``avd``; ``svg`` or ``png``: a file a frame; ``animation``: an SVG that moves;
        ``sheet``: a PNG with all frames; ``gif``, ``webp`` or ``apng``.
    """
    if emit != "frames":
        return emit
    if output == STANDARD_OUTPUT:
        return "animation"
    return SUFFIXES.get(_suffix(output)) or frame_format or "svg"


def problem(emit: str, output: str, files: int) -> str | None:
    """Say why a form cannot be written so, if it cannot.

    Parameters
    ----------
    emit : str
        A name of `FORMS`.
    output : str
        A folder, the name of a file, or ``-``.
    files : int
        How many drawings are blended.
    """
    form = FORMS[emit]
    if files > 2 and not form.sequence:
        return f"--emit {emit} takes two files; {files} given"
    suffix = _suffix(output)
    if form.suffix and suffix != form.suffix and output != STANDARD_OUTPUT:
        return f"--emit {emit} writes one file, so --output takes a name ending in {form.suffix}, or -; {output} given"
    if emit == "pair" and (suffix or output == STANDARD_OUTPUT):
        return f"--emit pair writes two files, so --output takes a folder; {output} given"
    if emit == "frames" and suffix in (".json", ".xml"):
        other = next(name for name, known in FORMS.items() if known.suffix == suffix)
        return f"--output {output}: with --emit {other} such a file is written"
    if suffix in PAGES:
        return f"--output {output}: such a page is written with --preview {output}"
    if suffix in NOT_WRITTEN:
        return (
            f"--output {output}: {suffix} is not written; {', '.join(SUFFIXES)} are, and frames into a folder"
        )
    return None


def _suffix(output: str) -> str:
    """What the name of a file ends in; empty for a folder and for standard output."""
    forms = (form.suffix for form in FORMS.values() if form.suffix)
    known = (*SUFFIXES, *forms, *PAGES, *NOT_WRITTEN)
    return next((suffix for suffix in known if output.lower().endswith(suffix)), "")


def frame_names(kind: str, frames: int) -> list[str]:
    """The names of frame files in order of time, padded with zeros to one width."""
    return [f"frame-{k + 1:0{len(str(frames))}d}.{kind}" for k in range(frames)]


def file_names(kind: str, output: str, frames: int) -> list[str]:
    """The files that are written, in order; none for standard output.

    Parameters
    ----------
    kind : str
        See `kind_of`.
    output : str
        A folder, the name of a file, or ``-``.
    frames : int
        How many there are.
    """
    if output == STANDARD_OUTPUT:
        return []
    if kind in FRAME_KINDS:
        return [join(output, name) for name in frame_names(kind, frames)]
    return [join(output, name) for name in PAIR_FILES] if kind == "pair" else [output]
