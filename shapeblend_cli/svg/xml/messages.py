"""Messages of the reader: problems, and notes on differences from browsers."""

from __future__ import annotations

from collections import Counter

_MAX_PHRASES = 20


class Problem(Exception):
    """A fault of a file, and a remedy; `read` adds the name of the file."""


def check_limit(count: int, most: int, things: str) -> None:
    """Raise a Problem if there are more things than are read."""
    if count > most:
        raise Problem(f"more than {most} {things}, the limit")


class Notes:
    """Phrases, each with the number of times it applies."""

    def __init__(self) -> None:
        self._counts: Counter[str] = Counter()
        self.left_out = 0  # elements that browsers draw

    def add(self, phrase: str) -> None:
        """Add a phrase, or count it once more."""
        if phrase in self._counts or len(self._counts) < _MAX_PHRASES:
            self._counts[phrase] += 1

    def leave_out(self, phrase: str) -> None:
        """Add a phrase on an element that browsers draw."""
        self.add(phrase)
        self.left_out += 1

    def phrases(self) -> tuple[str, ...]:
        """Return the phrases in the order they first came up."""
        counts = self._counts.items()
        return tuple(phrase if count == 1 else f"{phrase} ({count} times)" for phrase, count in counts)


def printable(text: str, most: int = 40) -> str:
    """Return `text` fit for one line of a message: no control characters, not too long."""
    cut = text if len(text) <= most else text[: most - 3] + "..."
    return "".join(c if c.isprintable() else c.encode("unicode_escape").decode("ascii") for c in cut)
