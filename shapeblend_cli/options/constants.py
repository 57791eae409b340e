"""The constants of the wire: the seven of the paper's table 1, and three of our own."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from shapeblend_cli.options.fields import Record, option
from shapeblend_cli.options.types import choice, number

WIRE = "The wire"

PAPER_DEFAULTS = {"k_s": 1.0, "p_b": 1000.0}
"""Defaults that change with the paper's bending."""

NOT_NEGATIVE, POSITIVE = number(0), number(0, above=True)


class WorkConstants(Record, section=WIRE):
    """The constants of the work that bends, stretches and moves a wire; the defaults are measured, not the paper's."""

    k_s: float = option(
        NOT_NEGATIVE,
        default=1.2,
        key="ks",
        help="Stiffness against stretching.",
        default_text=f"1.2; {PAPER_DEFAULTS['k_s']:g} with --bending paper",
    )
    k_b: float = option(NOT_NEGATIVE, default=1.0, key="kb", help="Stiffness against bending.")
    e_s: float = option(POSITIVE, default=2.0, key="es", help="Exponent of the stretching work.")
    e_b: float = option(POSITIVE, default=1.0, key="eb", help="Exponent of the bending work.")
    p_b: float = option(
        NOT_NEGATIVE,
        default=1.0,
        key="pb",
        help="Penalty for an angle that closes to zero.",
        default_text=f"1; {PAPER_DEFAULTS['p_b']:g} with --bending paper",
    )
    m_b: float = option(
        NOT_NEGATIVE,
        default=3.0,
        key="mb",
        help="Penalty for an angle that does not change monotonically; for --bending paper.",
    )
    c_s: float = option(
        number(0, 1, above=True),
        default=0.5,
        key="cs",
        help="How easily edges collapse to points: hardly ever near 0, freely at 1.",
    )
    bending: str = option(
        choice("turn", "paper"),
        default="turn",
        help="Measure of bending. turn: the change in how far the wire turns; paper: the change of its angle along "
        "straight vertex paths (equation 17).",
    )
    k_t: float = option(
        NOT_NEGATIVE,
        default=7.0,
        key="kt",
        help="Stiffness against travel, which keeps points of the wire near their places.",
    )
    smoothing: float = option(
        number(0, 0.1),
        default=0.01,
        help="Scale of bending: most of it is measured on outlines that are smoothed this far, as a share of their "
        "length.",
    )

    def _defaults(self, given: Mapping[str, Any]) -> dict[str, Any]:
        paper = PAPER_DEFAULTS if given.get("bending") == "paper" else {}
        return super()._defaults(given) | paper


PAPER: dict[str, Any] = {"bending": "paper", "k_t": 0.0, "smoothing": 0.0}
"""Settings that leave only the paper's model of work."""

TABLE_1 = ("k_s", "k_b", "e_s", "e_b", "p_b", "m_b", "c_s", "band")
"""The columns of table 1; the last is the diagonal deviation dd."""

PRESETS: dict[str, dict[str, Any]] = {
    name: dict(zip(TABLE_1, row, strict=True)) | PAPER
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
} | {"paper": PAPER}
"""The paper's model with the default constants, and rows of table 1 by their figures."""
