"""Jobs of folders, without a manifest."""

import errno
import os
import shutil
from pathlib import Path

import pytest

from shapeblend_cli.cli import run
from tests.support.commands import names

pytestmark = pytest.mark.usefixtures("forked")


def planned(capsys, line):
    """The outputs that a batch would write."""
    assert run(["batch", *line, "--dry-run"]) == 0
    return [each.split("\t")[0] for each in capsys.readouterr().out.splitlines()]


def test_a_chain_goes_from_each_drawing_to_the_next_in_natural_order(drawings, capsys):
    moving = ["m/1-2.svg", "m/2-9.svg", "m/9-10.svg"]
    for chain in ("in", "in/", "in/*.svg", "in/**"):
        assert planned(capsys, ["--chain", chain, "-o", "m/{a}-{b}.svg"]) == moving
    unquoted = ["--chain", "in/1.svg", "in/10.svg", "in/2.svg", "in/9.svg"]
    assert len(planned(capsys, unquoted)) == 3


def test_a_pattern_may_be_of_the_current_folder(drawings, batch, monkeypatch):
    monkeypatch.chdir("in")
    assert batch("--chain", "*.svg", "-o", "m/{n}.svg", "-j", "1")[0] == 0
    assert len(list(Path("m").glob("*.svg"))) == 3


def test_all_are_every_two(drawings, capsys):
    found = planned(capsys, ["--all", "in", "-o", "m/{n}.svg"])
    assert found == [f"m/{n}.svg" for n in range(1, 7)]
    assert planned(capsys, ["--all", "in", "--emit", "lottie"])[0] == "blend/1-2.json"


def test_pairs_have_one_name_in_two_folders_and_in_folders_inside(drawings, batch, capsys):
    for name in ("a/x.svg", "b/x.svg", "b/y.svg"):
        Path("on", name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy("in/1.svg", Path("on", name))
    shutil.copytree("on", "off")
    Path("off/b/y.svg").unlink()
    status, results, printed = batch("--pairs", "on", "off", "-o", "m/{a}.svg")
    assert status == 0
    assert [each["outputs"] for each in results.values()] == [["m/a/x.svg"], ["m/b/x.svg"]]
    assert "1 of 3 drawings in on have no namesake in off, b/y.svg for one" in printed.err
    assert {*names("m")} >= {"a/x.svg", "b/x.svg"}
    assert run(["batch", "--pairs", "off", "on", "-o", "n/{a}.svg", "--dry-run"]) == 0
    assert (
        capsys.readouterr().err
        == "shapeblend: 1 of 3 drawings in on have no namesake in off, b/y.svg for one\n"
    )


def test_in_a_manifest_folders_are_kept_below_it_alone(drawings, capsys):
    Path("in/jobs.csv").write_text("a,b\n1.svg,../in/2.svg\n../in/1.svg,9.svg\n", "utf-8")
    Path("jobs.csv").write_text("a,b\nin/1.svg,in/2.svg\n", "utf-8")
    assert planned(capsys, ["in/jobs.csv"]) == ["blend/1-2", "blend/1-9"]
    assert planned(capsys, ["jobs.csv"]) == ["blend/in/1-2"]


def test_numbers_have_one_width(drawings, capsys):
    rows = "".join(f"in/1.svg,in/2.svg,{k}\n" for k in range(1, 11))
    Path("jobs.csv").write_text(f"a,b,duration\n{rows}", "utf-8")
    assert planned(capsys, ["jobs.csv", "-o", "{n}.svg"])[::9] == ["01.svg", "10.svg"]


@pytest.mark.parametrize("line", [["batch", "--chain", "in"], ["rank", "other.svg", "in"]])
def test_a_folder_that_cannot_be_read_is_named(drawings, capsys, monkeypatch, line):
    def forbidden(path):
        raise PermissionError(errno.EACCES, os.strerror(errno.EACCES), path)

    shutil.copy("in/1.svg", "other.svg")
    monkeypatch.setattr(os, "listdir", forbidden)
    assert run(line) == 1
    assert capsys.readouterr().err == "shapeblend: in: is a folder that cannot be read (Permission denied)\n"
