"""Batches that meet: no two write the same outputs at a time."""

import subprocess
from pathlib import Path

import pytest

from shapeblend_cli.cli import run
from tests.batch.test_workers import COMMAND, is_gone, wait_for
from tests.support.commands import assert_refused, contents, wait_until

pytestmark = pytest.mark.usefixtures("forked")

LINE = ("--chain", "in", "-o", "m/{n}.svg", "-j", "1")
OTHER = ("batch", *LINE, "--duration", "3")


@pytest.fixture
def hold(drawings, broken):
    """Start a batch whose second job waits for a file `go`; `begun` has the number of its process."""
    processes = []

    def start(*more):
        broken("output == 'm/2.svg' and hold()")
        processes.append(subprocess.Popen([*COMMAND, *LINE, *more], stderr=subprocess.DEVNULL))
        wait_for("begun")
        return processes[0]

    yield start
    Path("go").touch()
    for process in processes:
        process.kill()
        process.wait()


def made():
    return {path.name: path.read_bytes() for path in Path("m").glob("*.svg")}


def test_another_batch_is_refused_in_a_line_or_waits(hold, capsys):
    first = hold()
    wait_until(lambda: Path("m/1.svg").exists() and not [*Path("m").glob(".shapeblend-*")])
    assert_refused(
        capsys, OTHER, f"m/1.svg: another batch is writing this, process {first.pid} on ", status=1
    )
    line = [*COMMAND, *OTHER[1:], "--wait"]
    with subprocess.Popen(line, stderr=subprocess.PIPE) as second:
        assert b"waiting until that has ended" in second.stderr.readline()
        Path("go").touch()
        assert first.wait(60) == 0
        assert b"3 done" in second.stderr.read()
    assert run(["batch", *LINE, "--dry-run"]) == 0
    assert capsys.readouterr().out.count("duration is 2.0, and was 3.0") == 3
    assert not [*Path("m").rglob("*.claim")]


def test_a_batch_that_was_killed_is_in_nobodys_way_and_its_processes_write_no_more(hold):
    first = hold()
    first.kill()
    first.wait()
    worker = int(Path("begun").read_text())
    assert run([*OTHER, "-q"]) == 0
    before = contents("m")
    Path("go").touch()
    assert is_gone(worker)
    assert contents("m") == before
    assert len(made()) == 3


def test_shards_and_batches_with_other_outputs_share_a_folder(hold, capsys):
    hold("--shard", "2/3")
    for shard in ("1/3", "3/3"):
        assert run(["batch", *LINE, "-q", "--shard", shard]) == 0
    others = ["m/other-{n}.svg" if word == "m/{n}.svg" else word for word in LINE]
    assert run(["batch", *others, "-q"]) == 0
    assert_refused(capsys, OTHER, "m/2.svg: another batch is writing this", status=1)


def test_nothing_is_left_of_a_claim_where_nothing_is_written(drawings, capsys):
    Path("in/1.svg").write_text("<svg/>", "utf-8")
    before = contents()
    assert run(["batch", "--chain", "in/[12].svg", "-o", "m/{a}/{n}.svg"]) == 1
    assert contents() == before
