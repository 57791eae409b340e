"""What the page of the studio looks like, and what it says: at a desk and on a phone."""

import json
import re

import pytest

from shapeblend_cli.options.easing import CURVES, NAMES
from shapeblend_cli.outputs.registry import FORMATS
from tests.support.documents import ROOT
from tests.support.studio_page import (
    SAMPLES,
    changed,
    choose_format,
    command,
    screen,
    settle,
    shape,
    unfold,
)

DESK = {"width": 1440, "height": 900}
PHONE = {"width": 390, "height": 844}
HINT = "Click a part of A, then the part of B that it becomes."


def box(page, selector):
    return page.locator(selector).bounding_box()


def overlap(one, other):
    return all(
        one[at] < other[at] + other[size] and other[at] < one[at] + one[size]
        for at, size in (("x", "width"), ("y", "height"))
    )


def crossed(page):
    """Pair the parts of the two drawings crosswise."""
    page.mouse.click(*screen(page, "a", (6, 6)))
    changed(page, lambda: page.mouse.click(*screen(page, "b", (18, 17))))


def ease(page, text):
    changed(page, lambda: (page.fill("#ease-text", text), page.press("#ease-text", "Enter")))


@pytest.mark.parametrize("is_timed", [False, True])
def test_at_a_desk_the_drawings_take_the_height_that_is_left(studio, is_timed):
    page = studio("two.svg", "swapped.svg", **DESK)
    if is_timed:
        page.click("#timeline-card > summary")
        assert box(page, "#bars")["height"] > 50
    sizes = [box(page, selector) for selector in ("#canvas-a", "#drawing", "#canvas-b")]
    assert min(min(size["width"], size["height"]) for size in sizes) > (140 if is_timed else 280)
    assert sizes[0]["x"] < sizes[1]["x"] < sizes[2]["x"]
    bottom = box(page, "#line")
    for selector in ("#film", "#verdict", "#timeline-card"):
        found = box(page, selector)
        assert found["y"] + found["height"] <= bottom["y"]
    assert bottom["y"] + bottom["height"] <= DESK["height"]


def test_what_designers_use_most_is_in_sight_and_it_is_seen_that_options_scroll(studio):
    page = studio(*SAMPLES, **DESK)
    room = box(page, "#options")
    for name in ("ease", "ease-text", "curve", "duration", "hold-a", "repeat", "trigger", "motion"):
        found = box(page, f"#{name}")
        assert room["y"] <= found["y"]
        assert found["y"] + found["height"] <= room["y"] + room["height"]
    is_more = "document.getElementById('options').classList.contains('is-more')"
    assert page.evaluate(is_more)
    page.evaluate("document.getElementById('options').scrollTo(0, 1e6)")
    page.wait_for_function(f"() => !{is_more}")


@pytest.mark.parametrize("look", [DESK, PHONE])
def test_an_error_is_beside_its_field_which_is_marked(studio, look):
    page = studio(*SAMPLES, **look)
    unfold(page)
    ease(page, "no easing")
    assert page.inner_text("#broken-says").startswith("--ease must be ")
    assert page.get_attribute("#ease-text", "aria-invalid") == "true"
    assert not overlap(box(page, "#broken"), box(page, "#ease-text"))
    assert box(page, "#broken-close")["height"] <= 44
    assert "must be" not in page.inner_text("#others-says")
    ease(page, "ease-in")
    assert page.locator("[aria-invalid]").count() == 0
    changed(page, lambda: (page.fill("#output", "blend.xyz"), page.press("#output", "Enter")))
    assert page.get_attribute("#output", "aria-invalid") == "true"
    page.click("#write")
    page.wait_for_selector("#written:has-text('Nothing was written.')")


def test_what_was_done_is_said_until_something_else_is(studio):
    page = studio("two.svg", "swapped.svg")
    crossed(page)
    assert page.inner_text("#says") == "Part 0 of A becomes part 1 of B."
    changed(page, lambda: page.click("#undo"))
    assert page.inner_text("#says") == "Undone: pair."
    ease(page, "ease")
    assert page.inner_text("#says") == HINT
    page.clock.install()
    changed(page, lambda: page.click("#undo"))
    assert page.inner_text("#says") == "Undone: easing."
    page.clock.run_for(7000)
    assert page.inner_text("#says") == HINT


def test_what_was_done_before_a_reload_can_be_undone_after_it(studio):
    page = studio("two.svg", "swapped.svg")
    page.on("dialog", lambda dialog: dialog.accept())
    first = shape(page)
    crossed(page)
    ease(page, "ease")
    changed(page, lambda: page.click("#undo"))
    for _ in range(2):
        page.reload()
        page.wait_for_selector("html[data-ready]")
        settle(page)
    changed(page, lambda: page.click("#redo"))
    assert command(page).endswith("--match 0=1 --ease ease")
    for _ in range(2):
        changed(page, lambda: page.click("#undo"))
    assert (command(page), shape(page)) == ("shapeblend two.svg swapped.svg", first)
    assert page.is_disabled("#undo")
    # Another studio knows nothing of it.
    assert studio("two.svg", "swapped.svg").is_disabled("#undo")


def test_the_command_line_is_seen_whole_with_corrections(studio):
    pins = ((3 + 0.123, 3, 3, 3), (10, 10.5, 9, 10.25))
    page = studio(
        "two.svg", "swapped.svg", **DESK, pins=tuple((complex(a, b), complex(c, d)) for a, b, c, d in pins)
    )
    crossed(page)
    ease(page, "cubic-bezier(0.3,0.1,0.2,1.1)")
    assert page.evaluate("(({ scrollHeight, clientHeight }) => scrollHeight - clientHeight)(command)") <= 0


def test_every_option_says_what_it_does_and_is_found(studio):
    page = studio(*SAMPLES, **DESK)
    unfold(page)
    assert "Seconds before" in page.inner_text("#option-delay-help")
    assert page.get_attribute("#option-delay", "aria-describedby") == "option-delay-help"
    assert page.get_attribute("#option-delay", "placeholder") == "0"
    cut = page.evaluate(
        """[...document.querySelectorAll("#all input")].filter(input => {
          const line = document.createElement("canvas").getContext("2d");
          line.font = getComputedStyle(input).font;
          return line.measureText(input.placeholder).width > input.clientWidth - 20;
        }).map(input => input.id)"""
    )
    assert cut == []
    words = page.evaluate(
        "[...document.getElementById(`option-trigger`).list.options].map(word => word.value)"
    )
    assert words == ["load", "click", "hover"]
    page.fill("#find", "crumb dust")
    assert page.is_visible("#none-found")
    page.fill("#find", "trigger")
    assert page.is_visible("#option-trigger")
    assert not page.is_visible("#option-delay")


def test_what_a_format_takes_is_asked_for_beside_it(studio):
    page = studio(*SAMPLES, output="blend.svg", **DESK)
    for name in ("width", "fps", "background", "columns", "lossless"):
        assert not page.is_visible(f"#option-{name}")
    changed(page, lambda: page.select_option("#trigger", "hover"))
    assert "--trigger hover" in command(page)
    changed(page, lambda: choose_format(page, "GIF"))
    assert "--trigger" not in command(page)
    assert page.is_disabled("#trigger")
    assert page.get_attribute("#option-width", "placeholder") == "400"
    changed(page, lambda: (page.fill("#option-width", "300"), page.keyboard.press("Enter")))
    changed(page, lambda: (page.fill("#option-fps", "10"), page.keyboard.press("Enter")))
    changed(page, lambda: choose_format(page, "WebP"))
    assert "--width 300" in command(page)
    assert "--fps 10" in command(page)
    assert page.is_visible("#option-lossless")
    changed(page, lambda: choose_format(page, "Contact sheet"))
    assert "--width 300" in command(page)
    assert "--fps" not in command(page)
    for number in range(len(FORMATS)):
        if page.input_value("#format") != str(number):
            changed(page, lambda number=number: page.select_option("#format", index=number))
        assert not page.is_visible("#broken"), page.inner_text("#broken")


def test_all_easings_of_the_command_are_offered(studio):
    page = studio(*SAMPLES)
    words = page.locator("#ease option").all_text_contents()
    assert {*NAMES, *CURVES} <= set(words)
    changed(page, lambda: page.select_option("#ease", "elastic-in-out"))
    assert command(page).endswith("--ease elastic-in-out")


def test_on_a_phone_nothing_lies_on_what_is_shown(studio):
    page = studio("two.svg", "swapped.svg", touch=True, **PHONE)
    crossed(page)
    lines = "e => e.getBoundingClientRect().height / parseFloat(getComputedStyle(e).lineHeight)"
    assert page.locator("#unsaved").evaluate(lines) < 1.5
    bar = box(page, "#to-export")
    assert (bar["x"], bar["width"], bar["y"] + bar["height"]) == (0, PHONE["width"], PHONE["height"])
    page.evaluate("scrollTo(0, 1e6)")
    last = box(page, "#keys")
    assert last["y"] + last["height"] <= bar["y"]


def test_a_project_is_saved_again_without_a_question(studio, here):
    page = studio("two.svg", "swapped.svg")
    for text in ("ease", "ease-in"):
        ease(page, text)
        page.click("#save")
        page.wait_for_selector("#notice:has-text('Saved blend.json')")
        page.click("#notice-close")
        assert json.loads((here / "blend.json").read_text())["ease"] == text
    (here / "blend.json").write_text("somebody else's")
    page.click("#save")
    page.wait_for_selector(f"#notice:has-text('There already: {here / 'blend.json'}.')")
    assert (here / "blend.json").read_text() == "somebody else's"
    page.click("#notice-do")
    page.wait_for_selector("#notice:has-text('Saved blend.json')")


def test_nodes_of_a_fine_drawing_leave_it_in_sight(studio, here):
    for name in ("car.svg", "bus.svg"):
        (here / name).write_bytes((ROOT / "docs" / "studio" / name).read_bytes())
    page = studio("car.svg", "bus.svg", width=1280, height=700)
    page.keyboard.press("2")
    size = "e => parseFloat(getComputedStyle(e).strokeWidth)"
    near = page.locator("#canvas-b .nodes.under").evaluate(size)
    for _ in range(5):
        page.keyboard.press("+")
    assert near < page.locator("#canvas-b .nodes.under").evaluate(size) <= 7


def test_a_mixture_is_not_shown_but_said(studio):
    page = studio(*SAMPLES)
    unfold(page)
    changed(page, lambda: (page.fill("#option-mix", ".5,.5"), page.press("#option-mix", "Enter")))
    assert re.match("--mix makes mixtures, which the studio does not show", page.inner_text("#broken-says"))
    assert page.get_attribute("#option-mix", "aria-invalid") == "true"
    changed(page, lambda: (page.fill("#option-mix", ""), page.press("#option-mix", "Enter")))
    assert not page.is_visible("#broken")
