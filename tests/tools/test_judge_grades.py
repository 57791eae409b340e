"""How the judge's agreement with grades by eye is counted."""

import pytest

from tools.quality import npm
from tools.quality.judge import blends, pairs, section
from tools.quality.judge.blends import ALIKE, OPTIONS, blend_of, look, number, unlikeness
from tools.quality.judge.pairs import Pair
from tools.quality.judge.section import Graded

WHERE = "game-icons"
BODIES = {
    "bar-up": '<path d="M10 2h4v20h-4z"/>',
    "bar-down": '<path d="M2 10h20v4h-20z"/>',
    "bar-long-input-box": '<path d="M0 0h9v9h-9z"/>',
    "heavy-bird": f'<path d="M0 0h9v9h-9z{"m0 0" * 400}"/>',
    "bird-with-hat": '<path d="M4 4h12v12h-4z"/>',
    "bird-with-shoe": '<path d="M4 4h12v12h-12z"/>',
    "cat-with-hat": '<path d="M2 4h12v10z"/>',
}


@pytest.fixture(autouse=True)
def packages(monkeypatch):
    """Packages with a handful of icons."""
    icons = {name: {"body": body} for name, body in BODIES.items()}
    known = {"icons": icons, "width": 24, "height": 24}
    for module in (pairs, npm):
        monkeypatch.setattr(module, "icon_set", lambda name: known)
    pairs.names.cache_clear()
    yield
    pairs.names.cache_clear()


def test_pairs_are_drawn_by_lot_and_every_other_one_has_a_word_in_common():
    picked = pairs.picked(5, 40)
    assert picked == pairs.picked(5, 40) != pairs.picked(6, 40)
    assert pairs.picked(5, 10) == picked[:10]
    for k, (icons, a, b) in enumerate(picked):
        assert icons == pairs.SETS[k % 10]
        assert a != b
        assert {a, b} <= BODIES.keys() - {"bar-long-input-box", "heavy-bird"}
        if k % 2 == 0:
            assert {a, b} == {"bird-with-hat", "bird-with-shoe"}
    assert {name for pair in picked for name in pair[1:]} >= {"bar-up", "cat-with-hat"}


def test_a_blend_is_known_again_by_its_look():
    pair = Pair(WHERE, "bar-up", "bar-down")
    straight, again, rigid = (blend_of(pair, {"motion": motion}) for motion in ("linear", "linear", "rigid"))
    assert look(straight) == look(again)
    assert unlikeness(look(straight), look(rigid)) > ALIKE
    assert number(straight) > 0.0


def graded(*rows):
    return [
        Graded(
            Pair(WHERE, a, b),
            dict(zip(OPTIONS, grades, strict=False)),
            dict.fromkeys(OPTIONS, "0" * 108),
            "note",
        )
        for a, b, grades in rows
    ]


def found(taken, *numbers):
    rows = [dict(zip(OPTIONS, row, strict=True)) for row in numbers]
    return {
        "pairs": [f"pair {k}" for k in range(len(rows))],
        "numbers": {name: [row[name] for row in rows] for name in OPTIONS},
        "taken": taken,
    }


def test_what_no_longer_looks_as_it_was_graded_does_not_count(monkeypatch):
    (one,) = graded(("bar-up", "bar-down", (1, 3, 3)))
    looks = {name: look(blend_of(one.pair, OPTIONS[name])) for name in ("linear", "intrinsic")}
    one = one._replace(looks=one.looks | looks | {"rigid": looks["linear"]})
    monkeypatch.setattr(section, "graded", lambda seed: [one])
    monkeypatch.setattr(section, "SEEDS", {5: 1})
    found = section.measured()["5"]
    kept = found["numbers"]
    assert kept["linear"][0] > 0.0 < kept["intrinsic"][0]
    assert kept["rigid"] == [None]


def test_agreement_is_counted(monkeypatch):
    # linear, intrinsic, rigid, paper, paper with intrinsic motion
    every = graded(
        ("a", "b", (1, 3, 2, 3, 3)),  # auto takes intrinsic, as it should
        ("b", "c", (3, 1, 1, 3, 3)),  # the straight one is taken, as the other is little better
        ("c", "d", (0, 3, 1, 0, 0)),  # the worst is taken
        ("d", "e", (2, 2, 2, 1, 3)),  # nothing to choose
    )
    numbers = found(
        ["intrinsic", "linear", "linear", None],
        (0.5, 0.1, 0.3, 0.2, 0.15),
        (0.5, 0.45, 0.6, None, None),
        (0.5, 0.6, 0.7, None, None),
        (0.5, 0.6, 0.7, 0.8, 0.4),
    )
    monkeypatch.setattr(section, "graded", lambda seed: every)
    monkeypatch.setattr(section, "SEEDS", {5: 4})
    ((seed, count, auto, *always, couples),) = section.section({"5": numbers}).table.rows
    assert (seed, count) == ("5", "4")
    assert auto == "2 of 3, 67 %"
    assert always == ["1 of 3, 33 %", "0 of 3, 0 %", "2 of 3, 67 %"]
    # 7 couples of the first pair differ, 2 of the second and 3 of the third, of which 1 and 2 are out of order, and 7
    # of the last.
    assert couples == "16 of 19, 84 %"
    (line,) = section.wrong({"5": numbers})
    assert line.startswith("5 pair 2: takes linear of linear 0.500 (grade 0)")


def test_what_auto_takes_is_found_by_its_look(monkeypatch):
    (one,) = graded(("bar-up", "bar-down", (1, 3, 3)))
    took = blend_of(one.pair, {}).pairs[0].shapes[0].motion_name
    assert section.measure(one).taken == took != "linear"
    monkeypatch.setattr(section, "CHOICES", ("linear",))
    assert section.measure(one).taken is None


@pytest.mark.parametrize("seed", section.SEEDS)
def test_every_pair_of_a_set_has_grades_and_looks_and_is_there_once(seed):
    every = section.graded(seed)
    assert len({frozenset(one.pair) for one in every}) == len(every) <= section.SEEDS[seed]
    for one in every:
        assert set(one.grades.values()) <= set(range(section.BEST + 1))
        assert {len(one.looks[name]) for name in one.grades} == {len(blends.MOMENTS) * blends.CELLS**2}
