"""How long the studio takes from a deed to what is seen of it."""

from __future__ import annotations

from pathlib import Path
from statistics import median
from typing import TYPE_CHECKING

from tools.studio.designer import Designer, designer

if TYPE_CHECKING:
    from playwright.sync_api import Browser

# Milliseconds from the last deed that was not yet answered to the picture that answers it.
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

DROP = """([files, [clientX, clientY]]) => {
  const dataTransfer = new DataTransfer();
  for (const [name, text] of Object.entries(files)) dataTransfer.items.add(new File([text], name));
  for (const kind of ["dragenter", "dragover", "drop"]) {
    const told = { dataTransfer, clientX, clientY, bubbles: true, cancelable: true };
    document.body.dispatchEvent(new DragEvent(kind, told));
  }
}"""

PLACES = 8


def after_drop(browser: Browser, files: tuple[str, str]) -> float:
    """Return the milliseconds from dropping two files to the first picture."""
    with designer(browser, ()) as at:
        at.page.wait_for_timeout(1500)  # the process has loaded long before anybody has found the files
        at.page.evaluate(WATCH)
        at.page.evaluate(
            DROP, [{Path(file).name: Path(file).read_text("utf-8") for file in files}, [200, 200]]
        )
        at.page.wait_for_function("() => window.took.length && document.querySelector('#picture path')")
        return float(at.page.evaluate("window.took[0]"))


def after_drag(browser: Browser, files: tuple[str, str]) -> float:
    """Return the milliseconds from a move of a dragged pin to the blend with it, the median of several."""
    with designer(browser, files) as at:
        at.page.wait_for_selector("#others:not([aria-busy]) > *", timeout=200_000)
        at.tool("pin")
        start, *_ = nodes(at, "a")
        at.begin_drag(start)
        ends = nodes(at, "b")
        at.page.mouse.move(*at.on_screen("b", ends[0]), steps=4)
        at.settle()
        at.page.evaluate(WATCH)
        for k in range(1, PLACES + 1):
            at.page.mouse.move(*at.on_screen("b", ends[k * len(ends) // (PLACES + 1)]))
            at.settle()
        at.page.mouse.up()
        took = at.page.evaluate("window.took")
        assert len(took) >= PLACES // 2, took
        return float(median(took))


def nodes(at: Designer, side: str) -> list[tuple[float, float]]:
    """Return nodes of the largest part of a drawing, as the page has them."""
    found = at.page.evaluate(
        """side => {
          const parts = [...document.querySelectorAll(`#canvas-${side} .part`)];
          const size = part => { const box = part.getBBox(); return box.width * box.height; };
          const part = parts.reduce((p, q) => size(q) > size(p) ? q : p);
          const length = part.getTotalLength();
          return Array.from({ length: 24 }, (_, k) => {
            const { x, y } = part.getPointAtLength(k * length / 24);
            return [x, y];
          });
        }""",
        side,
    )
    return [(x, y) for x, y in found]
