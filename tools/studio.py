"""Draw the pictures of the studio's page, and measure how fast it answers: `make studio`. No arguments."""

from __future__ import annotations

import io
import threading
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from statistics import median
from typing import TYPE_CHECKING, Any

from PIL import Image

from shapeblend_cli.batch.project import Project
from shapeblend_cli.studio.server import Studio
from shapeblend_cli.studio.session import Session
from tools.pictures import DOCS, beside

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Page

SCREENS: dict[str, dict[str, Any]] = {
    "light": {"color_scheme": "light"},
    "dark": {"color_scheme": "dark"},
    "phone": {"color_scheme": "light", "viewport": {"width": 390, "height": 844}, "has_touch": True},
}
CORRECTED = Project(("car.svg", "bus.svg"), {"match": ["0=11", "2=13", "1=15"]})
"""The blend that the pictures show."""

PLAIN, MANY = ("cloud.svg", "cloud-rain.svg"), ("many-1.svg", "many-2.svg")

PLACES = 8
"""Places that a pin is dragged to."""

WATCH = """() => {
  let began = null;
  window.took = [];
  for (const kind of ["pointermove", "drop"]) addEventListener(kind, event => {
    if (kind === "drop" || event.buttons) began ??= performance.now();
  }, true);
  new MutationObserver(() => requestAnimationFrame(() => {
    if (began !== null) window.took.push(performance.now() - began);
    began = null;
  })).observe(document.documentElement, { attributeFilter: ["data-version"] });
}"""
"""Takes the milliseconds from the first action without an answer to the picture that answers it."""

DROP = """([files, [clientX, clientY]]) => {
  const dataTransfer = new DataTransfer();
  for (const [name, text] of Object.entries(files)) dataTransfer.items.add(new File([text], name));
  for (const kind of ["dragenter", "dragover", "drop"]) {
    const told = { dataTransfer, clientX, clientY, bubbles: true, cancelable: true };
    document.body.dispatchEvent(new DragEvent(kind, told));
  }
}"""

NODES = """([side, count]) => {
  const size = part => { const box = part.getBBox(); return box.width * box.height; };
  const parts = [...document.querySelectorAll(`#canvas-${side} .part`)];
  const part = parts.reduce((p, q) => size(q) > size(p) ? q : p);
  const m = document.getElementById(`canvas-${side}`).getScreenCTM();
  return Array.from({ length: count }, (_, k) => {
    const { x, y } = part.getPointAtLength(k * part.getTotalLength() / count);
    return [m.a * x + m.e, m.d * y + m.f];
  });
}"""
"""Places along the largest part of a drawing, as they are on the screen."""


def many(kind: int) -> str:
    """Return a drawing of thirty petals, leaning to one side or the other."""
    petal = ("M0 0C4 -3 8 -3 11 0C8 5 4 5 0 0Z", "M0 0C2 -5 9 -4 11 0C9 2 3 3 0 0Z")[kind]
    places = [(14 + 17 * (k % 6), 14 + 17 * (k // 6)) for k in range(30)]
    shapes = "".join(
        f'<path transform="translate({x} {y}) rotate({12 * k + 35 * kind})" d="{petal}" fill="#{k:02x}6080"/>'
        for k, (x, y) in enumerate(places)
    )
    return f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 120 100">{shapes}</svg>'


@contextmanager
def studio(browser: Browser, project: Project, look: Mapping[str, Any] | None = None) -> Iterator[Page]:
    """Open a studio of drawings of the current folder in a page."""
    session = Session(project)
    server = Studio(session)
    session.start()
    threading.Thread(target=server.serve_forever, args=(0.02,), daemon=True).start()
    screen = {"viewport": {"width": 1280, "height": 900}, "reduced_motion": "reduce", **(look or {})}
    try:
        with browser.new_context(**screen) as context:
            page = context.new_page()
            page.goto(server.address)
            page.wait_for_selector("html[data-ready]")
            yield page
    finally:
        server.shutdown()
        server.server_close()
        session.stop()


def settle(page: Page) -> None:
    """Wait until the answer is seen."""
    page.evaluate("() => new Promise(requestAnimationFrame)")
    page.wait_for_function("() => !document.documentElement.dataset.asking")


def after_drop(browser: Browser, files: tuple[str, str]) -> float:
    """Return the milliseconds from dropping two files to the first picture."""
    with studio(browser, Project((), {})) as page:
        page.wait_for_timeout(1500)  # the process has loaded long before anybody has found the files
        page.evaluate(WATCH)
        page.evaluate(DROP, [{file: Path(file).read_text("utf-8") for file in files}, [200, 200]])
        page.wait_for_function("() => window.took.length && document.querySelector('#picture path')")
        return float(page.evaluate("window.took[0]"))


def after_drag(browser: Browser, files: tuple[str, str]) -> float:
    """Return the milliseconds from a move of a dragged pin to the blend with it, the median of several."""
    with studio(browser, Project(files, {})) as page:
        page.wait_for_selector("#others:not([aria-busy]) > *", timeout=200_000)
        page.click("[data-tool=pin]")
        (start,) = page.evaluate(NODES, ["a", 1])
        page.mouse.move(*start)
        page.mouse.down()
        first, *ends = page.evaluate(NODES, ["b", PLACES + 1])
        page.mouse.move(*first, steps=4)
        settle(page)
        page.evaluate(WATCH)
        for end in ends:
            page.mouse.move(*end)
            settle(page)
        page.mouse.up()
        took = page.evaluate("window.took")
        assert len(took) >= PLACES // 2, took
        return float(median(took))


def measured(browser: Browser) -> dict[str, float]:
    """Return milliseconds by what was done."""
    with beside("docs/studio"):
        for k, name in enumerate(MANY):
            Path(name).write_text(many(k), "utf-8")
        return {
            "two files dropped, plain icons": after_drop(browser, PLAIN),
            "a pin dragged, plain icons": after_drag(browser, PLAIN),
            "two files dropped, thirty contours": after_drop(browser, MANY),
            "a pin dragged, thirty contours": after_drag(browser, MANY),
        }


def draw(browser: Browser, screen: str) -> None:
    """Keep a picture of the page with a correction in it."""
    with beside("docs/studio"), studio(browser, CORRECTED, SCREENS[screen]) as page:
        settle(page)
        if screen != "phone":
            page.wait_for_selector("#others:not([aria-busy]) button", timeout=120_000)
        page.wait_for_timeout(300)
        image = Image.open(io.BytesIO(page.screenshot())).convert("RGB")
        image.quantize(255, dither=Image.Dither.NONE).save(
            DOCS / "studio" / f"page-{screen}.png", optimize=True
        )


def main() -> None:
    from playwright.sync_api import sync_playwright

    from tests.support.equipment import CHROMIUM

    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox", "--disable-gpu"])
        for screen in SCREENS:
            draw(browser, screen)
        for what, took in measured(browser).items():
            print(f"| {what} | {took:.0f} ms |")
        browser.close()


if __name__ == "__main__":
    main()
