"""Which format is chosen by its name."""

from shapeblend_cli.outputs import registry
from shapeblend_cli.outputs.formats import Format, Rendered


def test_the_longest_suffix_wins(monkeypatch):
    longer = Format("riv", "", lambda spec, pairs: Rendered([]), emit="riv", suffix=".riv.json")
    monkeypatch.setattr(registry, "FORMATS", (*registry.FORMATS, longer))
    assert registry.choose("riv", "x.RIV.json", None, 2) == (longer, "x.RIV.json")
    assert registry.choose("lottie", "x.json", None, 2)[0].name == "lottie"
