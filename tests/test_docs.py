"""What the documents say is what the commands do."""

import json
import re
import shutil
import subprocess

import click
import pytest

from shapeblend_cli.cli import shapeblend
from tests.support.documents import PAGES, ROOT, without_code
from tools import man_page, option_tables
from tools.quality import __main__ as quality

README = (ROOT / "README.md").read_text(encoding="utf-8")


OF_OTHERS = {"--help", "--repo", "--array", "--cpus-per-task", "--sshlogin"}
"""Options of other programs that pages name, and what every command has."""


def test_every_option_in_a_page_exists():
    commands = list(shapeblend.commands.values())
    commands += [c for group in commands if isinstance(group, click.Group) for c in group.commands.values()]
    params = [p for command in commands for p in command.params]
    known = {name for p in params for name in (*p.opts, *p.secondary_opts)}
    for page in (page for page in PAGES if page.name != "CONTRIBUTING.md"):
        text = page.read_text(encoding="utf-8")
        code = " ".join(re.findall(r"`[^`\n]*`|^ *shapeblend .*$", text, re.MULTILINE))
        told = set(re.findall(r"(?<![\w-])--[a-z]+(?:-[a-z]+)*", code))
        assert told <= known | OF_OTHERS, page


def test_the_tables_of_options_are_those_of_the_commands():
    tables = option_tables.tables()
    assert tables in option_tables.PAGE.read_text(encoding="utf-8")
    assert not re.search(r"^\| --- \| --- \|\n(?!\|)", tables, re.MULTILINE), "a section without options"
    told = {name for record in option_tables.RECORDS for name in record.options}
    for name in ("blend", "plot", "batch", "rank", "studio", "states"):
        assert {p.name for p in shapeblend.commands[name].params if isinstance(p, click.Option)} <= told


def anchors(page):
    """The anchors of a page's headings, as sites that show Markdown make them."""
    text = without_code(page.read_text(encoding="utf-8"))
    titles = re.findall(r"^#+ (.*)$", text, re.MULTILINE)
    return {re.sub(r"[^\w -]", "", title.lower()).replace(" ", "-") for title in titles}


def test_what_pages_link_to_is_there():
    for page in (*PAGES, ROOT / "CHANGELOG.md"):
        text = without_code(page.read_text(encoding="utf-8"))
        links = re.findall(r"\]\(([^)\s]+)\)", text) + re.findall(r'(?:src|srcset|href)="([^"]+)"', text)
        for link in (link for link in links if not link.startswith(("http://", "https://"))):
            name, _, anchor = link.partition("#")
            target = page.parent / name if name else page
            assert target.exists(), (page, link)
            assert not anchor or anchor in anchors(target), (page, link)


def test_the_readme_is_short_and_begins_with_a_picture_that_moves():
    assert len(README.splitlines()) <= 90
    picture, *_ = re.findall(r'<img src="([^"]+)"', README)
    assert "<animate " in (ROOT / picture).read_text(encoding="utf-8")


def test_the_readme_and_the_page_on_quality_are_made_of_the_scores():
    found = json.loads((ROOT / quality.RAW).read_text(encoding="utf-8"))
    for name, text in quality.documents(found, README).items():
        assert (ROOT / name).read_text(encoding="utf-8") == text, "run python -m tools.quality --again"


def test_the_manual_page_is_that_of_the_commands():
    assert man_page.PAGE.read_text(encoding="utf-8") == man_page.page(), "run make options"


@pytest.mark.skipif(shutil.which("groff") is None, reason="needs groff")
def test_the_manual_page_is_drawn_without_warnings():
    done = subprocess.run(["groff", "-man", "-Tutf8", "-ww", man_page.PAGE], capture_output=True, text=True)
    assert done.stderr == ""
    assert "least work" in " ".join(done.stdout.split())


def test_nothing_speaks_of_the_machine_it_was_made_on():
    patterns = ("*.md", "docs/*.md", "shapeblend_cli/**/*.py", "Makefile")
    for file in (file for pattern in patterns for file in ROOT.glob(pattern)):
        assert "/work/" not in file.read_text(encoding="utf-8")
        assert "/home/" not in file.read_text(encoding="utf-8")
