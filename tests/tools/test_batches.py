"""Batches beside separate commands."""

import re

from tools import batches


def test_batches_are_compared_with_commands(monkeypatch, capsys):
    monkeypatch.setattr(batches, "PLAIN", 2)
    batches.main(["frames", "--rounds", "1"])
    first, *ways = capsys.readouterr().out.splitlines()
    assert first.endswith("nine frames each: 2 jobs")
    times = [float(re.search(r"([\d.]+) times as fast", way)[1]) for way in ways]
    assert times[0] == 1.0
    assert all(0.1 < each < 20.0 for each in times)


def test_no_icon_is_in_two_of_the_unlike_pairs_and_every_two_of_a_set_are_blended(tmp_path):
    unlike = [file for row in batches.unlike(tmp_path) for file in row.values()]
    assert len({*unlike}) == len(unlike) > 150
    assert all((tmp_path / file).is_file() for file in unlike)
    assert len([*batches.every_two(tmp_path)]) == 300
