"""Limbs that turn about their joints, and morphs out of animations, on made-up drawings."""

import json
import random

import numpy as np
import pytest

from shapeblend_cli.geometry.polygons import signed_area
from tools.quality.morphs import articulated, authored
from tools.quality.morphs.articulated import Pose
from tools.quality.morphs.rig import NEAR, Limb, Rig
from tools.quality.truth.form import truth
from tools.quality.truth.measures import corr, strict
from tools.quality.truth.write import Morph, at, is_plain, pair


def sides(corners):
    """Straight cubics round a polygon."""
    return [p + (q - p) * np.arange(4) / 3 for p, q in zip(corners, np.roll(corners, -1), strict=True)]


BAR = sides(np.array([0, 100, 100 + 10j, 10j]))
U = np.linspace(0.0, 1.0, 200)


def posed(rig, time):
    return np.concatenate([rig.pose(segment, U, time) for segment in range(len(rig.contour))])


@pytest.mark.parametrize("degrees", [30.0, -80.0])
def test_a_limb_turns_and_keeps_its_width_and_the_rest_stays(degrees):
    rig = Rig(BAR, [Limb((50, 5), (100, 5), degrees)])
    rest, about = posed(rig, 0.0), 50 + 5j
    body, limb = rest.real < 40, rest.real > 60
    for time in (0.5, 1.0):
        turned = posed(rig, time)
        np.testing.assert_array_equal(turned[body], rest[body])
        expected = about + (rest[limb] - about) * np.exp(1j * np.radians(time * degrees))
        np.testing.assert_allclose(turned[limb], expected, atol=0.1)
    assert is_plain([turned])
    assert abs(signed_area(turned)) == pytest.approx(1000.0, rel=0.05)


def test_a_limb_grows_and_one_that_hangs_on_it_goes_with_it():
    rig = Rig(BAR, [Limb((80, 5), (100, 5), 40.0), Limb((50, 5), (100, 5), 90.0, 1.5)])
    rest, turned = posed(rig, 0.0), posed(rig, 1.0)
    between = (rest.real > 60) & (rest.real < 70)
    along, across = rest[between].real - 50, rest[between].imag - 5
    np.testing.assert_allclose(turned[between], 50 + 5j + 1j * (1.5 * along + 1j * across), atol=0.2)
    assert turned[rest.real > 95].imag.min() > 50


def test_cubics_follow_the_pose():
    rig = Rig([2 * segment + 7 for segment in BAR], [Limb((50, 5), (100, 5), 70.0)])
    np.testing.assert_allclose(rig.contour, BAR)  # drawings are scaled to one size
    pieces = rig.pieces(random.Random(1))
    assert len(pieces) > len(BAR)
    for time in (0.0, 0.25, 1.0):
        outline = rig.outline(pieces, time)
        ends, starts = ([cubic[k] for cubic in outline] for k in (-1, 0))
        assert ends == pytest.approx([*starts[1:], starts[0]])
        for (segment, first, last), cubic in zip(pieces, outline, strict=True):
            off = at(cubic, U) - rig.pose(segment, first + U * (last - first), time)
            assert np.abs(off).max() < 2 * NEAR


def test_a_pose_is_written_in_the_form_and_a_is_drawn_as_it_was(monkeypatch):
    monkeypatch.setattr(articulated, "silhouette", lambda family, name: BAR)
    one = articulated.morph(Pose("family", "bar", "bend", [Limb((50, 5), (100, 5), 60.0)]), 0)
    known, a, b = pair(one, "x", "single")
    assert a.count("L") == 3
    assert b.count("C") > 2
    found = truth(json.loads(json.dumps(known)), a, b)
    assert corr(found, found.true_links()) == pytest.approx(0.0, abs=1e-9)
    # Straight ways cut off the arc.
    ways = [[p + (q - p) * t for p, q in found.true_links()] for t in (0.25, 0.5, 0.75)]
    assert 0.03 < strict(found, ways) < 0.5


def path(nodes, closed=True):
    return {"c": closed, "v": nodes, "i": [[0, 0]] * len(nodes), "o": [[0, 0]] * len(nodes)}


OBLONG, ARROW = [[0, 0], [40, 0], [40, 20], [0, 20]], [[0, 0], [40, 10], [0, 20], [20, 10]]


@pytest.fixture
def animation(monkeypatch, tmp_path):
    """Make an animation of which paths are painted together."""
    folder = tmp_path / "lottie-web" / "test" / "animations"
    folder.mkdir(parents=True)
    monkeypatch.setattr(authored, "MODULES", tmp_path)
    monkeypatch.setattr(authored, "ANIMATIONS", ("made",))

    def write(*paths, layers=("a",)):
        items = [{"ty": "sh", "ks": {"k": path}} for path in paths]
        group = {"ty": "gr", "nm": "inner", "it": [*items, {"ty": "fl"}]}
        shapes = [{"ty": "gr", "nm": "outer", "it": [group]}]
        drawn = {"assets": [{}], "layers": [{"nm": name, "shapes": shapes} for name in layers]}
        (folder / "made.json").write_text(json.dumps(drawn), encoding="utf-8")

    return write


def keys(*nodes, times=None, closed=True):
    return [
        {"t": t, "s": [path(each, closed)]} for t, each in zip(times or range(len(nodes)), nodes, strict=True)
    ]


def test_a_step_goes_from_keyframe_to_keyframe(animation):
    animation(keys(OBLONG, ARROW, OBLONG))
    first, second = authored.steps("made")
    assert (first.layer, first.group, first.number, second.number) == ("a", "inner", 0, 1)
    np.testing.assert_array_equal(np.array(first.ends[0])[0, :, 0], np.array(OBLONG) @ [1, 1j])
    np.testing.assert_array_equal(np.array(first.ends[1]), np.array(second.ends[0]))
    old = keys(OBLONG, ARROW)  # an old file tells the last keyframe by the one before
    old[0]["e"] = old[1].pop("s")
    animation(old)
    assert len(list(authored.steps("made"))) == 1


@pytest.mark.parametrize(
    ("paths", "count"),
    [
        pytest.param([path(OBLONG)], 0, id="still"),
        pytest.param([keys(OBLONG, ARROW, closed=False)], 0, id="open"),
        pytest.param([keys(OBLONG, ARROW[:3])], 0, id="other nodes"),
        pytest.param([keys(OBLONG, ARROW), path(OBLONG)], 1, id="beside one that is still"),
        pytest.param([keys(OBLONG, ARROW), keys(OBLONG, ARROW, times=[0, 5])], 0, id="each in its own time"),
    ],
)
def test_steps_of_closed_paths_alone(animation, paths, count):
    animation(*paths)
    assert len(list(authored.steps("made"))) == count


def test_of_copies_of_a_layer_the_step_that_changes_most_is_taken(animation):
    little = [[0, 0], [40, 5], [40, 20], [0, 20]]
    animation(keys(OBLONG, little, ARROW), layers=("a", "a 2", "a Outlines 3"))
    (one,) = authored.morphs("single")
    assert one.what["char"] == "a/inner/1"
    assert max(np.ptp(frame[0].real) for frame in one.frames) == pytest.approx(100.0)


def test_what_is_stretched_or_turned_over_alone_is_no_morph(animation):
    animation(keys(OBLONG, [[0, 0], [80, 0], [90, 30], [10, 30]]))
    assert list(authored.morphs("single")) == []
    animation(keys(OBLONG, [[0, 0], [-40, 10], [-20, 20], [0, 20]]))
    assert list(authored.morphs("single")) == []


def test_how_far_a_morph_is_from_an_affine_map():
    def made(last):
        return Morph({}, (0.0, 1.0), [[sides(np.array(nodes) @ [1, 1j])] for nodes in (OBLONG, last)])

    assert authored.changed(made([[5, 5], [25, 15], [15, 25], [-5, 15]])) == pytest.approx(0.0, abs=1e-9)
    assert authored.changed(made(ARROW)) > 0.2
    assert not authored.is_same(made(ARROW), made(OBLONG))
