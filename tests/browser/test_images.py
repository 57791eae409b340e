"""Pictures at the ends of a blend, as Chromium shows them in the files, and in modules on the way."""

import numpy as np
from PIL import Image

from shapeblend_cli.cli import run
from tests.browser.test_preview import seek
from tests.support.commands import write
from tests.support.drawings import svg
from tests.support.images import checkerboard, disc, face, image
from tests.support.pictures import difference, pixels

SIZE = 240
EXIF = Image.Exif()
EXIF[0x0112] = 6

CLIP = '<clipPath id="c"><circle cx="12" cy="12" r="8"/></clipPath>'
FILES = {
    "a box": image(checkerboard(), 'x="3" y="4" width="16" height="16"'),
    "meet": image(face(), 'x="2" y="2" width="8" height="20"', "JPEG"),
    "slice": image(face(), 'x="2" y="2" width="8" height="20" preserveAspectRatio="xMinYMid slice"', "WEBP"),
    "none": image(face(), 'x="2" y="2" width="8" height="20" preserveAspectRatio="none"'),
    "turned and skewed": image(
        face(), 'width="12" height="9" transform="translate(9 3) rotate(25) skewX(20)"'
    ),
    "mirrored": image(face(), 'x="-20" y="5" width="16" height="12" transform="scale(-1 1)"'),
    "clipped": CLIP + image(face(), 'clip-path="url(#c)" width="24" height="18" transform="translate(0 3)"'),
    "clipped in a group": CLIP + '<g clip-path="url(#c)">' + image(face(), 'width="24" height="18"') + "</g>",
    "half transparent": '<rect width="24" height="12" fill="teal"/>'
    + image(disc(), 'x="4" y="4" width="16" height="16" opacity=".6"'),
    "of its own size": image(face(16, 12), 'x="2" y="2"'),
    "sideways": image(face(), 'x="2" y="2" width="20" height="20"', "JPEG", exif=EXIF),
    "pixelated": image(checkerboard(5, 1), 'x="2" y="2" width="20" height="20" image-rendering="pixelated"'),
}


def test_the_ends_are_the_drawings(here, screenshot):
    style = f"body{{margin:0;background:#fff}}img{{width:{SIZE}px;height:{SIZE}px;display:block}}"
    names = list(FILES)
    cells = []
    for k, name in enumerate(names):
        other = names[(k + 1) % len(names)]
        write(a=svg(FILES[name]), b=svg(FILES[other]))
        assert run(["a.svg", "b.svg", "-n", "0", "--ends", "-o", f"frames-{k}", "-q"]) == 0
        write(**{f"own-{k}": svg(FILES[name])})
        cells += [f"own-{k}.svg", f"frames-{k}/frame-1.svg", f"frames-{(k - 1) % len(names)}/frame-2.svg"]
    body = "".join(f'<img src="{(here / cell).as_uri()}">' for cell in cells)
    pixels = screenshot(style, body, SIZE, SIZE * len(cells)).reshape(len(names), 3, SIZE, SIZE, 3)
    for name, (own, first, last) in zip(names, pixels, strict=True):
        assert np.abs(own - 255.0).mean() > 5.0, name
        for frame in (first, last):
            assert np.abs(frame - own).mean() < 0.4, name


def test_pictures_of_pixels_are_what_chromium_shows(here, screenshot):
    """Drawn by resvg from pictures that are encoded again: but for how pixels are filtered they are the same."""
    names = [name for name in FILES if name != "pixelated"]
    for k, name in enumerate(names):
        write(a=svg(FILES[name]), b=svg(FILES[name]))
        assert (
            run(
                [
                    "a.svg",
                    "b.svg",
                    "-n",
                    "0",
                    "--ends",
                    "--format",
                    "png",
                    "--width",
                    str(SIZE),
                    "-o",
                    f"f-{k}",
                ]
            )
            == 0
        )
        write(**{f"own-{k}": svg(FILES[name])})
    style = f"body{{margin:0;background:#fff}}img{{width:{SIZE}px;height:{SIZE}px;display:block}}"
    cells = [file for k in range(len(names)) for file in (f"own-{k}.svg", f"f-{k}/frame-1.png")]
    body = "".join(f'<img src="{(here / cell).as_uri()}">' for cell in cells)
    pixels = screenshot(style, body, SIZE, SIZE * len(cells)).reshape(len(names), 2, SIZE, SIZE, 3)
    for name, (own, drawn) in zip(names, pixels, strict=True):
        assert np.abs(own - drawn).mean() < 2.0, name


ROUND, SQUARE = '<circle cx="9" cy="9" r="7"/>', '<path d="M6 4h14v14h-14z"/>'
CUT = '<rect y="20" width="24" height="4" fill="teal"/><clipPath id="c">{}</clipPath><g clip-path="url(#c)">{}</g>'
ONE = CUT.format(ROUND, image(checkerboard(), 'x="1" y="1" width="18" height="18"'))
OTHER = CUT.format(SQUARE, image(face(), 'width="24" height="18"'))
TURNED = image(disc(), 'x="14" y="2" width="9" height="9" transform="rotate(10)"')
FADED = image(disc(), 'x="3" y="12" width="9" height="9" opacity=".6"')
WITH_PICTURES = {"a": svg(ONE + TURNED), "b": svg(OTHER + FADED)}


def shown_in(page, selector):
    """What an element of a page draws, in the view of the drawings."""
    inside = page.evaluate("(selector) => document.querySelector(selector).innerHTML", selector)
    return svg(inside)


def written(here):
    """The frames at 0, half way, and 1, in pixels."""
    assert run("a.svg b.svg -n 1 --ends -o frames --warp off --ease linear -q -f".split()) == 0
    return [pixels((here / f"frames/frame-{k}.svg").read_text("utf-8")) for k in (1, 2, 3)]


def test_the_page_shows_pictures_and_what_clips_them(here, browser):
    write(**WITH_PICTURES)
    assert run("a.svg b.svg -o out --warp off --ease linear --preview page.html -q".split()) == 0
    page = browser.new_page(reduced_motion="reduce")
    wrong = []
    page.on("console", lambda message: wrong.append(message.text))
    page.goto((here / "page.html").as_uri())
    page.wait_for_selector("html[data-ready]")
    found = []
    for t in (0.0, 0.5, 1.0):
        seek(page, t)
        found.append(pixels(shown_in(page, "#picture")))
    page.close()
    assert wrong == []
    for shown, frame in zip(found, written(here), strict=True):
        assert difference(shown, frame) < 5e-3
    assert difference(found[0], found[2]) > 0.05
