"""Parts of one path that do not touch turn on their own, as they would if each were a path."""

import numpy as np
import pytest

from shapeblend_cli.frames.frames import shapes_at
from shapeblend_cli.geometry.polygons import signed_area
from shapeblend_cli.model import Polygon
from shapeblend_cli.motion import parts
from shapeblend_cli.motion.parts import _touch as touch
from shapeblend_cli.motion.parts import parts_of
from shapeblend_cli.options.settings import Settings
from shapeblend_cli.pipeline import match_all
from tests.support.drawings import drawing
from tests.support.motions import moving_polygons

SQUARE = np.array([0, 4, 4 + 4j, 4j])
TRAY = "M4 15h2v3h12v-3h2v5H4z"
DOWN, UP = "M12 14l-5-5h4V3h2v6h4z", "M12 3l-5 5h4v6h2V8h4z"
"""Above the tray; its box overlaps that of neither arrow."""

CORNERS = "M2 2h6v2H4v4H2z", "M22 2h-6v2h4v4h2z"
CORNERS_TURNED = "M8 8H2V6h4V2h2z", "M16 8h6V6h-4V2h-2z"


def outlines(*paths, t=0.5):
    """The nodes of all contours half way between two documents, each given as its paths."""
    (pair,), _ = match_all([drawing(*some) for some in paths], Settings(strokes="keep"))
    return [path.segments[:, 0] for shape in shapes_at(pair, t) for path in shape.paths]


def test_an_arrow_turns_above_a_tray_in_the_same_path():
    arrow, tray = sorted(outlines([DOWN + TRAY], [UP + TRAY]), key=lambda z: z.imag.mean())
    at_end = sorted(outlines([DOWN + TRAY], [UP + TRAY], t=0.0), key=lambda z: z.imag.mean())
    assert abs(signed_area(arrow)) == pytest.approx(abs(signed_area(at_end[0])), rel=1e-3)
    assert np.ptp(arrow.real) == pytest.approx(np.ptp(at_end[0].imag), rel=1e-3)
    np.testing.assert_allclose(tray, at_end[1], atol=1e-9)


def test_an_arrow_cut_out_of_a_plate_turns_in_it():
    plate = "M1 1v22h22V1z"
    down = "M12 14l5-5h-4V3h-2v6h-4z"
    half_way = min(outlines([plate + UP], [plate + down]), key=lambda z: np.ptp(z.real))
    assert np.ptp(half_way.real) == pytest.approx(11.0, abs=0.1)
    assert np.ptp(half_way.imag) == pytest.approx(10.0, abs=0.1)


def test_a_mouth_bends_back():
    mouth = "M6 {0}C8 {1} 16 {1} 18 {0}C17 {2} 7 {2} 6 {0}z"
    plate = "M1 1v22h22V1z"
    half_way = min(
        outlines([plate + mouth.format(12, 17, 20)], [plate + mouth.format(18, 13, 10)]),
        key=lambda z: np.ptp(z.imag),
    )
    assert np.ptp(half_way.real) > 2.0 * np.ptp(half_way.imag)


def test_parts_beside_each_other_turn_as_mirror_images():
    left, right = sorted(outlines(["".join(CORNERS)], ["".join(CORNERS_TURNED)]), key=lambda z: z.real.mean())
    image = 24 - right.conj()
    away = np.abs(left[:, None] - image)
    assert max(away.min(axis=0).max(), away.min(axis=1).max()) < 0.15


def test_parts_above_each_other_turn_towards_the_same_side():
    above, below = "M12 2l5 5-1 1-4-4-4 4-1-1z", "M12 22l5-5-1-1-4 4-4-4-1 1z"
    above_turned, below_turned = "M12 8l5-5-1-1-4 4-4-4-1 1z", "M12 16l5 5-1 1-4-4-4 4-1-1z"
    upper, lower = sorted(
        outlines([above + below], [above_turned + below_turned]), key=lambda z: z.imag.mean()
    )
    tips = upper[upper.real.argmax()], lower[lower.real.argmax()]
    assert tips[1] == pytest.approx(24j + tips[0].conjugate())
    assert tips[0] == pytest.approx(15 + 5j, abs=0.3)  # and somewhat inwards, to stay in the picture


def test_contours_that_lie_in_each_other_or_touch_are_one_part():
    hole, beside, far = SQUARE / 2 + 1 + 1j, SQUARE + 4, SQUARE + 20
    shape = moving_polygons(*((z, z + 1) for z in (SQUARE, hole, beside, far)))
    assert sorted(map(sorted, parts_of(with_polygons(shape)))) == [[0, 1, 2], [3]]


def test_what_is_apart_at_one_end_is_two_parts():
    shape = moving_polygons((SQUARE, SQUARE), (SQUARE + 1, SQUARE + 30))
    assert len(parts_of(with_polygons(shape))) == 2


def with_polygons(shape):
    """The contours of a shape made of paths, with these as polygons."""

    def polygon(path):
        nodes = path.segments[:, 0]
        return Polygon(nodes, np.arange(len(nodes)), np.zeros(len(nodes)), path.closed)

    return [
        contour._replace(polygon_a=polygon(contour.start), polygon_b=polygon(contour.end))
        for contour in shape.contours
    ]


@pytest.mark.parametrize("step", [0.0, 0.5])
def test_few_outlines_are_compared_where_many_lie_on_each_other(monkeypatch, step):
    """Of those that are in one group already, none is."""
    compared = []
    monkeypatch.setattr(parts, "_touch", lambda p, q: compared.append(1) or touch(p, q))
    shape = moving_polygons(*((10 * SQUARE + k * step,) * 2 for k in range(60)))
    assert len(parts_of(with_polygons(shape))) == 1
    assert len(compared) <= 2 * 60
