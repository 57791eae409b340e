"""Files that grow by whole lines: results and messages."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from shapeblend_cli.batch.lines import add_results
from shapeblend_cli.cli import run
from tests.support.commands import assert_refused

pytestmark = pytest.mark.usefixtures("forked")

ROW = '{"job": 1, "status": "done"}'
ADD = """
import sys
from shapeblend_cli.batch.lines import add_results
add = add_results("r.jsonl")
for k in range(300):
    add('{"job": %d, "status": "%s"}' % (k, sys.argv[1] * (1 + 97 * k)))
"""


@pytest.mark.parametrize(
    "text", ['{"a": "1.svg", "b": "2.svg"}\n', "<svg/>", "\0" * 9, "[" * 10**5, "a: b\n\tc\n"]
)
@pytest.mark.parametrize(
    "option", ["--results mine", "--log-file mine", "--summary mine.xml", "--depfile mine.d"]
)
def test_a_file_of_another_kind_is_refused_and_stays(option, text, drawings, capsys):
    flag, name = option.split()
    Path(name).write_text(text, "utf-8")
    line = ["batch", "--chain", "in", flag, name]
    assert_refused(capsys, line, "and stays as it is; another name would work", status=1)


def test_results_of_earlier_runs_are_kept(drawings, capsys):
    line = ["batch", "--chain", "in", "-o", "m/{n}.svg", "--results", "r.jsonl"]
    assert run(line) == run(line) == 0
    found = [json.loads(each) for each in Path("r.jsonl").read_text("utf-8").splitlines()]
    assert [each["status"] for each in found] == ["done"] * 3 + ["current"] * 3
    assert {each["output"] for each in found} == {f"m/{n}.svg" for n in (1, 2, 3)}


def test_processes_that_share_a_file_write_whole_lines(here):
    writers = [subprocess.Popen([sys.executable, "-c", ADD, letter]) for letter in "abc"]
    assert [writer.wait(60) for writer in writers] == [0, 0, 0]
    found = [json.loads(each)["status"] for each in Path("r.jsonl").read_text("utf-8").splitlines()]
    assert sorted(map(len, found)) == sorted(3 * [1 + 97 * k for k in range(300)])
    assert all(len({*text}) == 1 for text in found)


@pytest.mark.parametrize(("end", "stays"), [(ROW, True), ('{"job": 2, "sta', False)])
def test_a_line_that_was_cut_off_goes(end, stays, here):
    Path("r.jsonl").write_text(f"{ROW}\n{end}", "utf-8")
    add_results("r.jsonl")(ROW)
    assert Path("r.jsonl").read_text("utf-8") == f"{ROW}\n" * (3 if stays else 2)


def test_a_device_or_a_pipe_is_written_to_as_it_is(here):
    os.mkfifo("pipe")
    with subprocess.Popen(["head", "-n", "2", "pipe"], stdout=subprocess.PIPE) as reader:
        add = add_results("pipe")
        add(ROW)
        add(ROW)
        assert reader.stdout.read() == f"{ROW}\n{ROW}\n".encode()
