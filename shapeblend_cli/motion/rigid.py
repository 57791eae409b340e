"""Motion as if the shape were moved by hand: turned, scaled and shifted, and what else changes on straight paths."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import ComplexArray, ContourBlend
    from shapeblend_cli.motion.alignment import Alignment


class Rigid(NamedTuple):
    """The best similarity between the outlines is taken apart from the rest, which goes straight.

    A point on the way from ``a`` to ``b`` is at time t ``S(t) ((1 - t) a + t S^-1 b)``, where ``S(t)`` is what of the
    similarity ``S = S(1)`` has been gone through by then (`Alignment.placed`). Of a shape and the same shape turned,
    ``S^-1 b`` is ``a``, and every in-between is that shape.

    Attributes
    ----------
    alignment : Alignment
    """

    alignment: Alignment

    @property
    def name(self) -> str:
        """As `--motion` has it."""
        return "rigid"

    def segments(self, contours: Sequence[ContourBlend], t: float) -> list[ComplexArray]:
        """Control points of each contour at time t."""
        alignment = self.alignment
        return [
            alignment.placed(
                (1.0 - t) * (contour.start.segments - alignment.centre_a)
                + t * alignment.taken_back(contour.end.segments),
                t,
            )
            for contour in contours
        ]
