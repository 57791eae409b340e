"""What links are followed, and what files are opened."""

import os
from pathlib import Path

import pytest

from shapeblend_cli.images import links
from shapeblend_cli.images.links import NotThereError, bytes_of

OUTSIDE = "its file is not beside the drawing"


def why_not(link, folder=None):
    with pytest.raises(NotThereError) as caught:
        bytes_of(link, folder)
    return str(caught.value)


@pytest.mark.parametrize(
    ("link", "data"),
    [
        ("data:image/png;base64,aGVsbG8=", b"hello"),
        ("data:;base64,aGVs\n bG8=", b"hello"),
        ("data:image/png;base64,aGVsbG8%3D", b"hello"),
        ("DATA:text/plain,a%20b", b"a b"),
    ],
)
def test_links_that_hold_their_bytes(link, data):
    assert bytes_of(link, None) == data


@pytest.mark.parametrize(
    "link",
    [
        "http://127.0.0.1/a.png",
        "https://a.b/c.png",
        "file:///etc/passwd",
        "//a.b/c.png",
        "/etc/passwd",
        "\\\\a\\b",
        "#a",
    ],
)
def test_nothing_is_fetched_and_no_absolute_path_is_opened(here, link, monkeypatch):
    monkeypatch.setattr("builtins.open", lambda *_, **__: pytest.fail("it was opened"))
    assert why_not(link, ".") == "it is not in the file"


def test_files_are_opened_only_if_that_is_allowed(here):
    Path("a.png").write_bytes(b"a")
    assert why_not("a.png") == (
        "it is in another file; --images beside would take it if that is beside the drawing"
    )
    assert bytes_of("a.png", ".") == b"a"


def test_files_beside_a_drawing_and_below_are_opened_and_no_others(here):
    for folder in ("in/drawings", "in/drawings/pictures", "in/drawings-2"):
        Path(folder).mkdir(parents=True)
        Path(folder, "a b.png").write_bytes(folder.encode())
    assert bytes_of("a%20b.png#x", "in/drawings") == b"in/drawings"
    assert bytes_of("pictures/a b.png?v=1", "in/drawings") == b"in/drawings/pictures"
    assert bytes_of("pictures/../a b.png", "in/drawings") == b"in/drawings"
    for path in ("../drawings-2/a b.png", "%2e%2e/drawings-2/a b.png", "pictures/../../drawings-2/a b.png"):
        assert why_not(path, "in/drawings") == OUTSIDE


def test_links_of_the_file_system_are_followed_before_a_place_is_judged(here):
    Path("in").mkdir()
    Path("secret").write_bytes(b"secret")
    Path("in/inside.png").write_bytes(b"inside")
    os.symlink("../secret", "in/a.png")
    os.symlink("..", "in/up")
    os.symlink("inside.png", "in/b.png")
    assert why_not("a.png", "in") == OUTSIDE
    assert why_not("up/secret", "in") == OUTSIDE
    assert bytes_of("b.png", "in") == b"inside"


def test_what_is_no_file_is_not_opened(here):
    os.mkfifo("pipe.png")
    Path("folder.png").mkdir()
    assert why_not("pipe.png", ".") == "it is no file"
    assert why_not("folder.png", ".") == "it is no file"
    assert why_not("missing.png", ".") == "its file cannot be read"
    assert why_not("a%00b.png", ".") == "its file cannot be read"


def test_sizes_are_limited(here, monkeypatch):
    monkeypatch.setattr(links, "MOST_BYTES", 2**20)
    Path("a.png").write_bytes(bytes(2**20 + 1))
    large = "it is larger than 1 MB, the limit"
    assert why_not("a.png", ".") == large
    assert why_not("data:," + "a" * (2**20 + 1)) == large
    assert why_not("data:," + "a" * (3 * 2**20)) == large


def test_damaged_base64_is_said():
    assert why_not("data:image/png;base64,abcde") == "its base64 is damaged"
    assert why_not("") == ""
