"""The site of the documents is built without a network, and has every page."""

import json
import re
import time
import tomllib
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from threading import Thread

import pytest

from tests.support.chromium import start_chromium
from tests.support.equipment import require
from tools import site


def test_every_page_is_in_the_navigation_and_every_link_within_the_site_leads_somewhere(tmp_path):
    navigation = tomllib.loads(site.CONFIGURATION.read_text("utf-8"))["project"]["nav"]
    told = [name for section in navigation for names in section.values() for name in names]
    assert sorted(told) == sorted(
        [*(page.name for page in site.DOCS.glob("*.md")), *site.ROOT_PAGES.values()]
    )
    built = site.build(tmp_path)
    assert all((built / name).with_suffix(".html").is_file() for name in told)


SOUGHT = "pause loop easing icon hover gif after+effects figma react vue svelte spring duration delay white flubber"


@pytest.fixture(scope="module")
def index(tmp_path_factory):
    """What the search of the site looks through: the title and the text of each section."""
    return json.loads((site.build(tmp_path_factory.mktemp("site")) / "search.json").read_text("utf-8"))[
        "items"
    ]


@pytest.mark.parametrize("word", SOUGHT.split())
def test_what_people_look_for_is_found_and_on_the_first_page_of_the_guide(index, word):
    words = word.replace("+", " ")
    found = [one["location"] for one in index if words in f"{one['title']} {one['text']}".lower()]
    assert len(found) > 1
    assert any(location.startswith("guide.html") for location in found)


ANSWERS = {
    "pause": "guide.html#time",
    "loop": "guide.html#time",
    "easing": "guide.html#time",
    "spring": "guide.html#time",
    "overshoot": "guide.html#time",
    "GIF": "guide.html#pictures-and-videos",
    "transparent": "guide.html#pictures-and-videos",
    "currentColor": "guide.html#colours-lines-and-order",
    "folder": "guide.html#in-bulk",
    "first shape": "guide.html#selectors",
    "hover": "states.html",
    "icon": "icons.html",
    "react": "cookbook.html#react",
    "figma": "cookbook.html#figma",
    "after effects": "coming-from.html#after-effects-figma-and-lottie",
}
"""What people type, and where the first hit should lead."""

FOUND = """() => {
  const inside = (root) =>
    [...root.querySelectorAll("*")].flatMap((e) => [e, ...(e.shadowRoot ? inside(e.shadowRoot) : [])]);
  return inside(document).filter((e) => e.href && e.getRootNode() !== document).map((e) => e.href);
}"""
"""The hits of the search, which are in a shadow of the page."""


@pytest.fixture(scope="module")
def search(tmp_path_factory):
    """Type words into the search of the site, in Chromium, and return where the hits lead."""
    require("Chromium")
    from playwright.sync_api import sync_playwright

    folder = site.build(tmp_path_factory.mktemp("searched"))
    handler = partial(Quiet, directory=folder)
    with ThreadingHTTPServer(("127.0.0.1", 0), handler) as server, sync_playwright() as playwright:
        Thread(target=server.serve_forever, daemon=True).start()
        page = start_chromium(playwright.chromium).new_page()
        address = f"http://127.0.0.1:{server.server_port}/"
        page.goto(f"{address}index.html", wait_until="load")

        def hits(words):
            # The page listens to keys when its scripts have run.
            deadline = time.monotonic() + 60.0
            while time.monotonic() < deadline:
                page.keyboard.press("/")
                page.keyboard.press("Control+a")
                page.keyboard.press("Delete")
                if page.evaluate(FOUND):
                    page.wait_for_timeout(200)
                    continue
                page.keyboard.insert_text(words)
                if found := settled(page):
                    return [re.sub(r"\?[^#]*", "", place.removeprefix(address)) for place in found]
            return []

        yield hits
        server.shutdown()


def settled(page):
    """Return the hits when they have been the same for two seconds.

    On a busy machine they come one after the other. All words are put in at once, when the old hits are gone: the
    search begins with the first letter, and would show those of half a word.
    """
    found = page.evaluate(FOUND)
    same = 0
    while same < 10:
        page.wait_for_timeout(200)
        before, found = found, page.evaluate(FOUND)
        same = same + 1 if found == before else 0
    return found


class Quiet(SimpleHTTPRequestHandler):
    """A server that says nothing of what it serves."""

    def log_message(self, *_):
        pass


@pytest.mark.parametrize("words", ANSWERS)
def test_the_first_hit_answers(search, words):
    assert search(words)[0] == ANSWERS[words]


def test_words_for_a_section_that_is_not_there_end_it(tmp_path, monkeypatch):
    monkeypatch.setitem(site.SOUGHT, "guide.html#nothing", "x")
    with pytest.raises(SystemExit, match=r"the site has no guide\.html#nothing"):
        site.build(tmp_path / "site")


def test_a_link_that_leads_nowhere_ends_it(tmp_path, monkeypatch):
    monkeypatch.setattr(site, "DOCS", tmp_path / "docs")
    site.shutil.copytree(site.ROOT / "docs", site.DOCS)
    (site.DOCS / "glossary.md").write_text("[x](options.md#nothing)", "utf-8")
    with pytest.raises(SystemExit):
        site.build(tmp_path / "site")
