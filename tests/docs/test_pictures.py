"""The pictures in docs are those that the targets draw today."""

import io
import re

import numpy as np
import pytest
from PIL import Image

from tests.support.documents import without_code
from tools import gallery, judge_pictures, moving_pictures, paper_pictures, plots, readme_pictures
from tools.quality.data import NUMBER, Pair, polygon
from tools.quality.peers import node as libraries
from tools.quality.truth import letters
from tools.studio import __main__ as studio
from tools.studio.corrections import CORRECTIONS

ROOT = readme_pictures.ROOT
DOCS = readme_pictures.DOCS
LINK = re.compile(r"""(?:!\[[^\]]*\]\(|<img src="| srcset="|\]\((?=[^)]*\.png\)))([^)"]+)""")

NEAR = 0.3
"""Of 255: by how much pixels may differ in the mean. Renderers round differently at edges, and colours are few."""

ICONS = gallery.icons()


def differ(p, q):
    p, q = (np.asarray(picture.convert("RGB"), float) for picture in (p, q))
    assert p.shape == q.shape
    return float(np.abs(p - q).mean())


def same_but_for_rounding(drawn, file):
    """Compare an SVG document with a file; the last digit may differ from machine to machine."""
    kept = file.read_text(encoding="utf-8")
    assert NUMBER.sub("#", drawn) == NUMBER.sub("#", kept)
    numbers = [[float(n) for n in NUMBER.findall(text)] for text in (drawn, kept)]
    assert numbers[0] == pytest.approx(numbers[1], rel=1e-4, abs=0.11)


def in_gallery(shown):
    return Image.open(gallery.GALLERY / f"{shown.name}.png")


def near_upper_row(shown):
    """Compare what a picture of the gallery has of ours, without the gap below it."""
    drawn, kept = gallery.drawn(shown, with_flubber=False), in_gallery(shown)
    upper = (0, 0, kept.width, kept.height // 2)
    return differ(drawn.crop(upper), kept.crop(upper)) < NEAR


@pytest.mark.parametrize("name", readme_pictures.SHEETS)
def test_a_picture_of_the_readme_is_what_is_drawn(name):
    assert differ(readme_pictures.drawn(name), Image.open(DOCS / f"{name}.png")) < NEAR


@pytest.mark.parametrize("kind", plots.PLOTS)
def test_a_plot_in_the_docs_is_what_the_command_draws_and_the_document_says_so(kind):
    same_but_for_rounding(plots.plot(kind), DOCS / f"plot-{kind}.svg")
    document = (DOCS / "plots.md").read_text(encoding="utf-8")
    a, b, *options = plots.PLOTS[kind].split()
    command = " ".join([f"shapeblend plot {kind} samples/{a}.svg samples/{b}.svg", *options])
    assert f"`{command}`" in document
    assert f"(plot-{kind}.svg)" in document


@pytest.mark.parametrize("name", paper_pictures.shown())
def test_a_figure_of_the_paper_is_what_the_command_below_it_draws(name):
    file, drawn = paper_pictures.shown()[name].file, paper_pictures.draw(name)
    if file.suffix == ".svg":
        same_but_for_rounding(drawn.decode(), file)
    else:
        assert differ(Image.open(io.BytesIO(drawn)), Image.open(file)) < NEAR


@pytest.mark.parametrize("name", judge_pictures.EXAMPLES)
def test_a_picture_of_the_judge_is_what_is_drawn(name):
    same_but_for_rounding(judge_pictures.drawn(name), DOCS / f"judge-{name}.svg")


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


def test_what_moves_in_the_readme_is_what_is_drawn():
    same_but_for_rounding(readme_pictures.moving(), DOCS / "moving.svg")


@pytest.mark.parametrize("pair", moving_pictures.PAIRS, ids=moving_pictures.name)
def test_what_moves_in_the_gallery_that_moves_is_what_is_drawn(pair):
    file = moving_pictures.FOLDER / f"{moving_pictures.name(pair)}.svg"
    same_but_for_rounding(moving_pictures.moving(pair), file)
    assert differ(moving_pictures.still(pair), Image.open(file.with_suffix(".png"))) < NEAR


def test_the_gallery_that_moves_is_what_is_written_and_says_where_its_drawings_are_from():
    assert moving_pictures.PAGE.read_text(encoding="utf-8") == moving_pictures.page()
    sources = (moving_pictures.DRAWINGS / "README.md").read_text(encoding="utf-8")
    drawings = {file.name for file in moving_pictures.DRAWINGS.glob("*.svg")}
    assert drawings == {*re.findall(r"`([\w-]+\.svg)`", sources)}
    assert drawings <= {f"{drawing}.svg" for pair in moving_pictures.PAIRS for drawing in pair}


def test_every_picture_is_made_by_a_target_and_every_link_has_one():
    pages = [ROOT / "README.md", *DOCS.glob("*.md")]
    links = {page: LINK.findall(without_code(page.read_text("utf-8"))) for page in pages}
    linked = {(page.parent / link).resolve() for page in pages for link in links[page]}
    gallery_pages = {link.removeprefix("gallery/") for link in LINK.findall(gallery.PAGE.read_text("utf-8"))}
    made = {DOCS / f"{name}.png" for name in readme_pictures.SHEETS}
    made |= {gallery.GALLERY / name for name in gallery_pages}
    made |= {DOCS / "moving.svg"}
    moving = {moving_pictures.FOLDER / moving_pictures.name(pair) for pair in moving_pictures.PAIRS}
    made |= {file.with_suffix(suffix) for file in moving for suffix in (".svg", ".png")}
    made |= {studio.FOLDER / f"{correction.name}.png" for correction in CORRECTIONS}
    made |= {studio.FOLDER / f"page-{name}.png" for name in ("dark", "light", "phone")}
    made |= {DOCS / f"plot-{kind}.svg" for kind in plots.PLOTS}
    made |= {DOCS / f"judge-{name}.svg" for name in judge_pictures.EXAMPLES}
    made |= {shown.file for shown in paper_pictures.shown().values()}
    samples = {*studio.FOLDER.glob("*.svg"), *moving_pictures.DRAWINGS.glob("*.svg")}
    assert linked == made == {*DOCS.rglob("*.png"), *DOCS.rglob("*.svg")} - samples
    names = {shown.name for shown in ICONS}
    for name, every in gallery.LETTERS.items():
        rows = -(-letters.COUNTS[name] * len(letters.FAMILIES) // every)
        names |= {f"letters-{name}-{k + 1}" for k in range(rows)}
    assert {f"{name}.png" for name in names} == gallery_pages


def test_what_moves_is_small_and_loads_nothing():
    for file in moving_pictures.FOLDER.glob("*.svg"):
        text = file.read_text(encoding="utf-8")
        assert len(text) < 100_000
        assert not re.search(r"href|url\(|<script", text)


def test_pictures_of_the_gallery_are_small():
    sizes = [file.stat().st_size for file in gallery.GALLERY.iterdir()]
    assert len(sizes) == 12
    assert max(sizes) < 25_000


def test_figures_of_the_paper_are_small():
    assert all(shown.file.stat().st_size < 65_000 for shown in paper_pictures.shown().values())


def test_another_blend_is_another_picture():
    first, second = (gallery.drawn(shown, with_flubber=False) for shown in ICONS[:2])
    assert differ(first, second) > 20 * NEAR


def test_both_letters_are_laid_into_the_same_square():
    pair = Pair("", "M0,0 L10,0 L10,-20 L0,-20 Z", "M700.5,10 Q700.5,90 780.5,90 L700.5,90 Z")
    shapes = gallery.fitted(pair)
    for data, low, high in ((shapes.a, 30 + 10j, 70 + 90j), (shapes.b, 10 + 10j, 90 + 90j)):
        points = polygon(data)
        assert complex(points.real.min(), points.imag.min()) == pytest.approx(low)
        assert complex(points.real.max(), points.imag.max()) == pytest.approx(high)


def test_without_flubber_there_is_no_gallery(monkeypatch):
    monkeypatch.setattr(libraries, "install", lambda *what: "node and npm are not there")
    with pytest.raises(SystemExit, match="no gallery: node and npm are not there"):
        gallery.main()
