"""Which frames there are and what is in them: times beyond the drawings, and specks left out."""

from pathlib import Path

import numpy as np
import pytest

import shapeblend_cli as sb
from shapeblend_cli.cli import run
from tests.support.commands import made, points, report, write
from tests.support.drawings import BAR, EYED, LEAF, svg

BOX, FAR = "M2 8h8v8h-8z", "M6 8h8v8h-8z"


def framed(*options):
    """The texts of frames."""
    assert run(["a.svg", "b.svg", "-o", "frames", "-f", "-q", *options]) == 0
    return [path.read_text() for path in sorted(Path("frames").iterdir())]


def test_times_are_those_of_the_frames_and_go_on_beyond_both_drawings(here):
    write(a=svg(BOX), b=svg(FAR))
    texts = framed("--times", "-.5,0,.25,1,1.5", "--viewbox", "keep")
    assert [points(text).real.min() for text in texts] == pytest.approx([0.0, 2.0, 3.0, 6.0, 8.0])
    assert all('viewBox="0 0 24 24"' in text for text in texts)


@pytest.mark.parametrize("motion", ["linear", "rigid", "intrinsic", "auto"])
def test_motions_go_on_where_they_can(here, motion):
    """A bar that turns by 60 degrees goes on turning; what would cross itself stays."""
    turned = '<g transform="rotate(60 12 12)"><path d="M2 10H22V14H2Z"/></g>'
    write(a=svg("M2 10H22V14H2Z"), b=svg(turned))
    before, start, _, end, after = map(points, framed("--times", "-.25,0,.5,1,1.25", "--motion", motion))
    for one, other in ((before, start), (after, end)):
        assert np.isfinite(one).all()
        assert np.abs(one - one.mean()).max() < 2.0 * np.abs(other - other.mean()).max()
    if motion == "rigid":
        lengths = [np.abs(np.diff(outline)).max() for outline in (before, start, end, after)]
        assert lengths == pytest.approx([20.0] * 4, abs=0.1)


def test_what_grows_is_not_there_before(here):
    write(a=svg(LEAF, attributes='fill-rule="evenodd"'), b=svg(EYED, attributes='fill-rule="evenodd"'))
    counts = [text.split(' d="')[1].split('"')[0].count("M") for text in framed("--times", "-.2,.5,1.2")]
    assert counts == [1, 2, 2]


def test_paint_stays_beyond_the_drawings(here):
    write(a=svg(BOX, attributes='fill="#ff0000"'), b=svg(FAR, attributes='fill="#0000ff"'))
    first, last = framed("--times", "-1,2")
    assert 'fill="#ff0000"' in first
    assert 'fill="#0000ff"' in last


def test_times_are_in_the_report(here):
    write(a=svg(BOX), b=svg(FAR))
    found = report("a.svg", "b.svg", "--times", "-.25,.5,1.25")
    assert [frame["t"] for frame in found["frames"]] == [-0.25, 0.5, 1.25]


SPECK = "M20 20h.1v.1h-.1z"


def test_specks_are_left_out_of_every_frame(here, capsys):
    write(a=svg(BOX + SPECK, f'<path id="dust" d="{SPECK}"/>'), b=svg(FAR))
    plain = framed("-n", "1", "--ends")
    assert "M20" in plain[0]
    assert run("a.svg b.svg -n 1 --ends -o frames -f --specks 0.5".split()) == 0
    assert "a.svg: 2 contours smaller than 0.5 left out" in capsys.readouterr().err
    texts = [path.read_text() for path in sorted(Path("frames").iterdir())]
    assert [text.count("<path") for text in texts] == [1, 1, 1]
    assert [text.split(' d="')[1].split('"')[0].count("M") for text in texts] == [1, 1, 1]
    assert points(texts[1]) == pytest.approx((points(texts[0]) + points(texts[2])) / 2)


def test_specks_may_be_a_share_of_the_drawing(here, capsys):
    large = "M0 0H100V100H0Z M10 10h1.5v1.5h-1.5z M20 20h3v3h-3z"
    write(a=svg(large, viewbox="0 0 100 100"), b=svg("M0 0H100V100H0Z", viewbox="0 0 100 100"))
    assert run("a.svg b.svg -n 0 --ends -o frames --specks 2%".split()) == 0
    assert "a.svg: 1 contour smaller than 2 left out" in capsys.readouterr().err
    assert Path("frames/frame-1.svg").read_text().count("M") == 2
    assert len(sb.blend("a.svg", "b.svg", specks=2.0).pairs[0].contours) == 2


def test_a_drawing_of_specks_alone_is_refused(here, capsys):
    write(a=svg(SPECK), b=svg(LEAF))
    assert run("a.svg b.svg --specks 1".split()) == 1
    assert "a.svg: all of its contours are smaller than 1" in capsys.readouterr().err
    assert made() == []


def test_without_ffmpeg_a_line_says_what_to_install(here, capsys, monkeypatch):
    write(a=svg(BAR), b=svg(LEAF))
    monkeypatch.setenv("PATH", str(here))
    for suffix in ("mp4", "webm"):
        assert run(["a.svg", "b.svg", "-o", f"x.{suffix}"]) == 1
        error = capsys.readouterr().err
        assert (
            f"x.{suffix}: videos need the program ffmpeg, which is not installed (apt-get install ffmpeg"
            in error
        )
        assert error.count("\n") == 1
    assert made() == []
