"""Modules of JavaScript in Chromium: what they show at any time, and how they play."""

import gzip
from importlib import resources
from pathlib import Path

import numpy as np
import pytest

import shapeblend_cli as sb
from shapeblend_cli.cli import run
from tests.support.commands import write
from tests.support.drawings import EYED, LEAF, svg

SAMPLES = Path(__file__).parents[2] / "samples"
TIMES = [0.001, *(k / 20 for k in range(1, 20)), 0.999]  # the drawings themselves may be cut otherwise
PLACED = svg('<path id="box" d="M2 8h8v8h-8z"/>'), svg('<path id="box" d="M14 8h8v8h-8z"/>')
GRADIENT = (
    '<linearGradient id="g"><stop stop-color="{}"/><stop offset="1" stop-color="#0cf"/></linearGradient>'
    '<clipPath id="c"><path d="M0 0h{}v24h-24z"/></clipPath>'
    '<path clip-path="url(#c)" fill="url(#g)" d="M2 2h20v20h-20z"/>'
)
PAIRS = {
    "letters": tuple((SAMPLES / name).read_text() for name in ("e.svg", "f.svg")),
    "dancers": tuple((SAMPLES / f"dancer-{k}.svg").read_text() for k in (1, 2)),
    "birds": tuple((SAMPLES / f"bird-{k}.svg").read_text() for k in (1, 2)),
    "parts": (svg(EYED), svg(LEAF)),
    "gradients and clips": (svg(GRADIENT.format("#f00", 20)), svg(GRADIENT.format("#0f0", 12))),
    "lines": (
        svg('<path d="M4 6h16M4 12h16M4 18h16" fill="none" stroke="#222" stroke-width="2"/>'),
        svg('<path d="M5 5l14 14M19 5l-14 14" fill="none" stroke="#222" stroke-width="2"/>'),
    ),
}


@pytest.fixture
def module(browser, here):
    """Open a page that has imported the module of a blend as `blend`, and has an empty svg element."""
    pages = []

    def load(drawings, *options, **context):
        write(**dict(zip("ab", drawings, strict=True)))
        assert run(["a.svg", "b.svg", "-o", "blend.js", "-f", "-q", *options]) == 0
        page = browser.new_context(**context).new_page()
        pages.append(page)
        page.route("**/*", lambda route: route.fulfill(body="<svg></svg>", content_type="text/html"))
        page.route(
            "**/blend.js",
            lambda route: route.fulfill(body=Path("blend.js").read_text(), content_type="text/javascript"),
        )
        page.goto("http://localhost/")
        page.evaluate("import('/blend.js').then((found) => { window.blend = found; })")
        return page

    yield load
    for page in pages:
        page.context.close()


FIND = """() => {
    const paths = [...document.querySelectorAll("svg > path, svg > g path")];
    const shown = paths.filter((path) => getComputedStyle(path).visibility !== "hidden");
    const seen = shown.filter((path) => path.getTotalLength() > 0.1);
    return seen.map((path) => {
        const {x, y, width, height} = path.getBBox(), found = [[x, y], [x + width, y + height]];
        for (let k = 0; k < 40; k += 1) {
            const point = path.getPointAtLength((path.getTotalLength() * k) / 40);
            found.push([point.x, point.y]);
        }
        return found;
    });
}"""


@pytest.mark.parametrize("name", PAIRS)
def test_it_shows_what_frames_show(name, module, browser):
    page, frames = module(PAIRS[name]), browser.new_page()
    page.evaluate("window.show = blend.mount(document.querySelector('svg'))")
    blend = sb.blend("a.svg", "b.svg")
    for t in TIMES:
        page.evaluate(f"show({t})")
        frames.set_content(blend.frame(t).svg)
        box = "document.querySelector('svg').viewBox.baseVal"
        size = frames.evaluate(f"Math.max({box}.width, {box}.height)")
        shown, wanted = page.evaluate(FIND), frames.evaluate(FIND)
        assert len(shown) == len(wanted)
        assert np.abs(np.array(shown) - np.array(wanted)).max() <= 1e-3 * size, t
    frames.close()


def test_ends_and_colours_are_those_of_the_drawings(module):
    page = module((svg('<path fill="#f00" d="M2 2h9v9z"/>'), svg('<path fill="#00f" d="M2 2h9v9z"/>')))
    fills = page.evaluate("[0, 0.5, 1, 7].map((t) => blend.at(t)[0].fill)")
    assert (fills[0], fills[2], fills[3]) == ("#ff0000", "#0000ff", "#0000ff")
    assert fills[1] not in (fills[0], fills[2])
    assert page.evaluate("blend.interpolate(0)(0.5) === blend.at(0.5)[0].d")


def test_several_in_a_page_have_gradients_of_their_own(module):
    page = module(PAIRS["gradients and clips"])
    page.evaluate("""() => {
        document.body.append(document.querySelector("svg").cloneNode());
        const [first, second] = [...document.querySelectorAll("svg")].map(blend.mount);
        first(0); second(1);
    }""")
    assert page.evaluate(
        "new Set([...document.querySelectorAll('[id]')].map(({id}) => id)).size"
    ) == page.evaluate("document.querySelectorAll('[id]').length")


def test_it_plays_turns_round_and_ends(module):
    page = module(PLACED, "--duration", "0.3", "--easing", "ease-in")
    assert page.evaluate("blend.duration") == 300
    assert page.evaluate("blend.ease(0.5)") == pytest.approx(0.3154, abs=2e-3)
    found = page.evaluate("""async () => {
        const svg = document.querySelector("svg"), heard = [];
        const player = blend.animate(svg, { loop: 2, alternate: true });
        for (const name of ["loop", "finish"]) player.addEventListener(name, () => heard.push([name, player.time]));
        const left = () => svg.querySelector("path").getBBox().x;
        const ends = () => new Promise((found) => player.addEventListener("finish", found, { once: true }));
        player.play();
        await ends();
        const back = left();
        player.reverse();
        await ends();
        const stands = [left(), player.playing];
        player.seek(1);
        const far = left();
        player.options.alternate = player.options.loop = false;
        player.to(1).to(0);
        await ends();
        return [heard, back, stands, far, left()];
    }""")
    times = [["loop", 1], ["finish", 0], ["loop", 1], ["finish", 0], ["finish", 0]]
    assert found == [times, 2, [2, False], 14, 2]


def test_where_motion_is_reduced_it_ends_at_once(module):
    page = module(PLACED, reduced_motion="reduce")
    assert page.evaluate("""() => {
        const svg = document.querySelector("svg");
        const player = blend.animate(svg, { duration: 1e6, loop: true }).play();
        return [svg.querySelector("path").getBBox().x, player.playing];
    }""") == [14, False]


def test_an_element_plays_by_its_attributes(module):
    page = module(PLACED)
    page.evaluate("document.body.innerHTML = '<shape-blend autoplay duration=100></shape-blend>'")
    page.wait_for_function("document.querySelector('shape-blend').player.time === 1")
    assert (
        page.evaluate("document.querySelector('shape-blend').shadowRoot.querySelector('path').getBBox().x")
        == 14
    )


def test_a_title_may_look_like_a_place_to_be_filled(module):
    title = "/*EASING*/ FILE"
    titled = [each.replace("<path", f'<title>{title}"</title><path', 1) for each in PLACED]
    assert (
        module(titled)
        .evaluate("""() => {
        const svg = document.querySelector("svg");
        blend.mount(svg);
        return svg.querySelector("title").textContent;
    }""")
        .startswith(title)
    )


def test_what_is_for_the_page_is_refused(here, capsys):
    write(**dict(zip("ab", PLACED, strict=True)))
    for options in (["--repeat", "2"], ["--hold", "1"], ["--delay", "1"]):
        assert run(["a.svg", "b.svg", "-o", "blend.js", *options]) == 2
        assert "plays as its page says" in capsys.readouterr().err
    assert not Path("blend.js").exists()


def test_without_data_it_is_small():
    code = resources.files("shapeblend_cli.web").joinpath("module.js").read_bytes()
    assert len(gzip.compress(code, mtime=0)) < 3 * 1024
