"""Somebody at a studio, in Chromium: what is clicked and dragged there, and counted."""

from __future__ import annotations

import threading
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from shapeblend_cli.batch.project import Project
from shapeblend_cli.studio.server import Studio
from shapeblend_cli.studio.session import Session

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Page

Point = tuple[float, float]

SCREEN = """([side, [x, y]]) => {
  const m = document.getElementById(`canvas-${side}`).getScreenCTM();
  return [m.a * x + m.e, m.d * y + m.f];
}"""

QUIET = "() => !document.documentElement.dataset.asking"


class Designer:
    """Corrects a blend by mouse; points are in the coordinates of each drawing."""

    def __init__(self, page: Page) -> None:
        self.page = page
        self.clicks = self.drags = 0

    @property
    def command(self) -> str:
        """The command line that the page shows."""
        return self.page.inner_text("#command")

    def on_screen(self, side: str, point: Point) -> Point:
        """Return where a point of A or of B is in the window."""
        x, y = self.page.evaluate(SCREEN, [side, point])
        return x, y

    def settle(self) -> None:
        """Wait until what was asked for is seen."""
        self.page.evaluate("() => new Promise(requestAnimationFrame)")
        self.page.wait_for_function(QUIET)

    def tool(self, name: str) -> None:
        """Take a tool, unless it is the one at hand."""
        button = self.page.locator(f"[data-tool={name}]")
        if button.get_attribute("aria-checked") != "true":
            button.click()
            self.clicks += 1

    def pair(self, a: Point, b: Point) -> None:
        """Click a part of A and the part of B that it becomes."""
        self.tool("pair")
        for side, point in (("a", a), ("b", b)):
            self.page.mouse.click(*self.on_screen(side, point))
            self.clicks += 1
        self.settle()

    def pin(self, a: Point, b: Point) -> None:
        """Drag a point of A onto a point of B."""
        self.tool("pin")
        self.begin_drag(a)
        self.page.mouse.move(*self.on_screen("b", b), steps=8)
        self.page.mouse.up()
        self.drags += 1
        self.settle()

    def begin_drag(self, a: Point) -> None:
        """Press the button at a point of A."""
        self.page.mouse.move(*self.on_screen("a", a))
        self.page.mouse.down()

    def choose(self, options: str) -> None:
        """Choose one of the other blends."""
        self.page.wait_for_selector("#others:not([aria-busy]) button", timeout=120_000)
        self.page.locator("#others button", has_text=options).click()
        self.clicks += 1
        self.settle()

    def show(self, time: float) -> None:
        """Go to a moment."""
        self.page.fill("#time", str(time))


@contextmanager
def studio(files: Sequence[str], given: dict[str, Any] | None = None) -> Iterator[Studio]:
    """Open a studio of drawings that lie in the current folder."""
    session = Session(Project(tuple(files), given or {}))
    server = Studio(session)
    session.start()
    threading.Thread(target=server.serve_forever, args=(0.02,), daemon=True).start()
    try:
        yield server
    finally:
        server.shutdown()
        server.server_close()
        session.stop()


@contextmanager
def designer(browser: Browser, files: Sequence[str], **look: Any) -> Iterator[Designer]:
    """Sit down at a studio of drawings that lie in the current folder."""
    look = {"viewport": {"width": 1280, "height": 900}, "reduced_motion": "reduce", **look}
    with studio(files) as server, browser.new_context(**look) as context:
        page = context.new_page()
        page.goto(server.address)
        page.wait_for_selector("html[data-ready]")
        yield Designer(page)
