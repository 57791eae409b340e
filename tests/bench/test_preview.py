"""Time until a page of `--preview` can be used, for outlines of 200 vertices and for more."""

import pytest

from shapeblend_cli.cli import run
from tests.support.chromium import start_chromium
from tests.support.equipment import CHROMIUM

pytestmark = pytest.mark.skipif(
    CHROMIUM is None, reason="no Chromium here: apt-get install chromium-headless-shell"
)


@pytest.mark.parametrize("names", ["e f", "bird-1 bird-2", "cow deer"])
def test_opening_a_page(benchmark, tmp_path, samples, names):
    from playwright.sync_api import sync_playwright

    file = tmp_path / "x.html"
    drawings = [str(samples / f"{name}.svg") for name in names.split()]
    assert run([*drawings, "-n", "9", "-q", "-o", str(tmp_path / "out"), "--preview", str(file)]) == 0
    with sync_playwright() as playwright:
        browser = start_chromium(playwright.chromium)
        page = browser.new_page(reduced_motion="reduce")

        def open_():
            page.goto(file.as_uri())
            page.wait_for_selector("html[data-ready]")

        benchmark.group = "opening a page of --preview in Chromium"
        benchmark.extra_info["kB"] = file.stat().st_size // 1000
        benchmark.pedantic(open_, rounds=8, warmup_rounds=1)
        browser.close()
