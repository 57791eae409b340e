"""What the parts of the reader raise: a problem whose file is not known yet."""

from __future__ import annotations


class Problem(Exception):
    """What is wrong with a file and what would work; the reader adds the file's name."""


def shown(text: str, most: int = 40) -> str:
    """Return `text` fit for one line of a message: no control characters, not too long."""
    cut = text if len(text) <= most else text[: most - 3] + "..."
    return "".join(c if c.isprintable() else c.encode("unicode_escape").decode("ascii") for c in cut)
