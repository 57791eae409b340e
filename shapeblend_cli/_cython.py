"""What kernels use of the ``cython`` module, for a Python without Cython.

Cython resolves ``import cython`` while it compiles, so compiled kernels never come here. Uncompiled ones do
where Cython is not installed: every declaration below then means nothing, and the code runs as plain Python.
"""

from builtins import int as _whole
from collections import namedtuple
from typing import Any, Final

compiled: Final = False


class _Type:
    """A C type."""

    def __getitem__(self, _axes: object) -> "_Type":
        """Declare a memoryview, as in ``double[:, ::1]``."""
        return self


class _Unlocked:
    """Python without its lock, as a decorator and as a context: not here."""

    def __call__(self, decorated: Any) -> Any:
        """Return what is decorated as it is."""
        return decorated

    def __enter__(self) -> None:
        pass

    def __exit__(self, *_error: object) -> None:
        pass


def _unchanged(decorated: Any) -> Any:
    """A directive without settings: ``@cfunc``."""
    return decorated


def _directive(*_settings: object, **_named: object) -> Any:
    """A directive with settings: ``@boundscheck(False)``."""
    return _unchanged


const = int = bint = uchar = p_char = double = doublecomplex = void = _Type()
Py_ssize_t, longlong, ulonglong = _Type(), _Type(), _Type()
nogil = _Unlocked()

cclass = final = cfunc = ccall = inline = _unchanged
exceptval = boundscheck = wraparound = cdivision = _directive


def look_for_signals() -> None:
    """Do what Python does by itself between its instructions, and compiled code does not."""


def cast(new_type: object, value: Any) -> Any:
    """Return the value as it is; as an index or a long number, without what lies behind the point."""
    return _whole(value) if new_type in (Py_ssize_t, longlong, ulonglong) else value


def declare(_type: object = None, value: Any = None, **_variables: object) -> Any:
    """Return the value as it is."""
    return value


def struct(**members: object) -> type:
    """Make a type with these members."""
    return namedtuple("struct", members)
