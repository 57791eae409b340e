"""Similarities map drawings whole."""

from shapeblend_cli.geometry.similarity import Similarity
from tests.support.drawings import contours_of


def test_lengths_of_a_style_are_scaled():
    (contour,) = contours_of("M0 0H9V9Z", attributes='stroke="#000" stroke-width="3"')
    style = Similarity(2j).style(contour.style._replace(pixel=0.5))
    assert (style.stroke_width, style.pixel) == (6.0, 1.0)
