"""The studio in a real browser: drawings are corrected by mouse, by finger and by keyboard, and exported."""

import re
import shlex
import threading

import pytest

from shapeblend_cli.cli import run
from shapeblend_cli.rows.project import Project, read_project
from shapeblend_cli.studio.server import Studio
from shapeblend_cli.studio.session import Session
from tests.browser.test_preview import CONTRASTS
from tests.studio.test_safety import HOSTILE
from tests.support.drawings import BAR, LEAF, svg

SAMPLES = ("bird-1.svg", "bird-2.svg")
TWO = ("M3 3H10V10H3Z", "M12 12H23V23H12Z")  # parts that pair by place, and are not alike
SWAPPED = ("M3 3H9V10H3Z", "M12 13H23V23H12Z")


@pytest.fixture
def studio(browser, here, samples):
    """Open a studio in a page. Nothing may go wrong in it, and nothing may be asked for elsewhere."""
    running, wrong, asked = [], [], []
    for name in SAMPLES:
        (here / name).write_bytes((samples / name).read_bytes())
    for name, paths in {"two": TWO, "swapped": SWAPPED, "bar": [BAR], "leaf": [LEAF]}.items():
        (here / f"{name}.svg").write_text(svg(*paths, attributes='fill="#222"'))

    def open_(*files, width=1280, height=900, scheme="light", touch=False, folder="", **given):
        session = Session(Project(files, given), folder)
        server = Studio(session)
        session.start()
        threading.Thread(target=server.serve_forever, args=(0.02,), daemon=True).start()
        context = browser.new_context(
            viewport={"width": width, "height": height},
            color_scheme=scheme,
            reduced_motion="reduce",
            has_touch=touch,
            accept_downloads=True,
        )
        running.append((server, session, context))
        page = context.new_page()
        page.on("console", lambda message: wrong.append(f"{message.type}: {message.text}"))
        page.on("pageerror", lambda error: wrong.append(str(error)))
        page.on("request", lambda request: asked.append(request.url))
        page.goto(server.address)
        page.wait_for_selector("html[data-ready]")
        return page

    yield open_
    own = tuple(f"http://{host}/" for server, *_ in running for host in server.hosts)
    for server, session, context in running:
        context.close()
        server.shutdown()
        server.server_close()
        session.stop()
    assert [url for url in asked if not url.startswith((*own, "data:", "blob:"))] == []
    assert wrong == []


def shape(page):
    return page.evaluate(
        "() => [...document.querySelectorAll('#picture path')].map(path => path.getAttribute('d')).join(' ')"
    )


def changed(page, act):
    """Do something, and wait for the blend that comes of it."""
    version = page.evaluate("Number(document.documentElement.dataset.version)")
    act()
    page.wait_for_function("before => Number(document.documentElement.dataset.version) > before", arg=version)
    settle(page)


def settle(page):
    """Wait until no further blend comes."""
    page.evaluate("() => new Promise(requestAnimationFrame)")
    page.wait_for_function("() => !document.documentElement.dataset.asking")


def screen(page, side, point):
    """Where a point of a drawing is on the screen."""
    return page.evaluate(
        """([side, [x, y]]) => {
          const m = document.getElementById(`canvas-${side}`).getScreenCTM();
          return [m.a * x + m.e, m.d * y + m.f];
        }""",
        [side, point],
    )


def nodes(page, side, number=0):
    """The nodes of a part, in order."""
    text = page.get_attribute(f"#canvas-{side} .part[data-number='{number}']", "d")
    found = []
    for letter, numbers in re.findall(r"([MLC])([^MLCZ]*)", text):
        points = [tuple(map(float, pair)) for pair in re.findall(r"(-?[\d.]+),(-?[\d.]+)", numbers)]
        found += points[2::3] if letter == "C" else points
    return found


def drag(page, start, end):
    page.mouse.move(*start)
    page.mouse.down()
    page.mouse.move((start[0] + end[0]) / 2, (start[1] + end[1]) / 2, steps=4)
    page.mouse.move(*end, steps=6)


def choose_format(page, name):
    labels = page.locator("#format option").all_text_contents()
    page.select_option("#format", index=[label.startswith(name) for label in labels].index(True))


def unfold(page):
    page.evaluate("for (const fold of document.querySelectorAll('details')) fold.open = true")


def command(page):
    return page.inner_text("#command")


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
    changed(page, lambda: page.click("#corrections button"))
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
    page.wait_for_selector("#written:has-text('Wrote blend.json')")
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
    others = page.inner_text("#second .what > :first-child")
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
    assert "--pin 3.0,3.0:23.0,23.0" in command(page)
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
    assert "--pin 3.0,3.0:12.0,13.0" in command(page)
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
    for _ in range(100):
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


def test_a_drawing_that_cannot_be_read_is_said_at_once(studio, here):
    (here / "broken.svg").write_text("no drawing")
    page = studio("two.svg", "broken.svg")
    assert "broken.svg: " in page.inner_text("#broken")
    assert "--" not in page.inner_text("#command")
