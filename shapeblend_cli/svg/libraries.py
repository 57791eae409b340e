"""`parse_path` of svgpathtools, imported without modules that cost more time than reading a drawing.

The package imports all its modules and svgwrite. Its parser imports `scipy.integrate`, for the length of an arc, and
`webbrowser`, to show a drawing, which this program does not use.
"""

from __future__ import annotations

import sys
import warnings
from contextlib import contextmanager
from importlib.util import find_spec
from types import ModuleType
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator

PACKAGE = "svgpathtools"


@contextmanager
def _alone() -> Iterator[None]:
    """Let the parser be imported with stand-ins for its package and for what it does not need.

    Afterwards `sys.modules` is as it was, so that another import gets the whole package.
    """
    spec = find_spec(PACKAGE)
    package = ModuleType(PACKAGE)
    package.__path__ = list(spec.submodule_search_locations or ()) if spec else []
    stand_ins = {PACKAGE: package, "scipy.integrate": None, "webbrowser": ModuleType("webbrowser")}
    placed = {name: module for name, module in stand_ins.items() if name not in sys.modules}
    sys.modules.update(placed)  # type: ignore[arg-type]  # None: it cannot be imported
    try:
        yield
    finally:
        for name in [*placed, *(name for name in sys.modules if name.startswith(f"{PACKAGE}."))]:
            if name in placed or PACKAGE in placed:
                del sys.modules[name]


with _alone(), warnings.catch_warnings():
    # A regular expression of svgpathtools 1.4.2 is no raw string.
    warnings.simplefilter("ignore", SyntaxWarning)
    warnings.simplefilter("ignore", DeprecationWarning)
    from svgpathtools.parser import parse_path

__all__ = ["parse_path"]
