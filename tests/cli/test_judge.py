"""Grades of frames on the command line."""

import json
import os

import pytest
from PIL import Image, ImageDraw

from shapeblend_cli.cli import run
from shapeblend_cli.job.judged import strips_of
from tests.support.drawings import svg

EVEN = [f"M{x} 4h8v8h-8Z" for x in (2, 4, 6, 8, 10, 12, 14)]
TORN = [*EVEN[:2], "M3 3h1v9h-1Z M9 3h1v1h-1Z M15 18h1v2h-1Z", "M1 1h22v22h-22Z", "M20 3h1v1h-1Z", *EVEN[5:]]


def frames(folder, paths):
    folder.mkdir()
    for number, path in enumerate(paths, 8):  # frame-10 comes after frame-9
        (folder / f"frame-{number}.svg").write_text(svg(path))
    return folder


def grades(capsys, *arguments):
    assert run(["judge", "--json", *map(str, arguments)]) == 0
    return [json.loads(line) for line in capsys.readouterr().out.splitlines()]


def test_an_even_strip_is_graded_better_than_a_torn_one(tmp_path, capsys):
    even, torn = grades(capsys, frames(tmp_path / "even", EVEN), frames(tmp_path / "torn", TORN))
    assert (even["frames"], even["strip"]) == (7, str(tmp_path / "even"))
    assert even["grade"] + 0.5 < torn["grade"] <= 3.0
    assert torn["why"]


def test_frames_may_be_files_in_their_order(tmp_path, capsys):
    folder = frames(tmp_path / "even", EVEN)
    (whole,) = grades(capsys, folder)
    (files,) = grades(capsys, *(folder / f"frame-{k}.svg" for k in range(8, 15)))
    assert files["grade"] == whole["grade"]


def test_a_raised_digit_in_a_name_is_no_number(tmp_path):
    for name in ("frame-10.svg", "frame-9.svg", "frame-\u00b2.svg"):
        (tmp_path / name).touch()
    ((_, files),) = strips_of([str(tmp_path)])
    assert [os.path.basename(file) for file in files] == ["frame-9.svg", "frame-10.svg", "frame-\u00b2.svg"]


def test_pictures_on_an_opaque_ground_are_graded_as_drawings_are(tmp_path, capsys):
    (drawn,) = grades(capsys, frames(tmp_path / "even", EVEN))
    pictures = []
    for x in range(2, 15, 2):
        image = Image.new("RGB", (96, 96), "white")
        ImageDraw.Draw(image).rectangle((4 * x, 16, 4 * x + 31, 47), fill="black")
        pictures.append(image)
    (tmp_path / "png").mkdir()
    for number, image in enumerate(pictures):
        image.save(tmp_path / "png" / f"{number}.png")
    pictures[0].save(tmp_path / "all.gif", save_all=True, append_images=pictures[1:])
    for strip in grades(capsys, tmp_path / "png", tmp_path / "all.gif"):
        assert strip["frames"] == 7
        assert strip["grade"] == pytest.approx(drawn["grade"], abs=0.15)


def test_a_grade_above_the_limit_fails(tmp_path, capsys):
    even, torn = frames(tmp_path / "even", EVEN), frames(tmp_path / "torn", TORN)
    assert run(["judge", str(even), "--fail-over", "1.5"]) == 0
    assert run(["judge", str(even), str(torn), "--fail-over", "1.5"]) == 1
    table = capsys.readouterr().out.splitlines()
    assert table[0].split() == ["grade", "frames", "strip", "why"]


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda p: (p / "f").mkdir() or "f", "f: the folder has no frames"),
        (lambda p: (p / "a.txt").write_text("") or "a.txt", "a.txt: frames are files ending in"),
        (lambda p: (p / "a.png").write_bytes(b"no") and "a.png", "a.png: no PNG or GIF picture"),
        (lambda p: (p / "a.svg").write_text(svg(EVEN[0])) and "a.svg", "a.svg: 1 frame found"),
        (lambda p: "none", "none: no such file or folder; frames are files ending in"),
        (lambda p: "none.svg", "none.svg: cannot be read"),
    ],
)
def test_what_cannot_be_judged_gets_one_line(make, message, tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert run(["judge", make(tmp_path)]) == 1
    error = capsys.readouterr().err
    assert error.count("\n") == 1
    assert message in error
