"""Types of arrays, arrays that nobody changes, and values that go round."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    ComplexArray = NDArray[np.complex128]
    FloatArray = NDArray[np.float64]
    PictureArray = NDArray[np.float32]
    IntArray = NDArray[np.intp]
    BoolArray = NDArray[np.bool_]
    UIntArray = NDArray[np.uint8]


def frozen(values: object, dtype: object) -> NDArray:  # type: ignore[type-arg]
    """Return a read-only array of `dtype` holding its own copy of `values`, which may be such an array already."""
    if type(values) is np.ndarray and values.base is None and values.dtype == dtype:
        flags = values.flags
        if not flags.writeable and flags.c_contiguous:
            return values
    array = np.array(values, dtype=dtype, order="C")  # type: ignore[call-overload]
    array.setflags(write=False)
    return array


def rolled(values: Any, by: int) -> Any:
    """Return values that went round by some places, those beyond the end to the beginning: `numpy.roll`, sooner.

    >>> rolled(np.arange(4), 1).tolist(), rolled(np.arange(4), -1).tolist()
    ([3, 0, 1, 2], [1, 2, 3, 0])
    """
    first = -by % max(len(values), 1)
    return np.concatenate([values[first:], values[:first]])


def numbered(counts: IntArray) -> IntArray:
    """Return numbers from 0 for each of several runs of these lengths.

    >>> numbered(np.array([2, 3])).tolist()
    [0, 1, 0, 1, 2]
    """
    ends = counts.cumsum()
    return np.arange(ends[-1] if len(ends) else 0) - (ends - counts).repeat(counts)


def median(values: Any) -> float:
    """Return the median, without the modules that numpy's own loads."""
    rising, count = np.sort(values), len(values)
    return 0.5 * float(rising[(count - 1) // 2] + rising[count // 2])


def unroll(dots: IntArray, period: tuple[int, int] | None) -> FloatArray:
    """Return (k, 2) dots as positions along both polygons that never fall.

    For closed polygons of `period` vertices, positions continue past the last vertex, and the first dot is repeated at
    the end: (k + 1, 2).
    """
    if period is None:
        return dots.astype(np.float64)
    steps = (rolled(dots, -1) - dots) % np.array(period)
    return np.concatenate([dots[:1], dots[:1] + steps.cumsum(axis=0)]).astype(np.float64)
