"""The pages of docs/cookbook.md and coming-from.md in Chromium, each with what the command above it has written."""

import contextlib
import re
import subprocess
import threading
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest
from PIL import Image

from shapeblend_cli.cli import run
from tests.support.chromium import picture_of
from tests.support.documents import FENCE, ROOT, Command, furnish
from tests.support.equipment import INSTALLED, require

TEXT = "".join((ROOT / "docs" / f"{page}.md").read_text("utf-8") for page in ("cookbook", "coming-from"))
CDN = "https://cdn.jsdelivr.net/npm/"


class Recipe(NamedTuple):
    """A page, and the command that comes before it."""

    title: str
    command: str
    page: str


def recipes():
    found, command = [], ""
    for fence in FENCE.finditer(TEXT):
        if fence[1] == "sh":
            command = fence[2]
        if fence[1] == "html":
            title = re.findall(r"^## (.*)$", TEXT[: fence.start()], re.MULTILINE)[-1]
            found.append(Recipe(title, command, fence[2]))
    return found


RECIPES = recipes()


class Quiet(SimpleHTTPRequestHandler):
    """A server of files that says nothing."""

    def log_message(self, *words):
        pass


@pytest.fixture
def site(here):
    """The address of the working folder, which has the drawings that the cookbook names."""
    furnish()
    with ThreadingHTTPServer(("127.0.0.1", 0), partial(Quiet, directory=str(here))) as server:
        threading.Thread(target=server.serve_forever, args=(0.05,), daemon=True).start()
        yield f"http://127.0.0.1:{server.server_port}"
        server.shutdown()


def installed(route):
    """Answer for the network with what npm has installed, of the version that is asked for."""
    name, version, path = re.fullmatch(
        r"([\w-]+)@([\d.]+)/(.+)", route.request.url.removeprefix(CDN)
    ).groups()
    package = INSTALLED / "node_modules" / name
    assert f'"version": "{version}"' in (package / "package.json").read_text("utf-8")
    route.fulfill(path=package / path)


@contextlib.contextmanager
def opened(browser, site, recipe):
    """The page of a recipe, after its command."""
    if recipe.command:
        assert run(Command("", recipe.command).stages[0][1:]) == 0
    Path("index.html").write_text(f"<!doctype html><style>body {{margin: 0}}</style>{recipe.page}", "utf-8")
    with browser.new_context(viewport={"width": 100, "height": 100}) as context:
        page, wrong = context.new_page(), []
        page.on("pageerror", lambda error: wrong.append(error))
        page.route(f"{CDN}**", installed)
        page.goto(f"{site}/index.html")
        page.wait_for_load_state("networkidle")
        yield page
        assert wrong == []


def pictures(page, *waits):
    """What is seen after each of some milliseconds."""
    found = []
    for wait in waits:
        page.wait_for_timeout(wait)
        found.append(picture_of(page).tobytes())
    return found


@pytest.mark.parametrize("recipe", RECIPES, ids=lambda recipe: recipe.title)
def test_a_page_of_the_cookbook_moves_and_what_waits_for_clicks_does_so_then(recipe, site, browser):
    if CDN in recipe.page:
        require("what plays and morphs in pages")
    with opened(browser, site, recipe) as page:
        seen = set()
        if "click" in recipe.command + recipe.page:
            seen.update(pictures(page, 100, 200))
            assert len(seen) == 1
            page.mouse.click(24, 24)
        for _ in range(40):
            seen.update(pictures(page, 60))
            if len(seen) > 1:
                break
        assert len(seen) > 1
        if re.search(r'width="96"|width: 96\b', recipe.page):
            assert page.evaluate("document.querySelector('svg').getBoundingClientRect().width") == 96


def test_all_recipes_for_pages_are_here():
    assert len(RECIPES) == TEXT.count("```html") >= 6


BUNDLE = """
import { build } from "esbuild";
import { compile } from "svelte/compiler";
import { existsSync, readFileSync, writeFileSync } from "node:fs";
const folder = process.argv[1], svelte = `${folder}/Component.svelte`;
if (existsSync(svelte))
  writeFileSync(`${folder}/Component.js`, compile(readFileSync(svelte, "utf-8"), {}).js.code);
await build({
  entryPoints: [`${folder}/app.js`], outfile: `${folder}/bundle.js`, bundle: true, conditions: ["svelte", "browser"],
  format: "esm", jsx: "automatic", nodePaths: ["node_modules"], logLevel: "error",
});
"""


@contextlib.contextmanager
def bundled(browser, here, site, file, app):
    """A page with the component of the cookbook for a kind of file, which a bundler has put together."""
    require("what plays and morphs in pages")
    component = re.search(rf"^```{file.suffix[1:]}\n(.*?)^```$", TEXT, re.MULTILINE | re.DOTALL)[1]
    file.write_text(component, "utf-8")
    Path("app.js").write_text(app, "utf-8")
    (module,) = {recipe.command for recipe in RECIPES if recipe.title == "A blend in a web page"}
    page = '<body></body><script type="module" src="bundle.js"></script>'
    assert run(Command("", module).stages[0][1:]) == 0
    bundle = ["node", "--input-type=module", "-e", BUNDLE, str(here)]
    subprocess.run(bundle, cwd=INSTALLED, check=True)
    Path("blend.js").unlink()  # it is in the bundle
    with opened(browser, site, Recipe(file.name, "", page)) as shown:
        yield shown


def test_the_component_for_svelte_moves(here, site, browser):
    app = (
        'import { mount } from "svelte"; import Component from "./Component.js";'
        "mount(Component, { target: document.body });"
    )
    with bundled(browser, here, site, Path("Component.svelte"), app) as page:
        assert len(set(pictures(page, 60, 60, 60, 60))) > 1


def test_the_component_for_react_goes_on_and_back_as_it_is_pointed_at(here, site, browser):
    app = (
        'import { StrictMode, createElement } from "react"; import { createRoot } from "react-dom/client";'
        'import PlayPause from "./PlayPause.jsx";'
        "createRoot(document.body).render(createElement(StrictMode, {},"
        'createElement(PlayPause, { color: "#06c", display: "block" })));'
    )
    with bundled(browser, here, site, Path("PlayPause.jsx"), app) as page:
        page.mouse.move(99, 99)  # a browser without windows has it on the drawing first
        (first,) = set(pictures(page, 1000, 200))
        page.mouse.move(2, 48)
        assert len(set(pictures(page, 60, 60, 60, 60))) > 1
        (second,) = set(pictures(page, 800, 200))
        assert second != first
        box = page.locator("svg").bounding_box()
        assert (box["width"], box["height"]) == (96, 96)
        stroke = "getComputedStyle(document.querySelector('path')).stroke"
        assert page.evaluate(stroke) == "rgb(0, 102, 204)"
        page.mouse.move(99, 99)
        assert set(pictures(page, 1000, 200)) == {first}


def test_the_sprite_shows_one_cell_after_the_other(site, browser):
    (recipe,) = [recipe for recipe in RECIPES if recipe.title == "A sprite"]
    with opened(browser, site, recipe) as page:
        sheet = Image.open("sprite.png")
        white = Image.new("RGBA", sheet.size, "white")
        white.alpha_composite(sheet)
        for k in range(8):
            page.evaluate(
                f"const [moving] = document.getAnimations(); moving.pause(); moving.currentTime = {100 * k + 50}"
            )
            shown = picture_of(page, clip={"x": 0, "y": 0, "width": 64, "height": 64})
            cell = white.crop((3 + 67 * k, 3, 67 + 67 * k, 67))
            assert np.abs(np.asarray(shown, float) - np.asarray(cell.convert("RGB"))).mean() < 1.0
