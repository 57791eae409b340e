"""Build the documents as a site, out/site, and check its links: `make docs`. That needs no network.

The pages are the plain Markdown of `docs`, with the README in front. Zensical makes HTML of them. With `--links`, as
`make docs LINKS=1` has it, addresses of other sites are asked for too.
"""

from __future__ import annotations

import json
import re
import shutil
import subprocess
import sys
from html.parser import HTMLParser
from http.client import HTTPException
from pathlib import Path
from urllib.error import HTTPError
from urllib.parse import unquote, urlsplit
from urllib.request import Request, urlopen

from tools.quality.data import ROOT

OUT = ROOT / "out" / "site"

ROOT_PAGES = {"README.md": "index.md"} | {
    name: name.lower() for name in ("CHANGELOG.md", "CONTRIBUTING.md", "SECURITY.md")
}
"""Pages that are not in `docs`, and what they are called in the site."""

NAVIGATION = {
    "shapeblend": ["index", "install", "guide", "options", "examples", "moving", "gallery"],
    "Correct a blend": ["studio", "plots"],
    "Put it to work": [
        "cookbook",
        "batch",
        "states",
        "inkscape",
        "editing",
        "report",
        "rank",
        "capacity",
        "api",
    ],
    "How it works": ["how-it-works", "paper", "motion", "defaults", "solver", "glossary"],
    "Measurements": ["quality", "reliability"],
    "The project": ["changelog", "contributing", "security"],
}
"""Sections and their pages; all that there are, and only once."""

CONFIGURATION = """\
[project]
site_name = "shapeblend"
site_description = "Turns one SVG drawing into another and draws the steps in between"
docs_dir = "pages"
site_dir = "site"
use_directory_urls = false
nav = {navigation}

[project.theme]
font = false
features = ["navigation.sections", "navigation.top", "content.code.copy"]

[[project.theme.palette]]
media = "(prefers-color-scheme: light)"
scheme = "default"

[[project.theme.palette]]
media = "(prefers-color-scheme: dark)"
scheme = "slate"
"""


def sources(folder: Path) -> None:
    """Put the pages, what they show, and how they are to be made into a folder."""
    pages = folder / "pages"
    shutil.copytree(ROOT / "docs", pages, ignore=shutil.ignore_patterns("README.md"))
    for name, target in ROOT_PAGES.items():
        text = (ROOT / name).read_text(encoding="utf-8")
        text = re.sub(r'(\]\(|src="|srcset=")docs/', r"\1", text)
        (pages / target).write_text(text, "utf-8")
    for page in pages.glob("*.md"):
        page.write_text(_within(page.read_text(encoding="utf-8")), encoding="utf-8")
    navigation = ", ".join(
        f"{{{json.dumps(title)} = [{', '.join(json.dumps(f'{name}.md') for name in names)}]}}"
        for title, names in NAVIGATION.items()
    )
    (folder / "zensical.toml").write_text(CONFIGURATION.format(navigation=f"[{navigation}]"), "utf-8")


def _within(text: str) -> str:
    """Return a page whose links to other pages stay within the site; what is no page is named without a link."""
    for name, target in ROOT_PAGES.items():
        text = re.sub(rf"\]\((?:\.\./)?{name}(?=[)#])", f"]({target}", text)
    return re.sub(
        r"(?<!!)\[([^\]]+)\]\((?:\.\./|CITATION|[^)]*README\.md|studio/\))[^)]*(?<!\.png)\)", r"\1", text
    )


def build(folder: Path) -> Path:
    """Build the site in a folder; return where it is."""
    sources(folder)
    done = subprocess.run(
        [Path(sys.executable).with_name("zensical"), "build", "--clean", "--strict"],
        cwd=folder,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        check=False,
    )
    if done.returncode:
        sys.exit(done.stdout)
    return folder / "site"


class _Page(HTMLParser):
    """What a page links to and loads, and the places in it that can be linked to."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.links: list[str] = []
        self.loads: list[str] = []
        self.ids: set[str] = set()
        self.feed(text)

    def handle_starttag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
        for name, value in attributes:
            if name == "id" and value:
                self.ids.add(value)
            elif name in ("href", "src", "srcset") and value:
                (self.links if tag == "a" else self.loads).append(value)


def wrong_links(site: Path) -> list[str]:
    """Return what pages link to that is not there, and what they would load from elsewhere."""
    pages = {page: _Page(page.read_text(encoding="utf-8")) for page in site.glob("*.html")}
    wrong = []
    for page, found in pages.items():
        for link in [*found.links, *found.loads]:
            parts = urlsplit(link)
            if parts.scheme or parts.netloc:
                if link in found.loads and parts.scheme != "data":
                    wrong.append(f"{page.name} loads {link}")
                continue
            if page.name == "404.html":
                continue  # it stands anywhere
            target = (page.parent / unquote(parts.path)).resolve() if parts.path else page
            target = target / "index.html" if target.is_dir() else target
            anchor = unquote(parts.fragment)
            if not target.is_file() or (anchor and target in pages and anchor not in pages[target].ids):
                wrong.append(f"{page.name}: {link}")
    return sorted(set(wrong))


def elsewhere() -> list[str]:
    """Return the addresses of other sites that pages link to."""
    pages = [*(ROOT / name for name in ROOT_PAGES), *(ROOT / "docs").rglob("*.md")]
    links = re.compile(r"\]\(([a-z]+:[^)]*)\)|<([a-z]+:[^>]*)>")
    found = [link for page in pages for link in links.findall(page.read_text(encoding="utf-8"))]
    return sorted({a or b for a, b in found})


def unanswered(addresses: list[str]) -> list[str]:
    """Ask for addresses; return those that do not answer with a page, each with what happened."""
    wrong = []
    for address in addresses:
        request = Request(address, headers={"User-Agent": "Mozilla/5.0 (links of shapeblend's documents)"})
        try:
            with urlopen(request, timeout=20):
                pass
        except HTTPError as error:
            error.close()
            wrong.append(f"{address}: {error.code} {error.reason}")
        except (OSError, HTTPException) as error:
            wrong.append(f"{address}: not reached ({getattr(error, 'reason', error)})")
    return wrong


def main() -> None:
    shutil.rmtree(OUT, ignore_errors=True)
    OUT.mkdir(parents=True)
    site = build(OUT)
    if wrong := wrong_links(site):
        sys.exit("\n".join(["links that lead nowhere:", *wrong]))
    print(site / "index.html")
    if "--links" in sys.argv[1:]:
        addresses = elsewhere()
        if wrong := unanswered(addresses):
            sys.exit("\n".join([f"of {len(addresses)} links to other sites:", *wrong]))
        print(f"{len(addresses)} links to other sites are answered")


if __name__ == "__main__":
    main()
