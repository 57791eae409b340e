"""What jobs wrote that are gone, and frames of longer runs."""

import shutil
from pathlib import Path

import pytest

from shapeblend_cli.cli import run
from tests.support.commands import contents, names

pytestmark = pytest.mark.usefixtures("forked")

ROWS = ["in/1.svg,in/2.svg,m/1.svg", "in/2.svg,in/9.svg,m/2.svg", "in/9.svg,in/10.svg,m/deep/3"]


def manifest(name, rows):
    Path(name).write_text("\n".join(["a,b,o", *rows]), "utf-8")


@pytest.fixture
def done(drawings):
    """Two batches that write to one folder were done; of one of them, a job is gone now."""
    manifest("jobs.csv", ROWS)
    manifest("others.csv", ["in/1.svg,in/10.svg,m/other.svg"])
    assert run(["batch", "jobs.csv", "-n", "2"]) == run(["batch", "others.csv"]) == 0
    manifest("jobs.csv", ROWS[:1])


def frames(folder="f"):
    return [name for name in names(folder) if name.startswith("frame")]


def test_outputs_of_jobs_that_are_gone_are_removed_and_nothing_else(done, capsys):
    line = ["batch", "jobs.csv", "-n", "2", "--clean"]
    gone = ["m/2.svg", "m/deep/3/frame-1.svg", "m/deep/3/frame-2.svg"]
    before = contents()
    capsys.readouterr()
    assert run([*line, "--dry-run"]) == 0
    assert capsys.readouterr().out.splitlines() == [
        f"{file}\twould be removed, as no job writes it any more" for file in gone
    ]
    assert contents() == before
    assert run(line) == 0
    said = capsys.readouterr().err.splitlines()
    assert said == [f"shapeblend: {file}: removed, as no job writes it any more" for file in gone] + [
        "shapeblend: 1 up to date"
    ]
    assert names("m") == [
        ".shapeblend",
        ".shapeblend/1.svg.json",
        ".shapeblend/other.svg.json",
        "1.svg",
        "other.svg",
    ]


def test_an_output_that_was_edited_stays_and_that_is_said(done, capsys):
    Path("m/2.svg").write_text("mine", "utf-8")
    for _ in range(2):
        assert run(["batch", "jobs.csv", "-n", "2", "--clean"]) == 0
        assert "m/2.svg: no job writes it any more, but it was edited, and stays" in capsys.readouterr().err
    assert Path("m/2.svg").read_text("utf-8") == "mine"
    assert not Path("m/deep").exists()


def test_what_another_job_reads_or_writes_now_stays(done):
    manifest("jobs.csv", [ROWS[0], "m/2.svg,in/9.svg,m/deep/3"])
    assert run(["batch", "jobs.csv", "--force", "--clean", "-n", "2"]) == 0
    assert {*names("m")} >= {"1.svg", "2.svg", "deep/3/frame-1.svg"}


def test_frames_of_longer_runs_are_removed(drawings, batch):
    line = ("--chain", "in/[12].svg", "-o", "f")
    for count in (9, 5, 9):
        assert batch(*line, "-n", str(count))[0] == 0
    Path("f/frame-7.svg").write_text("mine", "utf-8")
    Path("f/frame-8.svg").unlink()
    _, _, printed = batch(*line, "-n", "5", "--clean")
    assert printed.err.splitlines() == [
        "shapeblend: f/frame-6.svg: removed, as no job writes it any more",
        "shapeblend: f/frame-9.svg: removed, as no job writes it any more",
        "shapeblend: f/frame-7.svg: no job writes it any more, but it was edited, and stays",
        "shapeblend: f: 1 frame files of another run remain, frame-7.svg among them",
        "shapeblend: 1 done",
    ]
    Path("f/frame-7.svg").unlink()
    assert len(frames()) == 5


def test_frames_are_removed_later_too_but_not_while_their_job_fails(drawings, statuses):
    line = ("--chain", "in/[12].svg", "-o", "f")
    assert statuses(*line, "-n", "9") == (0, "done")
    shutil.move("in/1.svg", "away")
    Path("in/1.svg").write_text("<svg/>", "utf-8")
    assert statuses(*line, "-n", "5", "--clean") == (1, "failed")
    assert len(frames()) == 9
    shutil.move("away", "in/1.svg")
    assert statuses(*line, "-n", "5") == (0, "done")
    assert statuses(*line, "-n", "5", "--clean") == (0, "current")
    assert len(frames()) == 5
