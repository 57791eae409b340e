"""Animated SVGs that wait for a click, for being pointed at, for the keyboard or for another element, in Chromium."""

from pathlib import Path

import numpy as np
import pytest

from shapeblend_cli.cli import run
from tests.support.chromium import picture_of
from tests.support.commands import write
from tests.support.drawings import EYED, LEAF, svg

SIZE = 120
SECONDS = 0.8
LONG = 4.0  # for what is done on the way: a busy machine may be slow to do it
BODY = "<!doctype html><style>body{{margin:0;background:#fff}}svg{{width:120px;height:120px;display:block}}</style>{}"
BOX, FAR = '<path id="box" d="M2 8h8v8h-8z"/>', '<path id="box" d="M14 8h8v8h-8z"/>'

each_method = pytest.mark.parametrize("method", ["smil", "css"])


def reacting(trigger, method, *options, a=BOX, b=FAR, more=()):
    """An animated SVG of two drawings or more."""
    write(a=svg(a), b=svg(b))
    files = ["a.svg", "b.svg"]
    for k, path in enumerate(more):
        Path(f"more-{k}.svg").write_text(svg(path))
        files.append(f"more-{k}.svg")
    command = [*files, "--trigger", trigger, "--animate", method, "--duration", str(SECONDS), "-o", "r.svg"]
    assert run([*command, "-f", "-q", *options]) == 0
    return Path("r.svg").read_text()


WATCH = """(find) => {
    const seen = window.seen = [];
    const look = (now) => {
        const box = eval(find);
        if (box) seen.push([now, box.getBBox().x]);
        requestAnimationFrame(look);
    };
    requestAnimationFrame(look);
}"""
RESTING = 150  # milliseconds
RESTS = f"""() => {{
    const last = seen.at(-1), before = seen.filter(([time]) => time < last[0] - {RESTING}).at(-1);
    return before && seen.filter(([time]) => time >= before[0]).every(([, x]) => x === last[1]);
}}"""


class Shown:
    """A page with a drawing, and a mouse and a keyboard. Each frame shows where its shape is."""

    FIND = "document.getElementById('box')"

    def __init__(self, page):
        self.page = page
        page.evaluate(WATCH, self.FIND)

    def left(self):
        """Where the shape is now: 2 in the first drawing, 14 in the second."""
        return self.page.evaluate(f"{self.FIND}.getBBox().x")

    def passes(self, place):
        """Wait until the shape has passed a place on its way to the right."""
        self.page.wait_for_function(f"seen.at(-1)?.[1] > {place}")

    def comes_to_look_like(self, picture, tolerance=1.0):
        """Wait until the page looks like a picture, for a busy machine some seconds."""
        for _ in range(100):
            if np.abs(self.picture() - picture)[:110, :110].mean() < tolerance:
                return
            self.page.wait_for_timeout(50)
        raise AssertionError("the page does not come to look like the picture")

    def moments(self):
        """The time and the place in each frame since this was last asked for, up to when it rests."""
        self.page.wait_for_timeout(RESTING)
        self.page.wait_for_function(RESTS)
        return np.array(self.page.evaluate("seen.splice(0, seen.length - 1)"))

    def path(self):
        """The places among these."""
        return self.moments()[:, 1]

    def picture(self):
        return np.asarray(picture_of(self.page, "L"), float)

    def point(self):
        self.page.mouse.move(60, 60)

    def leave(self):
        self.page.mouse.move(400, 400)

    def click(self):
        self.page.mouse.click(60, 60)


@pytest.fixture
def show(browser, tmp_path):
    """Show the body of a page."""
    contexts = []

    def shown(body, **options):
        file = tmp_path / "page.html"
        file.write_text(BODY.format(body), encoding="utf-8")
        blank = tmp_path / "blank.html"
        blank.write_text("<!doctype html>", encoding="utf-8")
        context = browser.new_context(viewport={"width": 500, "height": 500}, **options)
        contexts.append(context)
        page = context.new_page()
        # The shell of Chromium begins with the pointer in the corner, where drawings are, and forgets about a move in
        # a page that is no file.
        page.goto(blank.as_uri())
        page.mouse.move(400, 400)
        page.goto(file.as_uri())
        assert not page.evaluate("document.querySelector('body > *').matches(':hover')")
        return Shown(page)

    yield shown
    for context in contexts:
        context.close()


def assert_moves(places, start, end):
    """It goes from one place to another, over places between."""
    assert places[-1] == pytest.approx(end, abs=0.01)
    between = (places > min(start, end) + 0.5) & (places < max(start, end) - 0.5)
    assert between.sum() >= 3
    steps = np.diff(places) * np.sign(end - start)
    assert (steps >= -0.01).all()


def assert_turns_round(moments):
    """It goes back before it was at the end, and is nowhere faster than twice as fast as all the way in its time."""
    times, places = moments.T
    assert places.max() < 13.0
    assert places[-1] == pytest.approx(2.0, abs=0.01)
    assert (np.abs(np.diff(places)) <= 2.0 * 12.0 * np.diff(times) / 1000.0 / LONG + 0.5).all()


@each_method
def test_a_click_moves_it_and_another_one_brings_it_back(here, show, method):
    shown = show(reacting("click", method))
    assert (shown.path() == 2.0).all()
    for start, end in ((2, 14), (14, 2), (2, 14)):
        shown.click()
        assert_moves(shown.path(), start, end)


@each_method
def test_pointing_at_it_moves_it_and_leaving_brings_it_back(here, show, method):
    shown = show(reacting("hover", method))
    for _ in range(2):
        shown.point()
        assert_moves(shown.path(), 2, 14)
        shown.leave()
        assert_moves(shown.path(), 14, 2)


@each_method
def test_clip_paths_go_with_what_they_clip(here, show, method):
    region = '<clipPath id="c"><path d="M{} 4H{}V20H{}Z"/></clipPath>'
    cut = region + '<path id="box" d="M2 8H22V16H2Z" clip-path="url(#c)"/>'
    halves = cut.format(2, 12, 2), cut.format(12, 22, 12)
    shown = show(reacting("hover", method, a=halves[0], b=halves[1]))
    for move, is_left in ((shown.point, False), (shown.leave, True)):
        move()
        half = np.full((500, 500), 255.0)
        half[40:80, slice(10, 60) if is_left else slice(60, 110)] = 0.0
        shown.comes_to_look_like(half)


@each_method
def test_the_focus_of_the_keyboard_moves_it_and_brings_it_back(here, show, method):
    shown = show(reacting("hover", method) + "<button>next</button>")
    shown.page.keyboard.press("Tab")
    assert_moves(shown.path(), 2, 14)
    shown.page.keyboard.press("Tab")
    assert_moves(shown.path(), 14, 2)


@pytest.mark.parametrize(("method", "keys"), [("smil", ["Enter", " "]), ("css", [" ", " "])])
def test_keys_press_what_clicks_press(here, show, method, keys):
    shown = show(reacting("click", method))
    shown.page.keyboard.press("Tab")
    for key, start, end in zip(keys, (2, 14), (14, 2), strict=True):
        shown.page.keyboard.press(key)
        assert_moves(shown.path(), start, end)


@each_method
def test_it_turns_round_on_the_way_without_a_jump(here, show, method):
    shown = show(reacting("hover", method, "--duration", str(LONG)))
    shown.point()
    shown.passes(4.0)
    shown.leave()
    assert_turns_round(shown.moments())


@each_method
@pytest.mark.parametrize("trigger", ["click", "hover"])
def test_with_reduced_motion_it_changes_at_once(here, show, method, trigger):
    shown = show(reacting(trigger, method, "--duration", "30"), reduced_motion="reduce")
    still = show(svg(BOX)).picture(), show(svg(FAR)).picture()
    for k in (1, 0):
        if trigger == "click":
            shown.click()
        else:
            shown.leave() if k == 0 else shown.point()
        shown.comes_to_look_like(still[k], 2.0)


@each_method
@pytest.mark.parametrize("drawings", [(EYED, LEAF), (LEAF, EYED)])
def test_it_looks_like_the_drawings_at_both_ends(here, show, method, drawings):
    paths = [f'<path fill="#2040c0" fill-rule="evenodd" d="{data}"/>' for data in drawings]
    shown = show(reacting("click", method, a=paths[0], b=paths[1]))
    for still in (paths[0], paths[1], paths[0]):
        shown.comes_to_look_like(show(svg(still)).picture())
        shown.click()


def test_shapes_that_change_places_do_so_on_the_way(here, show):
    """Paint order changes: a copy comes and another goes."""
    red, blue = (f'<path fill="{c}" d="M{x} 4h12v12h-12z"/>' for c, x in (("#f00", 2), ("#00f", 8)))
    for method in ("smil", "css"):
        shown = show(reacting("click", method, a=red + blue, b=blue + red))
        for still in (red + blue, blue + red, red + blue):
            shown.comes_to_look_like(show(svg(still)).picture())
            shown.click()


def test_several_drawings_are_gone_through_and_back(here, show):
    middle = '<path id="box" d="M8 14h8v8h-8z"/>'
    shown = show(reacting("click", "smil", b=middle, more=[FAR]))
    for start, end in ((2, 14), (14, 2)):
        shown.click()
        assert_moves(shown.path(), start, end)


@pytest.mark.parametrize("name", ["menu", "the-menu"])
def test_the_event_of_another_element_moves_it_and_the_next_one_brings_it_back(here, show, name):
    shown = show(f'<button id="{name}">menu</button>' + reacting(f"{name}.click", "smil"))
    for start, end in ((2, 14), (14, 2), (2, 14)):
        shown.page.click("button")
        assert_moves(shown.path(), start, end)


@pytest.mark.parametrize("name", ["menu", "the-menu"])
def test_an_event_with_an_opposite_is_undone_by_that(here, show, name):
    shown = show(
        f'<button id="{name}">menu</button>' + reacting(f"{name}.focusin", "smil") + "<button>next</button>"
    )
    shown.page.focus(f"#{name}")
    assert_moves(shown.path(), 2, 14)
    shown.page.keyboard.press("Tab")
    assert_moves(shown.path(), 14, 2)


@each_method
def test_it_tells_what_it_is_and_whether_it_is_pressed(here, show, method):
    titled = "<title>Open the box</title>" + BOX
    shown = show(reacting("click", method, a=titled, b="<title>Open the box</title>" + FAR))
    role = "button" if method == "smil" else "switch"
    element = shown.page.get_by_role(role, name="Open the box")
    assert element.count() == 1
    shown.click()
    if method == "smil":
        assert element.get_attribute("aria-pressed") == "true"
    else:
        assert element.is_checked()
    named = show(reacting("hover", method))
    assert named.page.get_by_role("img", name="a to b").count() == 1


@each_method
def test_a_file_of_its_own_reacts_too(here, browser, method):
    reacting("click", method)
    page = browser.new_page(viewport={"width": 120, "height": 120})
    page.goto(Path("r.svg").absolute().as_uri())
    shown = Shown(page)
    for start, end in ((2, 14), (14, 2)):
        shown.click()
        assert_moves(shown.path(), start, end)
    page.close()


def test_fifty_copies_in_one_page_react_each_by_itself(here, show):
    icon = reacting("hover", "css")
    shown = show('<div style="display:flex;flex-wrap:wrap">' + icon * 50 + "</div>")
    shown.page.mouse.move(180, 60)
    shown.page.wait_for_function("document.querySelectorAll('path')[1].getBBox().x > 13.99999")
    places = shown.page.evaluate("[...document.querySelectorAll('path')].map(p => p.getBBox().x)")
    assert places[1] == pytest.approx(14.0)
    assert {*places[:1], *places[2:]} == {2.0}
