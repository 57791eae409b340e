"""What is done again, and what is not."""

import os
import shutil
from contextlib import chdir
from pathlib import Path

import pytest

from shapeblend_cli import __version__
from shapeblend_cli.cli import run
from tests.batch.conftest import write_drawings
from tests.support.commands import contents

pytestmark = pytest.mark.usefixtures("forked")

LINE = ("--chain", "in", "-o", "m/{a}-{b}.svg")


@pytest.fixture(scope="module")
def once_done(tmp_path_factory):
    """A folder with a batch that was done."""
    folder = tmp_path_factory.mktemp("done")
    with chdir(folder):
        write_drawings()
        assert run(["batch", *LINE]) == 0
    return folder


@pytest.fixture
def done(once_done, here):
    """A batch that was done."""
    shutil.copytree(once_done, here, dirs_exist_ok=True)
    return here


def reasons(capsys, *line):
    """What a dry run says, without changing anything."""
    before = contents()
    capsys.readouterr()
    assert run(["batch", *line, "--dry-run"]) == 0
    assert contents() == before
    return dict(line.split("\t") for line in capsys.readouterr().out.splitlines())


def test_nothing_is_done_twice(done, statuses, capsys):
    assert reasons(capsys, *LINE) == {}
    before = {path: path.stat().st_mtime_ns for path in Path("m").rglob("*")}
    assert statuses(*LINE) == (0, "current current current")
    assert {path: path.stat().st_mtime_ns for path in Path("m").rglob("*")} == before
    os.utime("in/2.svg")
    assert statuses(*LINE) == (0, "current current current")


def test_what_has_changed_is_done_again(done, statuses, capsys):
    shutil.copy("in/1.svg", "in/10.svg")
    assert reasons(capsys, *LINE) == {"m/9-10.svg": "10.svg has changed"}
    assert statuses(*LINE) == (0, "current current done")
    assert statuses(*LINE) == (0, "current current current")


def test_other_settings_are_said(done, statuses, capsys):
    assert {*reasons(capsys, *LINE, "--duration", "3").values()} == {"duration is 3.0, and was 2.0"}
    assert statuses(*LINE, "--duration", "3") == (0, "done done done")
    assert reasons(capsys, *LINE, "--duration", "3", "--timeout", "100", "--max-memory", "999") == {}


def test_an_output_that_is_gone_is_made_again_and_why_is_said(done, batch, capsys):
    before = Path("m/2-9.svg").read_bytes()
    Path("m/2-9.svg").unlink()
    assert reasons(capsys, *LINE) == {"m/2-9.svg": "2-9.svg is missing"}
    status, results, printed = batch(*LINE, "--why")
    assert (status, [each["status"] for each in results.values()]) == (0, ["current", "done", "current"])
    assert "shapeblend: m/2-9.svg: 2-9.svg is missing" in printed.err
    assert "m/1-2.svg" not in printed.err
    assert Path("m/2-9.svg").read_bytes() == before


def test_results_have_the_grade_of_what_is_made_now(drawings, batch):
    _, results, _ = batch(*LINE)
    grades = [each["grade"] for each in results.values()]
    assert all(0.0 <= grade["number"] <= 3.0 and grade["name"] for grade in grades)
    _, results, _ = batch(*LINE)
    assert [each["grade"] for each in results.values()] == [None] * 3


def test_a_drawing_that_cannot_be_read_is_said_before_anything_starts(done, batch, capsys):
    Path("in/10.svg").unlink()
    Path("in/2.svg").unlink()
    Path("in/2.svg").mkdir()
    Path("jobs.csv").write_text("a,b,o\nin/1.svg,in/2.svg,m/1-2.svg\nin/9.svg,in/10.svg,x.svg\n", "utf-8")
    words = "in/{}.svg: cannot be read ({}); a readable SVG file would work"
    problems = words.format(2, "Is a directory"), words.format(10, "No such file or directory")
    said = reasons(capsys, "jobs.csv")
    assert said == {"m/1-2.svg": f"would fail: {problems[0]}", "x.svg": f"would fail: {problems[1]}"}
    status, results, _ = batch("jobs.csv")
    assert (status, [(each["error"], each["attempts"]) for each in results.values()]) == (
        1,
        [(problem, 0) for problem in problems],
    )


def test_another_version_does_everything_again(done, statuses, monkeypatch, capsys):
    monkeypatch.setattr("shapeblend_cli.batch.records.method", lambda: "another")
    assert {*reasons(capsys, *LINE).values()} == {
        f"it was done by another version of shapeblend, {__version__}"
    }


def test_an_edited_output_stays_and_that_is_said(done, batch):
    Path("m/1-2.svg").write_text("mine", "utf-8")
    status, results, printed = batch(*LINE)
    assert (status, results[1]["status"]) == (0, "current")
    assert "1-2.svg: was edited since it was written, and stays as it is" in printed.err


def test_an_edited_output_is_not_replaced_without_force(done, batch):
    Path("m/1-2.svg").write_text("mine", "utf-8")
    shutil.copy("in/9.svg", "in/1.svg")
    status, results, printed = batch(*LINE)
    assert (status, results[1]["status"], results[2]["status"]) == (1, "failed", "current")
    assert results[1]["error"] == "m/1-2.svg: was edited since a batch wrote it; --force replaces it"
    assert results[1]["error"] in printed.err
    assert Path("m/1-2.svg").read_text("utf-8") == "mine"
    status, results, _ = batch(*LINE, "--force")
    assert (status, [each["status"] for each in results.values()]) == (0, ["done"] * 3)
    assert Path("m/1-2.svg").read_text("utf-8") != "mine"


def test_what_no_batch_has_written_is_not_replaced_without_force(drawings, batch):
    assert run(["in/1.svg", "in/2.svg", "-o", "m/1-2.svg"]) == 0
    status, results, _ = batch(*LINE)
    assert (status, results[1]["error"]) == (1, "m/1-2.svg: exists; --force replaces it")
    assert [each["status"] for each in results.values()] == ["failed", "done", "done"]


def test_folders_of_frames_and_reports_are_outputs_too(drawings, statuses):
    line = ("--chain", "in", "--report", "r/{a}-{b}.json", "-n", "2")
    assert statuses(*line) == (0, "done done done")
    assert statuses(*line) == (0, "current current current")
    Path("r/1-2.json").unlink()
    Path("blend/2-9/frame-2.svg").unlink()
    assert statuses(*line) == (0, "done done current")
    assert statuses(*line) == (0, "current current current")


def test_a_batch_can_be_moved_with_its_outputs(done, statuses):
    Path("elsewhere").mkdir()
    for folder in ("in", "m"):
        shutil.move(folder, "elsewhere")
    os.chdir("elsewhere")
    assert statuses(*LINE) == (0, "current current current")


def test_a_folder_that_takes_no_records_is_named(drawings, batch):
    Path("m").mkdir()
    Path("m/.shapeblend").touch()
    _, results, _ = batch(*LINE)
    assert results[1]["error"] == "m/.shapeblend: no record of a batch can be written there (File exists)"


@pytest.mark.parametrize("damage", ["", "{", "[]", '{"record": 1}'])
def test_a_damaged_record_is_none(damage, done, batch):
    Path("m/.shapeblend/1-2.svg.json").write_text(damage, "utf-8")
    status, results, _ = batch(*LINE)
    assert (status, results[1]["error"]) == (1, "m/1-2.svg: exists; --force replaces it")
