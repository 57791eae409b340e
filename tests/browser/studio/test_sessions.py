"""Thirty sessions in the studio, each a row of things that users do: nothing goes wrong, whatever comes after what."""

import random
import re

import pytest

from tests.support.documents import ROOT
from tests.support.studio_page import choose_format, command, drag, nodes, screen, settle, shape, unfold

DRAWINGS = {
    "studio": "car bus clouds rain run walk sun moon".split(),
    "moving/drawings": "fox wolf egg hatching-chick tulip sunflower".split(),
    "icons/lucide": "menu x bell bell-off".split(),
    "icons/phosphor": "eye eye-slash".split(),
}
PAIRS = [
    (f"{folder}/{a}.svg", f"{folder}/{b}.svg")
    for folder, names in DRAWINGS.items()
    for a, b in zip(names[::2], names[1::2], strict=True)
]
STEPS = 10
DEEDS = "pair pin stiffen keys undo swap move time wire export play remove look".split()
KEYS = "Tab ArrowRight ArrowLeft ArrowUp ArrowDown Enter Escape Space 1 2 3 + - 0 Control+z Control+y".split()


class User:
    """Somebody who does this and that with a page."""

    def __init__(self, page, seed):
        self.page, self.random = page, random.Random(seed)
        self.page.on("dialog", lambda dialog: dialog.accept())

    def place(self, side):
        number = self.random.randrange(self.page.locator(f"#canvas-{side} .part").count())
        return screen(self.page, side, self.random.choice(nodes(self.page, side, number)))

    def to_drawings(self):
        self.page.locator("#canvas-a").scroll_into_view_if_needed()

    def pair(self):
        self.page.click("[data-tool=pair]")
        self.to_drawings()
        for side in "ab":
            self.page.mouse.click(*self.place(side))

    def pin(self):
        self.page.click("[data-tool=pin]")
        self.to_drawings()
        drag(self.page, self.place("a"), self.place("b"))
        self.page.mouse.up()

    def stiffen(self):
        self.page.click("[data-tool=stiff]")
        self.to_drawings()
        drag(self.page, self.place("a"), self.place("a"))
        self.page.mouse.up()

    def keys(self):
        for key in self.random.choices(KEYS, k=8):
            self.page.keyboard.press(key)

    def undo(self):
        button = self.page.locator(self.random.choice(["#undo", "#redo"]))
        if button.is_enabled():
            button.click()

    def swap(self):
        self.page.click("#swap")

    def move(self):
        self.page.select_option("#motion", self.random.choice(["auto", "linear", "rigid", "intrinsic"]))
        self.page.fill("#ease-text", self.random.choice(["linear", "back", "spring(1,180,12)", "no easing"]))
        self.page.keyboard.press("Enter")

    def time(self):
        grips = self.page.locator(".grip:visible")
        if count := grips.count():
            grip = grips.nth(self.random.randrange(count))
            grip.press(self.random.choice(["ArrowRight", "Shift+ArrowLeft", "Delete"]))
        self.page.fill("#stagger", str(self.random.choice([0, 0.3, 0.6])), force=True)

    def wire(self):
        sliders = self.page.locator("#constants input")
        sliders.nth(self.random.randrange(sliders.count())).press("PageUp")

    def export(self):
        choose_format(
            self.page, self.random.choice(["Animated SVG", "GIF", "Lottie", "JavaScript", "PNG frames"])
        )
        self.page.click("#write")

    def play(self):
        self.page.click("#play")
        self.page.fill("#time", f"{self.random.random():.2f}")

    def remove(self):
        buttons = self.page.locator("#corrections [aria-label^=Remove]")
        if buttons.count():
            buttons.first.click()

    def look(self):
        for name in self.random.sample(["show-tint", "show-onion", "show-parts"], 2):
            self.page.evaluate("name => document.getElementById(name).click()", name)
        self.page.click("#theme")


@pytest.mark.parametrize("seed", range(30))
def test_nothing_goes_wrong_whatever_comes_after_what(studio, here, seed):
    files = PAIRS[seed % len(PAIRS)]
    for file in files:
        (here / file.rpartition("/")[2]).write_bytes((ROOT / "docs" / file).read_bytes())
    names = [file.rpartition("/")[2] for file in files]
    page = studio(
        *names, width=390 if seed % 2 else 1440, height=844 if seed % 2 else 900, touch=seed % 4 == 1
    )
    unfold(page)
    user = User(page, seed)
    deeds = ["keys"] if seed % 5 == 4 else DEEDS
    for _ in range(STEPS):
        getattr(user, user.random.choice(deeds))()
        page.evaluate(
            "for (const name of ['broken', 'notice']) document.getElementById(`${name}-close`).click()"
        )
        settle(page)
    assert not re.search("NaN|undefined", page.inner_text("body") + shape(page))
    assert command(page).startswith(tuple(f"shapeblend {name}" for name in names))
