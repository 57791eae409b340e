"""Drawings that are kept from one blend to the next."""

import pytest

from shapeblend_cli.blending import blended
from shapeblend_cli.blending.placing import AS_IT_IS, flattened
from shapeblend_cli.options.settings import Settings
from shapeblend_cli.pipeline import match_all
from shapeblend_cli.system.kept import Kept
from tests.support.drawings import drawing

SQUARE, ROUND = "M0 0H8V8H0Z", "M4 0A4 4 0 0 1 4 8A4 4 0 0 1 4 0Z"
BACK = "M0 0V8H8V0Z"


def outlines(drawings, kept):
    placed, _ = flattened(drawings, [AS_IT_IS] * len(drawings), 20, kept)
    return [[contour.polygon.vertices.tolist() for contour in each.contours] for each in placed]


@pytest.mark.parametrize("path", [SQUARE, BACK])
def test_what_is_kept_is_oriented_as_the_first_drawing(path):
    a, b, kept = drawing(path), drawing(ROUND), Kept()
    for pair in ([a, b], [b, a], [a, a]):
        assert outlines(pair, kept) == outlines(pair, Kept(0))


def test_lines_of_a_drawing_are_recovered_once(monkeypatch):
    found = []
    make = blended.pen_drawing
    monkeypatch.setattr(blended, "pen_drawing", lambda *given: found.append(given) or make(*given))
    a, b, c = map(drawing, (SQUARE, ROUND, BACK))
    for most, times in ((256, 3), (0, 4)):
        kept = Kept(most)
        for pair in ([a, b], [b, c]):
            match_all(pair, Settings(), kept=kept)
        assert len(found) == times
        found.clear()
