"""From files to a drawing of several states."""

from __future__ import annotations

import re
from pathlib import PurePath
from typing import TYPE_CHECKING

from shapeblend_cli.errors import OptionError
from shapeblend_cli.interpolate.stars import star_shapes
from shapeblend_cli.job.make import SLOW, match_files
from shapeblend_cli.job.targets import check_output, write_output
from shapeblend_cli.matching.solve import COMPILED
from shapeblend_cli.model import Box
from shapeblend_cli.outputs.formats import page_of, views
from shapeblend_cli.paint.names import page_for
from shapeblend_cli.paint.page_colour import with_page_colour
from shapeblend_cli.svg.writing.rounding import decimals_for
from shapeblend_cli.svg.writing.state_document import States, states_js, states_svg
from shapeblend_cli.system.clock import Clock

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from shapeblend_cli.job.options import StatesOptions
    from shapeblend_cli.options.settings import ReadOptions, Settings


def write_states(
    files: Sequence[str],
    read: ReadOptions,
    settings: Settings,
    options: StatesOptions,
    note: Callable[[str], None],
    progress: Callable[[str, float], None],
) -> None:
    """Read files, match each with the first, and write one drawing with a state for each."""
    if not COMPILED:
        note(SLOW)
    element = element_name(options) if options.output.lower().endswith(".js") else None
    if element is None and options.element is not None:
        raise OptionError(
            f"--element is for a custom element, a name ending in .js, not for --output {options.output}"
        )
    check_output(options.output, files, options.force)
    alone = [tuple(float(k == j) for j in range(len(files))) for k in range(len(files))]
    settings = settings.replace(mix=alone, motion="linear", unmatched="point")
    matched = match_files(files, read, settings, Clock(), note, progress)
    pairs, notes = with_page_colour(matched, settings.style)
    for text in notes:
        note(text)
    shown = Box.union(views(pairs))
    shapes = star_shapes(pairs)
    if any(key.style.fill_gradient or key.style.stroke_gradient for shape in shapes for key in shape.keys):
        note("gradients become plain colours in states, because CSS has no transitions of gradients")
    decimals = decimals_for(views(pairs)) if options.precision is None else options.precision
    states = States(
        shapes,
        names_of(files),
        shown,
        page_for(page_of(pairs), shown),
        options.duration,
        settings.ease,
        decimals,
    )
    trigger = None if options.trigger == "none" else options.trigger
    written = states_js(states, element, trigger) if element else states_svg(states, trigger)
    write_output(options.output, written, options.force)


def names_of(files: Sequence[str]) -> list[str]:
    """Return the names of states: names of files without folder and suffix, numbered where two are alike.

    Examples
    --------
    >>> names_of(["on/wifi.svg", "off/wifi.svg", "-"])
    ['wifi', 'wifi-2', 'state-3']
    """
    names: list[str] = []
    for k, file in enumerate(files, 1):
        stem = re.sub(r"[^\w.-]+", "-", PurePath(file).stem).strip("-") or f"state-{k}"
        name, number = stem, 1
        while name in names:
            number += 1
            name = f"{stem}-{number}"
        names.append(name)
    return names


def element_name(options: StatesOptions) -> str:
    """Return the name of a custom element, by default its file's; such names have a hyphen."""
    if options.element is not None:
        return options.element
    stem = re.sub(r"[^a-z0-9-]+", "-", PurePath(options.output).stem.lower()).strip("-")
    name = stem if "-" in stem else f"{stem}-states"
    if not re.match("[a-z]", name):
        raise OptionError(f"{options.output}: elements begin with a letter; --element shape-icon would work")
    return name
