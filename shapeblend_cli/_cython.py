"""What kernels use of the ``cython`` module, for a Python without Cython.

Cython resolves ``import cython`` while it compiles, so compiled kernels never come here. Uncompiled ones do
where Cython is not installed: every declaration below then means nothing, and the code runs as plain Python.
"""

from typing import Any, Final

compiled: Final = False


class _Type:
    """A C type; calling it converts nothing."""

    def __getitem__(self, _what: object) -> "_Type":
        """Declare a memoryview, as in ``double[:, ::1]``, or qualify a type, as in ``const[double]``."""
        return self

    def __call__(self, value: Any = None) -> Any:
        return value


class _Directive:
    """A directive in each of its three uses: ``@d``, ``@d(...)`` and ``with d:``."""

    def __call__(self, *args: Any, **_settings: Any) -> Any:
        if len(args) == 1 and callable(args[0]) and not isinstance(args[0], _Type | type):
            return args[0]
        return _unchanged

    def __enter__(self) -> None:
        pass

    def __exit__(self, *_exc_info: object) -> None:
        pass


def _unchanged(function: Any) -> Any:
    return function


void = char = uchar = bint = short = int = uint = long = longlong = Py_ssize_t = size_t = _Type()
float = double = complex = floatcomplex = doublecomplex = const = _Type()

cfunc = ccall = inline = nogil = gil = _Directive()
returns = locals = exceptval = _Directive()
boundscheck = wraparound = cdivision = initializedcheck = infer_types = _Directive()


def cast(_type: object, value: Any) -> Any:
    """Return the value as it is."""
    return value


def declare(_type: object = None, value: Any = None, **_variables: object) -> Any:
    """Return the value as it is."""
    return value
