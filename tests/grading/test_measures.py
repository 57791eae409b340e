"""What is measured in strips, for trees that tell grades."""

import numpy as np
import pytest

from shapeblend_cli.blending.placing import as_drawn
from shapeblend_cli.grading.grade import grade
from shapeblend_cli.grading.measures import NAMES, measures
from shapeblend_cli.grading.painting import picture
from shapeblend_cli.grading.seen import look
from shapeblend_cli.model import Box
from tests.support.drawings import drawing

VIEW = Box(0, 0, 24, 24)
GROWING = [f"M{12 - r} {12 - r}h{2 * r}v{2 * r}h{-2 * r}Z" for r in np.linspace(3, 9, 7).tolist()]


def strip(paths):
    return [picture(as_drawn(drawing(path)), VIEW) for path in paths]


def named(paths):
    return dict(zip(NAMES, measures(look(strip(paths))), strict=True))


def test_a_strip_has_the_same_measures_backwards():
    paths = [*GROWING[:2], "M2 2h9v4h-9Z M14 14h8v8h-8Z", *GROWING[3:]]
    found = measures(look(strip(paths)))
    assert measures(look(strip(paths[::-1]))) == pytest.approx(found, abs=1e-5)
    assert np.isfinite(found).all()


@pytest.mark.parametrize(
    ("name", "frame"),
    [
        ("pieces most", "M2 2h4v4h-4Z M10 10h4v4h-4Z M18 18h4v4h-4Z"),
        ("area below", "M11 11h2v2h-2Z"),
        ("area above", "M0 0h24v24h-24Z"),
        ("astray most", "M1 1h10v10h-10Z"),
        ("outside most", "M0 0h24v3h-24Z"),
        ("lost most", "M0 0h6v6h-6Z"),
        ("strange most", "M12 3L21 12L12 21L3 12Z"),
        ("step most", "M0 0h2v2h-2Z"),
    ],
)
def test_a_measure_sees_what_it_is_named_for(name, frame):
    plain, other = named(GROWING), named([*GROWING[:3], frame, *GROWING[4:]])
    assert other[name] > plain[name] + 0.01


def test_nothing_is_wrong_where_nothing_changes():
    assert grade(strip([GROWING[3]] * 7)) == (0.0, None)
