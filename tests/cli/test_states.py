"""`shapeblend states`, without a browser."""

from pathlib import Path
from xml.etree import ElementTree

import pytest

from shapeblend_cli.cli import run
from tests.support.commands import assert_refused, write
from tests.support.drawings import BAR, EIGHT, LEAF, RING, B, svg

pytestmark = pytest.mark.usefixtures("blended_once")

SVG = "{http://www.w3.org/2000/svg}"


def three():
    write(a=svg(B), b=svg(EIGHT), c=svg(RING))
    return ["a.svg", "b.svg", "c.svg"]


def test_a_drawing_begins_with_its_first_state(here):
    assert run(["states", *three(), "-o", "s.svg", "-q"]) == 0
    root = ElementTree.parse("s.svg").getroot()
    assert (root.get("data-state"), root.get("role"), root.get("aria-label")) == ("a", "img", "a to b to c")
    assert root[0].tag == f"{SVG}title"
    style = root.find(f"{SVG}style").text
    assert [f'[data-state="{name}"]' in style for name in "abc"] == [True] * 3
    assert "prefers-reduced-motion" in style
    assert "transition-duration:0.3s" in style


def test_paths_have_the_same_commands_in_all_states(here):
    import re

    assert run(["states", *three(), "-o", "s.svg", "-q"]) == 0
    style = ElementTree.parse("s.svg").getroot().find(f"{SVG}style").text
    paths = re.findall(r'd:path\("([^"]*)"\)', style)
    forms = [re.sub(r"[\d.,\s-]+", " ", path) for path in paths]
    numbers = [len(re.findall(r"-?[\d.]+", path)) for path in paths]
    assert len(paths) == 3
    assert len(set(forms)) == len(set(numbers)) == 1


def test_states_have_the_names_of_files_and_shapes_keep_theirs(here):
    (here / "on").mkdir()
    Path("on/x.svg").write_text(svg(f'<path id="bar" d="{BAR}"/>'))
    Path("x.svg").write_text(svg(f'<path id="bar" d="{LEAF}"/>'))
    assert run(["states", "x.svg", "on/x.svg", "-q"]) == 0
    text = Path("states.svg").read_text()
    assert 'id="bar"' in text
    assert '[data-state="x-2"]' in text


def test_an_element_is_called_by_its_file(here):
    for output, options, name in (
        ("player.js", [], "player-states"),
        ("My_Icon.js", [], "my-icon"),
        ("z.js", ["--element", "my-own"], "my-own"),
    ):
        assert run(["states", *three(), "-o", output, "-q", *options]) == 0
        text = Path(output).read_text()
        assert f'customElements.define("{name}", States)' in text
        assert f'<{name} state="c"></{name}>' in text
        assert "/*" not in text.split("class States")[1]


def test_gradients_are_plain_colours_and_that_is_said(here, capsys):
    stops = '<stop stop-color="red"/><stop offset="1" stop-color="blue"/>'
    shaded = f'<linearGradient id="g">{stops}</linearGradient><path fill="url(#g)" d="{BAR}"/>'
    write(a=svg(shaded), b=svg(LEAF))
    assert run("states a.svg b.svg -o s.svg".split()) == 0
    assert "gradients become plain colours in states" in capsys.readouterr().err


def test_one_file_has_no_states_and_existing_files_stay(here, capsys):
    three()
    assert run(["states", "a.svg"]) == 2
    Path("states.svg").write_text("mine")
    assert run(["states", "a.svg", "b.svg"]) == 1
    assert "exists" in capsys.readouterr().err
    assert Path("states.svg").read_text() == "mine"


def test_only_an_element_is_named(here, capsys):
    assert_refused(
        capsys,
        ["states", *three(), "-o", "s.svg", "--element", "my-own"],
        "--element is for a custom element, a name ending in .js, not for --output s.svg",
    )


def test_elements_react_as_the_trigger_says_unless_they_say_otherwise(here):
    written = {}
    for name, options in {"plain": [], "none": ["none"], "click": ["click"], "hover": ["hover"]}.items():
        asked = ["--trigger", *options] if options else []
        assert run(["states", *three(), "-o", "s.js", "-q", "-f", *asked]) == 0
        written[name] = Path("s.js").read_text()
    assert written["plain"] == written["none"]
    for name in ("click", "hover"):
        changed = written[name].replace(f' ?? "{name}"', "")
        assert (changed, len(written[name]) - len(changed)) == (written["plain"], len(name) + 6)
