"""Measure: whether the eyes of a face become eyes on the same side, and its mouth a mouth."""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import shapeblend_cli as sb
from tools.quality import raw
from tools.quality.npm import icon_file
from tools.quality.tables import Section, Table

if TYPE_CHECKING:
    from collections.abc import Sequence

    from tools.quality.peers import Tool


# Contours by number, counted through the file: the left eye, the right eye, the mouth. Seen by eye in each drawing; of
# a mouth with teeth or a tongue it is what they lie on.
FACES = {
    "grinning-face": (3, 4, 1),
    "smiling-face-with-smiling-eyes": (4, 5, 3),
    "slightly-smiling-face": (2, 3, 1),
    "frowning-face": (1, 2, 3),
    "neutral-face": (1, 2, 3),
    "expressionless-face": (2, 3, 1),
    "confused-face": (1, 2, 3),
    "worried-face": (4, 5, 1),
    "angry-face": (2, 3, 1),
    "crying-face": (1, 2, 5),
    "loudly-crying-face": (6, 7, 1),
    "winking-face": (1, 2, 5),
    "kissing-face": (1, 2, 3),
    "kissing-face-with-closed-eyes": (4, 3, 5),
    "grinning-face-with-big-eyes": (1, 2, 3),
    "grinning-face-with-smiling-eyes": (2, 1, 3),
    "beaming-face-with-smiling-eyes": (1, 2, 3),
    "grinning-squinting-face": (3, 4, 1),
    "grinning-face-with-sweat": (2, 1, 3),
    "astonished-face": (5, 6, 1),
    "smiling-face-with-heart-eyes": (2, 3, 1),
    "anguished-face": (1, 2, 5),
    "fearful-face": (2, 3, 6),
    "star-struck": (3, 4, 1),
    "sleepy-face": (2, 3, 1),
    "relieved-face": (2, 1, 5),
    "pensive-face": (1, 2, 3),
    "face-with-tears-of-joy": (2, 1, 5),
    "unamused-face": (5, 4, 1),
    "smirking-face": (4, 5, 1),
    "face-with-tongue": (1, 2, 3),
    "squinting-face-with-tongue": (1, 2, 3),
    "face-with-rolling-eyes": (2, 1, 3),
    "smiling-face-with-halo": (3, 2, 1),
    "persevering-face": (3, 4, 5),
    "confounded-face": (3, 4, 5),
    "weary-face": (1, 2, 5),
    "tired-face": (5, 6, 1),
    "angry-face-with-horns": (3, 4, 5),
    "face-blowing-a-kiss": (1, 2, 5),
}
APART = 17
"""Each face is paired with the one so many places on in the list, and the last ones with the first."""

PAIRS = list(zip(FACES, [*FACES][APART:] + [*FACES][:APART], strict=True))

HEADER = (
    "pairs",
    "eyes that become the eye on the same side",
    "mouths that become a mouth",
    "pairs all right",
)

TEXT = f"""\
{len(FACES)} faces of Twemoji, which npm installs from a lock file, in {len(PAIRS)} pairs: each with the face {APART}
places on in the list of `tools/quality/faces/section.py`. Which contours are the left eye, the right eye and the
mouth were identified by eye, and are in that list; where eyes are of several contours (white, pupil) the outer one
counts, and of a mouth with teeth or a tongue what they lie on. shapeblend is told nothing. `make bench-faces` measures
this alone."""


class Score(NamedTuple):
    """How many eyes, of two, and mouths, of one, became what they should."""

    eyes: int
    mouths: int


def drawn(name: str) -> str:
    """The file that draws a face."""
    return icon_file("twemoji", name)


def become(a: str, b: str) -> dict[int, int]:
    """What each contour of a face becomes."""
    with tempfile.TemporaryDirectory() as folder:
        files = Path(folder, "a.svg"), Path(folder, "b.svg")
        for file, name in zip(files, (a, b), strict=True):
            file.write_text(drawn(name), encoding="utf-8")
        (pair,) = sb.blend(*map(str, files)).pairs
    return {c.a: c.b for c in pair.contours if c.a is not None and c.b is not None}


def measured(tools: Sequence[Tool] = ()) -> dict:
    """Every pair, by shapeblend."""
    scores = raw.columns(Score, [_score(*pair) for pair in PAIRS])
    return {"pairs": [f"{a} {b}" for a, b in PAIRS], **scores}


def _score(a: str, b: str) -> Score:
    found = become(a, b)
    *eyes, mouth = (found.get(p) == q for p, q in zip(FACES[a], FACES[b], strict=True))
    return Score(sum(eyes), int(mouth))


def wrong(found: dict) -> list[str]:
    """The pairs of faces in which not all is as it should be."""
    scores = zip(found["pairs"], raw.records(Score, found), strict=True)
    return [f"{pair}: {s.eyes} eyes, {s.mouths} mouths" for pair, s in scores if sum(s) < 3]


def section(found: dict) -> Section:
    scores, count = raw.records(Score, found), len(found["pairs"])
    row = [
        str(count),
        f"{sum(s.eyes for s in scores)} of {2 * count}",
        f"{sum(s.mouths for s in scores)} of {count}",
        f"{sum(sum(s) == 3 for s in scores)} of {count}",
    ]
    return Section("Faces", TEXT, Table(HEADER, [row]))
