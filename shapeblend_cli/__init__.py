"""Blend one 2-D shape into another with the least work of bending and stretching."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from shapeblend_cli.constants import WorkConstants
    from shapeblend_cli.errors import ShapeblendError
    from shapeblend_cli.pipeline import blend, correspond
    from shapeblend_cli.settings import Settings
    from shapeblend_cli.svg.reading.read import read

__version__ = "0.1.0"
__all__ = ["Settings", "ShapeblendError", "WorkConstants", "__version__", "blend", "correspond", "read"]

_HOMES = {
    "Settings": "settings",
    "ShapeblendError": "errors",
    "WorkConstants": "constants",
    "blend": "pipeline",
    "correspond": "pipeline",
    "read": "svg.reading.read",
}


def __getattr__(name: str) -> Any:
    """Import a public name when it is first used: `shapeblend --help` needs none of them."""
    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from importlib import import_module

    return getattr(import_module(f"{__name__}.{_HOMES[name]}"), name)
