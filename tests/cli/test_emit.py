"""`--emit`: where it is written, and what is refused."""

import json

import pytest

from shapeblend_cli.cli import run
from tests.support.drawings import BAR, LEAF, RING, svg

FORMS_OF_FILES = [
    ("pair", ["blend", "blend/a.svg", "blend/b.svg"]),
    ("lottie", ["blend.json"]),
    ("avd", ["blend.xml"]),
]


@pytest.fixture
def here(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for name, d in (("a", BAR), ("b", LEAF), ("c", RING)):
        (tmp_path / f"{name}.svg").write_text(svg(d), encoding="utf-8")
    return tmp_path


def made(folder):
    """What there is beside the three drawings."""
    inputs = ("a.svg", "b.svg", "c.svg")
    found = sorted(path.relative_to(folder).as_posix() for path in folder.rglob("*"))
    return [name for name in found if name not in inputs]


@pytest.mark.parametrize(("emit", "names"), FORMS_OF_FILES)
def test_default_names_which_only_force_replaces(here, capsys, emit, names):
    assert run(["a.svg", "b.svg", "--emit", emit]) == 0
    assert made(here) == names
    assert capsys.readouterr() == ("", "")
    before = {name: (here / name).read_bytes() for name in names if "." in name}
    assert run(["b.svg", "c.svg", "--emit", emit]) == 1
    first = next(iter(before))
    assert capsys.readouterr().err == f"shapeblend: {first}: exists; --force replaces it\n"
    assert {name: (here / name).read_bytes() for name in before} == before
    assert run(["b.svg", "c.svg", "--emit", emit, "--force"]) == 0
    assert all((here / name).read_bytes() != text for name, text in before.items())
    assert made(here) == names


def test_frames_are_the_default(here):
    assert run(["a.svg", "b.svg", "-o", "one"]) == 0
    assert run(["a.svg", "b.svg", "-o", "two", "--emit", "frames"]) == 0
    assert [p.read_bytes() for p in sorted((here / "one").iterdir())] == [
        p.read_bytes() for p in sorted((here / "two").iterdir())
    ]


@pytest.mark.parametrize(
    ("emit", "output", "names"),
    [
        ("pair", "some/where", ["some", "some/where", "some/where/a.svg", "some/where/b.svg"]),
        ("lottie", "deep/x.JSON", ["deep", "deep/x.JSON"]),
        ("avd", "res/x.xml", ["res", "res/x.xml"]),
    ],
)
def test_names_that_are_given(here, emit, output, names):
    assert run(["a.svg", "b.svg", "--emit", emit, "-o", output]) == 0
    assert made(here) == names


@pytest.mark.parametrize(("emit", "names"), FORMS_OF_FILES)
def test_the_report_has_the_form(here, emit, names):
    assert run(["a.svg", "b.svg", "--emit", emit, "-n", "2", "--report", "r.json"]) == 0
    report = json.loads((here / "r.json").read_text(encoding="utf-8"))
    assert (report["settings"]["emit"], report["settings"]["output"]) == (emit, names[0])
    assert [frame["file"] for frame in report["frames"]] == [None, None]


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--emit", "gif"], "gif"),
        (["--emit", "pair", "-o", "-"], "a.svg and b.svg, so --output takes a folder; - given"),
        (["--emit", "pair", "-o", "x.svg"], "a folder; x.svg given"),
        (["--emit", "lottie", "-o", "x"], "ending in .json, or -; x given"),
        (["--emit", "lottie", "-o", "x.svg"], "ending in .json"),
        (["--emit", "avd", "-o", "x.json"], "ending in .xml"),
        (["--emit", "avd", "-o", "-", "--report", "-"], "standard output"),
        (["-o", "x.json"], "--emit lottie"),
        (["-o", "x.xml"], "--emit avd"),
        (["c.svg", "--emit", "pair"], "two files; 3 given"),
        (["c.svg", "--emit", "avd"], "two files; 3 given"),
    ],
)
def test_a_wrong_combination_is_exit_2(here, capsys, arguments, words):
    assert run(["a.svg", "b.svg", *arguments]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert words in line
    assert made(here) == []


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--emit", "pair", "-o", ".", "--force"], "a.svg: is an input"),
        (["--emit", "pair", "-o", "c.svg/x"], "c.svg: is a file"),
        (["--emit", "lottie", "--report", "blend.json"], "blend.json: is named for two"),
    ],
)
def test_targets_that_must_not_be_written(here, capsys, arguments, words):
    before = {name: (here / name).read_bytes() for name in ("a.svg", "b.svg", "c.svg")}
    assert run(["a.svg", "b.svg", *arguments]) == 1
    (line,) = capsys.readouterr().err.splitlines()
    assert words in line
    assert {name: (here / name).read_bytes() for name in before} == before
    assert made(here) == []


def test_nothing_is_left_when_writing_the_second_fails(here, monkeypatch, capsys):
    from shapeblend_cli import output

    replace, calls = output.os.replace, []

    def fail_at_the_second(source, target):
        calls.append(target)
        if len(calls) == 2:
            raise OSError(28, "No space left on device")
        replace(source, target)

    monkeypatch.setattr(output.os, "replace", fail_at_the_second)
    assert run(["a.svg", "b.svg", "--emit", "pair"]) == 1
    assert "No space left" in capsys.readouterr().err
    assert made(here) == []
