"""svgpathtools and svgwrite, imported without modules that cost more time than the two themselves.

Both import modules for features this program does not use: `scipy.integrate` for the length of an arc, `urllib.request`
to embed web fonts, `webbrowser` and `tempfile` to show a drawing, `xml.dom.minidom` to read one, and of a validator
that is switched off `svgwrite.data.svgparser`, its regular expressions, and `svgwrite.data.tiny12`, what SVG Tiny has.
During the import each is replaced by a stand-in, which imports the real module when one of its functions is called.
"""

from __future__ import annotations

import importlib
import sys
import warnings
from contextlib import contextmanager
from types import ModuleType
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

_PUT_OFF = (
    "scipy.integrate",
    "svgwrite.data.svgparser",
    "svgwrite.data.tiny12",
    "tempfile",
    "urllib.request",
    "webbrowser",
    "xml.dom.minidom",
)


class _StandIn(ModuleType):
    """A module whose attributes are functions that call their namesakes in the real one."""

    def __getattr__(self, name: str) -> Callable[..., Any]:
        # The import system looks for names such as __path__, and takes their absence for an answer.
        if name.startswith("__"):
            raise AttributeError(name)
        module = self.__name__

        def call_through(*args: Any, **kwargs: Any) -> Any:
            return getattr(importlib.import_module(module), name)(*args, **kwargs)

        return call_through


@contextmanager
def _stand_ins() -> Iterator[None]:
    """Put stand-ins into `sys.modules` for modules that are not imported yet, and take them out again."""
    names = [name for name in _PUT_OFF if name not in sys.modules]
    if "scipy.integrate" in names and "scipy" not in sys.modules:
        # Importing a submodule imports its parent first, which here is most of the cost.
        names.append("scipy")
    placed = {name: _StandIn(name) for name in names}
    sys.modules.update(placed)
    try:
        yield
    finally:
        for name, stand_in in placed.items():
            if sys.modules.get(name) is stand_in:
                del sys.modules[name]


with _stand_ins(), warnings.catch_warnings():
    # A regular expression of svgpathtools 1.4.2 is no raw string.
    warnings.simplefilter("ignore", SyntaxWarning)
    warnings.simplefilter("ignore", DeprecationWarning)
    import svgpathtools
    import svgwrite
    from svgpathtools import parse_path

__all__ = ["parse_path", "svgpathtools", "svgwrite"]
