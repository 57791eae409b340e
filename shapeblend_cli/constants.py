"""The paper's seven constants, and those of its table 1."""

from __future__ import annotations

from shapeblend_cli.field_types import number
from shapeblend_cli.fields import Record, option

WIRE = "The wire: the paper's seven constants"

NOT_NEGATIVE, POSITIVE = number(0), number(0, above=True)


class WorkConstants(Record, section=WIRE):
    """The constants of the work that bends and stretches a wire; the defaults are measured, not the paper's."""

    k_s: float = option(NOT_NEGATIVE, default=1.0, key="ks", help="Stiffness against stretching.")
    k_b: float = option(NOT_NEGATIVE, default=1.0, key="kb", help="Stiffness against bending.")
    e_s: float = option(POSITIVE, default=2.0, key="es", help="Exponent of the stretching work.")
    e_b: float = option(POSITIVE, default=1.0, key="eb", help="Exponent of the bending work.")
    p_b: float = option(
        NOT_NEGATIVE, default=1000.0, key="pb", help="Penalty for an angle that closes to zero."
    )
    m_b: float = option(
        NOT_NEGATIVE,
        default=3.0,
        key="mb",
        help="Penalty for an angle that does not change monotonically.",
    )
    c_s: float = option(
        number(0, 1, above=True),
        default=0.5,
        key="cs",
        help="How easily edges collapse to points: hardly ever near 0, freely at 1.",
    )


PRESETS: dict[str, dict[str, float]] = {
    name: dict(zip((*WorkConstants.options, "band"), row, strict=True))
    for name, row in {
        "fig1": (1.0, 0.2, 2.0, 2.0, 1000.0, 10.0, 0.5, 0.06),
        "fig2": (0.0, 1.0, 2.0, 2.0, 1000.0, 10.0, 0.5, 0.09),
        "fig3": (1.0, 1.0, 2.0, 0.5, 1000.0, 10.0, 0.5, 0.09),
        "fig8": (0.0, 1.0, 2.0, 0.8, 1000.0, 10.0, 0.5, 0.0),
        "fig10": (1.0, 0.0, 2.0, 1.0, 1000.0, 10.0, 0.5, 0.0),
        "fig11": (0.0, 1.0, 2.0, 1.0, 1000.0, 10.0, 0.5, 0.125),
        "fig27": (0.3, 1.0, 2.0, 0.3, 1000.0, 10.0, 0.5, 0.245),
        "fig28": (1.0, 0.1, 2.0, 0.1, 1000.0, 10.0, 0.5, 0.04),
    }.items()
}
"""Rows of table 1 by their figures: the constants, and the diagonal deviation dd as a band."""
