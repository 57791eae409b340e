"""How much of a pixel lies inside a path."""

import numpy as np
import pytest

from shapeblend_cli.images import coverage as module
from shapeblend_cli.images.coverage import coverage
from shapeblend_cli.model import Clip
from tests.support.drawings import drawing


def clip(d, rule="nonzero"):
    (shape,) = drawing(f'<path d="{d}"/>').shapes
    return Clip(
        tuple(contour.path if hasattr(contour, "path") else contour for contour in shape.contours), rule
    )


def seen(*clips, corner=0j, scale=1.0, size=(8, 8)):
    return coverage(clips, corner, scale, *size).astype(int)


def test_edges_between_pixels_are_shares():
    found = seen(clip("M1.25 2H5V4.5H1.25Z"))
    assert found[2].tolist() == [0, 191, 255, 255, 255, 0, 0, 0]
    assert found[4].tolist() == [0, 96, 128, 128, 128, 0, 0, 0]
    assert not found[[0, 1, 5, 6, 7]].any()


def test_the_corner_and_the_scale_move_and_enlarge():
    assert (
        seen(clip("M1 1H3V2H1Z"), corner=1 + 0.5j, scale=2.0, size=(5, 4)).sum(axis=1) == [0, 1020, 1020, 0]
    ).all()


@pytest.mark.parametrize(("rule", "middle"), [("nonzero", 255), ("evenodd", 0)])
def test_rules(rule, middle):
    found = seen(clip("M0 0H8V8H0Z M2 2H6V6H2Z", rule))
    assert found[4, 4] == middle
    assert found[0, 0] == 255


def test_what_lies_in_all_regions_is_seen():
    found = seen(clip("M0 0H4.5V8H0Z"), clip("M4 0H8V8H4Z"))
    assert found[3].tolist() == [0, 0, 0, 0, 128, 0, 0, 0]
    assert (seen() == 255).all()


def test_a_disc_has_its_area():
    found = seen(clip("M40 20A20 20 0 1 1 0 20A20 20 0 1 1 40 20Z"), size=(40, 40))
    assert found.sum() / 255 == pytest.approx(np.pi * 400, rel=5e-4)
    assert np.abs(found - found[::-1]).max() <= 2
    assert np.abs(found - found.T).max() <= 6


def test_beyond_the_picture_outlines_count():
    found = seen(clip("M-9 -9H20V20H-9Z M30 0V5L40 9Z"))
    assert (found == 255).all()


def test_many_crossings_are_looked_at_in_parts(monkeypatch):
    disc = clip("M40 20A20 20 0 1 1 0 20A20 20 0 1 1 40 20Z")
    whole = seen(disc, size=(40, 40))
    monkeypatch.setattr(module, "MOST_CROSSINGS", 50)
    assert (seen(disc, size=(40, 40)) == whole).all()
