"""`shapeblend studio` as a process: where it says it is, and how it ends."""

import http.client
import json
import os
import re
import signal
import socket
import subprocess
import sys
import time
from urllib.parse import urlsplit

import pytest

from shapeblend_cli.cli import run
from tests.support.drawings import BAR, LEAF, svg

COMMAND = [sys.executable, "-m", "shapeblend_cli", "studio", "--no-open"]


@pytest.fixture
def started(here):
    """Start a studio, and read where it is."""
    (here / "a.svg").write_text(svg(BAR))
    (here / "b.svg").write_text(svg(LEAF))
    running = []

    def start(*arguments):
        process = subprocess.Popen(
            [*COMMAND, *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
        )
        running.append(process)
        line = process.stdout.readline()
        return process, re.search(r"http://127\.0\.0\.1:\d+/\?token=\S+", line).group()

    yield start
    for process in running:
        process.kill()
        process.communicate()


def children(pid):
    """The numbers of the processes that a process has started."""
    with open(f"/proc/{pid}/task/{pid}/children") as stream:
        return [int(number) for number in stream.read().split()]


def is_there(pid):
    try:
        os.kill(pid, 0)
    except OSError:
        return False
    with open(f"/proc/{pid}/stat") as stream:
        return stream.read().split()[2] != "Z"


UNTIL_CLOSED = """
import sys
from shapeblend_cli.cli import run, studio
studio.PATIENCE = 1.5
sys.exit(run(["studio", "--no-open", "--until-closed", "a.svg", "b.svg"]))
"""


def test_it_ends_by_itself_after_its_page_if_that_is_asked_for(here):
    for name, data in {"a": BAR, "b": LEAF}.items():
        (here / f"{name}.svg").write_text(svg(data))
    process = subprocess.Popen([sys.executable, "-c", UNTIL_CLOSED], stdout=subprocess.PIPE, text=True)
    try:
        address = urlsplit(re.search(r"http:\S+", process.stdout.readline()).group())
        for _ in range(5):
            connection = http.client.HTTPConnection(address.netloc)
            connection.request("GET", f"/?{address.query}")
            assert connection.getresponse().status == 200
            connection.close()
            time.sleep(0.5)
        assert process.poll() is None
        assert process.wait(timeout=20) == 0
    finally:
        process.kill()
        process.communicate()


@pytest.mark.skipif(not os.path.exists("/proc/self/task"), reason="no /proc here")
@pytest.mark.parametrize("ending", [signal.SIGINT, signal.SIGTERM])
def test_it_says_where_it_is_and_leaves_nothing_behind(started, ending):
    process, address = started("a.svg", "b.svg", "--kb", "2")
    url = urlsplit(address)
    connection = http.client.HTTPConnection(url.hostname, url.port, timeout=30)
    connection.request("GET", f"/?{url.query}")
    response = connection.getresponse()
    assert (response.status, response.read()[:15]) == (200, b"<!doctype html>")
    connection.close()
    found = children(process.pid)
    process.send_signal(ending)
    _, said = process.communicate(timeout=30)
    assert (process.returncode, said) == (0, "")
    deadline = time.monotonic() + 20
    while any(map(is_there, found)) and time.monotonic() < deadline:
        time.sleep(0.1)
    assert not any(map(is_there, found))


def page_of(address):
    """Open the studio's page; return the connection, and the headers of what it asks for."""
    url = urlsplit(address)
    connection = http.client.HTTPConnection(url.netloc, timeout=60)
    connection.request("GET", f"/?{url.query}")
    response = connection.getresponse()
    response.read()
    headers = {"Cookie": response.headers["Set-Cookie"].partition(";")[0], "Origin": f"http://{url.netloc}"}
    headers["Content-Type"] = "application/json"
    return connection, headers


def test_a_project_writes_unasked_in_its_own_folder_alone(started, here):
    (here / "own").mkdir()
    (here / "own" / "blend.json").write_text('{"files": ["../a.svg", "../b.svg"], "output": "../made.svg"}')
    _, address = started("own/blend.json")
    connection, headers = page_of(address)
    answer = {}
    for what in ("begin", "write"):
        connection.request("POST", f"/api/{what}", json.dumps({"project": answer.get("project")}), headers)
        answer = json.loads(connection.getresponse().read())
    connection.close()
    assert answer == {"asks": {"outside": [str(here / "made.svg")], "existing": []}}


def test_it_begins_with_an_animated_svg_and_tells_at_the_end_what_was_not_saved(started):
    process, address = started("a.svg", "b.svg")
    connection, headers = page_of(address)
    connection.request("POST", "/api/begin", "{}", headers)
    project = json.loads(connection.getresponse().read())["project"]
    assert project == {"files": ["a.svg", "b.svg"], "output": "blend.svg"}
    asked = json.dumps({"project": project | {"kb": 2}, "is_present": True})
    connection.request("POST", "/api/look", asked, headers)
    assert "pairs" in json.loads(connection.getresponse().read())
    connection.close()
    process.send_signal(signal.SIGINT)
    said, _ = process.communicate(timeout=30)
    assert said.splitlines()[-1] == "What was not saved: shapeblend a.svg b.svg --kb 2 --output blend.svg"


def test_a_port_may_be_asked_for(started, capsys):
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    _, address = started("a.svg", "b.svg", "--port", str(port))
    assert urlsplit(address).port == port
    assert run(["studio", "--no-open", "--port", str(port)]) == 2
    assert f"port {port}: " in capsys.readouterr().err


@pytest.mark.parametrize(
    ("arguments", "status", "said"),
    [
        (["none.svg", "b.svg"], 1, "none.svg: cannot be read"),
        (["none.json"], 1, "none.json: cannot be read"),
        (["-", "b.svg"], 2, "not standard input"),
        (["--kb", "x"], 2, "--kb must be a number"),
        (["--port", "0"], 2, "--port must be 1 or more"),
    ],
)
def test_what_cannot_be_opened_is_said_in_a_line(here, capsys, arguments, status, said):
    assert run(["studio", "--no-open", *arguments]) == status
    (line,) = capsys.readouterr().err.splitlines()
    assert said in line
