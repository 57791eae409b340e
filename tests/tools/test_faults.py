"""docs/reliability.md is what `make faults` writes."""

import re

from tools.faults.document import DOCUMENT, Counts, document


def test_the_document_is_that_of_its_counts():
    text = DOCUMENT.read_text("utf-8")
    rows = dict(re.findall(r"^\| (.+?) \| (\d+) \| 0 \|$", text, re.MULTILINE))
    counts = Counts(
        namespaces=int(rows["process 1 of a PID namespace killed, and run again in another"]),
        errors=int(rows["a disk error at a move"]),
        kills=int(rows["SIGKILL at a move"]),
        meetings=int(rows["two runs at once on one target"]),
    )
    assert document(counts) == text
    assert counts.kills >= 200
    assert counts.meetings >= 200
