"""Animated SVGs in a real browser, at several times, beside the frame files in the same browser.

Every comparison is of pixels. A browser takes a second or two to start, so all pictures of a test are on one page.
"""

import base64
import re
from pathlib import Path

import numpy as np
import pytest

from shapeblend_cli.cli import run
from shapeblend_cli.frames.frames import frame_at
from shapeblend_cli.interpolate.chains import keyframed_shapes
from shapeblend_cli.model import Box
from shapeblend_cli.options.easing import PINGPONG, Ease, Timing
from shapeblend_cli.options.settings import Settings
from shapeblend_cli.pipeline import match_all
from shapeblend_cli.svg.writing.animation import Views
from shapeblend_cli.svg.writing.css import css_svg
from shapeblend_cli.svg.writing.document import frame_svg
from shapeblend_cli.svg.writing.smil import smil_svg
from tests.support.chromium import picture_of, start_chromium
from tests.support.commands import write
from tests.support.drawings import BAR, EIGHT, EYED, LEAF, RING, SQUARES, B, drawing, svg
from tests.support.ends import ENDS, SHADED, card, emitted_ends
from tests.support.images import checkerboard, face, image
from tests.support.motions import rotated

pytestmark = pytest.mark.usefixtures("blended_once")

SIZE = 120
EVENODD = 'fill-rule="evenodd"'

# Every element with a time is stopped there.
STOP = """<script>
onload = () => {
  for (const box of document.querySelectorAll("[data-time]")) {
    const time = Number(box.dataset.time);
    for (const drawing of box.querySelectorAll("svg")) { // one inside another has a time of its own
      drawing.pauseAnimations();
      drawing.setCurrentTime(time);
    }
    for (const animation of box.getAnimations({subtree: true})) {
      animation.pause();
      animation.currentTime = 1000 * time;
    }
  }
};
</script>"""


@pytest.fixture
def draw(screenshot):
    """Draw the bodies of cells, each stopped at a time if it has one, as (cells, SIZE, SIZE, 3) from 0 to 1."""
    style = f"body{{margin:0;background:#fff}}div{{position:absolute;left:0;width:{SIZE}px;height:{SIZE}px}}"
    style += f"svg,img{{width:{SIZE}px;height:{SIZE}px;display:block}}"

    def drawn(cells):
        boxes = ""
        for k, (body, time) in enumerate(cells):
            own_ids = re.sub(r"(gradient|clip|filter|pattern|mask)-(?=\d)", rf"\1-{k}-", body)
            stopped = "" if time is None else f"data-time={time}"
            boxes += f'<div style="top:{k * SIZE}px" {stopped}>{own_ids}</div>'
        pixels = screenshot(style, boxes + STOP, SIZE, SIZE * len(cells)) / 255.0
        return pixels.reshape(len(cells), SIZE, SIZE, 3)

    return drawn


@pytest.fixture
def assert_shown(draw):
    """Compare rows of an animation, a time, a frame, and, if need be, by how much they may differ in the mean."""

    def compare(rows):
        pixels = draw([cell for moving, time, still, *_ in rows for cell in ((moving, time), (still, None))])
        for moving, still, (_, time, _, *most) in zip(pixels[::2], pixels[1::2], rows, strict=True):
            assert_alike(moving, still, time, *most)

    return compare


def assert_alike(moving, still, time=None, most=0.004):
    """Two pictures differ in the rounding of edges alone."""
    seen, off = float(np.abs(still - 1.0).mean()), np.abs(moving - still)
    mean, share = float(off.mean()), float((off.max(axis=2) > 0.35).mean())
    assert (seen > 0.01, mean < most, share < 0.004) == (True, True, True), (seen, mean, share, time)


COLOURS = (
    '<rect x="2" y="2" width="14" height="14" fill="#eeeeee"/>'
    '<circle cx="14" cy="14" r="7" fill="#8080c0" fill-opacity="0.5" stroke="#303030" stroke-width="2"/>'
)
OTHER_COLOURS = (
    '<rect x="6" y="4" width="10" height="18" fill="#c0c0c0"/>'
    '<circle cx="8" cy="10" r="4" fill="#7070d0" fill-opacity="0.9" stroke="#303030" stroke-width="0.5"/>'
    '<path d="M20 20h2v2h-2z" fill="#202020"/>'
)
RED, BLUE = ('<path d="M2 6H22V18H2Z" fill="#ff0000"/>', '<path d="M2 6H22V18H2Z" fill="#0000ff"/>')
DASHED = '<path d="M2 12H22" fill="none" stroke="#000" stroke-width="3" stroke-dasharray="4 2"/>'
OTHER_DASHED = '<path d="M12 2V22" fill="none" stroke="#000" stroke-width="2" stroke-dasharray="1 3 2 1"/>'
SOLID = '<path d="M4 4L20 20" fill="none" stroke="#444" stroke-width="2"/>'


def graded(kind, colours, attributes):
    stops = "".join(f'<stop offset="{k}" stop-color="{colour}"/>' for k, colour in enumerate(colours))
    return (
        f'<{kind} id="g" gradientUnits="userSpaceOnUse" {attributes}>{stops}</{kind}>'
        '<path d="M2 2H22V22H2Z" fill="url(#g)"/>'
    )


ACROSS = graded("linearGradient", ("#ff0000", "#ffff00"), 'x1="2" x2="22" y1="2" y2="2"')
DOWN = graded("linearGradient", ("#0000ff", "#00ff00"), 'x1="2" x2="2" y1="4" y2="20" spreadMethod="reflect"')
ROUND = graded("radialGradient", ("#ffffff", "#000000"), 'cx="12" cy="12" r="10"')
OVAL = graded("radialGradient", ("#ffff00", "#004000"), 'cx="6" cy="8" r="5" gradientTransform="scale(2 1)"')

BANDS = '<g {0}><path d="M1 1H23V23H1Z" fill="#f0c000"/><path d="M1 {1}H23V{1}V16H1Z" fill="#c00000"/></g>'
CLIPPED_ROUND = '<clipPath id="r"><circle cx="10" cy="12" r="7"/></clipPath>' + BANDS.format(
    'clip-path="url(#r)"', 10
)
CLIPPED_POINTED = '<clipPath id="p"><path d="M4 4H22L13 22Z"/></clipPath>' + BANDS.format(
    'clip-path="url(#p)"', 6
)
KEEPING = (
    '<path d="M4 4H20V20H4Z" fill="none" stroke="#000" stroke-width="6" stroke-dasharray="9 3" '
    'vector-effect="non-scaling-stroke"/>'
)
SCALING = '<path d="M3 3H21V15H3Z" fill="none" stroke="#800" stroke-width="2"/>'

SHADOWED = (
    '<filter id="s" x="0" y="0" width="24" height="24" filterUnits="userSpaceOnUse">'
    '<feOffset in="SourceAlpha" dx="{0}" dy="{0}"/><feGaussianBlur stdDeviation="{1}"/>'
    '<feColorMatrix values="0 0 0 0 0 0 0 0 0 0 0 0 0 0 .4 0 0 0 .7 0"/>'
    '<feMerge><feMergeNode/><feMergeNode in="SourceGraphic"/></feMerge></filter>'
    '<g filter="url(#s)"><path d="M4 4H14V14H4Z" fill="#f0c000"/><path d="M9 9H18V18H9Z" fill="#c00000"/></g>'
)
GLASSY = (
    '<path d="M2 2H16V16H2Z" fill="#e0e0a0"/><g opacity=".5"><path d="M6 6H18V18H6Z" fill="#008080"/>'
    '<path d="M10 10H22V22H10Z" fill="#802000"/></g>'
)
INKED = (
    '<path d="M2 2H16V16H2Z" fill="#e0e0a0"/><g style="mix-blend-mode:multiply">'
    '<path d="M6 6H18V18H6Z" fill="#80c0c0"/>'
    '<path d="M10 10H22V22H10Z" fill="#c0a0ff"/></g>'
)

SPOTTED = (
    '<pattern id="t" width="{0}" height="6" patternUnits="userSpaceOnUse" patternTransform="rotate({1})">'
    '<rect width="{0}" height="6" fill="#f0e0a0"/><circle cx="2" cy="3" r="1.5" fill="#a02020"/></pattern>'
    '<path d="M2 2H{2}V20H2Z" fill="url(#t)"/>'
)
STRIPED = (
    '<pattern id="t" width="4" height="4" patternUnits="userSpaceOnUse"><path d="M0 0H2V4H0Z" fill="#2040a0"/>'
    '</pattern><path d="M4 4H21V21H4Z" fill="url(#t)" stroke="#202020"/>'
)
MASKED = (
    '<linearGradient id="w"><stop stop-color="#fff"/><stop offset="1" stop-color="#000"/></linearGradient>'
    '<mask id="m" maskUnits="userSpaceOnUse" x="0" y="0" width="24" height="24">'
    '<circle cx="{0}" cy="12" r="9" fill="url(#w)"/></mask><g mask="url(#m)">'
    '<path d="M2 2H22V13H2Z" fill="#a02020"/><path d="M2 {1}H22V22H2Z" fill="#2040a0"/></g>'
)

EFFECTS = {
    "shadows": ([SHADOWED.format(1, 0.5), SHADOWED.format(3, 2)], ["--ease", "ease-in"]),
    "a shadow in one of them": ([SHADOWED.format(2, 1), COLOURS], []),
    "a shadow and a blur": ([SHADOWED.format(2, 1), f'<g style="filter:blur(2px)">{RED}</g>'], []),
    "shadows, through three": ([SHADOWED.format(k, 1) for k in (1, 2, 3)], ["--stagger", "0.4"]),
    "opacity and modes of groups": ([GLASSY, INKED], []),
}

# Patterns and soft masks, alone and with filters and modes.
PAINTED = {
    "a pattern that turns and widens": ([SPOTTED.format(5, 0, 14), SPOTTED.format(8, 40, 22)], []),
    "patterns, through three": ([SPOTTED.format(5, 10 * k, 20) for k in range(3)], ["--stagger", "0.4"]),
    "another pattern": ([SPOTTED.format(6, 0, 20), STRIPED], []),
    "a pattern that becomes a colour": ([STRIPED, RED], []),
    "soft masks": ([MASKED.format(9, 9), MASKED.format(14, 14)], []),
    "a soft mask in one of them": ([MASKED.format(12, 10), COLOURS], []),
    "soft masks, through three": ([MASKED.format(9 + 3 * k, 9) for k in range(3)], ["--stagger", "0.4"]),
    "a masked pattern": ([MASKED.format(12, 10) + SPOTTED.format(6, 0, 9), STRIPED], []),
    "a masked shadow that is multiplied": (
        [
            MASKED.format(12, 10) + SHADOWED.format(1, 0.5),
            f'{STRIPED}<g style="mix-blend-mode:multiply">{SHADOWED.format(2, 1)}</g>',
        ],
        [],
    ),
}

CASES = {
    "colours": ([RED, BLUE], ["--ease", "ease"]),
    "dashes": ([SOLID, DASHED], []),
    "dashes that take each other's place": ([DASHED, OTHER_DASHED], ["--swap", "always"]),
    "holes": ([B, EIGHT], []),
    "an eye that shrinks": ([EYED, LEAF], []),
    "paint and strokes": ([COLOURS, OTHER_COLOURS], []),
    # On its way something would leave the viewBox, which css and stacked frames show as large as it ever is.
    "three drawings": ([LEAF, RING, SQUARES], ["--motion", "linear"]),
    "one path through four": ([B, EIGHT, B, EIGHT], ["--ease", "ease-in-out"]),
    "one after the other": ([COLOURS, OTHER_COLOURS], ["--stagger", "0.5", "--motion", "linear"]),
    "clipped": ([CLIPPED_ROUND, CLIPPED_POINTED], ["--ease", "ease-in"]),
    "clipped in one of them": ([CLIPPED_ROUND, BANDS.format("", 6)], []),
    "clipped in turn, through three": ([CLIPPED_ROUND, CLIPPED_POINTED, CLIPPED_ROUND], ["--stagger", "0.4"]),
    "widths on the screen": (
        [KEEPING, SCALING.replace('"2"', '"12" vector-effect="non-scaling-stroke"')],
        [],
    ),
    "a width on the screen becomes one in the drawing": ([KEEPING, SCALING], ["--ease", "ease-in-out"]),
    "polygons, split": ([SQUARES, LEAF], ["--polygons", "--unmatched", "split"]),
}


def blended(here, paths, options):
    """Write drawings; the names of the files, and the frames between them."""
    names = [f"{k}.svg" for k in range(len(paths))]
    for name, path in zip(names, paths, strict=True):
        (here / name).write_text(svg(path, attributes=EVENODD))
    folder = here / f"frames-{len(list(here.iterdir()))}"
    assert run([*names, "-n", "3", "--ends", "-o", str(folder), "-q", *options]) == 0
    return names, [path.read_text() for path in sorted(folder.glob("*.svg"))]


def animated(*arguments):
    assert run([*arguments, "-o", "moving.svg", "-f", "-q"]) == 0
    return Path("moving.svg").read_text()


PICTURE = image(checkerboard(), 'id="p" x="2" y="2" width="12" height="12"')
OTHER_PICTURE = image(
    face(), 'id="p" x="8" y="6" width="14" height="10" transform="rotate(30 12 12)"', "JPEG"
)
ROUND_PICTURE = CLIPPED_ROUND.partition("<g")[0] + f'<g clip-path="url(#r)">{PICTURE}</g>'

PICTURES = {
    "pictures": ([RED + PICTURE, RED + OTHER_PICTURE], ["--ease", "ease-in"]),
    "one picture": ([PICTURE, PICTURE.replace('x="2"', 'x="9" opacity=".6"')], []),
    "a picture that is turned over": (
        [RED + PICTURE, RED + PICTURE.replace("/>", ' transform="scale(-1 1) translate(-22)"/>')],
        [],
    ),
    "a picture that comes": ([RED, RED + PICTURE], []),
    "a clipped picture": ([ROUND_PICTURE, OTHER_PICTURE], ["--ease", "ease-in-out"]),
    "pictures one after the other": ([PICTURE + SOLID, OTHER_PICTURE + SOLID], ["--stagger", "0.4"]),
    "pictures, through three": ([PICTURE, OTHER_PICTURE, PICTURE], []),
}

GRADIENTS = {
    "linear": ([ACROSS, DOWN], []),
    "radial": ([ROUND, OVAL], ["--ease", "ease-in"]),
    "linear to radial": ([ACROSS, ROUND], []),
    "plain to linear": ([RED, DOWN], []),
    "gradients one after the other": (
        [ACROSS + RED, DOWN + BLUE],
        ["--stagger", "0.4", "--stagger-by", "size"],
    ),
    "through three": ([ACROSS, BLUE, OVAL], []),
    "one takes the other's place": ([ACROSS, OVAL], ["--swap", "always"]),
}


def moments(method, blend, options, most, left_out=4):
    """Rows for `assert_shown` of what `blended` has returned."""
    names, frames = blend
    moving = animated(*names, "--animate", method, *options)
    # Frames are eased themselves, so they are evenly spaced in time. At a drawing itself what is a point elsewhere may
    # be a dot.
    return [(moving, 0.5 * k, frames[k], most) for k in range(1, len(frames) - 1) if k % left_out]


def test_animations_show_what_the_frames_show(here, assert_shown):
    rows = {"smil": [], "css": []}
    for name, (paths, options) in (CASES | PICTURES | GRADIENTS).items():
        blend = blended(here, paths, options)
        # Between two colours there are as few in between as the eye asks for.
        most = 0.015 if name == "colours" or name in GRADIENTS else 0.004
        for method in ["smil"] if name in GRADIENTS else rows:
            rows[method] += moments(method, blend, options, most)
    for method in rows:
        assert_shown(rows[method])


@pytest.mark.parametrize("ease", [None, "back-in-out", "linear(0, 0.8 30%, 0.4, 1)"])
def test_filters_and_modes_and_patterns_and_masks_change_as_in_the_frames(here, assert_shown, ease):
    rows = {"smil": [], "css": []}
    for paths, options in [*EFFECTS.values(), *([] if ease else PAINTED.values())]:
        asked = ["--ease", ease] if ease else options
        blend = blended(here, paths, asked)
        for method in rows:
            # Half way modes change at once.
            rows[method] += moments(method, blend, asked, 0.015, left_out=2)
    for method in rows:
        assert_shown(rows[method])


@pytest.mark.parametrize("ease", ["back-in-out", "spring(1,100,8)", "linear(0, 0.8 30%, 0.4, 1)"])
def test_easing_beyond_the_drawings_is_that_of_the_frames(here, assert_shown, ease):
    rows = {"smil": [], "css": []}
    for name, (paths, options) in (CASES | PICTURES | GRADIENTS).items():
        asked = [*options, "--ease", ease]  # the last --ease counts
        blend = blended(here, paths, asked)
        most = 0.015 if name == "colours" or name in GRADIENTS else 0.006
        for method in ["smil"] if name in GRADIENTS else rows:
            rows[method] += moments(method, blend, asked, most)
    for method in rows:
        assert_shown(rows[method])


def test_pingpong_comes_back_the_way_it_went(here, draw):
    names, frames = blended(here, *CASES["one path through four"])
    options = ["--repeat", "pingpong", "--ease", "ease-in"]
    files = [animated(*names, *options, "--animate", method) for method in ("smil", "css")]
    first, *others, start = draw(
        [(text, time) for text in files for time in (1.3, 12.0 - 1.3)] + [(frames[0], None)]
    )
    for picture in others:
        assert_alike(picture, first)
    assert np.abs(first - start).mean() > 0.01


TURNING = {
    "a turn": ([EYED, LEAF], Timing()),
    "an eased turn": ([EYED, LEAF], Timing(ease=Ease(0.42, 0.0, 0.58, 1.0))),
    "paint and strokes": ([COLOURS, OTHER_COLOURS], Timing(ease=Ease(0.25, 0.1, 0.25, 1.0))),
    "one path that turns and goes straight": ([B, EIGHT, B, EIGHT], Timing(ease=Ease(0.42, 0.0, 1.0, 1.0))),
    "tracks that begin late and end early": ([LEAF, RING, SQUARES], Timing()),
    "there and back": ([B, EIGHT, B], Timing(ease=Ease(0.3, 0.0, 0.1, 1.0), repeat=PINGPONG)),
}


@pytest.mark.parametrize("method", ["smil", "css"])
@pytest.mark.parametrize("repeat", ["forever", "pingpong"])
def test_it_rests_at_each_drawing(here, draw, method, repeat):
    write(a=svg(LEAF), b=svg(BAR))
    asked = ["--duration", "1", "--ease", "ease-in", "--animate", method]
    for name, more in (("moves", []), ("rests", ["--hold", "1,2"])):
        assert run(["a.svg", "b.svg", "-o", f"{name}.svg", *asked, "--repeat", repeat, *more]) == 0
    moves, rests = (Path(f"{name}.svg").read_text("utf-8") for name in ("moves", "rests"))
    times = [(0.8, 0.0), (1.4, 0.4), (2.2, 0.999), (3.8, 0.999)]
    times += [(4.6, 1.6)] if repeat == "pingpong" else []
    pixels = draw([cell for rest, move in times for cell in ((rests, rest), (moves, move))])
    for moving, still, time in zip(pixels[::2], pixels[1::2], times, strict=True):
        assert np.abs(moving - still).mean() < 0.005, time


@pytest.mark.parametrize("method", ["smil", "css", "frames"])
def test_it_waits_once_before_it_begins(here, draw, method):
    write(a=svg(LEAF), b=svg(BAR))
    asked = ["a.svg", "b.svg", "--duration", "1", "--animate", method, "-n", "4"]
    at_once, later = animated(*asked), animated(*asked, "--delay", "1500ms")
    times = [(0.2, 0.0), (1.4, 0.0), (2.05, 0.55), (3.25, 1.75)]
    pixels = draw([cell for late, early in times for cell in ((later, late), (at_once, early))])
    for shown, expected, time in zip(pixels[::2], pixels[1::2], times, strict=True):
        assert np.abs(shown - expected).mean() < 0.001, time
    assert np.abs(pixels[0] - pixels[4]).mean() > 0.01


@pytest.mark.parametrize("method", ["smil", "css"])
def test_what_moves_on_curved_paths_is_shown_there(assert_shown, method):
    rows = []
    for paths, timing in TURNING.values():
        straight, _ = match_all([drawing(p, attributes=EVENODD) for p in paths], Settings(motion="linear"))
        moved = [rotated(pair) if k % 2 == 0 else pair for k, pair in enumerate(straight)]
        views = [moved[0].views[0], *(pair.views[1] for pair in moved)]
        if method == "smil":
            moving = smil_svg(keyframed_shapes(moved), Views(views), timing, 3)
        else:
            moving = css_svg(keyframed_shapes(moved), Box.union(views), timing, 3)
        for k, pair in enumerate(moved):
            for share in (0.05, 0.3, 0.5, 0.72):
                times = [timing.seconds * (k + share)]
                if timing.repeat == PINGPONG:
                    times.append(2.0 * timing.seconds * len(moved) - times[0])
                frame = frame_svg(frame_at(pair, timing.ease.at(share), as_drawn=False), 3)
                rows += [(moving, time, frame) for time in times]
    assert_shown(rows)


def test_stacked_frames_are_shown_in_turn(here, assert_shown):
    paths, options = CASES["three drawings"]
    names, frames = blended(here, paths, options)
    moving = animated(*names, "-n", "3", "--animate", "frames", *options)
    assert_shown([(moving, 4.0 * (k + 0.5) / len(frames), frame) for k, frame in enumerate(frames)])


def test_the_viewbox_moves_with_the_drawings(here, assert_shown):
    (here / "a.svg").write_text(svg(B, attributes=EVENODD))
    (here / "b.svg").write_text(svg(EIGHT, attributes=EVENODD, viewbox="-24 -12 72 48"))
    files = ["a.svg", "b.svg", "--place", "asis", "-q"]
    assert run([*files, "-n", "1", "--ends", "-o", "frames"]) == 0
    frames = [path.read_text() for path in sorted((here / "frames").glob("*.svg"))]
    moving = animated(*files)
    assert_shown([(moving, 1, frames[1]), (moving, 1.99999, frames[2])])


@pytest.mark.parametrize("method", ["smil", "css"])
def test_it_moves_inside_an_image(here, assert_shown, method):
    names, frames = blended(here, *CASES["holes"])
    text = animated(*names, "--animate", method, "--duration", "3600")
    rows = []
    for k in (1, 2, 3):
        # Nothing can be stopped inside an image, but an hour that has begun before hardly moves.
        begun = {"smil": ('dur="3600s"', f'dur="3600s" begin="-{900 * k}s"')}
        begun["css"] = ("3600s infinite", f"3600s -{900 * k}s infinite")
        assert begun[method][0] in text
        data = base64.b64encode(text.replace(*begun[method]).encode()).decode()
        rows.append((f'<img src="data:image/svg+xml;base64,{data}">', None, frames[k]))
    assert_shown(rows)


def test_css_stands_still_for_who_prefers_reduced_motion(here, assert_shown):
    names, frames = blended(here, *CASES["holes"])
    # What the media query holds is applied here to all.
    text = animated(*names, "--animate", "css").replace("(prefers-reduced-motion:reduce)", "all")
    assert_shown([(text, None, frames[0])])


@pytest.fixture(scope="module")
def still_browser(browser):
    """Chromium of somebody who prefers reduced motion; emulation of that does not reach images."""
    started = start_chromium(browser.browser_type, "--force-prefers-reduced-motion")
    yield started
    started.close()


@pytest.mark.parametrize(
    "options", ["--animate smil", "--animate frames -n 3", "--repeat pingpong", "--animate css"]
)
def test_for_who_prefers_reduced_motion_only_the_first_drawing_is_shown(
    here, browser, still_browser, options
):
    names, _ = blended(here, *CASES["one after the other"])
    text = animated(*names, *options.split(), "--duration", "1").replace(
        "<svg", '<svg width="99" height="99"', 1
    )
    (here / "m.svg").write_text(text)
    (here / "img.html").write_text('<body style="margin:0"><img src="m.svg">')
    (here / "inline.html").write_text(f'<body style="margin:0">{text}')
    (here / "first.svg").write_text(re.sub(r"<animate[^>]*/>", "", text).replace("animation:", "no:"))

    def pictures(one, motion, name, count, wait=60):
        with one.new_context(viewport={"width": 99, "height": 99}, reduced_motion=motion) as context:
            page, found = context.new_page(), []
            page.goto((here / name).as_uri())
            for _ in range(count):
                page.wait_for_timeout(wait)
                found.append(np.asarray(picture_of(page), float) / 255.0)
            return found

    (first,) = pictures(browser, "no-preference", "first.svg", 1)
    for name in ("m.svg", "img.html", "inline.html"):
        moved = [np.abs(picture - first).mean() for picture in pictures(browser, "no-preference", name, 6)]
        (still,) = pictures(still_browser, "null", name, 1, 500)
        assert max(moved) > 0.05
        assert np.abs(still - first).max() < 1e-9


@pytest.mark.parametrize("method", ["smil", "css", "frames"])
def test_the_first_and_the_last_moment_are_the_drawings(here, draw, method):
    # Only SMIL animates the viewBox, and CSS no gradients.
    left_out = {"smil": [], "css": [*SHADED, "another viewBox"], "frames": ["another viewBox"]}[method]
    cells, names = [], [name for name in ENDS if name not in left_out]
    for name in names:
        moving = emitted_ends(name, "m.svg", "-o", "m.svg", "--animate", method, "--repeat", "1", "-n", "1")
        cells += [(moving, 0.0), (moving, 1.99999), *((text, None) for text in ENDS[name][:2])]
    pictures = iter(draw(cells))
    for name, first, last, a, b in zip(names, pictures, pictures, pictures, pictures, strict=True):
        for shown, still in ((first, a), (last, b)):
            assert (np.abs(shown - still).max(axis=2) > 0.13).mean() < 0.005, name
        assert (np.abs(first - last).max(axis=2) > 0.13).mean() > 0.02


@pytest.mark.parametrize("method", ["smil", "css"])
def test_a_stroke_of_one_width_on_the_screen_is_that_of_the_drawings(here, draw, method):
    texts = [
        svg(KEEPING).replace("<svg", '<svg width="48"'),
        svg(f'<g transform="scale(2 3)">{KEEPING}</g>', viewbox="0 0 60 90").replace('"6"', '"3"'),
    ]
    for name, text in zip("ab", texts, strict=True):
        (here / f"{name}.svg").write_text(text, encoding="utf-8")
    moving = animated("a.svg", "b.svg", "--animate", method, "--repeat", "1", "--strokes", "keep")
    for shown, still in zip(
        *np.split(draw([(moving, 0.0), (moving, 1.99999), *((t, None) for t in texts)]), 2), strict=True
    ):
        assert_alike(shown, still)


@pytest.mark.parametrize("method", ["smil", "css"])
def test_what_lies_on_what_may_be_otherwise_in_each_drawing_of_a_sequence(here, draw, method):
    red, blue = 'fill="#d02020"', 'fill="#2040c0"'
    texts = [
        svg(card(2, 4, red), card(8, 6, blue)),
        svg(card(1, 4, red), card(13, 6, blue)),
        svg(card(9, 6, blue), card(3, 4, red)),
    ]
    names = [f"{k}.svg" for k in range(3)]
    for name, text in zip(names, texts, strict=True):
        (here / name).write_text(text, encoding="utf-8")
    moving = animated(*names, "--animate", method, "--repeat", "1")
    moments = (0.0, 1.99999, 2.00001, 3.99999)
    shown = draw([(moving, time) for time in moments] + [(texts[k], None) for k in (0, 1, 1, 2)])
    for picture, still in zip(shown[:4], shown[4:], strict=True):
        assert (np.abs(picture - still).max(axis=2) > 0.13).mean() < 0.005
