"""The ids of a document that is written."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from shapeblend_cli.model import KeyframedShape, PaintedShape, ShapeBlend


class Ids:
    """The ids of a document, each used once; `reserved` ids are kept for elements that take them by name.

    New ones begin with what `own` returns, so that several documents can stand in one page.
    """

    def __init__(
        self,
        reserved: Iterable[str | None] = (),
        taken: Iterable[str] = (),
        own: Callable[[], str] = str,
    ) -> None:
        self._reserved = set(reserved)
        self._taken = set(taken)
        self._own = own

    @classmethod
    def of(
        cls, shapes: Iterable[PaintedShape | KeyframedShape | ShapeBlend], own: Callable[[], str] = str
    ) -> Ids:
        """Return the ids of a document of some shapes."""
        names = (
            name.id for shape in shapes for name in (shape.name, *(group.name for group in shape.groups))
        )
        return cls(names, own=own)

    def take(self, name: str | None) -> str | None:
        """Return an id if it is still free, else None."""
        if name is None or name in self._taken:
            return None
        self._taken.add(name)
        return name

    def new(self, name: str) -> str:
        """Return an id that begins so, with a number if it is taken."""
        name = self._own() + name
        number, free = 1, name
        while free in self._taken or free in self._reserved:
            number += 1
            free = f"{name}-{number}"
        self._taken.add(free)
        return free
