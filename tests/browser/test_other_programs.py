"""What other programs make of a blend, in a real browser: both must show the frames.

lottie-web plays the Lottie, and a CSS transition moves one file of the pair into the other. lottie-web is installed by
npm from the lock file in `player` into `out/`.
"""

import json
import os
import re
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from shapeblend_cli.cli import run
from shapeblend_cli.easing import LINEAR, Ease
from shapeblend_cli.outputs.lottie import lottie
from shapeblend_cli.pipeline import frame_at
from shapeblend_cli.svg.writing.document import frame_svg
from tests.browser.test_animation import CHROMIUM, FLAGS
from tests.outputs.blends import BLENDS, written
from tests.support.drawings import EIGHT, B
from tests.support.motions import turned_move
from tests.support.pictures import difference

pytestmark = pytest.mark.skipif(CHROMIUM is None, reason="no Chromium here: apt-get install chromium")

HERE = Path(__file__).parent / "player"
INSTALLED = Path(__file__).parents[2] / "out" / "player"
PLAYER = INSTALLED / "node_modules" / "lottie-web" / "build" / "player" / "lottie.min.js"

SIZE = 160
FINER = 4
TIMES = (0.0, 0.25, 0.5, 0.75, 1.0)
SECONDS = 2

# Line caps, which have no half way, change in frames at half time, in a transition at once, and in Lottie never.
SMOOTH = [name for name in BLENDS if name != "lines"]


@pytest.fixture(scope="session")
def player():
    """lottie-web, installed unless it is there."""
    lock = (HERE / "package-lock.json").read_bytes()
    known = INSTALLED / "package-lock.json"
    if PLAYER.exists() and known.exists() and known.read_bytes() == lock:
        return PLAYER
    if not shutil.which("npm"):
        assert os.environ.get("CI") != "true", "no npm here: make test installs it"
        pytest.skip("no npm here, so no player: apt-get install npm")
    INSTALLED.mkdir(parents=True, exist_ok=True)
    for name in ("package.json", "package-lock.json"):
        shutil.copyfile(HERE / name, INSTALLED / name)
    command = ["npm", "ci", "--loglevel=error", "--no-audit", "--no-fund", "--ignore-scripts"]
    if subprocess.run(command, cwd=INSTALLED, stdout=subprocess.DEVNULL, check=False).returncode:
        known.unlink()
        assert os.environ.get("CI") != "true", "npm could not install lottie-web"
        pytest.skip("npm could not install lottie-web")
    return PLAYER


def drawings_and_frames(blend):
    """Write the drawings of a blend, and its frames at `TIMES`, all with the viewBox of A."""
    written(Path(), blend)
    count = str(len(TIMES) - 2)
    options = ["--ends", "-o", "frames", "--motion", "linear", "-q"]
    assert run(["from.svg", "to.svg", "-n", count, *options]) == 0
    viewbox = re.search(r'viewBox="[^"]*"', BLENDS[blend][0]).group()
    return [
        re.sub(r'viewBox="[^"]*"', viewbox, Path(f"frames/frame-{k + 1}.svg").read_text(encoding="utf-8"))
        for k in range(len(TIMES))
    ]


def two_rows(folder, frames, script, source=""):
    """A page with what a script makes of each cell above the frames: pairs of pictures."""
    cells = "".join('<div class="cell"></div>' for _ in frames) + "".join(
        f'<div class="frame">{frame}</div>' for frame in frames
    )
    style = (
        f"body {{margin: 0; width: {len(frames) * SIZE}px; background: white}}"
        f"div {{float: left; width: {SIZE}px; height: {SIZE}px}} svg {{display: block}}"
    )
    page = folder / "page.html"
    page.write_text(
        f"<!doctype html><style>{style}</style><body>{cells}{source}<script>{script}</script>",
        encoding="utf-8",
    )
    picture = folder / "page.png"
    subprocess.run(
        [
            *(CHROMIUM, *FLAGS, f"--user-data-dir={folder / 'profile'}", "--hide-scrollbars"),
            *(f"--force-device-scale-factor={FINER}", f"--window-size={len(frames) * SIZE},{2 * SIZE}"),
            *(f"--screenshot={picture}", page.as_uri()),
        ],
        capture_output=True,
        timeout=120,
        check=True,
    )
    drawn = np.asarray(Image.open(picture).convert("RGB").reduce(FINER), float)
    assert drawn.shape == (2 * SIZE, len(frames) * SIZE, 3)
    columns = np.split(drawn, len(frames), axis=1)
    return [np.split(column, 2) for column in columns]


def played(folder, player, text, frames, times):
    """What lottie-web shows at times as shares of a Lottie, each with a frame."""
    script = f"""
        document.querySelectorAll(".cell").forEach((container, k) => lottie.loadAnimation({{
            container, renderer: "svg", loop: false, autoplay: false, animationData: structuredClone({text}),
        }}).goToAndStop({json.dumps([60 * SECONDS * t for t in times])}[k], true));
    """
    return two_rows(folder, frames, script, f'<script src="{player.as_uri()}"></script>')


@pytest.mark.parametrize("blend", SMOOTH)
def test_lottie_web_plays_the_frames(tmp_path, monkeypatch, player, blend):
    monkeypatch.chdir(tmp_path)
    frames = drawings_and_frames(blend)
    assert run(["from.svg", "to.svg", "--emit", "lottie", "--motion", "linear", "-q"]) == 0
    pictures = played(tmp_path, player, (tmp_path / "blend.json").read_text(encoding="utf-8"), frames, TIMES)
    for shown, frame in pictures:
        assert (frame < 200).any()
        assert difference(shown, frame) < 2e-3
    assert difference(pictures[0][0], pictures[-1][0]) > 0.02


@pytest.mark.parametrize("ease", [LINEAR, Ease(0.42, 0.0, 0.58, 1.0)])
def test_lottie_web_plays_curved_paths(tmp_path, player, ease):
    move, pair = turned_move(B, EIGHT, attributes='fill="#c04020" fill-rule="evenodd"')
    times = (0.1, 0.3, 0.5, 0.62, 0.9)
    frames = [frame_svg(frame_at(pair, ease.at(t), as_drawn=False), 3) for t in times]
    pictures = played(tmp_path, player, lottie([move], SECONDS, ease, 3), frames, times)
    for shown, frame in pictures:
        assert (frame < 200).any()
        assert difference(shown, frame) < 5e-3
    straight = lottie([move._replace(ways=((),))], SECONDS, ease, 3)
    (shown, frame), *_ = played(tmp_path, player, straight, frames[2:3], times[2:3])
    assert difference(shown, frame) > 0.02


@pytest.mark.parametrize("blend", SMOOTH)
def test_a_css_transition_between_the_two_of_a_pair_shows_the_frames(tmp_path, monkeypatch, blend):
    monkeypatch.chdir(tmp_path)
    frames = drawings_and_frames(blend)
    assert run(["from.svg", "to.svg", "--emit", "pair", "-q"]) == 0
    a, b = ((tmp_path / "blend" / name).read_text(encoding="utf-8") for name in ("a.svg", "b.svg"))
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
    pictures = two_rows(tmp_path, frames, script)
    for moved, frame in pictures:
        assert difference(moved, frame) < 2e-3
    assert difference(pictures[0][0], pictures[-1][0]) > 0.02
