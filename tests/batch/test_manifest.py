"""Which jobs a batch has, and what is refused before anything starts."""

import cProfile
import io
import json
import sys
from pathlib import Path

import pytest

from shapeblend_cli.cli import run
from shapeblend_cli.rows.row import RECORDS, command_of, options_of
from tests.support.commands import assert_refused, contents, names

pytestmark = pytest.mark.usefixtures("forked")

ROWS = [
    {"a": "1.svg", "b": "2.svg", "o": "x.svg", "duration": 3, "curves": False, "match": ["0=0"]},
    {"a": "2.svg", "b": "9.svg", "c": "10.svg", "output": "y", "frames": 2, "ends": True},
]
AS_JSON_LINES = "\n\n".join(map(json.dumps, ROWS))
AS_CSV = "a,b,c,o,duration,polygons,match,frames,ends\n1.svg,2.svg,,x.svg,3,yes,0=0,,\n2.svg,9.svg,10.svg,y,,,,2,true\n"
AS_TOML = """
[defaults]
frames = 2
[[job]]
a = "1.svg"
b = "2.svg"
o = "x.svg"
duration = 3
polygons = true
match = ["0=0"]
[[job]]
files = ["2.svg", "9.svg", "10.svg"]
output = "y"
ends = true
"""


@pytest.mark.parametrize(
    ("name", "text"), {"jobs.jsonl": AS_JSON_LINES, "jobs.csv": AS_CSV, "jobs.toml": AS_TOML}.items()
)
def test_a_row_is_what_a_command_line_would_be(name, text, drawings, statuses):
    Path("in", name).write_text(text, "utf-8")
    assert statuses(f"in/{name}") == (0, "done done")
    single = "in/1.svg in/2.svg -o x.svg --duration 3 --polygons --match 0=0"
    assert run(single.split()) == 0
    assert Path("in/x.svg").read_bytes() == Path("x.svg").read_bytes()
    assert run("in/2.svg in/9.svg in/10.svg -o y -n 2 --ends".split()) == 0
    frames = {path.name: path.read_bytes() for path in Path("in/y").iterdir()}
    assert frames == {path.name: path.read_bytes() for path in Path("y").iterdir()}
    assert len(frames) == 2 * 2 + 3


def test_standard_input_has_json_lines(drawings, monkeypatch):
    text = json.dumps({"a": "in/1.svg", "b": "in/2.svg"}).encode()
    monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(text)))
    assert run(["batch", "-", "-q"]) == 0
    assert Path("blend/in/1-2/frame-5.svg").is_file()


def test_the_command_line_counts_more_than_defaults_and_less_than_a_row(drawings, statuses):
    row = "\n[[job]]\na = '1.svg'\nb = '2.svg'\n"
    Path("in/jobs.toml").write_text(f"[defaults]\nframes = 2{row}{row}o = 'more'\nframes = 4", "utf-8")
    assert statuses("in/jobs.toml", "-n", "3", "-o", "three") == (0, "done done")
    assert len(names("three")) == 3
    assert len(names("in/more")) == 4


def test_a_name_may_be_as_long_as_its_record_allows(drawings, statuses):
    name = 246 * "x" + ".svg"
    assert statuses("--chain", "in/[12].svg", "-o", f"m/{name}") == (0, "done")
    assert statuses("--chain", "in/[12].svg", "-o", f"m/{name}") == (0, "current")


def test_doubled_braces_are_braces(drawings, statuses):
    Path("in/jobs.csv").write_text("a,b,o\n1.svg,2.svg,{{a}}-{b}{{{n}}}.svg\n", "utf-8")
    assert statuses("in/jobs.csv") == (0, "done")
    assert Path("in/{a}-2{1}.svg").is_file()


AB = '{"a": "1.svg", "b": "2.svg"'
WRONG = {
    '{"a": "1.svg", "b": "2.svg", "vertexes": 3}': "line 2: 'vertexes' is no option of a job",
    '{"a": "1.svg", "b": "2.svg", "vertices": -3}': "line 2: vertices must be 0 or more, not -3",
    '{"a": "1.svg", "b": "2.svg", "fps": 9, "frames": 3, "o": "x.gif"}': "line 2: --frames and --fps both set",
    '{"a": "1.svg", "b": "2.svg", "durration": 3}': "line 2: 'durration' is no option of a job; duration would work",
    '{"a": "1.svg", "b": "2.svg", "quiet": true}': "line 2: 'quiet' is no option of a job",
    '{"a": "1.svg", "b": "2.svg", "ends": "perhaps"}': "line 2: ends must be True or False",
    '{"a": "1.svg", "b": "2.svg", "o": "y.svg", "output": "z.svg"}': "line 2: output is given twice",
    '{"a": "1.svg", "b": "2.svg", "o": "{x}.svg"}': "line 2: {x}.svg has {x}; {a}, {b}, {n} would work, and {{ for",
    '{"a": "1.svg", "b": "2.svg", "o": "-"}': "line 2: a batch writes files",
    '{"a": "1.svg", "b": "2.svg", "frames": 0}': "line 2: nothing is written",
    '{"a": "1.svg", "b": "2.svg", "images": "beside"}': "line 2: --images beside: a batch would not notice",
    '{"a": "1.svg", "b": "2.svg", "o": "./x.svg"}': "line 2: in/x.svg is written by in/jobs.jsonl, line 1 as well",
    '{"a": "1.svg", "b": "2.svg", "o": "2.svg"}': "line 2: in/2.svg would be written, which in/jobs.jsonl, line 1",
    f'{AB}, "o": "x.svg/y.svg"}}': "line 2: in/x.svg/y.svg is in in/x.svg, which in/jobs.jsonl, line 1 writes as",
    f'{AB}, "o": "y"}}\n{AB}, "o": "y/z/z.svg"}}': "line 3: in/y/z/z.svg is in in/y, where in/jobs.jsonl, line 2",
    f'{AB}, "o": "y/z.svg"}}\n{AB}, "o": "y"}}': "line 2: in/y/z.svg is in in/y, where in/jobs.jsonl, line 3 writes",
    f'{AB}, "o": "y"}}\n{AB}, "o": "y", "format": "png"}}': "line 3: in/y is written by in/jobs.jsonl, line 2 as well",
    f'{AB}, "o": "{251 * "x"}"}}': "line 2: in/xxx",
    f'{AB}, "o": "{256 * "x"}/y.svg"}}': "line 2: in/xxx",
    f'{AB}, "o": "\\u0000.svg"}}': r"line 2: 'in/\x00.svg' has a character that no file's name can have",
    f'{AB}, "o": "\\ud800.svg"}}': r"line 2: 'in/\ud800.svg' has a character that no file's name can have",
    '{"a": "1.svg", "b": "\\u0000.svg"}': r"line 2: 'in/\x00.svg' has a character that no file's name can have",
    '{"a": "1.svg"}': "line 2: a job has drawings a and b",
    '{"a": "1.svg", "c": "2.svg"}': "line 2: a job has drawings a and b",
    '{"a": "-", "b": "2.svg"}': "line 2: a drawing must be the name of a file, not '-'",
    '{"files": "1.svg"}': "line 2: files must be a list",
    '{"a": "1.svg", "a": "2.svg", "b": "2.svg"}': "line 2: not a JSON object (a key is given twice)",
    '{"a": "1.svg"': "line 2: not a JSON object",
    "[1]": "line 2: not a JSON object",
}


@pytest.mark.parametrize("row", WRONG)
def test_what_is_wrong_stops_the_batch_before_it_starts(row, drawings, capsys):
    Path("in/jobs.jsonl").write_text('{"a": "1.svg", "b": "2.svg", "o": "x.svg"}\n' + row, "utf-8")
    before = contents()
    assert run(["batch", "in/jobs.jsonl", "--results", "results.jsonl"]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert line.startswith(f"shapeblend: in/jobs.jsonl, {WRONG[row]}")
    assert contents() == before


CLASHING = {
    "a folder": ('"o": "y"', "--output 'y/{n}'"),
    "a file": ('"o": "y.svg"', "--output 'y-{n}.svg'"),
    "a file with fields": ('"o": "{a}-{b}.svg"', "{n} in --output"),
    "a report": ('"o": "{n}.svg", "report": "r.json"', "--report 'r-{n}.json'"),
    "a report with fields": ('"o": "{n}.svg", "report": "{a}.json"', "{n} in --report"),
    "the file of the best": ('"o": "{n}.svg", "try": "t.svg"', "--try 't-{n}.svg'"),
}


@pytest.mark.parametrize(("names", "remedy"), CLASHING.values(), ids=CLASHING)
def test_what_would_tell_two_jobs_of_the_same_drawings_apart(names, remedy, drawings, capsys):
    Path("in/jobs.jsonl").write_text(2 * f'{{"a": "1.svg", "b": "2.svg", {names}}}\n', "utf-8")
    assert_refused(capsys, ["batch", "in/jobs.jsonl"], f"as well; {remedy} would tell them apart")


@pytest.mark.parametrize(
    ("name", "text", "words"),
    [
        ("jobs.csv", "a,b,vertexes\n1.svg,2.svg,3\n", "jobs.csv, line 1: 'vertexes' is no option"),
        ("jobs.csv", 'a,b\n"1.svg",2.svg\n"1\n.svg",2.svg,3\n', "jobs.csv, line 3: 3 cells, and 2 columns"),
        ("jobs.csv", "a,b,n\n1.svg,2.svg,3\n", "jobs.csv, line 1: 'n' is no option"),
        ("jobs.csv", "a;b;o\n1.svg;2.svg;x.svg\n", "jobs.csv, line 1: a;b;o has no commas; a,b,o would work"),
        ("jobs.csv", "a\n1.svg\n", "jobs.csv, line 2: a job has drawings a and b"),
        ("jobs.csv", "a,b,b\n", "jobs.csv, line 1: two columns have the same name"),
        ("jobs.toml", "[[job]]\na='1.svg'\nb='2.svg'\n[[job]]\na='1.svg'\n", "jobs.toml, line 4: a job has"),
        ("jobs.toml", "[default]\nframes = 3\n", "jobs.toml: 'default' is unknown"),
        ("jobs.toml", "[defaults]\nframes = 'x'\n", "jobs.toml, [defaults]: frames must be a whole number"),
        ("jobs.toml", "[[job]\n", "jobs.toml: "),
        *(
            (f"jobs.{kind}", text, "no jobs found")
            for kind, text in (("csv", "a,b\n"), ("jsonl", ""), ("toml", ""))
        ),
        ("jobs.txt", "", "jobs.txt: a manifest ends in .jsonl, .csv or .toml"),
    ],
)
def test_what_is_wrong_in_other_manifests(name, text, words, here, capsys):
    Path(name).write_text(text, "utf-8")
    assert_refused(capsys, ["batch", name], words)


@pytest.mark.parametrize(
    ("line", "words"),
    [
        ("", "a batch is one of: a manifest, --pairs FROM TO, --chain '*.svg', --all FOLDER"),
        ("jobs.csv --all in", "a batch is one of"),
        ("--pairs in in in/1.svg", "a batch is one of"),
        ("--all in --chain in", "a batch is one of"),
        (
            "in",
            "in: is a folder, not a manifest; --chain in would blend each drawing in it with the next one",
        ),
        ("--all none", "--all: none is no folder"),
        ("--chain none*.svg", "--chain none*.svg: no drawings found; it takes two"),
        ("--chain in -o in/{a}.svg", "in/1.svg would be written, and is one of its drawings"),
        ("--pairs in in -o out", "--output 'out/{a}' would tell them apart"),
        ("--pairs in in -o o.svg", "--output 'o-{a}.svg' would tell them apart"),
        ("--chain in -o out/", "--output 'out/{a}-{b}' would tell them apart"),
        ("--chain in -o m/{n}.svg --report r.json", "--report 'r-{a}-{b}.json' would tell them apart"),
        ("--pairs in none", "--pairs: none is no folder"),
        ("--chain in -o in/{a}-{b}.svg", "in/1-2.svg would be taken for one of the drawings the next time"),
        ("--chain in --shard 3/2", "--shard must be K/N, with K from 1 to N, such as 3/16, not '3/2'"),
        ("--chain in --results in/1.svg", "in/1.svg: is read or written by the batch"),
        ("--chain in --results x --log-file ./x", "./x: is read or written by the batch"),
        ("- --watch", "--watch goes with a manifest that is a file, or with folders"),
        ("--chain in --dry-run --watch", "--watch goes with a manifest that is a file, or with folders"),
        ("- --clean", "--clean goes with a whole batch"),
        ("--chain in --shard 1/2 --clean", "--clean goes with a whole batch"),
        ("--chain in --fail-fast --keep-going 2", "--fail-fast is --keep-going 1; one of the two would work"),
        ("--chain in --jobs 2 --cluster tcp://1:2", "--jobs is for processes on this machine"),
        *(
            (
                f"--chain in --cluster {address}",
                "must be the address of a scheduler, such as tcp://192.168.0.1:8786",
            )
            for address in ("127.0.0.1", "tcp://", "nowhere")
        ),
    ],
)
def test_what_does_not_go_together_on_the_command_line(line, words, drawings, capsys):
    assert_refused(capsys, ["batch", *line.split()], words, status=1 if "results" in line else 2)


def test_a_command_line_is_what_gives_the_same_values():
    values = {
        "frames": 3, "ends": True, "curves": False, "ks": 0.3, "band": "none", "pin": ["0,3", "1.5,2:3,4"],
        "stiff": ["10,20,5=3"], "match": ["0=1", "left=right", "120,40:98,44"], "start": "0,3", "lenient": False,
        "ease": "ease-in", "repeat": "pingpong", "background": "white", "timeout": 2.5, "select_a": "#x y",
    }  # fmt: skip
    given = options_of(values, "here", "")
    _, *words = command_of((), given)
    again = {}
    flags = {flag: field for r in RECORDS for field in r.options.values() for flag in field.flags}
    while words:
        flag = words.pop(0)
        name = flag.lstrip("-")
        if flag in flags and flags[flag].metavar:
            again.setdefault(name, []).append(words.pop(0))
        else:
            again[name] = True
    again = {name: v[0] if v is not True and len(v) == 1 else v for name, v in again.items()}
    assert options_of(again, "here", "") | {"lenient": False} == given


@pytest.mark.parametrize("output", ["../{n}.svg", "{root}/{n}.svg", "link/{n}.svg"])
def test_a_manifest_writes_outside_its_folder_only_if_the_command_line_says_so(
    drawings, statuses, output, capsys
):
    Path("in/link").symlink_to("..")
    row = json.dumps({"a": "1.svg", "b": "2.svg", "o": output.replace("{root}", str(drawings))})
    Path("in/jobs.jsonl").write_text(row, "utf-8")
    assert run(["batch", "in/jobs.jsonl"]) == 2
    assert "lies outside the folder of the manifest; --outside" in capsys.readouterr().err
    assert not Path("1.svg").exists()
    assert statuses("in/jobs.jsonl", "--outside") == (0, "done")
    assert Path("1.svg").exists()


def test_a_manifest_replaces_nothing_by_itself(drawings, capsys):
    row = json.dumps({"a": "1.svg", "b": "2.svg", "o": "x.svg", "force": True})
    Path("in/jobs.jsonl").write_text(row, "utf-8")
    assert run(["batch", "in/jobs.jsonl"]) == 2
    assert "line 1: force replaces files, and only the command line can say it" in capsys.readouterr().err


def planned(count, capsys):
    """Plan so many rows of a manifest."""
    rows = "".join(f"in/{'12'[k % 2]}.svg,in/9.svg,m/{k}.svg\n" for k in range(count))
    Path("jobs.csv").write_text("a,b,o\n" + rows, "utf-8")
    assert run(["batch", "jobs.csv", "--dry-run"]) == 0
    assert len(capsys.readouterr().out.splitlines()) >= count


def calls(count, capsys):
    """How many functions are called to plan so many rows."""
    profile = cProfile.Profile()
    profile.runcall(planned, count, capsys)
    return sum(each.callcount for each in profile.getstats())


def test_a_row_among_many_is_planned_by_as_much_work_as_among_few(drawings, capsys):
    planned(20, capsys)
    assert calls(1_000, capsys) < 6 * calls(200, capsys)
