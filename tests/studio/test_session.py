"""What a studio answers: blends, exports and projects are those of the command."""

import io
import json
import shlex
import zipfile

import pytest

from shapeblend_cli.cli import run
from shapeblend_cli.errors import PictureError
from shapeblend_cli.outputs.registry import FORMATS
from tests.support.drawings import BAR, EYED, I_DOT, LEAF, svg

pytestmark = pytest.mark.usefixtures("forked")

PROJECT = {"files": ["a.svg", "b.svg"], "pin": ["2,6:3,14"], "kb": 0.5}


def contents(folder):
    return {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


def typed(command, folder, monkeypatch):
    """Run a command line in a folder of its own, and return what it wrote."""
    folder.mkdir()
    for name in ("a.svg", "b.svg", "c.svg"):
        if (folder.parent / name).exists():
            (folder / name).write_bytes((folder.parent / name).read_bytes())
    before = contents(folder)
    monkeypatch.chdir(folder)
    assert run(shlex.split(command)[1:]) == 0
    monkeypatch.chdir(folder.parent)
    return {name: content for name, content in contents(folder).items() if name not in before}


@pytest.mark.parametrize("format", FORMATS, ids=lambda format: f"{format.emit}-{format.name}")
def test_an_export_is_what_the_shown_command_line_writes(client, here, monkeypatch, format):
    try:
        format.check_libraries()
    except PictureError as missing:
        pytest.skip(str(missing))
    options = {"output": f"made{format.suffix}", "frames": 3}
    if format.emit != "frames":
        options["emit"] = format.emit
    if format.has_frame_files:
        options["format"] = format.name
    if "fps" in format.defaults:
        options["duration"] = 0.4  # ten pictures, not fifty
    if "width" in format.defaults:
        options["width"] = 40
    project = PROJECT | options
    command = client.ask("look", project=project)["command"]
    before = contents(here)
    answer = client.ask("write", project=project)
    assert "error" not in answer
    written = {name: content for name, content in contents(here).items() if name not in before}
    wanted = typed(command, here / "typed", monkeypatch)
    assert written == wanted
    downloaded = client.ask("download", project=project)
    if not format.suffix and downloaded[:2] == b"PK":
        with zipfile.ZipFile(io.BytesIO(downloaded)) as archive:
            found = {name: archive.read(name) for name in archive.namelist()}
        assert found == wanted
    else:
        (content,) = wanted.values()
        if isinstance(downloaded, dict):  # of JSON, which the client has read
            assert downloaded == json.loads(content)
        else:
            assert downloaded == content


def test_a_file_is_replaced_only_if_that_is_agreed_to(client, here):
    project = PROJECT | {"output": "moving.svg", "report": "report.json"}
    mine, other = here / "moving.svg", here / "report.json"
    mine.write_text("mine")
    other.symlink_to(here / "mine.json")
    (here / "mine.json").write_text("mine")
    names = [str(mine), str(here / "mine.json")]
    for agreed in ([], names[:1], ["moving.svg", "*"]):
        asks = client.ask("write", project=project, agreed=agreed)["asks"]
        assert asks == {"outside": [], "existing": [name for name in names if name not in agreed]}
        assert (mine.read_text(), other.read_text()) == ("mine", "mine")
    written = client.ask("write", project=project, agreed=names)["written"]
    assert written == ["moving.svg", "report.json"]
    assert mine.read_text().startswith("<svg")
    assert json.loads(other.read_text())


@pytest.mark.parametrize(
    ("option", "name"),
    [
        *(("output", name) for name in ("made{}", "own/../made{}", "{here}/made{}", "own/link/made{}")),
        *((option, "own/link/made{}") for option in ("report", "preview", "try")),
    ],
)
def test_outside_its_folder_a_studio_writes_only_what_is_agreed_to(opened, here, option, name):
    (here / "own").mkdir()
    (here / "own" / "link").symlink_to(here)
    client = opened(folder="own")
    name = name.format({"report": ".json", "preview": ".html"}.get(option, ".svg"), here=here)
    project = PROJECT | {"output": "own/blend.svg", option: name}
    place = here / name.rpartition("/")[2]
    for agreed in ([], ["made.svg", str(here)]):
        asked = client.ask("write", project=project, agreed=agreed)
        assert asked == {"asks": {"outside": [str(place)], "existing": []}}
        assert contents(here / "own") == {}
        assert not place.exists()
    assert name in client.ask("write", project=project, agreed=[str(place)])["written"]
    assert place.exists()


def test_a_project_is_saved_in_its_own_folder_unless_another_is_agreed_to(opened, here):
    (here / "own").mkdir()
    client = opened(folder="own")
    asks = {"outside": [str(here / "blend.json")], "existing": []}
    assert client.ask("save", project=PROJECT, file="blend.json") == {"asks": asks}
    assert client.ask("save", project=PROJECT, file="own/blend.json")["written"] == ["own/blend.json"]
    assert client.ask("save", project=PROJECT, file="blend.json", agreed=asks["outside"])["written"]


def test_a_studio_has_no_standard_output(client, here):
    before = contents(here)
    for options in ({"output": "-", "emit": "lottie"}, {"report": "-", "output": "moving.svg"}):
        assert (
            "cannot write to standard output, -;" in client.ask("write", project=PROJECT | options)["error"]
        )
    assert contents(here) == before


def test_a_drawing_is_never_replaced(client, here):
    before = contents(here)
    for agreed in ([], [str(here / "a.svg")]):
        answer = client.ask("write", project=PROJECT | {"output": "a.svg"}, agreed=agreed)
        assert "is an input" in answer["error"]
    assert contents(here) == before


def test_a_project_that_is_saved_does_the_same(client, here, monkeypatch):
    project = PROJECT | {"output": "moving.svg"}
    assert client.ask("save", project=project, file="blend.json")["written"] == ["blend.json"]
    assert run(["blend.json"]) == 0
    by_project = (here / "moving.svg").read_bytes()
    command = client.ask("look", project=project)["command"]
    assert typed(command, here / "typed", monkeypatch) == {"moving.svg": by_project}
    later = project | {"ease": "ease"}
    assert client.ask("save", project=later, file="blend.json")["written"] == ["blend.json"]  # it is its own
    (here / "blend.json").write_text("of somebody else")
    there = [str(here / "blend.json")]
    asked = client.ask("save", project=project, file="blend.json")
    assert asked == {"asks": {"outside": [], "existing": there}}
    assert client.ask("save", project=project, file="blend.json", agreed=there)["written"] == ["blend.json"]
    assert "ends in .json" in client.ask("save", project=project, file="blend.svg")["error"]


def test_dropped_drawings_are_blended_without_being_written(client, here):
    name = client.give("dropped.svg", svg(EYED, attributes='fill-rule="evenodd"').encode())
    assert name == {"name": "dropped.svg", "is_here": False}
    project = {"files": ["a.svg", "dropped.svg"], "output": "moving.svg"}
    assert "error" not in client.ask("look", project=project)
    assert client.ask("write", project=project)["written"] == ["moving.svg"]
    assert not (here / "dropped.svg").exists()
    (here / "dropped.svg").write_text(svg(EYED, attributes='fill-rule="evenodd"'))
    assert run(["a.svg", "dropped.svg", "-o", "typed.svg"]) == 0
    assert (here / "moving.svg").read_bytes() == (here / "typed.svg").read_bytes()


def test_drawings_of_one_name_are_told_apart(client):
    contents_ = [svg(path).encode() for path in (BAR, LEAF, EYED)]
    names = [client.give("icon.svg", content)["name"] for content in (*contents_, contents_[0])]
    assert names == ["icon.svg", "icon-2.svg", "icon-3.svg", "icon.svg"]
    assert client.give("a.svg", contents_[2])["name"] == "a-2.svg"  # the one that is open stays what it is


def test_a_dropped_project_goes_on_with_the_drawings_that_were_dropped_with_it(client):
    client.give("c.svg", svg(EYED).encode())
    given = client.give("blend.json", json.dumps({"files": ["c.svg", "b.svg"], "kb": 2}).encode(), "project")
    assert given["project"] == {"files": ["c.svg", "b.svg"], "kb": 2.0}
    missing = client.give("blend.json", json.dumps({"files": ["d.svg", "b.svg"]}).encode(), "project")
    assert "d.svg: not open here" in missing["error"]
    assert "not JSON" in client.give("blend.json", b"{", "project")["error"]


def test_a_pin_goes_where_it_was_dragged(client):
    plain = client.ask("look", project={"files": ["a.svg", "b.svg"]})
    pinned = client.ask("look", project={"files": ["a.svg", "b.svg"], "pin": ["22,18:3,14"]})
    assert plain["pairs"][0]["shapes"] != pinned["pairs"][0]["shapes"]
    assert pinned["command"] == "shapeblend a.svg b.svg --pin 22,18:3,14"
    (lists,) = pinned["pairs"][0]["lists"]
    ends = [(lists["vertices_a"][i], lists["vertices_b"][j]) for i, j in lists["dots"]]
    assert any(a == [22, 18] and abs(complex(*b) - (3 + 14j)) < 0.1 for a, b in ends)


def test_the_numbers_of_parts_are_those_of_the_command(client, here):
    (here / "a.svg").write_text(svg("M2 2H10V10H2Z", "M14 2H22V10H14Z", attributes='fill="#000"'))
    (here / "b.svg").write_text(svg("M2 14H10V22H2Z", "M14 14H22V22H14Z", attributes='fill="#000"'))
    crossed = client.ask("look", project={"files": ["a.svg", "b.svg"], "match": ["0=1", "1=0"]})
    assert {(c["a"], c["b"]) for c in crossed["pairs"][0]["contours"]} == {(0, 1), (1, 0)}
    assert len(crossed["drawings"][0]["contours"]) == 2
    assert crossed["drawings"][0]["contours"][1]["d"].startswith("M14,2")


def test_other_blends_have_the_options_that_give_them(client, here):
    (here / "a.svg").write_text(svg(LEAF))
    (here / "b.svg").write_text(svg(I_DOT))
    others = client.ask("others", project={"files": ["a.svg", "b.svg"]})["others"]
    assert others[0]["changes"] == {}
    assert len(others) > 1
    for other in others[1:]:
        flags = " ".join(f"--{name} {value:g}" if isinstance(value, float) else f"--{name} {value}"
                         for name, value in other["changes"].items())  # fmt: skip
        assert flags == other["options"]
        assert len(other["pictures"]) == 3
        answer = client.ask("look", project={"files": ["a.svg", "b.svg"], **other["changes"]})
        assert "error" not in answer
        assert other["options"] in answer["command"]


def test_what_the_command_refuses_is_refused_in_its_words(client, capsys):
    for more, said in (
        ({"frames": -1}, "frames must be 0 or more"),
        ({"nothing": 1}, "'nothing' is no option"),
        ({"match": ["0=9"]}, "9"),
        ({"emit": "avd", "output": "x.svg"}, "--emit avd"),
    ):
        answer = client.ask("look", project={"files": ["a.svg", "b.svg"]} | more)
        assert said in answer["error"]
        assert "bug" not in answer["error"]
    assert "two files" in client.ask("look", project={"files": ["a.svg"]})["error"]
    assert "error" in client.ask("look", project={"files": []})
    assert "error" in client.ask("look", project=[])


def test_several_drawings_are_looked_at_pair_by_pair(client, here):
    (here / "c.svg").write_text(svg(EYED, attributes='fill-rule="evenodd"'))
    client.give("c.svg", (here / "c.svg").read_bytes())
    answer = client.ask("look", project={"files": ["a.svg", "b.svg", "c.svg"]})
    assert [(pair["a"], pair["b"]) for pair in answer["pairs"]] == [(0, 1), (1, 2)]
    assert len(answer["drawings"]) == 3
