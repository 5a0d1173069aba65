# SPDX-License-Identifier: MIT
"""Circularly symmetric kernels k(q·w), and their responses to lights (lampion/lobe.h).

A lobe is an array (n,) of its Funk-Hecke factors lambda_l = 2 pi ∫ k(t) P_l(t) dt; its coefficients
around the axis q are lambda_l Y_lm(q).
"""
from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _arrays, _core
from ._core import constants, ffi, lib
from .light import as_lights, pointer

__all__ = ["make_diffuse", "make_phong", "make_vmf", "project", "response", "find_ggx",
           "copy_ggx_texels"]


def _factors(bands: int, make: Any, *numbers: float) -> NDArray[np.float32]:
    factors = np.empty(_core.bands(bands), np.float32)
    make(factors.size, *numbers, ffi.from_buffer("float[]", factors))
    return factors


def make_diffuse(bands: int) -> NDArray[np.float32]:
    """Factors (n,) of max(t, 0), the cosine of diffuse reflection; the first is pi."""
    return _factors(bands, lib.lmp_lobe_make_diffuse)


def make_phong(bands: int, exponent: float) -> NDArray[np.float32]:
    """Factors (n,) of (e+1)/(2 pi) max(t, 0)^e, whose integral is 1, e >= 0."""
    return _factors(bands, lib.lmp_lobe_make_phong, _core.number("exponent", exponent, 0))


def make_vmf(bands: int, concentration: float) -> NDArray[np.float32]:
    """Factors (n,) of the von Mises-Fisher lobe k/(2 pi (1 - exp(-2k))) exp(k (t - 1)), whose
    integral is 1, k > 0."""
    return _factors(bands, lib.lmp_lobe_make_vmf,
                    _core.number("concentration", concentration, 1e-30))


def project(factors: ArrayLike, axis: ArrayLike, *, out: NDArray | None = None) -> NDArray:
    """Coefficients (…, n²) lambda_l Y_lm(axis) of lobes (…, n) around axes (…, 3), unit."""
    n, scales = _arrays.per_band("factors", factors)
    axes = _arrays.directions("axis", axis)
    return _arrays.each(out, (n * n,), lambda k, q, sh: lib.lmp_lobe_project(n, k, q[0], sh),
                        ("factors", scales, 1, "float *"), ("axis", axes, 1, "lmp_vec3 *"))


def response(factors: ArrayLike, axis: ArrayLike, lights: Any, point: ArrayLike, *,
             out: NDArray | None = None) -> NDArray[np.float32]:
    """The light that a lobe gathers, ∫ L(w) k(axis·w) dw, in O(n) per light.

    Parameters
    ----------
    factors : array_like, (n,)
    axis : array_like, (…, 3)
        Unit.
    lights : array of `light.dtype`, or a sequence of such arrays
        Spheres alone are summed for all points at once; others point by point.
    point : array_like, (…, 3)
    out : ndarray of float32, (…, 3), optional

    Returns
    -------
    ndarray of float32, (…, 3)
        The series is truncated, so it may fall below 0.
    """
    n, scales = _arrays.per_band("factors", factors)
    if scales.ndim != 1:
        raise ValueError(f"factors must have the shape (n,), not {scales.shape}")
    scales = np.ascontiguousarray(scales)
    axes, listed = _arrays.directions("axis", axis), as_lights(lights)
    places = _arrays.points("point", point)
    where = ffi.from_buffer("float[]", scales)
    if listed["kind"].any():
        def call(axis: Any, place: Any, rgb: Any) -> None:
            rgb[0] = lib.lmp_lobe_response(n, where, axis[0], pointer(listed), listed.size,
                                           place[0])

        return _arrays.each(out, (3,), call, ("axis", axes, 1, "lmp_vec3 *"),
                            ("point", places, 1, "lmp_vec3 *"), ctype="lmp_rgb *")
    shape = _arrays.common_shape(("axis", axes, 1), ("point", places, 1))
    result = _arrays.Result(out, shape + (3,), [axes, places])
    keep: list = []
    members = {"center": _arrays.vec3_array(listed["position"], listed.shape, keep),
               "radius": _arrays.float_array(listed["radius"], listed.shape, keep),
               "radiance": _arrays.vec3_array(listed["radiance"], listed.shape, keep)}
    lib.lmp_lobe_response_n(n, where, _arrays.vec3_array(axes, shape, keep),
                            ffi.new("lmp_spheres *", members), listed.size,
                            _arrays.vec3_array(places, shape, keep), math.prod(shape), result.rgb())
    return result.finish()


def find_ggx(normal: ArrayLike, view: ArrayLike, roughness: ArrayLike) -> NDArray:
    """The Phong lobes by which glTF's GGX is approximated, of surfaces with normal and view
    (…, 3), unit, and glTF's roughness (…): an array (…) with the members lobe (5) of axis,
    exponent, f0 and f90, and diffuse_f0, diffuse_f90 of lmp_ggx_lobes."""
    normals, views = _arrays.directions("normal", normal), _arrays.directions("view", view)
    rough = _arrays.within("roughness", _arrays.numbers("roughness", roughness), 0, 1)
    return _arrays.each(None, (), lambda n, v, r, o: lib.lmp_lobe_find_ggx(n[0], v[0], r[0], o),
                        ("normal", normals, 1, "lmp_vec3 *"), ("view", views, 1, "lmp_vec3 *"),
                        ("roughness", rough, 0, "float *"), dtype=_core.dtype_of("lmp_ggx_lobes"),
                        ctype="lmp_ggx_lobes *")


def copy_ggx_texels() -> NDArray[np.float32]:
    """The table of GGX lobes that ggx.glsl reads, (5152, 4)."""
    texels = np.empty((constants.GGX_TEXELS, 4), np.float32)
    lib.lmp_lobe_copy_ggx_texels(ffi.from_buffer("float[]", texels))
    return texels
