"""Which format is chosen by its name."""

import inspect

import pytest

from shapeblend_cli.outputs import formats, registry
from shapeblend_cli.outputs.formats import Format


def test_the_longest_suffix_wins(monkeypatch):
    longer = Format("riv", "", "", emit="riv", suffix=".riv.json")
    monkeypatch.setattr(registry, "FORMATS", (*registry.FORMATS, longer))
    assert registry.choose("riv", "x.RIV.json", None, 2) == (longer, "x.RIV.json")
    assert registry.choose("lottie", "x.json", None, 2)[0].name == "lottie"


@pytest.mark.parametrize("form", registry.FORMATS, ids=lambda form: form.name)
def test_functions_of_formats_are_there(form):
    for name, takes in ((form.renderer, 2), (form.checker, 1), (form.libraries, 0)):
        assert not name or len(inspect.signature(formats.named(name)).parameters) == takes


@pytest.mark.parametrize("suffix", [".svg", ".png", ".gif", ".webp", ".mp4", ".json", ".lottie", ".xml"])
def test_the_suffix_alone_chooses(suffix):
    assert registry.choose("frames", f"x{suffix}", None, 2)[0].suffix == suffix


@pytest.mark.parametrize("name", ["frames", "a.b/frames", "x.foo/", "release 1.2", "v1.2-final"])
def test_other_names_are_folders(name):
    assert registry.choose("frames", name, None, 2)[0].name == "svg"


def test_a_folder_that_is_there_may_have_any_name(here):
    here.joinpath("x.foo").mkdir()
    assert registry.choose("frames", "x.foo", None, 2)[0].name == "svg"
