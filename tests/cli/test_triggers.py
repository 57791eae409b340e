"""What cannot wait for a trigger is refused, in a line that says what would work."""

import pytest

from shapeblend_cli.cli import run
from tests.support.commands import assert_refused, write
from tests.support.drawings import BAR, LEAF, svg

REFUSED = {
    "--trigger press": "must be load, click, hover, or the id of an element and an event of it, such as menu.click",
    "--trigger click": "--trigger click is for an animated SVG, --output FILE.svg",
    "--trigger click -o x.gif": "--trigger click is for an animated SVG",
    "--trigger hover -o x.svg --animate frames": "not for --animate frames",
    "--trigger click -o x.svg --repeat 2": "--repeat is for animations that start by themselves",
    "--trigger menu.click -o x.svg --animate css": "CSS knows no events of other elements",
    "c.svg --trigger click -o x.svg --animate css": "takes two files; 3 given",
    "--trigger click --emit lottie": "--trigger click is for an animated SVG",
}


@pytest.mark.parametrize("options", REFUSED)
def test_what_cannot_wait_is_refused(here, capsys, options):
    write(a=svg(BAR), b=svg(LEAF), c=svg(BAR))
    assert_refused(capsys, ["a.svg", "b.svg", *options.split()], REFUSED[options])


def test_transitions_go_straight_and_say_so_if_that_was_not_asked_for(here, capsys):
    write(a=svg("M2 10H22V14H2Z"), b=svg("M10 2H14V22H10Z"))
    assert run("a.svg b.svg --trigger hover --animate css -o x.svg".split()) == 0
    assert capsys.readouterr().err == ""
    assert run("a.svg b.svg --trigger hover --animate css -o y.svg --motion rigid".split()) == 0
    assert "moves on curved paths, which CSS transitions cannot show" in capsys.readouterr().err
