"""The plots of docs/plots.md are those of the command, and the document has a command for each."""

import re
from pathlib import Path

import pytest

from tools import plots

ROOT = Path(__file__).parents[2]
NUMBER = re.compile(r"-?\d+(?:\.\d+)?")


@pytest.mark.parametrize("kind", plots.PLOTS)
def test_a_plot_in_the_docs_is_what_the_command_draws(kind):
    drawn, kept = plots.plot(kind), (ROOT / "docs" / f"plot-{kind}.svg").read_text(encoding="utf-8")
    assert NUMBER.sub("#", drawn) == NUMBER.sub("#", kept)
    # Rounding may differ by a last digit from machine to machine.
    numbers = [[float(n) for n in NUMBER.findall(text)] for text in (drawn, kept)]
    assert numbers[0] == pytest.approx(numbers[1], rel=1e-4, abs=0.11)


@pytest.mark.parametrize("kind", plots.PLOTS)
def test_the_document_says_how_each_was_made(kind):
    document = (ROOT / "docs" / "plots.md").read_text(encoding="utf-8")
    a, b, *options = plots.PLOTS[kind].split()
    command = " ".join([f"shapeblend plot {kind} samples/{a}.svg samples/{b}.svg", *options])
    assert f"`{command}`" in document
    assert f"(plot-{kind}.svg)" in document
