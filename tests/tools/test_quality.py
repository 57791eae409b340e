"""The scores of docs/quality.md on shapes with known answers, and the run without node."""

import json
import shutil

import numpy as np
import pytest
from PIL import Image
from shapely import Point

from tools.quality import __main__ as quality
from tools.quality import crossings, data, motions, npm, raw, sizes, tables, times, worst
from tools.quality.data import Pair, icon_pairs, polygon, subpaths
from tools.quality.faces import section as faces
from tools.quality.judge import pairs as judge_icons
from tools.quality.morphs import packages
from tools.quality.motions import Choice, choice
from tools.quality.peers import ALL, Tool, arc_length, flubber, kute, node, polymorph, shapeblend
from tools.quality.scores import STEPS, Score, area, area_share, inside, is_crossed, is_overlapping, score
from tools.quality.truth import letters

SQUARE = np.array([0, 10, 10 + 10j, 10j])
BOW_TIE = SQUARE[[0, 2, 1, 3]]
TOUCHING = np.array([0, 10, 10 + 10j, 5, 10j])  # a vertex on the opposite side
POINT = np.full(4, 5 + 5j)


def frames(*contours):
    """The same contours at all times."""
    return [list(contours)] * (STEPS + 1)


CONTOURS = {
    "square": (SQUARE, False),
    "square, the other way round": (SQUARE[::-1], False),
    "square with repeated vertices": (np.repeat(SQUARE, 3), False),
    "square with two vertices nearly the same": (np.append(SQUARE, SQUARE[0] + 1e-7), False),
    "bow tie": (BOW_TIE, True),
    "a vertex touches a side": (TOUCHING, True),
    "a spike without width": (np.array([0, 10, 10 + 10j, 10, 20]), True),
    "point": (POINT, False),
    "line": (np.array([0, 10]), False),
}


@pytest.mark.parametrize(("contour", "crossed"), CONTOURS.values(), ids=CONTOURS)
def test_crossed(contour, crossed):
    assert is_crossed(contour) is crossed


def test_a_frame_is_crossed_if_one_of_its_contours_is_and_overlapping_if_they_cross_each_other():
    assert not score(frames(SQUARE, SQUARE + 50), (2, 2)).crossed
    assert score(frames(SQUARE, BOW_TIE + 50), (2, 2)).crossed
    found = score(frames(SQUARE, SQUARE + 5 + 5j), (2, 2))
    assert (found.crossed, found.overlapping) == (False, True)


OTHERS = {
    "none": ([], False),
    "apart": ([SQUARE + 20], False),
    "inside": ([SQUARE / 2 + 1], False),
    "the same": ([SQUARE], False),
    "side by side": ([SQUARE + 10], False),
    "sharing a part of a side": ([SQUARE + 10 + 5j], False),
    "inside, sharing two sides": ([SQUARE / 2], False),
    "off by less than files are precise": ([SQUARE + 9.995], False),
    "a little": ([SQUARE + 9.9], True),
    "the other way round": ([SQUARE[::-1] + 5], True),
    "two others": ([SQUARE + 50, SQUARE + 55], True),
    "a bow tie": ([BOW_TIE + 5], True),
    "a bow tie inside": ([BOW_TIE / 4 + 3], False),
    "point": ([POINT], False),
    "line": ([np.array([-5 + 5j, 15 + 5j])], False),
}


@pytest.mark.parametrize(("others", "overlapping"), OTHERS.values(), ids=OTHERS)
def test_overlapping(others, overlapping):
    assert is_overlapping([SQUARE, *others]) is overlapping


def test_only_in_betweens_count():
    both_ends = [[BOW_TIE], *frames(SQUARE)[1:-1], [BOW_TIE]]
    assert not score(both_ends, (1, 1)).crossed
    one = frames(SQUARE)
    one[7] = [BOW_TIE]
    assert score(one, (1, 1)).crossed
    both = [SQUARE, SQUARE + 5]
    assert not score([both, *frames(SQUARE)[1:-1], both], (2, 2)).overlapping
    one[7] = both
    assert score(one, (2, 2)).overlapping


def scaled(size):
    """Frames of a square whose size is a function of time."""
    return [[SQUARE * size(k / STEPS)] for k in range(STEPS + 1)]


def test_area_share_is_beside_the_straight_line_between_the_ends():
    assert area_share(scaled(lambda t: abs(1 - 2 * t))) == 0.0
    assert area_share(scaled(lambda t: 1 if t in (0, 1) else 0.8)) == pytest.approx(0.64)
    # Areas 100 and 400: at t = .5 a square of side 15 has 225, and 250 lies on the line.
    expected = min((10 * (1 + t)) ** 2 / (100 + 300 * t) for t in np.arange(1, STEPS) / STEPS)
    assert area_share(scaled(lambda t: 1 + t)) == pytest.approx(expected)


def test_areas_of_contours_add_up_whichever_way_round():
    assert area(SQUARE) == area(SQUARE[::-1]) == 100.0
    grown = [[SQUARE, SQUARE[::-1] * (k / STEPS) ** 0.5] for k in range(STEPS + 1)]
    assert area_share(grown) == pytest.approx(1.0)


def test_a_contour_that_grows_from_a_point_is_neither_crossed_nor_left_out():
    growing = [[SQUARE, 50 + 5 * (SQUARE - 5 - 5j) * k / STEPS] for k in range(STEPS + 1)]
    found = score(growing, (1, 2))
    assert not found.crossed
    assert not found.left_out


def test_contours_that_are_left_out_are_noticed_at_either_end():
    assert score(frames(SQUARE), (2, 1)).left_out
    assert score(frames(SQUARE), (1, 2)).left_out
    assert score(frames(SQUARE, POINT), (2, 1)).left_out
    assert not score(frames(SQUARE), (1, 1)).left_out


def test_polygon_follows_lines_and_curves():
    assert polygon("M0,0 L10,0 L10,10 L0,10 Z").tolist() == SQUARE.tolist()
    assert polygon("M0.5,-1 L10,0 L0.5,-1 Z").tolist() == [0.5 - 1j, 10]
    k = 0.5522847498
    circle = polygon(f"M1,0 C1,{k} {k},1 0,1 C-{k},1 -1,{k} -1,0 C-1,-{k} -{k},-1 0,-1 C{k},-1 1,-{k} 1,0 Z")
    assert len(circle) == 4 * data.CHORDS
    np.testing.assert_allclose(np.abs(circle), 1.0, atol=3e-4)


FLAG = "M0,0 L10,0 C10,5 5,10 0,10 Q-2,5 0,2 Z"


def test_path_data_is_counted_turned_and_cut_without_another_outline():
    assert data.pieces(FLAG) == data.pieces("M0 0L10 0C10 5 5 10 0 10 Q-2 5 0 2L0 0Z") == 4
    assert data.pieces("M0,0C0,5 1e-5,10 5,10 9,10 5,5 0,0") == 2
    assert data.pieces(f"{FLAG} {FLAG}") == 8
    assert data.open_data("M0,0 L10,0 L5,5 Z").count("L") == 3
    assert "Z" not in data.open_data(FLAG)
    both = data.one_way_round(f"{FLAG} M0,0 L0,10 L10,10 Z")
    there, back = subpaths(both)
    assert there == FLAG
    assert polygon(back).tolist() == [0, 10 + 10j, 10j]
    assert data.one_way_round(both) == both
    turned = data.one_way_round("M0,0 L0,2 Q-2,5 0,10 C5,10 10,5 10,0 Z")
    np.testing.assert_allclose(polygon(turned), polygon(FLAG), atol=1e-5)


@pytest.mark.parametrize("share", [0, 1])
def test_lines_and_curves_are_cut_where_they_run(share):
    cut = data.cut_in_two(FLAG, share, np.random.default_rng(1))
    assert data.pieces(cut) == 4 * (1 + share)
    off = [inside(polygon(cut)).boundary.distance(Point(z.real, z.imag)) for z in polygon(FLAG)]
    assert max(off) < 0.02
    assert area(polygon(cut)) == pytest.approx(area(polygon(FLAG)), rel=2e-3)


def test_libraries_get_what_they_can_take():
    pair = Pair("", "M0,0 L0,1 L1,1 Z M0,0 L20,0 L20,20 Z M50,0 L60,0 L60,10 Z", "M0,0 L9,0 L9,9 L0,9 Z")
    (a,), (b,) = (kute.FINE.job(pair)[side] for side in "ab")
    assert (area(polygon(a)), area(polygon(b))) == (200.0, 81.0)
    assert kute.FINE.job(pair)["side"] == pytest.approx((40 + 800**0.5) / node.VERTICES)
    assert [job["side"] for job in (kute.OF_CURVES.job(pair), flubber.OWN.job(pair))] == [None, None]
    assert len(flubber.FINE.job(pair)["a"]) == 3
    assert len(subpaths(polymorph.FINE.job(pair)["a"])) == 3
    assert kute.OF_CURVES.job(pair)["b"] == [
        "M0.000000,0.000000 " + " ".join(f"L{z.real:.6f},{z.imag:.6f}" for z in (9, 9 + 9j, 9j, 0j))
    ]


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
    monkeypatch.setattr(node.Library, "path_data", lambda self, pairs, times: [None])
    assert flubber.FINE.links([None]) == flubber.FINE.blends([None]) == [None]


@pytest.mark.parametrize(("name", "pairs", "contours"), [("single", 80, (1, 1)), ("whole", 40, (2, 5))])
def test_sets_of_icons(name, pairs, contours):
    icons = icon_pairs(name)
    counts = [len(subpaths(side)) for pair in icons for side in (pair.a, pair.b)]
    assert len(icons) == pairs
    assert (min(counts), max(counts)) == contours
    # Every number is taken in: lines and curves end where the data says.
    assert all(np.isfinite(polygon(part)).all() for pair in icons for part in subpaths(pair.a))


def test_what_a_file_draws_is_read_whole():
    drawn = shapeblend.drawn(
        """<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100">
        <path d="M0 0H10V10H0Z M50 50H60V60H50Z"/><circle cx="50" cy="20" r="10"/></svg>"""
    )
    assert [len(contour) for contour in drawn][:2] == [4, 4]
    assert drawn[0].tolist() == SQUARE.tolist()
    assert len(drawn[2]) >= shapeblend.FINE
    np.testing.assert_allclose(np.abs(drawn[2] - 50 - 20j), 10.0, atol=1e-2)


def test_shapeblend_gives_the_frames_of_its_files():
    (blend,) = shapeblend.blends([Pair("", "M0,0 L10,0 L10,10 L0,10 Z", "M20,0 L40,0 L40,20 L20,20 Z")])
    assert len(blend) == STEPS + 1
    areas = [area(contour) for (contour,) in blend]
    assert areas == pytest.approx([(10 + k) ** 2 for k in range(STEPS + 1)], rel=1e-3)
    share = pytest.approx(1.69 / 1.9, rel=1e-3)
    assert score(blend, (1, 1)) == Score(False, False, area_share=share, left_out=False)


def test_shapeblend_gives_the_motion_it_is_told():
    # The paper's step turned by a quarter: straight paths shrink it to half its area, where travel is free.
    step = np.array([0, 60, 60 + 20j, 20 + 20j, 20 + 60j, 60j])
    turned = step[0] + 1j * (step - step[0]) + 60
    sides = (f"M{'L'.join(f'{z.real:g},{z.imag:g}' for z in side)}Z" for side in (step, turned))
    pair = Pair("", *sides)
    files = {motion: shapeblend.frames(pair, motion, also=["--kt", "0"]) for motion in shapeblend.MOTIONS}
    shares = {motion: area_share(list(map(shapeblend.drawn, each))) for motion, each in files.items()}
    assert shares.pop("linear") == pytest.approx(0.5, abs=0.02)
    assert shares == {name: pytest.approx(1.0, abs=0.02) for name in ("rigid", "intrinsic", "safe")}
    assert area_share(shapeblend.blends([pair])[0]) == pytest.approx(1.0, abs=0.02)
    assert choice(shapeblend.report(pair)).motion == "rigid"


def test_shapeblend_failing_is_no_answer(capsys):
    nothing = Pair("", "", "M0,0 L10,0 L10,10 Z")
    assert shapeblend.blends([nothing]) == [None]
    assert shapeblend.animation(nothing) is None
    assert shapeblend.report(nothing) is None
    assert worst.judged(nothing, "linear") is None
    assert "a.svg" in capsys.readouterr().err


def test_arc_length_finds_start_and_direction():
    turned = np.roll(SQUARE, 1)[::-1] + 30
    for blend in (arc_length.frames([SQUARE], [turned]), arc_length.frames([turned], [SQUARE])):
        assert score(blend, (1, 1)) == Score(False, False, area_share=pytest.approx(1.0), left_out=False)
        assert area(blend[5][0]) == pytest.approx(100.0)


def test_arc_length_pairs_by_size_and_lets_the_rest_grow():
    blend = arc_length.frames([3 * SQUARE], [SQUARE + 50, 4 * SQUARE])
    assert [area(contour) for contour in blend[0]] == pytest.approx([900.0, 0.0])
    assert [area(contour) for contour in blend[-1]] == pytest.approx([1600.0, 100.0])
    np.testing.assert_allclose(blend[0][1], 55 + 5j)


def test_animated_holds_all_frames_and_rounding_keeps_points_apart():
    assert sizes.rounded("M1.23456,-0.0001L10,1e-7L-2.5000001,33.9999Z") == "M1.235,0L10,0L-2.5,34Z"
    text = sizes.animated(["M0,0L1,0L1,1Z", "M0,0L2,0L2,2Z"])
    assert 'values="M0,0L1,0L1,1Z;M0,0L2,0L2,2Z"' in text
    assert shapeblend.drawn(text.replace("<path>", '<path d="M0,0L2,0L2,2Z">'))


def icons(scores, tool="a tool"):
    """What `crossings.measured` gives for one set and one tool."""
    measured = {"pairs": [""] * len(scores), "scores": {tool: raw.columns(Score, scores)}}
    return {"single": measured, "whole": NOTHING}


NOTHING = {"pairs": [], "scores": {}}


def test_no_answer_counts_as_crossed_and_as_shrunk():
    good, bad = Score(False, False, 1.0, False), Score(True, False, 0.5, True)
    (row,) = crossings.section(icons([good, good, bad, None])).table.rows
    assert row == ["one contour", "a tool", "4", "3", "50 %", "25 %", "50 %", "100.0 %", "33.3 %"]
    (row,) = crossings.section(icons([None])).table.rows
    assert row == ["one contour", "a tool", "1", "0", "100 %", "100 %", "100 %", "–", "–"]


def test_the_short_table_has_no_further_rows_in_which_all_is_well():
    good, bad = Score(False, False, 1.0, False), Score(True, True, 0.5, False)
    section = crossings.section(icons([good, bad]))
    assert dict(section.brief)[crossings.LEFT_OUT] == {"a tool": "0 %"}
    table = tables.short([section], ["a tool"], [])
    assert f"| {crossings.OVERLAPPING} | 50 % |" in table
    assert f"| {crossings.LITTLE_AREA} | 50 % |" in table
    assert crossings.LEFT_OUT not in table
    assert [tool.name for tool in ALL if tool.brief and "shapeblend" in tool.name] == [shapeblend.NAME]


def test_choices_are_counted_with_the_median_of_what_is_wrong():
    contour = {
        "motion": "rigid",
        "candidates": [{"name": "linear", "wrong": 0.5}, {"name": "rigid", "wrong": 0.25}],
    }
    assert choice({"pairs": [{"contours": [contour]}]}) == Choice("rigid", 0.25)
    assert choice({"pairs": [{"contours": [{**contour, "candidates": []}]}]}) == Choice("rigid", 0.0)
    twice = [Choice("rigid", 0.1), None, Choice("rigid", 0.3)]
    chosen = {"single": twice, "whole": [Choice("linear", 0.05)]}
    table = motions.section({name: raw.columns(Choice, found) for name, found in chosen.items()}).table
    assert table.header[1::2] == ["one contour, 2 pairs", "two to five contours, 1 pairs"]
    assert table.rows[0] == ["linear", "0", "", "1", "0.050"]
    assert table.rows[1] == ["rigid", "2", "0.200", "0", ""]


def test_the_sheet_of_the_worst_has_both_motions_of_each(monkeypatch, tmp_path, capsys):
    pairs = icon_pairs("single")[:3]
    monkeypatch.setattr(worst, "icon_pairs", lambda name: pairs if name == "single" else [])
    monkeypatch.setattr(worst, "ROOT", tmp_path)
    monkeypatch.setattr(worst, "SHEET", tmp_path / "out" / "worst.png")
    monkeypatch.setattr(worst, "PAIRS", 2)
    drawn = []
    monkeypatch.setattr(worst, "sheet", lambda svgs, *size: drawn.extend(svgs) or Image.new("L", (1, 1)))
    worst.main()
    assert len(drawn) == 2 * 2 * (STEPS + 1)
    ranks = sorted((worst.judged(pair, "linear").rank, pair.id) for pair in pairs)
    told = capsys.readouterr().out.splitlines()
    assert [line.split()[1] for line in told[:2]] == [name for _, name in ranks[:2]]
    assert told[2] == "out/worst.png"


def test_figures_are_replaced_and_nothing_else():
    section = tables.Section("T", "text", tables.Table(["a"], [["1"]]), [("what", {"x": "7 %"})])
    figures = tables.short([section], ["x", "y"], ["z (not there)"])
    assert "| what | 7 % | – |" in figures
    assert "Not measured: z (not there)." in figures
    text = tables.with_figures(f"before\n{tables.BEGIN}\nold\n{tables.END}\nafter\n", figures)
    assert text == f"before\n{figures}\nafter\n"
    assert tables.with_figures(text, figures) == text
    with pytest.raises(ValueError, match="no place for figures"):
        tables.with_figures("before", figures)


def test_without_node_the_rest_is_measured_and_the_document_says_so(monkeypatch, tmp_path, capsys):
    for module in (node, letters, packages, faces, judge_icons):
        monkeypatch.setattr(module, "install", lambda *what: "node and npm are not there")
    small = {name: sorted(icon_pairs(name), key=lambda pair: len(pair.a + pair.b)) for name in data.SETS}
    few = {"single": small["single"][:2], "whole": small["whole"][:1]}
    others = {shapeblend.named(motion) for motion in ("rigid", "intrinsic", "safe")}
    monkeypatch.setattr(quality, "ALL", [tool for tool in ALL if tool.name not in others])
    for module in (crossings, motions, sizes):
        monkeypatch.setattr(module, "icon_pairs", few.get)
    monkeypatch.setattr(quality, "ROOT", tmp_path)
    (tmp_path / "docs").mkdir()
    (tmp_path / "README.md").write_text(f"x\n{tables.BEGIN}{tables.END}\n", encoding="utf-8")

    def files():
        quality.main([])
        return [(tmp_path / name).read_text(encoding="utf-8") for name in ("README.md", "docs/quality.md")]

    readme, document = once = files()
    assert f"Not measured: {flubber.NAME} (node and npm are not there)." in document
    assert "Not measured: letters (node and npm are not there)." in document
    assert "Not measured: faces (node and npm are not there)." in document
    assert "Not measured: judge (node and npm are not there)." in document
    assert "Not measured: limbs and morphs (node and npm are not there)." in document
    assert f"| {flubber.NAME}" not in document
    assert "| one contour | shapeblend | 2 | 2 |" in document
    assert "| one contour | shapeblend --motion linear | 2 | 2 |" in document
    assert f"Not measured: {flubber.NAME} (node and npm are not there)." in readme
    assert f"| {flubber.NAME}" not in readme
    assert "| Icons that cross themselves on the way |" in readme
    assert files() == once
    monkeypatch.setattr(crossings, "measured", None)
    quality.main(["--only", "motions"])
    assert (tmp_path / "docs" / "quality.md").read_text(encoding="utf-8") == document
    monkeypatch.setattr(quality, "measured", None)
    quality.main(["--again"])
    assert (tmp_path / "docs" / "quality.md").read_text(encoding="utf-8") == document


def test_a_measure_takes_any_tool(monkeypatch):
    monkeypatch.setattr(crossings, "icon_pairs", lambda name: [Pair("one", "M0,0 Z", "M0,0 Z")])
    tools = [Tool("none", lambda pairs: [None]), Tool("bow", lambda pairs: [frames(BOW_TIE)])]
    found = crossings.measured(tools)["single"]
    assert found["pairs"] == ["one"]
    assert found["scores"]["none"]["crossed"] == [None]
    assert found["scores"]["bow"]["crossed"] == [1]


def test_scores_come_back_from_their_columns():
    scores = [Score(True, False, 0.123456789, False), None, Score(False, True, np.float64(1.0), True)]
    found = json.loads(raw.text({"one": raw.columns(Score, scores), "two": {"three": []}}))
    assert raw.records(Score, found["one"]) == [Score(1, 0, 0.12346, 0), None, Score(0, 1, 1.0, 1)]
    assert raw.text({"a": [1, None], "b": {}}) == '{\n "a": [1,null],\n "b": {\n }\n}'


def test_times_are_told_as_multiples():
    ours, theirs = [1.0, 2.0, 9.0], [0.5, 0.5, 3.0]
    alone = {shapeblend.NAME: {"wall": ours, "cpu": ours}, flubber.NAME: {"wall": theirs, "cpu": theirs}}
    bulk = {
        shapeblend.NAME: {"wall": [4.8], "cpu": [3.99]},
        flubber.NAME: {"wall": [0.4], "cpu": [0.41]},
        arc_length.NAME: {"wall": [0.05], "cpu": [0.05]},
    }
    found = {"pairs": ["a", "b", "c"], "alone": alone, "many": 40, "bulk": bulk}
    section = times.section({"single": found, "whole": found})
    assert section.table.rows[0] == [
        *("one contour", shapeblend.NAME),
        *("3", "2.00 s", "2.00 s"),
        *("40", "0.12 s", "0.10 s"),
    ]
    assert section.table.rows[1][-2:] == ["10 ms", "10 ms"]
    assert section.table.rows[2] == ["one contour", arc_length.NAME, *"–––", "40", "1.2 ms", "1.2 ms"]
    assert dict(section.brief) == {
        times.ALONE: {shapeblend.NAME: "about 3", flubber.NAME: "1"},
        times.IN_BULK: {shapeblend.NAME: "about 10", flubber.NAME: "1", arc_length.NAME: "about 0.1"},
    }


def test_segments_of_a_file_count_the_closing_lines():
    assert shapeblend.segments(data.svg("M0,0 L10,0 L10,10 Z M20,20 L30,20 L30,30 L20,20 Z")) == 6
    assert shapeblend.segments(shapeblend.middle(Pair("", "M0,0 H10 V10 Z", "M0,0 H20 V20 Z"))) == 3
    counts = sizes.segments([Pair("", "M0,0 L10,0 L10,10 Z", "M0,0 L20,0 L20,20 Z")], [])
    assert counts == {shapeblend.NAME: [3], arc_length.NAME: [arc_length.VERTICES]}


def test_npm_is_not_asked_where_it_is_not(monkeypatch, tmp_path):
    monkeypatch.setattr(shutil, "which", lambda name: None)
    assert npm.install.__wrapped__(node.HERE, tmp_path / "out") == "node and npm are not there"
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("folder", [node.HERE, letters.HERE, packages.HERE], ids=lambda folder: folder.name)
def test_what_npm_installs_is_locked_by_its_contents_alone(folder):
    lock = json.loads((folder / "package-lock.json").read_text(encoding="utf-8"))
    asked = json.loads((folder / "package.json").read_text(encoding="utf-8"))["dependencies"]
    packages = {name: package for name, package in lock["packages"].items() if name}
    assert {name: packages[f"node_modules/{name}"]["version"] for name in asked} == asked
    assert all("integrity" in package and "resolved" not in package for package in packages.values())
