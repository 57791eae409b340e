"""The forms a blend is written in: what is asked for, and the files that come of it.

The command line looks here before anything else is imported, so this imports nothing.
"""

from __future__ import annotations

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
    suffix = next((s for s in (".svg", ".json", ".xml") if output.lower().endswith(s)), None)
    if form.suffix and suffix != form.suffix and output != STANDARD_OUTPUT:
        return f"--emit {emit} writes one file, so --output takes a name ending in {form.suffix}, or -; {output} given"
    if emit == "pair" and (suffix or output == STANDARD_OUTPUT):
        return f"--emit pair writes two files, so --output takes a folder; {output} given"
    if emit == "frames" and suffix in (".json", ".xml"):
        other = next(name for name, known in FORMS.items() if known.suffix == suffix)
        return f"--output {output}: with --emit {other} such a file is written"
    return None


def file_names(emit: str, output: str) -> list[str]:
    """The files of any form but frames, in order; none for standard output."""
    if output == STANDARD_OUTPUT:
        return []
    return [output] if FORMS[emit].suffix else [f"{output}/{name}" for name in PAIR_FILES]
