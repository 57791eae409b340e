"""The pictures in docs are those that `make pictures` draws today."""

import io
import re

import numpy as np
import pytest
from PIL import Image

from tests.support.documents import ROOT, without_code
from tests.support.equipment import require
from tools.pictures import DOCS, pictures
from tools.quality.data import NUMBER
from tools.studio import SCREENS

LINK = re.compile(r"""(?:!\[[^\]]*\]\(|<img src="| srcset="|\]\((?=[^)]*\.png\)))([^)"]+)""")
PICTURES = pictures()
OF_THE_STUDIO = {f"studio/page-{screen}.png" for screen in SCREENS}

NEAR = 0.3
"""Maximum difference of pixels, in the mean, of 255: renderers round differently at edges."""

MOST_BYTES = 100_000


def every_frame(data):
    image = Image.open(io.BytesIO(data))
    for k in range(getattr(image, "n_frames", 1)):
        image.seek(k)
        yield np.asarray(image.convert("RGB"))


def differ(p, q):
    p, q = (np.array([*every_frame(data)], float) for data in (p, q))
    assert p.shape == q.shape
    return float(np.abs(p - q).mean())


@pytest.mark.parametrize("name", PICTURES)
def test_a_picture_is_what_is_drawn(name):
    if name.startswith("gallery/"):
        require("flubber")
    drawn, kept = PICTURES[name](), (DOCS / name).read_bytes()
    if name.endswith((".png", ".webp")):
        assert differ(drawn, kept) < NEAR
        return
    drawn, kept = drawn.decode(), kept.decode()
    assert NUMBER.sub("#", drawn) == NUMBER.sub("#", kept)
    # The last digit may differ from machine to machine.
    numbers = [[float(n) for n in NUMBER.findall(text)] for text in (drawn, kept)]
    assert numbers[0] == pytest.approx(numbers[1], rel=1e-4, abs=0.11)


def test_another_blend_is_another_picture():
    first, second = (PICTURES[f"moving/{name}.png"]() for name in ("fox-wolf", "egg-hatching-chick"))
    assert differ(first, second) > 20 * NEAR


def test_every_picture_is_drawn_by_a_target_and_shown_by_a_page():
    pages = [ROOT / "README.md", *DOCS.glob("*.md")]
    links = {page: LINK.findall(without_code(page.read_text("utf-8"))) for page in pages}
    linked = {(page.parent / link).resolve() for page in pages for link in links[page]}
    drawn = {DOCS / name for name in {*PICTURES} | OF_THE_STUDIO}
    drawings = {*(DOCS / "studio").glob("*.svg"), *(DOCS / "moving" / "drawings").glob("*.svg")}
    drawings |= {*(DOCS / "icons").glob("*/*.svg")}
    every = {file for kind in ("png", "svg", "webp") for file in DOCS.rglob(f"*.{kind}")}
    assert linked == drawn == every - drawings


def test_pictures_are_small_and_animations_load_nothing():
    for name in {*PICTURES} | OF_THE_STUDIO:
        assert (DOCS / name).stat().st_size < MOST_BYTES
    for file in (DOCS / "moving").glob("*.svg"):
        assert not re.search(r"href|url\(|<script", file.read_text("utf-8"))


@pytest.mark.parametrize("folder", ["studio", "moving/drawings"])
def test_every_drawing_of_others_has_its_source(folder):
    named = (DOCS / folder / "README.md").read_text("utf-8")
    assert {f"`{file.name}`" for file in (DOCS / folder).glob("*.svg")} <= {
        *re.findall(r"`[\w-]+\.svg`", named)
    }
