"""Lines of one drawing that become those of several others."""

from pathlib import Path

import numpy as np
import pytest

from shapeblend_cli.interpolate.stars import mixed_shape, star_shapes
from shapeblend_cli.model import Frame
from shapeblend_cli.options.settings import Settings
from shapeblend_cli.pipeline import match_all
from shapeblend_cli.svg.reading.read import read
from shapeblend_cli.svg.writing.document import frame_svg
from tests.support.drawings import drawing
from tests.support.pictures import difference, pixels

ICONS = Path(__file__).parents[1] / "pens" / "icons"


def star(*drawings):
    alone = [tuple(float(j == k) for j in range(len(drawings))) for k in range(len(drawings))]
    settings = Settings(mix=alone, motion="linear", unmatched="point")
    pairs, _ = match_all(drawings, settings)
    return pairs, star_shapes(pairs)


def picture(pairs, shapes, weights):
    painted = [mixed_shape(shape, weights) for shape in shapes]
    return pixels(frame_svg(Frame(0.0, 0, tuple(filter(None, painted)), pairs[0].views[0]), 3))


@pytest.mark.parametrize(
    "names",
    [
        ("lucide-menu", "lucide-x", "lucide-eye"),
        ("ph-eye", "ph-eye-slash"),
        ("ph-eye", "ph-eye-slash", "ph-circle", "ph-x"),
        ("ph-x", "ph-plus", "ph-check", "ph-list"),
        ("ph-circle", "ph-eye-slash", "ph-magnifying-glass"),
        ("ph-toggle-right", "ph-check", "ph-list"),
        ("ph-magnifying-glass", "ph-x", "ph-eye-slash"),
        ("ph-x", "lucide-eye-off", "lucide-eye"),
        ("ph-x", "ph-list-bullets", "ph-trash"),
    ],
    ids="-".join,
)
def test_each_state_is_its_drawing(names):
    files = [ICONS / f"{name}.svg" for name in names]
    pairs, shapes = star(*(read(str(file)) for file in files))
    assert all(key.style.fill is None for shape in shapes for key in shape.keys)
    for k, file in enumerate(files):
        weights = [float(j == k) for j in range(len(files))]
        assert difference(picture(pairs, shapes, weights), pixels(file.read_text("utf-8"))) < 1e-2


def test_a_line_that_opens_stays_in_its_place_on_the_way():
    names = "ph-eye", "ph-eye-slash", "ph-circle"
    pairs, shapes = star(*(read(str(ICONS / f"{name}.svg")) for name in names))
    eye, slashed, between = (picture(pairs, shapes, w) for w in ([1, 0, 0], [0, 1, 0], [0.5, 0.5, 0]))
    new = (between < 128) & (eye > 200) & (slashed > 200)
    assert new.mean() < 2e-3


def test_transparent_lines_are_not_cut():
    ring, arc = "M12 4A8 8 0 1 0 12 20A8 8 0 1 0 12 4Z", "M12 4A8 8 0 0 0 12 20M12 20A8 8 0 0 0 20 12"
    style = 'fill="none" stroke="#000" stroke-width="2" stroke-linecap="round"'
    for opacity, is_cut in (("1", True), ("0.5", False)):
        drawings = [drawing(f'<path d="{d}" {style} opacity="{opacity}"/>') for d in (ring, arc, ring)]
        pairs, _ = star(*drawings)
        assert any(any(shape.contours[0].lines) for shape in pairs[0].shapes) == is_cut


def test_lines_with_mitres_have_no_steps_that_rounding_would_turn():
    ring, arcs = "M12 4A8 8 0 1 0 12 20A8 8 0 1 0 12 4Z", "M12 4A8 8 0 0 0 12 20M12 20A8 8 0 0 0 20 12"
    style = 'fill="none" stroke="#000" stroke-width="2" stroke-linecap="round"'
    drawings = [drawing(f'<path d="{d}" {style}/>') for d in (ring, arcs, "M8 9A4 4 0 1 1 12 13V15M12 18V19")]
    _, shapes = star(*drawings)
    paths = [path for shape in shapes for key in shape.keys for path in key.paths]
    steps = np.concatenate([np.abs(path.segments[:, 3] - path.segments[:, 0]) for path in paths])
    assert ((steps == 0.0) | (steps > 1e-3)).all()
