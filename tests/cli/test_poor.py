"""What the command says and does where even the best in-betweens look poor: a line, --fail-on and --try."""

import base64
import json
import re
from pathlib import Path
from xml.etree import ElementTree

import pytest

from shapeblend_cli.cli import run
from shapeblend_cli.job import make
from tests.support.commands import write
from tests.support.drawings import BAR, svg
from tests.support.shapes import comb, spiral

SVG = "{http://www.w3.org/2000/svg}"
HREF = "{http://www.w3.org/1999/xlink}href"


KEEP = ("--strokes", "keep")  # a comb and a spiral are pen lines, too


def path(z):
    """Path data of a polygon that fills the view."""
    z = z - z.real.min() - 1j * z.imag.min()
    z = 1 + 1j + 22 * (z.real / z.real.max() + 1j * z.imag / z.imag.max())
    return "M" + " ".join(f"{v.real:.4f},{v.imag:.4f}" for v in z) + "Z"


@pytest.fixture(autouse=True)
def here(here):
    write(comb=svg(path(comb(5))), spiral=svg(path(spiral(4.0, 90))), bar=svg(BAR))
    return here


def test_a_poor_blend_is_said_in_one_line_that_says_what_would_help(here, capsys):
    assert run(["comb.svg", "spiral.svg", *KEEP]) == 0
    (line,) = capsys.readouterr().err.splitlines()
    assert re.fullmatch(
        r"shapeblend: comb.svg and spiral.svg: the in-betweens look poor, grade \d\.\d: [a-z ,]+; "
        r"--pin or --match may help, and --try FILE.svg shows other blends",
        line,
    )
    assert run(["comb.svg", "spiral.svg", *KEEP, "-f", "-q"]) == 0
    assert run(["comb.svg", "spiral.svg", *KEEP, "-f", "--motion", "linear"]) == 0
    assert run(["bar.svg", "bar.svg", "-f"]) == 0
    assert capsys.readouterr().err == ""


def test_a_quiet_run_is_not_graded_in_vain(here, monkeypatch):
    def fail(pair):
        raise AssertionError

    monkeypatch.setattr(make, "grade_of", fail)
    assert run(["comb.svg", "spiral.svg", *KEEP, "-q"]) == 0


def test_in_a_pipeline_a_poor_blend_can_fail_and_then_nothing_is_written(here, capsys):
    assert run(["comb.svg", "spiral.svg", *KEEP, "--fail-on", "poor", "-o", "out"]) == 1
    assert "comb.svg and spiral.svg: the in-betweens look poor, " in capsys.readouterr().err
    assert not (here / "out").exists()
    assert run(["bar.svg", "bar.svg", "--fail-on", "poor", "-o", "out"]) == 0


def test_the_worst_pair_of_a_sequence_is_named(here, capsys):
    assert run(["spiral.svg", "spiral.svg", "comb.svg", *KEEP, "--fail-on", "poor", "-o", "out"]) == 1
    assert "spiral.svg and comb.svg: the in-betweens look poor, grade " in capsys.readouterr().err


def test_the_grade_is_that_of_the_frames(here, capsys):
    assert run(["comb.svg", "spiral.svg", *KEEP, "--ends", "-o", "out", "--report", "report.json", "-q"]) == 0
    (pair,) = json.loads(Path("report.json").read_text("utf-8"))["pairs"]
    assert run(["judge", "out", "--json"]) == 0
    judged = json.loads(capsys.readouterr().out)
    assert pair["grade"]["number"] == pytest.approx(judged["grade"], abs=0.02)
    assert pair["grade"]["why"] == judged["why"]


def test_a_sheet_of_tries_has_other_blends_with_their_numbers_and_options(here, capsys):
    assert run(["comb.svg", "spiral.svg", *KEEP, "--try", "sheet.svg", "-o", "out"]) == 0
    assert "--try" not in capsys.readouterr().err
    root = ElementTree.fromstring((here / "sheet.svg").read_text("utf-8"))
    words = [element.text for element in root.iter(f"{SVG}text")]
    numbers = [float(line.split()[0]) for line in words]
    assert words[0].split(None, 1)[1] == "as it is"
    assert len(words) > 1
    assert numbers[1:] == sorted(numbers[1:])
    assert all(re.match(r"\d\.\d --", line.replace("  ", " ")) for line in words[1:])
    pictures = [element.get(HREF) for element in root.iter(f"{SVG}image")]
    assert len(pictures) == 9 * len(words)
    first = base64.b64decode(pictures[0].partition("base64,")[2]).decode("utf-8")
    assert ElementTree.fromstring(first).tag == f"{SVG}svg"

    # The options do what the sheet says.
    options = words[1].split(None, 1)[1].split()
    assert run(["comb.svg", "spiral.svg", *KEEP, *options, "-f", "-n", "1", "-o", "half.svg", "-q"]) == 0


def test_what_is_asked_for_is_not_tried_otherwise(here):
    assert (
        run(["comb.svg", "spiral.svg", *KEEP, "--try", "sheet.svg", "--motion", "linear", "-o", "out"]) == 0
    )
    text = (here / "sheet.svg").read_text("utf-8")
    assert "--motion" not in text


def test_tries_are_of_two_files(here, capsys):
    assert run(["comb.svg", "spiral.svg", "bar.svg", "--try", "sheet.svg"]) == 2
    assert "--try applies to two files; 3 given" in capsys.readouterr().err
