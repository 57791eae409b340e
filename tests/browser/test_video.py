"""Videos: what ffmpeg finds in them, and that Chromium plays them."""

import json
import subprocess
from pathlib import Path

import numpy as np
import pytest

from shapeblend_cli.cli import run
from tests.support.commands import write
from tests.support.drawings import svg
from tests.support.equipment import require

LEFT, RIGHT = '<path d="M2 8h8v8h-8z"/>', '<path d="M14 8h8v8h-8z"/>'


@pytest.fixture(scope="module", autouse=True)
def program():
    require("ffmpeg")


def probed(file):
    """What ffprobe says of the only stream of a video, its frames counted."""
    show = [
        "-count_frames",
        "-show_entries",
        "stream=codec_name,width,height,nb_read_frames,avg_frame_rate,pix_fmt",
    ]
    command = ["ffprobe", "-v", "error", *show, "-show_entries", "format=duration", "-of", "json", file]
    found = json.loads(subprocess.run(command, capture_output=True, check=True).stdout)
    (stream,) = found["streams"]
    return stream | {"duration": float(found["format"]["duration"])}


def frames(file, width, height):
    """The pictures of a video, grey from 0 to 255."""
    command = ["ffmpeg", "-v", "error", "-i", file, "-f", "rawvideo", "-pix_fmt", "gray", "-"]
    raw = subprocess.run(command, capture_output=True, check=True).stdout
    return np.frombuffer(raw, np.uint8).reshape(-1, height, width).astype(float)


@pytest.mark.parametrize(("suffix", "codec"), [("mp4", "h264"), ("webm", "vp9")])
@pytest.mark.parametrize(
    ("options", "count", "seconds"),
    [
        (["--duration", "2"], 50, 2.0),
        (["--duration", "1", "--fps", "10"], 10, 1.0),
        (["--duration", "2", "--fps", "10", "--repeat", "pingpong"], 40, 4.0),
        (["--duration", "1", "--fps", "10", "--repeat", "3"], 30, 3.0),
        (["--duration", "3", "-n", "7"], 9, 3.0),
    ],
)
def test_a_video_has_the_frames_and_the_length_it_should_have(here, suffix, codec, options, count, seconds):
    write(a=svg(LEFT), b=svg(RIGHT))
    assert run(["a.svg", "b.svg", "-o", f"v.{suffix}", "-q", "--width", "64", *options]) == 0
    found = probed(f"v.{suffix}")
    assert (found["codec_name"], found["width"], found["height"]) == (codec, 64, 64)
    assert int(found["nb_read_frames"]) == count
    assert found["duration"] == pytest.approx(seconds, abs=0.02)


def test_the_first_and_the_last_frame_are_the_drawings(here):
    write(a=svg(LEFT), b=svg(RIGHT))
    assert run("a.svg b.svg -o v.mp4 -q --width 48 --fps 10".split()) == 0
    shown = frames("v.mp4", 48, 48)
    places = [
        float((np.arange(48) * (picture < 128).sum(axis=0)).sum() / (picture < 128).sum())
        for picture in shown
    ]
    assert places[0] == pytest.approx(2 * 6 - 0.5, abs=0.6)
    assert places[-1] == pytest.approx(2 * 18 - 0.5, abs=0.6)
    assert (np.diff(places) > 0).all()


def test_odd_sides_are_made_even(here):
    write(a=svg(LEFT, viewbox="0 0 24 17"), b=svg(RIGHT, viewbox="0 0 24 17"))
    assert run("a.svg b.svg -o v.mp4 -q --width 51 --fps 5".split()) == 0
    found = probed("v.mp4")
    assert (found["width"], found["height"]) == (52, 36)


def test_a_webm_is_transparent_unless_it_is_asked_not_to_be(here):
    write(a=svg(LEFT), b=svg(RIGHT))
    assert run("a.svg b.svg -o v.webm -q --width 48 --fps 5".split()) == 0
    command = ["ffmpeg", "-v", "error", "-c:v", "libvpx-vp9", "-i", "v.webm", "-frames:v", "1", "first.png"]
    subprocess.run(command, check=True)
    from PIL import Image

    with Image.open("first.png") as picture:
        alpha = np.asarray(picture.convert("RGBA"))[..., 3]
    assert alpha[2, 2] < 10
    assert alpha[24, 12] > 245


def test_the_same_command_gives_the_same_bytes(here):
    write(a=svg(LEFT), b=svg(RIGHT))
    for suffix in ("mp4", "webm"):
        for name in ("one", "other"):
            assert run(["a.svg", "b.svg", "-o", f"{name}.{suffix}", "-q", "--width", "48", "--fps", "5"]) == 0
        assert Path(f"one.{suffix}").read_bytes() == Path(f"other.{suffix}").read_bytes()


@pytest.mark.parametrize("suffix", ["mp4", "webm"])
def test_a_browser_plays_it(here, browser, suffix):
    write(a=svg(LEFT), b=svg(RIGHT))
    assert run(["a.svg", "b.svg", "-o", f"v.{suffix}", "-q", "--width", "64", "--duration", "1"]) == 0
    page = browser.new_page()
    Path("page.html").write_text(f'<video id="v" muted src="v.{suffix}"></video>')
    page.goto(Path("page.html").absolute().as_uri())
    if suffix == "mp4" and not page.evaluate(
        "document.createElement('video').canPlayType('video/mp4; codecs=avc1.64001f')"
    ):
        pytest.skip("this Chromium has no H.264")
    ended = (
        "new Promise((done, failed) => {v.onended = () => done(v.currentTime); v.onerror = failed; v.play()})"
    )
    assert page.evaluate(ended) == pytest.approx(1.0, abs=0.1)
    page.close()
