"""One Chromium for all tests in a browser."""

import numpy as np
import pytest

from tests.support.chromium import picture_of, start_chromium
from tests.support.equipment import require


@pytest.fixture(scope="session", autouse=True)
def browser():
    """Chromium, as long as there are tests that need it."""
    require("Chromium")
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright:
        started = start_chromium(playwright.chromium)
        yield started
        started.close()


@pytest.fixture
def screenshot(browser, tmp_path):
    """Draw the body of a page, as red, green and blue from 0 to 255 of each pixel."""

    def draw(style, body, width, height, finer=1):
        file = tmp_path / "page.html"
        file.write_text(f"<!doctype html><style>{style}</style><body>{body}", encoding="utf-8")
        with browser.new_context(
            viewport={"width": width, "height": height}, device_scale_factor=finer
        ) as context:
            page = context.new_page()
            page.goto(file.as_uri())
            return np.asarray(picture_of(page).reduce(finer), float)

    return draw
