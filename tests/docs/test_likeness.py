"""What docs/rank.md says of likeness, measured anew for two letters."""

import json

import numpy as np

from tools.quality import likeness


def test_letters_find_themselves_where_the_document_says(fonts):
    pair = likeness.FONTS[-1]
    written = json.loads(likeness.SCORES.read_text("utf-8"))[" into ".join(pair)]
    found = likeness.places(pair, "AX")
    where = [likeness.CHARACTERS.index(character) for character in "AX"]
    assert found["overlap"] == [written["overlap"][k] for k in where]
    for way in ("looks", "work"):
        assert np.abs(np.subtract(found[way], [written[way][k] for k in where])).max() <= 3
