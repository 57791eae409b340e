"""Whole commands beside the bare imports."""

import json

from tests.support.commands import write
from tests.support.drawings import BAR, LEAF, svg
from tools import commands


def test_commands_are_measured_in_multiples_of_imports(here, monkeypatch, capsys):
    monkeypatch.setattr(commands, "ROUNDS", 1)
    write(bar=svg(BAR), leaf=svg(LEAF))
    (here / "pairs.json").write_text(json.dumps([{"id": "bar to leaf", "a": "bar.svg", "b": "leaf.svg"}]))
    commands.main([str(here), "--motion", "linear"])
    lines = capsys.readouterr().out.splitlines()
    assert [line.split()[0] for line in lines[1:4]] == ["median", "95", "most"]
    time, memory = map(float, lines[1].split()[1:])
    assert 1.0 < time < 100.0
    assert 20.0 < memory < 500.0
    assert lines[-1].endswith("bar to leaf")
