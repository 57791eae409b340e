"""Drawings for the studio, and how its page is used."""

import re

SAMPLES = ("bird-1.svg", "bird-2.svg")
TWO = ("M3 3H10V10H3Z", "M12 12H23V23H12Z")  # parts that pair by place, and are not alike
SWAPPED = ("M3 3H9V10H3Z", "M12 13H23V23H12Z")


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
