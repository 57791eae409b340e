"""What the documents say is what the commands do."""

import json
import re
import shutil
import subprocess
from pathlib import Path

import click
import pytest

from shapeblend_cli.cli import shapeblend
from tools import man_page, option_tables, wheels
from tools.quality import likeness
from tools.quality.peers import arc_length, flubber
from tools.quality.peers import shapeblend as shapeblend_blend
from tools.quality.tables import BEGIN, END

ROOT = Path(__file__).parents[1]
README = (ROOT / "README.md").read_text(encoding="utf-8")


def test_every_option_in_the_readme_exists():
    commands = list(shapeblend.commands.values())
    commands += [c for group in commands if isinstance(group, click.Group) for c in group.commands.values()]
    params = [p for command in commands for p in command.params]
    known = {name for p in params for name in (*p.opts, *p.secondary_opts)}
    code = " ".join(re.findall(r"`[^`\n]*`|^ *shapeblend .*$", README, re.MULTILINE))
    told = set(re.findall(r"(?<![\w-])--[a-z]+(?:-[a-z]+)*", code))
    assert told
    assert told <= known | {"--preset", "--help"}


def test_the_tables_of_options_are_those_of_the_commands():
    tables = option_tables.tables()
    assert tables in README
    assert not re.search(r"^\| --- \| --- \|\n(?!\|)", tables, re.MULTILINE), "a section without options"
    told = {name for record in option_tables.RECORDS for name in record.options}
    for name in ("blend", "plot", "batch", "rank", "studio", "states"):
        assert {p.name for p in shapeblend.commands[name].params if isinstance(p, click.Option)} <= told


@pytest.mark.parametrize("link", re.findall(r"\]\(([^)#]+)\)", README))
def test_what_the_readme_links_to_is_there(link):
    assert (ROOT / link).exists()


def test_figures_beside_other_tools_are_those_of_the_document():
    document = (ROOT / "docs" / "quality.md").read_text(encoding="utf-8")
    for text in (README, document):
        assert (text.count(BEGIN), text.count(END)) == (1, 1)
    figures = README[README.index(BEGIN) : README.index(END)]
    assert figures in document
    for tool in (shapeblend_blend.NAME, flubber.NAME, arc_length.NAME):
        assert tool in figures
    assert len(re.findall(r"\d %", figures)) >= 4 * 3


def test_the_manual_page_is_that_of_the_commands():
    assert man_page.PAGE.read_text(encoding="utf-8") == man_page.page(), "run make options"


def test_the_manual_page_has_every_command_and_every_option():
    page = man_page.PAGE.read_text(encoding="utf-8").replace(r"\-", "-")
    for name, command in shapeblend.commands.items():
        assert name == shapeblend.default or f".SS shapeblend {name}" in page
        for param in command.params:
            if isinstance(param, click.Option) and not param.hidden:
                assert param.opts[-1] in page


@pytest.mark.skipif(shutil.which("groff") is None, reason="needs groff")
def test_the_manual_page_is_drawn_without_warnings():
    done = subprocess.run(["groff", "-man", "-Tutf8", "-ww", man_page.PAGE], capture_output=True, text=True)
    assert done.stderr == ""
    assert "least work" in " ".join(done.stdout.split())


@pytest.mark.parametrize(("tool", "figures"), [(likeness, likeness.table), (wheels, wheels.figures)])
def test_figures_in_documents_are_those_of_their_scores(tool, figures):
    found = json.loads(tool.SCORES.read_text(encoding="utf-8"))
    assert figures(found) in tool.DOCUMENT.read_text(encoding="utf-8")


def test_nothing_speaks_of_the_machine_it_was_made_on():
    patterns = ("*.md", "docs/*.md", "shapeblend_cli/**/*.py", "Makefile")
    for file in (file for pattern in patterns for file in ROOT.glob(pattern)):
        assert "/work/" not in file.read_text(encoding="utf-8")
        assert "/home/" not in file.read_text(encoding="utf-8")
