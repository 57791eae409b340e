"""Outputs that are kept for other checkouts and for other machines."""

import shutil
import subprocess
from pathlib import Path

import pytest

from shapeblend_cli.cli import run
from tests.batch.test_workers import COMMAND, many, wait_for
from tests.support.commands import assert_refused

pytestmark = pytest.mark.usefixtures("forked")

LINE = ("--chain", "in", "-o", "m/{n}.svg", "--cache", "../cache")


@pytest.fixture
def checkout(here, monkeypatch):
    """Make a folder for a checkout, and go there; with the drawings of the first one, if there is one."""

    def make(name):
        source = here / "first" / "in"
        (here / name).mkdir()
        monkeypatch.chdir(here / name)
        if source.exists():
            shutil.copytree(source, "in", copy_function=shutil.copyfile)

    return make


@pytest.fixture
def alone(monkeypatch):
    """From now on no process can be started that does jobs."""
    return lambda: monkeypatch.setattr("shapeblend_cli.system.processes.START", "raise SystemExit(1)")


def made():
    return {path.name: path.read_bytes() for path in Path("m").glob("*.svg")}


def entries():
    return [path for path in Path("../cache").rglob("*") if path.is_file()]


def test_a_batch_that_was_killed_does_what_is_missing_and_a_second_checkout_nothing(
    checkout, broken, batch, alone
):
    checkout("first")
    many(13)
    broken("output == 'm/06.svg' and hold()")
    process = subprocess.Popen(
        [*COMMAND, *LINE, "-j", "2", "--results", "r.jsonl"], stderr=subprocess.DEVNULL
    )
    wait_for("r.jsonl", b'"done"')
    process.kill()
    process.wait()
    Path("go").touch()
    status, results, _ = batch(*LINE)
    assert (status, {each["status"] for each in results.values()}) == (0, {"current", "done"})
    before = made()
    assert run(["in/0.svg", "in/1.svg", "-o", "single.svg"]) == 0
    assert Path("single.svg").read_bytes() == before["01.svg"]
    checkout("second")
    alone()
    status, results, printed = batch(*LINE)
    assert (status, len(results)) == (0, 12)
    assert all(each["cached"] and each["attempts"] == 0 for each in results.values())
    assert printed.err.endswith("shapeblend: 12 from the cache\n")
    assert made() == before


def test_only_what_is_made_of_the_same_is_taken(checkout, statuses, capsys):
    checkout("first")
    many(3)
    line = ("--chain", "in", "-n", "1", "--cache", "../cache")
    assert statuses(*line, "-o", "m/{n}.svg") == (0, "done done")
    for more in (
        ["-o", "m/{n}"],
        ["-o", "n/{n}.svg", "--duration", "3"],
        ["-o", "o/{n}.svg", "--preview", "{n}.html"],
    ):
        assert run(["batch", *line, *more, "--dry-run"]) == 0
        assert "cache" not in capsys.readouterr().out
    checkout("second")
    shutil.copy("in/0.svg", "in/2.svg")
    assert run(["batch", *line, "-o", "elsewhere/{n}.svg", "--dry-run"]) == 0
    reason = "it has not been done yet"
    assert (
        capsys.readouterr().out == f"elsewhere/1.svg\t{reason}; the cache has it\nelsewhere/2.svg\t{reason}\n"
    )


def test_reports_have_the_names_that_were_typed(checkout, capsys):
    checkout("first")
    many(2)
    line = ("-o", "x", "--report", "r.json", "--cache", "../cache")
    assert run(["batch", "--chain", "in", *line]) == 0
    before = Path("r.json").read_bytes()
    checkout("second")
    assert run(["batch", "--chain", str(Path("in").resolve()), *line, "--dry-run"]) == 0
    assert "cache" not in capsys.readouterr().out
    assert run(["batch", "--chain", "in", *line]) == 0
    assert Path("r.json").read_bytes() == before


@pytest.mark.parametrize(
    "damage", [lambda data: b"", lambda data: data[:-1], lambda data: data.replace(b"M", b"L", 1)]
)
def test_a_damaged_entry_counts_as_missing_and_is_made_again(damage, checkout, batch):
    checkout("first")
    many(2)
    assert run(["batch", *LINE]) == 0
    (entry,) = entries()
    whole = entry.read_bytes()
    entry.write_bytes(damage(whole))
    checkout("second")
    _, results, _ = batch(*LINE)
    assert (results[1]["status"], results[1]["cached"]) == ("done", False)
    assert entries() == [entry]
    assert entry.read_bytes() == whole


def test_what_cannot_be_written_is_in_no_other_jobs_way(checkout, batch):
    checkout("first")
    many(3)
    line = ("--chain", "in", "-o", "m/{a}/x.svg", "--cache", "../cache")
    assert run(["batch", *line]) == 0
    checkout("second")
    Path("m").mkdir()
    Path("m/0").touch()
    status, results, _ = batch(*line)
    assert (status, results[1]["error"]) == (1, "m/0: is a file, and a folder of that name is needed")
    assert (results[2]["status"], results[2]["cached"]) == ("done", True)


def test_a_cache_that_cannot_be_a_folder(drawings, capsys):
    line = ["batch", "--chain", "in", "--cache", "in/1.svg"]
    assert_refused(
        capsys, line, "in/1.svg: cannot be a folder (File exists); another name would work", status=1
    )
