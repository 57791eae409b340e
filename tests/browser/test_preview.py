"""The page of `--preview` in a real browser, used by mouse, by finger and by keyboard."""

import itertools
import json
import re

import numpy as np
import pytest

from shapeblend_cli.cli import run
from shapeblend_cli.job.job import RECORDS
from shapeblend_cli.matching.landscape import landscape
from shapeblend_cli.options.settings import Settings
from shapeblend_cli.svg.reading.read import read
from shapeblend_cli.wires.match import solved_wires
from tests.support.chromium import picture_of
from tests.support.commands import points
from tests.support.drawings import BAR, EIGHT, EYED, LEAF, SQUARES, B, svg
from tests.support.motions import blend
from tests.support.solver import path_through

SETTINGS = Settings(vertices=40, motion="linear")
EVENODD = 'fill-rule="evenodd" fill="{}"'
COLOURS = ("#804000", "#206080", "#308030")
DRAWINGS = {
    "one": [LEAF, BAR],
    "several": [EYED, LEAF],
    "more": [BAR, SQUARES],
    "three": [B, EIGHT, LEAF],
    "large": [LEAF, BAR],
    "resting": [LEAF, BAR],
}
OPTIONS = {
    "large": "--vertices 420 --repeat 3 -n 0",
    "resting": "--ease back --duration 1 --hold 0.5,1 --repeat pingpong",
}


@pytest.fixture(scope="module")
def pages(tmp_path_factory):
    """Pages by name, and the drawings they are of."""
    folder = tmp_path_factory.mktemp("pages")
    found = {}
    for name, paths in DRAWINGS.items():
        files = [folder / f"{name}-{letter}.svg" for letter in "abc"[: len(paths)]]
        for file, path, colour in zip(files, paths, COLOURS, strict=False):
            file.write_text(svg(path, attributes=EVENODD.format(colour)))
        page = folder / f"{name}.html"
        options = f"-n 3 --vertices {SETTINGS.vertices} -q {OPTIONS.get(name, '')} --motion linear".split()
        suffix = ".svg" if name == "resting" else ""
        outputs = ["-o", str(folder / f"{name}{suffix}"), "--preview", str(page)]
        assert run([*map(str, files), *options, *outputs]) == 0
        found[name] = (page, files)
    return found


@pytest.fixture
def opened(browser, pages):
    """Open a page. Nothing may go wrong in it, and nothing may be fetched, as long as the test runs."""
    contexts, wrong, asked = [], [], []

    def open_(name, *, moving=False, width=1280, height=900, scheme="light", touch=False):
        context = browser.new_context(
            viewport={"width": width, "height": height},
            color_scheme=scheme,
            reduced_motion="no-preference" if moving else "reduce",
            has_touch=touch,
        )
        contexts.append(context)
        page = context.new_page()
        page.clock.install()
        page.on("console", lambda message: wrong.append(f"{message.type}: {message.text}"))
        page.on("pageerror", lambda error: wrong.append(str(error)))
        page.on("request", lambda request: asked.append(request.url))
        address = pages[name][0].as_uri()
        page.goto(address)
        page.wait_for_selector("html[data-ready]")
        assert not page.is_visible("#graph")  # the words of the method are folded away
        assert not page.is_visible("#command")
        page.click("#run > summary")
        page.click("#method > summary")
        page.locator("body").click(position={"x": 2, "y": 2})
        page.evaluate("() => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))")
        return page

    yield open_
    addresses = {path.as_uri() for path, _ in pages.values()}
    assert [url for url in asked if url not in addresses and not url.startswith("data:,")] == []
    for context in contexts:
        context.close()
    assert wrong == []


@pytest.fixture
def page(opened):
    """The page called one, opened."""
    return opened("one")


def time_of(page):
    return float(page.input_value("#time"))


def shape(page):
    return page.get_attribute("#picture path", "d")


def overlaid(page):
    return page.locator("#overlay path").count()


def seek(page, time):
    page.fill("#time", str(time))


def stand_still(page):
    """Let time pass by `run_for` alone: else it goes on as well, the more the busier the machine is."""
    page.clock.pause_at(page.evaluate("Date.now()") + 1000)


def test_it_plays_by_itself_and_stops_on_request(opened):
    page = opened("one", moving=True)
    first = shape(page)
    page.wait_for_function(
        "before => document.querySelector('#picture path').getAttribute('d') !== before", arg=first
    )
    assert page.get_attribute("#play", "aria-label") == "Pause"
    page.click("#play")
    assert page.get_attribute("#play", "aria-label") == "Play"
    still, time = shape(page), time_of(page)
    page.clock.run_for(1000)
    assert (shape(page), time_of(page)) == (still, time)
    page.locator("body").press(" ")
    page.wait_for_function("before => Number(document.getElementById('time').value) !== before", arg=time)


def test_it_does_not_start_for_who_prefers_reduced_motion(page):
    page.clock.run_for(1000)
    assert (time_of(page), page.get_attribute("#play", "aria-label")) == (0.0, "Play")
    page.click("#play")
    page.wait_for_function("() => Number(document.getElementById('time').value) > 0")


@pytest.mark.parametrize("repeat", ["once", "forever", "pingpong"])
def test_at_its_end_it_does_what_was_chosen(page, repeat):
    page.select_option("#repeat", label=repeat)
    seek(page, 0.8)
    page.click("#play")
    if repeat == "once":
        page.wait_for_function("() => document.getElementById('play').getAttribute('aria-label') === 'Play'")
        assert time_of(page) == 1.0
        page.click("#play")  # again, from the beginning
        page.wait_for_function("() => Number(document.getElementById('time').value) < 0.9")
    else:
        stand_still(page)
        times = []
        for _ in range(40):
            times.append(time_of(page))
            page.clock.run_for(25)
        steps = np.diff(times)
        assert steps.min() < 0
        assert (steps.min() < -0.5) == (repeat == "forever")


def test_the_slider_stands_beside_the_middle_of_the_button(page):
    middles = [
        (box := page.locator(name).bounding_box())["y"] + box["height"] / 2 for name in ("#play", "#time")
    ]
    assert middles[0] == pytest.approx(middles[1], abs=1)


def test_there_is_no_table_of_frames_without_frames(opened):
    page = opened("one")
    assert page.is_visible("#frames-all")
    page = opened("large")
    assert not page.is_visible("#frames-all")


def test_settings_are_called_as_their_options(page):
    page.click("text=All settings")
    names = set(page.locator("#settings dt").all_text_contents())
    flags = {
        part for record in RECORDS for o in record.options.values() for f in o.flags for part in f.split("/")
    }
    assert {"--select-a", "--try", "--pin"} <= names <= flags


def test_of_lines_no_bound_of_nothing_is_told(browser, tmp_path):
    for name, data in {"menu": "M4 6H20 M4 12H20 M4 18H20", "x": "M18 6 6 18 M6 6 18 18"}.items():
        strokes = 'fill="none" stroke="#222" stroke-width="2"'
        (tmp_path / f"{name}.svg").write_text(svg(data, attributes=strokes))
    page_file, report = tmp_path / "x.html", tmp_path / "r.json"
    files = [str(tmp_path / f"{name}.svg") for name in ("menu", "x")]
    assert run([*files, "-q", "-n", "0", "--preview", str(page_file), "--report", str(report)]) == 0
    contours = json.loads(report.read_text())["pairs"][0]["contours"]
    assert any(one["work"] > 0 and one["lower_bound"] == 0 for one in contours)
    with browser.new_context(reduced_motion="reduce") as context:
        page = context.new_page()
        page.goto(page_file.as_uri())
        page.wait_for_selector("html[data-ready]")
        page.click("#method > summary")
        for number in range(len(contours)):
            if page.is_visible("#contour"):
                page.select_option("#contour", str(number))
            assert "gap 100 %" not in page.inner_text("#works")


def test_rests_and_easings_that_overshoot_are_played(opened):
    page = opened("resting")
    stand_still(page)
    page.click("#play")
    shown = []
    for _ in range(36):  # a rest, forwards, a rest, backwards
        page.clock.run_for(100)
        shown.append(float(page.inner_text("#clock")))
    assert shown[:4] == [0] * 4
    assert max(shown) > 1.05
    assert shown.count(1) >= 9
    assert min(shown[25:]) == 0


def test_the_slider_shows_what_frames_show(page, pages):
    folder = pages["one"][0].with_suffix("")
    for k, time in ((1, 0.25), (2, 0.5), (3, 0.75)):
        seek(page, time)
        frame = (folder / f"frame-{k}.svg").read_text()
        np.testing.assert_allclose(points(shape(page)), points(frame), rtol=0, atol=2e-3)
        (fill,) = re.findall(r'fill="([^"]*)"', frame)
        # Between two of the even times at which paint is told, channels go evenly.
        colours = (page.get_attribute("#picture path", "fill"), fill)
        ours, theirs = (np.array(list(bytes.fromhex(c[1:])), int) for c in colours)
        assert np.abs(ours - theirs).max() <= 1
    assert page.inner_text("#clock") == "0.75"


def test_keys_move_in_time(page):
    shapes = {}
    keys = ["ArrowRight", "Shift+ArrowRight", "Shift+ArrowLeft", "End", "ArrowLeft", "Home"]
    for key, time in zip(keys, (0.02, 0.25, 0.0, 1.0, 0.98, 0.0), strict=True):
        page.locator("body").press(key)
        assert time_of(page) == pytest.approx(time)
        shapes[key] = shape(page)
    page.focus("#time")
    page.keyboard.press("ArrowRight")
    assert time_of(page) == pytest.approx(0.02)
    assert shape(page) == shapes["ArrowRight"]


def test_all_that_is_operated_can_be_reached_by_keyboard_and_has_a_name(opened):
    page = opened("several")
    page.check("#show-points")
    reached = []
    for _ in range(45):
        page.keyboard.press("Tab")
        reached.append(page.evaluate("document.activeElement.id"))
        outline = page.evaluate("getComputedStyle(document.activeElement).outlineStyle")
        assert outline != "none" or reached[-1] == ""
    wanted = "theme play time speed repeat show-parts show-onion show-points show-paths dot copy contour graph zoom-in"
    assert set(wanted.split()) <= set(reached)
    nameless = page.evaluate(
        """[...document.querySelectorAll("button, select, input, canvas[tabindex]")].filter(e =>
        !(e.getAttribute("aria-label") || e.labels?.length || e.textContent.trim())).map(e => e.id)"""
    )
    assert nameless == []


def test_toggles_show_and_hide(page):
    seek(page, 0.5)
    onions = [page.locator("#onion path:not(.halo)").count()]
    for press in (page.check, page.uncheck):
        press("#show-onion")
        onions.append(page.locator("#onion path:not(.halo)").count())
    assert onions == [0, 5, 0]  # three frames and two drawings
    page.check("#show-points")
    assert (page.locator("#overlay .points").count(), page.locator("#overlay .paths").count()) == (3, 0)
    page.check("#show-paths")
    page.uncheck("#show-points")
    assert (page.locator("#overlay .points").count(), page.locator("#overlay .paths").count()) == (0, 1)
    page.uncheck("#show-paths")
    assert overlaid(page) == 0


@pytest.fixture(scope="module")
def contour(pages):
    """The contour of the page called one."""
    pair, _ = blend(*(read(str(file)) for file in pages["one"][1]), SETTINGS)
    return pair.contours[0]


@pytest.fixture(scope="module")
def expected(contour):
    """What the graph of that page shows."""
    return landscape(solved_wires(contour, SETTINGS), contour.correspondence.dots, None)


def screen(page, point):
    """Where a point of the drawing is on the screen."""
    m = page.evaluate("(m => [m.a, m.d, m.e, m.f])(document.getElementById('drawing').getScreenCTM())")
    return m[0] * point.real + m[2], m[1] * point.imag + m[3]


@pytest.mark.parametrize("way", ["mouse", "finger", "keyboard"])
def test_a_dot_shows_its_pair(opened, contour, way):
    page = opened("one", touch=way == "finger")
    page.check("#show-points")
    found = contour.correspondence.dots
    number = next(k for k, (_, j) in enumerate(found) if np.count_nonzero(found[:, 1] == j) == 1 and k > 4)
    i, j = found[number]
    a, b = contour.polygon_a.vertices[i], contour.polygon_b.vertices[j]
    if way == "keyboard":
        page.focus("#dot")
        for _ in range(number):
            page.keyboard.press("ArrowRight")
        assert time_of(page) == 0.0
    else:
        (page.mouse.move if way == "mouse" else page.touchscreen.tap)(*screen(page, b))
    said = page.inner_text("#dot-says")
    assert re.findall(r"[AB] (\d+) at", said)[1] == str(j)
    at_a, at_b = (complex(*map(float, at)) for at in re.findall(r"at (-?[\d.]+), (-?[\d.]+)", said))
    assert abs(at_b - b) < 1e-2
    assert abs(at_a - contour.polygon_a.vertices[int(re.findall(r"A (\d+) at", said)[0])]) < 1e-2
    assert abs(points(page.get_attribute("#overlay .way", "d"))[-1] - b) < 1e-2
    if way == "keyboard":
        assert abs(at_a - a) < 1e-2


def cell_of(page, column, row, columns, rows):
    """Where a dot of the graph is on the screen, all of it shown."""
    box = page.locator("#graph").bounding_box()
    left, top, width, height = box["x"] + 44, box["y"] + 28, box["width"] - 54, box["height"] - 36
    return (
        left + width / 2 + (column - (columns - 1) / 2) * (width - 14) / columns,
        top + height / 2 + (row - (rows - 1) / 2) * (height - 14) / rows,
    )


def assert_other_path_is_shown(page, contour, expected, column, row, time):
    """The polygon of eq (2) by the least path through a dot, over the picture."""
    m, n = len(contour.polygon_a.vertices), len(contour.polygon_b.vertices)
    path = path_through(expected, column, row)[:-1] + np.array(expected.start)
    at_a, at_b = contour.polygon_a.vertices[path[:, 0] % m], contour.polygon_b.vertices[path[:, 1] % n]
    polygon = (1 - time) * at_a + time * at_b
    np.testing.assert_allclose(points(page.get_attribute("#overlay .other", "d")), polygon, atol=1e-2)
    work = float(re.search(r"least work ([\d.]+)", page.inner_text("#cell")).group(1))
    assert work == pytest.approx(expected.works[column, row], rel=2e-3)


def test_a_click_on_the_graph_shows_the_other_correspondence_and_escape_goes_back(page, contour, expected):
    columns, rows = expected.works.shape
    seek(page, 0.25)
    before = shape(page)
    for column, row in ((columns // 2, rows // 3), (columns // 3, rows // 2), (columns - 4, rows // 2)):
        assert np.isfinite(expected.works[column, row])
        page.mouse.click(*cell_of(page, column, row, columns, rows))
        assert_other_path_is_shown(page, contour, expected, column, row, 0.25)
    seek(page, 0.5)
    assert_other_path_is_shown(page, contour, expected, columns - 4, rows // 2, 0.5)
    seek(page, 0.25)
    page.keyboard.press("Escape")
    assert overlaid(page) == 0
    assert shape(page) == before
    # The button does the same.
    page.mouse.click(*cell_of(page, columns // 2, rows // 3, columns, rows))
    page.click("#back")
    assert overlaid(page) == 0


def test_the_graph_is_used_by_keyboard(page, contour, expected):
    page.focus("#graph")
    for press in ["Shift+ArrowRight", *["ArrowRight"] * 2, *["ArrowDown"] * 7, "+", "-", "Enter"]:
        page.keyboard.press(press)
    assert_other_path_is_shown(page, contour, expected, 12, 7, 0.0)
    assert time_of(page) == 0.0  # arrows stay in the graph
    page.keyboard.press("Escape")
    assert overlaid(page) == 0


def pixels(page):
    return page.evaluate("document.getElementById('graph').toDataURL()")


def middle_of_graph(page):
    box = page.locator("#graph").bounding_box()
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2


def test_the_graph_is_zoomed_and_moved(page):
    seen = [pixels(page)]
    page.locator("#graph").hover()
    page.mouse.wheel(0, -400)
    page.wait_for_function("seen => document.getElementById('graph').toDataURL() !== seen", arg=seen[0])
    seen.append(pixels(page))
    x, y = middle_of_graph(page)
    page.mouse.down()
    page.mouse.move(x - 60, y - 40, steps=4)
    page.mouse.up()
    seen.append(pixels(page))
    assert overlaid(page) == 0  # that was no click
    page.click("#zoom-in")
    seen.append(pixels(page))
    assert all(p != q for p, q in itertools.pairwise(seen))
    page.click("#zoom-fit")
    page.mouse.move(0, 0)
    assert pixels(page) == seen[0]


def test_two_fingers_zoom(opened):
    page = opened("one", width=390, height=844, touch=True)
    page.locator("#graph").scroll_into_view_if_needed()
    before = pixels(page)
    x, y = middle_of_graph(page)
    fingers = page.context.new_cdp_session(page)
    for kind, apart in (("touchStart", 20), *(("touchMove", 20 + 8 * k) for k in range(1, 8))):
        points = [{"x": x + way * apart, "y": y + way * apart / 2, "id": way + 1} for way in (-1, 1)]
        fingers.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})
    fingers.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})
    assert "zoomed" in page.get_attribute("#graph", "class")
    assert pixels(page) != before
    assert overlaid(page) == 0


def test_a_graph_that_is_too_large_is_its_path_alone(opened):
    page = opened("large")
    assert "are too many for this page" in page.inner_text("#graph-help")
    assert not page.is_visible("#legend")
    before = pixels(page)
    page.locator("#graph").click()
    page.mouse.move(0, 0)
    assert overlaid(page) == 0
    assert pixels(page) == before
    assert "No frames were asked for" in page.inner_text("#strip-says")
    assert page.locator("#repeat option:checked").inner_text() == "3 times"


def test_contours_are_chosen_the_largest_first(opened):
    page = opened("several")
    options = page.locator("#contour option").all_inner_texts()
    assert len(options) == 2
    assert "shrinks to a point" in options[1]
    assert page.is_visible("#graph")
    page.select_option("#contour", index=1)
    assert not page.is_visible("#graph")
    assert "no graph" in page.inner_text("#graph-absent")
    page.check("#show-points")
    seek(page, 0.5)
    page.focus("#dot")
    page.keyboard.press("End")
    assert "pair" in page.inner_text("#dot-says")
    page.select_option("#contour", index=0)
    assert page.is_visible("#graph")


def test_a_stroke_on_an_edge_is_no_point(browser, tmp_path):
    square, wide = "M2 2H10V10H2Z", "M2 2H18V10H2Z"
    for name, shapes in {"a": [square], "b": [wide, f'<path d="{wide}" fill="none" stroke="red"/>']}.items():
        (tmp_path / f"{name}.svg").write_text(svg(*shapes))
    files = [str(tmp_path / name) for name in ("a.svg", "b.svg", "out", "page.html")]
    assert run([*files[:2], "-o", files[2], "--preview", files[3], "-q"]) == 0
    page = browser.new_page()
    page.goto((tmp_path / "page.html").as_uri())
    options = page.locator("#contour option").all_text_contents()
    page.close()
    assert sum("follows the edge that it lies on" in option for option in options) == 1
    assert not any("point" in option for option in options)


def test_three_drawings_run_through_or_one_pair_at_a_time(opened):
    page = opened("three")
    assert (page.get_attribute("#time", "max"), page.locator("#scope option").count()) == ("2", 3)
    ends = []
    for time in (0.0, 1.0, 2.0):
        seek(page, time)
        ends.append(page.get_attribute("#picture path", "fill"))
    assert ends == list(COLOURS)
    page.select_option("#scope", "1")
    assert [page.get_attribute("#time", name) for name in ("min", "max")] == ["1", "2"]
    assert time_of(page) == 1.0
    assert page.inner_text("#clock") == "B → C 0.00"
    page.select_option("#scope", "all")
    page.click("summary:has-text('Frames')")
    page.locator("#frames tr").last.wait_for()
    assert page.locator("#frames tr").count() == 6
    page.locator("#frames button").nth(4).click()
    assert time_of(page) == pytest.approx(1.5)


@pytest.mark.parametrize("name", list(DRAWINGS))
def test_on_a_phone_nothing_is_wider_than_the_screen(opened, name):
    page = opened(name, width=390, height=844, touch=True)
    page.check("#show-points")
    for title in ("All settings",) if name == "large" else ("Frames", "All settings"):  # one has no frames
        page.click(f"summary:has-text('{title}')")
    assert page.evaluate("document.documentElement.scrollWidth") == 390
    small = page.evaluate(
        """[...document.querySelectorAll("button, select, input[type=range], label.check")]
        .map(e => [e.id || e.textContent, e.getBoundingClientRect()])
        .filter(([_, box]) => box.width && (box.height < 44 || box.width < 44)).map(([name]) => name)"""
    )
    assert small == []


# The contrast of WCAG 2 of every piece of text with what is behind it.
CONTRASTS = """(() => {
  const channels = text => text.match(/[\\d.]+/g).map(Number);
  const light = ([r, g, b]) => {
    const [x, y, z] = [r, g, b].map(c => c / 255).map(c => c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4);
    return 0.2126 * x + 0.7152 * y + 0.0722 * z;
  };
  const found = [];
  const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  while (walker.nextNode()) {
    const element = walker.currentNode.parentElement;
    if (!walker.currentNode.data.trim() || !element.checkVisibility() || element.closest("script")) continue;
    let behind = element;
    const ground = () => getComputedStyle(behind).backgroundColor;
    while (/rgba\\(.*, 0\\)|transparent/.test(ground())) behind = behind.parentElement;
    const [p, q] = [getComputedStyle(element).color, ground()].map(channels).map(light);
    found.push([(Math.max(p, q) + 0.05) / (Math.min(p, q) + 0.05), walker.currentNode.data]);
  }
  return found;
})()"""


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("is_toggled", [False, True])
def test_text_is_readable_in_light_and_dark(opened, scheme, is_toggled):
    page = opened("several", scheme=scheme)
    page.check("#show-points")
    before = pixels(page)
    page.focus("#dot")
    page.keyboard.press("ArrowRight")
    if is_toggled:
        page.click("#theme")
        assert pixels(page) != before
    ground = page.evaluate("getComputedStyle(document.body).backgroundColor")
    brightness = np.mean([int(v) for v in re.findall(r"\d+", ground)[:3]])
    assert (brightness < 128) == ((scheme == "dark") != is_toggled)
    contrasts = page.evaluate(CONTRASTS)
    assert len(contrasts) > 50
    assert [pair for pair in contrasts if pair[0] < 4.5] == []


def test_a_click_on_the_drawing_chooses_its_contour(opened):
    page = opened("several")
    seek(page, 0.5)
    chosen = []
    for contour in page.evaluate("[...document.querySelectorAll('#contour option')].map(o => o.value)"):
        page.check("#show-parts")
        x, y = page.evaluate(
            """contour => {
              const part = document.querySelector(`#parts [data-contour="${contour}"]`);
              const { x, y } = part.getPointAtLength(part.getTotalLength() / 3).matrixTransform(part.getScreenCTM());
              return [x, y];
            }""",
            contour,
        )
        page.uncheck("#show-parts")
        page.mouse.click(x, y)
        chosen.append(page.input_value("#contour") == contour)
    assert chosen == [True, True]


def test_parts_have_one_colour_from_end_to_end(opened):
    page = opened("more")
    assert page.locator(".part").count() == 0
    page.check("#show-parts")
    seek(page, 0.25)
    colours = page.evaluate(
        """[...document.querySelectorAll("#film svg")].map(svg =>
        [...svg.querySelectorAll(".part")].map(part => part.getAttribute("fill")))"""
    )
    assert len(colours) == 9
    assert len(set(map(tuple, colours))) == 1
    assert colours[0] == page.evaluate(
        "[...document.querySelectorAll('#parts .part')].map(part => part.getAttribute('fill'))"
    )


def test_the_film_shows_moments_and_goes_there(page):
    frames = page.locator("#film button")
    assert frames.count() == 9
    assert len({frames.nth(k).locator("path").get_attribute("d") for k in range(9)}) == 9
    frames.nth(2).click()
    assert time_of(page) == pytest.approx(0.25)
    assert shape(page) == frames.nth(2).locator("path").get_attribute("d")


def test_the_onion_skin_is_seen_on_a_dark_drawing(page):
    seek(page, 0.5)
    before = np.array(pixels_of(page, "#stage"))
    page.check("#show-onion")
    after = np.array(pixels_of(page, "#stage"))
    inside = before.sum(axis=2) < 300  # where the drawing paints
    assert inside.sum() > 1000
    assert (np.abs(after - before).sum(axis=2) > 60)[inside].mean() > 0.02


def pixels_of(page, selector):
    return np.asarray(picture_of(page.locator(selector)), int)


def test_a_dot_of_the_graph_is_copied_as_a_pin_that_the_command_takes(
    page, pages, contour, expected, tmp_path
):
    page.context.grant_permissions(["clipboard-read", "clipboard-write"])
    columns, rows = expected.works.shape
    column, row = columns // 2, rows // 3
    assert not page.is_visible("#copy-pin")
    page.mouse.click(*cell_of(page, column, row, columns, rows))
    page.click("#copy-pin")
    page.wait_for_selector("#copy-pin:text-is('Copied')")
    option, value = page.evaluate("navigator.clipboard.readText()").split(" ")
    files = [str(file) for file in pages["one"][1]]
    report = tmp_path / "report.json"
    settings = f"--vertices {SETTINGS.vertices} --motion linear -n 0 --report {report} -o {tmp_path / 'out'}"
    assert run([*files, option, value, *settings.split()]) == 0
    (found,) = json.loads(report.read_text())["pairs"][0]["contours"]
    p, q = (complex(*map(float, point.split(","))) for point in value.split(":"))
    pinned = [
        (abs(complex(*found["vertices_a"][i]) - p), abs(complex(*found["vertices_b"][j]) - q))
        for i, j in found["dots"]
    ]
    assert min(max(offs) for offs in pinned) < 0.3


def test_the_command_is_copied(page, pages):
    page.context.grant_permissions(["clipboard-read", "clipboard-write"])
    page.click("#copy")
    page.wait_for_selector("#copy:text-is('Copied')")
    copied = page.evaluate("navigator.clipboard.readText()")
    assert copied.startswith("shapeblend ")
    assert copied.endswith("-o one --preview one.html")  # without folders
    page.click("#copy-studio")
    page.wait_for_selector("#copy-studio:text-is('Copied')")
    assert page.evaluate("navigator.clipboard.readText()").startswith(
        "shapeblend studio one-a.svg one-b.svg "
    )
