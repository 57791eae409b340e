"""A project in a file does what its command line does."""

import json
import re

import pytest

from shapeblend_cli.cli import run
from shapeblend_cli.rows.project import parse_project, project_text
from tests.support.drawings import BAR, EYED, LEAF, svg

OPTIONS = {
    "files": ["a.svg", "b.svg"],
    "pin": ["2,6:3,14"],
    "match": ["0=0"],
    "stiff": ["12,6,20=3"],
    "polygons": True,
    "ends": True,
    "motion": "linear",
    "kb": 0.5,
    "ks": 2,
    "timeout": 30,
    "band": 0.75,
    "ease": "cubic-bezier(0.4,0,0.6,1)",
    "duration": 1.5,
    "repeat": "pingpong",
    "output": "moving.svg",
}
TYPED = (
    "a.svg b.svg --pin 2,6:3,14 --match 0=0 --stiff 12,6,20=3 --polygons --ends --motion linear "
    "--kb 0.5 --ks 2 --timeout 30 --band 0.75 --ease cubic-bezier(0.4,0,0.6,1) --duration 1.5 --repeat pingpong "
    "-o typed.svg"
)


@pytest.fixture
def folder(here):
    """A folder with drawings, which is the current one."""
    for name, path in {"a": BAR, "b": LEAF, "c": EYED}.items():
        (here / f"{name}.svg").write_text(svg(path))
    return here


def write(file, values):
    file.write_text(values if isinstance(values, str) else json.dumps(values))


def test_it_writes_what_its_command_line_writes(folder):
    write(folder / "blend.json", OPTIONS)
    assert run(["blend.json"]) == 0
    assert run(TYPED.split()) == 0
    assert (folder / "moving.svg").read_bytes() == (folder / "typed.svg").read_bytes()


def test_its_files_are_beside_it_and_what_is_typed_counts_more(folder):
    inside = folder / "inside"
    inside.mkdir()
    write(inside / "blend.json", {"files": ["../a.svg", "../b.svg"], "o": "moving.svg", "duration": 3})
    assert run(["inside/blend.json"]) == 0
    assert (inside / "moving.svg").exists()
    assert run("inside/blend.json --duration 7 -o other.svg".split()) == 0
    assert 'dur="7s"' in (folder / "other.svg").read_text()


def test_it_is_read_as_it_was_written():
    project = parse_project(json.dumps(OPTIONS).encode(), "blend.json", "")
    text = project_text(project, "")
    assert json.loads(text) == OPTIONS
    assert ".0" not in text
    assert parse_project(text.encode(), "blend.json", "") == project
    elsewhere = project_text(project, "inside")
    assert json.loads(elsewhere)["files"] == ["../a.svg", "../b.svg"]
    assert (
        parse_project(elsewhere.encode(), "inside/blend.json", "inside")
        .given["output"]
        .endswith("moving.svg")
    )


@pytest.mark.parametrize(
    ("name", "value", "words"),
    [
        ("trigger", "hover", "--trigger hover"),
        ("trigger", "menu.click", "--trigger menu.click"),
        ("ks", 2.0, "--ks 2"),
        ("timeout", 30, "--timeout 30"),
        ("hold", "0,1.5", "--hold 0,1.5"),
        ("kt", 1e-05, "--kt 1e-05"),
        ("specks", "1%", "--specks 1%"),
    ],
)
def test_values_are_written_as_they_are_typed(name, value, words):
    project = parse_project(json.dumps({"files": ["a.svg", "b.svg"], name: value}).encode(), "", "")
    assert " ".join(project.command[3:]) == words
    text = project_text(project, "")
    assert not re.search(r"\.0\b", text)
    assert parse_project(text.encode(), "", "") == project


def test_no_option_gets_lost(folder):
    project = parse_project(json.dumps(OPTIONS).encode(), "blend.json", "")
    _, *words = project.command
    assert run(words) == 0
    write(folder / "blend.json", OPTIONS)
    assert run(["blend.json", "-o", "again.svg"]) == 0
    assert (folder / "moving.svg").read_bytes() == (folder / "again.svg").read_bytes()


@pytest.mark.parametrize(
    ("content", "said"),
    [
        ("", "not JSON"),
        ("[1]", "not a JSON object"),
        ('{"files": ["a.svg"]}', "a blend needs two files"),
        ('{"files": "a.svg"}', "must be a list"),
        ('{"files": ["a.svg", "b.svg"], "fro": 1}', "'fro' is no option"),
        ('{"files": ["a.svg", "b.svg"], "frames": -1}', "frames must be 0 or more"),
        ('{"files": ["a.svg", "b.svg"], "frames": 1, "frames": 2}', "given twice"),
        ("[" * 100_000, "not JSON"),
    ],
)
def test_what_is_no_project_is_refused_in_one_line(folder, capsys, content, said):
    write(folder / "blend.json", content)
    assert run(["blend.json"]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert said in line
    assert sorted(path.name for path in folder.iterdir()) == ["a.svg", "b.svg", "blend.json", "c.svg"]


def test_it_stands_alone(folder, capsys):
    write(folder / "blend.json", OPTIONS)
    assert run(["blend.json", "c.svg"]) == 2
    assert "given alone" in capsys.readouterr().err
    assert run(["none.json"]) == 1
    assert "none.json: cannot be read" in capsys.readouterr().err


@pytest.mark.parametrize("output", ["../out.svg", "{root}/out.svg", "link/out.svg"])
def test_a_project_writes_outside_its_folder_only_if_the_command_line_says_so(folder, capsys, output):
    inside = folder / "inside"
    inside.mkdir()
    (inside / "link").symlink_to(folder)
    path = output.format(root=folder)
    write(inside / "blend.json", {"files": ["../a.svg", "../b.svg"], "o": path})
    assert run(["inside/blend.json"]) == 2
    assert "lies outside the folder of the project; --output " in capsys.readouterr().err
    assert not (folder / "out.svg").exists()
    assert run(["inside/blend.json", "-o", "out.svg"]) == 0


@pytest.mark.parametrize("value", [True, "yes"])
def test_a_project_replaces_nothing_by_itself(folder, capsys, value):
    write(folder / "blend.json", {"files": ["a.svg", "b.svg"], "o": "moving.svg", "force": value})
    (folder / "moving.svg").write_text("mine")
    assert run(["blend.json"]) == 2
    assert "only the command line can say it: --force" in capsys.readouterr().err
    assert (folder / "moving.svg").read_text() == "mine"


@pytest.mark.parametrize(
    "line",
    [
        "blend.json -o blend.json",
        "a.svg b.svg -o x.svg --timing times.json --report times.json",
        "batch jobs.jsonl --report jobs.jsonl",
        "batch jobs.jsonl --timing times.json --report times.json",
    ],
)
def test_no_file_that_is_read_is_replaced(folder, capsys, line):
    write(folder / "blend.json", {"files": ["a.svg", "b.svg"]})
    write(folder / "jobs.jsonl", {"a": "a.svg", "b": "b.svg", "o": "x.svg"})
    write(folder / "times.json", {"0": {"start": 0.5}})
    before = {path: path.read_bytes() for path in folder.iterdir()}
    assert run([*line.split(), "--force"]) in (1, 2)
    assert re.search(r"\.jsonl?( would be written, and)?:? is an input", capsys.readouterr().err)
    assert {path: path.read_bytes() for path in folder.iterdir()} == before
