"""The pictures in docs are those that the targets draw today."""

import re

import numpy as np
import pytest
from PIL import Image

from tools import gallery, plots, readme_pictures
from tools.quality.data import Pair, polygon
from tools.quality.peers import flubber
from tools.quality.truth import letters

ROOT = readme_pictures.ROOT
DOCS = readme_pictures.DOCS
LINK = re.compile(r"!\[[^\]]*\]\(([^)]+)\)")

NEAR = 0.3
"""Of 255: by how much pixels may differ in the mean. Renderers round differently at edges, and colours are few."""

ICONS = gallery.icons()


def pixels(picture):
    return np.asarray(picture.convert("RGB"), dtype=float)


def differ(p, q):
    """The mean difference of two pictures."""
    p, q = pixels(p), pixels(q)
    assert p.shape == q.shape
    return float(np.abs(p - q).mean())


def in_gallery(shown):
    return Image.open(gallery.GALLERY / f"{shown.name}.png")


def upper_row(picture):
    """What a picture of the gallery has of ours, without the gap below it."""
    return picture.crop((0, 0, picture.width, picture.height // 2))


def near_upper_row(shown):
    drawn = gallery.drawn(shown, with_flubber=False)
    kept = upper_row(in_gallery(shown))
    return differ(drawn.crop((0, 0, *kept.size)), kept) < NEAR


@pytest.mark.parametrize("name", readme_pictures.SHEETS)
def test_a_picture_of_the_readme_is_what_is_drawn(name):
    assert differ(readme_pictures.drawn(name), Image.open(DOCS / f"{name}.png")) < NEAR


@pytest.mark.parametrize("shown", ICONS, ids=lambda shown: shown.name)
def test_icons_in_the_gallery_are_what_is_drawn(shown):
    assert near_upper_row(shown)


def test_letters_in_the_gallery_are_what_is_drawn(fonts):
    found = gallery.of_letters()
    assert len(found) == 3
    assert all(map(near_upper_row, found))


def test_the_gallery_has_flubber_as_it_is_drawn(node, fonts):
    # A third of the pairs; what is not flubber's is drawn above.
    for shown in [*ICONS, *gallery.of_letters()][::3]:
        assert differ(gallery.drawn(shown), in_gallery(shown)) < NEAR


def test_the_page_of_the_gallery_is_what_is_written(fonts):
    assert gallery.PAGE.read_text(encoding="utf-8") == gallery.page([*ICONS, *gallery.of_letters()])


def test_every_picture_is_made_by_a_target_and_every_link_has_one():
    pages = [ROOT / "README.md", *DOCS.glob("*.md")]
    linked = {
        (page.parent / link).resolve() for page in pages for link in LINK.findall(page.read_text("utf-8"))
    }
    gallery_pages = {link.removeprefix("gallery/") for link in LINK.findall(gallery.PAGE.read_text("utf-8"))}
    made = {DOCS / f"{name}.png" for name in readme_pictures.SHEETS}
    made |= {gallery.GALLERY / name for name in gallery_pages}
    made |= {DOCS / f"plot-{kind}.svg" for kind in plots.PLOTS}
    assert linked == made == {*DOCS.rglob("*.png"), *DOCS.rglob("*.svg")}
    names = {shown.name for shown in ICONS}
    names |= {
        f"letters-{name}-{k + 1}"
        for name, every in gallery.LETTERS.items()
        for k in range(_rows(name, every))
    }
    assert {f"{name}.png" for name in names} == gallery_pages


def _rows(name, every):
    """How many letters of a set are shown."""
    return -(-letters.COUNTS[name] * len(letters.FAMILIES) // every)


def test_pictures_of_the_gallery_are_small():
    sizes = [file.stat().st_size for file in gallery.GALLERY.iterdir()]
    assert len(sizes) == 12
    assert max(sizes) < 25_000


def test_another_blend_is_another_picture():
    first, second = ICONS[:2]
    assert (
        differ(gallery.drawn(first, with_flubber=False), gallery.drawn(second, with_flubber=False))
        > 20 * NEAR
    )


def test_both_letters_are_laid_into_the_same_square():
    shapes = gallery.fitted(
        Pair("", "M0,0 L10,0 L10,-20 L0,-20 Z", "M700.5,10 Q700.5,90 780.5,90 L700.5,90 Z")
    )
    for data, low, high in ((shapes.a, 30 + 10j, 70 + 90j), (shapes.b, 10 + 10j, 90 + 90j)):
        points = polygon(data)
        assert complex(points.real.min(), points.imag.min()) == pytest.approx(low)
        assert complex(points.real.max(), points.imag.max()) == pytest.approx(high)


def test_without_flubber_there_is_no_gallery(monkeypatch):
    monkeypatch.setattr(flubber, "install", lambda *what: "node and npm are not there")
    with pytest.raises(SystemExit, match="no gallery: node and npm are not there"):
        gallery.main()
