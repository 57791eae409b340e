"""Types of arrays, and arrays that nobody changes."""

from __future__ import annotations

from typing import TYPE_CHECKING

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
    """Return a read-only array of `dtype` holding its own copy of `values`."""
    array = np.array(values, dtype=dtype, order="C")  # type: ignore[call-overload]
    array.setflags(write=False)
    return array
