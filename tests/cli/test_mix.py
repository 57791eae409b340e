"""Mixtures of several drawings."""

import shutil
from pathlib import Path

import numpy as np
import pytest

import shapeblend_cli as sb
from shapeblend_cli.cli import run
from tests.support.commands import points, write
from tests.support.drawings import BAR, EIGHT, EYED, I_DOT, J_DOT, LEAF, RING, SQUARES, B, svg
from tests.support.pictures import pixels

EVENODD = 'fill-rule="evenodd"'
COARSE = ("--vertices", "60", "-q", "-f")


def letters(*paths):
    for name, path in zip("abcd", paths, strict=False):
        write(**{name: svg(path, attributes=EVENODD)})
    return [f"{name}.svg" for name, _ in zip("abcd", paths, strict=False)]


def mixed(files, *mixes):
    """The texts of the frames of mixtures."""
    shutil.rmtree("mixed", ignore_errors=True)
    given = [word for mix in mixes for word in ("--mix", mix)]
    assert run([*files, *given, "-o", "mixed", *COARSE]) == 0
    return [path.read_text() for path in sorted(Path("mixed").iterdir())]


def test_all_of_one_drawing_is_that_drawing(here):
    files = letters(B, EIGHT, RING)
    found = mixed(files, "1,0,0", "0,2,0", "0,0,1")
    for text, file, other in zip(found, files, ("b.svg", "a.svg", "b.svg"), strict=True):
        assert run([file, other, "-n", "0", "--ends", "-o", "ends", *COARSE]) == 0
        assert points(text) == pytest.approx(points(Path("ends/frame-1.svg").read_text()))
    assert mixed(files, "1,0,0") == [found[0]]  # also alone


@pytest.mark.parametrize(
    ("mix", "pair", "count"), [(".5,.5,0", "ab", 1), ("0,.5,.5", "bc", 1), ("3,0,1", "ac", 3)]
)
def test_none_of_a_drawing_is_the_blend_of_the_others(here, mix, pair, count):
    files = letters(B, EIGHT, EYED)
    (text,) = mixed(files, mix)
    names = [f"{name}.svg" for name in pair]
    assert run([*names, "-n", str(count), "-o", "blend", "--motion", "linear", *COARSE]) == 0
    assert text == Path("blend/frame-1.svg").read_text()


def test_a_mixture_is_the_mean_of_corresponding_points(here):
    """Three squares of different sizes: a square of the mean size, at the mean place."""
    sizes = (4, 8, 16)
    files = letters(*(f"M{s / 4} {s / 4}h{s}v{s}h{-s}z" for s in sizes))
    for weights in ((1, 1, 1), (0.2, 0.5, 0.3), (6, 1, 3)):
        share = np.array(weights) / sum(weights)
        (text,) = mixed(files, ",".join(map(str, weights)))
        found = points(text)
        side = float(share @ sizes)
        assert found.real.min() == pytest.approx(side / 4, abs=0.01)
        assert np.ptp(found.real) == pytest.approx(side, abs=0.01)
        assert np.ptp(found.imag) == pytest.approx(side, abs=0.01)


def test_paint_is_mixed_too(here):
    colours = ("#ff0000", "#00ff00", "#0000ff")
    for name, colour in zip("abc", colours, strict=True):
        write(**{name: svg(BAR, attributes=f'fill="{colour}" stroke="#000" stroke-width="{ord(name) - 96}"')})
    (text,) = mixed(["a.svg", "b.svg", "c.svg"], "1,1,1")
    assert 'stroke-width="2"' in text
    red, green, blue = (int(text.split('fill="#')[1][k : k + 2], 16) for k in (0, 2, 4))
    assert max(red, green, blue) < 220
    assert min(red, green, blue) > 60


def test_what_one_drawing_has_grows_from_a_point(here):
    """The pupil of an eye, in three drawings of which one has it: as wide as that one's share."""
    files = letters(LEAF, EYED, BAR)
    widths = []
    for text in mixed(files, "0,1,0", ".4,.5,.1", ".8,.1,.1"):
        pupil = points("M" + text.split(' d="')[1].split('"')[0].split("M")[2])
        widths.append(np.ptp(pupil.real))
    assert widths == pytest.approx([4.0, 2.0, 0.4], abs=0.05)


@pytest.mark.parametrize("drawings", [(B, EIGHT, RING, SQUARES), (I_DOT, J_DOT, B), (SQUARES, BAR, LEAF)])
def test_mixtures_go_over_into_the_drawings(here, drawings):
    """Nearly all of a drawing looks like it, whichever it is."""
    files = letters(*drawings)
    mixes = [
        ",".join("1" if other == k else rest for other in range(len(drawings)))
        for k in range(len(drawings))
        for rest in ("0.001", "0")
    ]
    found = mixed(files, *mixes)
    for close, exact in zip(found[::2], found[1::2], strict=True):
        assert np.abs(pixels(close).astype(float) - pixels(exact)).mean() < 3.0


def test_one_mixture_is_written_to_one_file(here):
    files = letters(B, EIGHT, RING)
    (text,) = mixed(files, "1,1,1")
    assert run([*files, "--mix", "1,1,1", "-o", "one.svg", *COARSE]) == 0
    assert Path("one.svg").read_text() == text
    assert "<animate" not in text
    assert run([*files, "--mix", "1,1,1", "--mix", "1,2,3", "-o", "sheet.png", *COARSE]) == 0
    assert Path("sheet.png").stat().st_size > 1000


def test_names_stay_in_mixtures(here):
    named = [f'<g id="g" ><path id="bar" d="{path}"/></g>' for path in (BAR, LEAF, "M4 4H20V20H4Z")]
    write(a=svg(named[0]), b=svg(named[1]), c=svg(named[2]))
    (text,) = mixed(["a.svg", "b.svg", "c.svg"], "1,1,1")
    assert 'id="bar"' in text
    assert 'id="g"' in text


def test_mixtures_in_python(here):
    files = letters(B, EIGHT, RING)
    blend = sb.blend(files, vertices=60)
    (text,) = mixed(files, ".2,.5,.3")
    assert blend.mix(0.2, 0.5, 0.3).svg == text
    with pytest.raises(sb.ShapeblendError, match="has 2 shares; 3 files given"):
        blend.mix(0.5, 0.5)
