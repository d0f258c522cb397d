"""What comes in as arrays: checked, and told about by argument, shape and what was expected."""

from typing import Any, Optional

import numpy as np


def _numbers(name: str, value: Any, expected: str) -> np.ndarray:
    try:
        array = np.asarray(value)
    except ValueError as error:  # rows of different lengths
        raise ValueError(f"{name}: {expected} was expected, but this is no array: {error}") from None
    if array.dtype.kind not in "fiu":
        raise ValueError(f"{name}: {expected} was expected, but its dtype is {array.dtype}, shape {array.shape}")
    return array


def _told_shape(array: np.ndarray) -> str:
    hint = "; transpose it" if array.ndim == 2 and array.shape[0] == 3 and array.shape[1] != 3 else ""
    return f"its shape is {array.shape}{hint}"


def _finite(name: str, array: np.ndarray, what: str) -> np.ndarray:
    bad = ~np.isfinite(array)
    if bad.ndim > 1:
        bad = bad.any(axis=1)
    if bad.any():
        raise ValueError(f"{name}: finite {what} were expected, but {int(bad.sum())} of {len(array)} rows hold NaN or infinity, row {int(bad.argmax())} first; "
                         f"leave them out with {name}[numpy.isfinite({name}).all(axis=1)]")
    return array


def points(name: str, value: Any, least: int = 1, columns: int = 3) -> np.ndarray:
    """A (n, columns) float64 array of finite numbers, without a copy where it is one already."""
    expected = f"an array of shape (n, {columns}), n >= {least}, of numbers"
    array = _numbers(name, value, expected)
    if array.ndim != 2 or array.shape[1] != columns or len(array) < least:
        raise ValueError(f"{name}: {expected} was expected, but {_told_shape(array)}")
    return _finite(name, np.ascontiguousarray(array, dtype=np.float64), "numbers")


def unit_normals(name: str, value: Any, count: int) -> np.ndarray:
    """A (count, 3) float64 array; rows that are not finite stand for no normal."""
    expected = f"an array of shape ({count}, 3), a normal for each point,"
    array = _numbers(name, value, expected)
    if array.shape != (count, 3):
        raise ValueError(f"{name}: {expected} was expected, but {_told_shape(array)}")
    return np.ascontiguousarray(array, dtype=np.float64)


def triangles(name: str, value: Any, vertices: int) -> np.ndarray:
    """A (m, 3) int32 array of indices of vertices."""
    expected = "an array of shape (m, 3) of whole numbers"
    array = np.asarray(value)
    if array.ndim != 2 or array.shape[1] != 3 or array.dtype.kind not in "iu":
        raise ValueError(f"{name}: {expected} was expected, but its dtype is {array.dtype}, {_told_shape(array)}")
    if len(array) and (array.min() < 0 or array.max() >= vertices):
        wrong = int(array.min()) if array.min() < 0 else int(array.max())
        raise ValueError(f"{name}: indices from 0 to {vertices - 1} were expected, as there are {vertices} vertices, but one is {wrong}")
    return np.ascontiguousarray(array, dtype=np.int32)


def values(name: str, value: Any, count: int, dtype: Any) -> np.ndarray:
    """A (count,) array of the dtype, one value for each vertex."""
    expected = f"an array of shape ({count},), a number for each vertex,"
    array = _numbers(name, value, expected)
    if array.shape != (count,):
        raise ValueError(f"{name}: {expected} was expected, but its shape is {array.shape}")
    return np.ascontiguousarray(array, dtype=dtype)


def way(name: str, value: Optional[str]) -> str:
    """Which way z grows: 'up', 'down' or 'auto'."""
    if value not in (None, "auto", "up", "down"):
        raise ValueError(f"{name}: 'up', 'down' or 'auto' was expected, not {value!r}")
    return value or "auto"
