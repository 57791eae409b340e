"""Pairs of coloured drawings whose ends are hard to keep: what lies on what changes, and paint has no partner."""

import re
from pathlib import Path

from shapeblend_cli.cli import run
from tests.support.commands import write
from tests.support.drawings import svg
from tests.support.pictures import pixels


def disc(x, y, r, attributes):
    return f'<circle cx="{x}" cy="{y}" r="{r}" {attributes}/>'


def card(x, y, attributes, width=10, height=14):
    return f'<rect x="{x}" y="{y}" width="{width}" height="{height}" {attributes}/>'


def shade(tag, name, attributes, *colours):
    stops = "".join(f'<stop offset="{k}" stop-color="{colour}"/>' for k, colour in enumerate(colours))
    return f'<{tag} id="{name}" gradientUnits="userSpaceOnUse" {attributes}>{stops}</{tag}>'


RED, BLUE, GOLD, GREEN = ('fill="#d02020"', 'fill="#2040c0"', 'fill="#e8b000"', 'fill="#209040"')
EDGED = 'fill="#ffe080" stroke="#402000" stroke-width="1.5" stroke-linejoin="round"'
WIRE = 'fill="none" stroke="#000" stroke-width="2.5" stroke-linecap="round" stroke-linejoin="round"'
HALF = 'fill-opacity="0.5"'
SHADES = (
    shade("linearGradient", "g", 'x1="2" x2="22"', "#c02020", "#ffe000")
    + shade("linearGradient", "h", 'y1="2" y2="22" x2="0"', "#c02020", "#0040c0")
    + shade("radialGradient", "r", 'cx="9" cy="9" r="9"', "#fff", "#208020")
    + shade("radialGradient", "f", 'cx="12" cy="12" r="11" fx="8" fy="6"', "#fff", "#c08000")
    + shade(
        "radialGradient",
        "o",
        'r="1" gradientTransform="translate(10 9) rotate(30) scale(12 6)"',
        "#fff",
        "#203080",
    )
)

ENDS = {
    "a card from below comes to the top": (
        svg(card(3, 3, RED), card(9, 7, BLUE)),
        svg(card(9, 7, BLUE), card(3, 3, RED)),
        "--match 0=1 --match 1=0",
    ),
    "three cards go round": (
        svg(card(2, 2, RED), card(6, 5, BLUE), card(10, 8, GOLD)),
        svg(card(10, 8, GOLD), card(2, 2, RED), card(6, 5, BLUE)),
        "--match 0=1 --match 1=2 --match 2=0",
    ),
    "glass in another order": (
        svg(card(3, 3, f"{RED} {HALF}"), disc(15, 13, 7, f"{BLUE} {HALF}"), card(9, 2, GOLD, 6, 20)),
        svg(card(9, 2, GOLD, 6, 20), card(3, 3, f"{RED} {HALF}"), disc(15, 13, 7, f"{BLUE} {HALF}")),
        "--match 0=1 --match 1=2 --match 2=0",
    ),
    "edged cards pass a stroke": (
        svg(card(3, 3, EDGED), '<path d="M4 20L20 4" stroke="#c00" stroke-width="3"/>', card(10, 8, EDGED)),
        svg(card(10, 8, EDGED), card(3, 3, EDGED), '<path d="M4 4L20 20" stroke="#c00" stroke-width="3"/>'),
        "--match 0=1 --match 1=2 --match 2=0",
    ),
    "spots grow on what was below": (
        svg(card(2, 12, GOLD, 20, 8), card(4, 4, RED, 16, 10), card(6, 9, GREEN, 12, 6)),
        svg(card(4, 4, RED, 16, 12), disc(9, 9, 2, GREEN), disc(15, 9, 2, GREEN), card(2, 12, GOLD, 20, 8)),
        "--match 0=3 --match 1=0 --match 2=1",
    ),
    "shades that begin with one colour": (
        svg(SHADES, card(2, 2, 'fill="url(#g)"', 14, 14), card(8, 8, 'fill="url(#h)"', 14, 14)),
        svg(SHADES, card(8, 8, 'fill="url(#h)"', 14, 14), card(2, 2, 'fill="url(#g)"', 14, 14)),
        "--match 0=1 --match 1=0",
    ),
    "a linear shade dissolves below a round one": (
        svg(SHADES, card(2, 2, 'fill="url(#g)"', 14, 14), disc(14, 14, 6, BLUE)),
        svg(SHADES, disc(14, 14, 6, BLUE), card(2, 2, 'fill="url(#r)"', 14, 14)),
        "--match 0=1 --match 1=0",
    ),
    "an oval light goes, and a round one comes": (
        svg(SHADES, disc(12, 12, 9, 'fill="url(#o)"'), card(2, 20, 'fill="url(#f)"', 20, 3)),
        svg(SHADES, disc(10, 10, 7, GREEN), card(3, 19, 'fill="url(#r)"', 18, 4)),
        "",
    ),
    "one shade dissolves over another": (
        svg(SHADES, card(2, 2, 'fill="url(#h)"', 14, 20)),
        svg(SHADES, card(4, 2, 'fill="url(#f)"', 14, 18)),
        "",
    ),
    "dashes and sharp corners": (
        svg(
            f'<path d="M4 21L12 7L20 21Z" {GOLD} stroke="#402000" stroke-width="2" stroke-miterlimit="9"/>',
            '<path d="M3 2H20" fill="none" stroke="#c00" stroke-width="2" stroke-dasharray="4 2"/>',
        ),
        svg(
            f'<path d="M5 21L12 9L19 21Z" {GREEN} stroke="#402000" stroke-width="1" stroke-miterlimit="9"/>',
            '<path d="M4 4H20" fill="none" stroke="#c00" stroke-width="3" stroke-dasharray="3 1 1 1"/>',
        ),
        "",
    ),
    "strokes near the edge of a fill": (
        svg(
            f'<path d="M4 4H20V20H4Z" {GOLD}/>',
            f'<path d="M4 4L20 4" {WIRE}/><path d="M20 4V20H4V4" {WIRE}/>',
        ),
        svg(
            f'<path d="M5 4H19V18H5Z" {GOLD}/>',
            f'<path d="M5 4V17.5L5.5 18H18.5L19 17.5V4" {WIRE}/><path d="M5 4H19" {WIRE}/>',
        ),
        "",
    ),
    "one shape becomes two with a card between": (
        svg(f'<path d="M2 2H10V22H2Z M14 2H22V22H14Z" {RED}/>', card(5, 8, BLUE, 14, 8)),
        svg(card(2, 2, RED, 8, 20), card(5, 8, BLUE, 14, 8), card(14, 2, GREEN, 8, 20)),
        "--match 0=0 --match 1=2 --match 2=1",
    ),
    "another viewBox": (
        svg(card(3, 3, RED), card(9, 7, BLUE)),
        svg(card(90, 70, BLUE, 100, 140), card(30, 30, RED, 100, 140), viewbox="0 0 240 220"),
        "--match 0=1 --match 1=0",
    ),
}
"""Two documents and options each."""

SHADED = [name for name, (a, b, _) in ENDS.items() if "Gradient" in a + b]


def write_ends(name):
    """Write the two drawings of a pair, to `a.svg` and `b.svg`."""
    a, b, _ = ENDS[name]
    write(a=a, b=b)


def emitted_ends(name, file, *options):
    """Write the two drawings of a pair, and blend them; gives the text of a file."""
    write_ends(name)
    assert run(["a.svg", "b.svg", "-q", "-f", *ENDS[name][2].split(), *options]) == 0
    return Path(file).read_text(encoding="utf-8")


def viewbox_of(text):
    """The attribute that says what a document shows."""
    return re.search(r'viewBox="[^"]*"', text).group()


def seen(text, like):
    """A document as pixels, of the part of the plane that another one shows."""
    return pixels(text.replace(viewbox_of(text), viewbox_of(like), 1))
