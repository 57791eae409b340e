"""Settings: checked when they are made, never changed, and declared once."""

import pickle
import subprocess
import sys

import numpy as np
import pytest

from shapeblend_cli.options.constants import PRESETS, WorkConstants
from shapeblend_cli.options.easing import Ease
from shapeblend_cli.options.settings import Settings


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"vertices": -3}, "vertices must be 0 or more, not -3"),
        ({"vertices": 2.5}, "vertices must be a whole number, not 2.5"),
        ({"vertices": True}, "vertices must be a whole number, not True"),
        ({"frames": 10_001}, "frames must be at most 10000, not 10001"),
        ({"solver": "magic"}, "solver must be exact or simplified, not 'magic'"),
        ({"motion": []}, r"motion must be auto, linear, rigid or intrinsic, not \[\]"),
        ({"preset": "fig9"}, "preset must be fig1, .*, fig28 or paper, not 'fig9'"),
        ({"curves": 1}, "curves must be True or False, not 1"),
        ({"c_s": 0}, "c_s must be greater than 0, not 0"),
        ({"c_s": 1.5}, "c_s must be at most 1, not 1.5"),
        ({"k_b": float("nan")}, "k_b must be a number, not nan"),
        ({"k_b": 10**400}, "k_b must be a number, not 1000"),
        ({"p_b": "7"}, "p_b must be a number, not '7'"),
        ({"band": 2}, "band must be none, or a number between 0 and 1, not 2"),
        ({"start": (0, -1)}, r"start must be two vertex numbers, and these begin at 0, not 0,-1"),
        ({"start": 3}, "start must be auto, or two vertex numbers such as 0,3, not 3"),
        ({"pins": [(1, 2j)]}, r"pins must be two vertex numbers such as 0,3, or two points"),
        ({"pins": 3}, "pins must be a sequence, not 3"),
        ({"stiff": [(1j, 0, 2)]}, "stiff must be a point with a radius and a weight greater than 0"),
        ({"match": [("a",)]}, "match must be of the form A=B"),
        ({"ease": "easy"}, "ease must be linear, ease, .*, not 'easy'"),
        ({"ease": (0, 0, 1)}, "ease must be linear"),
    ],
)
def test_what_is_wrong_is_named_with_what_would_work(given, message):
    with pytest.raises(ValueError, match=f"^{message}"):
        Settings(**given)


def test_an_unknown_field_is_named_with_those_there_are():
    message = "Settings has no field vertexes; its fields are k_s, k_b, .*vertices"
    with pytest.raises(TypeError, match=message):
        Settings(vertexes=3)


def test_values_are_kept_in_one_form():
    settings = Settings(
        vertices=np.int64(7),
        k_b=1,
        start=[0, np.int8(3)],
        pins=[[1, 2], [(0, 1.5), np.complex128(2 + 1j)]],
        stiff=[[(1, 2), 3, 4]],
        match=[(0, "#left "), [(1, 2), 3j]],
        ease="ease-in",
    )
    assert settings.pins == ((1, 2), (1.5j, 2 + 1j))
    assert settings.stiff == ((1 + 2j, 3.0, 4.0),)
    assert (settings.start, settings.match) == ((0, 3), (("0", "#left"), (1 + 2j, 3j)))
    assert settings.ease == Ease(0.42, 0.0, 1.0, 1.0)
    kinds = [type(value) for value in (settings.vertices, settings.k_b, settings.start[1])]
    assert kinds == [int, float, int]


def test_values_may_have_the_form_of_the_command_line():
    typed = Settings(match=["0=1"], pins="1,2:3,4", stiff="10,20,5=3", start="0,3")
    assert typed == Settings(match=[(0, 1)], pins=[((1, 2), (3, 4))], stiff=[(10 + 20j, 5, 3)], start=(0, 3))


def test_settings_are_values():
    settings = Settings(vertices=50, k_b=0.3)
    with pytest.raises(AttributeError, match="frozen"):
        settings.vertices = 3
    assert settings == Settings(k_b=0.3, vertices=50) != Settings()
    assert {settings: 1}[settings.replace()] == 1
    assert repr(settings) == "Settings(k_b=0.3, vertices=50)"
    assert pickle.loads(pickle.dumps(settings)) == settings
    assert settings.replace(vertices=None, motion="rigid") == Settings(k_b=0.3, motion="rigid")


def test_a_preset_gives_what_is_not_given_and_else_the_solver():
    settings = Settings(preset="fig28", k_b=0.3)
    row = PRESETS["fig28"]
    assert settings.constants == WorkConstants.of(row | {"k_b": 0.3})
    bands = settings.band, settings.replace(band="none").band, Settings(band=0.5, preset="fig8").band
    assert bands == (row["band"], None, 0.5)
    assert settings.replace(preset="fig3") == Settings(preset="fig3", k_b=0.3)
    assert settings.replace(band="none").replace(vertices=9).band is None
    assert Settings().constants == WorkConstants()


def test_the_paper_has_another_penalty_for_an_angle_of_zero():
    """By turning an angle that closes costs little; by the paper's bending it is as good as forbidden."""
    for kind in (Settings, WorkConstants):
        assert kind().p_b < 10.0
        assert (kind(bending="paper").p_b, kind(bending="paper", p_b=5.0).p_b) == (1000.0, 5.0)
    assert (Settings(preset="paper").p_b, Settings(preset="paper", p_b=2.0).p_b) == (1000.0, 2.0)
    settings = Settings(bending="paper")
    assert settings.replace(bending="turn").p_b == Settings().p_b
    assert settings.replace(k_b=0.5).p_b == 1000.0
    assert Settings().replace(bending="paper").p_b == 1000.0


def test_the_preset_of_the_paper_is_its_work_alone():
    settings = Settings(preset="paper")
    assert (settings.bending, settings.k_t, settings.smoothing) == ("paper", 0.0, 0.0)
    assert settings.constants == WorkConstants(bending="paper", k_t=0.0, smoothing=0.0)
    for name in PRESETS:
        row = Settings(preset=name)
        assert (row.bending, row.k_t, row.smoothing, row.p_b) == ("paper", 0.0, 0.0, 1000.0)
    mixed = Settings(preset="paper", k_t=5.0, bending="turn")
    assert (mixed.bending, mixed.k_t, mixed.smoothing, mixed.p_b) == ("turn", 5.0, 0.0, Settings().p_b)


@pytest.mark.parametrize(
    ("given", "cut"),
    [
        ({}, True),
        ({"vertices": 0}, False),
        ({"bending": "paper"}, False),
        ({"preset": "fig28"}, False),
        ({"band": 0.2}, False),
        ({"solver": "simplified"}, False),
        ({"k_t": 0.0, "smoothing": 0.0}, True),
    ],
)
def test_where_the_polygons_are_the_papers_they_are_not_cut_again(given, cut):
    assert Settings(**given).makes_common_cuts == cut


def test_the_documentation_names_every_field_and_its_type():
    for name in Settings.options.keys() - WorkConstants.options.keys():
        assert f"\n{name} : {Settings.__annotations__[name]}\n    " in Settings.__doc__


def test_settings_need_no_numpy():
    code = "import sys, shapeblend_cli.options.settings; sys.exit('numpy' in sys.modules)"
    subprocess.run([sys.executable, "-c", code], check=True)
