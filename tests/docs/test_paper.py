"""What docs/paper.md says of the paper's figures holds of the blends that its commands make."""

import json
import re

import numpy as np
import pytest

from shapeblend_cli.options.constants import PRESETS
from tools.pictures import DOCS, shown, written

TEXT = (DOCS / "paper.md").read_text(encoding="utf-8")
SHOWN = shown("paper.md")
TIMES = np.arange(7) / 6


@pytest.fixture
def report(tmp_path):
    """Blend as the page says, with further options perhaps, and read the report."""

    def report_of(name, *more):
        file = tmp_path / "report.json"
        written([*SHOWN[f"paper/{name}.png"], "--report", str(file), *more], f"{name}.png")
        return json.loads(file.read_text(encoding="utf-8"))

    return report_of


def contour(report):
    (pair,) = report["pairs"]
    (found,) = pair["contours"]
    return found


def moving(found, number):
    """Where the vertex of A with that number is at seven even times, on its straight path."""
    ((i, j),) = [dot for dot in found["dots"] if dot[0] == number]
    a, b = complex(*found["vertices_a"][i]), complex(*found["vertices_b"][j])
    return (1 - TIMES) * a + TIMES * b


def test_every_picture_has_its_command_and_every_command_its_picture():
    assert len(SHOWN) == TEXT.count("![") == TEXT.count("```sh")


ROWS = re.findall(r"^\| (\d+) \| (.*) \| (\S+) \|$", TEXT, re.MULTILINE)


@pytest.mark.parametrize(("figure", "constants", "here"), ROWS, ids=[row[0] for row in ROWS])
def test_figures_of_table_1_have_its_constants_and_stay_in_its_band(report, figure, constants, here):
    preset, name = f"fig{figure}", f"figure-{figure}"
    columns = ("band", "k_s", "k_b", "e_s", "e_b")
    assert [float(value) for value in constants.split(" | ")] == [PRESETS[preset][key] for key in columns]
    assert f"--preset {preset}" in " ".join(SHOWN[f"paper/{name}.png"])
    assert f"{contour(report(name))['diagonal_deviation']:.3f}" == here


def test_table_1_is_shown_whole():
    assert {f"fig{row[0]}" for row in ROWS} == PRESETS.keys() - {"paper"}
    assert {tuple(PRESETS[f"fig{row[0]}"][key] for key in ("p_b", "m_b", "c_s")) for row in ROWS} == {
        (1000, 10, 0.5)
    }


def test_figure_2_needs_a_vertex_on_the_stem(report):
    assert contour(report("figure-2-corners"))["work"] > 10 * contour(report("figure-2"))["work"]


def test_figure_8_goes_by_numbers(report):
    assert contour(report("figure-8"))["dots"] == [[k, k] for k in range(6)]


def test_figure_9_takes_no_work_and_loses_half_its_area(report):
    found = report("figure-9")
    assert contour(found)["work"] == pytest.approx(0, abs=1e-9)
    area = {frame["t"]: frame["area"] for frame in found["frames"]}
    assert area[0.5] == pytest.approx(area[0.0] / 2)
    turned = report("figure-9-default")
    assert contour(turned)["motion_because"].startswith("B is A turned")
    assert len({round(frame["area"]) for frame in turned["frames"]}) == 1


def test_the_inner_corner_of_figure_10_stays(report):
    assert np.ptp(np.abs(moving(contour(report("figure-10")), 3))) == 0


def test_figure_11_deviates_as_table_1_says_and_its_high_part_keeps_its_shape(report):
    found = contour(report("figure-11"))
    assert found["diagonal_deviation"] == PRESETS["fig11"]["band"]
    corners = [found["vertices_a"].index(corner) for corner in ([20, 20], [140, 20])]
    left, right = (moving(found, k) for k in corners)
    assert right - left == pytest.approx(120)


def test_two_angles_of_figure_12_reach_zero(report):
    assert contour(report("figure-12"))["zero_angles"] == 2


@pytest.mark.parametrize("number", [4, 6])
def test_angles_of_figure_13_exceed_130_degrees_on_the_way(report, number):
    found = contour(report("figure-13"))
    before, at, after = (moving(found, k % 7) for k in (number - 1, number, number + 1))
    degrees = np.degrees(np.abs(np.angle((before - at) / (after - at))))
    assert degrees[[0, -1]] == pytest.approx([90, 90])
    assert degrees.max() > 130


def test_pins_of_figure_26_change_the_left_step_alone(report):
    free, pinned = (contour(report(name))["dots"] for name in ("figure-26-constants", "figure-26"))
    half = len(free) // 2
    assert free[:half] != pinned[:half]
    assert free[half + 1 :] == pinned[half + 1 :]


@pytest.mark.parametrize(
    "row", re.findall(r"^\| `(--ks .*)` \| (.*) \| (.*) \| (.*) \| (.*) \|$", TEXT, re.M)
)
def test_work_of_figures_23_and_24_is_what_the_page_says(report, row):
    options, *works = row
    for name, paper, told in zip(("figure-23", "figure-24"), works[::2], works[1::2], strict=True):
        work = contour(report(name, *options.split()))["work"]
        assert f"{work:.3f}" == told
        assert f"{work:.2f}" == paper


def test_the_table_of_works_was_seen():
    assert len(re.findall(r"^\| `--ks", TEXT, re.MULTILINE)) == 2


def test_the_fourth_dot_of_figure_25_is_that_of_the_paper(report):
    assert contour(report("figure-25-blend"))["dots"][3] == [2, 3]


def test_figure_27_crosses_nothing(report):
    found = report("figure-27")
    assert f"as far as {contour(found)['diagonal_deviation']:.3f}" in " ".join(TEXT.split())
    assert not any(frame["self_crossings"] for frame in found["frames"])


def test_antlers_of_figure_27_cross_without_a_zero_angle_and_by_default_they_do_not(report):
    found = report("figure-27-antlers")
    start = [contour(found)[f"vertices_{side}"][k] for side, k in zip("ab", (16, 155), strict=True)]
    assert start == [[30, 62], [172, 10]]
    assert contour(found)["zero_angles"] == 0
    assert any(frame["self_crossings"] for frame in found["frames"])
    assert not any(frame["self_crossings"] for frame in report("figure-27-antlers-default")["frames"])


def test_the_arm_of_figure_28_is_shortest_half_way_and_by_default_it_is_not(report):
    found = contour(report("figure-28"))
    shoulder, hand = (moving(found, found["vertices_a"].index(at)) for at in ([218, 120], [282, 218]))
    length = np.abs(hand - shoulder)
    assert length.argmin() == 3
    assert length.min() < 0.7 * length[0]
    assert contour(report("figure-28-default"))["motion"] == "intrinsic"
