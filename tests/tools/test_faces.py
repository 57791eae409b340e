from tests.support.drawings import svg
from tools.quality.faces import section


def dot(x, y, r):
    return f'<circle cx="{x}" cy="{y}" r="{r}" fill="#640"/>'


DRAWN = {
    "wide": (dot(20, 20, 20), dot(12, 12, 3), dot(28, 12, 3.5), dot(20, 28, 4)),
    "small": (dot(20, 20, 20), dot(20, 30, 2), dot(28, 14, 3), dot(12, 14, 3.2)),
}


def test_eyes_and_mouths_are_counted_for_each_tool(monkeypatch):
    monkeypatch.setattr(section, "drawn", lambda name: svg(*DRAWN[name], viewbox="0 0 40 40"))
    monkeypatch.setattr(section, "FACES", {"wide": (1, 2, 3), "small": (3, 2, 1)})
    monkeypatch.setattr(section, "PAIRS", [("wide", "small")])
    found = section.measured()
    assert section.by_size("wide", "small") == {0: 0, 3: 3, 2: 2, 1: 1}
    assert section.section(found).table.rows == [
        ["shapeblend", "1", "2 of 2", "1 of 1", "1 of 1"],
        [section.FLUBBER, "1", "1 of 2", "0 of 1", "0 of 1"],
    ]
    assert section.wrong(found) == []


def test_each_face_is_in_two_pairs_and_with_another_face():
    assert len(section.PAIRS) == 40
    assert sorted(a for a, _ in section.PAIRS) == sorted(b for _, b in section.PAIRS) == sorted(section.FACES)
    assert all(a != b for a, b in section.PAIRS)
