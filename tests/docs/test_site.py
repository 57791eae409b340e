"""The site of the documents: it is built without a network, has every page, and every link leads somewhere."""

import re
import shutil
import threading
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer

import pytest

from tools import site


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    """Give the folder of the site."""
    return site.build(tmp_path_factory.mktemp("site"))


def test_every_page_is_in_the_navigation_once():
    told = [name for names in site.NAVIGATION.values() for name in names]
    pages = {page.stem for page in (site.ROOT / "docs").glob("*.md")}
    pages |= {name.removesuffix(".md") for name in site.ROOT_PAGES.values()}
    assert sorted(told) == sorted(pages)


def test_every_page_is_built_and_its_links_lead_somewhere(built):
    for names in site.NAVIGATION.values():
        for name in names:
            assert (built / f"{name}.html").is_file()
    assert site.wrong_links(built) == []


def test_the_picture_that_moves_is_on_the_first_page(built):
    text = (built / "index.html").read_text(encoding="utf-8")
    (picture,) = re.findall(r'<img[^>]*src="([^"]*moving\.svg)"', text)
    assert (built / picture).is_file()


def test_links_that_lead_nowhere_and_what_comes_from_elsewhere_are_found(built, tmp_path):
    copy = shutil.copytree(built, tmp_path / "site")
    page = copy / "guide.html"
    more = '<a href="nowhere.html">x</a><a href="options.html#nothing">y</a><img src="https://example.org/x.png">'
    page.write_text(page.read_text(encoding="utf-8").replace("</body>", f"{more}</body>"), encoding="utf-8")
    assert site.wrong_links(copy) == [
        "guide.html loads https://example.org/x.png",
        "guide.html: nowhere.html",
        "guide.html: options.html#nothing",
    ]


def test_links_to_other_sites_are_whole_addresses():
    addresses = site.elsewhere()
    assert len(addresses) >= 8
    for address in addresses:
        assert re.fullmatch(r"https://([a-z0-9-]+\.)+[a-z]+(/[\w.~/-]*)?(#[\w-]+)?", address)


def test_links_to_other_sites_that_are_not_answered_are_found():
    class Site(BaseHTTPRequestHandler):
        def do_GET(self):
            self.send_response(200 if self.path == "/there" else 404)
            self.end_headers()

        def log_message(self, *words):
            pass

    with ThreadingHTTPServer(("127.0.0.1", 0), Site) as server:
        threading.Thread(target=server.serve_forever, args=(0.01,), daemon=True).start()
        here = f"http://127.0.0.1:{server.server_port}"
        found = site.unanswered([f"{here}/there", f"{here}/gone"])
        server.shutdown()
    assert found == [f"{here}/gone: 404 Not Found"]
    assert site.unanswered([f"{here}/there"])[0].startswith(f"{here}/there: not reached (")
