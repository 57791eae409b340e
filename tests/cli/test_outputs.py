"""`--emit`, `--output` and `--format`: what is written where, and what that needs."""

import subprocess
import sys
from pathlib import Path

import pytest
from PIL import Image

from shapeblend_cli.cli import run
from tests.support.commands import contents, made, report, write
from tests.support.drawings import BAR, svg

pytestmark = pytest.mark.usefixtures("blended_once")

AB = ["a.svg", "b.svg"]
RED, GREEN, BLUE, WHITE = (255, 0, 0, 255), (0, 255, 0, 255), (0, 0, 255, 255), (255, 255, 255, 255)
CLEAR = (0, 0, 0, 0)


@pytest.fixture(autouse=True)
def here(three):
    return three


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
def test_names_of_files_which_only_force_replaces(here, capsys, refused, arguments, names):
    assert run([*AB, *arguments.split()]) == 0
    assert made() == names
    assert capsys.readouterr() == ("", "")
    before = {name: (here / name).read_bytes() for name in names if "." in name}
    first = next(iter(before))
    line = refused(["b.svg", "c.svg", *arguments.split()], 1, first)
    assert line == f"shapeblend: {first}: exists; --force replaces it"
    assert run(["b.svg", "c.svg", *arguments.split(), "--force"]) == 0
    assert all((here / name).read_bytes() != text for name, text in before.items())
    assert made() == names


@pytest.mark.parametrize(
    ("arguments", "files", "settings"),
    [
        ("--emit pair -n 2", [None] * 2, {"emit": "pair", "output": "blend"}),
        ("--emit lottie -n 2", [None] * 2, {"emit": "lottie", "output": "blend.json"}),
        ("--emit avd -n 2", [None] * 2, {"emit": "avd", "output": "blend.xml"}),
        ("-n 1 --style b", ["frame-1.svg"], {"style": "b"}),
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
    found = report(*AB, *arguments.split())
    assert {name: found["settings"][name] for name in settings} == settings
    assert [frame["file"] for frame in found["frames"]] == files


def test_frames_are_the_default(here):
    assert run([*AB, "-o", "one"]) == 0
    assert run([*AB, "-o", "two", "--emit", "frames"]) == 0
    assert [*contents("one").values()] == [*contents("two").values()]


@pytest.mark.parametrize(("more", "columns"), [("", 5), ("c.svg -n 2 --ends --columns 7", 7)])
def test_a_contact_sheet_of_the_frames(here, capsys, more, columns):
    assert run([*AB, *more.split(), "-o", "x.png"]) == 0
    assert capsys.readouterr() == ("", "")
    assert made() == ["x.png"]
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
    ("kind", "arguments", "times"),
    [
        *((kind, "--fps 10 --duration 0.5", [100] * 5) for kind in ("gif", "webp", "apng")),
        ("gif", "-n 2 --duration 0.4", [100] * 4),
        ("apng", "-n 0", [1000] * 2),
        ("webp", "-n 1 --repeat pingpong --duration 0.2", [100] * 4),
        ("webp", "c.svg -n 0 --duration 0.3", [200] * 3),
        ("gif", "--fps 50 --duration 0.04", [20] * 2),
        ("gif", "-n 1 --duration 0.3 --hold 0.5", [600, 100, 600]),
        ("gif", "-n 1 --duration 0.3 --hold 0.2 --delay 0.3", [600, 100, 300]),
        ("apng", "-n 1 --repeat pingpong --duration 0.2 --hold 500ms,1s", [600, 100, 1100, 100]),
        ("webp", "c.svg -n 0 --duration 0.3 --hold 0,1", [200, 1200, 1200]),
    ],
)
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
    assert made() == ["blend", "blend/frame-1.png", "blend/frame-2.png"]
    for k in (1, 2):
        image = still(f"blend/frame-{k}.png")
        assert (image.format, image.mode, image.size) == ("PNG", "RGBA", (512, 512))
        assert image.getpixel((0, 0)) == CLEAR
        assert image.getpixel((256, 256))[3] == 255


def test_frames_of_another_run_are_spoken_of_if_quiet_too(here, capsys):
    png = ["--format", "png", "--width", "20"]
    assert run([*AB, *png]) == run(AB) == 0
    assert capsys.readouterr().err == ""
    assert run([*AB, *png, "-n", "2", "-f", "-q"]) == 0
    (line,) = capsys.readouterr().err.splitlines()
    assert "3 frame files of another run remain, frame-3.png among them" in line


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
    write(wide=svg("M2 2H46V22H2Z", viewbox="0 0 48 24"))
    assert run(["wide.svg", "b.svg", "-o", "x.apng", "-n", "1"]) == 0
    assert {picture.size for picture, _ in shown("x.apng")} == {(400, 200)}
    assert run(["b.svg", "wide.svg", "-o", "f", "--format", "png", "--ends", "-n", "1"]) == 0
    assert {frame(f"f/frame-{k}.png").size for k in (1, 2, 3)} == {(512, 512)}


@pytest.mark.parametrize("missing", ["resvg_py", "PIL"])
@pytest.mark.parametrize("wanted", [["-o", "x.png"], ["-o", "x.webp"], ["-o", "x", "--format", "png"]])
def test_without_the_extra_there_is_one_line_before_any_work(here, monkeypatch, refused, missing, wanted):
    (here / "a.svg").write_text("no drawing at all")
    for name in [name for name in sys.modules if name.split(".")[0] == missing]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.setitem(sys.modules, missing, None)
    line = refused([*AB, *wanted], 1, f"{wanted[1]}: pictures need resvg_py and Pillow; ")
    assert line.endswith("; pip install 'shapeblend[pictures]' installs them")


@pytest.mark.parametrize(
    ("mark", "command"),
    [("uv-receipt.toml", "uv tool install"), ("pipx_metadata.json", "pipx install --force")],
)
def test_the_line_has_the_command_that_installed_the_program(here, monkeypatch, refused, mark, command):
    (here / mark).touch()
    monkeypatch.setattr(sys, "prefix", str(here))
    monkeypatch.setitem(sys.modules, "resvg_py", None)
    line = refused([*AB, "-o", "x.png"], 1, "x.png: pictures need resvg_py and Pillow; ")
    assert line.endswith(f"; {command} 'shapeblend[pictures]' installs them")


def test_svg_needs_no_extra(here, monkeypatch):
    for missing in ("resvg_py", "PIL"):
        monkeypatch.setitem(sys.modules, missing, None)
    for output in ("frames", "x.svg"):
        assert run([*AB, "-o", output]) == 0


@pytest.mark.parametrize(
    ("viewbox", "words"),
    [
        ("0 0 24000 24", "x.png: the view of the first drawing, 24000 x 24, would be"),
        ("0 0 24 24000", "a smaller --width"),
    ],
)
def test_what_cannot_be_drawn_is_exit_1(refused, viewbox, words):
    write(a=svg(BAR, viewbox=viewbox))
    refused([*AB, "-o", "x.png"], 1, words)


def test_frames_that_nobody_sees_are_neither_drawn_nor_measured(monkeypatch):
    for name in ("frames.frames.frame_at", "job.report.measure"):
        monkeypatch.setattr(f"shapeblend_cli.{name}", None)
    for arguments in ("-o x.svg", "-o y.svg --animate css", "--emit pair", "--emit lottie", "--emit avd"):
        assert run([*AB, *arguments.split()]) == 0


def test_a_format_is_chosen_without_what_renders_it():
    code = (
        "import sys; from shapeblend_cli.cli import run; run('a.svg b.svg -o x.gif --fps 9 -n 3'.split());"
        "print({'numpy', 'svgwrite', 'PIL', 'resvg_py', 'xml.etree.ElementTree'} & sys.modules.keys())"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert "one is enough" in done.stderr
    assert done.stdout == "set()\n"


def test_the_same_output_named_twice_is_one_output():
    assert run([*AB, "-o", "x.svg", "--output", "x.svg"]) == 0
    assert made() == ["x.svg"]


def test_ends_of_an_animation_are_there_anyway_and_that_is_said(capsys):
    for name, options in (("plain.svg", []), ("ends.svg", ["--ends"])):
        assert run([*AB, "-o", name, *options]) == 0
    said = capsys.readouterr().err
    assert said == "shapeblend: --ends adds nothing here: animations begin and end with the drawings\n"
    assert contents()[Path("plain.svg")] == contents()[Path("ends.svg")]


@pytest.mark.parametrize("options", ["--report r.json", "--fail-on poor", "-v", "-o -"])
def test_without_in_betweens_a_run_goes_on_if_anything_else_comes_of_it(options):
    assert run([*AB, "-n", "0", *options.split()]) == 0


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (["--duration", "300"], "--duration 300 is 5 minutes; 300ms would be 0.3 seconds"),
        (["--hold", "0,60"], "--hold 60 is 1 minute; 60ms would be 0.06 seconds"),
        (["--delay", "200"], "--delay 200 is 3.33 minutes; 200ms would be 0.2 seconds"),
        (["--duration", "59"], ""),
        (["--duration", "300ms"], ""),
    ],
)
def test_times_of_minutes_are_said(capsys, options, said):
    assert run([*AB, "-o", "x.svg", *options]) == 0
    assert capsys.readouterr().err == (f"shapeblend: {said}\n" if said else "")
    assert run([*AB, "-o", "x.svg", *options, "-f", "-q"]) == 0
    assert capsys.readouterr().err == ""
