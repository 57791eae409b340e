"""Build the documents as a site, out/site, with zensical: `make docs`. That needs no network.

The pages are the plain Markdown of `docs`, with the README in front. `site.toml` has their order.
"""

from __future__ import annotations

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
    return folder / "site"


def main() -> None:
    shutil.rmtree(OUT, ignore_errors=True)
    OUT.mkdir(parents=True)
    print(build(OUT) / "index.html")


if __name__ == "__main__":
    main()
