"""Motion as if shapes were moved by hand: turned, scaled and shifted."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import ComplexArray, ContourBlend
    from shapeblend_cli.motion.alignment import Alignment


class Rigid(NamedTuple):
    """Motion in which a shape is rotated, scaled and shifted; all other change is on straight paths.

    A point from ``a`` to ``b`` is at time t at ``S(t) ((1 - t) a + t S^-1 b)``, where ``S(t)`` is the similarity
    ``S = S(1)`` as far as it has gone by then (`Alignment.apply`). If the shape is only rotated, ``S^-1 b`` is ``a``,
    and every in-between is that shape.
    """

    alignments: tuple[Alignment, ...]  # of each contour; contours of one part have the same

    @property
    def name(self) -> str:
        """The name for `--motion`."""
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
