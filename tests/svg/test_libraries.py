"""What is imported, and when."""

import subprocess
import sys

import pytest

from tests.svg.reading.drawings import svg


def run(code):
    """Run `code` in a new interpreter, warnings being errors, and return what it prints."""
    command = [sys.executable, "-W", "error", "-c", code]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    assert done.stderr == ""
    return done.stdout.split()


EXPENSIVE = ["scipy", "scipy.integrate", "svgpathtools", "svgpathtools.parser", "svgwrite", "webbrowser"]
ON_DEMAND = ["tinycss2", "cssselect2", "gzip"]
PLAIN = svg('<g style="fill:#123;stroke:none"><path d="M0 0h5v5z"/></g>')


@pytest.mark.parametrize(
    ("code", "names"), [("", EXPENSIVE + ON_DEMAND), (f"read.read('a', {PLAIN!r});", ON_DEMAND)]
)
def test_expensive_modules_are_not_imported_nor_css_libraries_for_a_plain_file(code, names):
    imported = f"import sys; print(*(name for name in {names!r} if name in sys.modules))"
    assert run(f"from shapeblend_cli.svg.reading import read; {code}{imported}") == []


TRACES = {
    "a later import gets the whole package": (
        "from shapeblend_cli.svg.libraries import parse_path; import svgpathtools, webbrowser;"
        "print(hasattr(svgpathtools, 'Document'), hasattr(webbrowser, 'open_new_tab'))"
    ),
    "a package imported before stays": (
        "import webbrowser, svgpathtools; from shapeblend_cli.svg.libraries import parse_path; import sys;"
        "print(parse_path is svgpathtools.parse_path, sys.modules['webbrowser'] is webbrowser)"
    ),
}


@pytest.mark.parametrize("code", TRACES.values(), ids=TRACES)
def test_stand_ins_leave_no_trace(code):
    assert run(code) == ["True", "True"]
