"""Correct blends in the studio, measure it, and write the pictures and figures of docs/studio.md: no arguments.

`python -m tools.studio --again` writes the document from what was kept, without a browser.
"""

from __future__ import annotations

import contextlib
import io
import json
import os
import shlex
import shutil
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

from PIL import Image

from shapeblend_cli.cli import run
from tools.quality.data import ROOT
from tools.quality.tables import Table, with_figures
from tools.studio.corrections import CORRECTIONS, Correction
from tools.studio.designer import designer
from tools.studio.speed import after_drag, after_drop

if TYPE_CHECKING:
    from playwright.sync_api import Browser

DOCS = ROOT / "docs"
FOLDER = DOCS / "studio"
PAGE, KEPT = DOCS / "studio.md", FOLDER / "corrections.json"

BEGIN, END = "<!-- written by make studio -->", "<!-- end of what make studio writes -->"

COLUMNS, CELL, COLOURS = 7, 110, 255

SCREENS: dict[str, dict[str, Any]] = {
    "light": {"color_scheme": "light"},
    "dark": {"color_scheme": "dark"},
    "phone": {"color_scheme": "light", "viewport": {"width": 390, "height": 844}, "has_touch": True},
}

PLAIN, MANY = ("cloud.svg", "cloud-rain.svg"), ("many-1.svg", "many-2.svg")


@contextlib.contextmanager
def drawings() -> Iterator[Path]:
    """Work in a folder with the drawings, and two of thirty contours."""
    before = os.getcwd()
    with tempfile.TemporaryDirectory() as folder:
        for file in FOLDER.glob("*.svg"):
            shutil.copy(file, folder)
        for k, name in enumerate(MANY):
            Path(folder, name).write_text(many(k), encoding="utf-8")
        os.chdir(folder)
        try:
            yield Path(folder)
        finally:
            os.chdir(before)


def many(kind: int) -> str:
    """Return a drawing of thirty petals, leaning to one side or the other."""
    petal = ("M0 0C4 -3 8 -3 11 0C8 5 4 5 0 0Z", "M0 0C2 -5 9 -4 11 0C9 2 3 3 0 0Z")[kind]
    places = [(14 + 17 * (k % 6), 14 + 17 * (k // 6)) for k in range(30)]
    shapes = "".join(
        f'<path transform="translate({x} {y}) rotate({12 * k + 35 * kind})" d="{petal}" fill="#{k:02x}6080"/>'
        for k, (x, y) in enumerate(places)
    )
    return f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 120 100">{shapes}</svg>'


def row(command: str) -> Image.Image:
    """Draw the frames of a blend, both ends among them, as a command line does."""
    with tempfile.TemporaryDirectory() as folder:
        file = f"{folder}/row.png"
        size = ["-n", str(COLUMNS - 2), "--ends", "--columns", str(COLUMNS), "--width", str(CELL)]
        if run([*shlex.split(command)[1:], *size, "-q", "-o", file]) != 0:
            raise SystemExit(f"{command} was not blended")
        with Image.open(file) as image:
            return image.convert("RGB")


def drawn(kept: dict[str, Any]) -> Image.Image:
    """Draw a blend before its correction, and below it after that; the drawings are in the current folder."""
    rows = [row(kept[when]) for when in ("before", "after")]
    both = Image.new("RGB", (rows[0].width, 2 * rows[0].height))
    for k, image in enumerate(rows):
        both.paste(image, (0, k * image.height))
    return both


def correct(browser: Browser, correction: Correction) -> dict[str, Any]:
    """Correct a blend, and return what was done, with the command lines before and after."""
    with designer(browser, correction.files) as at:
        before = at.command
        correction.steps(at)
        if at.page.is_visible("#broken"):
            raise SystemExit(f"{correction.name}: {at.page.inner_text('#broken')}")
        return {"before": before, "after": at.command, "clicks": at.clicks, "drags": at.drags}


def show_page(browser: Browser, name: str) -> None:
    """Keep a picture of the page, with a correction in it."""
    with designer(browser, ("car.svg", "bus.svg"), **SCREENS[name]) as at:
        next(c for c in CORRECTIONS if c.a == "car").steps(at)
        at.page.mouse.move(4, 4)
        if name != "phone":
            at.page.wait_for_selector("#others:not([aria-busy]) button", timeout=120_000)
        at.page.wait_for_timeout(300)
        keep(Image.open(io.BytesIO(at.page.screenshot())), FOLDER / f"page-{name}.png", 255)


def keep(image: Image.Image, file: Path, colours: int = COLOURS) -> None:
    """Write a picture of few colours."""
    image.convert("RGB").quantize(colours, dither=Image.Dither.NONE).save(file, optimize=True)


def told(found: dict[str, Any]) -> str:
    """Return what the document says of corrections, and how long things take."""
    parts = [BEGIN, ""]
    for correction in CORRECTIONS:
        kept = found["corrections"][correction.name]
        count = " and ".join(
            f"{kept[what]} {what if kept[what] > 1 else what[:-1]}"
            for what in ("clicks", "drags")
            if kept[what]
        )
        parts += [
            f"### {correction.a} → {correction.b}",
            "",
            f"{correction.wrong} {correction.done} **{count}.**",
            "",
            f"![{correction.a} into {correction.b}, above before, below after](studio/{correction.name}.png)",
            "",
            f"    {kept['after']}",
            "",
        ]
    rows = [(name, f"{took:.0f} ms") for name, took in found["milliseconds"].items()]
    parts += [
        "## How fast it answers",
        "",
        Table(("what was done", "time until the picture"), rows).markdown(),
        END,
    ]
    return "\n".join(parts)


def measured(browser: Browser) -> dict[str, float]:
    """Return milliseconds by what was done."""
    return {
        "two files dropped, plain icons": after_drop(browser, PLAIN),
        "a pin dragged, plain icons": after_drag(browser, PLAIN),
        "two files dropped, thirty contours": after_drop(browser, MANY),
        "a pin dragged, thirty contours": after_drag(browser, MANY),
    }


def main() -> None:
    """Do all of it."""
    if "--again" not in sys.argv[1:]:
        from playwright.sync_api import sync_playwright

        from tests.support.equipment import CHROMIUM

        with drawings(), sync_playwright() as playwright:
            browser = playwright.chromium.launch(
                executable_path=CHROMIUM, args=["--no-sandbox", "--disable-gpu"]
            )
            found: dict[str, Any] = {"corrections": {}}
            for correction in CORRECTIONS:
                found["corrections"][correction.name] = correct(browser, correction)
                keep(drawn(found["corrections"][correction.name]), FOLDER / f"{correction.name}.png")
            for name in SCREENS:
                show_page(browser, name)
            found["milliseconds"] = {name: round(took, 1) for name, took in measured(browser).items()}
            browser.close()
        KEPT.write_text(json.dumps(found, indent=1) + "\n", encoding="utf-8")
    found = json.loads(KEPT.read_text(encoding="utf-8"))
    PAGE.write_text(with_figures(PAGE.read_text(encoding="utf-8"), told(found), BEGIN, END), encoding="utf-8")


if __name__ == "__main__":
    main()
