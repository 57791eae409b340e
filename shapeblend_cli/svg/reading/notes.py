"""What a drawing's notes say: phrases, each with the number of times it applies."""

from __future__ import annotations

from collections import Counter

_MAX_PHRASES = 20


class Notes:
    """Phrases on what was left out or read otherwise than a browser would."""

    def __init__(self) -> None:
        self._counts: Counter[str] = Counter()

    def add(self, phrase: str) -> None:
        """Add a phrase, or count it once more."""
        if phrase in self._counts or len(self._counts) < _MAX_PHRASES:
            self._counts[phrase] += 1

    def phrases(self) -> tuple[str, ...]:
        """Return the phrases in the order they first came up."""
        counts = self._counts.items()
        return tuple(phrase if count == 1 else f"{phrase} ({count} times)" for phrase, count in counts)
