"""The help, and what a shell is told to complete a command line with."""

import os
import re
import subprocess
import sys
from collections import Counter
from pathlib import Path

import click
import pytest

from shapeblend_cli.cli import run, shapeblend
from shapeblend_cli.cli.blend import EXAMPLES
from shapeblend_cli.cli.group import SectionedCommand
from shapeblend_cli.options.constants import WorkConstants
from shapeblend_cli.options.settings import SECTIONS

SECTIONED = {
    name: found for name, found in shapeblend.commands.items() if isinstance(found, SectionedCommand)
}


@pytest.mark.parametrize("name", SECTIONED)
def test_every_option_stands_in_a_section_that_has_a_place(name):
    sections = {param.section for param in SECTIONED[name].params if isinstance(param, click.Option)}
    assert sections <= {*SECTIONS}


def test_the_help_says_every_option_once(capsys):
    assert run(["--help"]) == 0
    text = capsys.readouterr().out
    lines = text.splitlines()
    said = Counter(line.split()[0].strip(",") for line in lines if line.startswith("  -"))
    assert said["--motion"] == said["--ks"] == said["--output"] + said["-o"] == said["-h"] == 1
    assert max(said.values()) == 1
    assert text.count("A.svg B.svg") == 1
    assert re.search(r"^  plot +Draw how two files correspond", text, re.MULTILINE)
    assert "Examples:" in lines


def test_the_help_says_what_the_work_is_by_default_and_by_the_paper(capsys):
    assert run(["--help"]) == 0
    text = " ".join(capsys.readouterr().out.split())
    constants = WorkConstants()
    for option, default in {
        "--bending [turn|paper]": constants.bending,
        "--kt X": f"{constants.k_t:g}",
        "--smoothing X": f"{constants.smoothing:g}",
        "--pb X": f"{constants.p_b:g}; {WorkConstants(bending='paper').p_b:g} with --bending paper",
    }.items():
        assert re.search(rf"{re.escape(option)} [^\[]*\[default: {re.escape(default)}\]", text)
    assert "--preset [fig1|fig2|fig3|fig8|fig10|fig11|fig27|fig28|paper]" in text


@pytest.mark.parametrize("line", [line for line, _ in EXAMPLES])
def test_the_examples_work(line, three):
    Path("blend.json").write_text('{"files": ["a.svg", "b.svg"]}')
    assert run(line.split()[1:]) == 0


@pytest.mark.parametrize(
    ("line", "offered"),
    [
        ("shapeblend ins", ["plain,inspect", "file,ins"]),
        ("shapeblend --mot", ["plain,--motion"]),
        ("shapeblend a.svg b", ["file,b"]),
        (
            "shapeblend a.svg b.svg --motion ",
            [f"plain,{m}" for m in "auto linear rigid intrinsic".split()],
        ),
        ("shapeblend a.svg b.svg --bending ", ["plain,turn", "plain,paper"]),
        ("shapeblend plot ", [f"plain,{kind}" for kind in "graph angle".split()]),
        ("shapeblend plot graph a", ["file,a"]),
        ("shapeblend inspect a", ["file,a"]),
        ("shapeblend a.svg b.svg -o m", ["file,m"]),
    ],
)
def test_a_shell_completes(line, offered):
    words = {"COMP_WORDS": line, "COMP_CWORD": str(line.count(" "))}
    environment = os.environ | words | {"_SHAPEBLEND_COMPLETE": "bash_complete"}
    command = [sys.executable, "-c", "from shapeblend_cli.cli import run; run([])"]
    done = subprocess.run(command, env=environment, capture_output=True, text=True)
    assert done.stdout.split() == offered


@pytest.mark.parametrize("shell", ["bash", "zsh", "fish"])
def test_scripts_for_shells(shell, capsys):
    assert run(["completion", shell]) == 0
    assert "_SHAPEBLEND_COMPLETE" in capsys.readouterr().out
