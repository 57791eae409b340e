"""Pictures that are bent with outlines: which, and how they look."""

import io

import numpy as np
import pytest
from PIL import Image

from shapeblend_cli.cli import run
from shapeblend_cli.frames.frames import frame_at
from shapeblend_cli.images.own_files import with_own_pictures
from shapeblend_cli.options.settings import Settings
from shapeblend_cli.pipeline import match_all
from tests.support.commands import write
from tests.support.drawings import drawing, svg
from tests.support.images import checkerboard, face, image

BOARD, FACE = checkerboard(), face()
HEART = (
    "M12 22C5 17 1 12 1 7.5C1 4 3.5 2 6.5 2C9 2 11 3.5 12 5.5"
    "C13 3.5 15 2 17.5 2C20.5 2 23 4 23 7.5C23 12 19 17 12 22Z"
)
ROUND = '<circle cx="12" cy="12" r="9"/>'


def clipped(region, picture, attributes='width="24" height="24" preserveAspectRatio="none"'):
    region = region if region.startswith("<") else f'<path d="{region}"/>'
    return f'<clipPath id="c">{region}</clipPath>' + image(picture, f'{attributes} clip-path="url(#c)"')


def blend(a, b, **settings):
    (pair,), notes = match_all([drawing(a), drawing(b, file="b.svg")], Settings(**settings))
    return pair, notes


def bent(pair, t=0.5):
    """What is bent at a time."""
    return [shape.bent for shape in frame_at(pair, t, as_drawn=False).shapes if shape.bent]


def pixels(pair, t, side=96):
    """A frame as pictures of pixels show its one picture, without clips."""
    frame = with_own_pictures(frame_at(pair, t, as_drawn=False), side)
    (raster,) = (shape.style.picture.raster for shape in frame.shapes if shape.style.picture)
    return np.asarray(Image.open(io.BytesIO(raster.data)), int)


CASES = {
    "clipped in both": (clipped(ROUND, BOARD), clipped(HEART, FACE), 1),
    "clipped in one": (clipped(ROUND, BOARD), image(FACE, 'width="24" height="24"'), 1),
    "surrounded in both": (
        '<path d="M2 2H14V14H2Z" stroke="red"/>' + image(BOARD, 'x="2" y="2" width="12" height="12"'),
        '<path d="M8 8L22 10V22L8 20Z" stroke="red"/>'
        + image(BOARD, 'x="9" y="11" width="12" height="8" preserveAspectRatio="none"'),
        1,
    ),
    "surrounded, without a partner": (
        '<path d="M2 2H14V14H2Z" stroke="red"/>' + image(BOARD, 'x="2" y="2" width="12" height="12"'),
        f'<path d="{HEART}" stroke="red"/>',
        1,
    ),
    "clipped along an outline, without a partner": (
        f'<path d="M2 2H14V14H2Z" fill="none" stroke="red"/>{clipped("M2 2H14V14H2Z", BOARD)}',
        f'<path d="{HEART}" fill="none" stroke="red"/>',
        1,
    ),
    "small, on a card": (
        '<path d="M0 0H24V24H0Z"/>' + image(BOARD, 'width="6" height="6"'),
        '<path d="M0 0H24V24H0Z"/>' + image(BOARD, 'x="9" y="11" width="6" height="6"'),
        0,
    ),
    "clipped by two shapes": (
        clipped(ROUND + '<rect width="3" height="3"/>', BOARD),
        clipped(HEART, FACE),
        0,
    ),
    "free": (image(BOARD, 'width="6" height="6"'), image(FACE, 'x="9" width="6" height="6"'), 0),
}


@pytest.mark.parametrize("case", CASES)
def test_which_pictures_are_bent(case):
    a, b, count = CASES[case]
    pair, notes = blend(a, b, strokes="keep")
    assert (len(bent(pair)), notes) == (count, [])
    assert not bent(blend(a, b, warp="off")[0])


QUADS = {
    "turned": "M12 2L22 12L12 22L2 12Z",
    "sheared": "M2 4H18L22 18H6Z",
}


@pytest.mark.parametrize("case", QUADS)
def test_a_checkerboard_in_a_square_is_exact_under_affine_maps(case):
    """Centres of its fields have their colours, wherever the square becomes a parallelogram."""
    corners = [
        complex(*map(float, p.split()))
        for p in {"turned": ("12 2", "22 12", "2 12"), "sheared": ("2 4", "18 4", "6 18")}[case]
    ]
    across, down = corners[1] - corners[0], corners[2] - corners[0]
    matrix = (
        f"matrix({across.real} {across.imag} {down.real} {down.imag} {corners[0].real} {corners[0].imag})"
    )
    start = clipped("M4 4H20V20H4Z", BOARD, 'x="4" y="4" width="16" height="16"')
    end = f'<clipPath id="c"><path d="{QUADS[case]}"/></clipPath><g clip-path="url(#c)">'
    end += image(BOARD, f'width="1" height="1" transform="{matrix}"') + "</g>"
    pair, _ = blend(start, end, motion="linear", start=(0, 0), vertices=0)
    for t in (0.25, 0.5, 0.75):
        seen, side = pixels(pair, t, 240), 10.0
        for row in range(6):
            for column in range(6):
                u, v = (column + 0.5) / 6, (row + 0.5) / 6
                place = (1 - t) * (4 + 4j + 16 * complex(u, v)) + t * (corners[0] + u * across + v * down)
                colour = seen[int(side * place.imag), int(side * place.real), :3]
                expected = (20, 60, 160) if (row + column) % 2 == 0 else (250, 230, 190)
                assert np.abs(colour - expected).max() < 12, (t, row, column)


def test_the_edge_of_a_bent_picture_is_that_of_the_outline():
    """Within half a pixel: all that is inside is drawn, and no more than a pixel or two beyond, which clips cut off."""
    pair, _ = blend(clipped(ROUND, BOARD), clipped(HEART, BOARD))
    for t in (0.2, 0.5, 0.8):
        alpha = pixels(pair, t, 240)[..., 3] > 0
        (shape,) = frame_at(pair, t, as_drawn=False).shapes
        (path,) = shape.clips[0].paths
        outline = path.segments[:, [0, 1, 2, 3]]
        s = np.linspace(0, 1, 40)[:, None, None]
        p, q, r, e = outline.T[:, None, None]
        edge = 10 * ((1 - s) ** 3 * p + 3 * s * (1 - s) ** 2 * q + 3 * s**2 * (1 - s) * r + s**3 * e).ravel()
        middle = edge.mean()
        for distance, expected in ((-0.5, True), (4.0, False)):
            places = edge + distance * (edge - middle) / np.abs(edge - middle)
            hit = alpha[places.imag.astype(int).clip(0, 239), places.real.astype(int).clip(0, 239)]
            assert (hit == expected).mean() > 0.99, (t, distance)


def test_both_pictures_are_those_of_their_drawings_at_the_ends():
    pair, _ = blend(clipped(ROUND, BOARD), clipped(HEART, FACE))
    for t, picture in ((1e-6, BOARD), (1 - 1e-6, FACE)):
        own = np.asarray(picture.convert("RGB").resize((96, 96)), int)
        seen = pixels(pair, t)
        inside = seen[..., 3] == 255
        assert inside.mean() > 0.3
        assert np.abs(seen[..., :3] - own)[inside].mean() < 6.0


def test_an_outline_that_crosses_itself_is_said(monkeypatch):
    from shapeblend_cli.blending.images import warping

    def refuse(*_):
        raise warping.NotSimpleError

    monkeypatch.setattr(warping, "Bending", refuse)
    pair, notes = blend(clipped(ROUND, BOARD), clipped(HEART, FACE))
    assert notes == [warping.NOT_BENT]
    assert not bent(pair)


def test_without_earcut_pictures_move_as_a_whole(monkeypatch):
    from shapeblend_cli.blending.images import warping

    monkeypatch.setattr(warping, "is_available", lambda: False)
    pair, (note,) = blend(clipped(ROUND, BOARD), clipped(HEART, FACE))
    assert note.startswith("pictures are not bent with their outlines; ")
    assert not bent(pair)


def test_documents_show_triangles_if_that_is_asked_for(here):
    write(a=svg(clipped(ROUND, BOARD)), b=svg(clipped(HEART, FACE)))
    for warp, are_there in (("auto", False), ("svg", True), ("off", False)):
        assert run(["a.svg", "b.svg", "-n", "1", "--warp", warp, "-o", warp, "-q"]) == 0
        text = (here / warp / "frame-1.svg").read_text("utf-8")
        assert ("<use" in text) == are_there
        assert text.count("base64,") == 2
