"""Modules of JavaScript in Chromium: what they show at any time, and how they play."""

import gzip
import subprocess
from importlib import resources
from pathlib import Path

import pytest

import shapeblend_cli as sb
from shapeblend_cli.cli import run
from tests.support.commands import write
from tests.support.documents import ROOT
from tests.support.drawings import EYED, LEAF, svg
from tests.support.equipment import INSTALLED, require
from tools.icons import pairs_in

pytestmark = pytest.mark.usefixtures("blended_once")

SAMPLES = ROOT / "samples"
ICONS = ROOT / "docs" / "icons"
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
PAIRS |= {
    pair["id"]: tuple((ICONS / pair[side]).read_text() for side in "ab")
    for pair in [*pairs_in(ICONS, "lucide")[1::2], *pairs_in(ICONS, "phosphor")[::2]]
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


OFF = """([text, share]) => {
    const visible = (root) => [...root.querySelectorAll("svg > path, svg > g path")]
        .filter((path) => getComputedStyle(path).visibility !== "hidden");
    const svg = document.querySelector("svg"), {width, height} = svg.viewBox.baseVal;
    const reach = share * Math.max(width, height);
    const board = document.createElement("div");
    board.innerHTML = text;
    document.body.append(board);
    const bare = (paths) => paths.map((path) => {
        const copy = document.createElementNS("http://www.w3.org/2000/svg", "path");
        copy.setAttribute("d", path.getAttribute("d"));
        copy.style.cssText = `stroke: red; stroke-width: ${2 * reach}px; stroke-linecap: round; stroke-linejoin: round`;
        board.firstElementChild.append(copy);
        return copy;
    });
    const [shown, wanted] = [visible(svg), visible(board)].map(bare);
    const pointsOf = (path, count) => {
        const length = path.getTotalLength();
        return Array.from({length: count}, (_, k) => path.getPointAtLength(length * k / count));
    };
    // Chromium's strokes of nearly flat curves have holes: there the nearest of many points counts.
    const dots = new Map();
    const dotsOf = (path) => {
        if (!dots.has(path))
            dots.set(path, pointsOf(path, 2000).map(({x, y}) => [x, y]));
        return dots.get(path);
    };
    const isNear = ({x, y}, other) => dotsOf(other).some(([u, v]) => Math.hypot(u - x, v - y) < reach);
    // A path of the same place in the order is most likely the one.
    const isOn = (one, others, k) => others[k]?.isPointInStroke(one)
        || others.some((other) => other.isPointInStroke(one)) || others.some((other) => isNear(one, other));
    // Points of the one that lie on no outline of the other.
    const off = (some, others) => some.flatMap((path, place) => path.getTotalLength() <= reach ? [] :
        pointsOf(path, 100).filter((one) => !isOn(one, others, place)).map(({x, y}) => [x, y]));
    const found = [...off(shown, wanted), ...off(wanted, shown)];
    board.remove();
    return found;
}"""


def test_what_is_shown_is_compared_for_forty_pairs():
    assert len(PAIRS) >= 40


@pytest.mark.parametrize("name", PAIRS)
def test_its_outlines_are_those_of_frames(name, module):
    page = module(PAIRS[name])
    page.evaluate("window.show = blend.mount(document.querySelector('svg'))")
    blend = sb.blend("a.svg", "b.svg")
    for t in TIMES:
        page.evaluate(f"show({t})")
        assert page.evaluate(OFF, [blend.frame(t).svg, 1e-3]) == [], t


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


SIZED = [(ICONS / "lucide" / f"{name}.svg").read_text() for name in ("menu", "x")]
SIZES = {
    "no size": ("<svg></svg>", "", [28, 28]),
    "a width": ('<svg width="96"></svg>', "", [96, 96]),
    "a height": ('<svg height="48"></svg>', "", [48, 48]),
    "a width and a height": ('<svg width="96" height="48"></svg>', "", [96, 48]),
    "a width in an attribute style": ('<svg style="width: 6em; font-size: 10px"></svg>', "", [60, 60]),
    "a height in a sheet": ("<svg></svg>", "svg { height: 40px }", [40, 40]),
    "an item that grows": ("<svg></svg>", "body { display: flex; width: 80px } svg { flex: 1 }", [80, 80]),
}


@pytest.mark.parametrize(("markup", "rules", "size"), SIZES.values(), ids=SIZES)
def test_a_size_in_the_page_is_kept_else_there_is_that_of_the_file(markup, rules, size, module):
    wide = SIZED[0].replace('"24"', '"28"').replace('"0 0 24 24"', '"-2 -2 28 28"')  # the view moves, too
    page = module((wide, SIZED[1]), "--place", "asis")
    page.set_content(f"<!doctype html><style>body {{ margin: 0 }} {rules}</style>{markup}")
    found = page.evaluate("""() => {
        const svg = document.querySelector("svg");
        const size = () => { const { width, height } = svg.getBoundingClientRect(); return [width, height]; };
        const show = blend.mount(svg), first = size();
        show(0.5);
        const second = size();
        blend.animate(svg).seek(1);  // as React does in strict mode
        return [first, second, size(), svg.getAttribute("viewBox")];
    }""")
    assert found == [size, size, size, "0 0 24 24"]


def test_the_svg_element_of_a_page_keeps_its_name(module):
    named = [each.replace("<svg ", '<svg id="drawing" ') for each in SIZED]
    assert (
        module(named).evaluate("""() => {
        const svg = document.querySelector("svg");
        svg.id = "icon";
        blend.mount(svg)(0.5);
        return svg.id;
    }""")
        == "icon"
    )


def test_labels_of_inkscape_are_left_out(module):
    labels = '<svg xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape"', '<path inkscape:label="box"'
    labelled = [each.replace("<svg", labels[0]).replace("<path", labels[1]) for each in PLACED]
    page = module(labelled)
    page.evaluate("blend.mount(document.querySelector('svg'))(1)")
    assert page.evaluate("document.querySelector('path').getBBox().x") == 14


def test_it_has_the_text_colour_of_its_page(module):
    page = module(SIZED)
    page.set_content('<body style="color: #06c"><svg></svg><shape-blend></shape-blend></body>')
    assert (
        page.evaluate("""() => {
        blend.mount(document.querySelector("svg"))(0.5);
        document.querySelector("shape-blend").player.seek(0.5);
        return [document, document.querySelector("shape-blend").shadowRoot]
            .map((root) => getComputedStyle(root.querySelector("path")).stroke);
    }""")
        == ["rgb(0, 102, 204)"] * 2
    )


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


def test_thirty_contours_take_little_more_than_frames_that_are_ready(module):
    """To work out a frame takes no longer than a few times what the browser needs to lay out a ready one."""
    places = [(x, y) for x in range(0, 60, 10) for y in range(5, 50, 10)]
    rings = [
        "".join(f'<path d="M{x} {y}q2 -3 4 0t4 0v3q-4 {bend} -8 0z"/>' for x, y in places) for bend in (2, 6)
    ]
    page = module([svg(ring, attributes='fill="#345"') for ring in rings])
    ready, worked = page.evaluate("""() => {
        const svg = document.querySelector("svg"), show = blend.mount(svg), count = 240;
        const paths = [...svg.querySelectorAll("path")];
        const frames = Array.from({length: count}, (_, k) => blend.at(k / count));
        const time = (draw) => {
            const began = performance.now();
            for (let k = 0; k < count; k += 1) {
                draw(k);
                svg.getBoundingClientRect();  // so that it is laid out
            }
            return (performance.now() - began) / count;
        };
        const set = (k) => paths.forEach((path, n) => {
            for (const [name, value] of Object.entries(frames[k][n])) path.setAttribute(name, value);
        });
        time(set);
        return [time(set), time((k) => show(k / count))];
    }""")
    assert page.evaluate("blend.at(0.5).length") >= 30
    assert worked < 12 * ready


TYPED = """
import { Player, animate, at, define, duration, ease, interpolate, mount } from "./blend.js";
const data: string = interpolate(0)(0.5);
const player: Player = animate(document.querySelector("svg")!, { loop: 2, alternate: true, easing: ease });
player.play().reverse().to(1).seek(0.5).pause();
mount(document.querySelector("svg")!)(0.5);
define("my-blend");
const fill: string = at(duration / 1000)[0].fill;
// @ts-expect-error: a time is a number
at("now");
// @ts-expect-error: what is drawn into is an element
mount("svg");
// @ts-expect-error: nothing is called so
animate(document.querySelector("svg")!, { speed: 2 });
"""


def test_its_types_are_those_of_its_functions(here):
    require("what plays and morphs in pages")
    write(**dict(zip("ab", PLACED, strict=True)))
    assert run(["a.svg", "b.svg", "-o", "blend.js", "-q"]) == 0
    Path("use.ts").write_text(TYPED)
    compiler = INSTALLED / "node_modules" / "typescript" / "bin" / "tsc"
    options = "--noEmit --strict --allowJs --target es2023 --module esnext --lib es2023,dom --moduleResolution bundler"
    done = subprocess.run(["node", compiler, *options.split(), "use.ts"], capture_output=True, text=True)
    assert done.stdout == ""
    assert done.returncode == 0
