"""The scores of docs/quality.md on shapes with known answers, what other tools get, and how figures are written."""

import json
import shutil

import numpy as np
import pytest
from shapely import Point

from tools.quality import __main__ as quality
from tools.quality import crossings, data, npm, raw, tables, times
from tools.quality.data import Pair, polygon, subpaths
from tools.quality.faces import section as faces
from tools.quality.peers import Tool, arc_length, flubber, kute, node, polymorph, shapeblend
from tools.quality.scores import STEPS, Score, area, area_share, inside, is_crossed, is_overlapping, score

SQUARE = np.array([0, 10, 10 + 10j, 10j])
BOW_TIE = SQUARE[[0, 2, 1, 3]]
POINT = np.full(4, 5 + 5j)


def frames(*contours):
    """The same contours at all times."""
    return [list(contours)] * (STEPS + 1)


CONTOURS = {
    "square": (SQUARE, False),
    "square with two vertices nearly the same": (np.append(SQUARE, SQUARE[0] + 1e-7), False),
    "bow tie": (BOW_TIE, True),
    "a vertex touches a side": (np.array([0, 10, 10 + 10j, 5, 10j]), True),
    "a spike without width": (np.array([0, 10, 10 + 10j, 10, 20]), True),
    "point": (POINT, False),
    "line": (np.array([0, 10]), False),
}


@pytest.mark.parametrize(("contour", "crossed"), CONTOURS.values(), ids=CONTOURS)
def test_crossed(contour, crossed):
    assert is_crossed(contour) is crossed


OTHERS = {
    "apart": ([SQUARE + 20], False),
    "inside, sharing two sides": ([SQUARE / 2], False),
    "sharing a part of a side": ([SQUARE + 10 + 5j], False),
    "off by less than files are precise": ([SQUARE + 9.995], False),
    "a little": ([SQUARE + 9.9], True),
    "the other way round": ([SQUARE[::-1] + 5], True),
    "two others": ([SQUARE + 50, SQUARE + 55], True),
    "a bow tie inside": ([BOW_TIE / 4 + 3], False),
    "point": ([POINT], False),
}


@pytest.mark.parametrize(("others", "overlapping"), OTHERS.values(), ids=OTHERS)
def test_overlapping(others, overlapping):
    assert is_overlapping([SQUARE, *others]) is overlapping


def test_only_in_betweens_count():
    for wrong, field in ([BOW_TIE], "crossed"), ([SQUARE, SQUARE + 5], "overlapping"):
        both_ends = [wrong, *frames(SQUARE)[1:-1], wrong]
        assert not getattr(score(both_ends, (1, 1)), field)
        one = frames(SQUARE)
        one[7] = wrong
        assert getattr(score(one, (1, 1)), field)


def test_area_share_is_beside_the_straight_line_between_the_ends():
    def scaled(size):
        return [[SQUARE * size(k / STEPS)] for k in range(STEPS + 1)]

    assert area_share(scaled(lambda t: abs(1 - 2 * t))) == 0.0
    # Areas 100 and 400: at t = .5 a square of side 15 has 225, and 250 lies on the line.
    expected = min((10 * (1 + t)) ** 2 / (100 + 300 * t) for t in np.arange(1, STEPS) / STEPS)
    assert area_share(scaled(lambda t: 1 + t)) == pytest.approx(expected)
    grown = [[SQUARE, SQUARE[::-1] * (k / STEPS) ** 0.5] for k in range(STEPS + 1)]
    assert area_share(grown) == pytest.approx(1.0)


def test_contours_that_are_left_out_are_noticed_at_either_end_unless_they_grow_from_a_point():
    assert score(frames(SQUARE), (2, 1)).left_out
    assert score(frames(SQUARE, POINT), (1, 2)).left_out
    growing = [[SQUARE, 50 + 5 * (SQUARE - 5 - 5j) * k / STEPS] for k in range(STEPS + 1)]
    assert not score(growing, (1, 2)).left_out


def test_no_answer_counts_as_crossed_and_as_shrunk():
    good, bad = Score(False, False, 1.0, False), Score(True, False, 0.5, True)
    scores = {"pairs": [""] * 4, "scores": {"a tool": raw.columns(Score, [good, good, bad, None])}}
    section = crossings.section({"single": scores, "whole": {"pairs": [], "scores": {}}})
    (row,) = section.table.rows
    assert row == ["one contour", "a tool", "4", "3", "50 %", "25 %", "50 %", "100.0 %", "33.3 %"]
    assert section.brief[0].cells == {"a tool": "50 %"}


FLAG = "M0,0 L10,0 C10,5 5,10 0,10 Q-2,5 0,2 Z"


def test_path_data_is_read_counted_turned_and_cut_without_another_outline():
    assert data.pieces(FLAG) == data.pieces("M0 0L10 0C10 5 5 10 0 10 Q-2 5 0 2L0 0Z") == 4
    assert data.pieces("M0,0C0,5 1e-5,10 5,10 9,10 5,5 0,0") == 2
    assert "Z" not in data.open_data(FLAG)
    there, back = subpaths(data.one_way_round(f"{FLAG} M0,0 L0,10 L10,10 Z"))
    assert there == FLAG
    assert polygon(back).tolist() == [0, 10 + 10j, 10j]
    cut = data.cut_in_two(FLAG, 1.0, np.random.default_rng(1))
    assert data.pieces(cut) == 8
    assert max(inside(polygon(cut)).boundary.distance(Point(z.real, z.imag)) for z in polygon(FLAG)) < 0.02
    assert area(polygon(cut)) == pytest.approx(area(polygon(FLAG)), rel=2e-3)


def test_libraries_get_what_they_can_take():
    pair = Pair("", "M0,0 L0,1 L1,1 Z M0,0 L20,0 L20,20 Z M50,0 L60,0 L60,10 Z", "M0,0 L9,0 L9,9 L0,9 Z")
    (a,), (b,) = (kute.FINE.job(pair)[side] for side in "ab")
    assert (area(polygon(a)), area(polygon(b))) == (200.0, 81.0)
    assert kute.FINE.job(pair)["side"] == pytest.approx((40 + 800**0.5) / node.VERTICES)
    assert len(flubber.FINE.job(pair)["a"]) == 3
    assert len(subpaths(polymorph.FINE.job(pair)["a"])) == 3


def test_what_goes_where_is_told_by_frames_on_the_way(monkeypatch):
    triangle = [
        "M0 0 C 0 0 4 0 4 0 4 0 4 4 4 4 4 4 0 0 0 0",
        "M8 0 C 8 0 12 0 12 0 12 0 12 4 12 4 12 4 8 0 8 0",
    ]
    monkeypatch.setattr(node.Library, "path_data", lambda self, pairs, times: [triangle, None])
    ((p, q),), nothing = polymorph.FINE.links([None, None])
    assert nothing is None
    assert p[[0, -1]].tolist() == [-4, -4]
    assert (q - p).tolist() == [16] * len(p)


def test_shapeblend_gives_the_frames_of_its_files_or_no_answer(capsys):
    square = "M0,0 L10,0 L10,10 L0,10 Z"
    pairs = [Pair("", square, "M20,0 L40,0 L40,20 L20,20 Z"), Pair("", "", square)]
    blend, nothing = shapeblend.blends(pairs)
    assert [area(contour) for (contour,) in blend] == pytest.approx(
        [(10 + k) ** 2 for k in range(STEPS + 1)], rel=1e-3
    )
    assert nothing is None
    assert "a.svg" in capsys.readouterr().err


def test_arc_length_finds_start_and_direction_pairs_by_size_and_lets_the_rest_grow():
    turned = np.roll(SQUARE, 1)[::-1] + 30
    blend = arc_length.frames([SQUARE], [turned])
    assert score(blend, (1, 1)) == Score(False, False, area_share=pytest.approx(1.0), left_out=False)
    blend = arc_length.frames([3 * SQUARE], [SQUARE + 50, 4 * SQUARE])
    assert [area(contour) for contour in blend[0]] == pytest.approx([900.0, 0.0])
    assert [area(contour) for contour in blend[-1]] == pytest.approx([1600.0, 100.0])


def test_the_short_table_has_no_further_rows_in_which_all_is_well():
    brief = [
        tables.Brief(name, {"x": cell}) for name, cell in (("a", "7 %"), ("... b", "0 %"), ("... c", "1 %"))
    ]
    section = tables.Section("T", "text", tables.Table(["a"], [["1"]]), brief)
    assert [line for line in tables.short([section], ["x", "y"]).splitlines() if "%" in line] == [
        "| a | 7 % | – |",
        "| ... c | 1 % | – |",
    ]


def test_figures_are_replaced_and_nothing_else():
    text = tables.with_figures(f"before\n{tables.BEGIN}\nold\n{tables.END}\nafter\n", "new")
    assert text == "before\nnew\nafter\n"
    with pytest.raises(ValueError, match="no place for figures"):
        tables.with_figures("before", "new")


def test_one_section_is_measured_the_others_stay_and_documents_are_made(monkeypatch, tmp_path):
    kept = json.loads((quality.ROOT / quality.RAW).read_text("utf-8"))
    (tmp_path / "docs").mkdir()
    (tmp_path / quality.RAW).write_text(raw.text(kept), "utf-8")
    (tmp_path / "README.md").write_text(f"x\n{tables.BEGIN}{tables.END}\n", "utf-8")
    monkeypatch.setattr(quality, "ROOT", tmp_path)
    monkeypatch.setattr(quality, "ready", lambda: None)
    monkeypatch.setattr(crossings, "icon_pairs", lambda name: [Pair("one", "M0,0 Z", "M0,0 Z")])
    tools = [Tool(name, lambda pairs: [frames(BOW_TIE)], None, True) for name in kept["times"]["alone"]]
    monkeypatch.setattr(quality, "ALL", tools)
    quality.main(["icons"])
    again = json.loads((tmp_path / quality.RAW).read_text("utf-8"))
    assert again["icons"]["single"]["scores"][shapeblend.NAME]["crossed"] == [1]
    assert {name: again[name] for name in again if name != "icons"} == {
        name: kept[name] for name in kept if name != "icons"
    }
    assert "| Icons that cross themselves on the way | 100 % |" in (tmp_path / "README.md").read_text("utf-8")
    monkeypatch.setattr(quality, "ready", lambda: "node and npm are not there")
    with pytest.raises(SystemExit, match="nothing was measured: node and npm are not there"):
        quality.main([])


def test_scores_come_back_from_their_columns():
    scores = [Score(True, False, 0.123456789, False), None, Score(False, True, np.float64(1.0), True)]
    found = json.loads(raw.text({"one": raw.columns(Score, scores), "two": {"three": []}}))
    assert raw.records(Score, found["one"]) == [Score(1, 0, 0.12346, 0), None, Score(0, 1, 1.0, 1)]


def test_times_are_told_as_multiples():
    alone = {shapeblend.NAME: [1.0, 2.0, 9.0], flubber.NAME: [0.5, 0.5, 3.0]}
    many = {shapeblend.NAME: 3.99, flubber.NAME: 0.41}
    section = times.section({"pairs": 40, "alone": alone, "many": many})
    assert section.table.rows[0] == [shapeblend.NAME, "2000.0 ms", "99.8 ms"]
    assert [brief.cells[shapeblend.NAME] for brief in section.brief] == ["about 3", "about 10"]


def test_eyes_and_mouths_that_become_what_they_should_are_counted(monkeypatch):
    monkeypatch.setattr(faces, "PAIRS", [("grinning-face", "crying-face"), ("crying-face", "sleepy-face")])
    right = dict(zip(faces.FACES["grinning-face"], faces.FACES["crying-face"], strict=True))
    monkeypatch.setattr(faces, "become", lambda a, b: right)
    found = faces.measured()
    assert faces.section(found).table.rows == [["2", "2 of 4", "1 of 2", "1 of 2"]]
    assert faces.wrong(found) == ["crying-face sleepy-face: 0 eyes, 0 mouths"]


def test_npm_is_not_asked_where_it_is_not(monkeypatch, tmp_path):
    monkeypatch.setattr(shutil, "which", lambda name: None)
    assert npm.install.__wrapped__(target=tmp_path / "out") == "node and npm are not there"
    assert not (tmp_path / "out").exists()


def test_what_npm_installs_is_locked_by_its_contents_alone():
    lock = json.loads((npm.PACKAGES / "package-lock.json").read_text(encoding="utf-8"))
    asked = json.loads((npm.PACKAGES / "package.json").read_text(encoding="utf-8"))["dependencies"]
    packages = {name: package for name, package in lock["packages"].items() if name}
    assert {name: packages[f"node_modules/{name}"]["version"] for name in asked} == asked
    assert all("integrity" in package and "resolved" not in package for package in packages.values())


def test_strokes_count_as_the_outlines_of_what_they_paint_together():
    line = '<path d="M{}" fill="none" stroke="#000" stroke-width="2" stroke-linecap="{}"/>'

    def svg_of(*lines):
        return f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 10 10">{"".join(lines)}</svg>'

    cross = svg_of(line.format("0,5L10,5", "butt") + line.format("5,0V10", "butt"))
    (contour,) = shapeblend.painted(cross)
    assert not is_crossed(contour)
    assert area(contour) == pytest.approx(36.0)
    ring = svg_of(line.format("0,0H10V10H0Z", "round"))
    assert sorted(map(area, shapeblend.painted(ring))) == pytest.approx([64.0, 144.0])
