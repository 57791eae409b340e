"""How far the ends of blends are from their files, as Chromium draws both: python -m tools.ends FOLDER [--moving].

Each SVG file of FOLDER is drawn in Chromium, and so is the frame that `--ends` writes for it, on white, 512 pixels the
longer side. Prints the files with too many different pixels, the worst first, and how many files are within the limit;
out/ends has pictures of the others: the file, the frame, and where they differ. With `--moving` the frame is the one
with which a blend of the file with itself begins to move: there lines may have been recovered from outlines.
"""

from __future__ import annotations

import re
import signal
import sys
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from PIL import Image

from shapeblend_cli.blending.placing import as_drawn
from shapeblend_cli.errors import InputError, ShapeblendError
from shapeblend_cli.frames.frames import frame_at
from shapeblend_cli.model import Frame
from shapeblend_cli.options.settings import Settings
from shapeblend_cli.pipeline import match_all
from shapeblend_cli.svg.reading.read import read
from shapeblend_cli.svg.writing.document import frame_svg
from shapeblend_cli.svg.writing.rounding import decimals_for
from tools.quality.data import ROOT

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from playwright.sync_api import Browser, Page

OUT = ROOT / "out" / "ends"

SIDE = 512
"""Pixels of the longer side of a picture."""

FINER = 3
"""How many times finer both are drawn before they are reduced, in pixels: letters lie on whole pixels, and edges that
a mask and a shape share are fainter, where that is drawn.
"""

DIFFERENT = 32
"""Minimum difference of a pixel that counts, of red, green or blue from 0 to 255: edges that are a tenth of a pixel
elsewhere stay below it.
"""

SHARE = 0.005
"""Maximum share of different pixels of a frame that looks like its file."""

LETTERS = b' text-rendering="geometricPrecision"'
"""What a file is given, so that its letters are drawn as the outlines they are, and not fitted to pixels."""

SECONDS = 20
"""Maximum time of one blend; after that the drawing itself is measured."""

STRETCHED = b'preserveAspectRatio="none"'
"""What a file has whose picture is stretched to the size of the page."""

PAGE = """<!doctype html><style>body {{ margin: 0; background: #fff }} img {{ display: block; position: absolute;
top: 0; width: {width}px; height: {height}px }}</style><img src="{file}"><img style="left: {width}px" src="{frame}">"""


class Measured(NamedTuple):
    """A file, its share of different pixels or None, and what was said about it."""

    name: str
    share: float | None
    notes: Sequence[str]

    @property
    def is_within(self) -> bool:
        return self.share is not None and self.share <= SHARE


@contextmanager
def time_limit(seconds: int) -> Iterator[None]:
    """Raise TimeoutError after so many seconds."""

    def late(*_: object) -> None:
        raise TimeoutError(f"as it is drawn: no blend after {seconds} s")

    before = signal.signal(signal.SIGALRM, late)
    signal.alarm(seconds)
    try:
        yield
    finally:
        signal.alarm(0)
        signal.signal(signal.SIGALRM, before)


def end_frame(file: Path, *, is_moving: bool) -> tuple[str, tuple[int, int], list[str]]:
    """Return the frame of a file, its size in pixels, and the notes."""
    drawing = read(str(file), lenient=True)
    notes = [*drawing.notes]
    if drawing.viewbox is None:
        raise InputError(str(file), "it has no size; a viewBox would work")
    frame = Frame(0.0, 0, as_drawn(drawing), drawing.viewbox)
    if is_moving:
        try:
            with time_limit(SECONDS):
                (pair,), own = match_all([drawing, drawing], Settings())
            frame = frame_at(pair, 0.0, as_drawn=False)
            notes += own
        except TimeoutError as error:
            notes.append(str(error))
    longer = max(frame.view.width, frame.view.height)
    width, height = (
        max(round(SIDE * length / longer), 1) for length in (frame.view.width, frame.view.height)
    )
    text = frame_svg(frame, decimals_for([frame.view]))
    root = re.search(rb"<(?:\w+:)?svg\b[^>]*", file.read_bytes())
    if root and (b"viewBox" not in root[0] or STRETCHED in root[0]):  # browsers stretch such a file
        text = text.replace("<svg ", '<svg preserveAspectRatio="none" ', 1)
    return text, (width, height), notes


def page_in(browser: Browser) -> Page:
    """Return a page of a browser, in which `measured` draws."""
    return browser.new_page(device_scale_factor=FINER)


def pictures(page: Page, file: Path, frame: Path, size: tuple[int, int]) -> list[Any]:
    """Return how Chromium draws a file and a frame, in a size: red, green and blue from 0 to 255 of each pixel."""
    from tests.support.chromium import picture_of

    width, height = size
    document = frame.with_suffix(".html")
    document.write_text(
        PAGE.format(width=width, height=height, file=file.as_uri(), frame=frame.as_uri()), "utf-8"
    )
    page.set_viewport_size({"width": 2 * width, "height": height})
    page.goto(document.as_uri())
    both = np.asarray(picture_of(page).reduce(FINER), int)
    return [both[:, :width], both[:, width:]]


def measured(page: Page, file: Path, out: Path, *, is_moving: bool) -> Measured:
    """Measure one file; where too much differs, write the frame and the pictures beside each other into `out`."""
    name = file.stem
    try:
        text, size, notes = end_frame(file, is_moving=is_moving)
    except ShapeblendError as error:
        return Measured(name, None, [str(error)])
    with TemporaryDirectory() as folder:
        frame, original = Path(folder) / "frame.svg", Path(folder) / "original.svg"
        frame.write_text(text, "utf-8")
        original.write_bytes(re.sub(rb"<(\w+:)?svg(?=\s)", rb"\g<0>" + LETTERS, file.read_bytes(), count=1))
        drawn = pictures(page, original, frame, size)
    different = np.abs(drawn[0] - drawn[1]).max(axis=2) >= DIFFERENT
    found = Measured(name, float(different.mean()), notes)
    if not found.is_within:
        where = np.repeat(np.where(different, 0, 255)[..., None], 3, axis=2)
        Image.fromarray(np.hstack([*drawn, where]).astype(np.uint8)).save(out / f"{name}.png")
        (out / f"{name}.svg").write_text(text, "utf-8")
    return found


def table(found: Sequence[Measured]) -> Iterator[str]:
    """Return a line for each file that is not within the limit, the worst first, and how many files are."""
    for one in sorted(found, key=lambda one: -1.0 if one.share is None else -one.share):
        if not one.is_within:
            share = "-" if one.share is None else f"{100 * one.share:.2f} %"
            yield f"{share:>8}  {one.name}: {'; '.join(one.notes) or 'no note'}"
    within = sum(one.is_within for one in found)
    yield f"{within} of {len(found)} files differ in at most {100 * SHARE:g} % of the pixels"


def main(*arguments: str) -> None:
    """Measure the SVG files of a folder."""
    from playwright.sync_api import Error, sync_playwright

    from tests.support.chromium import start_chromium

    is_moving = "--moving" in arguments
    (folder,) = (argument for argument in arguments if argument != "--moving")
    files = sorted(Path(folder).rglob("*.svg"))
    OUT.mkdir(parents=True, exist_ok=True)
    found = []
    with sync_playwright() as playwright:
        browser = start_chromium(playwright.chromium)
        page = page_in(browser)
        for file in files:
            try:
                found.append(measured(page, file, OUT, is_moving=is_moving))
            except Error as error:  # it may be too much for one page, and is for no other one
                found.append(
                    Measured(file.stem, None, ["not drawn by Chromium: " + str(error).split("\n", 1)[0]])
                )
                browser.close()
                browser = start_chromium(playwright.chromium)
                page = page_in(browser)
            print(f"{len(found)}/{len(files)} {file.name}", file=sys.stderr, flush=True)
        browser.close()
    print("\n".join(table(found)))


if __name__ == "__main__":
    main(*sys.argv[1:])
