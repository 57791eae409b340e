"""The extension in Inkscape itself, on a display that nobody sees, and our drawings opened there."""

import subprocess
from pathlib import Path
from xml.etree import ElementTree

import pytest

from shapeblend_cli.cli import run
from tests.support.equipment import require
from tests.support.inkscape import DOCUMENT, walker

SVG, LABEL = "{http://www.w3.org/2000/svg}", "{http://www.inkscape.org/namespaces/inkscape}label"
MODE = LABEL.replace("label", "groupmode")
PREFERENCES = (
    '<inkscape xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape" version="1">'
    '<group id="extensions" {}/></inkscape>'
)
SECONDS = 180


@pytest.fixture(scope="session", autouse=True)
def program():
    require("Inkscape")


@pytest.fixture
def inkscape(here, monkeypatch):
    """Run Inkscape with a profile of its own, in which the extension is installed."""
    profile = here / "profile"
    profile.mkdir()
    monkeypatch.setenv("INKSCAPE_PROFILE_DIR", str(profile))
    assert run(["inkscape", "install"]) == 0

    def called(*arguments, **parameters):
        """Extensions are given their parameters by the preferences of the last time."""
        given = " ".join(
            f'org.shapeblend.{name.replace("__", ".")}="{value}"' for name, value in parameters.items()
        )
        (profile / "preferences.xml").write_text(PREFERENCES.format(given))
        command = ["xvfb-run", "-a", "inkscape", "--batch-process", *arguments]
        return subprocess.run(command, capture_output=True, text=True, timeout=SECONDS, check=True)

    return called


def applied(inkscape, *actions, document=DOCUMENT, **parameters):
    """A document after some actions, and after Inkscape has saved it."""
    Path("document.svg").write_text(document)
    saving = ["export-filename:out.svg", "export-overwrite", "export-do"]
    inkscape("--with-gui", "document.svg", f"--actions={';'.join([*actions, *saving])}", **parameters)
    return ElementTree.parse("out.svg").getroot()


def queried(file):
    """The ids of all that Inkscape has in a file, with their boxes in pixels."""
    done = subprocess.run(
        ["inkscape", "--query-all", file], capture_output=True, text=True, check=True, timeout=SECONDS
    )
    rows = [line.rsplit(",", 4) for line in done.stdout.splitlines() if line.count(",") >= 4]
    return {name: tuple(map(float, box)) for name, *box in rows}


def by_id(root, name):
    return next(element for element in root.iter() if element.get("id") == name)


def test_two_objects_are_blended_and_the_frames_lie_between_them(inkscape):
    root = applied(inkscape, "select-by-id:low,high", "org.shapeblend.blend.noprefs", blend__frames=3)
    layer = by_id(root, "layer1")
    assert layer.get(LABEL) == "Layer 1"
    assert [child.get("id") for child in layer] == ["low", "blend", "high"]
    frames = list(by_id(root, "blend"))
    assert [frame.get(LABEL) for frame in frames] == ["t = 0.25", "t = 0.5", "t = 0.75"]
    assert by_id(root, "blend").get(LABEL) == "low to high"
    boxes = queried("out.svg")
    lefts = [boxes[name][0] for name in ("low", "frame-1", "frame-2", "frame-3", "high")]
    assert lefts == sorted(lefts)
    assert len(set(lefts)) == 5


def test_steps_layers_and_motion_have_their_effect(inkscape):
    parameters = {"blend__frames": 2, "blend__as": "layers", "blend__ease": "ease-in"}
    root = applied(inkscape, "select-by-id:low,high", "org.shapeblend.blend.noprefs", **parameters)
    layer = by_id(root, "layer1")
    assert [child.get("id") for child in layer] == ["low", "frame-1", "frame-2", "high"]
    assert [child.get(MODE) for child in layer][1:3] == ["layer", "layer"]
    assert layer[1].get(LABEL) != "low to high, t = 0.3333"  # eased


def test_pins_have_their_effect(inkscape):
    def frame(*ids, document=DOCUMENT):
        root = applied(
            inkscape,
            f"select-by-id:{','.join(ids)}",
            "org.shapeblend.blend.noprefs",
            document=document,
            blend__frames=1,
            blend__motion="linear",
        )
        return by_id(root, "frame-1").find(f".//{SVG}path").get("d")

    pinned = frame("low", "high")
    assert frame("low", "high", "dot-a", "dot-b") == pinned  # dots that are selected are pins all the same
    assert frame("low", "high", document=DOCUMENT.replace("pin 1", "no pin")) != pinned


def test_an_animation_is_written(inkscape, here):
    moving = here / "moving.svg"
    applied(
        inkscape,
        "select-by-id:low,high",
        "org.shapeblend.animate.noprefs",
        animate__output=moving,
        animate__duration=3,
        animate__repeat="pingpong",
    )
    root = ElementTree.parse(moving).getroot()
    assert next(root.iter(f"{SVG}animate")).get("dur") == "6s"


def test_a_round_trip_keeps_groups_labels_ids_and_millimetres(here):
    """A file that Inkscape has saved, frames of it, and these opened again."""
    for name, leg in (("a", "M2 12h4v10h-4z"), ("b", "M1 12h4v10h-6z")):
        Path(f"{name}-plain.svg").write_text(walker(leg))
        command = ["inkscape", f"{name}-plain.svg", "--export-type=svg", f"--export-filename={name}.svg"]
        subprocess.run(command, capture_output=True, check=True, timeout=SECONDS)
    assert run("a.svg b.svg -n 3 --ends -o frames -q".split()) == 0
    original = queried("a.svg")
    for k in range(1, 6):
        file = f"frames/frame-{k}.svg"
        assert queried(file).keys() == original.keys()
        root = ElementTree.parse(file).getroot()
        assert (root.get("width"), root.get("height")) == ("24mm", "24mm")
        labels = [element.get(LABEL) for element in root.iter() if element.get(LABEL)]
        assert labels == ["Legs", "left leg", "Head"]
    for name, box in queried("frames/frame-1.svg").items():
        assert box == pytest.approx(original[name], abs=0.02)
    assert run("a.svg b.svg -n 3 --emit layers -o layers.svg -q".split()) == 0
    assert {"frame-1", "frame-2", "frame-3", "leg-l", "layer1"} <= queried("layers.svg").keys()
