"""The page that `make bulk` writes."""

import json

from tools.bulk import DOCUMENT, RAW, document


def test_the_page_is_what_was_measured():
    assert DOCUMENT.read_text("utf-8") == document(json.loads(RAW.read_text("utf-8")))
