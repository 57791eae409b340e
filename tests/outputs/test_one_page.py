"""Several blends in one page: what one of them defines is none of the others' business."""

import re
from pathlib import Path

import pytest

from shapeblend_cli.cli import run
from tests.support.commands import write
from tests.support.drawings import svg

SHADED = (
    '<linearGradient id="g"><stop stop-color="{colour}"/><stop offset="1" stop-color="#0cf"/></linearGradient>'
    '<clipPath id="c"><path d="M0 0h{width}v24h-24z"/></clipPath>'
    '<path clip-path="url(#c)" fill="url(#g)" d="M2 2h20v20h-20z"/>'
)
KINDS = {
    "smil": [],
    "css": ["--animate", "css"],
    "frames": ["--animate", "frames"],
    "hover": ["--trigger", "hover"],
    "click": ["--trigger", "click"],
    "hover by css": ["--trigger", "hover", "--animate", "css"],
    "click by css": ["--trigger", "click", "--animate", "css"],
    "a module": ["--emit", "js"],
}
TIMER = re.compile("b[0-9a-f]{8}s?")


def names(text):
    """What a document defines, by ids, and the classes and keyframes of its style sheet."""
    return set(re.findall(r'(?:\bid=|\bclass=|"id":|@keyframes )"?([\w-]+)', text))


def written(*options):
    assert run(["a.svg", "b.svg", "-o", "-", "-q", *options]) == 0


@pytest.mark.parametrize("options", KINDS.values(), ids=KINDS)
def test_two_blends_share_no_names(options, here, capsys):
    found = []
    for colour, width in (("#f00", 20), ("#0a0", 16)):
        first, second = (SHADED.format(colour=colour, width=each) for each in (width, 12))
        write(a=svg(first), b=svg(second))
        written(*options)
        text = capsys.readouterr().out
        found.append(names(text))
        links = set(re.findall(r"url\(#([\w-]+)\)|#(b[0-9a-f]{8}[\w-]*)", text))
        assert {one or other for one, other in links} <= found[-1]
    assert found[0]
    assert found[1]
    shared = found[0] & found[1]
    # Frames at the same times end by timers that do the same.
    assert all(TIMER.fullmatch(name) for name in shared) if "frames" in options else not shared


def test_two_drawings_of_states_share_no_names(here):
    found = []
    for path in ("M2 2h20v20z", "M2 2h20v20h-20z"):
        write(a=svg(path), b=svg("M4 4h8v8z"))
        assert run(["states", "a.svg", "b.svg", "-o", "states.svg", "-f", "-q"]) == 0
        found.append(names(Path("states.svg").read_text()))
    assert found[0]
    assert not found[0] & found[1]
