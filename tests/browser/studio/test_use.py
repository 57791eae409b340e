"""The studio in a real browser: drawings are corrected by mouse, by finger and by keyboard, and exported."""

import json
import re
import shlex

import pytest

from shapeblend_cli.cli import run
from shapeblend_cli.rows.project import read_project
from tests.browser.test_images import WITH_PICTURES, shown_in, written
from tests.browser.test_preview import CONTRASTS
from tests.studio.test_safety import HOSTILE
from tests.support.commands import write
from tests.support.documents import ROOT
from tests.support.drawings import svg
from tests.support.pictures import difference, pixels
from tests.support.studio_page import (
    SAMPLES,
    SWAPPED,
    TWO,
    changed,
    choose_format,
    command,
    drag,
    nodes,
    screen,
    settle,
    shape,
    unfold,
)


def test_a_pin_is_dragged_and_the_blend_follows_while_it_is_dragged(studio):
    page = studio(*SAMPLES)
    before = shape(page)
    page.click("[data-tool=pin]")
    start, end = screen(page, "a", nodes(page, "a")[0]), screen(page, "b", nodes(page, "b")[12])
    changed(page, lambda: drag(page, start, end))
    tried = shape(page)
    assert tried != before
    assert "--pin" not in command(page)  # it is not let go yet
    changed(page, page.mouse.up)
    assert "--pin" in command(page)
    assert shape(page) == tried
    assert page.locator("#corrections li").count() == 1
    # Its other end is moved.
    goal = screen(page, "b", nodes(page, "b")[40])
    changed(page, lambda: (drag(page, end, goal), page.mouse.up()))
    assert page.locator("#corrections li").count() == 1
    assert shape(page) != tried
    changed(page, lambda: page.click("#corrections [aria-label^=Remove]"))
    assert shape(page) == before
    assert command(page) == "shapeblend bird-1.svg bird-2.svg"


def test_parts_are_paired_by_two_clicks_undone_and_done_again(studio):
    page = studio("two.svg", "swapped.svg")
    before = shape(page)
    colours = [page.get_attribute(f"#canvas-{side} [data-number='0']", "fill") for side in "ab"]
    assert colours[0] == colours[1]
    page.mouse.click(*screen(page, "a", (6, 6)))
    assert page.locator("#canvas-a .chosen").get_attribute("data-number") == "0"
    changed(page, lambda: page.mouse.click(*screen(page, "b", (18, 17))))
    crossed = shape(page)
    assert crossed != before
    assert command(page) == "shapeblend two.svg swapped.svg --match 0=1"
    fill = {
        (side, k): page.get_attribute(f"#canvas-{side} [data-number='{k}']", "fill")
        for side in "ab"
        for k in range(2)
    }
    assert fill["a", 0] == fill["b", 1] != fill["a", 1] == fill["b", 0]
    changed(page, lambda: page.click("#undo"))
    assert (shape(page), command(page)) == (before, "shapeblend two.svg swapped.svg")
    changed(page, lambda: page.keyboard.press("Control+Shift+Z"))
    assert shape(page) == crossed
    changed(page, lambda: page.keyboard.press("Control+z"))
    assert shape(page) == before


def test_a_stretch_is_stiffened_by_dragging_along_it(studio):
    page = studio(*SAMPLES)
    page.click("[data-tool=stiff]")
    some = [screen(page, "a", point) for point in nodes(page, "a")[0:16:3]]
    page.mouse.move(*some[0])
    page.mouse.down()
    for point in some[1:]:
        page.mouse.move(*point, steps=5)
    assert page.locator("#canvas-a .stiff").count() == 1
    changed(page, page.mouse.up)
    assert re.search(r"--stiff [\d.]+,[\d.]+,[\d.]+=4", command(page))
    changed(page, lambda: (page.fill("#corrections input", "9"), page.keyboard.press("Enter")))
    assert "=9" in command(page)


def test_sliders_and_fields_change_the_blend_and_the_command(studio):
    page = studio(*SAMPLES)
    page.click("#wire-card summary")
    before = shape(page)
    page.focus("#constant-kt")
    changed(page, lambda: page.keyboard.press("Home"))
    assert "--kt 0.221" in command(page)
    assert shape(page) != before
    changed(page, lambda: page.click("#constants-reset"))
    assert shape(page) == before
    changed(page, lambda: page.select_option("#motion", "linear"))
    changed(page, lambda: page.select_option("#ease", "ease-in-out"))
    assert command(page).endswith("--motion linear --ease ease-in-out")
    page.click("#all-card summary")
    changed(page, lambda: (page.fill("#option-vertices", "40"), page.keyboard.press("Enter")))
    assert "--vertices 40" in command(page)
    changed(page, lambda: page.select_option("#option-curves", "polygons"))
    assert "--polygons" in command(page)
    changed(page, lambda: (page.fill("#option-vertices", "-4"), page.keyboard.press("Enter")))
    assert "vertices must be 0 or more, not -4" in page.inner_text("#broken")
    changed(page, lambda: page.click("#undo"))
    assert not page.is_visible("#broken")


def test_the_export_is_what_the_shown_command_line_writes(studio, here):
    page = studio("two.svg", "swapped.svg")
    page.mouse.click(*screen(page, "a", (6, 6)))
    changed(page, lambda: page.mouse.click(*screen(page, "b", (18, 17))))
    changed(page, lambda: choose_format(page, "Animated SVG"))
    changed(page, lambda: (page.fill("#output", "moving.svg"), page.keyboard.press("Enter")))
    page.click("#write")
    page.wait_for_selector("#written:has-text('Wrote moving.svg')")
    made = (here / "moving.svg").read_bytes()
    page.click("#write")
    page.wait_for_selector(f"#written:has-text('There already: {here / 'moving.svg'}.')")
    page.click("text=Replace what is there")
    page.wait_for_selector("#written:has-text('Wrote moving.svg')")
    words = shlex.split(command(page))
    assert words[:2] == ["shapeblend", "two.svg"]
    assert run([*words[1:], "--force"]) == 0
    assert (here / "moving.svg").read_bytes() == made


def test_what_would_be_written_elsewhere_is_asked_about_with_its_path(studio, here):
    page = studio("two.svg", "swapped.svg", folder="own", output="own/../made.svg")
    page.click("#write")
    page.wait_for_selector(f"#written:has-text('Not in the folder of this project: {here / 'made.svg'}.')")
    assert not (here / "made.svg").exists()
    page.click("text=Write there")
    page.wait_for_selector("#written:has-text('Wrote own/../made.svg')")
    assert (here / "made.svg").exists()
    changed(page, lambda: (page.fill("#output", "-"), page.keyboard.press("Enter")))
    page.click("#write")
    page.wait_for_selector("#written:has-text('cannot write to standard output')")
    assert not page.is_visible("#replace")


def test_a_project_is_saved_and_opened_again(studio, here):
    page = studio("two.svg", "swapped.svg")
    page.mouse.click(*screen(page, "a", (6, 6)))
    changed(page, lambda: page.mouse.click(*screen(page, "b", (18, 17))))
    corrected = shape(page)
    page.click("#save")
    page.wait_for_selector("#notice:has-text('Saved blend.json')")
    project = read_project("blend.json")
    again = studio(*project.files, **project.given)
    assert shape(again) == corrected
    assert command(again) == command(page)


def test_drawings_are_dropped_and_blended(studio, here):
    page = studio()
    assert page.is_visible("#empty")
    changed(page, lambda: drop(page, {name: (here / name).read_text() for name in SAMPLES}))
    assert command(page) == "shapeblend bird-1.svg bird-2.svg"
    assert shape(page)
    # One that is dropped onto B takes its place.
    x, y = screen(page, "b", nodes(page, "b")[0])
    assert not page.is_visible("#absent")
    changed(page, lambda: drop(page, {"new.svg": (here / "leaf.svg").read_text()}, (x, y)))
    assert command(page) == "shapeblend bird-1.svg new.svg"
    assert page.inner_text("#absent") == "It expects new.svg where it is used."
    changed(page, lambda: page.click("#undo"))
    assert command(page) == "shapeblend bird-1.svg bird-2.svg"


def test_what_is_dropped_by_mistake_takes_no_work_away(studio, here):
    page = studio("two.svg", "swapped.svg", match=["0=1"])
    onto_b = screen(page, "b", (18, 17))
    for name, place, why in (
        ("readme.txt", onto_b, "neither a drawing, .svg or .svgz, nor a project, .json"),
        ("picture.png", (5, 5), "neither a drawing"),
        ("leaf.svg", (5, 5), "dropped onto A or B it takes the place of that one"),
    ):
        drop(page, {name: (here / "leaf.svg").read_text()}, place)
        page.wait_for_selector(f"#broken-says:has-text('{name}: ')")
        assert why in page.inner_text("#broken-says")
        assert command(page) == "shapeblend two.svg swapped.svg --match 0=1"
    changed(page, lambda: drop(page, {"leaf.svgz": (here / "leaf.svg").read_text()}, onto_b))
    assert command(page) == "shapeblend two.svg leaf.svgz"
    assert not page.is_visible("#broken")


def drop(page, files, at=(200, 200)):
    """Drop files, by name with their texts."""
    page.evaluate(
        """([files, [clientX, clientY]]) => {
          const dataTransfer = new DataTransfer();
          for (const [name, text] of Object.entries(files)) dataTransfer.items.add(new File([text], name));
          for (const kind of ["dragenter", "dragover", "drop"]) {
            const told = { dataTransfer, clientX, clientY, bubbles: true, cancelable: true };
            document.body.dispatchEvent(new DragEvent(kind, told));
          }
        }""",
        [files, list(at)],
    )


def test_all_of_it_is_done_by_keyboard_alone(studio, here):
    page = studio("two.svg", "swapped.svg")
    press = page.keyboard.press
    before = shape(page)

    def tab_to(name):
        for _ in range(80):
            if page.evaluate("document.activeElement.id") == name:
                return
            press("Tab")
        raise AssertionError(f"{name} is not reached")

    # Parts are paired.
    tab_to("canvas-a")
    assert "A: part" in page.inner_text("#says")
    while "part 0 " not in page.inner_text("#says"):
        press("ArrowRight")
    press("Enter")
    assert page.evaluate("document.activeElement.id") == "canvas-b"
    press("ArrowRight")
    assert "B: part 1" in page.inner_text("#says")
    changed(page, lambda: press("Enter"))
    assert command(page).endswith("--match 0=1")
    crossed = shape(page)
    changed(page, lambda: press("Control+z"))
    assert shape(page) == before
    changed(page, lambda: press("Control+y"))
    assert shape(page) == crossed
    # A point is pinned.
    press("2")
    tab_to("canvas-a")
    press("ArrowRight")
    press("Enter")
    assert page.evaluate("document.activeElement.id") == "canvas-b"
    changed(page, lambda: press("ArrowRight"))  # it is tried where the cursor is
    changed(page, lambda: press("Enter"))
    assert re.search(r"--pin [\d.,]+:[\d.,]+ --match 0=1", command(page))
    # Something held is let go.
    press("Shift+Tab")
    press("Enter")
    press("Escape")
    assert page.locator(".end").count() == 0
    # Another blend is chosen.
    page.wait_for_selector("#others:not([aria-busy]) button:nth-child(2)")
    page.evaluate("() => document.querySelector('#others button:nth-child(2)').id = 'second'")
    tab_to("second")
    others = page.get_attribute("#second", "title")
    before_it = shape(page)
    changed(page, lambda: press("Enter"))
    assert command(page).endswith(others)
    chosen = shape(page)
    assert chosen != before_it
    changed(page, lambda: press("Control+z"))
    assert shape(page) == before_it
    changed(page, lambda: press("Control+y"))
    assert shape(page) == chosen
    changed(page, lambda: press("Control+z"))
    # A stretch is stiffened.
    press("3")
    tab_to("canvas-a")
    press("Enter")
    press("ArrowRight")
    changed(page, lambda: press("Enter"))
    assert "--stiff" in command(page)
    # A format is chosen, and it is exported.
    tab_to("format")
    changed(page, lambda: press("ArrowDown"))
    while not page.input_value("#output").endswith(".svg"):
        changed(page, lambda: press("ArrowDown"))
    tab_to("write")
    press("Enter")
    page.wait_for_selector("#written:has-text('Wrote blend.svg')")
    made = (here / "blend.svg").read_bytes()
    assert run([*shlex.split(command(page))[1:], "--force"]) == 0
    assert (here / "blend.svg").read_bytes() == made


def test_on_a_phone_parts_are_paired_and_points_pinned_by_taps(studio, here):
    page = studio("two.svg", "swapped.svg", width=390, height=844, touch=True)
    before = shape(page)
    tap = page.touchscreen.tap
    tap(*screen(page, "a", (6, 6)))
    changed(page, lambda: tap(*screen(page, "b", (18, 17))))
    assert command(page).endswith("--match 0=1")
    changed(page, lambda: page.tap("#undo"))
    assert shape(page) == before
    changed(page, lambda: page.tap("#redo"))
    page.tap("[data-tool=pin]")
    tap(*screen(page, "a", (3, 3)))
    changed(page, lambda: tap(*screen(page, "b", (23, 23))))
    assert "--pin 3,3:23,23" in command(page)
    # What is pinned is dragged on by a finger.
    pinned = shape(page)
    fingers = page.context.new_cdp_session(page)
    start, end = screen(page, "b", (23, 23)), screen(page, "b", (12, 13))

    def finger(kind, *points):
        told = [{"x": x, "y": y} for x, y in points]
        fingers.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": told})

    finger("touchStart", start)
    finger("touchMove", ((start[0] + end[0]) / 2, (start[1] + end[1]) / 2))
    changed(page, lambda: (finger("touchMove", end), finger("touchEnd")))
    assert "--pin 3,3:12,13" in command(page)
    assert shape(page) != pinned
    # Another blend is chosen.
    page.tap("#others-card summary")
    page.wait_for_selector("#others:not([aria-busy]) button:nth-child(2)")
    changed(page, lambda: page.tap("#others button:nth-child(2)"))
    changed(page, lambda: page.tap("#undo"))
    # All of it is exported.
    choose_format(page, "Animated SVG")
    settle(page)
    with page.expect_download() as begun:
        page.tap("#download")
    made = begun.value.path().read_bytes()
    assert begun.value.suggested_filename == "blend.svg"
    assert not (here / "blend.svg").exists()
    assert run(shlex.split(command(page))[1:]) == 0
    assert (here / "blend.svg").read_bytes() == made


@pytest.mark.parametrize("files", [(), SAMPLES])
def test_on_a_phone_nothing_is_wider_than_the_screen_or_too_small_for_a_finger(studio, files):
    page = studio(*files, width=390, height=844, touch=True)
    unfold(page)
    if files:
        page.wait_for_selector("#others:not([aria-busy]) button")
    assert page.evaluate("document.documentElement.scrollWidth") == 390
    if files:
        page.evaluate("document.getElementById('timeline-card').hidden = false")
        menu = page.locator("#stagger-by")
        wanted = "(menu) => { menu.style.flex = 'none'; return menu.offsetWidth; }"
        assert menu.evaluate("(menu) => menu.offsetWidth") == menu.evaluate(wanted)
    small = page.evaluate(
        """[...document.querySelectorAll("button, select, a.button, summary, input:not([hidden]):not([type=checkbox])")]
        .map(e => [e.id || e.textContent, e.getBoundingClientRect()])
        .filter(([_, box]) => box.width && (box.height < 44 || box.width < 44)).map(([name]) => name)"""
    )
    assert small == []


def test_all_that_is_operated_has_a_name_and_shows_where_the_focus_is(studio):
    page = studio(*SAMPLES)
    page.wait_for_selector("#others button")
    unfold(page)
    nameless = page.evaluate(
        """[...document.querySelectorAll("button, select, input:not([hidden]), [tabindex]")].filter(e =>
        !(e.getAttribute("aria-label") || e.labels?.length || e.textContent.trim())).map(e => e.id || e.outerHTML)"""
    )
    assert nameless == []
    page.locator("body").click(position={"x": 3, "y": 3})
    seen = set()
    for _ in range(140):
        page.keyboard.press("Tab")
        name, outline = page.evaluate(
            "[document.activeElement.id, getComputedStyle(document.activeElement).outlineStyle]"
        )
        seen.add(name)
        assert outline != "none" or name == ""
    assert {
        "open",
        "theme",
        "canvas-a",
        "canvas-b",
        "play",
        "time",
        "motion",
        "write",
        "command",
        "save",
    } <= seen
    assert page.get_attribute("#says", "role") == "status"
    assert page.get_attribute("#broken", "role") == "alert"


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("is_toggled", [False, True])
def test_text_is_readable_in_light_and_dark(studio, scheme, is_toggled):
    page = studio("two.svg", "swapped.svg", scheme=scheme)
    page.wait_for_selector("#others:not([aria-busy]) button")
    page.mouse.click(*screen(page, "a", (6, 6)))
    changed(page, lambda: page.mouse.click(*screen(page, "b", (18, 17))))
    page.wait_for_selector("#others:not([aria-busy]) button")
    if is_toggled:
        page.click("#theme")
    page.mouse.move(3, 3)
    ground = page.evaluate("getComputedStyle(document.body).backgroundColor")
    brightness = sum(int(v) for v in re.findall(r"\d+", ground)[:3]) / 3
    assert (brightness < 128) == ((scheme == "dark") != is_toggled)
    found = [pair for pair in page.evaluate(CONTRASTS) if pair[1].strip() not in ("Redo", "Undo")]
    assert len(found) > 30
    assert [pair for pair in found if pair[0] < 4.5] == []


def test_a_hostile_drawing_runs_and_loads_nothing(studio, here):
    page = studio()
    page.on("dialog", lambda dialog: pytest.fail(f"a script ran: {dialog.message}"))
    changed(page, lambda: drop(page, {"evil.svg": HOSTILE, "leaf.svg": (here / "leaf.svg").read_text()}))
    page.wait_for_selector("#others button")
    assert (
        page.locator(
            "foreignObject, iframe, script:not([src='main.js']), main image, [onload], [onclick]"
        ).count()
        == 0
    )
    for act in ("#play", "#show-onion", "#show-tint"):
        page.click(act)


def test_what_cannot_be_read_is_said_and_the_rest_goes_on(studio, here):
    page = studio(*SAMPLES)
    before = shape(page)
    changed(page, lambda: drop(page, {"none.svg": "no drawing"}, screen(page, "b", nodes(page, "b")[0])))
    assert "none.svg: " in page.inner_text("#broken")
    changed(page, lambda: page.click("#undo"))
    assert not page.is_visible("#broken")
    assert shape(page) == before


def test_a_blend_that_hangs_is_stopped_by_a_button_and_the_page_says_so(studio):
    jagged = "M" + " ".join(f"{k % 97} {(k * 37) % 89}" for k in range(1500)) + "Z"
    page = studio(*SAMPLES, timeout=600.0)
    drop(page, {"slow.svg": svg(jagged, viewbox="0 0 100 100")}, screen(page, "b", nodes(page, "b")[0]))
    page.wait_for_selector("#busy:visible")
    page.click("#halt")
    page.wait_for_selector("#broken:visible")
    settle(page)
    assert page.inner_text("#broken-says") == "stopped"
    while page.is_enabled("#undo"):
        changed(page, lambda: page.click("#undo"))
    assert not page.is_visible("#broken")
    assert command(page).startswith("shapeblend bird-1.svg bird-2.svg --timeout")


def test_of_several_drawings_one_pair_at_a_time_is_shown(studio):
    page = studio("two.svg", "swapped.svg", "leaf.svg")
    assert page.get_attribute("#time", "max") == "2"
    assert "apply to two drawings" in page.inner_text("#says")
    assert [page.inner_text(f"#name-{side}") for side in "ab"] == ["two.svg", "swapped.svg"]
    first = shape(page)
    page.select_option("#pair", "1")
    assert [page.inner_text(f"#name-{side}") for side in "ab"] == ["swapped.svg", "leaf.svg"]
    assert shape(page) != first
    page.mouse.click(*screen(page, "a", (6, 6)))
    assert page.locator(".chosen").count() == 0


def test_a_drawing_that_was_changed_elsewhere_is_seen(studio, here):
    page = studio(*SAMPLES)
    before = shape(page)
    (here / "bird-2.svg").write_text((here / "leaf.svg").read_text())
    page.wait_for_timeout(2100)
    changed(page, lambda: page.evaluate("() => dispatchEvent(new Event('focus'))"))
    assert shape(page) != before
    assert page.get_attribute("#canvas-b .part", "d").startswith("M3,14")


def test_a_drawing_that_cannot_be_read_is_said_at_once_and_nothing_breaks(studio, here):
    (here / "broken.svg").write_text("no drawing")
    page = studio("two.svg", "broken.svg")
    assert "broken.svg: " in page.inner_text("#broken")
    assert "--" not in page.inner_text("#command")
    # There is nothing to enlarge, to point at or to colour yet.
    page.keyboard.press("+")
    page.click("#zoom-fit")
    page.hover("#canvas-b")
    page.keyboard.down("Control")
    page.mouse.wheel(0, -100)
    page.keyboard.up("Control")
    page.focus("#canvas-a")
    for key in ("Tab", "ArrowRight", "Enter", "2", "Shift+Tab", "ArrowDown"):
        page.keyboard.press(key)
    page.click("#show-parts")
    # It can be saved, and that is said.
    changed(page, lambda: page.click("#save"))
    assert page.inner_text("#notice-says").startswith("Saved blend.json")
    assert page.is_visible("#broken")
    # What is dropped onto B takes its place all the same.
    box = page.locator("#canvas-b").bounding_box()
    changed(
        page, lambda: drop(page, {"new.svg": (here / "leaf.svg").read_text()}, (box["x"] + 9, box["y"] + 9))
    )
    assert command(page) == "shapeblend two.svg new.svg"
    assert not page.is_visible("#broken")


OPEN = "M3 3H21V12H3"  # filled, and not closed


def test_filled_outlines_that_are_not_closed_are_coloured_and_clicked_inside(studio, here):
    (here / "open.svg").write_text(svg(OPEN, "M4 15 12 22 20 15", attributes='fill="#222" id="roof"'))
    page = studio("open.svg", "two.svg")
    fills = [page.get_attribute(f"#canvas-a [data-number='{k}']", "fill") for k in range(2)]
    assert "none" not in fills
    page.click("#show-tint")
    assert page.get_attribute("#parts path", "fill") != "none"
    page.mouse.click(*screen(page, "a", (12, 7.5)))
    assert page.get_attribute("#canvas-a .chosen", "data-number") == "0"


def test_what_is_pointed_at_is_told_on_both_sides(studio, here):
    name = f"{'named-' * 9}.svg"
    (here / name).write_text(svg(TWO[0], f'<path id="wheel" d="{TWO[1]}"/>'))
    page = studio(name, "swapped.svg", match=["wheel=1"])
    assert [page.inner_text(f"#count-{side}") for side in "ab"] == ["2 parts", "2 parts"]
    page.mouse.move(*screen(page, "a", (18, 18)))
    assert [page.inner_text(f"#count-{side}") for side in "ab"] == ["part 1 (wheel)", "part 1"]
    # All of it can be read, whatever the drawing is called.
    assert page.evaluate(
        "(({ scrollWidth, clientWidth }) => scrollWidth <= clientWidth)(document.getElementById('count-a'))"
    )
    # It is paired with another one instead, which is said by number.
    page.mouse.click(*screen(page, "a", (18, 18)))
    changed(page, lambda: page.mouse.click(*screen(page, "b", (6, 6))))
    assert command(page).endswith(" swapped.svg --match 1=0")


def test_a_tool_is_changed_while_a_part_is_held(studio):
    page = studio("two.svg", "swapped.svg")
    page.mouse.click(*screen(page, "a", (6, 6)))
    page.keyboard.press("2")
    assert page.get_attribute("[data-tool=pin]", "aria-checked") == "true"
    assert page.locator(".chosen, .end").count() == 0


def test_other_blends_are_those_of_the_drawings_that_are_shown(studio, here):
    page = studio(*SAMPLES)
    page.wait_for_selector("#others button")
    drop(page, {"leaf.svg": (here / "leaf.svg").read_text(), "bar.svg": (here / "bar.svg").read_text()})
    page.wait_for_function("() => document.title.startsWith('leaf.svg')")
    assert "bird" not in page.inner_text("#chain")
    assert page.locator("#others button").count() == 0


def test_drawings_come_in_the_order_given_and_are_swapped_with_their_corrections(studio, here):
    page = studio()
    two = {"b.svg": svg(*TWO, attributes='fill="#222"'), "a.svg": svg(*SWAPPED, attributes='fill="#222"')}
    changed(page, lambda: drop(page, two))
    assert command(page) == "shapeblend b.svg a.svg"
    page.mouse.click(*screen(page, "a", (6, 6)))
    changed(page, lambda: page.mouse.click(*screen(page, "b", (18, 17))))
    page.keyboard.press("2")
    changed(
        page, lambda: (drag(page, screen(page, "a", (3, 3)), screen(page, "b", (23, 23))), page.mouse.up())
    )
    assert command(page) == "shapeblend b.svg a.svg --pin 3,3:23,23 --match 0=1"
    changed(page, lambda: page.click("#swap"))
    assert command(page) == "shapeblend a.svg b.svg --pin 23,23:3,3 --match 1=0"


def test_drawings_stay_where_they_are_whatever_is_said_of_a_blend(studio):
    page = studio("two.svg", "swapped.svg")
    before = screen(page, "b", (23, 23))
    page.mouse.click(*screen(page, "a", (6, 6)))
    changed(page, lambda: page.mouse.click(*screen(page, "b", (18, 17))))
    assert "vanishes" in page.inner_text("#places")
    assert screen(page, "b", (23, 23)) == before
    changed(page, lambda: (page.fill("#ease-text", "no easing"), page.press("#ease-text", "Enter")))
    assert page.is_visible("#broken")
    assert screen(page, "b", (23, 23)) == before


def test_a_reload_loses_nothing_and_what_is_not_saved_is_said(studio, here):
    page = studio("two.svg", "swapped.svg")
    assert not page.is_visible("#unsaved")
    page.mouse.click(*screen(page, "a", (6, 6)))
    changed(page, lambda: page.mouse.click(*screen(page, "b", (18, 17))))
    asked = []
    page.on("dialog", lambda dialog: (asked.append(dialog.type), dialog.accept()))
    page.click("#theme")
    for is_saved in (False, True):
        colours = page.evaluate("document.documentElement.dataset.theme")
        assert page.is_visible("#unsaved") != is_saved
        page.reload()
        page.wait_for_selector("html[data-ready]")
        assert command(page).endswith("--match 0=1")
        assert asked == ["beforeunload"]  # of the first time alone
        assert page.evaluate("document.documentElement.dataset.theme") == colours
        if not is_saved:
            page.click("#save")
            page.wait_for_selector("#notice:has-text('Saved blend.json')")
            changed(page, lambda: page.evaluate("() => null") or page.click("#theme") or page.click("#swap"))
            changed(page, lambda: page.click("#undo"))


def test_the_number_of_pictures_is_what_is_written(studio, here):
    page = studio("two.svg", "swapped.svg", output="blend")
    assert page.get_attribute("#frames", "placeholder") == "5"
    changed(page, lambda: choose_format(page, "GIF"))
    assert page.get_attribute("#frames", "placeholder") == "48"
    changed(page, lambda: choose_format(page, "Animated SVG"))
    assert not page.is_visible("#frames")
    changed(page, lambda: choose_format(page, "Lottie"))
    assert page.input_value("#output") == "blend.lottie.json"  # blend.json is the project
    changed(page, lambda: choose_format(page, "Animated SVG"))
    changed(page, lambda: (page.fill("#output", "other.svg"), page.keyboard.press("Enter")))
    changed(page, lambda: (page.fill("#output", ""), page.keyboard.press("Enter")))
    assert page.input_value("#output") == "blend.svg"
    page.wait_for_selector("#size:has-text('kB')")
    page.click("#write")
    page.wait_for_selector("#written:has-text('Wrote blend.svg')")
    assert page.inner_text("#size").startswith(f"{len((here / 'blend.svg').read_bytes()) / 1e3:.3g} kB")


@pytest.mark.parametrize(("width", "height"), [(1440, 900), (390, 844)])
def test_the_picture_and_export_stay_in_sight_while_options_scroll(studio, width, height):
    page = studio(*SAMPLES, width=width, height=height)
    unfold(page)
    page.locator("#constants-reset").scroll_into_view_if_needed()
    page.wait_for_timeout(50)
    assert page.evaluate(
        """(height) => ["drawing", innerWidth > 1000 ? "write" : "to-export"].every(id => {
          const { top, bottom } = document.getElementById(id).getBoundingClientRect();
          return top >= 0 && bottom <= height;
        })""",
        height,
    )


def test_drawings_are_enlarged_where_the_pointer_is_and_moved(studio):
    page = studio(*SAMPLES)
    point = nodes(page, "a")[0]
    before = screen(page, "a", point)
    pointer = [round(value) for value in before]  # wheels turn at whole pixels
    page.mouse.move(*pointer)
    page.keyboard.down("Control")
    page.mouse.wheel(0, -100)
    page.keyboard.up("Control")
    page.wait_for_function("() => document.getElementById('canvas-a').classList.contains('zoomed')")
    assert screen(page, "a", point) == pytest.approx(before, abs=1)
    page.mouse.down()
    page.mouse.move(pointer[0] + 30, pointer[1] + 20, steps=3)
    page.mouse.up()
    assert page.locator(".chosen").count() == 0  # it was no click
    moved = screen(page, "a", point)
    assert moved == pytest.approx((before[0] + 30, before[1] + 20), abs=1)
    stage = page.get_attribute("#drawing", "viewBox")
    page.keyboard.press("+")
    assert page.get_attribute("#drawing", "viewBox") != stage
    page.keyboard.press("0")
    assert page.get_attribute("#drawing", "viewBox") == stage
    assert page.locator(".zoomed").count() == 0


def test_the_end_of_a_pin_is_nudged_by_arrow_keys_and_all_nudges_are_undone_together(studio):
    page = studio("two.svg", "swapped.svg")
    page.keyboard.press("2")
    changed(
        page, lambda: (drag(page, screen(page, "a", (3, 3)), screen(page, "b", (23, 23))), page.mouse.up())
    )
    pinned = command(page)
    page.click("[aria-label='Move pin 1 in B by keys']")
    for key in ("ArrowLeft", "Shift+ArrowUp"):
        page.keyboard.press(key)
    settle(page)
    scale = page.evaluate("document.getElementById('canvas-b').getScreenCTM().a")
    end = re.search(r"--pin 3,3:([\d.]+),([\d.]+)", command(page))
    assert [float(value) for value in end.groups()] == pytest.approx(
        [23 - 1 / scale, 23 - 10 / scale], abs=0.01
    )
    assert page.locator(".picked").count() == 1
    changed(page, lambda: page.click("#undo"))
    assert command(page) == pinned


def test_the_verdict_points_at_parts_and_what_helps(studio, here):
    for name in ("car.svg", "bus.svg"):
        (here / name).write_bytes((ROOT / "docs" / "studio" / name).read_bytes())
    page = studio("car.svg", "bus.svg", swap="never")
    place = page.locator(".place", has_text="Part 11 of B")
    assert place.inner_text() == "Part 11 of B comes from nothing: pair it"
    place.hover()
    assert page.get_attribute("#canvas-b .pointed", "data-number") == "11"
    place.click()
    car = page.locator("#canvas-a [data-number='0']").bounding_box()
    spot = car["x"] + 0.5 * car["width"], car["y"] + 0.7 * car["height"]
    changed(page, lambda: page.mouse.click(*spot))
    assert "--match 0=11" in command(page)
    page.click("#all-card summary")
    changed(page, lambda: page.select_option("#option-swap", "always"))
    assert page.get_attribute("#verdict", "data-is") != "right"
    assert "pair it" not in page.inner_text("#places")  # nothing would come of it


def test_an_easing_is_shaped_by_its_handles_and_played_beyond_the_drawings(studio):
    page = studio(*SAMPLES)
    page.locator("#curve").scroll_into_view_if_needed()
    knob = page.locator(".knob").nth(1).bounding_box()
    x, y = knob["x"] + knob["width"] / 2, knob["y"] + knob["height"] / 2
    changed(page, lambda: (drag(page, (x, y), (x - 20, y - 15)), page.mouse.up()))
    x1, y1, x2, y2 = map(float, re.search(r"--ease 'cubic-bezier\((.*?)\)'", command(page))[1].split(","))
    assert (x1, y1) == (0, 0)
    assert 0 < x2 < 1 < y2
    changed(page, lambda: page.locator(".knob").nth(1).press("ArrowDown"))
    changed(page, lambda: (page.fill("#ease-text", "spring(1,200,9)"), page.keyboard.press("Enter")))
    assert "spring(1,200,9)" in command(page)
    assert page.locator(".knob:visible").count() == 0
    page.evaluate("() => window.seen = new Set()")
    page.evaluate(
        """() => new MutationObserver(() => seen.add(Number(document.getElementById("clock").textContent)))
        .observe(document.getElementById("clock"), { childList: true })"""
    )
    page.click("#play")
    page.wait_for_function("() => Math.max(...seen) > 1.05")


def timeline(page):
    """Open the timeline; return where the track of a part is."""
    page.locator("#timeline-card > summary").click()

    def track(name):
        return page.locator(".part-row", has=page.get_by_role("slider", name=f"All of {name}")).locator(
            ".track"
        )

    return track


def timing_of(page):
    return json.loads(re.search(r"--timing '(.*?)'", command(page))[1])


def pull(page, grip, track, share, *, by_alt=False):
    """Drag a grip along a track, by a share of it."""
    box, width = grip.bounding_box(), track.bounding_box()["width"]
    start = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    drag(page, start, (start[0] + share * width, start[1]))
    if by_alt:
        page.keyboard.down("Alt")
        page.mouse.move(start[0] + share * width + 1, start[1])
    page.mouse.up()
    page.keyboard.up("Alt")


@pytest.mark.parametrize("width", [1440, 390])
def test_bars_of_parts_are_dragged_and_snap(studio, width):
    page = studio("two.svg", "swapped.svg", width=width)
    still = shape(page)
    track = timeline(page)
    start, whole = page.get_by_label("Start of 0"), page.get_by_label("All of 1")
    start.scroll_into_view_if_needed()
    changed(page, lambda: pull(page, start, track("0"), 0.495))
    assert timing_of(page) == {"0": {"start": 0.5, "length": 0.5}}  # of the middle of the time
    assert shape(page) != still
    changed(page, lambda: pull(page, start, track("0"), -0.2, by_alt=True))
    assert timing_of(page)["0"]["start"] == pytest.approx(0.3, abs=0.02)
    assert timing_of(page)["0"]["start"] % 0.25 > 0
    changed(page, lambda: pull(page, page.get_by_label("End of 1"), track("1"), -0.3))
    changed(page, lambda: pull(page, whole, track("1"), 0.297))  # its end comes near the end of all
    assert timing_of(page)["1"]["start"] == pytest.approx(0.3, abs=0.02)
    assert timing_of(page)["1"]["start"] + timing_of(page)["1"]["length"] == pytest.approx(1.0)
    for _ in range(4):
        changed(page, lambda: page.click("#undo"))
    assert "--timing" not in command(page)
    assert shape(page) == still


def test_a_part_that_is_pointed_at_is_forgotten_with_its_drawing(studio, here):
    (here / "three.svg").write_text(svg(*TWO, "M14 3H21V9H14Z", attributes='fill="#222"'))
    page = studio("three.svg", "two.svg")
    page.mouse.move(*screen(page, "a", (17, 6)))  # the third part, which the other drawing does not have
    page.wait_for_function("() => document.getElementById('count-a').textContent.includes('part 2')")
    changed(page, lambda: page.evaluate("document.getElementById('swap').click()"))
    assert page.inner_text("#count-a") == "2 parts"


def test_bars_are_moved_by_keys_and_what_is_written_moves_so(studio, here):
    page = studio("two.svg", "swapped.svg")
    timeline(page)
    end = page.get_by_label("End of 0")
    changed(page, lambda: end.press("Shift+ArrowLeft"))
    for _ in range(3):
        changed(page, lambda: end.press("Shift+ArrowLeft"))
    assert timing_of(page) == {"0": {"start": 0.0, "length": 0.6}}
    assert end.get_attribute("aria-valuetext") == "1.2 s"
    assert page.evaluate("document.activeElement.getAttribute('aria-label')") == "End of 0"
    run(shlex.split(command(page))[1:])
    assert len(list((here / "blend").iterdir())) == 5
    changed(page, lambda: page.keyboard.press("Delete"))
    assert "--timing" not in command(page)
    changed(page, lambda: page.keyboard.press("Control+z"))
    changed(page, lambda: page.keyboard.press("Control+z"))  # all four steps are one
    assert "--timing" not in command(page)
    assert page.is_disabled("#undo")


def test_bars_are_swapped_with_the_drawings(studio, here):
    (here / "three.svg").write_text(svg(*TWO, "M14 3H21V9H14Z", attributes='fill="#222"'))
    page = studio("three.svg", "swapped.svg", style="a")
    timeline(page)
    changed(page, lambda: page.get_by_label("Start of 1").press("Shift+ArrowRight"))
    before = timing_of(page)
    assert list(before) == ["1"]
    changed(page, lambda: page.click("#swap"))
    assert not page.is_visible("#broken")
    assert page.inner_text("#name-a") == "swapped.svg"
    assert timing_of(page) == {"B1": before["1"]}
    assert "--style b" in command(page)
    assert page.get_by_label("Start of B1").get_attribute("aria-valuenow") == "0.1"
    changed(page, lambda: page.click("#swap"))
    assert timing_of(page) == before


def test_a_drag_of_a_bar_is_let_go_by_escape(studio):
    page = studio("two.svg", "swapped.svg")
    before = shape(page)
    track = timeline(page)
    box, width = page.get_by_label("Start of 0").bounding_box(), track("0").bounding_box()["width"]
    start = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    changed(page, lambda: drag(page, start, (start[0] + 0.6 * width, start[1])))
    assert shape(page) != before
    changed(page, lambda: page.keyboard.press("Escape"))
    page.mouse.up()
    assert shape(page) == before
    assert "--timing" not in command(page)


def test_parts_start_one_after_the_other_until_one_is_moved_by_hand(studio):
    page = studio("two.svg", "swapped.svg")
    timeline(page)
    changed(page, lambda: page.fill("#stagger", "0.4"))
    changed(page, lambda: page.select_option("#stagger-by", "right"))
    assert "--stagger 0.4 --stagger-by right" in command(page)
    assert page.get_by_label("Start of 0").get_attribute("aria-valuenow") == "0.4"
    changed(page, lambda: page.get_by_label("End of 1").press("ArrowRight"))
    assert "--stagger" not in command(page)
    assert timing_of(page) == {"0": {"start": 0.4, "length": 0.6}, "1": {"start": 0.0, "length": 0.61}}
    changed(page, lambda: page.click("#at-once"))
    assert "--timing" not in command(page)


def test_rests_are_set_and_kept_and_wrong_ones_stay_and_are_said(studio):
    page = studio(*SAMPLES)
    changed(page, lambda: (page.fill("#hold-b", "1.5"), page.keyboard.press("Enter")))
    assert "--hold 0,1.5" in command(page)
    changed(page, lambda: page.click("#swap"))
    assert "--hold 1.5,0" in command(page)
    changed(page, lambda: (page.fill("#hold-b", "-1"), page.keyboard.press("Enter")))
    assert page.inner_text("#broken-says").startswith("--hold ")
    page.locator("#hold-b").blur()
    changed(page, lambda: page.select_option("#motion", "linear"))
    assert page.is_visible("#broken")
    assert page.input_value("#hold-b") == "-1"


def test_drawings_are_added_to_a_chain_put_in_order_and_taken_away(studio, here):
    page = studio("two.svg", "swapped.svg", timing={"1": {"start": 0.5}})
    changed(page, lambda: page.set_input_files("#more", [here / "leaf.svg"]))
    assert command(page) == "shapeblend two.svg swapped.svg leaf.svg"  # bars are of the parts that were
    assert "apply to two drawings" in page.inner_text("#says")
    unfold(page)
    changed(page, lambda: page.click("[aria-label='Earlier leaf.svg']"))
    assert command(page) == "shapeblend two.svg leaf.svg swapped.svg"
    assert page.inner_text("#pair option:first-child") == "two.svg → leaf.svg"
    changed(page, lambda: page.click("[aria-label='Remove two.svg']"))
    assert command(page) == "shapeblend leaf.svg swapped.svg"
    assert page.inner_text("#says").startswith("Click a part of A")
    assert page.locator("#chain button:disabled").count() == 3


def test_an_empty_studio_has_drawings_to_try(studio):
    page = studio()
    changed(page, lambda: page.click("text=fish to bird"))
    assert command(page) == "shapeblend fish.svg bird.svg"
    page.wait_for_selector("#others button")
    names = page.locator("#others .what > :first-child").all_inner_texts()
    assert names[0] == "As it is"
    assert not any("--" in name for name in names)


def test_pictures_and_what_clips_them_are_shown(studio, here):
    write(**WITH_PICTURES)
    page = studio("a.svg", "b.svg", warp="off", ease="linear")
    page.wait_for_selector("#picture image")
    start, middle, end = written(here)
    papers = [page.locator(".paper").nth(k).evaluate("(group) => group.innerHTML") for k in (0, 1)]
    for paper, frame in zip(papers, (start, end), strict=True):
        assert difference(pixels(svg(paper)), frame) < 5e-3
    page.fill("#time", "0.5")
    assert difference(pixels(shown_in(page, "#picture")), middle) < 5e-3
