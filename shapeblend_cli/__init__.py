"""Blend one 2-D shape into another with the least work of bending and stretching.

import shapeblend_cli as sb

blend = sb.blend("hen.svg", "pecking.svg")  # drawings, or names of files
blend.frame(0.5)                            # a picture, which a notebook shows
blend.save("moving.svg", duration=2.0)      # any format that the command has
match = sb.match(p0, p1)                    # polygons alone, as arrays
"""

# Nothing is imported here: a signal that came meanwhile would end the command with a traceback (see `__main__`).
TYPE_CHECKING = False

if TYPE_CHECKING:
    from shapeblend_cli.api import Blend, Picture, blend, match, read
    from shapeblend_cli.errors import ShapeblendError
    from shapeblend_cli.model import Correspondence, Drawing
    from shapeblend_cli.options.settings import Settings
    from shapeblend_cli.outputs.options import OutputOptions
    from shapeblend_cli.version import __version__

_MODULES = {
    "Blend": "api",
    "Correspondence": "model",
    "Drawing": "model",
    "OutputOptions": "outputs.options",
    "Picture": "api",
    "Settings": "options.settings",
    "ShapeblendError": "errors",
    "__version__": "version",
    "blend": "api",
    "match": "api",
    "read": "api",
}

__all__ = [
    "Blend",
    "Correspondence",
    "Drawing",
    "OutputOptions",
    "Picture",
    "Settings",
    "ShapeblendError",
    "__version__",
    "blend",
    "match",
    "read",
]


def __getattr__(name: str) -> object:
    """Import a public name when it is first used: `shapeblend --help` needs none of them."""
    if name not in _MODULES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from importlib import import_module

    return getattr(import_module(f"{__name__}.{_MODULES[name]}"), name)


def __dir__() -> list[str]:
    return __all__
