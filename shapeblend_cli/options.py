"""Options and parameter types of the command line."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import click

from shapeblend_cli.presets import PRESETS

if TYPE_CHECKING:
    from collections.abc import Callable

    Decorator = Callable[[Callable[..., Any]], Callable[..., Any]]

CONSTANTS = {
    "ks": (1.0, "Stiffness against stretching."),
    "kb": (1.0, "Stiffness against bending."),
    "es": (2.0, "Exponent of stretching."),
    "eb": (1.0, "Exponent of bending."),
    "pb": (1000.0, "Penalty for an angle that closes to zero."),
    "mb": (10.0, "Penalty for an angle that goes back and forth."),
    "cs": (0.5, "Edges collapse to points: near 0 hardly ever, 1 easily."),
}
"""The paper's seven constants: default and help."""


class StartType(click.ParamType[Any]):
    """``auto``, or two vertex numbers ``I,J``."""

    name = "auto|I,J"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """Turn ``auto`` into None and ``I,J`` into two numbers."""
        if value == "auto" or isinstance(value, tuple):
            return None if value == "auto" else value
        try:
            i, j = (int(part) for part in value.split(","))
        except ValueError:
            self.fail(f"{value!r} is neither 'auto' nor two vertex numbers such as 0,3.", param, ctx)
        if i < 0 or j < 0:
            self.fail(f"{value!r}: vertex numbers begin at 0.", param, ctx)
        return i, j


class ConstantType(click.ParamType[float]):
    """A finite number, not negative; above zero where zero means nothing, and at most one for c_s."""

    name = "X"

    def __init__(self, positive: bool, largest: float) -> None:
        self.positive = positive
        self.largest = largest

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> float:
        """Read a number and hold it against its range."""
        try:
            number = float(value)
        except ValueError:
            self.fail(f"{value!r} is not a number.", param, ctx)
        least = "greater than 0" if self.positive else "0 or more"
        if not math.isfinite(number) or number < 0.0 or (self.positive and number == 0.0):
            self.fail(f"{value} must be {least}.", param, ctx)
        if number > self.largest:
            self.fail(f"{value} must be at most {self.largest:g}.", param, ctx)
        return number


def constant_options(command: Callable[..., Any]) -> Callable[..., Any]:
    """``--ks`` to ``--cs`` and ``--preset``."""
    add = click.option(
        "--preset",
        type=click.Choice(list(PRESETS)),
        help="The constants of a row of the paper's table 1; single constants given beside it win.",
    )
    command = add(command)
    for name, (default, text) in reversed(CONSTANTS.items()):
        kind = ConstantType(name in ("es", "eb", "cs"), 1.0 if name == "cs" else math.inf)
        command = click.option(f"--{name}", type=kind, help=f"{text}  [default: {default:g}]")(command)
    return command


def constants_in_force(preset: str | None, given: dict[str, float | None]) -> dict[str, float]:
    """The seven constants: what was given, else the preset's, else the default."""
    base = {name: default for name, (default, _) in CONSTANTS.items()}
    return base | PRESETS.get(preset or "", {}) | {name: x for name, x in given.items() if x is not None}
