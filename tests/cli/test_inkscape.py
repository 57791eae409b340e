"""`shapeblend inkscape`, without Inkscape."""

import io
import os
import subprocess
import sys
from contextlib import redirect_stdout
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest

from shapeblend_cli.cli import run
from shapeblend_cli.inkscape import extension
from tests.support.commands import made, points, process
from tests.support.inkscape import DOCUMENT, NAMESPACES

SVG = "{http://www.w3.org/2000/svg}"
INX = "{http://www.inkscape.org/namespace/inkscape/extension}"


def blended(*options, document=DOCUMENT, ids=("low", "high"), command="blend"):
    """What the command prints for a document."""
    Path("document.svg").write_text(document)
    selected = [word for name in ids for word in ("--id", name)]
    printed = io.TextIOWrapper(io.BytesIO(), "utf-8", write_through=True)
    with redirect_stdout(printed):
        assert run(["inkscape", command, "document.svg", *selected, *options]) == 0
    return printed.buffer.getvalue().decode()


def frames(text, name="frame-"):
    root = ElementTree.fromstring(text.encode())
    return [element for element in root.iter() if (element.get("id") or "").startswith(name)]


def test_the_document_stays_as_it_is_but_for_what_is_put_in(here):
    text = blended("-n", "2")
    start = text.index('<g id="blend"')
    end = text.index("</g></g></g>", start) + len("</g></g></g>")
    assert text[:start] + text[end:] == DOCUMENT
    before = DOCUMENT.index('d="M 5,10 H 25 V 30 H 5 Z"/>') + len('d="M 5,10 H 25 V 30 H 5 Z"/>')
    assert start == before


def test_frames_begin_at_the_lower_object_whatever_the_order_of_the_selection(here):
    assert blended("-n", "1") == blended("-n", "1", ids=("high", "low"))


def test_frames_lie_where_the_objects_are_whatever_is_around_them(here):
    """In a group that is turned and squashed, the frames at both ends are the objects."""
    around = '<g transform="rotate(30) scale(2,1)"><g transform="matrix(1 .2 0 1 3 4)">'
    low, high = '<path id="low" d="M5 5H15V15H5Z"/>', '<path id="high" d="M30 5H40V15H30Z"/>'
    text = blended(
        "-n",
        "1",
        "--ends",
        document=f"<svg {NAMESPACES} viewBox='0 0 99 99'>{around}{low}{high}</g></g></svg>",
    )
    Path("after.svg").write_text(text)
    from shapeblend_cli.svg.reading.read import read

    first, _, last = (read("after.svg", select=f"#frame-{k}").shapes[0] for k in (1, 2, 3))
    for name, frame in (("low", first), ("high", last)):
        drawn = read("after.svg", select=f"#{name}").shapes[0]
        nodes, expected = frame.contours[0].segments[:, 0], drawn.contours[0].segments[:, 0]
        assert np.abs(nodes[:, None] - expected).min(axis=1).max() < 0.02


def test_pins_by_dots_and_by_lines(here):
    def nodes(document):
        return points(blended("-n", "1", "--motion", "linear", document=document).split('id="frame-1"')[1])

    free = nodes(DOCUMENT.replace("pin 1", "not a pin"))
    dotted = nodes(DOCUMENT)
    line = '<path inkscape:label="Pin 1" d="M82 28 7 13" fill="none" stroke="red"/>'
    lined = nodes(DOCUMENT.replace("pin 1", "dot").replace("</g></svg>", f"{line}</g></svg>"))
    corner = (7 + 13j + 82 + 28j) / 2  # where the pinned corners are half way
    assert np.abs(dotted - corner).min() < 0.01
    assert np.abs(lined - corner).min() < 0.01
    assert np.abs(free - corner).min() > 1.0


TWO_PARTS = f"""<svg {NAMESPACES} viewBox="0 0 100 50">
<g id="low"><path id="p" d="M5 5H15V15H5Z"/><path id="q" inkscape:label="pair 1" d="M5 30H12V37H5Z"/></g>
<g id="high"><path id="r" inkscape:label="Pair 1" d="M70 5H80V15H70Z"/><path id="s" d="M70 30H77V37H70Z"/></g></svg>
"""


def test_parts_of_one_label_become_each_other(here):
    def middles(document):
        (frame,) = frames(blended("-n", "1", document=document))
        return sorted(round(points(path.get("d")).mean().imag) for path in frame.iter(f"{SVG}path"))

    assert middles(TWO_PARTS.replace("air 1", "art")) == [10, 34]
    assert middles(TWO_PARTS) == [10, 22, 34]  # the others shrink and grow


def test_a_pair_needs_a_part_of_each_object(here, capsys):
    Path("document.svg").write_text(TWO_PARTS.replace("Pair 1", "part"))
    assert run("inkscape blend document.svg --id low --id high".split()) == 1
    told = "'pair 1' marks one part of the lower object and no parts of the upper one; one of each with that label"
    assert told in capsys.readouterr().err


@pytest.mark.parametrize("document", [DOCUMENT, TWO_PARTS])
def test_the_studio_opens_with_what_was_selected_and_marked(here, monkeypatch, capfdbinary, document):
    called = []
    monkeypatch.setattr(subprocess, "Popen", lambda words, **given: called.append((words, given)))
    Path("document.svg").write_text(document)
    assert run("inkscape studio document.svg --id low --id high".split()) == 0
    assert capfdbinary.readouterr().out.decode() == document
    ((python, dash, module, studio, a, b, *options), given) = called[0]
    assert (python, dash, module, studio) == (sys.executable, "-m", "shapeblend_cli", "studio")
    assert [Path(file).name for file in (a, b)] == ["1-low.svg", "2-high.svg"]
    assert given["start_new_session"]
    options.remove("--until-closed")
    assert ("--pin" in options, "--match" in options) == (document == DOCUMENT, document == TWO_PARTS)
    assert run([a, b, *options, "-n", "1", "-o", "frames", "-q"]) == 0


def test_layers_are_put_into_layers_only(here):
    inside = DOCUMENT.replace('<path id="low"', '<g id="inner"><path id="low"').replace(
        'H 5 Z"/>', 'H 5 Z"/></g>'
    )
    text = blended("-n", "2", "--as", "layers", document=inside)
    layer = next(e for e in ElementTree.fromstring(text.encode()).iter() if e.get("id") == "layer1")
    assert [child.get("id") for child in layer] == ["inner", "frame-1", "frame-2", "high"]


def test_ids_are_new_ones(here):
    text = blended(
        "-n", "1", document=DOCUMENT.replace('id="svg5"', 'id="blend"').replace("dot-a", "frame-1")
    )
    ids = [e.get("id") for e in ElementTree.fromstring(text.encode()).iter() if e.get("id")]
    assert len(ids) == len(set(ids))
    assert "blend-2" in ids


REFUSED = {
    ("low",): "one object is selected; two, or two groups, and dots for pins, would work",
    (): "no objects are selected",
    ("low", "none"): "no object has the id none",
    ("layer1", "high"): "high is in layer1; objects beside each other would work",
    ("low", "high", "dot-a", "svg5"): "is in svg5",
}


@pytest.mark.parametrize("ids", REFUSED)
def test_what_cannot_be_blended_is_refused_in_a_line(here, capsys, ids):
    Path("document.svg").write_text(DOCUMENT)
    assert run(["inkscape", "blend", "document.svg", *(word for name in ids for word in ("--id", name))]) == 1
    printed = capsys.readouterr()
    assert REFUSED[ids] in printed.err
    assert (printed.out, printed.err.count("\n")) == ("", 1)


def test_a_pin_needs_two_points(here, capsys):
    Path("document.svg").write_text(DOCUMENT.replace('id="dot-b" inkscape:label="pin 1"', 'id="dot-b"'))
    assert run("inkscape blend document.svg --id low --id high".split()) == 1
    assert (
        "'pin 1' marks 1 points; two dots or one line with that label would work" in capsys.readouterr().err
    )


def test_an_animation_goes_from_the_lowest_object_up(here):
    third = DOCUMENT.replace('<g id="high"', '<path id="middle" d="M40 10H50V20H40Z"/><g id="high"')
    text = blended("--output", "m.svg", document=third, ids=("high", "low", "middle"), command="animate")
    assert text == third
    root = ElementTree.parse("m.svg").getroot()
    x, y, width, height = map(float, root.get("viewBox").split())
    assert x + width < 95
    assert y > 5
    assert height < 35
    values = next(root.iter(f"{SVG}animate")).get("values").split(";")
    places = [values.index(data) for data in ("M7 13l20 0 0 20-20 0z", "M42 13l10 0 0 10-10 0z")]
    assert places == [0, 1]
    assert values[-1].startswith("M72 18l10-10")


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ("", "an animation needs the name of a file"),
        ("--output -", "standard output is for the document"),
        ("--output x.bmp", ".bmp cannot be written"),
    ],
)
def test_an_animation_needs_a_file(here, capsys, options, message):
    Path("document.svg").write_text(DOCUMENT)
    assert run(["inkscape", "animate", "document.svg", "--id", "low", "--id", "high", *options.split()]) == 2
    assert message in capsys.readouterr().err
    assert made() == ["document.svg"]


def test_the_extension_is_installed_where_inkscape_looks(here, monkeypatch, capsys):
    monkeypatch.setenv("INKSCAPE_PROFILE_DIR", str(here / "profile"))
    for _ in range(2):  # again, to bring it up to date
        assert run(["inkscape", "install"]) == 0
        assert "restart Inkscape" in capsys.readouterr().err
    names = sorted(path.name for path in (here / "profile" / "extensions").iterdir())
    assert names == [
        "shapeblend.py",
        *(f"shapeblend_{what}.inx" for what in ("animate", "blend", "studio")),
    ]
    assert run(["inkscape", "install", "--folder", "other"]) == 0
    assert sorted(os.listdir("other")) == names


def test_parameters_are_options_of_the_command(here):
    for name, text in extension.files().items():
        if name.endswith(".inx"):
            root = ElementTree.fromstring(text.encode())
            what = root.find(f"{INX}param[@name='what']").text
            given = {param.get("name") for param in root.iter(f"{INX}param")} - {"what"}
            options = process("inkscape", what, "--help").stdout.decode()
            assert all(f"--{name}" in options for name in given)


def test_the_script_hands_on_what_inkscape_gives(here):
    assert run(["inkscape", "install", "--folder", "."]) == 0
    Path("document.svg").write_text(DOCUMENT)
    given = ["--what=blend", "--frames=2", "--as=group", "--ease=linear", "--id=low", "--id=high", "--tab=x"]
    done = subprocess.run(
        [sys.executable, "shapeblend.py", *given, "document.svg"], capture_output=True, check=True
    )
    assert done.stdout.decode() == blended("-n", "2")
    failed = subprocess.run(
        [sys.executable, "shapeblend.py", "--id=low", "document.svg"], capture_output=True
    )
    assert failed.returncode == 1
    assert b"one object is selected" in failed.stderr


def test_without_the_command_one_sentence_says_what_to_type(here):
    assert run(["inkscape", "install", "--folder", "."]) == 0
    script = Path("shapeblend.py")
    script.write_text(script.read_text().replace(sys.executable, "/gone/python"))
    environment = {"PATH": "/nowhere"}
    done = subprocess.run([sys.executable, script, "document.svg"], capture_output=True, env=environment)
    assert done.returncode == 1
    assert done.stderr.decode() == (
        "The command shapeblend was not found. Install it, then type in a terminal: shapeblend inkscape install\n"
    )


def test_the_script_needs_nothing_but_the_standard_library():
    import ast

    tree = ast.parse(Path(extension.__file__).with_name("script.py").read_text())
    names = {alias.name for node in ast.walk(tree) if isinstance(node, ast.Import) for alias in node.names}
    names |= {node.module for node in ast.walk(tree) if isinstance(node, ast.ImportFrom)}
    assert names <= {"__future__", *sys.stdlib_module_names}
