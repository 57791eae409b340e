"""Drawings of several states, from any to any, in Chromium."""

from itertools import pairwise
from pathlib import Path

import pytest

from shapeblend_cli.cli import run
from tests.browser.test_triggers import LONG, Shown, assert_moves, assert_turns_round, show  # noqa: F401  # a fixture
from tests.support.commands import write
from tests.support.drawings import EYED, LEAF, RING, svg

PLACES = {"left": 2.0, "middle": 8.0, "right": 14.0}
SECONDS = 0.8


def files():
    for name, x in PLACES.items():
        write(**{name: svg(f'<path id="box" d="M{x} 8h8v8h-8z" fill="#{int(x) * 11:06x}"/>')})
    return [f"{name}.svg" for name in PLACES]


def made(*options, file="s.svg"):
    assert run(["states", *files(), "-o", file, "-f", "-q", "--duration", str(SECONDS), *options]) == 0
    return Path(file).read_text()


class Element(Shown):
    """A custom element in a page, whose path is in its shadow."""

    FIND = "document.querySelector('my-icon').shadowRoot.getElementById('box')"


@pytest.fixture
def element(show, here):  # noqa: F811
    """Show a custom element with attributes."""

    def shown(attributes="", before="", seconds=SECONDS, asked=(), **options):
        script = made("--element", "my-icon", "--duration", str(seconds), *asked, file="icon.js")
        body = f"<style>my-icon{{width:120px;height:120px}}</style><script>{before}</script>"
        body += f'<script type="module">{script}</script><my-icon {attributes}></my-icon>'
        found = show(body, **options)
        found.page.wait_for_function("!!customElements.get('my-icon')")
        return Element(found.page)

    return shown


def test_each_state_goes_to_each(here, show):  # noqa: F811
    shown = show(made())
    now = "left"
    for name in ("right", "left", "middle", "right", "middle", "left"):
        shown.page.evaluate(f"document.querySelector('svg').dataset.state = '{name}'")
        assert_moves(shown.path(), PLACES[now], PLACES[name])
        now = name


def test_a_click_and_a_key_go_on_to_the_next_state(here, show):  # noqa: F811
    shown = show(made("--trigger", "click"))
    states = [*PLACES.values(), PLACES["left"], PLACES["middle"]]
    for k, (start, end) in enumerate(pairwise(states)):
        shown.click() if k < 3 else shown.page.keyboard.press("Enter")
        assert_moves(shown.path(), start, end)


def test_pointing_and_the_focus_show_the_second_state(here, show):  # noqa: F811
    shown = show(made("--trigger", "hover") + "<button>next</button>")
    for there, back in ((shown.point, shown.leave), (lambda: shown.page.keyboard.press("Tab"),) * 2):
        there()
        assert_moves(shown.path(), 2, 8)
        back()
        assert_moves(shown.path(), 8, 2)


def test_a_state_can_change_on_the_way(here, show):  # noqa: F811
    shown = show(made("--duration", str(LONG)))
    shown.page.evaluate("document.querySelector('svg').dataset.state = 'right'")
    shown.passes(4.0)
    shown.page.evaluate("document.querySelector('svg').dataset.state = 'left'")
    assert_turns_round(shown.moments())


def test_states_look_like_their_drawings(here, show):  # noqa: F811
    drawings = {"eye": EYED, "leaf": LEAF, "ring": RING}
    for name, data in drawings.items():
        write(**{name: svg(f'<path fill="#2040c0" fill-rule="evenodd" d="{data}"/>')})
    assert run("states eye.svg leaf.svg ring.svg -o s.svg -q --duration 0".split()) == 0
    shown = show(Path("s.svg").read_text())
    for name in ("eye", "leaf", "ring", "eye"):
        shown.page.evaluate(f"document.querySelector('svg').dataset.state = '{name}'")
        shown.comes_to_look_like(show(Path(f"{name}.svg").read_text()).picture())


def test_with_reduced_motion_a_state_is_there_at_once(here, show, element):  # noqa: F811
    for shown, change in (
        (show(made(), reduced_motion="reduce"), "document.querySelector('svg').dataset.state = 'right'"),
        (element(reduced_motion="reduce"), "document.querySelector('my-icon').state = 'right'"),
    ):
        shown.page.evaluate(change)
        assert shown.left() == pytest.approx(14.0)


def test_an_element_goes_from_state_to_state(element):
    shown = element('state="middle"')
    assert shown.left() == pytest.approx(8.0)
    now = "middle"
    for name in ("left", "right", "middle"):
        shown.page.evaluate(f"document.querySelector('my-icon').state = '{name}'")
        assert_moves(shown.path(), PLACES[now], PLACES[name])
        now = name
    shown.page.evaluate("document.querySelector('my-icon').setAttribute('state', 'left')")
    assert_moves(shown.path(), 8, 2)
    assert shown.page.evaluate("document.querySelector('my-icon').states") == list(PLACES)


def test_an_element_without_a_trigger_has_that_of_its_module(element):
    shown = element(asked=("--trigger", "click"))
    shown.click()
    assert_moves(shown.path(), 2, 8)


def test_an_element_may_have_no_trigger_where_its_module_has_one(element):
    shown = element('trigger=""', asked=("--trigger", "click"))
    shown.click()
    shown.page.wait_for_timeout(500)
    assert shown.left() == 2.0


def test_an_element_reacts_to_clicks_and_keys(element):
    shown = element('trigger="click" label="Player"')
    button = shown.page.get_by_role("button", name="Player: left")
    assert button.count() == 1
    shown.click()
    assert_moves(shown.path(), 2, 8)
    shown.page.keyboard.press(" ")
    assert_moves(shown.path(), 8, 14)
    assert shown.page.get_by_role("button", name="Player: right").count() == 1


def test_an_element_reacts_to_pointing_and_the_focus(element):
    shown = element('trigger="hover"')
    shown.point()
    assert_moves(shown.path(), 2, 8)
    shown.leave()
    assert_moves(shown.path(), 8, 2)
    shown.page.keyboard.press("Tab")
    assert_moves(shown.path(), 2, 8)


def test_an_element_tells_the_page(element):
    shown = element()
    told = "new Promise(done => {const i = document.querySelector('my-icon');"
    told += "i.addEventListener('statechange', e => done(e.detail), {once: true}); i.next()})"
    assert shown.page.evaluate(told) == "middle"


def test_an_element_moves_where_paths_have_no_transitions(element):
    shown = element(before="CSS.supports = () => false;", seconds=LONG)
    path = "document.querySelector('my-icon').shadowRoot.querySelector('path').getAttribute('d')"
    start = shown.page.evaluate(path)
    shown.page.evaluate("document.querySelector('my-icon').state = 'right'")
    shown.passes(4.0)
    between = shown.page.evaluate(path)
    shown.moments()
    end = shown.page.evaluate(path)
    xs = [float(text.replace(",", " ").lstrip("M").split()[0]) for text in (start, between, end)]
    assert xs[0] == 2.0
    assert 2.0 < xs[1] < 14.0
    assert xs[2] == 14.0


SCROLL = """async (change) => {
    const long = [0], frames = [];
    const watch = new PerformanceObserver(l => long.push(...l.getEntries().map(e => e.duration)));
    watch.observe({type: "longtask"});
    scrollTo(0, 0);
    eval(change);
    let last = await new Promise(requestAnimationFrame);
    for (let k = 0; k < 60; k++) {
        scrollBy(0, 40);
        const now = await new Promise(requestAnimationFrame);
        frames.push(now - last);
        last = now;
    }
    watch.disconnect();
    return {long: Math.max(...long), frame: frames.sort((a, b) => a - b)[30], top: scrollY};
}"""


@pytest.mark.parametrize("kind", ["svg", "element"])
def test_a_page_of_fifty_scrolls_about_as_smoothly_while_they_move(here, show, kind):  # noqa: F811
    """No task holds the page up, and frames come one after the other, compared with the same page at rest."""
    drawings = {"eye": EYED, "leaf": LEAF, "ring": RING}
    for name, data in drawings.items():
        write(**{name: svg(f'<path fill-rule="evenodd" d="{data}"/>')})
    output = "s.svg" if kind == "svg" else "my-icon.js"
    assert run(["states", "eye.svg", "leaf.svg", "ring.svg", "-o", output, "-q", "--duration", "2"]) == 0
    text = Path(output).read_text()
    body = "<style>svg,my-icon{width:120px;height:120px;display:block}</style>"
    if kind == "svg":
        body += text * 50
        change = "document.querySelectorAll('svg').forEach(s => s.dataset.state = 'ring')"
    else:
        body += f'<script type="module">{text}</script>' + "<my-icon></my-icon>" * 50
        change = "document.querySelectorAll('my-icon').forEach(s => s.state = 'ring')"
    shown = show(body)
    if kind == "element":
        shown.page.wait_for_function("document.querySelectorAll('my-icon:defined').length === 50")
    at_rest = shown.page.evaluate(SCROLL, "")
    moving = shown.page.evaluate(SCROLL, change)
    assert moving["top"] > 2000
    assert moving["long"] < 200 + 3 * at_rest["long"]
    assert moving["frame"] < 6 + 2 * at_rest["frame"]
