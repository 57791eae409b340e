"""Whether there is what pictures need: it comes with an extra, and is imported only where they are asked for."""

from __future__ import annotations

from importlib import import_module

from shapeblend_cli.errors import PictureError


def check_libraries(kind: str) -> None:
    """Refuse pictures where they cannot be drawn.

    Raises
    ------
    PictureError
    """
    try:
        for name in ("resvg_py", "PIL.Image"):
            import_module(name)
    except ImportError as error:
        raise PictureError(
            "pictures need resvg_py and Pillow; pip install 'shapeblend[pictures]' installs them"
        ) from error
    if kind == "webp" and not import_module("PIL.features").check("webp"):
        raise PictureError("the Pillow that is installed writes no WebP; .apng would work")
