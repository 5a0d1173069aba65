# SPDX-License-Identifier: MIT
"""Lobes and BRDFs integrated over caps in advance (lampion/preintegrated.h): a lookup costs the
same at any number of bands. How they are stored may change in a minor version.
"""
from __future__ import annotations

from types import SimpleNamespace
from typing import Any, Callable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _arrays, _core, _host
from ._core import constants, ffi, lib
from .brdf import Table, as_table
from .sh import Window

__all__ = ["Lobe", "Brdf"]

_error_min = constants.PREINTEGRATED_LOBE_ERROR_MIN


def _bound(error: float) -> float:
    return _core.number_or_0("error", error, _error_min, 0.1)


class Lobe(_host.Stored):
    """The response of Phong lobes of any exponent to caps.

    Parameters
    ----------
    bands : int
        0 means 10.
    window, window_size
        As in `sh.make_window`.
    error : float
        The largest error relative to the largest value, 0.002 … 0.1; 0 means 0.005.
    threads, progress
        As for `brdf.Table`.
    """

    __slots__ = ()
    _ctype, _destroy = "lmp_preintegrated_lobe", lib.lmp_preintegrated_lobe_destroy
    _read, _size = lib.lmp_preintegrated_lobe_read, lib.lmp_preintegrated_lobe_size
    _write = lib.lmp_preintegrated_lobe_write

    def __init__(self, bands: int = 0, *, window: str | int = "none", window_size: float = 0,
                 error: float = 0, threads: int = 1,
                 progress: Callable[[float], Any] | None = None):
        desc = ffi.new("lmp_preintegrated_lobe_desc *",
                       (_core.integer_or_0("bands", bands, 1, constants.BANDS_MAX),
                        _core.choice("window", Window, window),
                        _core.number("window_size", window_size, 0), _bound(error)))
        self._create(lambda host, lobe: lib.lmp_preintegrated_lobe_create(host, desc, lobe),
                     _host.Host(threads, progress))

    def eval(self, exponent: ArrayLike, one_minus_cos: ArrayLike,
             cosine: ArrayLike) -> NDArray[np.float32]:
        """Responses (…) to caps of unit strength: exponent >= 0, 1 - cos of a cap's half angle,
        0 … 1, and the cosine of the angle between the axes, -1 … 1."""
        arrays = [
            _arrays.within("exponent", _arrays.numbers("exponent", exponent), 0),
            _arrays.within("one_minus_cos", _arrays.numbers("one_minus_cos", one_minus_cos), 0, 1),
            _arrays.within("cosine", _arrays.numbers("cosine", cosine), -1, 1)]

        def call(exponent: Any, size: Any, cosine: Any, value: Any) -> None:
            value[0] = lib.lmp_preintegrated_lobe_eval(self._c, exponent[0], size[0], cosine[0])

        names = ("exponent", "one_minus_cos", "cosine")
        return _arrays.each(None, (), call, *[(name, array, 0, "float *")
                                              for name, array in zip(names, arrays)])

    def describe(self) -> SimpleNamespace:
        """Its bands, window, error, bytes and the arrays cells, coefficients (pairs, 2) and remap
        that a kernel of your own reads."""
        found = lib.lmp_preintegrated_lobe_describe(self._c)
        info = _core.record(found)
        info.cells = _core.view(self, found.cells, (found.cell_count,),
                                _core.dtype_of("lmp_preintegrated_lobe_cell"))
        info.coefficients = _core.view(self, found.coefficients, (found.pair_count, 2), np.int16)
        info.remap = _core.view(self, found.remap, (constants.PREINTEGRATED_LOBE_REMAP_COUNT,),
                                np.float32)
        return info


class Brdf(_host.Stored):
    """The response of an isotropic BRDF's table to caps.

    Parameters
    ----------
    table : brdf.Table
        Isotropic; it is not kept.
    error : float
        As for `Lobe`.
    bytes_max : int
        Of the result; 0 means 2^27.
    threads, progress
        As for `brdf.Table`.
    """

    __slots__ = ()
    _ctype, _destroy = "lmp_preintegrated_brdf", lib.lmp_preintegrated_brdf_destroy
    _read, _size = lib.lmp_preintegrated_brdf_read, lib.lmp_preintegrated_brdf_size
    _write = lib.lmp_preintegrated_brdf_write

    def __init__(self, table: Table, *, error: float = 0, bytes_max: int = 0, threads: int = 1,
                 progress: Callable[[float], Any] | None = None):
        desc = ffi.new("lmp_preintegrated_brdf_desc *",
                       (_bound(error), _core.integer("bytes_max", bytes_max, 0, 2**63 - 1)))
        source = as_table(table)
        self._create(lambda host, brdf:
                     lib.lmp_preintegrated_brdf_create(host, desc, source, brdf),
                     _host.Host(threads, progress))

    def eval(self, cos_theta_o: ArrayLike, axis: ArrayLike,
             one_minus_cos: ArrayLike) -> NDArray[np.float32]:
        """Responses (…, 3) to caps of unit strength: cosine of the view's angle 0 … 1 (…), axis of
        the cap in the frame of the view (…, 3), unit, 1 - cos of its half angle, 0 … 1 (…)."""
        cosines = _arrays.within("cos_theta_o", _arrays.numbers("cos_theta_o", cos_theta_o), 0, 1)
        sizes = _arrays.within("one_minus_cos",
                               _arrays.numbers("one_minus_cos", one_minus_cos), 0, 1)

        def call(cosine: Any, axis: Any, size: Any, rgb: Any) -> None:
            rgb[0] = lib.lmp_preintegrated_brdf_eval(self._c, cosine[0], axis[0], size[0])

        return _arrays.each(None, (3,), call, ("cos_theta_o", cosines, 0, "float *"),
                            ("axis", _arrays.directions("axis", axis), 1, "lmp_vec3 *"),
                            ("one_minus_cos", sizes, 0, "float *"), ctype="lmp_rgb *")

    def ambient(self, cos_theta_o: ArrayLike) -> NDArray[np.float32]:
        """Responses (…, 3) to ambient radiance 1, for cosines of the view's angle, 0 … 1 (…)."""
        cosines = _arrays.within("cos_theta_o", _arrays.numbers("cos_theta_o", cos_theta_o), 0, 1)

        def call(cosine: Any, rgb: Any) -> None:
            rgb[0] = lib.lmp_preintegrated_brdf_ambient(self._c, cosine[0])

        return _arrays.each(None, (3,), call, ("cos_theta_o", cosines, 0, "float *"),
                            ctype="lmp_rgb *")

    def describe(self) -> SimpleNamespace:
        """Its bands, window, error, bytes and the arrays that a kernel of your own reads:
        view_remap, cap_remap, ambient, slices [view][cap] and texels."""
        found = lib.lmp_preintegrated_brdf_describe(self._c)
        info = _core.record(found)
        views, caps = found.view_count, found.cap_count
        info.view_remap = _core.view(self, found.view_remap, (found.view_steps + 1,), np.float32)
        info.cap_remap = _core.view(self, found.cap_remap, (found.cap_steps + 1,), np.float32)
        info.ambient = _core.view(self, found.ambient, (views, 3), np.float32)
        info.slices = _core.view(self, found.slices, (views, caps),
                                 _core.dtype_of("lmp_preintegrated_brdf_slice"))
        info.texels = _core.view(self, found.texels, (found.texel_count, 3), np.int16)
        return info
