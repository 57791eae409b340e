"""Blends to write in every form: what is hard about each is in its name."""

from pathlib import Path

import pytest

from shapeblend_cli.cli import run
from tests.support.commands import write
from tests.support.drawings import BAR, EIGHT, I_DOT, J_DOT, LEAF, RING, SQUARES, B, svg

AB = ("a.svg", "b.svg")
ROUND = 'stroke="#204080" stroke-width="1.5" stroke-linecap="round" stroke-linejoin="round"'

BLENDS = {
    "holes": (
        svg(B, attributes='fill="#c04020" fill-rule="evenodd"'),
        svg(EIGHT, attributes='fill="#c08020" fill-rule="evenodd"'),
    ),
    "colours of different hues": (
        svg(SQUARES, attributes='fill="#c04020"'),
        svg(SQUARES, attributes='fill="#2040c0"'),
    ),
    "a hole that grows, stroked with round caps": (
        svg(LEAF, attributes=f'fill="#ffcc00" {ROUND}'),
        svg(RING, attributes=f'fill="#ffcc00" fill-rule="evenodd" {ROUND}'),
    ),
    "outlines that shrink": (svg(SQUARES, attributes='fill="#080"'), svg(BAR, attributes='fill="#090"')),
    "stroked outlines that grow": (
        svg(BAR, attributes=f'fill="#fff" {ROUND}'),
        svg(SQUARES, attributes=f'fill="#fff" {ROUND}'),
    ),
    "evenodd": (
        svg("M2 2H22V22H2Z M6 6H18V18H6Z", attributes='fill-rule="evenodd"'),
        svg("M2 12L12 2L22 12L12 22Z M8 12L12 8L16 12L12 16Z", attributes='fill-rule="evenodd"'),
    ),
    "lines": (
        svg("M2 2H20V14", attributes=f'fill="none" {ROUND}'),
        svg("M4 20C4 4 20 4 20 20", attributes='fill="none" stroke="#204090" stroke-width="4"'),
    ),
    "paint on one side alone": (
        svg(BAR, attributes='fill="#c0c" fill-opacity=".5"'),
        svg(LEAF, attributes=f'fill="none" {ROUND}'),
    ),
    "shapes on top of one another": (
        svg(f'<path d="{BAR}" fill="#e0a000"/>', f'<path d="{I_DOT}" fill="#0060a0"/>'),
        svg(f'<path d="{LEAF}" fill="#e0b000"/>', f'<path d="{J_DOT}" fill="#0070a0"/>'),
    ),
    "another viewBox": (
        svg("M-40 -10H-20V10H-40Z", viewbox="-50 -20 40 40", attributes='stroke="#f00" stroke-width="3"'),
        svg("M100 100H500L300 400Z", viewbox="50 50 500 400", attributes='fill="#333"'),
    ),
}


OPTIONS = {name: ["--strokes", "keep"] if name == "paint on one side alone" else [] for name in BLENDS}
"""Options of each blend: a stroke that meets a fill would become an outline, whose paint has a partner."""

each_blend = pytest.mark.parametrize("blend", BLENDS)


def emitted(blend, emit, file, *options):
    """Write the two drawings of a blend, and emit it; gives the text of a file."""
    write_blend(blend)
    assert run([*AB, "--emit", emit, *OPTIONS[blend], *options]) == 0
    return Path(file).read_text(encoding="utf-8")


def write_blend(blend):
    """Write the two drawings of a blend, to the files of `AB`."""
    a, b = BLENDS[blend]
    write(a=a, b=b)
