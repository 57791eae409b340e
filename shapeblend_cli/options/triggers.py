"""The triggers of an animation, and their opposites."""

from __future__ import annotations

import re
from typing import NamedTuple

LOAD, CLICK, HOVER = "load", "click", "hover"

OPPOSITES = {
    "mouseenter": "mouseleave",
    "mouseover": "mouseout",
    "pointerenter": "pointerleave",
    "pointerover": "pointerout",
    "focusin": "focusout",
    "focus": "blur",
    "mousedown": "mouseup",
    "pointerdown": "pointerup",
    "touchstart": "touchend",
    "keydown": "keyup",
}
"""Events that start an animation, and the events that take it back."""

_EVENT = r"([^\s.;,'\"<>&]+)\.([A-Za-z][A-Za-z0-9-]*)"


class Trigger(NamedTuple):
    """The trigger of an animation: loading, a click, the pointer on it, or the event of an element."""

    kind: str = LOAD  # or "event"
    name: str = ""  # of the element, its id
    event: str = ""

    def __str__(self) -> str:
        """As `--trigger` has it."""
        return f"{self.name}.{self.event}" if self.name else self.kind

    @property
    def is_load(self) -> bool:
        """Whether the animation begins by itself."""
        return self.kind == LOAD

    @property
    def opposite(self) -> str | None:
        """The event that brings it back, if there is one; else the same event does."""
        return OPPOSITES.get(self.event)


def parse(text: str) -> Trigger:
    """Read ``load``, ``click``, ``hover`` or ``NAME.event``; raise ValueError for anything else."""
    if text in (LOAD, CLICK, HOVER):
        return Trigger(text)
    match = re.fullmatch(_EVENT, text)
    if match is None:
        raise ValueError(text)
    return Trigger("event", match[1], match[2])
