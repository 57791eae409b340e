"""Draw the pictures of the studio's page, for docs/studio.md: `make studio`. No arguments."""

from __future__ import annotations

import threading
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from PIL import Image

from shapeblend_cli.rows.project import Project
from shapeblend_cli.studio.server import Studio
from shapeblend_cli.studio.session import Session
from tools.pictures import DOCS, beside

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Page

SCREENS: dict[str, dict[str, Any]] = {
    "light": {"color_scheme": "light"},
    "dark": {"color_scheme": "dark"},
    "phone": {
        "color_scheme": "light",
        "viewport": {"width": 390, "height": 844},
        "has_touch": True,
        "is_mobile": True,
    },
}
CORRECTED = Project(("car.svg", "bus.svg"), {"match": ["0=11", "2=13", "1=15"]})
"""The blend that the pictures show."""


@contextmanager
def studio(browser: Browser, project: Project, look: Mapping[str, Any]) -> Iterator[Page]:
    """Open a studio of drawings of the current folder in a page."""
    session = Session(project)
    server = Studio(session)
    session.start()
    threading.Thread(target=server.serve_forever, args=(0.02,), daemon=True).start()
    screen = {"viewport": {"width": 1280, "height": 900}, "reduced_motion": "reduce", **look}
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


def draw(browser: Browser, screen: str) -> None:
    """Keep a picture of the page with a correction in it."""
    from tests.support.chromium import picture_of

    with beside("docs/studio"), studio(browser, CORRECTED, SCREENS[screen]) as page:
        page.wait_for_function("() => !document.documentElement.dataset.asking")
        if screen != "phone":
            page.wait_for_selector("#others:not([aria-busy]) button", timeout=120_000)
        page.wait_for_timeout(300)
        picture_of(page).quantize(255, dither=Image.Dither.NONE).save(
            DOCS / "studio" / f"page-{screen}.png", optimize=True
        )


def main() -> None:
    from playwright.sync_api import sync_playwright

    from tests.support.chromium import start_chromium

    with sync_playwright() as playwright:
        # People see the scroll bars, which Playwright hides.
        browser = start_chromium(playwright.chromium, ignore_default_args=["--hide-scrollbars"])
        for screen in SCREENS:
            draw(browser, screen)
        browser.close()


if __name__ == "__main__":
    main()
