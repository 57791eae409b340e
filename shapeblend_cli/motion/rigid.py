"""Motion of shapes that are moved by hand: turned, scaled and shifted."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import ComplexArray, ContourBlend
    from shapeblend_cli.motion.alignment import Alignment


class Rigid(NamedTuple):
    """Motion as if a shape were moved by hand: rotated, scaled and shifted, and what else changes moves straight.

    A point between ``a`` and ``b`` is at time t ``S(t) ((1 - t) a + t S^-1 b)``, where ``S(t)`` is the part of the
    similarity ``S = S(1)`` gone through by then (`Alignment.apply`). Of a shape and the same shape rotated, ``S^-1 b``
    is ``a``, and every in-between is that shape.
    """

    alignments: tuple[Alignment, ...]  # of each contour; those of one part have the same

    @property
    def name(self) -> str:
        """As `--motion` has it."""
        return "rigid"

    def segments(self, contours: Sequence[ContourBlend], t: float) -> list[ComplexArray]:
        """Return the control points of each contour at time t."""
        return [
            alignment.apply(
                (1.0 - t) * (contour.start.segments - alignment.centre_a)
                + t * alignment.undo(contour.end.segments),
                t,
            )
            for contour, alignment in zip(contours, self.alignments, strict=True)
        ]
