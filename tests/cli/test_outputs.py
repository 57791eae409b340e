"""`--emit`, `--output` and `--format`: what is written where, and what is refused."""

import json
import subprocess
import sys

import pytest
from PIL import Image

from shapeblend_cli.cli import run
from shapeblend_cli.outputs.raster_animation import MOST_RUNS
from tests.support.drawings import BAR, LEAF, RING, svg

AB = ["a.svg", "b.svg"]
INPUTS = {
    "a.svg": svg(BAR, attributes='fill="#ff0000"'),
    "b.svg": svg(LEAF, attributes='fill="#0000ff"'),
    "c.svg": svg(RING, attributes='fill-rule="evenodd"'),
}
RED, GREEN, BLUE, WHITE = (255, 0, 0, 255), (0, 255, 0, 255), (0, 0, 255, 255), (255, 255, 255, 255)
CLEAR = (0, 0, 0, 0)


@pytest.fixture
def here(here):
    for name, text in INPUTS.items():
        (here / name).write_text(text, encoding="utf-8")
    return here


def made(folder):
    """What there is beside the three drawings."""
    names = {path.relative_to(folder).as_posix() for path in folder.rglob("*")}
    return sorted(names - INPUTS.keys())


def shown(file):
    """Every picture of an animation with its time in milliseconds."""
    with Image.open(file) as image:
        for k in range(image.n_frames):
            image.seek(k)
            image.load()
            yield image.convert("RGBA"), image.info["duration"]


def still(file):
    """A picture that stands still; it remembers how the file has it."""
    with Image.open(file) as image:
        image.load()
    return image


def frame(file):
    return still(file).convert("RGBA")


@pytest.mark.parametrize(
    ("arguments", "names"),
    [
        ("--emit pair", ["blend", "blend/a.svg", "blend/b.svg"]),
        ("--emit lottie", ["blend.json"]),
        ("--emit avd", ["blend.xml"]),
        ("--emit pair -o some/where", ["some", "some/where", "some/where/a.svg", "some/where/b.svg"]),
        ("--emit lottie -o deep/x.JSON", ["deep", "deep/x.JSON"]),
        ("--emit avd -o res/x.xml", ["res", "res/x.xml"]),
        ("-o x.gif -n 0 --width 9", ["x.gif"]),
    ],
)
def test_names_of_files_which_only_force_replaces(here, capsys, arguments, names):
    assert run([*AB, *arguments.split()]) == 0
    assert made(here) == names
    assert capsys.readouterr() == ("", "")
    before = {name: (here / name).read_bytes() for name in names if "." in name}
    assert run(["b.svg", "c.svg", *arguments.split()]) == 1
    first = next(iter(before))
    assert capsys.readouterr().err == f"shapeblend: {first}: exists; --force replaces it\n"
    assert {name: (here / name).read_bytes() for name in before} == before
    assert run(["b.svg", "c.svg", *arguments.split(), "--force"]) == 0
    assert all((here / name).read_bytes() != text for name, text in before.items())
    assert made(here) == names


@pytest.mark.parametrize(
    ("arguments", "files", "settings"),
    [
        ("--emit pair -n 2", [None] * 2, {"emit": "pair", "output": "blend"}),
        ("--emit lottie -n 2", [None] * 2, {"emit": "lottie", "output": "blend.json"}),
        ("--emit avd -n 2", [None] * 2, {"emit": "avd", "output": "blend.xml"}),
        (
            "-o x.gif --width 20",
            [None] * 5,
            {"width": 20, "fps": 25, "background": "#ffffff", "format": None},
        ),
        (
            "--format png -n 2",
            ["frame-1.png", "frame-2.png"],
            {"format": "png", "width": 512, "background": "transparent", "fps": None, "columns": None},
        ),
    ],
)
def test_the_report_has_the_form_and_the_files_of_frames(here, arguments, files, settings):
    assert run([*AB, *arguments.split(), "--report", "r.json"]) == 0
    report = json.loads((here / "r.json").read_text(encoding="utf-8"))
    assert {name: report["settings"][name] for name in settings} == settings
    assert [frame["file"] for frame in report["frames"]] == files


def test_frames_are_the_default(here):
    assert run([*AB, "-o", "one"]) == 0
    assert run([*AB, "-o", "two", "--emit", "frames"]) == 0
    one, two = ([p.read_bytes() for p in sorted((here / name).iterdir())] for name in ("one", "two"))
    assert one == two


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ("--emit pair -o . --force", "a.svg: is an input"),
        ("--emit pair -o c.svg/x", "c.svg: is a file"),
        ("--emit lottie --report blend.json", "blend.json: is named for two"),
    ],
)
def test_targets_that_must_not_be_written(here, capsys, arguments, words):
    assert run([*AB, *arguments.split()]) == 1
    (line,) = capsys.readouterr().err.splitlines()
    assert words in line
    assert {name: (here / name).read_text(encoding="utf-8") for name in INPUTS} == INPUTS
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
    assert run([*AB, "--emit", "pair"]) == 1
    assert "No space left" in capsys.readouterr().err
    assert made(here) == []


@pytest.mark.parametrize(("more", "columns"), [("", 5), ("c.svg -n 2 --ends --columns 7", 7)])
def test_a_contact_sheet_of_the_frames(here, capsys, more, columns):
    assert run([*AB, *more.split(), "-o", "x.png"]) == 0
    assert capsys.readouterr() == ("", "")
    assert made(here) == ["x.png"]
    sheet = still("x.png")
    assert (sheet.format, sheet.mode, sheet.size) == ("PNG", "RGB", (columns * 210 + 10, 220))


def test_a_sheet_with_the_ends_and_columns_and_width(here):
    assert run([*AB, "-o", "x.png", "--ends", "--columns", "3", "--width", "40"]) == 0
    sheet = frame("x.png")
    assert sheet.size == (3 * 42 + 2, 3 * 42 + 2)
    assert sheet.getpixel((22, 22)) == RED
    assert sheet.getpixel((22, 2 + 2 * 42 + 20)) == BLUE
    assert sheet.getpixel((2 + 42 + 20, 2 + 2 * 42 + 20)) == sheet.getpixel((0, 0))  # an empty place
    assert sheet.getpixel((3, 3)) == WHITE


@pytest.mark.parametrize("name", ["x.gif", "x.webp", "x.apng", "X.GIF", "deep/X.WebP"])
def test_an_animation_by_pictures_a_second(here, name):
    assert run([*AB, "-o", name, "--duration", "0.4"]) == 0
    pictures, times = zip(*shown(name), strict=True)
    assert times == (40,) * 10
    assert {picture.size for picture in pictures} == {(400, 400)}
    assert [pictures[k].getpixel((200, 200)) for k in (0, -1)] == [RED, BLUE]
    corner = WHITE if name.lower().endswith("gif") else CLEAR
    assert {picture.getpixel((0, 0)) for picture in pictures} == {corner}


@pytest.mark.parametrize(
    ("arguments", "times"),
    [
        ("--fps 10 --duration 0.5", [100] * 5),
        ("-n 2 --duration 0.4", [100] * 4),
        ("-n 0", [1000] * 2),
        ("-n 1 --repeat pingpong --duration 0.2", [100] * 4),
        ("c.svg -n 0 --duration 0.3", [200] * 3),
        ("--fps 50 --duration 0.04", [20] * 2),
    ],
)
@pytest.mark.parametrize("kind", ["gif", "webp", "apng"])
def test_how_many_pictures_and_for_how_long(here, kind, arguments, times):
    assert run([*AB, "-o", f"x.{kind}", "--width", "40", *arguments.split()]) == 0
    assert [time for _, time in shown(f"x.{kind}")] == times


def test_the_ease_is_applied_once_and_the_pictures_are_the_frames(here):
    even = ["-n", "3", "--width", "60", "--ends"]
    eased = ["--ease", "ease-in", *even]
    assert run([*AB, "-o", "x.apng", *eased]) == 0
    assert run([*AB, "-o", "frames", "--format", "png", *eased]) == 0
    frames = [frame(f"frames/frame-{k}.png").tobytes() for k in range(1, 6)]
    assert [picture.tobytes() for picture, _ in shown("x.apng")] == frames
    assert run([*AB, "-o", "even", "--format", "png", *even]) == 0
    assert frame("even/frame-3.png").tobytes() != frames[2]


def test_a_folder_of_png_frames(here):
    assert run([*AB, "--format", "png", "-n", "2"]) == 0
    assert made(here) == ["blend", "blend/frame-1.png", "blend/frame-2.png"]
    for k in (1, 2):
        image = still(f"blend/frame-{k}.png")
        assert (image.format, image.mode, image.size) == ("PNG", "RGBA", (512, 512))
        assert image.getpixel((0, 0)) == CLEAR
        assert image.getpixel((256, 256))[3] == 255


def test_frames_of_another_run_are_spoken_of(here, capsys):
    png = ["--format", "png", "--width", "20"]
    assert run([*AB, *png]) == run(AB) == 0
    assert capsys.readouterr().err == ""
    assert run([*AB, *png, "-n", "2", "-f"]) == 0
    (line,) = capsys.readouterr().err.splitlines()
    assert "3 frame files of another run are left, frame-3.png among them" in line


def test_backgrounds(here):
    assert run([*AB, "-o", "x.webp", "-n", "0", "--width", "40", "--background", "teal"]) == 0
    assert {picture.getpixel((0, 0)) for picture, _ in shown("x.webp")} == {(0, 128, 128, 255)}
    assert run([*AB, "-o", "x.png", "--background", "transparent"]) == 0
    sheet = still("x.png")
    assert sheet.mode == "RGBA"
    assert sheet.getpixel((0, 0))[3] == sheet.getpixel((12, 12))[3] == 0
    assert run([*AB, "-o", "f", "--format", "png", "--background", "hsl(120 100% 50%)"]) == 0
    assert frame("f/frame-1.png").getpixel((0, 0)) == GREEN


def test_pictures_have_the_proportions_of_the_first_drawing(here):
    (here / "wide.svg").write_text(svg("M2 2H46V22H2Z", viewbox="0 0 48 24"), encoding="utf-8")
    assert run(["wide.svg", "b.svg", "-o", "x.apng", "-n", "1"]) == 0
    assert {picture.size for picture, _ in shown("x.apng")} == {(400, 200)}
    assert run(["b.svg", "wide.svg", "-o", "f", "--format", "png", "--ends", "-n", "1"]) == 0
    assert {frame(f"f/frame-{k}.png").size for k in (1, 2, 3)} == {(512, 512)}


@pytest.mark.parametrize("output", ["x.png", "x.gif", "x.webp", "x.apng"])
def test_the_same_bytes_again(here, output):
    arguments = [*AB, "-o", output, "-n", "2", "--width", "50"]
    assert run(arguments) == 0
    before = (here / output).read_bytes()
    assert run([*arguments, "--force"]) == 0
    assert (here / output).read_bytes() == before


@pytest.mark.parametrize("missing", ["resvg_py", "PIL"])
@pytest.mark.parametrize("wanted", [["-o", "x.png"], ["-o", "x.webp"], ["-o", "x", "--format", "png"]])
def test_without_the_extra_there_is_one_line_before_any_work(here, monkeypatch, capsys, missing, wanted):
    (here / "a.svg").write_text("no drawing at all")
    for name in [name for name in sys.modules if name.split(".")[0] == missing]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.setitem(sys.modules, missing, None)
    assert run([*AB, *wanted]) == 1
    assert capsys.readouterr().err == (
        f"shapeblend: {wanted[1]}: pictures need resvg_py and Pillow; "
        "pip install 'shapeblend[pictures]' installs them\n"
    )
    assert made(here) == []


def test_svg_needs_no_extra(here, monkeypatch):
    for missing in ("resvg_py", "PIL"):
        monkeypatch.setitem(sys.modules, missing, None)
    for output in ("frames", "x.svg"):
        assert run([*AB, "-o", output]) == 0


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ("--emit gif", "gif"),
        ("--emit pair -o -", "a.svg and b.svg, so --output takes a folder; - given"),
        ("--emit pair -o x.svg", "a folder; x.svg given"),
        ("--emit pair -o x.png", "a folder; x.png given"),
        ("--emit lottie -o x", "ending in .json, or -; x given"),
        ("--emit lottie -o x.svg", "ending in .json"),
        ("--emit lottie -o x.gif", "ending in .json"),
        ("--emit avd -o x.json", "ending in .xml"),
        ("--emit avd -o - --report -", "standard output"),
        ("-o x.json", "--emit lottie"),
        ("-o x.xml", "--emit avd"),
        ("c.svg --emit pair", "two files; 3 given"),
        ("c.svg --emit avd", "two files; 3 given"),
        ("-o x.html", "x.html: such a page is written with --preview x.html"),
        ("-o x.jpg", "x.jpg: .jpg is not written; .svg, .png, .gif, .webp, .apng are"),
        ("-o X.MP4", "X.MP4: .mp4 is not written"),
        ("-o x.svg --columns 3", "--columns is for a contact sheet, a name ending in .png; --output x.svg"),
        ("-o x.gif --columns 3", "--columns is for a contact sheet"),
        ("--columns 3", "--output blend is none"),
        ("--columns 0 -o x.png", "--columns"),
        ("--width 100", "--width is for pictures"),
        ("--width 100 -o -", "--width is for pictures"),
        ("--width 0 -o x.png", "--width"),
        ("-o x.png --fps 9", "--fps is for an animation of pixels"),
        ("-o x.svg --fps 9", "--fps is for an animation of pixels"),
        ("-o x.gif --fps 51", "--fps"),
        ("-o x.gif --fps 9 -n 3", "one will do"),
        ("-o x.gif --background transparent", "half transparent"),
        ("-o x.png --background nope", "an opaque CSS colour"),
        ("-o x.png --background #ff000080", "an opaque CSS colour"),
        ("--background red", "--background is for pictures"),
        ("-o x.png --format png", "--format is for a folder"),
        ("-o x.svg --format svg", "--format is for a folder"),
        ("-o - --format png", "--format is for a folder"),
        ("--emit pair --format png", "--emit pair is none"),
        ("-o x.png -n 0", "--ends would work"),
        ("-o x.gif -n 200", "202 pictures in 2 seconds"),
        ("-o x.webp --duration 0.03", "2 pictures in 0.03 seconds"),
        (f"-o x.apng --repeat {MOST_RUNS + 1}", "65535 times at most"),
    ],
)
def test_what_does_not_fit_together_is_exit_2(here, capsys, arguments, words):
    assert run([*AB, *arguments.split()]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert words in line
    assert made(here) == []


@pytest.mark.parametrize(
    ("viewbox", "arguments", "words"),
    [
        ("0 0 24 24", "-o x.gif --width 9000", "x.gif: 50 pictures of 9000 x 9000 pixels"),
        ("0 0 24 24", "-o x.png --width 9000", "x.png: 5 pictures of 9000 x 9000 pixels"),
        ("0 0 24 24", "-o f --format png --width 9000", "f: 5 pictures"),
        ("0 0 24000 24", "-o x.png", "x.png: 24000 x 24 is shown of the first drawing"),
        ("0 0 24 24000", "-o x.png", "a smaller --width"),
    ],
)
def test_what_cannot_be_drawn_is_exit_1(here, capsys, viewbox, arguments, words):
    (here / "a.svg").write_text(svg(BAR, viewbox=viewbox), encoding="utf-8")
    assert run([*AB, *arguments.split()]) == 1
    (line,) = capsys.readouterr().err.splitlines()
    assert words in line
    assert made(here) == []


def test_a_folder_of_the_name_of_a_picture_stays(here, capsys):
    (here / "x.png").mkdir()
    assert run([*AB, "-o", "x.png"]) == 1
    assert "is a folder" in capsys.readouterr().err
    assert list((here / "x.png").iterdir()) == []


def test_frames_that_nobody_sees_are_neither_drawn_nor_measured(here, monkeypatch):
    for name in ("pipeline.frame_at", "files.measure"):
        monkeypatch.setattr(f"shapeblend_cli.{name}", None)
    for arguments in ("-o x.svg", "-o y.svg --animate css", "--emit pair", "--emit lottie", "--emit avd"):
        assert run([*AB, *arguments.split()]) == 0


def test_a_format_is_chosen_without_what_renders_it():
    code = (
        "import sys; from shapeblend_cli.cli import run; run('a.svg b.svg -o x.gif --fps 9 -n 3'.split());"
        "print({'numpy', 'svgwrite', 'PIL', 'resvg_py', 'xml.etree.ElementTree'} & sys.modules.keys())"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert "one will do" in done.stderr
    assert done.stdout == "set()\n"
