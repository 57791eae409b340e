"""Build the documents as a site, out/site, with zensical: `make docs`. That needs no network.

The pages are the plain Markdown of `docs`, with the README in front. `site.toml` has their order.
"""

from __future__ import annotations

import json
import re
import shutil
import subprocess
import sys
from pathlib import Path

from tools.quality.data import ROOT

DOCS, OUT = ROOT / "docs", ROOT / "out" / "site"
CONFIGURATION = Path(__file__).with_name("site.toml")

ROOT_PAGES = {"README.md": "index.md"} | {
    name: name.lower() for name in ("CHANGELOG.md", "CONTRIBUTING.md", "SECURITY.md")
}
"""Pages that are not in `docs`, and what they are called in the site."""


SOUGHT = {
    "guide.html#time": "pause, rest, loop, repeat, ping-pong, easing, ease, spring, overshoot, delay, duration, speed",
    "guide.html#pictures-and-videos": "GIF, PNG, WebP, APNG, video, MP4, transparent, white background",
    "guide.html#colours-lines-and-order": "currentColor, gradients, opacity",
    "guide.html#selectors": "first shape, some shapes only, ids, classes",
    "guide.html#in-bulk": "folder, many files",
    "states.html": "hover, click, trigger",
}
"""Words by which people look for a section of a page, where its title has others. The search counts a title most."""


def sources(folder: Path) -> None:
    """Put the pages, the pictures and the configuration into a folder."""
    pages = folder / "pages"
    shutil.copytree(DOCS, pages, ignore=shutil.ignore_patterns("README.md"))
    for name, target in ROOT_PAGES.items():
        text = (ROOT / name).read_text(encoding="utf-8")
        (pages / target).write_text(re.sub(r'(\]\(|src="|srcset=")docs/', r"\1", text), "utf-8")
    for page in pages.glob("*.md"):
        page.write_text(_within(page.read_text(encoding="utf-8")), encoding="utf-8")
    shutil.copy(CONFIGURATION, folder / "zensical.toml")


def _within(text: str) -> str:
    """Return a page whose links to other pages stay within the site; what is no page is named without a link."""
    for name, target in ROOT_PAGES.items():
        text = re.sub(rf"\]\((?:\.\./)?{name}(?=[)#])", f"]({target}", text)
    return re.sub(
        r"(?<!!)\[([^\]]+)\]\((?:\.\./|CITATION|[^)]*README\.md|studio/\))[^)]*(?<!\.png)\)", r"\1", text
    )


def build(folder: Path) -> Path:
    """Build the site in an empty folder; return where it is. A link that leads nowhere ends it."""
    sources(folder)
    zensical = Path(sys.executable).with_name("zensical")
    done = subprocess.run([zensical, "build", "--clean", "--strict"], cwd=folder, check=False)
    if done.returncode:
        sys.exit("the site could not be built")
    site = folder / "site"
    _answer(site / "search.json")
    return site


def _answer(file: Path) -> None:
    """Add the words of `SOUGHT` to the titles that the search looks through; a section that is not there ends it."""
    index = json.loads(file.read_text(encoding="utf-8"))
    places = {item["location"]: item for item in index["items"]}
    if lost := SOUGHT.keys() - places.keys():
        sys.exit(f"the site has no {min(lost)}")
    for place, words in SOUGHT.items():
        places[place]["title"] += f": {words}"
    file.write_text(json.dumps(index, ensure_ascii=False, separators=(",", ":")), encoding="utf-8")


def main() -> None:
    shutil.rmtree(OUT, ignore_errors=True)
    OUT.mkdir(parents=True)
    print(build(OUT) / "index.html")


if __name__ == "__main__":
    main()
