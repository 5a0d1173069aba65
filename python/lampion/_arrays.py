# SPDX-License-Identifier: MIT
"""How NumPy's arrays become those of base.h and sh.h, which have pointers and strides in bytes.

float32 in native order passes as it is, whatever its strides; other numbers are converted. What is
converted, or has strides that C cannot have (negative ones, or such that lead to several axes), is
copied. Arrays broadcast over the axes that come before their last ones: those of a vector (3) or of
coefficients (n²)."""
from __future__ import annotations

import math
from typing import Any, Callable

import numpy as np

from ._core import bands as checked_bands
from ._core import constants, ffi

_cast = ffi.cast
_float_pointer = ffi.typeof("float *")  # types are looked up once, because strings are parsed
_vec3_array = ffi.typeof("lmp_vec3_array *")
_float_array = ffi.typeof("lmp_float_array *")
_sh_array = ffi.typeof("lmp_sh_array *")
_rgb_array = ffi.typeof("lmp_rgb_array *")
_float32 = np.dtype(np.float32)
_any: tuple[None, ...] = (None,)


def numbers(name: str, value: Any, core: tuple[int | None, ...] = (),
            dtype: np.dtype = _float32) -> np.ndarray:
    """value as an array whose last axes are `core`, None standing for any length."""
    if type(value) is np.ndarray:
        array = value
    else:
        try:
            array = np.asarray(value)
        except ValueError:
            raise ValueError(f"{name} must be an array, not a ragged sequence") from None
    if array.dtype != dtype:
        if array.dtype.kind not in "fiub":
            raise TypeError(f"{name} must be numbers, not {array.dtype}")
        with np.errstate(over="ignore"):
            array = array.astype(dtype)
    elif not array.flags.aligned:
        array = array.copy()
    ends = array.shape[array.ndim - len(core):] if array.ndim >= len(core) else ()
    if ends != core and (len(ends) != len(core) or any(
            want is not None and want != have for want, have in zip(core, ends))):
        wanted = ", ".join("n" if size is None else str(size) for size in core)
        raise ValueError(f"{name} must have the shape (…, {wanted}), not {array.shape}")
    return array


def indices(name: str, value: Any, count: int) -> np.ndarray:
    """value as an array of indices below count."""
    array = np.asarray(value)
    if array.size and array.dtype.kind not in "iu":
        raise TypeError(f"{name} must be integers, not {array.dtype}")
    if array.size and not (0 <= array.min() and array.max() < count):
        raise ValueError(f"{name} must be 0 … {count - 1}" if count
                         else f"{name} must be an index, and there is none")
    return array.astype(np.uintp)


def finite(name: str, array: np.ndarray) -> np.ndarray:
    """Refuses infinity and NaN."""
    if not np.isfinite(array).all():
        raise ValueError(f"{name} must be finite")
    return array


def within(name: str, array: np.ndarray, least: float, most: float = math.inf) -> np.ndarray:
    """Refuses numbers outside a range, and those that are not finite."""
    if array.size == 0:
        return array
    low, high = (array.item(),) * 2 if array.size == 1 else (array.min(), array.max())
    if not (least <= low and high <= most and abs(high) < math.inf):  # as NaN is not, either
        finite(name, array)
        bound = f"at least {least:g}" if most == math.inf else f"{least:g} … {most:g}"
        raise ValueError(f"{name} must be {bound}")
    return array


def unit(name: str, array: np.ndarray) -> np.ndarray:
    """Refuses vectors (…, 3) that are not unit, by the tolerance of base.h."""
    if array.size == 0:
        return array
    if array.size == 3:
        x, y, z = array.reshape(3).tolist()
        least = most = x * x + y * y + z * z
    else:
        x, y, z = array[..., 0], array[..., 1], array[..., 2]
        with np.errstate(over="ignore", invalid="ignore"):
            length2 = x * x  # a quarter of einsum's time
            length2 += y * y
            length2 += z * z
        least, most = length2.min(), length2.max()
    tolerance = constants.UNIT_TOLERANCE
    if not (1 - tolerance <= least and most <= 1 + tolerance):
        raise ValueError(f"{name} must be unit vectors: divide them by their lengths")
    return array


def directions(name: str, value: Any, dtype: np.dtype = _float32) -> np.ndarray:
    """Unit vectors (…, 3)."""
    return unit(name, numbers(name, value, (3,), dtype))


def points(name: str, value: Any) -> np.ndarray:
    """Vectors (…, 3). Their values are not looked at: of NaN comes NaN, as in NumPy."""
    return numbers(name, value, (3,))


def colors(name: str, value: Any) -> np.ndarray:
    """Finite colors (…, 3); a number stands for gray."""
    array = numbers(name, value)
    return finite(name, numbers(name, np.full(3, array) if array.ndim == 0 else array, (3,)))


def color(name: str, value: Any, most: float = float(np.finfo(np.float32).max)) -> list[float]:
    """One color 0 … most; a number stands for gray."""
    array = within(name, numbers(name, value), 0, most)
    if array.shape not in ((), (3,)):
        raise ValueError(f"{name} must be a number or a color of three, not {array.shape}")
    return np.broadcast_to(array, 3).tolist()


def coefficients(name: str, value: Any, core: tuple[int, ...] = (),
                 most: int = constants.BANDS_MAX,
                 dtype: np.dtype = _float32) -> tuple[int, np.ndarray]:
    """The bands of coefficients (…, *core, n²), and these as an array."""
    array = numbers(name, value, core + _any, dtype)
    count = array.shape[-1]
    bands = math.isqrt(count)
    if bands * bands != count or not 1 <= bands <= most:
        raise ValueError(f"{name} must have n² coefficients for 1 … {most} bands, not {count}")
    return bands, array


def per_band(name: str, value: Any, most: int = constants.BANDS_MAX) -> tuple[int, np.ndarray]:
    """The bands of an array (…, n), and it."""
    array = numbers(name, value, _any)
    return checked_bands(array.shape[-1], most), array


# --- many elements at once ----------------------------------------------------------------------


def pointer(array: np.ndarray, ctype: Any = _float_pointer) -> Any:
    """To the first element of an array, which must live as long as it is used."""
    if array.flags.c_contiguous:
        return _cast(ctype, ffi.from_buffer(array))
    return _cast(ctype, array.__array_interface__["data"][0])  # which takes ten times as long


def common_shape(*arrays: tuple[str, np.ndarray, int]) -> tuple[int, ...]:
    """The shape that arrays, given as name, array and number of core axes, broadcast to."""
    known = {array.shape[:array.ndim - core] for _, array, core in arrays if array.ndim > core}
    if len(known) < 2:
        return known.pop() if known else ()
    try:
        return np.broadcast_shapes(*known)
    except ValueError:
        listed = ", ".join(f"{name} {array.shape}" for name, array, _ in arrays)
        raise ValueError(f"these do not broadcast: {listed}") from None


def _elements(array: np.ndarray, core: int, shape: tuple[int, ...]) -> tuple[np.ndarray, int]:
    """An array whose elements, in the order of `shape`, are one stride in bytes apart, and that."""
    lead = array.ndim - core
    if array.shape[:lead] == shape and lead == 1:
        stride = array.strides[0]
    elif math.prod(array.shape[:lead]) == 1:
        return array, 0
    else:
        ends = array.shape[lead:]
        array = np.broadcast_to(array, shape + ends).reshape((-1,) + ends)
        stride = array.strides[0]
    if stride < 0:
        array = array.copy()
        stride = array.strides[0]
    return array, stride


def vec3_array(array: np.ndarray, shape: tuple[int, ...], keep: list) -> Any:
    """An lmp_vec3_array of vectors (…, 3) broadcast to `shape`; `keep` receives what must live."""
    array, stride = _elements(array, 1, shape)
    step = array.strides[-1] // array.itemsize
    x = pointer(array)
    keep.append(array)
    return ffi.new(_vec3_array, (x, x + step, x + 2 * step, stride))[0]


def float_array(array: np.ndarray, shape: tuple[int, ...], keep: list) -> Any:
    """An lmp_float_array of numbers broadcast to `shape`."""
    array, stride = _elements(array, 0, shape)
    keep.append(array)
    return ffi.new(_float_array, (pointer(array), stride))[0]


class Result:
    """What a function returns: `out`, if it is given, else a new array. The library writes to
    `target`, which is another array where `out` overlaps an argument or has a layout that C has
    not; `finish` copies it."""

    def __init__(self, out: np.ndarray | None, shape: tuple[int, ...], reads: list,
                 dtype: np.dtype = _float32, name: str = "out"):
        self.shape = shape
        if out is None:
            self.out = self.target = np.empty(shape, dtype)
            return
        if type(out) is not np.ndarray:
            raise TypeError(f"{name} must be an array, not {type(out).__name__}")
        if out.dtype != dtype:
            raise TypeError(f"{name} must be of {np.dtype(dtype).name}, not {out.dtype}")
        if out.shape != shape:
            raise ValueError(f"{name} must have the shape {shape}, not {out.shape}")
        if not out.flags.writeable:
            raise ValueError(f"{name} is read-only")
        self.out = self.target = out
        for array in reads:
            if np.may_share_memory(out, array):
                self.target = np.empty(shape, dtype)
        if not out.flags.aligned:
            self.target = np.empty(shape, dtype)

    def pointer(self, ctype: str = "float *") -> Any:
        """To contiguous memory for all elements."""
        if not self.target.flags.c_contiguous:
            self.target = np.empty(self.shape, self.target.dtype)
        return pointer(self.target, ctype)

    def _rows(self, core: int) -> np.ndarray:
        """The target as (count, values), which takes another target if that would be a copy."""
        lead = self.target.ndim - core
        flat = (math.prod(self.shape[:lead]), math.prod(self.shape[lead:]))
        if flat == self.target.shape:
            return self.target
        rows = self.target.reshape(flat)
        if not np.may_share_memory(rows, self.target):
            self.target = np.empty(self.shape, _float32)
            rows = self.target.reshape(flat)
        return rows

    def sh(self, core: int = 1) -> Any:
        """An lmp_sh_array; `core` axes are the values of an element."""
        rows = self._rows(core)
        (count, values), (step, inner) = rows.shape, rows.strides
        if (inner == 4 or values == 1) and step >= 4 * values:
            layout, stride = 0, step  # LMP_SH_INTERLEAVED
        elif step == 4 and inner >= 4 * count:
            layout, stride = 1, inner  # LMP_SH_PLANAR
        elif count * values == 0:
            layout, stride = 0, 0
        else:
            self.target = np.empty(self.shape, _float32)
            rows, layout, stride = self.target.reshape(count, values), 0, 0
        return ffi.new(_sh_array, (pointer(rows), stride, layout))[0]

    def rgb(self) -> Any:
        """An lmp_rgb_array of colors (…, 3)."""
        rows = self._rows(1)
        stride, inner = rows.strides
        if rows.size and (inner != 4 or stride < 12):
            self.target = np.empty(self.shape, _float32)
            rows, stride = self.target.reshape(-1, 3), 0
        return ffi.new(_rgb_array, (pointer(rows), stride))[0]

    def finish(self) -> Any:
        """The result; a NumPy scalar if it has no axes, as NumPy's functions return it."""
        if self.target is not self.out:
            np.copyto(self.out, self.target)
        return self.out if self.out.ndim else self.out[()]


# --- one element after another ------------------------------------------------------------------


def _packed(array: np.ndarray, core: int) -> np.ndarray:
    """An array, or a copy of it, each of whose elements is contiguous."""
    first = array[(0,) * (array.ndim - core)]
    return array if not core or first.flags.c_contiguous else np.ascontiguousarray(array)


def _pointers(array: np.ndarray, core: int, shape: tuple[int, ...], ctype: str) -> list:
    """Pointers to the elements of an array broadcast to `shape`."""
    lead = array.ndim - core
    spread = np.broadcast_to(array, shape + array.shape[lead:])
    offsets = np.zeros(shape, np.intp)
    for axis, (length, stride) in enumerate(zip(shape, spread.strides)):
        steps = np.arange(length) * stride
        offsets += steps.reshape((-1,) + (1,) * (len(shape) - axis - 1))
    start = int(_cast("uintptr_t", pointer(array)))
    return [_cast(ctype, start + offset) for offset in offsets.ravel().tolist()]


def each(out: np.ndarray | None, core: tuple[int, ...], call: Callable,
         *inputs: tuple[str, np.ndarray, int, str], dtype: np.dtype = _float32,
         ctype: str = "float *") -> Any:
    """Calls a function that takes one element, for each of arrays that broadcast: inputs are name,
    array, number of core axes and type of pointer. `call` gets pointers, the result's last."""
    shape = common_shape(*[(name, array, axes) for name, array, axes, _ in inputs])
    arrays = [array for _, array, _, _ in inputs]
    result = Result(out, shape + core, arrays, dtype)
    if math.prod(shape):
        result.pointer()
        arrays = [_packed(array, axes) for _, array, axes, _ in inputs]  # which pointers refer to
        columns = [_pointers(array, axes, shape, kind)
                   for array, (_, _, axes, kind) in zip(arrays, inputs)]
        columns.append(_pointers(result.target, len(core), shape, ctype))
        for row in zip(*columns):
            call(*row)
    return result.finish()
