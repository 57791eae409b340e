"""Jobs done by a dask cluster: of one process that has all of it, and of commands in a shell that share no folder."""

import json
import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from tests.support.commands import write
from tests.support.dask_processes import ADDRESS, SCHEDULER, worker
from tests.support.drawings import BAR, LEAF, svg

pytest.importorskip("distributed")

BATCH = [sys.executable, "-m", "shapeblend_cli", "batch"]
LINE = ("--chain", "in", "-o", "m/{n}.svg", "--results", "r.jsonl")
COUNT = 16

# What every Python does first that has this on its path. A drawing says what is to happen to the job that it is in.
BROKEN = """
import os, time
import shapeblend_cli.batch.records as records
import shapeblend_cli.batch.worker as worker

do = worker.do

def broken(order):
    data = b"".join(order.data or ())
    if b"<!-- slow -->" in data:
        time.sleep(0.2)
    if b"<!-- ends its process -->" in data:
        os._exit(3)
    if b"<!-- ends its worker -->" in data:
        os.kill(os.getppid(), 9)
        time.sleep(60)
    return do(order)

worker.do = broken
if os.environ.get("OTHER_VERSION"):
    records.method = lambda: "another"
if os.environ.get("IMPATIENT"):
    import shapeblend_cli.batch.cluster as cluster
    cluster.PATIENCE = 0.5
"""

# Either gives the address of a scheduler, and ends with it.
LOCAL = """
import time
from distributed import LocalCluster
if __name__ == "__main__":
    cluster = LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None)
    print(cluster.scheduler_address, flush=True)
    while True:
        time.sleep(1)
"""
WORKERS = """
import os, sys
from distributed import Client
client = Client(sys.argv[1], timeout=30)
client.wait_for_workers(int(sys.argv[2]), timeout=60)
print(*client.run(os.getpid).values())
"""


class Cluster:
    """A scheduler and its workers, in processes that end with it."""

    def __init__(self, home, kind):
        self.home = home
        (home / "broken").mkdir()
        (home / "broken" / "sitecustomize.py").write_text(BROKEN, "utf-8")
        self.environment = {
            **os.environ,
            "PYTHONPATH": str(home / "broken"),
            "DASK_DISTRIBUTED__SCHEDULER__ALLOWED_FAILURES": "1",
        }
        self._processes = []
        try:
            self._begin(kind)
        except BaseException:
            self.end()
            raise

    def _begin(self, kind):
        home = self.home
        if kind == "local":
            (home / "local.py").write_text(LOCAL, "utf-8")
            self.scheduler = self._start(sys.executable, "local.py", stdout=subprocess.PIPE)
            self.address = self.scheduler.stdout.readline().decode().strip()
        else:
            self.scheduler = self._start(*SCHEDULER)
            file = wait_for(home / ADDRESS, b"}")
            self.address = json.loads(file.read_text("utf-8"))["address"]
            for name in "one", "two":
                self.add_worker(name)
        self.workers(2)

    def add_worker(self, name, **environment):
        """Start one more worker, in a folder of its own."""
        folder = self.home / name
        folder.mkdir()
        return self._start(*worker(self.address, folder), cwd=folder, **environment)

    def workers(self, count):
        """The numbers of the processes of at least so many workers."""
        command = [sys.executable, "-c", WORKERS, self.address, str(count)]
        done = subprocess.run(command, capture_output=True, check=True, text=True, timeout=120)
        return list(map(int, done.stdout.split()))

    def client(self, *arguments, **environment):
        """Start a batch on this cluster."""
        line = [*BATCH, *arguments, "--cluster", self.address]
        environment = {**self.environment, **environment}
        return subprocess.Popen(line, env=environment, stderr=subprocess.PIPE, text=True)

    def run(self, *arguments, **environment):
        """Run a batch on this cluster; its status, results by number, and what it printed."""
        process = self.client(*arguments, **environment)
        _, printed = process.communicate(timeout=240)
        return process.returncode, read_results(), printed

    def end(self):
        for process in reversed(self._processes):
            process.terminate()
        for process in self._processes:
            try:
                process.wait(10)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
            if process.stdout is not None:
                process.stdout.close()

    def _start(self, *command, cwd=None, stdout=subprocess.DEVNULL, **environment):
        environment = {**self.environment, **environment}
        options = {"stdout": stdout, "stderr": subprocess.DEVNULL, "stdin": subprocess.DEVNULL}
        process = subprocess.Popen(command, cwd=cwd or self.home, env=environment, **options)
        self._processes.append(process)
        return process


@pytest.fixture(scope="module")
def cluster(tmp_path_factory):
    """Give a cluster of commands in a shell."""
    found = Cluster(tmp_path_factory.mktemp("cluster"), "shell")
    yield found
    found.end()


@pytest.fixture
def local_cluster(tmp_path_factory):
    """Give a cluster of one process; what a worker is, and how it comes back, is the only thing that differs."""
    found = Cluster(tmp_path_factory.mktemp("local"), "local")
    yield found
    found.end()


@pytest.fixture
def slow(here):
    """A folder of drawings for 16 jobs, each of which takes a while."""
    drawings(COUNT + 1)


def drawings(count, **happens):
    Path("in").mkdir()
    for k in range(count):
        what = happens.get(f"to{k}", "slow")
        write(**{f"in/{k}": f"<!-- {what} -->" + svg(f"M{k} 0" + (BAR if k % 2 else LEAF))})


def read_results():
    if not Path("r.jsonl").exists():
        return {}
    found = [json.loads(each) for each in Path("r.jsonl").read_text("utf-8").splitlines()]
    return {each["job"]: each for each in sorted(found, key=lambda each: each["job"])}


def statuses(results):
    return [each["status"] for each in results.values()]


def wait_for(file, text, count=1):
    end = time.monotonic() + 120.0
    while not (file.exists() and file.read_bytes().count(text) >= count):
        assert time.monotonic() < end, file
        time.sleep(0.02)
    return file


def made(folder="m"):
    return {path.name: path.read_bytes() for path in Path(folder).glob("*.svg")}


def assert_as_by_one_process(folder="m"):
    """Outputs are, byte for byte, those of a batch in one process here."""
    line = [*BATCH, "--chain", "in", "-o", "alone/{n}.svg", "-j", "1", "-q"]
    subprocess.run(line, check=True)
    assert made(folder) == made("alone")


@pytest.mark.parametrize("kind", ["local_cluster", "cluster"])
def test_a_worker_is_killed_and_what_it_was_at_is_done_by_another(request, kind, slow):
    cluster = request.getfixturevalue(kind)
    first, *_ = cluster.workers(2)
    process = cluster.client(*LINE)
    wait_for(Path("r.jsonl"), b'"done"', 3)
    os.kill(first, signal.SIGKILL)
    _, printed = process.communicate(timeout=240)
    assert process.returncode == 0, printed
    assert statuses(read_results()) == ["done"] * COUNT
    assert f"{COUNT} done" in printed
    assert_as_by_one_process()


def test_a_job_that_ends_its_process_or_its_worker_each_time_has_died(cluster, here):
    drawings(7, to0="ends its worker", to4="ends its process")
    status, results, printed = cluster.run("--chain", "in", "-o", "m/{n}.svg", "--results", "r.jsonl")
    assert (status, statuses(results)) == (1, ["died", "done", "done", "died", "died", "done"]), printed
    assert results[1]["error"].startswith("in/0.svg and in/1.svg: the process that did it died 4 times, and")
    assert results[4]["error"].endswith("died twice, with exit status 3 at last")
    assert [results[k]["attempts"] for k in (1, 2, 4)] == [4, 1, 2]
    assert len(made()) == 3


def test_a_client_is_killed_and_run_again_and_does_what_is_missing(cluster, slow):
    process = cluster.client(*LINE)
    wait_for(Path("r.jsonl"), b'"done"', 5)
    process.kill()
    process.communicate()
    before = {path: path.stat().st_mtime_ns for path in Path("m").glob("*.svg")}
    assert 5 <= len(before) < COUNT
    status, results, _ = cluster.run(*LINE)
    assert status == 0
    assert statuses(results).count("current") == len(before)
    assert statuses(results).count("done") == COUNT - len(before)
    assert all(path.stat().st_mtime_ns == time for path, time in before.items())
    assert_as_by_one_process()


def test_what_is_wrong_with_a_drawing_is_said_as_by_one_process(cluster, here):
    drawings(3)
    Path("in/1.svg").write_text("<svg/>", "utf-8")
    status, results, _ = cluster.run(*LINE)
    elsewhere = results[1]["error"]
    subprocess.run([*BATCH, *LINE, "-q"], check=False, capture_output=True)
    assert (status, elsewhere) == (1, read_results()[1]["error"])


def test_folders_of_frames_reports_and_outputs_that_are_not_its_own(cluster, here):
    drawings(3)
    line = ("--chain", "in", "-o", "m/{n}", "--report", "r/{n}.json", "-n", "2", "--results", "r.jsonl")
    Path("m/1").mkdir(parents=True)
    Path("m/1/frame-1.svg").write_text("mine", "utf-8")
    status, results, _ = cluster.run(*line)
    assert (status, statuses(results)) == (1, ["failed", "done"])
    assert results[1]["error"] == "m/1/frame-1.svg: exists; --force replaces it"
    assert json.loads(Path("r/2.json").read_text("utf-8"))["inputs"] == ["in/1.svg", "in/2.svg"]
    assert len(list(Path("m/2").glob("*.svg"))) == 2
    status, results, _ = cluster.run(*line, "--force", "--cache", "c")
    assert (status, statuses(results)) == (0, ["done", "done"])
    for folder in ("m", "r"):
        shutil.rmtree(folder)
    status, results, _ = cluster.run(*line, "--cache", "c")
    assert (status, [each["cached"] for each in results.values()]) == (0, [True, True])
    assert len(list(Path("m/2").glob("*.svg"))) == 2


def test_a_signal_ends_it_in_a_line(cluster, slow):
    process = cluster.client(*LINE)
    wait_for(Path("r.jsonl"), b'"done"', 2)
    process.send_signal(signal.SIGINT)
    _, printed = process.communicate(timeout=60)
    assert process.returncode == 130
    assert "interrupted; files that were being written are complete" in printed
    assert {each["outputs"][0] for each in read_results().values()} == {f"m/{name}" for name in made()}


def test_another_version_gets_no_jobs(cluster, here):
    drawings(5)
    status, _, printed = cluster.run(*LINE, OTHER_VERSION="yes")
    (line,) = printed.strip().splitlines()[-1:]
    assert status == 1
    assert f"{cluster.address}: none of its workers can be used; the worker tcp://" in line
    assert "of other code, and this is" in line
    assert not Path("m").exists()
    other = cluster.add_worker("other", OTHER_VERSION="yes")
    cluster.workers(3)
    status, results, printed = cluster.run(*LINE)
    assert (status, statuses(results)) == (0, ["done"] * 4)
    assert printed.count("of other code, and this is") == 1
    assert "it gets no jobs" in printed
    other.terminate()


def test_the_scheduler_is_gone(cluster, slow):
    """The last test, as it ends the cluster."""
    process = cluster.client(*LINE)
    wait_for(Path("r.jsonl"), b'"done"', 2)
    cluster.scheduler.kill()
    _, printed = process.communicate(timeout=60)
    assert process.returncode == 1
    (line,) = printed.splitlines()
    assert line.startswith(f"shapeblend: {cluster.address}: the scheduler is gone; what was written stays")
    assert statuses(read_results()).count("done") == len(made())
    status, _, printed = cluster.run(*LINE, IMPATIENT="yes")
    assert status == 1
    assert "no scheduler answers there" in printed
    assert len(printed.splitlines()) == 1
