"""What a page contains, and that nothing in it can do harm."""

import base64
import hashlib
import json
import re
import zlib
from collections import defaultdict
from html.parser import HTMLParser
from pathlib import Path

import numpy as np
import pytest

from shapeblend_cli.cli import run
from shapeblend_cli.frames.frames import frame_at
from shapeblend_cli.geometry import cubics
from shapeblend_cli.interpolate.paths import paths_at, waypoints
from shapeblend_cli.matching.landscape import landscape
from shapeblend_cli.options.settings import Settings
from shapeblend_cli.pipeline import match_all
from shapeblend_cli.preview import graphs as graphs_module
from shapeblend_cli.preview.graphs import graphs
from shapeblend_cli.preview.pictures import dot_positions, picture
from shapeblend_cli.wires.match import solved_wires
from tests.support.drawings import BAR, EIGHT, EYED, LEAF, RING, SQUARES, B, drawing, svg
from tests.support.images import face, image
from tests.support.motions import blend, rotated

LINES = '<path id="{}" d="M2 2L22 20" fill="none" stroke="#000"/>'


@pytest.fixture
def here(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for name, path in {"a": EYED, "b": LEAF, "c": B}.items():
        (tmp_path / f"{name}.svg").write_text(svg(path, attributes='fill-rule="evenodd" fill="#804000"'))
    return tmp_path


class Page(HTMLParser):
    """The elements of a page with their attributes, their texts by tag, and its data."""

    def __init__(self, text):
        super().__init__()
        self.text, self.open, self.found, self.texts = text, None, [], defaultdict(list)
        self.feed(text)
        self.data = json.loads(self.texts["script"][0])
        self.scenes = [json.loads(unpacked(pair["packed"])) for pair in self.data["pairs"]]

    def handle_starttag(self, tag, attributes):
        self.found.append((tag, dict(attributes)))
        self.open = tag
        self.texts[tag].append("")

    def handle_endtag(self, tag):
        self.open = None

    def handle_data(self, data):
        if self.open:
            self.texts[self.open][-1] += data


def unpacked(text):
    return zlib.decompress(base64.b64decode(text))


def previewed(*arguments, frames=("-n", "3")):
    assert run([*arguments, *frames, "-o", "frames", "-f", "-q", "--preview", "x.html"]) == 0
    return Page(Path("x.html").read_text(encoding="utf-8"))


def points_at(shape, t, decimals):
    """The numbers of a shape at a time, as the page finds them."""
    steps = np.array(shape["points"])
    keys = np.cumsum(np.cumsum(steps.reshape(len(steps), -1, 2), axis=0), axis=1) / 10.0**decimals
    return np.array([np.interp(t, shape["times"], column) for column in keys.reshape(len(keys), -1).T])


def numbers_of(outlines):
    """The same from the outlines of a frame."""
    found = []
    for outline in outlines:
        found.append(outline.segments[0, 0])
        for segment, is_line in zip(outline.segments, outline.straight, strict=True):
            found += list(segment[3:] if is_line else segment[1:])
    return np.stack([np.real(found), np.imag(found)], axis=1).ravel()


def picture_of(pair, times, decimals):
    ends = (frame_at(pair, 0.0, as_drawn=True), frame_at(pair, 1.0, as_drawn=True))
    return picture(pair, ends, times, decimals)


@pytest.mark.parametrize("is_turned", [False, True])
def test_between_its_keys_the_picture_is_that_of_the_frames(is_turned):
    (pair,), _ = match_all([drawing(B), drawing(EIGHT)], Settings(motion="linear"))
    pair = rotated(pair) if is_turned else pair
    own = (0.21, 0.64)
    for shape, moving in zip(picture_of(pair, own, 4)["shapes"], pair.shapes, strict=True):
        for t in (0.0, *own, 0.43, 1.0):
            off = np.abs(points_at(shape, t, 4) - numbers_of(paths_at(moving, t))).max()
            assert off < (24 * 2e-3 if is_turned and t == 0.43 else 1e-4)
        times = {0.0, 1.0, *(w.t for w in waypoints(moving)), *(own if is_turned else ())}
        assert set(shape["times"]) == times


def test_the_ends_are_what_frames_have_there(here):
    (scene,) = previewed("a.svg", "b.svg", "--ends").scenes
    for end, name in zip(scene["ends"], ("frame-1", "frame-5"), strict=True):
        frame = (here / "frames" / f"{name}.svg").read_text()
        assert [path["path"]["d"] for path in end] == re.findall(r' d="([^"]*)"', frame)
        assert all(f'fill="{path["path"]["fill"]}"' in frame for path in end)


@pytest.mark.parametrize("times", ["0.3", "-0.2,0.5,1.5"])
def test_the_ends_are_the_drawings_whatever_the_times_of_the_frames(here, times):
    scenes = [
        previewed("a.svg", "b.svg", frames=frames).scenes[0] for frames in (("-n", "1"), ("--times", times))
    ]
    assert scenes[0]["ends"] == scenes[1]["ends"]


def test_pictures_and_what_clips_shapes_are_there_once(here):
    photo = image(face(), 'id="p" x="2" y="4" width="8" height="6"')
    region = '<clipPath id="c"><circle cx="12" cy="12" r="{}"/></clipPath>'
    markup = region + '<g clip-path="url(#c)">' + photo + '<use href="#p" x="10"/><path d="M2 2H9V9H2Z"/></g>'
    for name, radius in (("a", 8), ("b", 5)):
        (here / f"{name}.svg").write_text(svg(markup.format(radius)))
    (scene,) = previewed("a.svg", "b.svg", "--ends").scenes
    (name,) = scene["images"]
    assert scene["images"][name].startswith("data:image/png;base64,")
    assert [shape["coats"][0].get("source") for shape in scene["shapes"]] == [name, name, None]
    assert [shape["clips"] for shape in scene["shapes"]] == [[0]] * 3
    (region,) = scene["regions"]
    assert (region["rule"], len(region["shapes"])) == ("nonzero", 1)
    for end in scene["ends"]:
        assert [path.get("source") for path in end] == [name, name, None]
        assert [len(path["clips"]) for path in end] == [1, 1, 1]


def test_paint_is_given_once_where_it_stays_and_at_even_times_where_it_changes():
    (pair,), _ = match_all([drawing(BAR, attributes='fill="#ff0000"'), drawing(LEAF)], Settings())
    (coat,) = picture_of(pair, (), 3)["shapes"][0]["coats"]
    assert coat["path"]["fill-opacity"] == ["1"]
    fills = coat["path"]["fill"]
    assert (len(fills), fills[0], fills[-1]) == (31, "#ff0000", "#000000")
    assert fills[15] == frame_at(pair, 0.5, as_drawn=True).shapes[0].style.fill


@pytest.mark.parametrize("curves", [False, True])
def test_dots_lie_on_the_outline_that_moves(curves):
    pair, _ = blend(drawing(EYED), drawing(LEAF), Settings(motion="linear", curves=curves))
    for contour in pair.contours:
        positions = dot_positions(contour)
        number = np.minimum(positions.astype(int), len(contour.start.segments) - 1)
        for path, vertices in zip((contour.start, contour.end), contour.dot_points(), strict=True):
            # Polygons are cut at their dots; curves near by.
            points = cubics.evaluate(path.segments[number], positions - number)
            np.testing.assert_allclose(points, vertices, rtol=0, atol=0.8 if curves else 1e-9)


def levels_of(graph):
    planes = np.frombuffer(unpacked(graph["works"]), np.uint8).astype(int).reshape(2, -1)
    steps = (planes[0] + 256 * planes[1]).reshape(graph["columns"], graph["rows"])
    return np.cumsum(steps, axis=1) % 65536


def graphs_of(a, b, **settings):
    """The contours of a pair, and their graphs."""
    settings = Settings(**settings)
    pair, _ = blend(drawing(*a), drawing(*b), settings)
    return pair.contours, graphs(pair.contours, settings)


@pytest.mark.parametrize("band", [None, 0.2])
def test_the_graph_is_the_landscape(band):
    (contour,), (graph,) = graphs_of([BAR], [LEAF], vertices=40, band=band)
    wires = solved_wires(contour, Settings(vertices=40, band=band))
    expected = landscape(wires, contour.correspondence.dots, band)
    levels = levels_of(graph)
    there = np.isfinite(expected.works)
    np.testing.assert_array_equal(levels <= graph["levels"], there)
    assert (there.mean() > 0.9) == (band is None)
    extra = graph["unit"] * graph["finest"] * np.expm1(levels / graph["levels"] * graph["top"])
    more = expected.works[there] - contour.correspondence.work
    np.testing.assert_allclose(extra[there], more, rtol=1e-3, atol=1e-5 * graph["unit"])
    for name in ("step", "before", "after"):
        assert unpacked(graph[name]) == getattr(expected, name).tobytes()


def test_where_nothing_costs_anything_there_is_a_graph_all_the_same():
    _, (graph,) = graphs_of([BAR], [BAR], vertices=20)
    assert levels_of(graph)[0, 0] == 0
    assert graph["unit"] > 0.0


def test_graphs_beyond_the_room_are_left_out_the_largest_kept(monkeypatch):
    drawings = [RING, BAR], [RING, LEAF]
    contours, _ = graphs_of(*drawings, vertices=40)
    dots = [len(c.polygon_a.vertices) * len(c.polygon_b.vertices) for c in contours]
    largest = max(range(len(dots)), key=lambda k: contours[k].scale_a)
    monkeypatch.setattr(graphs_module, "MOST_DOTS", dots[largest])
    _, found = graphs_of(*drawings, vertices=40)
    assert isinstance(found[largest], dict)
    assert {g if isinstance(g, str) else "graph" for g in found} == {"graph", "full"}
    monkeypatch.setattr(graphs_module, "MOST_DOTS", 100)
    assert graphs_of(*drawings, vertices=40)[1] == ["large"] * len(dots)


def test_what_grows_from_a_point_has_no_graph():
    contours, found = graphs_of([BAR], [SQUARES], vertices=20, unmatched="point")
    assert [g is None for g in found] == [c.a is None for c in contours]
    assert found.count(None) == 3


def test_numbers_are_those_of_the_report(here):
    page = previewed("a.svg", "b.svg", "c.svg", "--report", "r.json", "--preset", "fig27")
    report, data = json.loads((here / "r.json").read_text()), page.data
    for name in ("settings", "frames", "version"):
        assert data[name] == report[name]
    assert data["settings"]["preview"] == "x.html"
    assert set(report["seconds"]) <= set(data["seconds"])
    for pair, scene, told in zip(data["pairs"], page.scenes, report["pairs"], strict=True):
        for contour, one, long in zip(pair["contours"], told["contours"], scene["lists"], strict=True):
            assert {name: contour[name] for name in one if name in contour} == {
                name: value for name, value in one.items() if name not in ("vertices_a", "vertices_b", "dots")
            }
            assert long["dots"] == one["dots"]
            np.testing.assert_allclose(long["vertices_a"], one["vertices_a"], atol=1e-3)
            assert len(long["places"]) == len(one["dots"])
        assert sorted(pair["order"]) == list(range(len(told["contours"])))


def test_the_command_is_what_was_typed_quoted_for_a_shell(here):
    (here / "it's a.svg").write_text((here / "a.svg").read_text())
    data = previewed("it's a.svg", "b.svg").data
    assert data["command"][:3] == ["shapeblend", "'it'\"'\"'s a.svg'", "b.svg"]
    assert data["names"] == ["it's a.svg", "b.svg"]


def test_others_are_told_no_folders(here):
    (here / "secret").mkdir()
    for name in "ab":
        (here / "secret" / f"{name}.svg").write_text((here / f"{name}.svg").read_text())
    (here / "secret" / "a.svg").write_text(
        svg("M0 0h9v9z", '<image href="x.png"/>').replace('<path d="<image', "<image")
    )
    page = previewed(str(here / "secret" / "a.svg"), "secret/b.svg")
    assert page.data["studio"][:4] == ["shapeblend", "studio", "a.svg", "b.svg"]
    assert "secret" not in Path("x.html").read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("options", "kept"),
    [
        ("-n 0 --kb 2 -o m.svg", "--kb 2 -o m.svg"),
        ("--frames=0 -q", ""),
        ("-n0 --ends", "--ends"),
        ("-n 10 -o strip.png", "-n 10 -o strip.png"),
    ],
)
def test_the_studio_is_asked_for_the_blend_and_not_for_the_page(here, options, kept):
    assert run(["a.svg", "b.svg", *options.split(), "--preview", "x.html"]) == 0
    page = Page(Path("x.html").read_text(encoding="utf-8"))
    assert " ".join(page.data["studio"]) == f"shapeblend studio a.svg b.svg {kept}".strip()


def test_what_files_say_does_no_harm(here):
    evil = "</script><script>alert(1)</script><!--"
    name = evil.replace("/", "_") + "&.svg"
    (here / name).write_text(svg(f'<path id="{evil.replace("<", "&lt;")}" d="M2 2H22V18H2Z junk"/>'))
    page = previewed(name, "b.svg", "--lenient")
    assert evil in page.data["notes"][0]
    assert page.data["names"][0] == name
    assert [tag for tag, _ in page.found].count("script") == 2
    assert "<!--" not in page.text
    assert page.texts["h1"] == [f"{name} → b.svg"]
    assert all(not key.startswith("on") for _, attributes in page.found for key in attributes)


def test_nothing_is_fetched_and_no_other_script_runs(here):
    page = previewed("a.svg", "b.svg")
    (policy,) = (a["content"] for _, a in page.found if a.get("http-equiv") == "Content-Security-Policy")
    rules = dict(rule.split(" ", 1) for rule in policy.split("; "))
    assert rules["default-src"] == "'none'"
    for kind, rule in (("script", "script-src"), ("style", "style-src")):
        digest = hashlib.sha256(page.texts[kind][-1].encode()).digest()
        assert rules[rule] == f"'sha256-{base64.b64encode(digest).decode()}'"
    addresses = set(re.findall(r"https?://[^\"']*", page.text))
    assert addresses == {"http://www.w3.org/2000/svg"}  # a name, which is not fetched
    assert [a for _, a in page.found if {"src", "href"} & set(a)] == [{"rel": "icon", "href": "data:,"}]


def test_same_input_same_bytes_but_for_how_long_it_took(here):
    timeless = re.compile(r'"seconds":(\{[^}]*\}|[-\d.e]+)')
    first, second = (timeless.sub("", previewed("a.svg", "c.svg", "--force").text) for _ in range(2))
    assert first == second


@pytest.mark.parametrize(
    ("options", "counts", "most"),
    [
        # Outlines of all kinds of bends pack worse.
        (["e", "f", "--preset", "paper"], [200, 197], 150_000),
        (["bird-1", "bird-2", "--preset", "paper"], [263, 261], 300_000),
        # Cut at each other's vertices there are more of them, and dots of the graph by their square.
        (["e", "f"], None, 300_000),
        (["bird-1", "bird-2"], None, 600_000),
    ],
)
def test_a_pair_of_two_hundred_vertices_each_stays_small(here, samples, options, counts, most):
    a, b, *options = options
    page = previewed(str(samples / f"{a}.svg"), str(samples / f"{b}.svg"), *options, "-f")
    found = page.data["pairs"][0]["contours"][0]["counts"]
    assert found == counts if counts else all(200 <= count <= 600 for count in found)
    assert len(page.text.encode()) < most


@pytest.mark.parametrize(
    ("arguments", "status", "said"),
    [
        (["--preview", "x.txt"], 2, "must be a file name ending in .htm or .html"),
        (["--preview", "-"], 2, "must be a file name ending in .htm or .html"),
        (["--preview", "old.html"], 1, "old.html: "),
        (["--preview", "r.html", "--report", "r.html"], 1, "r.html: is named for two different outputs"),
        (["--preview", "sub.html/x.html"], 1, "sub.html"),
    ],
)
def test_a_page_that_cannot_be_written_is_refused_in_one_line(here, capsys, arguments, status, said):
    (here / "old.html").write_text("mine")
    (here / "sub.html").write_text("mine")
    before = sorted(path.name for path in here.iterdir())
    assert run(["a.svg", "b.svg", *arguments]) == status
    (line,) = capsys.readouterr().err.splitlines()
    assert line.startswith("shapeblend: ")
    assert said in line
    assert sorted(path.name for path in here.iterdir()) == before
    assert (here / "old.html").read_text() == "mine"


def test_names_of_pages_may_be_written_in_capitals_and_replaced_on_request(here):
    for _ in range(2):
        assert run(["a.svg", "b.svg", "-n", "0", "-q", "--preview", "X.HTM", "--force"]) == 0
    data = Page((here / "X.HTM").read_text()).data
    assert (data["frames"], len(data["pairs"])) == ([], 1)


def test_open_lines_and_empty_works_are_shown_too(here):
    for name in ("l", "m"):
        (here / f"{name}.svg").write_text(svg(LINES.format(name)))
    (contour,) = previewed("l.svg", "m.svg").data["pairs"][0]["contours"]
    assert (contour["closed"], contour["work"]) == (False, pytest.approx(0.0, abs=1e-12))
