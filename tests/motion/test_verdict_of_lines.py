"""The verdict on blends of pen lines."""

from shapeblend_cli.motion.verdict import FAULTS, verdict
from tests.pens.test_line_blends import blend, strokes


def test_what_stays_and_what_little_comes_looks_good():
    for names in (("ph-eye", "ph-eye-slash"), ("lucide-menu", "lucide-x"), ("ph-plus", "ph-check")):
        found = verdict([blend(*names)])
        assert found is None or not found.is_poor


def test_where_nearly_all_comes_or_goes_the_blend_is_poor():
    one, other = "M2 3H5M2 6H5M2 9H5", "M2 3H5M20 12V20M16 12V20M12 12V20"
    pair = blend(strokes(one), strokes(other))
    alone = pair._replace(shapes=tuple(shape for shape in pair.shapes if not shape.is_matched))
    assert alone.shapes
    found = verdict([alone])
    assert found.is_poor
    assert found.fault == FAULTS["alone"]
    assert verdict([pair]).wrong < found.wrong


def test_lines_that_shrink_on_their_way_look_worse():
    bar, turned = "M4 12H20M2 2H22", "M20 12H4.001M2 2H22"
    pair = blend(strokes(bar), strokes(turned), strokes="recover", match=(("0", "0"),), reverse="no")
    straight = pair._replace(shapes=tuple(shape._replace(motion=None) for shape in pair.shapes))
    assert verdict([straight]).wrong > verdict([pair]).wrong + 0.1
