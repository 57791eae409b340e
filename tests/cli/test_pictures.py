"""Pictures of pixels: what is written, and what is refused."""

import json
import sys

import pytest
from PIL import Image

from shapeblend_cli.cli import run
from shapeblend_cli.outputs.raster_animation import MOST_RUNS
from tests.support.drawings import BAR, LEAF, RING, svg

RED, BLUE = 'fill="#ff0000"', 'fill="#0000ff"'


@pytest.fixture
def here(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "a.svg").write_text(svg(BAR, attributes=RED), encoding="utf-8")
    (tmp_path / "b.svg").write_text(svg(LEAF, attributes=BLUE), encoding="utf-8")
    (tmp_path / "c.svg").write_text(svg(RING, attributes='fill-rule="evenodd"'), encoding="utf-8")
    return tmp_path


def made(folder):
    inputs = ("a.svg", "b.svg", "c.svg")
    found = sorted(path.relative_to(folder).as_posix() for path in folder.rglob("*"))
    return [name for name in found if name not in inputs]


def shown(file):
    """Every picture of an animation with its time in milliseconds."""
    with Image.open(file) as image:
        for k in range(image.n_frames):
            image.seek(k)
            image.load()
            yield image.convert("RGBA"), image.info["duration"]


def frame(file):
    """A picture that stands still."""
    with Image.open(file) as image:
        return image.convert("RGBA")


def test_a_contact_sheet_of_the_frames(here, capsys):
    assert run(["a.svg", "b.svg", "-o", "x.png"]) == 0
    assert capsys.readouterr() == ("", "")
    assert made(here) == ["x.png"]
    with Image.open("x.png") as sheet:
        assert (sheet.format, sheet.mode, sheet.size) == ("PNG", "RGB", (5 * 210 + 10, 220))


def test_a_sheet_with_the_ends_and_columns_and_width(here):
    assert run(["a.svg", "b.svg", "-o", "x.png", "--ends", "--columns", "3", "--width", "40"]) == 0
    with Image.open("x.png") as sheet:
        assert sheet.size == (3 * 42 + 2, 3 * 42 + 2)
        assert sheet.getpixel((22, 22)) == (255, 0, 0)
        assert sheet.getpixel((22, 2 + 2 * 42 + 20)) == (0, 0, 255)
        assert sheet.getpixel((2 + 42 + 20, 2 + 2 * 42 + 20)) == sheet.getpixel((0, 0))  # an empty place
        assert sheet.getpixel((3, 3)) == (255, 255, 255)


def test_a_sheet_of_several_pairs(here):
    assert run(["a.svg", "b.svg", "c.svg", "-n", "2", "--ends", "-o", "x.png", "--columns", "7"]) == 0
    with Image.open("x.png") as sheet:
        assert sheet.size == (7 * 210 + 10, 220)


@pytest.mark.parametrize("name", ["x.gif", "x.webp", "x.apng", "X.GIF", "deep/X.WebP"])
def test_an_animation_by_pictures_a_second(here, name):
    assert run(["a.svg", "b.svg", "-o", name, "--duration", "0.4"]) == 0
    pictures, times = zip(*shown(name), strict=True)
    assert times == (40,) * 10
    assert {picture.size for picture in pictures} == {(400, 400)}
    assert pictures[0].getpixel((200, 200)) == (255, 0, 0, 255)
    assert pictures[-1].getpixel((200, 200)) == (0, 0, 255, 255)
    corner = (255, 255, 255, 255) if name.lower().endswith("gif") else (0, 0, 0, 0)
    assert {picture.getpixel((0, 0)) for picture in pictures} == {corner}


@pytest.mark.parametrize(
    ("arguments", "times"),
    [
        (["--fps", "10", "--duration", "0.5"], [100] * 5),
        (["-n", "2", "--duration", "0.4"], [100] * 4),
        (["-n", "0"], [1000] * 2),
        (["-n", "1", "--repeat", "pingpong", "--duration", "0.2"], [100] * 4),
        (["c.svg", "-n", "0", "--duration", "0.3"], [200] * 3),
        (["--fps", "50", "--duration", "0.04"], [20] * 2),
    ],
)
@pytest.mark.parametrize("kind", ["gif", "webp", "apng"])
def test_how_many_pictures_and_for_how_long(here, kind, arguments, times):
    assert run(["a.svg", "b.svg", "-o", f"x.{kind}", "--width", "40", *arguments]) == 0
    assert [time for _, time in shown(f"x.{kind}")] == times


def test_the_ease_is_applied_once_and_the_pictures_are_the_frames(here):
    eased = ["-n", "3", "--ease", "ease-in", "--width", "60", "--ends"]
    assert run(["a.svg", "b.svg", "-o", "x.apng", *eased]) == 0
    assert run(["a.svg", "b.svg", "-o", "frames", "--format", "png", *eased]) == 0
    frames = [frame(f"frames/frame-{k}.png").tobytes() for k in range(1, 6)]
    assert [picture.tobytes() for picture, _ in shown("x.apng")] == frames
    assert run(["a.svg", "b.svg", "-o", "even", "--format", "png", "-n", "3", "--width", "60", "--ends"]) == 0
    assert frame("even/frame-3.png").tobytes() != frames[2]


def test_a_folder_of_png_frames(here):
    assert run(["a.svg", "b.svg", "--format", "png", "-n", "2", "--report", "r.json"]) == 0
    assert made(here) == ["blend", "blend/frame-1.png", "blend/frame-2.png", "r.json"]
    for k in (1, 2):
        with Image.open(f"blend/frame-{k}.png") as image:
            assert (image.format, image.mode, image.size) == ("PNG", "RGBA", (512, 512))
            assert image.getpixel((0, 0)) == (0, 0, 0, 0)
            assert image.getpixel((256, 256))[3] == 255
    report = json.loads((here / "r.json").read_text(encoding="utf-8"))
    assert [frame["file"] for frame in report["frames"]] == ["frame-1.png", "frame-2.png"]
    said = {name: report["settings"][name] for name in ("format", "width", "background", "fps", "columns")}
    assert said == {"format": "png", "width": 512, "background": "transparent", "fps": None, "columns": None}


def test_frames_of_another_run_are_spoken_of(here, capsys):
    assert run(["a.svg", "b.svg", "--format", "png", "--width", "20"]) == 0
    assert run(["a.svg", "b.svg"]) == 0
    assert capsys.readouterr().err == ""
    assert run(["a.svg", "b.svg", "--format", "png", "--width", "20", "-n", "2", "-f"]) == 0
    (line,) = capsys.readouterr().err.splitlines()
    assert "3 frame files of another run are left, frame-3.png among them" in line


def test_the_report_of_an_animation(here):
    assert run(["a.svg", "b.svg", "-o", "x.gif", "--width", "20", "--report", "r.json"]) == 0
    report = json.loads((here / "r.json").read_text(encoding="utf-8"))
    assert [frame["file"] for frame in report["frames"]] == [None] * 5
    assert [report["settings"][n] for n in ("width", "fps", "background", "format")] == [
        *(20, 25, "#ffffff"),
        None,
    ]


def test_backgrounds(here):
    assert run(["a.svg", "b.svg", "-o", "x.webp", "-n", "0", "--width", "40", "--background", "teal"]) == 0
    assert {picture.getpixel((0, 0)) for picture, _ in shown("x.webp")} == {(0, 128, 128, 255)}
    assert run(["a.svg", "b.svg", "-o", "x.png", "--background", "transparent"]) == 0
    with Image.open("x.png") as sheet:
        assert sheet.mode == "RGBA"
        assert sheet.getpixel((0, 0))[3] == sheet.getpixel((12, 12))[3] == 0
    assert run(["a.svg", "b.svg", "-o", "f", "--format", "png", "--background", "hsl(120 100% 50%)"]) == 0
    assert frame("f/frame-1.png").getpixel((0, 0)) == (0, 255, 0, 255)


def test_pictures_have_the_proportions_of_the_first_drawing(here):
    (here / "wide.svg").write_text(svg("M2 2H46V22H2Z", viewbox="0 0 48 24"), encoding="utf-8")
    assert run(["wide.svg", "b.svg", "-o", "x.apng", "-n", "1"]) == 0
    assert {picture.size for picture, _ in shown("x.apng")} == {(400, 200)}
    assert run(["b.svg", "wide.svg", "-o", "f", "--format", "png", "--ends", "-n", "1"]) == 0
    assert {frame(f"f/frame-{k}.png").size for k in (1, 2, 3)} == {(512, 512)}


@pytest.mark.parametrize("output", ["x.png", "x.gif", "x.webp", "x.apng"])
def test_the_same_bytes_again(here, output):
    assert run(["a.svg", "b.svg", "-o", output, "-n", "2", "--width", "50"]) == 0
    before = (here / output).read_bytes()
    assert run(["a.svg", "b.svg", "-o", output, "-n", "2", "--width", "50", "--force"]) == 0
    assert (here / output).read_bytes() == before


def test_nothing_is_replaced_without_force(here, capsys):
    (here / "x.gif").write_text("mine")
    assert run(["a.svg", "b.svg", "-o", "x.gif"]) == 1
    assert "--force" in capsys.readouterr().err
    assert (here / "x.gif").read_text() == "mine"


@pytest.mark.parametrize("missing", ["resvg_py", "PIL"])
@pytest.mark.parametrize("wanted", [["-o", "x.png"], ["-o", "x.webp"], ["-o", "x", "--format", "png"]])
def test_without_the_extra_there_is_one_line_before_any_work(here, monkeypatch, capsys, missing, wanted):
    (here / "a.svg").write_text("no drawing at all")
    for name in [name for name in sys.modules if name.split(".")[0] == missing]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.setitem(sys.modules, missing, None)
    assert run(["a.svg", "b.svg", *wanted]) == 1
    assert capsys.readouterr().err == (
        f"shapeblend: {wanted[1]}: pictures need resvg_py and Pillow; "
        "pip install 'shapeblend[pictures]' installs them\n"
    )
    assert made(here) == []


def test_svg_needs_no_extra(here, monkeypatch):
    for missing in ("resvg_py", "PIL"):
        monkeypatch.setitem(sys.modules, missing, None)
    for output in ("frames", "x.svg"):
        assert run(["a.svg", "b.svg", "-o", output]) == 0


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["-o", "x.html"], "x.html: such a page is written with --preview x.html"),
        (["-o", "x.jpg"], "x.jpg: .jpg is not written; .svg, .png, .gif, .webp, .apng are"),
        (["-o", "X.MP4"], "X.MP4: .mp4 is not written"),
        (
            ["-o", "x.svg", "--columns", "3"],
            "--columns is for a contact sheet, a name ending in .png; --output x.svg",
        ),
        (["-o", "x.gif", "--columns", "3"], "--columns is for a contact sheet"),
        (["--columns", "3"], "--output blend is none"),
        (["--columns", "0", "-o", "x.png"], "--columns"),
        (["--width", "100"], "--width is for pictures"),
        (["--width", "100", "-o", "-"], "--width is for pictures"),
        (["--width", "0", "-o", "x.png"], "--width"),
        (["-o", "x.png", "--fps", "9"], "--fps is for an animation of pixels"),
        (["-o", "x.svg", "--fps", "9"], "--fps is for an animation of pixels"),
        (["-o", "x.gif", "--fps", "51"], "--fps"),
        (["-o", "x.gif", "--fps", "9", "-n", "3"], "one will do"),
        (["-o", "x.gif", "--background", "transparent"], "half transparent"),
        (["-o", "x.png", "--background", "nope"], "an opaque CSS colour"),
        (["-o", "x.png", "--background", "#ff000080"], "an opaque CSS colour"),
        (["--background", "red"], "--background is for pictures"),
        (["-o", "x.png", "--format", "png"], "--format is for a folder"),
        (["-o", "x.svg", "--format", "svg"], "--format is for a folder"),
        (["-o", "-", "--format", "png"], "--format is for a folder"),
        (["--emit", "pair", "--format", "png"], "--emit pair is none"),
        (["--emit", "pair", "-o", "x.png"], "a folder; x.png given"),
        (["--emit", "lottie", "-o", "x.gif"], "ending in .json"),
        (["-o", "x.png", "-n", "0"], "--ends would work"),
        (["-o", "x.gif", "-n", "200"], "202 pictures in 2 seconds"),
        (["-o", "x.webp", "--duration", "0.03"], "2 pictures in 0.03 seconds"),
        (["-o", "x.apng", "--repeat", str(MOST_RUNS + 1)], "65535 times at most"),
    ],
)
def test_what_does_not_fit_together_is_exit_2(here, capsys, arguments, words):
    assert run(["a.svg", "b.svg", *arguments]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert words in line
    assert made(here) == []


@pytest.mark.parametrize(
    ("viewbox", "arguments", "words"),
    [
        ("0 0 24 24", ["-o", "x.gif", "--width", "9000"], "x.gif: 50 pictures of 9000 x 9000 pixels"),
        ("0 0 24 24", ["-o", "x.png", "--width", "9000"], "x.png: 5 pictures of 9000 x 9000 pixels"),
        ("0 0 24 24", ["-o", "f", "--format", "png", "--width", "9000"], "f: 5 pictures"),
        ("0 0 24000 24", ["-o", "x.png"], "x.png: 24000 x 24 is shown of the first drawing"),
        ("0 0 24 24000", ["-o", "x.png"], "a smaller --width"),
    ],
)
def test_what_cannot_be_drawn_is_exit_1(here, capsys, viewbox, arguments, words):
    (here / "a.svg").write_text(svg(BAR, viewbox=viewbox), encoding="utf-8")
    assert run(["a.svg", "b.svg", *arguments]) == 1
    (line,) = capsys.readouterr().err.splitlines()
    assert words in line
    assert made(here) == []


def test_a_folder_of_the_name_of_a_picture_stays(here, capsys):
    (here / "x.png").mkdir()
    assert run(["a.svg", "b.svg", "-o", "x.png"]) == 1
    assert "is a folder" in capsys.readouterr().err
    assert list((here / "x.png").iterdir()) == []
