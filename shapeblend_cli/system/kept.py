"""What was made already, kept for when it is needed again: drawings that are in many pairs of a batch."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Hashable
from functools import cached_property
from typing import Any


class Kept:
    """Values by their keys: those that were used last, `most` of them, and none that is made of much.

    >>> kept = Kept(most=2)
    >>> for key in "ab":
    ...     kept.keep(key, key.upper(), size=1)
    >>> kept.find("a")
    'A'
    >>> kept.keep("c", "C", size=1)
    >>> [kept.find(key) for key in "abc"]
    ['A', None, 'C']
    """

    def __init__(self, most: int = 256, largest: int = 20_000, steps: int = 0) -> None:
        self._values: OrderedDict[Hashable, Any] = OrderedDict()
        self._most = most
        self._largest = largest
        self._steps = steps

    @cached_property
    def steps(self) -> Kept:
        """What was made on the way from drawings to a blend, for when they are blended again a little otherwise."""
        return Kept(self._steps)

    @property
    def keeps(self) -> bool:
        """Whether anything is kept at all."""
        return self._most > 0

    def find(self, key: Hashable) -> Any:
        """Return a value; None if it is not kept."""
        if key in self._values:
            self._values.move_to_end(key)
        return self._values.get(key)

    def keep(self, key: Hashable, value: Any, size: int) -> None:
        """Keep a value that was made of about this number of bytes."""
        if size <= self._largest:
            self._values[key] = value
            if len(self._values) > self._most:
                self._values.popitem(last=False)
