"""What other programs make of a blend, in a real browser: both must show the frames.

lottie-web plays the Lottie, and a CSS transition moves one file of the pair into the other.
"""

import json
import re
from pathlib import Path

import numpy as np
import pytest

from shapeblend_cli.cli import run
from shapeblend_cli.frames.frames import frame_at
from shapeblend_cli.options.easing import LINEAR, Ease, Timing
from shapeblend_cli.outputs.lottie.lottie import lottie
from shapeblend_cli.svg.writing.document import frame_svg
from tests.outputs.blends import AB, BLENDS, OPTIONS, emitted, write_blend
from tests.support.commands import write
from tests.support.drawings import EIGHT, B, svg
from tests.support.ends import ENDS, emitted_ends
from tests.support.equipment import LOTTIE_WEB, require
from tests.support.images import checkerboard, disc, face, image
from tests.support.motions import rotated_move
from tests.support.pictures import difference

ICONS = Path(__file__).parents[1] / "pens" / "icons"

BAR = '<rect width="24" height="3"/>'

SIZE = 160
FINER = 4
TIMES = (0.0, 0.25, 0.5, 0.75, 1.0)
SECONDS = 2

# Line caps, which have no half way, change in frames at half time, in a transition at once, and in Lottie never.
SMOOTH = [name for name in BLENDS if name != "lines"]

# A transition mixes colours in its own way, which is duller between different hues.
MIXED_ALIKE = [name for name in SMOOTH if name != "colours of different hues"]


def frames_of(blend, ease="linear"):
    """The frames of a blend at `TIMES`, all with the viewBox of A."""
    write_blend(blend)
    options = [
        "-n",
        str(len(TIMES) - 2),
        "--ends",
        "-o",
        "frames",
        "--motion",
        "linear",
        "-q",
        "--ease",
        ease,
    ]
    assert run([*AB, *options, *OPTIONS[blend]]) == 0
    viewbox = re.search(r'viewBox="[^"]*"', BLENDS[blend][0]).group()
    files = [Path(f"frames/frame-{k + 1}.svg") for k in range(len(TIMES))]
    return [re.sub(r'viewBox="[^"]*"', viewbox, file.read_text(encoding="utf-8")) for file in files]


def written_frames():
    """The frames in a folder, with ids of their own: all stand in one page."""
    files = [Path(f"frames/frame-{k + 1}.svg") for k in range(len(TIMES))]
    return [
        re.sub(r'(id="|#)clip-', rf"\1clip-{k}-", file.read_text("utf-8")) for k, file in enumerate(files)
    ]


def assert_shown(pictures, most=2e-3):
    """Something is drawn, and each picture is that of its frame."""
    for shown, frame in pictures:
        assert (frame < 200).any()
        assert difference(shown, frame) < most


@pytest.fixture
def two_rows(screenshot):
    """Draw what a script makes of each cell above the frames: pairs of pictures."""

    def draw(frames, script, source=""):
        cells = '<div class="cell"></div>' * len(frames)
        cells += "".join(f'<div class="frame">{frame}</div>' for frame in frames)
        width = len(frames) * SIZE
        style = (
            f"body {{margin: 0; width: {width}px; background: white}}"
            f"div {{float: left; width: {SIZE}px; height: {SIZE}px}} svg {{display: block}}"
        )
        body = f"{cells}{source}<script>{script}</script>"
        drawn = screenshot(style, body, width, 2 * SIZE, FINER)
        assert drawn.shape == (2 * SIZE, width, 3)
        return [np.split(column, 2) for column in np.split(drawn, len(frames), axis=1)]

    return draw


@pytest.fixture
def played(two_rows):
    """Draw what lottie-web shows at times as shares of a Lottie, each with a frame."""
    require("what plays and morphs in pages")

    def draw(text, frames, times):
        script = f"""
            document.querySelectorAll(".cell").forEach((container, k) => lottie.loadAnimation({{
                container, renderer: "svg", loop: false, autoplay: false, animationData: structuredClone({text}),
            }}).goToAndStop({json.dumps([60 * SECONDS * t for t in times])}[k], true));
        """
        return two_rows(frames, script, f'<script src="{LOTTIE_WEB.as_uri()}"></script>')

    return draw


@pytest.mark.parametrize("ease", ["linear", "back-in-out", "spring(1,100,8)"])
@pytest.mark.parametrize("blend", SMOOTH)
def test_lottie_web_plays_the_frames(here, played, blend, ease):
    text = emitted(blend, "lottie", "blend.json", "--motion", "linear", "-q", "--ease", ease)
    pictures = played(text, frames_of(blend, ease), TIMES)
    assert_shown(pictures, 2e-3 if ease == "linear" else 6e-3)
    assert difference(pictures[0][0], pictures[-1][0]) > 0.02


# A Lottie shows the same part of the plane all the time.
@pytest.mark.parametrize("name", [name for name in ENDS if name != "another viewBox"])
def test_lottie_web_begins_and_ends_with_the_drawings(here, played, name):
    text = emitted_ends(name, "m.json", "--emit", "lottie", "-o", "m.json")
    assert_shown(played(text, ENDS[name][:2], (0.0, 1.0)), 5e-3)


@pytest.mark.parametrize("ease", [LINEAR, Ease(0.42, 0.0, 0.58, 1.0)])
def test_lottie_web_plays_curved_paths(played, ease):
    move, pair = rotated_move(B, EIGHT, attributes='fill="#c04020" fill-rule="evenodd"')
    times, timing = (0.1, 0.3, 0.5, 0.62, 0.9), Timing(SECONDS, ease)
    frames = [frame_svg(frame_at(pair, ease.at(t), as_drawn=False), 3) for t in times]
    assert_shown(played(lottie([move], timing, 3), frames, times), 5e-3)
    straight = move._replace(shapes=tuple(shape._replace(waypoints=()) for shape in move.shapes))
    (shown, frame), *_ = played(lottie([straight], timing, 3), frames[2:3], times[2:3])
    assert difference(shown, frame) > 0.02


@pytest.mark.parametrize("names", [("ph-eye", "ph-eye-slash"), ("ph-check", "ph-plus")])
def test_lottie_web_draws_lines_on_and_back(here, played, names):
    files = [*(str(ICONS / f"{name}.svg") for name in names), "--strokes", "recover"]
    assert run([*files, "--emit", "lottie", "-o", "x.json", "--duration", str(SECONDS), "-q"]) == 0
    assert run([*files, "-n", str(len(TIMES) - 2), "--ends", "-o", "frames", "-q"]) == 0
    frames = [Path(f"frames/frame-{k + 1}.svg").read_text("utf-8") for k in range(len(TIMES))]
    assert_shown(played(Path("x.json").read_text("utf-8"), frames, TIMES), 1e-2)


CLIPS = (
    '<clipPath id="c">{}</clipPath><clipPath id="d"><path d="M0 0H24V15H0Z"/></clipPath>'
    '<g clip-path="url(#d)">{}</g>'
)
PHOTOS = {
    "boxes": (
        image(checkerboard(), 'x="2" y="4" width="10" height="10"'),
        image(face(), 'x="10" y="9" width="12" height="9"', "JPEG"),
    ),
    "turned, skewed and mirrored": (
        image(face(), 'width="12" height="9" transform="translate(9 3) rotate(25) skewX(20)"'),
        image(face(), 'x="-20" y="5" width="16" height="12" transform="scale(-1 1)"'),
    ),
    "the same picture": (
        image(face(), 'width="10" height="9" transform="rotate(20)"', "WEBP"),
        image(face(), 'x="6" y="8" width="16" height="12" opacity=".5"', "WEBP"),
    ),
    "in clips": (
        CLIPS.format(
            '<circle cx="9" cy="9" r="7"/>',
            image(checkerboard(), 'x="1" y="1" width="18" height="18" clip-path="url(#c)"'),
        ),
        CLIPS.format(
            '<path d="M6 4h14v14h-14z"/>', image(face(), 'width="24" height="18" clip-path="url(#c)"')
        ),
    ),
    "in one drawing alone": (BAR, BAR + image(disc(), 'x="4" y="4" width="16" height="16"')),
}


@pytest.mark.parametrize(
    "options", [(), ("--stagger", "0.4"), ("--ease", "back")], ids=["", "stagger", "back"]
)
@pytest.mark.parametrize("name", PHOTOS)
def test_lottie_web_shows_pictures(here, played, name, options):
    write(**{side: svg(BAR + markup) for side, markup in zip("ab", PHOTOS[name], strict=True)})
    files = ["a.svg", "b.svg", "-q", "--warp", "off", *options]
    assert run([*files, "--emit", "lottie", "-o", "x.json", "--duration", str(SECONDS)]) == 0
    assert run([*files, "-n", str(len(TIMES) - 2), "--ends", "-o", "frames"]) == 0
    assert_shown(played(Path("x.json").read_text("utf-8"), written_frames(), TIMES), 1e-2)


def test_lottie_web_shows_what_clips_leave(here, played):
    a, b = (
        '<clipPath id="c"><circle cx="9" cy="9" r="6"/></clipPath>',
        '<clipPath id="c"><path d="M6 6h16v9h-16z"/></clipPath>',
    )
    for name, clip in (("a", a), ("b", b)):
        write(**{name: svg(f'{clip}<path d="M1 1H22V20H1Z" fill="#c40" clip-path="url(#c)"/>')})
    assert run(["a.svg", "b.svg", "--emit", "lottie", "-o", "x.json", "--duration", str(SECONDS), "-q"]) == 0
    assert run(["a.svg", "b.svg", "-n", str(len(TIMES) - 2), "--ends", "-o", "frames", "-q"]) == 0
    assert_shown(played(Path("x.json").read_text("utf-8"), written_frames(), TIMES), 5e-3)


@pytest.mark.parametrize("blend", MIXED_ALIKE)
def test_a_css_transition_between_the_two_of_a_pair_shows_the_frames(here, two_rows, blend):
    a = emitted(blend, "pair", "blend/a.svg", "-q")
    b = Path("blend/b.svg").read_text(encoding="utf-8")
    script = f"""
        const to = new DOMParser().parseFromString({json.dumps(b)}, "image/svg+xml");
        const cells = [...document.querySelectorAll(".cell")];
        const set = (path, from) => [...from.attributes].filter((a) => a.name != "id").forEach(
            (a) => path.style.setProperty(a.name, a.name == "d" ? `path("${{a.value}}")` : a.value));
        for (const cell of cells) {{
            cell.innerHTML = {json.dumps(a)};
            cell.querySelectorAll("path").forEach((path) => set(path, path));
        }}
        document.body.getBoundingClientRect();
        cells.forEach((cell, k) => cell.querySelectorAll("path").forEach((path) => {{
            getComputedStyle(path).d;
            path.style.transition = "all 1s linear";
            set(path, to.getElementById(path.id));
            path.getAnimations().forEach((moving) => {{
                moving.pause();
                moving.currentTime = Math.min(1000 * {json.dumps(TIMES)}[k], 999.9999);
            }});
        }}));
    """
    pictures = two_rows(frames_of(blend), script)
    assert_shown(pictures)
    assert difference(pictures[0][0], pictures[-1][0]) > 0.02
